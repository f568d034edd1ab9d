"""Every fault of a wire, a board and a supply: what the driver does then, and what it never does."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim.device.driver.actions import Connect, Disconnect, MoveTo, Reset, Run, Stream, Wake
from rvsim.device.virtual.faults import Fault, Faults
from rvsim.motion import joint_move

LANGUAGES = pytest.mark.parametrize("language", ["ssc32", "bridge"])
AWAY = np.array([0.5, -0.4, -0.3, 0.2, 0.1])


def switched(arm, *faults: Fault) -> None:
    arm.arm.faults = Faults(frozenset(faults))


def running(arm, seconds: float = 4.0):
    arm.ready()
    arm.done(Run(joint_move(arm.robot, arm.home, arm.home + AWAY, seconds=seconds)))
    arm.run(0.5)
    return arm


@LANGUAGES
@pytest.mark.parametrize(
    "fault",
    [Fault.SPLIT_REPLY, Fault.DUPLICATED_REPLY, Fault.STUCK_MOVING, Fault.QP_WITH_OFFSET, Fault.STALLED_SERVO,
     Fault.SAGGING_SERVO, Fault.FIRST_ANALOG],
)  # fmt: skip
def test_these_disturb_no_trajectory(rig, language, fault) -> None:
    arm = running(rig(language, potentiometers=language == "ssc32"))
    switched(arm, fault)
    arm.until("ready", 6.0)
    assert arm.state.commanded_q == pytest.approx(arm.home + AWAY, abs=2e-3)


@LANGUAGES
def test_late_answers_make_the_arm_wait_but_never_hurry(rig, language) -> None:
    arm = running(rig(language))
    switched(arm, Fault.LATE_REPLY)
    before, most, said = arm.pulses[0], 0.0, set()
    while arm.state.phase == "running":
        arm.run(0.02)
        said.add(arm.state.reason)
        before, most = arm.pulses[0], max(most, abs(arm.pulses[0] - before))
    quickest = 1.875 * 0.5 / 4.0 * arm.arm.servos[0].us_per_rad
    assert most <= quickest * (arm.core.period + 0.04) + 3.0
    assert arm.state.latency > 0.5
    assert "The controller answers late; the arm waits for it." in said


@LANGUAGES
def test_an_arm_that_follows_arrives_though_the_board_was_silent_for_a_while(rig, language) -> None:
    arm = rig(language).ready()
    far = arm.home + np.array([1.4, 0.0, 0.0, 0.0, 0.0])
    arm.done(Stream(far))
    arm.run(0.1)
    switched(arm, Fault.NO_REPLY)
    arm.run(1.0)
    switched(arm)
    arm.until("ready")
    assert arm.state.commanded_q == pytest.approx(far, abs=2e-3)


@LANGUAGES
def test_three_silent_questions_latch_the_stop_and_a_reset_needs_an_answer(rig, language) -> None:
    arm = running(rig(language), 10.0)
    switched(arm, Fault.NO_REPLY)
    arm.until("stopped", 1.5)
    assert "not answered three times" in arm.state.reason
    arm.run(1.0)
    held = arm.pulses.copy()
    assert "has not answered since" in arm.do(Reset()).sentence
    arm.run(2.0)
    assert np.array_equal(arm.pulses, held)
    switched(arm)
    arm.run(2.0)
    arm.done(Reset())
    assert arm.state.awake == (True,) * 5
    assert np.array_equal(arm.pulses, held)


@LANGUAGES
@pytest.mark.parametrize("what", ["run", "stream", "move"])
def test_a_brown_out_puts_everything_to_sleep_and_nothing_jumps_afterwards(rig, language, what) -> None:
    arm = rig(language).ready()
    target = joint_move(arm.robot, arm.home, arm.home + AWAY, seconds=4.0)
    arm.done({"run": Run(target), "stream": Stream(arm.home + AWAY), "move": MoveTo(arm.home + AWAY, 4.0)}[what])
    arm.run(0.5)
    switched(arm, Fault.BROWN_OUT)
    arm.run(3.0)
    assert arm.state.phase == "stopped"
    assert "forgotten" in arm.state.reason
    assert not any(arm.state.awake)
    assert np.isnan(arm.pulses).all()
    arm.done(Reset())
    assert arm.state.phase == "asleep"
    assert "asleep" in arm.do(MoveTo(arm.home)).sentence
    arm.done(Wake(0, arm.home[0]))
    arm.until("ready")
    assert np.flatnonzero(np.isfinite(arm.pulses)).tolist() == [0]


def test_a_brown_out_in_every_move_never_goes_unnoticed(rig) -> None:
    arm = rig().ready()
    switched(arm, Fault.BROWN_OUT_IN_MOVE)
    arm.done(MoveTo(arm.home + AWAY, 3.0))
    arm.until("stopped", 3.0)
    assert not any(arm.state.awake)


@LANGUAGES
def test_a_wrong_baud_is_no_connection_and_moves_nothing(rig, language) -> None:
    arm = rig(language, 38400, board_baud=9600)
    arm.done(Connect())
    arm.until("lost", 5.0)
    assert "baud" in arm.state.reason
    assert np.isnan(arm.pulses).all()


@LANGUAGES
@pytest.mark.parametrize("fault", [Fault.WRONG_BAUD, Fault.CORRUPTED_REPLY, Fault.SATURATED_BUFFER])
def test_nonsense_never_moves_what_sleeps_and_ends_stopped_or_well(rig, language, fault) -> None:
    arm = running(rig(language))
    switched(arm, fault)
    arm.run(8.0)
    assert arm.state.phase in ("ready", "stopped", "running")
    if arm.state.phase == "stopped":
        arm.run(1.0)
        held = arm.pulses.copy()
        arm.run(2.0)
        assert np.array_equal(arm.pulses, held, equal_nan=True)


@LANGUAGES
def test_a_lost_port_forgets_everything_and_connecting_again_wakes_nothing(rig, language) -> None:
    arm = running(rig(language))
    arm.core.lose("The plug is out.")
    assert (arm.state.phase, arm.state.reason) == ("lost", "The plug is out.")
    assert arm.core.process(arm.now + 1.0, b"\x96" * 40) == b""
    assert "Connect again" in arm.do(MoveTo(arm.home)).sentence
    arm.wire.process(0.1)  # what was on the wire arrives
    told = len(arm.board.told)
    arm.connect()
    arm.run(2.0)
    assert not any(arm.state.awake)
    assert len(arm.board.told) == told


def test_a_board_that_does_otherwise_is_stopped(rig) -> None:
    arm = rig().ready()
    arm.arm.write(b"#0P2200T500\r")  # another program
    arm.until("stopped", 3.0)
    assert "base should be at 0.0°" in arm.state.reason


def test_a_bridge_that_has_stopped_by_itself_is_believed(rig) -> None:
    from rvsim.device.bridge.messages import Stop, encode

    arm = running(rig("bridge"))
    arm.arm.write(encode(Stop(), 0))
    arm.until("stopped", 1.0)
    assert "latched a stop" in arm.state.reason
    arm.run(0.5)
    arm.done(Reset())
    arm.run(0.5)
    assert arm.state.phase == "ready"


def test_a_disconnected_arm_is_stopped_first(rig) -> None:
    arm = running(rig())
    arm.done(Disconnect())
    arm.run(1.0)
    held = arm.pulses.copy()
    arm.run(3.0)
    assert np.array_equal(arm.pulses, held)
    assert arm.state.phase == "disconnected"
