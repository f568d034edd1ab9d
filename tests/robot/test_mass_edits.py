"""Edits of the mass data change one number of one link of a copy, and say that it is assumed."""

import numpy as np
import pytest

from rvsim.dynamics import gravity_torques, mass_matrix
from rvsim.errors import RobotDefinitionError, UnknownNameError
from rvsim.files import load_robot, robot_names
from rvsim.robot.mass_edits import MASS_KEYS, mass_value, with_guessed_masses, with_mass_value


@pytest.mark.parametrize("key", MASS_KEYS)
@pytest.mark.parametrize("name", ["ur5e", "rrrp"])
def test_one_number_changes_and_counts_as_assumed(name, key):
    robot = load_robot(name)
    edited = with_mass_value(robot, 1, key, 0.75)
    assert mass_value(edited.masses[1], key) == 0.75
    assert edited.masses[1].assumed
    others = [other for other in MASS_KEYS if other != key]
    before = [mass_value(robot.masses[1], other) if robot.masses else 0.0 for other in others]
    assert [mass_value(edited.masses[1], other) for other in others] == before
    assert len(edited.masses) == robot.dof
    if robot.masses:
        assert edited.masses[0] is robot.masses[0]
        assert not robot.masses[1].assumed


@pytest.mark.parametrize(("key", "value"), [("mass", -1.0), ("zz", -1e-3), ("x", float("nan"))])
def test_what_no_body_can_have_is_refused(key, value):
    with pytest.raises(RobotDefinitionError, match="link 2"):
        with_mass_value(load_robot("ur5e"), 1, key, value)


def test_a_misspelt_key_is_named():
    with pytest.raises(UnknownNameError, match="mass"):
        with_mass_value(load_robot("ur5e"), 1, "weight", 1.0)


@pytest.mark.parametrize("name", robot_names())
def test_a_guess_makes_every_arm_computable(name):
    robot = with_guessed_masses(load_robot(name))
    assert np.linalg.eigvalsh(mass_matrix(robot, robot.home)).min() > 0.0
    assert np.all(np.isfinite(gravity_torques(robot, robot.home)))
