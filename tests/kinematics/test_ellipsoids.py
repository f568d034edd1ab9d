"""An ellipsoid's axes are the singular vectors, and what it says holds for every joint speed and every force."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim import jacobian, load_robot, robot_names
from rvsim.errors import ShapeError, UnknownNameError
from rvsim.kinematics import ellipsoid

PARTS = {"linear": slice(0, 3), "angular": slice(3, 6)}


def any_jacobian(name: str) -> np.ndarray:
    robot = load_robot(name)
    return jacobian(robot, np.random.default_rng(2).uniform(0.2, 1.2, robot.dof))


@pytest.mark.parametrize("name", robot_names())
@pytest.mark.parametrize("part", PARTS)
def test_its_axes_are_the_singular_vectors(name, part):
    J = any_jacobian(name)
    found, rows = ellipsoid(J, part), J[PARTS[part]]
    np.testing.assert_allclose(found.axes @ found.axes.T, np.eye(3), atol=1e-14)
    np.testing.assert_allclose(rows @ rows.T @ found.axes, found.axes * found.radii**2, atol=1e-12)


@pytest.mark.parametrize("name", ["rv-m1", "ur5e", "rv-1a", "al5b"])
@pytest.mark.parametrize("part", PARTS)
def test_velocities_and_forces_trade_places(name, part):
    J = any_jacobian(name)
    velocity, force = ellipsoid(J, part), ellipsoid(J, part, "force")
    np.testing.assert_array_equal(velocity.axes, force.axes)
    np.testing.assert_allclose(velocity.radii * force.radii, 1.0)
    torques = J[PARTS[part]].T @ (force.axes * force.radii)
    np.testing.assert_allclose(np.linalg.norm(torques, axis=0), 1.0)


def test_unit_joint_speeds_stay_inside_and_reach_the_surface():
    J = any_jacobian("ur5e")
    found = ellipsoid(J)
    speeds = np.random.default_rng(1).normal(size=(500, 6))
    speeds /= np.linalg.norm(speeds, axis=1, keepdims=True)
    inside = np.linalg.norm((speeds @ J[:3].T @ found.axes) / found.radii, axis=1)
    assert inside.max() <= 1.0 + 1e-12
    assert inside.max() > 0.95


def test_a_planar_arm_moves_in_a_disc_and_bears_any_force_across_it():
    J = any_jacobian("planar")
    np.testing.assert_allclose(np.abs(ellipsoid(J).axes[:, 2]), [0.0, 0.0, 1.0], atol=1e-12)
    assert ellipsoid(J).radii[2] == 0.0
    assert np.isposinf(ellipsoid(J, "linear", "force").radii[2])


def test_wrong_arguments_are_named():
    J = any_jacobian("ur5e")
    with pytest.raises(UnknownNameError, match="linear, angular"):
        ellipsoid(J, "line")  # type: ignore[arg-type]
    with pytest.raises(UnknownNameError, match="velocity, force"):
        ellipsoid(J, "linear", "speed")  # type: ignore[arg-type]
    with pytest.raises(ShapeError, match="J"):
        ellipsoid(J[:5])
