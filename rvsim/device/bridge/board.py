"""The encoder bridge of the virtual arm: set-points down, measured angles up. It knows its servos itself."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from rvsim.device.bridge.axes import axis_scales, places_of, values_of
from rvsim.device.bridge.courses import Courses
from rvsim.device.bridge.frames import BadFrame, Found, FrameDecoder, Problem
from rvsim.device.bridge.messages import (
    Axes,
    BoardMessage,
    Clear,
    Encoders,
    Error,
    Identify,
    Identity,
    Limp,
    Period,
    Place,
    Poll,
    PollAxes,
    SetPoints,
    Status,
    Stop,
    Wake,
    decode,
    encode,
)
from rvsim.device.virtual.clock import FRAME_NS, NANO, Clock
from rvsim.device.virtual.contract import BoolArray, ChannelState, Measure
from rvsim.device.virtual.faults import NO_FAULTS, Fault
from rvsim.device.virtual.servo import GRIPPER_SPEED, USUAL_SPEED
from rvsim.robot import GripperServo, Robot, Servo
from rvsim.robot.arrays import FloatArray
from rvsim.robot.servo import CHANNELS
from rvsim.robot.servos import pulses_of, servo_limits

VERSION = 1
NAME = "rvsim virtual bridge"
LEAST_PERIOD_MS = 20
_MILLI = NANO // 1000
_OLD = 128  # sequence numbers: a step of less than half the circle is new, any other is repeated or old
# Hundredths of a degree, of a millimetre: how far behind an axis may be before it is said not to follow.
_BEHIND_MOVING, _BEHIND_RESTING = 3000, 800
_TIME_TO_ARRIVE = 0.5  # [s]


class BridgeBoard:
    """A microcontroller with an encoder on each joint.

    Args:
        robot: the arm.
        servos, gripper: as they really are: whoever built the bridge has calibrated it.
        measure: where the joints really are, (n,) [rad, m].
        name: what it calls itself.
    """

    def __init__(
        self, robot: Robot, servos: Sequence[Servo], gripper: GripperServo | None, measure: Measure, name: str = NAME
    ) -> None:
        self.faults = NO_FAULTS
        self._robot, self._servos, self._gripper = robot, tuple(servos), gripper
        self._measure, self._name = measure, name
        self._channels = [servo.channel for servo in servos] + ([] if gripper is None else [gripper.channel])
        self._clock = Clock()
        self._answers = bytearray()
        self._reports = 0
        self.power_cycle()

    # The contract of a board.

    @property
    def pulses(self) -> FloatArray:
        """(32,) the pulses on the servos' pins in the present frame [µs], whole ones; NaN where there is none."""
        pulses = np.full(CHANNELS, np.nan)
        pulses[self._channels] = np.round(self._pulses_of(self._courses.at(self._frame)))
        return pulses

    @property
    def powered(self) -> BoolArray:
        """(32,) where a servo gets pulses."""
        return np.isfinite(self.pulses)

    @property
    def channels(self) -> tuple[ChannelState, ...]:
        """(32) what each channel is doing."""
        states: list[ChannelState] = ["unknown"] * CHANNELS
        moving, awake = self._courses.moving(self._clock.now), self._courses.awake
        for axis, channel in enumerate(self._channels):
            states[channel] = "moving" if moving[axis] else "holding" if awake[axis] else self._asleep[axis]
        return tuple(states)

    @property
    def moving(self) -> bool:
        """Whether a move is under way."""
        return bool(self._courses.moving(self._clock.now).any())

    @property
    def busy(self) -> bool:
        """Whether anything changes by itself."""
        return self.moving or self._period > 0

    def write(self, data: bytes) -> None:
        """Bytes arrive now; frames that they complete are acted upon, or answered with an error."""
        for found in self._frames.feed(data):
            self._answer(self._answer_to(found), found.sequence)

    def process(self, dt: float) -> None:
        """So much time passes [s]."""
        until = self._clock.advance(dt)
        while self._period and (frame := _frame_from(self._due)) <= until:
            self._answer(self._encoders(frame), self._reports)
            self._reports = (self._reports + 1) % 256
            self._due += self._period

    def read(self) -> bytes:
        """What it has sent since the last call."""
        answers = bytes(self._answers)
        self._answers.clear()
        return answers

    def power_cycle(self) -> None:
        """Off and on: everything is forgotten but the calibration; all axes are asleep."""
        self._courses = _courses(self._robot, self._servos, self._gripper)
        self._asleep: list[ChannelState] = ["unknown"] * len(self._channels)
        self._frames = FrameDecoder()
        self._last: int | None = None
        self._stopped, self._restarted = False, True
        self._period, self._due, self._reports = 0, 0, 0
        self._on_since = self._clock.now
        self._answers.clear()

    # What frames do.

    @property
    def _frame(self) -> int:
        """The present servo frame's beginning [ns]."""
        return self._clock.now // FRAME_NS * FRAME_NS

    def _answer(self, message: BoardMessage, sequence: int) -> None:
        self._answers += encode(message, sequence)

    def _answer_to(self, found: Found) -> BoardMessage:
        if isinstance(found, BadFrame):
            return Error(found.problem)
        message = decode(found)
        if isinstance(message, Problem):
            return Error(message)
        deed = _DEEDS.get(type(message))
        if deed is None:
            return Error(Problem.TYPE)
        if not self._in_order(found.sequence, type(message)):
            return Error(Problem.SEQUENCE)
        return deed(self, message)

    def _in_order(self, sequence: int, message: type) -> bool:
        """Whether a number is new; a stop must never fail for its number, and Identify begins anew."""
        step = 1 if self._last is None else (sequence - self._last) % 256
        new = 0 < step < _OLD or message in (Stop, Identify)
        self._last = sequence if new else self._last
        return new

    def _identify(self, _: Identify) -> BoardMessage:
        self._restarted = False
        return Identity(VERSION, self._robot.dof, self._gripper is not None, self._name)

    def _poll(self, _: Poll) -> BoardMessage:
        return self._encoders(self._clock.now)

    def _encoders(self, now: int) -> BoardMessage:
        timestamp = (now - self._on_since) // _MILLI % 2**32
        return Encoders(timestamp, self._status_at(now), places_of(self._robot, self._measured()))

    def _axes(self, _: PollAxes) -> BoardMessage:
        places = places_of(self._robot, self._courses.at(self._frame))
        return Axes(self._status(), places, _flags(self._stalled(self._clock.now)), _flags(self._courses.limited))

    def _set_points(self, message: SetPoints) -> BoardMessage:
        if len(message.places) != len(self._channels):
            return Error(Problem.LENGTH)
        if self._stopped:
            return Error(Problem.STOPPED)
        for axis, place in enumerate(message.places):
            if place is not None and not self._courses.awake[axis]:
                return Error(Problem.ASLEEP, axis)
        self._go(message.places, message.duration_ms)
        return self._status()

    def _go(self, places: Sequence[Place], duration_ms: int) -> None:
        self._courses.go(values_of(self._robot, places), self._clock.now, duration_ms / 1e3)

    def _wake(self, message: Wake) -> BoardMessage:
        axis = message.axis
        if axis >= len(self._channels):
            return Error(Problem.VALUE, axis)
        if self._stopped:
            return Error(Problem.STOPPED)
        places: list[Place] = [None] * len(self._channels)
        places[axis] = message.place
        if not self._courses.awake[axis]:
            measured = self._measured()[axis]
            start = values_of(self._robot, places)[axis] if np.isnan(measured) else measured
            if np.isnan(start):
                return Error(Problem.VALUE, axis)
            self._courses.wake(axis, float(np.clip(start, *self._reach(axis))), self._clock.now)
        self._go(places, message.duration_ms)
        return self._status()

    def _limp(self, message: Limp) -> BoardMessage:
        if message.axis >= len(self._channels):
            return Error(Problem.VALUE, message.axis)
        self._courses.sleep(message.axis)
        self._asleep[message.axis] = "limp"
        return self._status()

    def _stop(self, _: Stop) -> BoardMessage:
        self._courses.stop(self._clock.now)
        self._stopped = True
        return self._status()

    def _clear(self, _: Clear) -> BoardMessage:
        self._stopped = False
        return self._status()

    def _set_period(self, message: Period) -> BoardMessage:
        if 0 < message.period_ms < LEAST_PERIOD_MS:
            return Error(Problem.VALUE)
        self._period = message.period_ms * _MILLI
        self._due = self._clock.now + self._period
        return self._status()

    # What it knows of its axes.

    def _measured(self) -> FloatArray:
        """(m,) NaN for the gripper, which has no encoder."""
        return np.append(self._measure(), [np.nan] * (len(self._channels) - self._robot.dof))

    def _status(self) -> Status:
        return self._status_at(self._clock.now)

    def _status_at(self, now: int) -> Status:
        return Status(
            moving=bool(self._courses.moving(now).any()) or Fault.STUCK_MOVING in self.faults,
            stalled=bool(self._stalled(now).any()),
            limit=bool(self._courses.limited.any()),
            stopped=self._stopped,
            asleep=not self._courses.awake.all(),
            restarted=self._restarted,
        )

    def _stalled(self, now: int) -> BoolArray:
        """(m,) which axes do not follow: far behind on their way, or not there in time."""
        behind = np.abs(self._measured() - self._courses.at(now)) * axis_scales(self._robot)
        late = (behind > _BEHIND_RESTING) & (self._courses.resting(now) > _TIME_TO_ARRIVE)
        return np.asarray((behind > _BEHIND_MOVING) | late)

    def _reach(self, axis: int) -> tuple[float, float]:
        """What the servo can, beyond the limits that set-points are held to."""
        return self._servos[axis].limits if axis < len(self._servos) else (0.0, 1.0)

    def _pulses_of(self, values: FloatArray) -> FloatArray:
        joints, grip = values[: self._robot.dof], values[self._robot.dof :].tolist()
        pulses = [
            math.nan if math.isnan(opening) or not self._gripper else self._gripper.pulse(opening) for opening in grip
        ]
        return np.append(pulses_of(self._servos, joints), pulses)


def _courses(robot: Robot, servos: Sequence[Servo], gripper: GripperServo | None) -> Courses:
    """Within what both the arm and its servos allow, and no quicker than they can."""
    speeds = [USUAL_SPEED if joint.max_speed is None else joint.max_speed.value for joint in robot.joints]
    arm, hands = robot.limits, servo_limits(servos)
    lower = np.maximum(arm[:, 0], hands[:, 0])
    upper = np.maximum(np.minimum(arm[:, 1], hands[:, 1]), lower)
    if gripper is None:
        return Courses(lower, upper, np.array(speeds))
    return Courses(np.append(lower, 0.0), np.append(upper, 1.0), np.array([*speeds, GRIPPER_SPEED]))


def _frame_from(now: int) -> int:
    """The first servo frame at a time [ns] or after it."""
    return -(-now // FRAME_NS) * FRAME_NS


def _flags(mask: BoolArray) -> tuple[bool, ...]:
    return tuple(map(bool, mask))


# One deed a message: the type of the key is the type that the deed takes.
_DEEDS: dict[type, Callable[[BridgeBoard, Any], BoardMessage]] = {
    Identify: BridgeBoard._identify,
    Poll: BridgeBoard._poll,
    PollAxes: BridgeBoard._axes,
    SetPoints: BridgeBoard._set_points,
    Stop: BridgeBoard._stop,
    Clear: BridgeBoard._clear,
    Wake: BridgeBoard._wake,
    Limp: BridgeBoard._limp,
    Period: BridgeBoard._set_period,
}
