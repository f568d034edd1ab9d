"""The Jacobian is the derivative of the forward kinematics, for every arm."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim import forward_kinematics, jacobian, load_robot, robot_names
from rvsim.errors import ShapeError
from rvsim.kinematics import pose_and_jacobian
from rvsim.robot import Joint, Robot, Tool
from rvsim.spatial import rotation_error, transform_from_twist

ORACLE_NAMES = {"rv-m1": "rvm1", "rv-1a": "rv1a", "ur5e": "ur5e", "rrrp": "rrrp", "al5b": "al5b"}


def assert_derivative(robot: Robot, q: np.ndarray, J: np.ndarray) -> None:
    """Central differences, one joint at a time: the tool's displacement and rotation vector over the step."""
    step = 1e-5
    for joint, column in enumerate(np.moveaxis(J, -1, 0)):
        shift = step * np.eye(robot.dof)[joint]
        before, after = forward_kinematics(robot, q - shift), forward_kinematics(robot, q + shift)
        linear = (after - before)[..., :3, 3]
        angular = rotation_error(before[..., :3, :3], after[..., :3, :3])
        np.testing.assert_allclose(column, np.concatenate([linear, angular], -1) / (2.0 * step), atol=3e-9)


def random_poses(robot: Robot, *shape: int, seed: int = 3) -> np.ndarray:
    return np.random.default_rng(seed).uniform(-np.pi, np.pi, (*shape, robot.dof))


@pytest.mark.parametrize("name", ORACLE_NAMES)
def test_the_jacobian_is_the_oracles(name, oracle):
    samples = oracle["robots"][ORACLE_NAMES[name]]["samples"]
    robot = load_robot(name)
    for sample in samples:
        np.testing.assert_allclose(jacobian(robot, sample["q"]), sample["J"], rtol=0.0, atol=1e-12)
    q, J = (np.array([sample[key] for sample in samples]) for key in "qJ")
    np.testing.assert_allclose(jacobian(robot, q), J, rtol=0.0, atol=1e-12)


@pytest.mark.parametrize("name", robot_names())
def test_every_arm_with_each_tool_moves_as_its_jacobian_says(name):
    robot = load_robot(name)
    for held in (robot.with_tool(tool.name) for tool in robot.tools):
        q = random_poses(held, 40)
        assert_derivative(held, q, jacobian(held, q))


lengths = st.floats(-1.0, 1.0)
joints = st.builds(
    Joint, st.just("j"), st.sampled_from(["revolute", "prismatic"]), lengths, lengths, lengths, st.floats(-3.2, 3.2)
)
placements = st.lists(lengths, min_size=6, max_size=6).map(transform_from_twist)


@given(st.lists(joints, min_size=1, max_size=7), st.sampled_from(["standard", "modified"]), placements, placements)
def test_any_dh_table_moves_as_its_jacobian_says(rows, convention, base, tool):
    robot = Robot("any", "Any", convention, tuple(rows), base, (Tool("tool", "Tool", tool),))
    q = random_poses(robot, 2)
    assert_derivative(robot, q, jacobian(robot, q))


@pytest.mark.parametrize("name", robot_names())
@pytest.mark.parametrize("shape", [(), (0,), (3, 4), (50,)])
def test_any_leading_shape_alone_or_together_with_the_pose(name, shape):
    robot = load_robot(name)
    q = random_poses(robot, *shape)
    J = jacobian(robot, q)
    both = pose_and_jacobian(robot, q)
    assert J.shape == both.J.shape == (*shape, 6, robot.dof)
    np.testing.assert_allclose(both.J, J, atol=1e-14)
    np.testing.assert_allclose(both.T, forward_kinematics(robot, q), atol=1e-14)


def test_a_wrong_number_of_joints_is_named():
    with pytest.raises(ShapeError, match=r"q must have the shape \(\.\.\., 5\)"):
        jacobian(load_robot("rv-m1"), np.zeros((2, 6)))
