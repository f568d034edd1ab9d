"""The place alone for arms of six joints: the place exactly, and of all orientations the one nearest to the wanted."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from rvsim import forward_kinematics, inverse_kinematics, load_robot
from rvsim.kinematics import branch_labels, inverse_kinematics_batch, inverse_tasks
from rvsim.kinematics.inverse import InverseResult
from rvsim.lab.drawings import ellipse, ellipse_rotation
from rvsim.robot import Robot, Tool
from rvsim.spatial import rotation_error_angle, rotation_from_quaternion, rotation_from_vector, transform, translation

ARMS = ("ur5e", "rv-1a")


def reached(robot: Robot, T: np.ndarray, near: np.ndarray | None = None) -> InverseResult:
    result = inverse_kinematics(robot, T, task="position", near=near)
    for branch in result.branches:
        assert branch.residual <= 1e-9
        assert branch.continuum
        np.testing.assert_allclose(forward_kinematics(robot, branch.q)[:3, 3], T[:3, 3], atol=1e-9)
    return result


def turns(robot: Robot, result: InverseResult, T: np.ndarray) -> dict[str, float]:
    """Label → how far the tool is turned from T."""
    return {
        branch.label: float(rotation_error_angle(forward_kinematics(robot, branch.q)[:3, :3], T[:3, :3]))
        for branch in result.branches
    }


def wanted(rng: np.random.Generator, place: np.ndarray) -> np.ndarray:
    return transform(rotation_from_quaternion(rng.normal(size=4)), place)


@pytest.mark.parametrize("name", ARMS)
def test_a_branch_that_has_the_wanted_orientation_keeps_it(name: str, random_q: Callable[..., np.ndarray]) -> None:
    robot = load_robot(name)
    assert inverse_tasks(robot) == ("pose", "position")
    for q in random_q(robot, 30):
        T = forward_kinematics(robot, q)
        result = reached(robot, T, q)
        assert result.best is not None
        assert result.best.distance < 1e-6
        turned = turns(robot, result, T)
        for branch in inverse_kinematics(robot, T, near=q).branches:
            assert turned.get(branch.label, 0.0) < 1e-9


def test_no_orientation_nearer_to_the_wanted_one_has_the_branch() -> None:
    robot, rng = load_robot("ur5e"), np.random.default_rng(1)
    labels = branch_labels(robot)
    for place in rng.uniform([-0.5, -0.5, -0.2], [0.5, 0.5, 0.8], (12, 3)):
        T = wanted(rng, place)
        turned = turns(robot, reached(robot, T), T)
        axes = rng.normal(size=(4000, 3))
        angles = rng.uniform(0.0, np.pi, 4000)
        others = np.tile(T, (4000, 1, 1))
        vectors = axes / np.linalg.norm(axes, axis=1, keepdims=True) * angles[:, None]
        others[:, :3, :3] = rotation_from_vector(vectors) @ T[:3, :3]
        lacking = np.asarray(np.isnan(inverse_kinematics_batch(robot, others)).any(axis=2))
        for i, label in enumerate(labels):
            if label in turned:  # a stretched elbow is one branch: the other label's
                assert np.where(lacking[:, i], np.pi, angles).min() > turned[label] - 1e-6


def test_all_of_the_ellipse_of_source_002_is_reached_with_the_least_tilt() -> None:
    robot, R = load_robot("ur5e"), ellipse_rotation()
    least = []
    for place in ellipse():
        T = transform(R, place)
        least.append(min(turns(robot, reached(robot, T), T).values()))
    assert len(least) == 184
    assert np.degrees(max(least)) == pytest.approx(12.72, abs=0.01)
    assert sum(turn < 1e-9 for turn in least) == 114
    # The wrist's 99.6 mm must bring the flange 133.3 mm off the base axis.
    away = np.linalg.norm(ellipse()[:, :2], axis=1)
    tilts = np.arcsin(np.maximum(0.1333 - away, 0.0) / 0.0996)
    np.testing.assert_allclose(least, tilts, atol=1e-5)


def test_at_the_border_of_its_reach_the_arm_turns_the_tool_outwards() -> None:
    robot = load_robot("rv-1a")
    far = forward_kinematics(robot, [0.3, np.pi / 2, -np.pi / 2 + 0.1, 0.0, 0.1, 0.0])[:3, 3]
    result = reached(robot, transform(np.diag([1.0, -1.0, -1.0]), far))
    assert result.best is not None


def test_where_every_branch_breaks_a_limit_the_tool_turns_until_one_does_not(
    random_q: Callable[..., np.ndarray],
) -> None:
    robot, rng = load_robot("rv-1a"), np.random.default_rng(4)
    given_way = 0
    for q in random_q(robot, 12, seed=4):
        T = wanted(rng, forward_kinematics(robot, q)[:3, 3])
        given_way += not any(branch.within_limits for branch in inverse_kinematics(robot, T).branches)
        result = reached(robot, T)
        assert result.failure is None
    assert given_way >= 3


def test_a_tip_beside_the_last_axis_is_brought_to_its_place_as_well(random_q: Callable[..., np.ndarray]) -> None:
    robot, rng = load_robot("ur5e"), np.random.default_rng(5)
    bent = Tool("bent", "Bent", translation([0.05, 0.03, 0.12]))
    robot = replace(robot, tools=(*robot.tools, bent), tool_name="bent")
    for q in random_q(robot, 6, seed=5):
        assert len(reached(robot, wanted(rng, forward_kinematics(robot, q)[:3, 3])).branches) >= 2


@pytest.mark.parametrize("name", ARMS)
def test_a_place_out_of_reach_is_told_with_the_nearest(name: str) -> None:
    robot = load_robot(name)
    failure = inverse_kinematics(robot, transform(np.eye(3), [2.0, 0.0, 0.3]), task="position").failure
    assert failure is not None
    assert failure.kind == "reach"
    assert "away" in failure.reason
    assert failure.nearest.position_error > 0.5
