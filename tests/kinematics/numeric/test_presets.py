"""The settings of the sources do what the sources did with them."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from rvsim import load_robot
from rvsim.kinematics import forward_kinematics, solve_numeric
from rvsim.kinematics.numeric import AS_IN_SOURCE_000, AS_IN_SOURCE_002, NumericResult, Preset
from rvsim.lab.drawings import ellipse
from rvsim.robot import Robot
from rvsim.spatial import rot_x, transform


def follow(robot: Robot, preset: Preset, targets: np.ndarray) -> list[NumericResult]:
    """One target after the other, each from the solution before if the preset says so."""
    start: ArrayLike | None = preset.guess
    results: list[NumericResult] = []
    for T in targets:
        results.append(solve_numeric(robot, T, start, preset.solver, task=preset.task, options=preset.options))
        start = results[-1].q if preset.warm_start else preset.guess
    return results


def test_source_000_tracks_the_part_of_its_line_that_its_limits_allow_within_a_millimetre() -> None:
    robot = load_robot("rv-m1")
    along = np.linspace(0.6, 0.9, 4)[:, None]
    points = np.array([0.11, 0.0, 0.13]) + along * np.array([0.12, 0.0, 0.203])
    targets = transform(np.broadcast_to(rot_x(np.pi), (4, 3, 3)), points)
    results = follow(robot, AS_IN_SOURCE_000, targets)
    assert all(result.converged for result in results)
    reached = forward_kinematics(robot, [result.q for result in results])
    assert np.linalg.norm(reached[:, :3, 3] - points, axis=1).max() <= 1e-3
    assert max(result.rotation_error for result in results) <= 0.1


def test_source_002_reaches_every_point_of_its_ellipse_within_a_millimetre() -> None:
    robot, points = load_robot("ur5e"), ellipse()
    results = follow(robot, AS_IN_SOURCE_002, transform(np.eye(3), points))
    assert all(result.converged and result.restarts == 0 for result in results)
    reached = forward_kinematics(robot, [result.q for result in results])
    assert np.linalg.norm(reached[:, :3, 3] - points, axis=1).max() <= 1e-3
