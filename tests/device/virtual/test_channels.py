"""Group moves in virtual time: exact to a frame, all together; first moves and limp channels jump."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim.device.ssc32.commands import Move, ServoMove
from rvsim.device.virtual.channels import Channels
from rvsim.device.virtual.clock import FRAME_NS, NANO, frame_after

MILLI = NANO // 1000
PULSES = st.integers(500, 2500)


def moved(*servos: tuple[int, int, int | None], time_ms: int | None = None) -> Move:
    return Move(tuple(ServoMove(*servo) for servo in servos), time_ms)


def known(*pulses: int) -> Channels:
    """Channels 0, 1, … that hold these pulses; the last frame was at time 0."""
    channels = Channels()
    channels.start(moved(*((index, pulse, None) for index, pulse in enumerate(pulses))), -1)
    channels.frame(0)
    return channels


def ends(channels: Channels, start: int) -> dict[int, int]:
    """When each moving channel came to its end: at the first frame at which it no longer moves [ns]."""
    found: dict[int, int] = {}
    frame = start
    while channels.changing:
        frame = frame_after(frame)
        before = channels.states
        channels.frame(frame)
        found |= {i: frame for i in range(32) if before[i] == "moving" and channels.states[i] == "holding"}
    return found


@given(st.integers(0, FRAME_NS - 1), PULSES, PULSES)
def test_t700_takes_700_ms_within_a_frame_and_all_end_together(start: int, first: int, second: int) -> None:
    channels = known(1500, 1500)
    channels.start(moved((0, first, None), (1, second, None), time_ms=700), start)
    arrivals = set(ends(channels, start).values())
    assert len(arrivals) == 1
    assert 700 * MILLI <= arrivals.pop() - start < 700 * MILLI + FRAME_NS
    assert channels.commanded[:2].tolist() == [first, second]


@given(
    st.lists(st.tuples(PULSES, PULSES, st.none() | st.integers(500, 5000)), min_size=1, max_size=6),
    st.none() | st.integers(0, 3000),
)
def test_a_group_takes_the_longest_of_t_and_every_way_by_its_speed(
    servos: list[tuple[int, int, int | None]], time_ms: int | None
) -> None:
    channels = known(*(here for here, _, _ in servos))
    channels.start(moved(*((i, there, speed) for i, (_, there, speed) in enumerate(servos)), time_ms=time_ms), 1)
    seconds = max([(time_ms or 0) / 1000, *(abs(there - here) / speed for here, there, speed in servos if speed)])
    for end in ends(channels, 1).values():
        assert -1e-6 <= end / NANO - seconds <= 0.020 + 1e-6


def test_between_start_and_end_pulses_lie_on_a_line_whole_microseconds() -> None:
    channels = known(1000, 2000)
    channels.start(moved((0, 2000, None), (1, 1500, None), time_ms=1000), 0)
    for frame in range(1, 51):
        channels.frame(frame * FRAME_NS)
        assert channels.commanded[:2].tolist() == [1000 + 20 * frame, 2000 - 10 * frame]


def test_a_first_move_ignores_speed_and_time_and_is_not_waited_for() -> None:
    channels = known(1500)
    channels.start(moved((0, 1600, None), (9, 2000, 10), time_ms=400), 0)
    assert not channels.powered[9]
    channels.frame(FRAME_NS)
    assert channels.commanded[9] == 2000
    assert channels.states[9] == "holding"
    assert channels.states[0] == "moving"
    assert ends(channels, FRAME_NS) == {0: 400 * MILLI}


def test_a_limp_channel_jumps_at_once_and_has_no_say_in_the_time_of_its_group() -> None:
    channels = known(1500, 1500)
    channels.start(moved((1, 0, None)), 0)
    assert channels.states[1] == "limp"
    assert math.isnan(channels.pulses[1])
    channels.start(moved((0, 1600, 1000), (1, 2500, 10)), 0)
    channels.frame(FRAME_NS)
    assert channels.commanded[1] == 2500
    assert ends(channels, FRAME_NS) == {0: 100 * MILLI}


def test_stop_stops_one_servo_where_it_is_and_the_time_of_the_move_goes_on() -> None:
    channels = known(1000, 1000)
    channels.start(moved((0, 2000, None), (1, 2000, None), time_ms=1000), 0)
    for frame in range(1, 6):
        channels.frame(frame * FRAME_NS)
    channels.stop(0)
    assert channels.commanded[0] == 1100
    assert ends(channels, 5 * FRAME_NS) == {1: 1000 * MILLI}
    assert channels.commanded[:2].tolist() == [1100, 2000]
    channels.start(moved((1, 1000, None), time_ms=1000), 1000 * MILLI)
    channels.stop(1)
    assert not channels.changing
    assert channels.moving(1999 * MILLI)
    assert not channels.moving(2000 * MILLI)


def test_a_servo_that_goes_limp_is_waited_for_no_longer() -> None:
    channels = known(1000)
    channels.start(moved((0, 2000, None), time_ms=1000), 0)
    channels.start(moved((0, 0, None)), 1)
    assert not channels.moving(2)


def test_stop_before_a_first_move_has_begun_leaves_the_channel_without_a_pulse() -> None:
    channels = Channels()
    channels.start(moved((3, 1500, None)), 5)
    channels.stop(3)
    channels.frame(FRAME_NS)
    assert channels.states[3] == "unknown"
    assert not channels.powered.any()


def test_a_new_move_begins_where_the_old_one_is() -> None:
    channels = known(1000)
    channels.start(moved((0, 2000, None), time_ms=1000), 0)
    for frame in range(1, 26):
        channels.frame(frame * FRAME_NS)
    channels.start(moved((0, 1000, None), time_ms=500), 500 * MILLI)
    channels.frame(26 * FRAME_NS)
    assert channels.commanded[0] == 1480


def test_an_offset_is_on_the_pin_and_not_in_the_command() -> None:
    channels = known(1500)
    channels.offset([(0, 40), (1, -40)])
    assert channels.pulses[0] == 1540
    assert channels.commanded[0] == 1500
    assert np.isnan(channels.pulses[1])


@pytest.mark.parametrize("high", [True, False])
def test_a_pin_that_is_a_switch_has_no_pulses_until_it_is_a_servo_again(high: bool) -> None:
    channels = known(1500)
    channels.set_level(0, high)
    assert channels.levels == {0: high}
    assert channels.states[0] == "limp"
    channels.start(moved((0, 1500, None)), 0)
    channels.frame(FRAME_NS)
    assert channels.levels == {}
    assert channels.powered[0]
