"""Two ways to the tool that share nothing agree to rounding, for every arm."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim import forward_kinematics, jacobian, load_robot, robot_names
from rvsim.errors import ShapeError
from rvsim.kinematics import forward_by_exponentials, forward_difference, product_of_exponentials, screw_axes
from rvsim.robot import Robot


def random_poses(robot: Robot, *shape: int) -> np.ndarray:
    return np.random.default_rng(5).uniform(-np.pi, np.pi, (*shape, robot.dof))


def span(robot: Robot) -> float:
    """The arm's size with the place of its base and a slide of π: what the rounding is measured by."""
    slides = np.pi * np.count_nonzero(~robot.is_revolute)
    return max(1.0, robot.size + slides + float(np.linalg.norm(robot.T_base_0[:3, 3])))


@pytest.mark.parametrize("name", robot_names())
def test_both_ways_agree_to_rounding_with_each_tool(name):
    robot = load_robot(name)
    for held in (robot.with_tool(tool.name) for tool in robot.tools):
        difference = forward_difference(held, random_poses(held, 1000))
        assert difference.position.max() <= 1e-14 * span(held)
        assert difference.rotation.max() <= 1e-14


@pytest.mark.parametrize("name", robot_names())
def test_at_zero_the_screws_are_the_jacobian_and_the_tool_stands_at_m(name):
    robot = load_robot(name)
    zero = np.zeros(robot.dof)
    J = jacobian(robot, zero)
    # A twist at the base origin is v + p × ω for a tool at p.
    p = forward_kinematics(robot, zero)[:3, 3]
    linear = J[:3].T + np.cross(p, J[3:].T)
    np.testing.assert_allclose(screw_axes(robot), np.hstack([linear, J[3:].T]), atol=1e-14)
    np.testing.assert_allclose(product_of_exponentials(robot).M, forward_kinematics(robot, zero), atol=1e-14)


@pytest.mark.parametrize("shape", [(), (0,), (3, 4)])
def test_any_leading_shape(shape):
    robot = load_robot("rrrp")
    q = random_poses(robot, *shape)
    assert forward_by_exponentials(robot, q).shape == (*shape, 4, 4)
    assert forward_difference(robot, q).position.shape == forward_difference(robot, q).rotation.shape == shape


def test_a_wrong_number_of_joints_is_named():
    with pytest.raises(ShapeError, match="q must have the shape"):
        forward_by_exponentials(load_robot("ur5e"), np.zeros(5))
