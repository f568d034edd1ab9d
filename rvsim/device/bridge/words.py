"""What bytes of the encoder bridge say, for people who read the wire log."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rvsim.device.bridge.axes import axis_names
from rvsim.device.bridge.frames import BadFrame, Found, FrameDecoder, Problem
from rvsim.device.bridge.messages import (
    Axes,
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
)
from rvsim.robot import Robot

PROBLEM_WORDS: dict[Problem, str] = {
    Problem.NOISE: "bytes outside of a frame",
    Problem.CUT: "a frame that was cut short",
    Problem.ESCAPE: "an escape byte where none belongs",
    Problem.LENGTH: "a wrong length",
    Problem.CRC: "a wrong CRC",
    Problem.SEQUENCE: "a repeated or old sequence number",
    Problem.TYPE: "an unknown type",
    Problem.VALUE: "a number outside its range, or an axis that there is not",
    Problem.ASLEEP: "an axis is asleep: wake it first",
    Problem.STOPPED: "a stop has latched: clear it first",
}
# In the order of the flags of a Status.
_STATUS_WORDS = ("moving", "not following", "at a limit", "stopped", "some axis asleep", "restarted")


class _Axes:
    """Names and units of places, as far as the arm is known."""

    def __init__(self, robot: Robot | None) -> None:
        self._names = () if robot is None else axis_names(robot)
        self._sliding = () if robot is None else tuple(not joint.revolute for joint in robot.joints)
        self._joints = len(self._sliding)

    def name(self, axis: int) -> str:
        return self._names[axis] if axis < len(self._names) else f"axis {axis}"

    def place(self, axis: int, place: Place) -> str:
        if place is None:
            return "nothing"
        if not self._names or axis > self._joints:
            return _hundredths(place)
        if axis == self._joints:
            return f"{_hundredths(place)} % open"
        return f"{_hundredths(place)} mm" if self._sliding[axis] else f"{_hundredths(place)}°"


def frame_in_words(data: bytes, robot: Robot | None = None) -> str:
    """What frames say, both ways, each with its number; of what is no whole frame that it is none.

    Args:
        robot: whose joints the axes are; without it they have numbers and no units.
    """
    axes, decoder = _Axes(robot), FrameDecoder()
    words = [_found(item, axes) for item in decoder.feed(data)]
    return "; ".join(words + ["a piece of a frame"] * decoder.unfinished)


def _found(found: Found, axes: _Axes) -> str:
    if isinstance(found, BadFrame):
        return f"no frame: {PROBLEM_WORDS[found.problem]}"
    message = decode(found)
    if isinstance(message, Problem):
        return f"{found.sequence}: says nothing: {PROBLEM_WORDS[message]}"
    return f"{found.sequence}: {_WORDS[type(message)](message, axes)}"


def _set_points(message: SetPoints, axes: _Axes) -> str:
    told = [axis for axis, place in enumerate(message.places) if place is not None]
    if not told:
        return "no axis to anywhere"
    parts = ", ".join(f"{axes.name(axis)} to {axes.place(axis, message.places[axis])}" for axis in told)
    return f"{parts}{', together' if len(told) > 1 else ''} in {message.duration_ms} ms"


def _wake(message: Wake, axes: _Axes) -> str:
    if message.place is None:
        return f"wake {axes.name(message.axis)} where it is"
    return f"wake {axes.name(message.axis)}, to {axes.place(message.axis, message.place)} in {message.duration_ms} ms"


def _identity(message: Identity, _: _Axes) -> str:
    grip = " and a gripper" if message.gripper else ""
    return f"I am “{message.name}”, {message.joints} joints{grip}, version {message.version} of the protocol"


def _encoders(message: Encoders, axes: _Axes) -> str:
    measured = ", ".join(
        f"{axes.name(axis)} {'has no encoder' if place is None else axes.place(axis, place)}"
        for axis, place in enumerate(message.places)
    )
    return f"measured at {message.timestamp_ms} ms: {measured} ({_status(message.status)})"


def _axes_told(message: Axes, axes: _Axes) -> str:
    told = ", ".join(
        f"{axes.name(axis)} {'asleep' if place is None else axes.place(axis, place)}{_fares(message, axis)}"
        for axis, place in enumerate(message.places)
    )
    return f"told: {told} ({_status(message.status)})"


def _fares(message: Axes, axis: int) -> str:
    return " (does not follow)" * message.stalled[axis] + " (at a limit)" * message.limit[axis]


def _status(status: Status) -> str:
    return ", ".join(word for word, on in zip(_STATUS_WORDS, status, strict=True) if on) or "at rest"


def _error(message: Error, axes: _Axes) -> str:
    where = "" if message.axis is None else f"{axes.name(message.axis)}: "
    return f"not done: {where}{PROBLEM_WORDS[message.problem]}"


_WORDS: dict[type, Callable[[Any, _Axes], str]] = {
    Identify: lambda *_: "what are you?",
    Poll: lambda *_: "where are the axes?",
    PollAxes: lambda *_: "what are the axes told?",
    SetPoints: _set_points,
    Stop: lambda *_: "stop, all axes",
    Clear: lambda *_: "leave the latched stop",
    Wake: _wake,
    Limp: lambda message, axes: f"{axes.name(message.axis)} off (limp)",
    Period: lambda message, _: f"report every {message.period_ms} ms" if message.period_ms else "report no more",
    Identity: _identity,
    Encoders: _encoders,
    Axes: _axes_told,
    Status: lambda message, _: f"done ({_status(message)})",
    Error: _error,
}


def _hundredths(place: int) -> str:
    return f"{place / 100:.2f}".replace("-", "−")
