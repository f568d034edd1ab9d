"""How far the tool is off its path between the points: asked of the motion that the arm really makes."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim import load_robot
from rvsim.kinematics import forward_kinematics
from rvsim.motion import line_path, through_points, track, trajectory_of
from rvsim.motion.between import way_deviation

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
