"""The emergency stop: first, at once, for good, and until somebody resets it."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim.device.driver.actions import Grip, JogPulse, Limp, MoveTo, Reset, Run, StopAll, Stream, Wake
from rvsim.motion import joint_move

LANGUAGES = pytest.mark.parametrize("language", ["ssc32", "bridge"])
BAUDS = pytest.mark.parametrize("baud", [9600, 38400, 115200])
AWAY = np.array([0.5, -0.4, -0.3, 0.2, 0.1])


def started(arm):
    arm.ready()
    arm.done(Run(joint_move(arm.robot, arm.home, arm.home + AWAY, seconds=4.0)))
    return arm


@LANGUAGES
@BAUDS
@pytest.mark.parametrize("moment", [1.0, 1.012, 1.024, 1.036, 1.048])
def test_no_byte_goes_before_the_stop_wherever_a_line_is_cut(rig, language, baud, moment) -> None:
    arm = started(rig(language, baud))
    arm.run(moment)
    told, sent, byte = len(arm.board.told), len(arm.board.bytes), 10.0 / baud
    arm.done(StopAll("test"))
    pressed = arm.now
    arm.run(1.0)
    after = arm.board.bytes[sent:]
    first = 0x7E if language == "bridge" else 0x1B
    # The byte that was under way cannot be called back.
    assert [value for _, value in after].index(first) <= 1
    assert after[0][0] - pressed <= 2.1 * byte
    stopped = [entry for entry in arm.board.told[told:] if entry.stops]
    assert not [entry for entry in arm.board.told[told:] if entry.moves or entry.limp]
    used = set(arm.channels) if language == "ssc32" else set(range(32))
    seen, last = set(), 0.0
    for entry in stopped:
        if not used <= seen:
            seen, last = seen | entry.stops, entry.time
    assert last - pressed <= 0.004 + (2 + (6 * 6 + 1 if language == "ssc32" else 6)) * byte
    assert {channel for entry in stopped for channel in entry.stops} == set(range(32))


@LANGUAGES
@BAUDS
def test_a_stopped_arm_stays_and_takes_nothing_until_the_reset(rig, language, baud) -> None:
    arm = started(rig(language, baud))
    arm.run(1.5)
    arm.done(StopAll("the cat"))
    arm.run(0.5)
    held, told = arm.pulses.copy(), len(arm.board.told)
    for action in (MoveTo(arm.home), Stream(arm.home), Grip(0.2), Wake(0, 0.0), Limp(0), JogPulse(0, 1500.0)):
        assert arm.do(action) is not None
    arm.run(3.0)
    assert (arm.state.phase, arm.state.reason) == ("stopped", "the cat")
    assert np.array_equal(arm.pulses, held)
    assert not any(entry.moves for entry in arm.board.told[told:])
    arm.done(Reset())
    arm.run(1.0)
    assert arm.state.phase == "ready"
    assert np.array_equal(arm.pulses, held)
    arm.done(MoveTo(arm.home))
    arm.until("ready")
    assert arm.state.commanded_q == pytest.approx(arm.home, abs=2e-3)


@LANGUAGES
def test_the_driver_knows_where_a_stop_has_left_the_arm(rig, language) -> None:
    arm = started(rig(language))
    arm.run(2.0)
    arm.done(StopAll())
    arm.run(1.0)
    raw = arm.core._language.raw(arm.core._language.values(arm.core._belief.at(arm.now)))
    if language == "ssc32":
        assert raw == pytest.approx(arm.pulses, abs=10.0)
    arm.done(Reset())
    arm.done(MoveTo(arm.state.commanded_q))
    before = arm.arm.true_q
    arm.until("ready")
    assert arm.arm.true_q == pytest.approx(before, abs=0.03)


def test_a_stop_that_got_lost_is_said_again(rig) -> None:
    arm = rig(baud=115200).ready()
    arm.done(MoveTo(arm.home + AWAY, 5.0))
    arm.run(0.5)
    arm.done(StopAll())
    arm.board.deaf = True  # noise swallows it
    arm.run(0.06)
    arm.board.deaf = False
    assert not any(entry.stops for entry in arm.board.told)
    arm.run(0.8)
    held = arm.pulses.copy()
    arm.run(1.0)
    assert np.array_equal(arm.pulses, held)


@LANGUAGES
def test_an_arm_whose_power_was_cut_after_the_stop_is_asleep(rig, language) -> None:
    arm = rig(language).ready()
    arm.done(StopAll())
    arm.run(1.0)
    arm.arm.power_cycle()
    arm.run(1.0)
    told = len(arm.board.told)
    arm.done(Reset())
    assert "asleep" in arm.do(MoveTo(arm.home + AWAY)).sentence
    arm.run(1.0)
    assert not any(entry.moves for entry in arm.board.told[told:])
    assert arm.state.phase == "asleep"


def test_a_second_stop_keeps_the_first_reason_and_is_said_too(rig) -> None:
    arm = started(rig())
    arm.run(0.5)
    arm.done(StopAll("first"))
    arm.run(0.5)
    told = len(arm.board.told)
    arm.done(StopAll("second"))
    arm.run(0.5)
    assert len(arm.board.told) > told
    assert arm.state.reason == "first"


def test_there_is_nothing_to_stop_without_a_port(rig) -> None:
    assert "Connect first" in rig().do(StopAll()).sentence
