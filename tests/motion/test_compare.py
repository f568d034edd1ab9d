"""The comparison of solvers along a path: all find the path they can, and what the table says is what the joints do."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim import forward_kinematics, load_robot
from rvsim.lab import named_path
from rvsim.motion import Path
from rvsim.motion.compare import CONTESTANTS, Entry, comparison
from rvsim.robot import Robot

SECONDS = iter(range(10**9))


def entries(robot: Robot, path: Path, **settings: object) -> list[Entry]:
    parts = comparison(robot, path, clock=lambda: float(next(SECONDS)), **settings)  # type: ignore[arg-type]
    return [part for part in parts if isinstance(part, Entry)]


@pytest.fixture(scope="module")
def ellipse() -> tuple[Robot, list[Entry]]:
    robot = load_robot("ur5e")
    path = named_path("ellipse-moved", robot).part(slice(0, 24))
    return robot, entries(robot, path, near=np.radians([0, -90, 90, -90, -90, 0]))


def test_the_closed_form_comes_first_and_is_exact(ellipse: tuple[Robot, list[Entry]]) -> None:
    first = ellipse[1][0]
    assert [entry.contestant.name for entry in ellipse[1]] == [contestant.name for contestant in CONTESTANTS]
    assert first.success == 1.0
    assert first.largest < 1e-13
    assert first.largest_rotation < 1e-7
    assert not first.jumps


def test_every_solver_follows_within_its_tolerances(ellipse: tuple[Robot, list[Entry]]) -> None:
    for entry in ellipse[1][1:]:
        options = entry.contestant.options
        assert entry.success > 0.9
        assert entry.rms <= entry.largest <= options.position_tolerance
        assert entry.largest_rotation <= options.rotation_tolerance
        assert entry.iterations is not None
        assert entry.iterations >= entry.success * 23


def test_the_errors_are_those_of_the_joints(ellipse: tuple[Robot, list[Entry]]) -> None:
    robot, found = ellipse
    for entry in found:
        known = np.isfinite(entry.q).all(axis=1)
        points = named_path("ellipse-moved", robot).points[:24][known]
        away = np.linalg.norm(forward_kinematics(robot, entry.q[known])[:, :3, 3] - points, axis=1)
        np.testing.assert_allclose(entry.position_error[known], away, atol=1e-15)


def test_the_time_counts_one_tick_a_point(ellipse: tuple[Robot, list[Entry]]) -> None:
    assert ellipse[1][0].seconds == 1.0
    assert all(entry.seconds == 24.0 and entry.seconds_per_point == 1.0 for entry in ellipse[1][1:])


def test_points_out_of_reach_lower_the_success_of_all() -> None:
    robot = load_robot("rv-m1")
    closed, newton = entries(robot, named_path("line", robot).moved([0.25, 0.0, 0.0]).part(slice(0, 50, 7)))[:2]
    assert closed.success < 1.0
    assert newton.success <= closed.success


def test_an_arm_that_only_places_its_tool_is_asked_for_the_place_alone() -> None:
    robot = load_robot("planar")
    found = entries(robot, named_path("star", robot).part(slice(0, 101, 10)))
    assert found[0].success == 1.0
    assert all(np.isnan(entry.largest_rotation) for entry in found)


def test_it_tells_how_far_it_is_and_can_be_given_up() -> None:
    robot = load_robot("ur5e")
    path = named_path("ellipse-moved", robot).part(slice(0, 5))
    shares = [part for part in comparison(robot, path) if isinstance(part, float)]
    assert shares == sorted(shares)
    assert shares[0] >= 0.0
    assert shares[-1] < 1.0
