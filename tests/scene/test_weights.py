"""Each link's weight hangs at its centre of mass; together they hang where the potential energy says."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rvsim.dynamics import potential_energy
from rvsim.files import load_robot
from rvsim.scene.palette import DARK
from rvsim.scene.weights import centers_of_mass, weight_items


@pytest.mark.parametrize("name", ["rv-m1", "rv-1a", "ur5e", "al5b", "planar"])
def test_the_heights_give_the_potential_energy(name):
    robot = load_robot(name)
    q = np.random.default_rng(2).uniform(-2.0, 2.0, robot.dof)
    heights = centers_of_mass(robot, q)[:, 2]
    expected = 9.81 * sum(link.mass * z for link, z in zip(robot.masses, heights, strict=True))
    assert potential_energy(robot, q, gravity=9.81) == pytest.approx(expected, abs=1e-9)


def test_an_arm_without_masses_shows_none():
    robot = load_robot("ur5e")
    assert weight_items(replace(robot, masses=()), robot.home, DARK) == ()
    keys = [item.key for item in weight_items(robot, robot.home, DARK)]
    assert len(set(keys)) == len(keys)
