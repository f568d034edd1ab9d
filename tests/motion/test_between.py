"""How far the tool is off its path between the points: asked of the motion that the arm really makes."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim import load_robot
from rvsim.kinematics import forward_kinematics
from rvsim.lab import named_path
from rvsim.motion import line_path, through_points, track, trajectory_of
from rvsim.motion.between import off_at_points, off_between, way_deviation, ways_off_path

START, END = np.array([0.3, -0.18, 0.11]), np.array([0.3, 0.18, 0.21])


def off_the_line(samples: int) -> float:
    tracking = track(load_robot("rv-m1"), line_path(START, END, samples))
    found = way_deviation(trajectory_of(tracking, tracking.robot.home), tracking)
    assert found is not None
    return found


def test_a_spline_through_denser_points_leaves_a_line_much_less() -> None:
    off = np.array([off_the_line(samples) for samples in (11, 21, 41, 81)])
    assert (off[:-1] / off[1:] > 5.0).all()  # more than the four of straight chords


@pytest.mark.parametrize("law", ["quintic", "trapezoid", "quickest"])
def test_it_is_what_the_motion_does_whatever_its_law(law: str) -> None:
    robot = load_robot("rv-m1")
    tracking = track(robot, line_path(START, END, 13))
    trajectory = trajectory_of(tracking, robot.home, law=law)
    times = np.linspace(trajectory.path_start, trajectory.duration, 4001)
    offsets = forward_kinematics(robot, trajectory.q(times))[:, :3, 3] - START
    along = (END - START) / np.linalg.norm(END - START)
    seen = np.linalg.norm(offsets - np.outer(offsets @ along, along), axis=1).max()
    found = way_deviation(trajectory, tracking)
    assert found == pytest.approx(seen, rel=0.05)


def test_ways_over_missed_points_and_paths_of_one_point_do_not_count() -> None:
    robot = load_robot("rv-m1")
    away = through_points([[0.3, 0.0, 0.2], [3.0, 0.0, 0.2], [0.3, 0.1, 0.2]], np.diag([1.0, -1.0, -1.0]))
    tracking = track(robot, away)
    assert tracking.reached_count == 2
    assert way_deviation(trajectory_of(tracking, robot.home), tracking) is None


def test_the_spread_is_that_of_the_offsets_along_each_axis_and_of_their_lengths() -> None:
    robot = load_robot("rv-m1")
    tracking = track(robot, line_path(START, END, 11))
    motion = trajectory_of(tracking, robot.home)
    off = off_between(motion, tracking)
    assert off.spread is not None
    assert off.spread.largest[3] == way_deviation(motion, tracking)
    np.testing.assert_allclose(off.spread.rms[3] ** 2, np.sum(off.spread.rms[:3] ** 2))
    along = (END - START) / np.linalg.norm(END - START)
    np.testing.assert_allclose(off.offset @ along, 0.0, atol=1e-9)  # the nearest place is square to the line
    np.testing.assert_allclose(off.place - off.offset, START + np.outer(off.index / 10.0, END - START), atol=2e-3)
    assert off.worst is not None
    assert off.distance[off.index == off.worst] == off.spread.largest[3]


def test_at_the_points_only_rounding_is_left() -> None:
    tracking = track(load_robot("rv-m1"), line_path(START, END, 11))
    off = off_at_points(tracking)
    assert off.index.tolist() == list(range(11))
    assert off.spread is not None
    assert off.spread.largest.max() < 1e-14
    assert off.spread.largest[3] == tracking.max_deviation


def test_ways_over_missed_points_are_told_apart_and_begin_and_end_on_the_path() -> None:
    robot = load_robot("ur5e")
    tracking = track(robot, named_path("ellipse", robot))
    (way,) = ways_off_path(trajectory_of(tracking, robot.home), tracking)
    np.testing.assert_allclose(way[[0, -1]], tracking.path.points[[75, 146]], atol=1e-12)
    assert not ways_off_path(trajectory_of(track(robot, named_path("ellipse-moved", robot)), robot.home), tracking)
