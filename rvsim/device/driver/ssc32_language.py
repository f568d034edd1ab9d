"""The SSC-32 and SSC-32U as the driver speaks to them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np

from rvsim.device.driver.language import Event, Measured, Named, Reported
from rvsim.device.ssc32.commands import Move, Query, QueryPulses, QueryVersion, ReadAnalog, ServoMove, Stop
from rvsim.device.ssc32.host_side import encode
from rvsim.device.ssc32.lines import CR
from rvsim.device.ssc32.replies import ReplyDecoder
from rvsim.device.virtual.inputs import ANALOG, potentiometer_pulse
from rvsim.device.words import in_a_row
from rvsim.language import tr
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.robot.servo import CHANNELS, LONGEST_US, SHORTEST_US
from rvsim.robot.servos import joints_of, pulses_of, within_servos

ESC = b"\x1b"
_PO_US = 150.0  # old firmware reports up to 100 µs of offset; answers are steps of 10 µs


class Ssc32Language:
    """The SSC-32 and SSC-32U over their codec. What they report is what they send, never a measurement.

    Args:
        robot: with servos.
        potentiometers: joint i has a tap on the i-th of VA … VH, 0 V at 500 µs and 5 V at 2500 µs: these measure.
    """

    title = "SSC-32"
    named_answers = gentle = False

    def __init__(self, robot: Robot, *, potentiometers: bool = False) -> None:
        self._channels: tuple[int, ...] = ()
        self.use(robot)
        self._replies = ReplyDecoder()
        self._taps = min(robot.dof, ANALOG) if potentiometers else 0
        self._analog_turn = self._analog_valid = False

    def use(self, robot: Robot) -> bool:
        """Another calibration; whether the channels are the same.

        Raises:
            RobotDefinitionError: a joint has no value that both arm and servo allow.
        """
        limits = [tuple(pair) for pair in within_servos(robot).limits]
        before = self._channels
        self._servos, self._gripper = robot.servos, robot.gripper_servo
        channels = [servo.channel for servo in robot.servos]
        ends = [(math.ceil(servo.min_us), math.floor(servo.max_us)) for servo in robot.servos]
        if self._gripper is not None:
            pulses = sorted((self._gripper.open_us, self._gripper.closed_us))
            channels.append(self._gripper.channel)
            ends.append((math.ceil(pulses[0]), math.floor(pulses[1])))
            limits.append((0.0, 1.0))
        self._channels, self._limits = tuple(channels), np.array(limits)
        self._least, self._most = np.array(ends, dtype=np.float64).T
        return before == self._channels

    @property
    def axes(self) -> int:
        """m."""
        return len(self._channels)

    @property
    def channels(self) -> tuple[int, ...]:
        """One an axis."""
        return self._channels

    @property
    def limits(self) -> FloatArray:
        """(m, 2)."""
        return self._limits

    @property
    def set_point_bytes(self) -> int:
        """`#0P1500` a joint, `T100` and CR."""
        return sum(len(f"#{channel}P1500") for channel in self._channels[: len(self._servos)]) + len("T100\r")

    @property
    def question_bytes(self) -> int:
        """`QP0` a channel and CR."""
        return sum(len(f"QP{channel}") for channel in self._channels) + 1

    @property
    def tolerance(self) -> FloatArray:
        """(m,) [µs]."""
        return np.full(self.axes, _PO_US)

    def raw(self, values: FloatArray) -> FloatArray:
        """(m,) whole µs within each servo's limits."""
        pulses = np.full(self.axes, np.nan)
        n = len(self._servos)
        pulses[:n] = pulses_of(self._servos, values[:n])
        if self._gripper is not None and not math.isnan(values[n]):
            pulses[n] = self._gripper.pulse(float(values[n]))
        return np.clip(np.round(pulses), self._least, self._most)

    def values(self, raw: FloatArray) -> FloatArray:
        """(m,) q, and the opening."""
        values = np.full(self.axes, np.nan)
        n = len(self._servos)
        values[:n] = joints_of(self._servos, raw[:n])
        if self._gripper is not None and not math.isnan(raw[n]):
            values[n] = self._gripper.opening(float(raw[n]))
        return values

    def jogged(self, channel: int, pulse_us: float) -> tuple[int, float] | str:
        """The axis, and the pulse held within what the controller can."""
        if channel not in self._channels:
            known = in_a_row(map(str, self._channels))
            return tr(
                "No joint hangs on channel {channel}; the arm's channels are {known}.", channel=channel, known=known
            )
        return self._channels.index(channel), float(np.clip(round(pulse_us), SHORTEST_US, LONGEST_US))

    def set_points(self, raw: FloatArray, seconds: float) -> bytes:
        """`#0P1500#1P1600T60`."""
        named = ((channel, pulse) for channel, pulse in zip(self._channels, raw, strict=True) if not math.isnan(pulse))
        servos = tuple(ServoMove(channel, round(pulse)) for channel, pulse in named)
        return encode(Move(servos, min(max(round(seconds * 1e3), 1), 65535)))

    def wake(self, raw: FloatArray, seconds: float) -> bytes:
        """The same: the time counts only where the board already knows a position."""
        return self.set_points(raw, seconds)

    def limp(self, axis: int) -> bytes:
        """`#0P0`."""
        return encode(Move((ServoMove(self._channels[axis], 0),)))

    def stop(self, awake: Sequence[bool]) -> tuple[bytes, ...]:
        """Twice those of the arm, awake ones first, then all others: a byte may be lost on a bad wire.

        ESC throws away the piece of a line that was cut off. A CR would carry it out.
        """
        used = sorted(range(self.axes), key=lambda axis: not awake[axis])
        first = ESC + _stops(self._channels[axis] for axis in used)
        others = _stops(channel for channel in range(CHANNELS) if channel not in self._channels)
        return first, first, others

    def clear(self) -> bytes:
        """Nothing: this board latches nothing."""
        return b""

    def hello(self) -> bytes:
        """`VER`; the ESC throws away what another program may have left unfinished."""
        return ESC + self._asked(QueryVersion())

    def poll(self) -> bytes:
        """`QP` of all its channels; where there are potentiometers, `VA` … in turn with it."""
        self._analog_turn = not self._analog_turn and self._taps > 0
        if self._analog_turn:
            return self._asked(ReadAnalog(tuple(range(self._taps))))
        return self._asked(QueryPulses(self._channels))

    def lines(self, data: bytes) -> tuple[bytes, ...]:
        """At each CR."""
        *whole, rest = data.split(CR)
        return (*(line + CR for line in whole), *((rest,) if rest else ()))

    def _asked(self, query: Query) -> bytes:
        self._replies.expect(query)
        return encode(query)

    @property
    def pending(self) -> bool:
        """Whether an answer is owed."""
        return self._replies.pending > 0

    def forget(self) -> None:
        """Wait no longer for answers."""
        self._replies.forget()
        self._analog_valid = False

    def feed(self, data: bytes) -> tuple[Event, ...]:
        """A name, or pulses; anything else is nonsense and no event."""
        return tuple(event for reply in self._replies.feed(data) if (event := self._event(reply.query, reply.value)))

    def _event(self, query: Query, value: object) -> Event | None:
        if isinstance(query, QueryVersion) and isinstance(value, str):
            return Named(value.strip())
        if isinstance(query, QueryPulses) and isinstance(value, tuple) and len(value) == self.axes:
            pulses = np.array(value, dtype=np.float64)
            return Reported(np.where(pulses == 0.0, np.nan, pulses))
        if isinstance(query, ReadAnalog) and isinstance(value, tuple):
            return self._measured(value)
        return None

    def _measured(self, volts: Sequence[float]) -> Measured | None:
        """An input's first reading, and that after a long pause, is not valid."""
        valid, self._analog_valid = self._analog_valid, True
        if not valid:
            return None
        taps = [potentiometer_pulse(value) for value in volts]
        values = np.full(self.axes, np.nan)
        values[: self._taps] = joints_of(self._servos[: self._taps], taps)
        return Measured(values, "potentiometers")


def _stops(channels: Iterable[int]) -> bytes:
    return b"".join(encode(Stop(channel)) for channel in channels)
