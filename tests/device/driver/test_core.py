"""The driver in virtual time, in both languages: what moves, what does not, and what is said instead."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim.device.driver.actions import (
    Connect,
    Disconnect,
    Grip,
    Hold,
    JogPulse,
    Limp,
    MoveTo,
    Reset,
    Run,
    StopAll,
    Stream,
    UseServos,
    Wake,
)
from rvsim.motion import joint_move
from rvsim.robot.servos import pulses_of

LANGUAGES = pytest.mark.parametrize("language", ["ssc32", "bridge"])
BAUDS = pytest.mark.parametrize("baud", [9600, 38400, 115200])
AWAY = np.array([0.5, -0.4, -0.3, 0.2, 0.1])


@LANGUAGES
def test_connecting_moves_nothing_and_says_what_is_there(rig, language) -> None:
    arm = rig(language)
    before = arm.arm.true_q
    arm.connect()
    arm.run(5.0)
    assert arm.board.told == []
    assert np.isnan(arm.pulses).all()
    assert np.array_equal(arm.arm.true_q, before)
    assert arm.state.board
    assert arm.state.connected
    assert not any(arm.state.awake)


@LANGUAGES
def test_a_wake_moves_its_axis_and_no_other(rig, language) -> None:
    arm = rig(language)
    arm.connect()
    arm.done(Wake(2, arm.home[2]))
    arm.until("ready")
    assert arm.state.awake == (False, False, True, False, False)
    assert np.flatnonzero(np.isfinite(arm.pulses)).tolist() == [2]
    assert arm.state.commanded_q[2] == pytest.approx(arm.home[2], abs=2e-3)


def test_a_board_that_kept_its_power_is_woken_slowly(rig) -> None:
    arm = rig().ready()
    arm.done(Disconnect())
    arm.connect()
    assert not any(arm.state.awake)
    assert arm.state.measured_q == pytest.approx(arm.home, abs=0.02)
    arm.done(Wake(0, arm.home[0] + 0.5))
    arm.run(0.3)
    assert arm.pulses[0] < pulses_of(arm.robot.servos, arm.home + 0.5)[0] - 100.0
    arm.until("ready")


@pytest.mark.parametrize(
    ("action", "words"),
    [
        (Wake(9, 0.0), "no joint 9"),
        (Wake(0, 0.1), "awake already"),
        (MoveTo([0.0, 1.0]), "5 joints"),
        (MoveTo([0.0, 1.0, "a", 0.0, 0.0]), "no list of numbers"),
        (MoveTo([0.0, 1.0, np.nan, 0.0, 0.0]), "none, or infinite"),
        (MoveTo([0.0, 1.5, -2.9, 0.0, 0.0]), "elbow would be at −166.2°"),
        (MoveTo([0.0, 1.5, -1.5, 0.0, 0.0], -1.0), "from 0 to 60 s"),
        (Stream([np.inf] * 5), "none, or infinite"),
        (Grip(1.5), "from 0 (closed) to 1 (open)"),
        (JogPulse(17, 1500.0), "channels are 0, 1, 2, 3, 5, 4"),
        (JogPulse(0, np.nan), "no number"),
        (Limp("thumb"), "no joint 'thumb'"),
        (Connect(), "connected already"),
        (Reset(), "Nothing is stopped"),
    ],
)
def test_what_is_wrong_is_refused_with_its_reason(rig, action, words) -> None:
    arm = rig().ready()
    told = len(arm.board.told)
    assert words in arm.do(action).sentence
    arm.run(0.5)
    assert len(arm.board.told) == told


@pytest.mark.parametrize("action", [MoveTo(np.zeros(5)), Stream(np.zeros(5)), Grip(0.5), JogPulse(0, 1500.0)])
def test_nothing_moves_while_its_axis_sleeps(rig, action) -> None:
    arm = rig()
    assert "Connect first" in arm.do(action).sentence
    arm.connect()
    assert "asleep" in arm.do(action).sentence
    arm.run(1.0)
    assert arm.board.told == []


class Hurried:
    """A trajectory in a fiftieth of its time."""

    def __init__(self, trajectory) -> None:
        self.duration, self._trajectory = trajectory.duration / 50.0, trajectory

    def q(self, t):
        return self._trajectory.q(50.0 * np.asarray(t))


def test_a_plan_beyond_a_limit_is_refused_with_joint_time_value_and_limit(rig) -> None:
    arm = rig().ready()
    beyond = joint_move(arm.robot, arm.home, arm.home + np.array([0.0, 0.0, -1.4, 0.0, 0.0]), seconds=4.0)
    sentence = arm.do(Run(beyond)).sentence
    assert sentence.startswith("elbow would be at −161.")
    assert "after 2.97 s" in sentence
    assert "allow −161.0° to −44.9°" in sentence
    hasty = joint_move(arm.robot, arm.home, arm.home + AWAY, seconds=4.0)
    assert "it can do 210.0°/s" in arm.do(Run(Hurried(hasty))).sentence
    elsewhere = joint_move(arm.robot, arm.home + AWAY, arm.home, seconds=2.0)
    assert "Go to its start first" in arm.do(Run(elsewhere)).sentence
    assert arm.state.phase == "ready"


@LANGUAGES
@BAUDS
def test_a_trajectory_is_followed_within_quantisation_and_one_set_point(rig, language, baud) -> None:
    arm = rig(language, baud).ready()
    trajectory = joint_move(arm.robot, arm.home, arm.home + AWAY, seconds=3.0)
    arm.done(Run(trajectory))
    start, servos = arm.now, arm.arm.servos if language == "bridge" else arm.robot.servos
    quickest = np.abs(trajectory.at(np.linspace(0.0, 3.0, 100)).qd).max(axis=0)
    allowed = [servo.us_per_rad for servo in servos] * (quickest * (arm.core.period + 0.03)) + 2.0
    while arm.state.phase == "running":
        arm.step()
        away = arm.pulses[:5] - pulses_of(servos, trajectory.q(arm.now - start))
        assert (np.abs(away) <= allowed).all()
    assert arm.now - start == pytest.approx(3.0, abs=2 * arm.core.period)
    assert arm.state.commanded_q == pytest.approx(arm.home + AWAY, abs=2e-3)
    recording = arm.core.recording
    assert recording.joint_errors("commanded").max.max() < 0.01
    assert np.isfinite(recording.joint_errors().rms).all()


def test_an_approach_goes_to_the_start_first(rig) -> None:
    arm = rig().ready()
    trajectory = joint_move(arm.robot, arm.home + AWAY, arm.home, seconds=2.0)
    arm.done(Run(trajectory, approach=True))
    arm.run(0.3)
    assert arm.state.time == 0.0
    arm.until("ready")
    assert arm.core.recording.joint_errors("commanded").max.max() < 0.02


@LANGUAGES
def test_of_streamed_poses_one_is_under_way_and_the_newest_wins(rig, language) -> None:
    arm = rig(language).ready()
    told, sent = len(arm.board.told), len(arm.sent)
    for count in range(300):
        arm.done(Stream(arm.home + 0.1 * np.sin(0.05 * count)))
        arm.run(0.016)
        assert arm.wire.out_waiting <= arm.baud / 10 * 0.021
    assert len(arm.sent) - sent <= 300 * 0.016 * arm.baud / 10 + 64
    assert len(arm.board.told) - told <= 300 * 0.016 / arm.core.period + 1
    assert arm.state.dropped_setpoints > 100
    last = arm.home + np.array([0.3, -0.2, 0.1, 0.0, -0.1])
    arm.done(Stream(last))
    arm.until("ready")
    assert arm.state.commanded_q == pytest.approx(last, abs=2e-3)


def test_streaming_is_held_at_the_limits_and_says_so(rig) -> None:
    arm = rig().ready()
    arm.done(Stream(arm.home + np.array([0.0, 0.0, 2.0, 0.0, 0.0])))
    arm.run(3.0)
    assert arm.state.clamped == ("elbow",)
    assert arm.pulses[2] <= arm.robot.servos[2].max_us
    assert np.nanmax(arm.state.commanded_q - arm.core.limits[:, 1]) <= 0.0


def test_a_far_pose_is_streamed_no_quicker_than_calmly(rig) -> None:
    arm = rig(baud=115200).ready()
    arm.done(Stream(arm.home + np.array([1.4, 0.0, 0.0, 0.0, 0.0])))
    before = arm.pulses[0]
    for _ in range(50):
        arm.run(0.02)
        calm = 0.5 * arm.robot.joints[0].max_speed.value * arm.robot.servos[0].us_per_rad
        assert arm.pulses[0] - before <= 0.04 * calm + 2.0
        before = arm.pulses[0]


def test_hold_ends_a_move_where_it_is(rig) -> None:
    arm = rig().ready()
    arm.done(MoveTo(arm.home + AWAY, 4.0))
    arm.run(2.0)
    arm.done(Hold())
    arm.until("ready")
    held = arm.pulses.copy()
    arm.run(3.0)
    assert np.array_equal(arm.pulses, held)
    assert arm.state.commanded_q[0] == pytest.approx(arm.home[0] + 0.25, abs=0.05)


@pytest.mark.parametrize(("seconds", "least"), [(2.0, 2.0), (0.0, 0.136), (None, 0.4)])
def test_a_timed_move_takes_its_time_but_is_never_quicker_than_the_joints(rig, seconds, least) -> None:
    arm = rig(baud=115200).ready()
    start = arm.now
    arm.done(MoveTo(arm.home + AWAY, seconds))
    arm.until("ready")
    assert least <= arm.now - start <= least + 0.1


def test_a_limp_axis_is_asleep_and_ends_what_was_under_way(rig) -> None:
    arm = rig().ready()
    arm.done(Run(joint_move(arm.robot, arm.home, arm.home + AWAY, seconds=5.0)))
    arm.run(1.0)
    arm.done(Limp(1))
    arm.until("ready")
    arm.run(1.0)
    assert np.isnan(arm.pulses[1])
    assert arm.state.awake == (True, False, True, True, True)
    assert "shoulder is asleep" in arm.do(Stream(arm.home)).sentence


def test_another_calibration_changes_the_meaning_and_no_pulse(rig) -> None:
    from dataclasses import replace

    arm = rig().ready()
    before = arm.pulses.copy()
    servos = [replace(servo, zero_us=servo.zero_us + 50.0) for servo in arm.robot.servos]
    arm.done(UseServos(servos, arm.robot.gripper_servo))
    arm.run(1.0)
    assert np.array_equal(arm.pulses, before)
    assert arm.state.commanded_q[0] == pytest.approx(arm.home[0] - 50.0 / arm.robot.servos[0].us_per_rad)
    wrong = [replace(servo, min_us=500.0, max_us=501.0) for servo in servos]
    assert "Calibrate it again" in arm.do(UseServos(wrong)).sentence
    swapped = [
        replace(servos[0], channel=servos[1].channel),
        replace(servos[1], channel=servos[0].channel),
        *servos[2:],
    ]
    arm.done(UseServos(swapped, arm.robot.gripper_servo))
    assert not any(arm.state.awake)


def test_potentiometers_measure_what_pulses_only_claim(rig) -> None:
    arm = rig(potentiometers=True, baud=38400).ready()
    arm.done(UseServos(arm.arm.servos, arm.arm.gripper_servo))
    arm.run(2.0)
    assert arm.state.measured_kind == "potentiometers"
    assert arm.state.measured_q == pytest.approx(arm.arm.true_q, abs=0.02)


def test_everything_said_and_heard_is_logged_in_lines(rig) -> None:
    arm = rig().ready()
    arm.done(MoveTo(arm.home + AWAY))
    arm.run(0.05)
    arm.done(StopAll())
    arm.run(1.0)
    assert b"".join(data for _, way, data in arm.logged if way == "→") == bytes(arm.sent)
    assert sum(len(data) for _, way, data in arm.logged if way == "←") == arm.state.received_bytes
    assert all(data.count(b"\r") <= 1 for _, way, data in arm.logged if way == "→")
