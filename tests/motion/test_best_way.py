"""The best way to a pose: every candidate ends there, keeps the limits, and none that is ranked lower is better."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim import forward_kinematics, inverse_kinematics, load_robot
from rvsim.motion import best_way
from rvsim.motion.best_way import CRITERIA, MOVE_LAWS, Criterion, Way, best_ways, best_ways_to
from rvsim.motion.trajectory import accelerations, speeds
from rvsim.robot import Robot

GOAL = {"ur5e": (20, -70, 100, -60, -80, 30), "rv-m1": (40, 30, -60, -20, 50), "scara": (30, 40, 0.05, 20)}


def goal(robot: Robot) -> np.ndarray:
    values = np.array(GOAL[robot.name], dtype=float)
    return np.where(robot.is_revolute, np.radians(values), values)


@pytest.fixture(params=GOAL)
def robot(request: pytest.FixtureRequest) -> Robot:
    return load_robot(request.param)


def ways(robot: Robot, criterion: Criterion = "quickest") -> tuple[Way, ...]:
    return best_ways_to(robot, robot.home, goal(robot), criterion)


def test_there_is_one_way_for_each_branch_and_each_puts_the_tool_there(robot: Robot) -> None:
    T = forward_kinematics(robot, goal(robot))
    found = ways(robot)
    assert {way.label for way in found} == {b.label for b in inverse_kinematics(robot, T, near=robot.home).branches}
    for way in found:
        np.testing.assert_allclose(forward_kinematics(robot, way.q), T, atol=1e-9)
        assert way.possible == bool(np.all((way.q >= robot.limits[:, 0] - 1e-9) & (way.q <= robot.limits[:, 1] + 1e-9)))


@pytest.mark.parametrize("law", MOVE_LAWS)
def test_each_law_goes_from_rest_to_rest_and_no_joint_is_faster_than_it_may(robot: Robot, law: str) -> None:
    move = ways(robot)[0].moves[law]  # type: ignore[index]
    moments = move.at(np.linspace(0.0, move.duration, 300))
    np.testing.assert_allclose(moments.q[[0, -1]], [robot.home, ways(robot)[0].q], atol=1e-9)
    np.testing.assert_allclose(moments.qd[[0, -1]], 0.0, atol=2e-2)
    assert np.all(np.abs(moments.qd) <= speeds(robot) * 1.01)
    assert np.all(np.abs(moments.qdd) <= accelerations(robot) * 1.02)


@pytest.mark.parametrize("criterion", CRITERIA)
def test_the_first_is_the_best_of_those_that_are_clear(robot: Robot, criterion: Criterion) -> None:
    found = [way for way in ways(robot, criterion) if way.possible and way.clear]
    values = [way.seconds if criterion == "quickest" else way.motion for way in found]
    assert values == sorted(values)


def test_no_other_copy_of_an_angle_is_quicker_or_less_motion() -> None:
    robot = load_robot("ur5e")
    start = robot.home + np.radians([170, 0, 0, 0, 0, -170])
    best = best_ways_to(robot, start, start + np.radians([30, 5, 5, 5, 5, -30]), "least motion")[0]
    turned = best.q + 2.0 * np.pi * np.eye(6)[[0, 0, 5, 5]] * np.array([[1], [-1], [1], [-1]])
    for other in turned[np.all((turned >= robot.limits[:, 0]) & (turned <= robot.limits[:, 1]), axis=1)]:
        assert np.linalg.norm(other - start) > best.motion
        assert best_way._moves(robot, start, other)["jerk-limited"].duration >= best.seconds


def test_where_the_pose_is_out_of_reach_there_is_no_way() -> None:
    robot = load_robot("ur5e")
    T = np.eye(4)
    T[0, 3] = 5.0
    assert best_ways(robot, robot.home, T) == ()
