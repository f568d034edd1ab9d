"""Creeping after a target that leaves the arm's reach: as near as the pose that a search finds, and never by a jump."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim import forward_kinematics, inverse_kinematics, load_robot
from rvsim.kinematics.inverse.creep import creep
from rvsim.kinematics.inverse.nearest import nearest_configuration
from rvsim.kinematics.inverse.solve import attempt

BEGINS = {
    "rv-m1": (0.5, 0.7, -0.9, 0.35, 1.0),
    "rv-1a": (0.3, 1.4, 0.5, 0.7, 0.9, 0.5),
    "ur5e": (0.3, -1.2, 1.7, -0.9, 1.0, 0.6),
    "al5b": (0.3, 1.7, -1.4, -0.3, 0.3),
}
STEPS = 8


def followed(name: str, direction: np.ndarray, place_only: bool, sizes: float = 1.0):
    """The joints (k, n) of an arm whose target goes straight away, and the last target."""
    robot, q = load_robot(name), np.array(BEGINS[name])
    T = forward_kinematics(robot, q)
    way = [q]
    for _ in range(60):
        T[:3, 3] += sizes * robot.size / 60 * direction
        way.append(creep(robot, way[-1], T, robot.limits, place_only=place_only, steps=STEPS).q)
    for _ in range(60):
        crept = creep(robot, way[-1], T, robot.limits, place_only=place_only, steps=STEPS)
        way.append(crept.q)
        if crept.settled:
            break
    assert crept.settled
    return robot, np.array(way), T


def directions(count: int) -> np.ndarray:
    vectors = np.random.default_rng(3).normal(size=(count, 3))
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


@pytest.mark.parametrize("place_only", [False, True])
@pytest.mark.parametrize("name", BEGINS)
def test_the_limits_are_kept_no_step_is_a_jump_and_in_the_end_nothing_nearby_is_nearer(name, place_only) -> None:
    for direction in directions(6):
        robot, way, T = followed(name, direction, place_only)
        assert (way >= robot.limits[:, 0]).all()
        assert (way <= robot.limits[:, 1]).all()
        assert np.abs(np.diff(way, axis=0)).max() <= 0.25 + 1e-12
        around = (
            way[-1] + np.random.default_rng(0).normal(size=(4000, robot.dof)) * np.geomspace(1e-4, 0.05, 4000)[:, None]
        )
        near = forward_kinematics(robot, np.clip(around, *robot.limits.T))[:, :3, 3]
        error = np.linalg.norm(forward_kinematics(robot, way[-1])[:3, 3] - T[:3, 3])
        assert error <= np.linalg.norm(near - T[:3, 3], axis=1).min() + 1e-4 * robot.size


@pytest.mark.parametrize("name", BEGINS)
def test_straight_out_of_reach_it_comes_as_near_as_a_search_everywhere_would(name) -> None:
    robot = load_robot(name)
    outwards = forward_kinematics(robot, np.array(BEGINS[name]))[:3, 3] - robot.T_base_0[:3, 3]
    robot, way, T = followed(name, outwards / np.linalg.norm(outwards), False, sizes=0.8)
    best = nearest_configuration(robot, T, way[-1], robot.limits, way[-1:], place_only=False)
    error = np.linalg.norm(forward_kinematics(robot, way[-1])[:3, 3] - T[:3, 3])
    assert error <= best.position_error + 0.005 * robot.size


@pytest.mark.parametrize("name", BEGINS)
def test_a_target_within_reach_is_reached_pose_and_all(name) -> None:
    robot, q = load_robot(name), np.array(BEGINS[name])
    T = forward_kinematics(robot, q + 0.04)
    for _ in range(5):
        q = creep(robot, q, T, robot.limits, place_only=False, steps=STEPS).q
    np.testing.assert_allclose(forward_kinematics(robot, q), T, atol=1e-6)


def test_an_attempt_in_a_hurry_has_the_same_branches_and_can_be_asked_why_not_later() -> None:
    robot = load_robot("rv-m1")
    for target, reached in ((BEGINS["rv-m1"], True), ((0.5, 0.7, -2.1, 0.35, 1.0), False)):
        T = forward_kinematics(robot, target)
        tried, result = attempt(robot, T), inverse_kinematics(robot, T)
        assert tried.reached is reached
        assert [branch.label for branch in tried.branches] == [branch.label for branch in result.branches]
        if not reached:
            assert tried.failure().kind == result.failure.kind == "limits"
