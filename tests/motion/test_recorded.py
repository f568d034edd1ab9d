"""Recorded poses are passed exactly, at their times where they have some, and the arm goes to the first one itself."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim import load_robot
from rvsim.errors import ShapeError
from rvsim.motion import joint_move
from rvsim.motion.recorded import motion_through


def test_a_motion_is_the_same_when_it_is_recorded_and_played_again() -> None:
    robot = load_robot("ur5e")
    first = joint_move(robot, robot.home, robot.home + 0.4, seconds=3.0)
    times = np.linspace(0.0, 3.0, 200)
    again = motion_through(robot, robot.home + 0.1, first.q(times), times)
    between = np.linspace(0.0, 3.0, 77)
    np.testing.assert_allclose(again.q(again.path_start + between), first.q(between), atol=1e-7)
    np.testing.assert_allclose(again.at(again.path_start + between).qd, first.at(between).qd, atol=1e-4)
    np.testing.assert_array_equal(again.q(0.0), robot.home + 0.1)


def test_without_times_every_pose_is_passed_within_the_speeds() -> None:
    robot = load_robot("rv-m1")
    rng = np.random.default_rng(3)
    poses = robot.home + np.cumsum(rng.uniform(-0.1, 0.1, (8, robot.dof)), axis=0)
    motion = motion_through(robot, robot.home, poses)
    times = np.linspace(0.0, motion.duration, 20_001)
    seen = motion.at(times)
    limits = [joint.max_speed.value for joint in robot.joints]
    assert np.all(np.abs(seen.qd) <= np.array(limits) * 1.001)
    for pose in poses:
        assert np.abs(seen.q - pose).max(axis=1).min() < 1e-3


def test_what_does_not_fit_is_refused() -> None:
    robot = load_robot("planar")
    poses = np.zeros((2, robot.dof))
    for q, times in ((np.empty((0, robot.dof)), None), (poses, [0.0, 0.0]), (poses, [1.0])):
        with pytest.raises(ShapeError):
            motion_through(robot, robot.home, q, times)
    assert motion_through(robot, robot.home, poses[:1]).duration > 0.0
