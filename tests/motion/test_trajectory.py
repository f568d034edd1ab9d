"""Trajectories: the arm never jumps, waits where it must, passes every reached point, and heeds its joints' speeds."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rvsim import forward_kinematics, load_robot
from rvsim.lab import named_path
from rvsim.motion import Path, Tracking, Trajectory, joint_move, through_points, track, trajectory_of
from rvsim.motion.laws import quintic_between
from rvsim.motion.trajectory import Law, Stretch, accelerations, speeds

CASES = [
    ("rv-m1", "letter-board"),
    ("rv-m1", "letter-scaled"),
    ("ur5e", "ellipse"),
    ("rrrp", "spiral"),
    ("scara", "star"),
]


def tracked(robot: str, path: str) -> Tracking:
    arm = load_robot(robot)
    return track(arm, named_path(path, arm))


def played(robot: str, path: str) -> tuple[Tracking, Trajectory]:
    tracking = tracked(robot, path)
    trajectory = trajectory_of(tracking, tracking.robot.home)
    assert trajectory is not None
    return tracking, trajectory


@pytest.mark.parametrize(("robot", "path"), CASES)
def test_no_joint_jumps_or_exceeds_its_speed(robot: str, path: str) -> None:
    tracking, trajectory = played(robot, path)
    times = np.linspace(0.0, trajectory.duration, 4001)
    speeds = np.abs(np.diff(trajectory.q(times), axis=0)) / np.diff(times)[:, None]
    fastest = [joint.max_speed.value for joint in tracking.robot.joints if joint.max_speed is not None]
    assert len(fastest) == tracking.robot.dof
    assert np.all(speeds <= np.array(fastest) * (1.0 + 1e-9))


@pytest.mark.parametrize(("robot", "path"), CASES)
@pytest.mark.parametrize("law", ["quintic", "cubic", "trapezoid", "quickest"])
def test_speeds_and_accelerations_are_derivatives_and_within_the_limits(robot: str, path: str, law: Law) -> None:
    tracking = tracked(robot, path)
    trajectory = trajectory_of(tracking, tracking.robot.home, law=law)
    assert trajectory is not None
    times = np.linspace(0.0, trajectory.duration, 2003)
    moments = trajectory.at(times)
    assert np.all(np.abs(moments.qdd) <= accelerations(tracking.robot) * 1.001)
    inside = np.abs(times[:, None] - trajectory.starts).min(axis=1) > 2e-4  # not across the border of two stretches
    before, after = trajectory.at(times[inside] - 1e-4), trajectory.at(times[inside] + 1e-4)
    speeds = (after.q - before.q) / 2e-4
    assert np.allclose(speeds, moments.qd[inside], atol=2e-3)


LAWS: tuple[Law, ...] = ("quintic", "cubic", "trapezoid", "quickest")


@given(
    arm=st.sampled_from(["rv-m1", "ur5e", "al5b"]),
    shares=st.lists(st.lists(st.floats(0.1, 0.9), min_size=6, max_size=6), min_size=4, max_size=7),
    law=st.sampled_from(LAWS),
    wish=st.floats(0.0, 6.0),
)
@settings(max_examples=40)
def test_a_path_that_is_eased_exceeds_no_limit_and_is_no_slower_than_one_slowed_down_as_a_whole(
    arm: str, shares: list[list[float]], law: Law, wish: float
) -> None:
    robot = load_robot(arm)
    low, high = np.maximum(robot.limits[:, 0], -2.0), np.minimum(robot.limits[:, 1], 2.0)
    q = low + np.array(shares)[:, : robot.dof] * (high - low)
    points = forward_kinematics(robot, q)[:, :3, 3]
    tracking = Tracking(robot, Path("via", points, None), q, ())
    whole, local = (trajectory_of(tracking, q[0], path_seconds=wish, law=law, ease=ease) for ease in (False, True))
    assert whole is not None
    assert local is not None
    assert local.duration <= whole.duration * (1.0 + 1e-9)
    assert local.duration >= wish * (1.0 - 1e-9)
    for motion in (whole, local):
        moments = motion.at(np.linspace(0.0, motion.duration, 20_011))
        assert np.all(np.abs(moments.qd) <= speeds(robot) * (1.0 + 1e-6))
        assert np.all(np.abs(moments.qdd) <= accelerations(robot) * (1.0 + 1e-6))
        np.testing.assert_allclose(motion.q(motion.duration), q[-1], atol=1e-12)


def test_easing_changes_the_law_only_where_a_joint_needs_it() -> None:
    tracking = tracked("ur5e", "ellipse-moved")
    wished = 0.6 * _path_seconds(trajectory_of(tracking, tracking.robot.home, path_seconds=0.0))
    motion = trajectory_of(tracking, tracking.robot.home, path_seconds=wished, ease=True)
    assert motion is not None
    (stretch,) = [stretch for stretch in motion.stretches if stretch.eased]
    fractions = np.linspace(0.0, 1.0, 2001)
    law, done = stretch.law, np.linspace(0.01, 0.99, 99)
    wanted = quintic_between(0.0, 1.0, 0.0, 1.0)
    asked = np.interp(done, wanted.q(fractions)[:, 0], wanted.at(fractions).qd[:, 0] / stretch.wanted)
    had = np.interp(done, law.q(fractions)[:, 0], law.at(fractions).qd[:, 0] / stretch.duration)
    assert np.all(had <= asked * 1.01)
    assert np.mean(np.isclose(had, asked, rtol=0.01)) > 0.1


def _path_seconds(motion: Trajectory | None) -> float:
    assert motion is not None
    return motion.duration - motion.path_start


def test_the_tool_rests_at_the_corners_of_a_star() -> None:
    tracking, trajectory = played("scara", "star")
    assert len(tracking.path.corners) == 4  # and the fifth is where it begins and ends
    at_corner = [t for t in trajectory.starts[2:-1] if trajectory.path_index(t) in tracking.path.corners]
    assert len(at_corner) == 4
    assert np.abs(trajectory.at(at_corner).qd).max() < 1e-9


def test_a_smooth_path_has_no_corners_however_coarse() -> None:
    turn = np.linspace(0.0, 2.0 * np.pi, 12)
    circle = through_points(np.stack([np.cos(turn), np.sin(turn), 0.0 * turn], axis=1))
    assert not len(circle.corners)


@pytest.mark.parametrize(("robot", "path"), CASES)
def test_it_begins_where_the_arm_is_and_passes_every_reached_point_in_order(robot: str, path: str) -> None:
    tracking, trajectory = played(robot, path)
    assert np.array_equal(trajectory.q(0.0), tracking.robot.home)
    knots = np.concatenate([stretch.q for stretch in trajectory.stretches])
    progress = np.concatenate([stretch.progress for stretch in trajectory.stretches])
    for index in np.flatnonzero(tracking.reached):
        assert (knots[progress == index] == tracking.q[index]).all(axis=1).any()
    assert np.all(np.diff(progress) >= 0.0)
    assert progress[-1] == tracking.samples - 1
    assert trajectory.path_index(trajectory.duration) == tracking.samples - 1


def test_over_an_unreached_stretch_the_arm_waits_at_the_last_reached_point() -> None:
    tracking, trajectory = played("ur5e", "ellipse")
    times = np.linspace(0.0, trajectory.duration, 3001)
    on_path = [t for t in times if trajectory.phase(t) == "path"]
    gap = [t for t in on_path if 76.0 < trajectory.path_index(t) < 145.0]
    assert len(gap) > 100
    assert np.array_equal(trajectory.q(gap), np.tile(tracking.q[75], (len(gap), 1)))


def test_where_the_path_begins_unreached_the_arm_waits_at_its_first_reached_point() -> None:
    arm = load_robot("rv-m1")
    tracking = track(arm, named_path("line", arm, samples=11, start=(0.11, 0.0, 0.13), end=(0.23, 0.0, 0.333)))
    trajectory = trajectory_of(tracking, arm.home)
    assert trajectory is not None
    phases = [stretch.phase for stretch in trajectory.stretches]
    assert phases == ["approach", "path", "path", "path"]
    wait, _, rest = trajectory.stretches[1:]
    assert wait.progress.tolist() == [0.0, 6.0]
    assert np.array_equal(wait.q[0], tracking.q[6])
    assert rest.progress.tolist() == [9.0, 10.0]
    assert np.array_equal(trajectory.q(trajectory.duration), tracking.q[9])


def test_nothing_reached_is_no_trajectory() -> None:
    assert trajectory_of(tracked("rv-m1", "letter-raw"), np.zeros(5)) is None


def test_every_stretch_begins_and_ends_at_rest() -> None:
    _, trajectory = played("rv-m1", "letter-scaled")
    step = 1e-4
    for edge in trajectory.starts:
        change = trajectory.q(edge + step) - trajectory.q(edge - step)
        assert np.abs(change).max() < 1e-6


def test_time_is_clamped_and_a_wish_for_a_duration_is_heeded_where_the_joints_allow() -> None:
    tracking = tracked("rv-m1", "letter-board")
    slow = trajectory_of(tracking, tracking.robot.home, path_seconds=40.0, approach_seconds=5.0)
    fast = trajectory_of(tracking, tracking.robot.home, path_seconds=1e-3, approach_seconds=1e-3)
    assert slow is not None
    assert fast is not None
    assert slow.duration == pytest.approx(45.0)
    assert slow.path_start == 5.0
    assert 1.0 < fast.duration < 20.0
    assert np.array_equal(slow.q([-1.0, 99.0]), [tracking.robot.home, tracking.q[-1]])
    assert slow.phase(-1.0) == "approach"
    assert slow.path_index(99.0) == 49.0


def test_a_joint_move_goes_straight_in_joint_space_all_joints_together() -> None:
    arm = load_robot("rv-m1")
    q0, q1 = arm.home, np.radians([30.0, 40.0, -50.0, 20.0, 60.0])
    move = joint_move(arm, q0, q1)
    part = (move.q(np.linspace(0.0, move.duration, 50)) - q0) / (q1 - q0)
    assert np.allclose(part, part[:, :1], atol=1e-12)
    assert np.array_equal(move.q(move.duration), q1)
    assert np.allclose(move.q(move.duration / 2), (q0 + q1) / 2)
    assert joint_move(arm, q0, q0).duration > 0.0
    assert joint_move(arm, q0, q1, seconds=9.0).duration == 9.0


def test_stretches_must_meet() -> None:
    ends = [np.array([[0.0], [1.0]]), np.array([[2.0], [3.0]])]
    stretches = [Stretch(1.0, np.array([0.0, 1.0]), q, np.array([0.0, 1.0])) for q in ends]
    with pytest.raises(ValueError, match="must begin in the pose"):
        Trajectory(tuple(stretches))
    with pytest.raises(ValueError, match="at least 1"):
        Trajectory(())
