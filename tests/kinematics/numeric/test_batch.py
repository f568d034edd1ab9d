"""Many poses at once: every one that can be reached is reached, and nothing is said to be that is not."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim import load_robot, robot_names
from rvsim.errors import PoseError, ShapeError, UnknownNameError
from rvsim.kinematics import forward_kinematics
from rvsim.kinematics.numeric import solve_numeric_batch
from rvsim.robot import Convention, Joint, Robot
from rvsim.robot.arrays import FloatArray
from rvsim.spatial import pose_difference, rotation_from_rpy, transform, translation

TOLERANCE = 1e-6


def reachable_poses(robot: Robot, count: int, seed: int = 7) -> FloatArray:
    """Poses of random configurations within the limits, of angles without limits within half a turn, of lengths 3."""
    bound = np.where(robot.is_revolute, np.pi, 3.0)
    low, high = np.maximum(robot.limits[:, 0], -bound), np.minimum(robot.limits[:, 1], bound)
    return forward_kinematics(robot, np.random.default_rng(seed).uniform(low, high, (count, robot.dof)))


def within_limits(robot: Robot, q: FloatArray) -> bool:
    return bool(np.all((q >= robot.limits[:, 0]) & (q <= robot.limits[:, 1])))


@pytest.mark.parametrize("name", ["ur5e", "rv-m1"])
def test_two_thousand_random_poses_are_all_solved_within_a_micrometre_and_a_microradian(name: str) -> None:
    robot = load_robot(name)
    T = reachable_poses(robot, 2000)
    result = solve_numeric_batch(robot, T)
    assert result.converged.all()
    assert within_limits(robot, result.q)
    difference = pose_difference(forward_kinematics(robot, result.q), T)
    assert difference.position.max() < TOLERANCE
    assert difference.angle.max() < TOLERANCE


@pytest.mark.parametrize("task", ["pose", "position"])
@pytest.mark.parametrize("name", robot_names())
def test_every_arm_reaches_what_it_can(name: str, task: str) -> None:
    robot = load_robot(name)
    T = reachable_poses(robot, 100)
    result = solve_numeric_batch(robot, T, task=task)
    assert result.converged.all()
    assert within_limits(robot, result.q)
    difference = pose_difference(forward_kinematics(robot, result.q), T)
    assert difference.position.max() < TOLERANCE
    assert task == "position" or difference.angle.max() < TOLERANCE


@pytest.mark.parametrize("convention", ["standard", "modified"])
@pytest.mark.parametrize("dof", [1, 2, 7])
def test_an_arm_of_ones_own_needs_no_closed_form(dof: int, convention: Convention) -> None:
    random = np.random.default_rng(dof)
    rows = random.uniform([-3.0, -0.3, -0.3, -2.0], [3.0, 0.3, 0.3, 2.0], (dof, 4))
    joints = [
        Joint(f"j{i}", "prismatic" if i == 3 else "revolute", theta, d, a, alpha, lower=-2.0, upper=2.5)
        for i, (theta, d, a, alpha) in enumerate(rows)
    ]
    base = transform(rotation_from_rpy([0.3, -0.5, 1.0]), [0.1, 0.2, 0.3])
    robot = Robot("own", "An arm of one's own", convention, tuple(joints), base)
    assert solve_numeric_batch(robot, reachable_poses(robot, 200)).converged.all()


def test_what_cannot_be_reached_is_nan_and_not_converged() -> None:
    robot = load_robot("rv-m1")
    T = reachable_poses(robot, 5)
    T[2] = translation([2.0 * robot.size, 0.0, 0.0]) @ T[2]
    result = solve_numeric_batch(robot, T)
    assert result.converged.tolist() == [True, True, False, True, True]
    assert np.isnan(result.q[2]).all()


def test_a_pose_that_a_five_axis_arm_cannot_take_is_not_converged_but_its_place_is() -> None:
    robot = load_robot("rv-m1")
    turn = np.array([[1.0, 0, 0], [0, np.cos(0.3), -np.sin(0.3)], [0, np.sin(0.3), np.cos(0.3)]])
    T = forward_kinematics(robot, [[0.3, 0.5, -1.0, 0.2, 0.1]])
    T[:, :3, :3] = T[:, :3, :3] @ turn
    assert not solve_numeric_batch(robot, T).converged.any()
    assert solve_numeric_batch(robot, T, task="position").converged.all()


def test_without_limits_a_pose_outside_them_is_found_and_with_them_it_is_not() -> None:
    robot = load_robot("rv-m1")
    T = forward_kinematics(robot, [[3.0, 0.2, -0.5, 0.1, 0.4], [0.2, 0.3, -2.5, -0.6, 0.1]])
    assert solve_numeric_batch(robot, T, enforce_joint_limits=False).converged.all()
    assert not solve_numeric_batch(robot, T).converged.all()


def test_the_answer_depends_on_the_poses_only() -> None:
    robot = load_robot("ur5e")
    T = reachable_poses(robot, 300)
    first, again = solve_numeric_batch(robot, T), solve_numeric_batch(robot, T)
    assert np.array_equal(first.q, again.q)
    assert solve_numeric_batch(robot, T[:0]).q.shape == (0, 6)


def test_what_is_no_pose_or_no_task_is_refused() -> None:
    robot = load_robot("ur5e")
    with pytest.raises(ShapeError):
        solve_numeric_batch(robot, np.eye(4))
    with pytest.raises(PoseError):
        solve_numeric_batch(robot, 2.0 * np.eye(4)[None])
    with pytest.raises(PoseError):
        solve_numeric_batch(robot, np.full((1, 4, 4), np.nan), task="position")
    with pytest.raises(UnknownNameError, match="position"):
        solve_numeric_batch(robot, np.eye(4)[None], task="positon")
