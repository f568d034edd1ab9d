"""Where joints are marked: within reach, far apart, clear of the table; and what one sees there."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rvsim.device.calibration.marks import MOST_UNCOVERED, mark_plan, usual_range
from rvsim.device.calibration.words import number_words, pose_words
from rvsim.files import load_robot
from rvsim.kinematics.clearance import clearance

ROBOT = load_robot("al5b")


@pytest.mark.parametrize("joint", range(5))
def test_the_arm_is_clear_of_the_table_from_mark_to_mark(joint: int) -> None:
    plan = mark_plan(ROBOT, joint, *usual_range(ROBOT, joint))
    poses = np.linspace(plan.postures[0], plan.postures[1], 21)
    room = clearance(ROBOT, poses)
    assert room.table.min() > 0.01
    assert room.own.min() > 0.0
    assert plan.postures[0][joint] == plan.values[0]
    assert np.count_nonzero(plan.postures[0] != plan.postures[1]) == 1


@given(st.integers(0, 4), st.floats(-150.0, 0.0), st.floats(25.0, 200.0))
@settings(max_examples=15)
def test_marks_cover_the_range_so_that_reading_errors_stay_small(joint: int, lower: float, width: float) -> None:
    low, high = math.radians(lower), math.radians(lower + width)
    first, second = mark_plan(ROBOT, joint, low, high).values
    assert low - 1e-9 <= first < second <= high + 1e-9
    assert max(first - low, high - second) <= MOST_UNCOVERED * (second - first) + 1e-9


@pytest.mark.parametrize(
    ("joint", "degrees", "words"),
    [
        (0, (0, 90, -90, 0, 0), "the arm points straight ahead, along the x axis of the base"),
        (0, (90, 90, -90, 0, 0), "the arm points to the left, at a right angle to straight ahead"),
        (0, (-30, 90, -90, 0, 0), "the arm points 30° to the right of straight ahead"),
        (1, (0, 90, -90, 0, 0), "the upper arm stands straight up"),
        (1, (40, 0, -90, 0, 0), "the upper arm lies level, pointing forward"),
        (1, (90, 180, -90, 0, 0), "the upper arm lies level, pointing backward"),
        (1, (0, 135, -90, 0, 0), "the upper arm points backward, 45° above the level"),
        (2, (0, 90, -90, 0, 0), "the forearm is at a right angle to the upper arm, bent forward"),
        (2, (0, 90, 0, 0, 0), "the forearm is in line with the upper arm"),
        (2, (0, 0, -45, 0, 0), "the forearm is bent 45° downward from the line of the upper arm"),
        (3, (0, 90, -90, 90, 0), "the hand is at a right angle to the forearm, bent upward"),
        (3, (70, 90, -90, -60, 0), "the hand is bent 60° downward from the line of the forearm"),
        (4, (0, 90, -90, 0, 0), "the hand is not turned: its two fingers are side by side, level"),
        (
            4,
            (0, 90, -90, 0, 60),
            "the hand is turned 60° clockwise from the pose with its fingers side by side, seen from the arm",
        ),
    ],
)
def test_poses_in_words(joint: int, degrees: tuple[float, ...], words: str) -> None:
    assert pose_words(ROBOT, joint, np.radians(degrees)).startswith(words)


@pytest.mark.parametrize("name", ["rv-m1", "ur5e", "scara", "cartesian", "rrrp"])
def test_there_are_words_for_every_joint_of_any_arm(name: str) -> None:
    robot = load_robot(name)
    for joint in range(robot.dof):
        assert len(pose_words(robot, joint, robot.home)) > 10
    assert number_words(robot, 0, 0.0) in ("0°", "0 mm")
