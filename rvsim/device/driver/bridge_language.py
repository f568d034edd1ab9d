"""The encoder bridge as the driver speaks to it: places down, told places and measured ones up."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from rvsim.device.bridge.axes import axis_scales
from rvsim.device.bridge.frames import START, BadFrame, Problem
from rvsim.device.bridge.host_side import BridgeDecoder, BridgeEncoder, Heard
from rvsim.device.bridge.messages import (
    LONGEST_MS,
    Axes,
    Clear,
    Encoders,
    Error,
    HostMessage,
    Identify,
    Identity,
    Limp,
    Poll,
    PollAxes,
    SetPoints,
    Status,
    Stop,
    Wake,
)
from rvsim.device.driver.language import Event, Latched, Measured, Named, Noticed, Reported, Unfit
from rvsim.device.words import axis_names, in_a_row
from rvsim.language import tr, tr_later, trn
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.robot.servos import within_servos

_TOLERANCE = 1500.0  # hundredths of a degree, of a millimetre, of a percent
_STOPS = 2  # at once: a frame may be lost on a bad wire
_FRAME_BYTES = 6  # of an empty message
_LATCHED = tr_later("The bridge has latched a stop. Reset it when nothing is in the arm's way.")


class BridgeLanguage:
    """The encoder bridge. Raw numbers are its places; it has its own calibration.

    Args:
        robot: the arm; where it has servos their limits count as well.
    """

    title = "Encoder bridge"
    named_answers = gentle = True

    def __init__(self, robot: Robot) -> None:
        self._gripper: bool | None = None
        self.use(robot)
        self._encoder, self._decoder = BridgeEncoder(), BridgeDecoder()
        self._awaited: type | None = None
        self._turn = False
        self._clearing = False

    def use(self, robot: Robot) -> bool:
        """Other limits; whether there is still a gripper, or still none.

        Raises:
            RobotDefinitionError: a joint has no value that both arm and servo allow.
        """
        gripper, before = robot.gripper_servo is not None, self._gripper
        limits = [tuple(pair) for pair in within_servos(robot).limits] + [(0.0, 1.0)] * gripper
        self._robot, self._gripper, self._limits = robot, gripper, np.array(limits)
        self._scales = axis_scales(robot)
        self._least, self._most = (
            np.ceil(self._limits[:, 0] * self._scales),
            np.floor(self._limits[:, 1] * self._scales),
        )
        return before == gripper

    @property
    def axes(self) -> int:
        """m."""
        return len(self._limits)

    @property
    def limits(self) -> FloatArray:
        """(m, 2)."""
        return self._limits

    @property
    def set_point_bytes(self) -> int:
        """A time and a place an axis; a few bytes are escaped."""
        return _FRAME_BYTES + 2 + 2 * self.axes + 2

    @property
    def question_bytes(self) -> int:
        """An empty frame."""
        return _FRAME_BYTES

    @property
    def tolerance(self) -> FloatArray:
        """(m,)."""
        return np.full(self.axes, _TOLERANCE)

    def raw(self, values: FloatArray) -> FloatArray:
        """(m,) places within the limits."""
        return np.clip(np.round(values * self._scales), self._least, self._most)

    def values(self, raw: FloatArray) -> FloatArray:
        """(m,) q, and the opening."""
        return raw / self._scales

    def jogged(self, _channel: int, _pulse_us: float) -> tuple[int, float] | str:
        """None: pulses are the bridge's own business."""
        return tr("The bridge has its own calibration; there are no pulses to be sent.")

    def set_points(self, raw: FloatArray, seconds: float) -> bytes:
        """One frame."""
        places = tuple(None if np.isnan(place) else round(place) for place in raw.tolist())
        return self._encoder.encode(SetPoints(places, _milliseconds(seconds)))

    def wake(self, raw: FloatArray, seconds: float) -> bytes:
        """Each axis begins where its encoder says it is."""
        axes = np.flatnonzero(np.isfinite(raw)).tolist()
        return b"".join(self._encoder.encode(Wake(axis, round(raw[axis]), _milliseconds(seconds))) for axis in axes)

    def limp(self, axis: int) -> bytes:
        """One frame."""
        return self._encoder.encode(Limp(axis))

    def stop(self, _awake: Sequence[bool]) -> tuple[bytes, ...]:
        """All axes at once, more than once: a start byte ends whatever was cut off before it."""
        return tuple(b"".join(self._encoder.encode(Stop()) for _ in range(_STOPS)) for _ in range(2))

    def clear(self) -> bytes:
        """What are you? — which ends "restarted" — and leave the stop."""
        self._clearing = True
        return self._encoder.encode(Identify()) + self._encoder.encode(Clear())

    def hello(self) -> bytes:
        """What are you?"""
        return self._asked(Identify(), Identity)

    def poll(self) -> bytes:
        """What the axes are told, and in turn with it where they are."""
        self._turn = not self._turn
        return self._asked(PollAxes(), Axes) if self._turn else self._asked(Poll(), Encoders)

    def _asked(self, message: HostMessage, answer: type) -> bytes:
        self._awaited = answer
        return self._encoder.encode(message)

    def lines(self, data: bytes) -> tuple[bytes, ...]:
        """At each start byte."""
        first, *frames = data.split(bytes((START,)))
        return (*((first,) if first else ()), *(bytes((START,)) + frame for frame in frames))

    @property
    def pending(self) -> bool:
        """Whether an answer is owed."""
        return self._awaited is not None

    def forget(self) -> None:
        """Wait no longer for answers."""
        self._awaited = None

    def feed(self, data: bytes) -> tuple[Event, ...]:
        """What the board says; bad frames are no events."""
        return tuple(event for message in self._decoder.feed(data) for event in self._events(message))

    def _events(self, message: Heard) -> Iterator[Event]:
        if isinstance(message, BadFrame):
            return
        if isinstance(message, self._awaited or ()):
            self._awaited = None
        if isinstance(message, Identity):
            yield from self._identified(message)
        elif isinstance(message, Axes):
            yield from self._told(message)
        elif isinstance(message, Encoders):
            yield from self._encoded(message)
        elif isinstance(message, Error):
            yield from self._failed(message)
        yield from self._fares(message.status if isinstance(message, Axes | Encoders) else message)

    def _identified(self, message: Identity) -> Iterator[Event]:
        yield Named(message.name or tr("encoder bridge"))
        if (message.joints, message.gripper) != (self._robot.dof, self._gripper):
            yield Unfit(_another_arm(message))

    def _told(self, message: Axes) -> Iterator[Event]:
        if len(message.places) == self.axes:
            yield Reported(_numbers(message.places))
        names = axis_names(self._robot)
        stalled = [name for name, stuck in zip(names, message.stalled, strict=False) if stuck]
        yield Noticed(
            tr("{joints}: does not follow. Is something in the way?", joints=in_a_row(stalled)) if stalled else ""
        )

    def _encoded(self, message: Encoders) -> Iterator[Event]:
        if len(message.places) == self.axes:
            yield Measured(self.values(_numbers(message.places)), "encoders")

    def _failed(self, message: Error) -> Iterator[Event]:
        if message.problem is Problem.STOPPED:
            yield Latched(tr(_LATCHED))

    def _fares(self, status: object) -> Iterator[Event]:
        """What a status says of itself; that of before a reset still says "stopped"."""
        if not isinstance(status, Status):
            return
        if status.restarted:
            yield Reported(np.full(self.axes, np.nan))
        self._clearing = self._clearing and status.stopped
        if status.stopped and not self._clearing:
            yield Latched(tr(_LATCHED))


def _another_arm(message: Identity) -> str:
    if message.gripper:
        return trn(
            "The bridge drives another arm than this one: {n} joint and a gripper.",
            "The bridge drives another arm than this one: {n} joints and a gripper.",
            message.joints,
        )
    return trn(
        "The bridge drives another arm than this one: {n} joint.",
        "The bridge drives another arm than this one: {n} joints.",
        message.joints,
    )


def _numbers(places: Sequence[int | None]) -> FloatArray:
    return np.array([np.nan if place is None else place for place in places], dtype=np.float64)


def _milliseconds(seconds: float) -> int:
    return min(max(round(seconds * 1e3), 1), LONGEST_MS)
