"""The 32 channels of a servo controller: what each is doing, and moves that start and end together.

Moves are linear, in frames of 20 ms, without acceleration. A channel whose pulse nobody knows, or that is limp, jumps
at the next frame whatever time is asked for, and has no say in the time of its group. Sources: Lynxmotion, "SSC-32 User
Guide" (group moves, STOP, first move), and drivers written against the board.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from rvsim.device.ssc32.commands import Move, ServoMove
from rvsim.device.virtual.clock import NANO
from rvsim.device.virtual.contract import BoolArray, ChannelState
from rvsim.robot.arrays import FloatArray
from rvsim.robot.servo import CHANNELS, LONGEST_US, SHORTEST_US


class Course(NamedTuple):
    """One channel under way: pulses [µs] and times [ns] of its start and end."""

    start_us: int
    end_us: int
    begins: int
    ends: int

    def pulse(self, now: int) -> int:
        """The whole pulse [µs] at a time from `begins` on."""
        if now >= self.ends:
            return self.end_us
        way = (self.end_us - self.start_us) * (now - self.begins)
        return self.start_us + round(way / (self.ends - self.begins))


class Channels:
    """Pulses as they change from frame to frame; times are the board's [ns]."""

    def __init__(self) -> None:
        self._pulses = np.full(CHANNELS, np.nan)
        self._offsets = np.zeros(CHANNELS)
        self._courses: dict[int, Course] = {}
        self._limp: set[int] = set()
        self._promised: dict[int, int] = {}  # when the move of a channel should end, stopped on its way or not
        self.levels: dict[int, bool] = {}  # pins that are switches and no servos

    @property
    def commanded(self) -> FloatArray:
        """(32,) the pulses as asked for [µs], without offsets; NaN where there is none."""
        return self._pulses.copy()

    @property
    def pulses(self) -> FloatArray:
        """(32,) the pulses on the pins [µs], offsets included; NaN where there is none."""
        return self._pulses + self._offsets

    @property
    def offsets(self) -> FloatArray:
        """(32,) [µs]."""
        return self._offsets.copy()

    @property
    def powered(self) -> BoolArray:
        """(32,) which pins have pulses."""
        return np.asarray(np.isfinite(self._pulses))

    @property
    def states(self) -> tuple[ChannelState, ...]:
        """(32) what each is doing."""
        return tuple(map(self._state, range(CHANNELS)))

    @property
    def changing(self) -> bool:
        """Whether some pulse will change by itself."""
        return bool(self._courses)

    def moving(self, now: int) -> bool:
        """What Q asks: also true of stopped channels until the time has passed that their move should have taken."""
        return self.changing or any(end > now for end in self._promised.values())

    def frame(self, now: int) -> None:
        """The pulses of the frame at this time."""
        for channel, course in list(self._courses.items()):
            self._pulses[channel] = course.pulse(now)
            if now >= course.ends:
                del self._courses[channel]
        if not self._courses and not self.moving(now):
            self._promised.clear()

    def start(self, move: Move, now: int) -> None:
        """A move; its limp channels go limp at once, the others run together from now on."""
        for servo in move.servos:
            if servo.pulse_us == 0:
                self.release(servo.channel)
        aims = {servo.channel: servo for servo in move.servos if servo.pulse_us}
        duration = max((self._least_time(servo) for servo in aims.values()), default=0)
        if any(np.isfinite(self._pulses[channel]) for channel in aims):
            duration = max(duration, (move.time_ms or 0) * (NANO // 1000))
        for channel, servo in aims.items():
            self._begin(channel, servo.pulse_us, now, duration)

    def stop(self, channel: int) -> None:
        """The channel stays at the pulse it has; what was promised of its time stays so."""
        self._courses.pop(channel, None)

    def release(self, channel: int) -> None:
        """No more pulses: the servo is limp."""
        self._courses.pop(channel, None)
        self._promised.pop(channel, None)
        self._pulses[channel] = np.nan
        self._limp.add(channel)

    def set_level(self, channel: int, high: bool) -> None:
        """The pin becomes a switch."""
        self.release(channel)
        self.levels[channel] = high

    def offset(self, offsets: Iterable[tuple[int, int]]) -> None:
        """(channel, µs) pairs that are added to the pulses on the pins."""
        for channel, value in offsets:
            self._offsets[channel] = value

    def _state(self, channel: int) -> ChannelState:
        if channel in self._courses:
            return "moving"
        if np.isfinite(self._pulses[channel]):
            return "holding"
        return "limp" if channel in self._limp else "unknown"

    def _least_time(self, servo: ServoMove) -> int:
        """|Δ|/S [ns] of a channel whose pulse is known; else it has no say."""
        here = self._pulses[servo.channel]
        if not servo.speed or not np.isfinite(here):
            return 0
        return abs(_held(servo.pulse_us) - int(here)) * NANO // servo.speed

    def _begin(self, channel: int, pulse_us: int, now: int, duration: int) -> None:
        here, end = self._pulses[channel], _held(pulse_us)
        known = bool(np.isfinite(here))
        ends = now + duration if known else now
        self._courses[channel] = Course(int(here) if known else end, end, now, ends)
        self._promised[channel] = ends
        self._limp.discard(channel)
        self.levels.pop(channel, None)


def _held(pulse_us: int) -> int:
    return min(max(pulse_us, int(SHORTEST_US)), int(LONGEST_US))
