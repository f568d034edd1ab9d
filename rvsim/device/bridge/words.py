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
from rvsim.language import tr, tr_later
from rvsim.robot import Robot

PROBLEM_WORDS: dict[Problem, str] = {
    Problem.NOISE: tr_later("bytes outside of a frame"),
    Problem.CUT: tr_later("a frame that was cut short"),
    Problem.ESCAPE: tr_later("an escape byte where none belongs"),
    Problem.LENGTH: tr_later("a wrong length"),
    Problem.CRC: tr_later("a wrong CRC"),
    Problem.SEQUENCE: tr_later("a repeated or old sequence number"),
    Problem.TYPE: tr_later("an unknown type"),
    Problem.VALUE: tr_later("a number outside its range, or an axis that there is not"),
    Problem.ASLEEP: tr_later("an axis is asleep: wake it first"),
    Problem.STOPPED: tr_later("a stop has latched: clear it first"),
}
# In the order of the flags of a Status.
_STATUS_WORDS = (
    "moving",
    tr_later("not following"),
    tr_later("at a limit"),
    "stopped",
    tr_later("some axis asleep"),
    "restarted",
)


class _Axes:
    """Names and units of places, as far as the arm is known."""

    def __init__(self, robot: Robot | None) -> None:
        self._names = () if robot is None else axis_names(robot)
        self._sliding = () if robot is None else tuple(not joint.revolute for joint in robot.joints)
        self._joints = len(self._sliding)

    def name(self, axis: int) -> str:
        return self._names[axis] if axis < len(self._names) else tr("axis {axis}", axis=axis)

    def place(self, axis: int, place: Place) -> str:
        if place is None:
            return "nothing"
        if not self._names or axis > self._joints:
            return _hundredths(place)
        if axis == self._joints:
            return tr("{hundredths} % open", hundredths=_hundredths(place))
        return f"{_hundredths(place)} mm" if self._sliding[axis] else f"{_hundredths(place)}°"


def frame_in_words(data: bytes, robot: Robot | None = None) -> str:
    """What frames say, both ways, each with its number; of what is no whole frame that it is none.

    Args:
        robot: whose joints the axes are; without it they have numbers and no units.
    """
    axes, decoder = _Axes(robot), FrameDecoder()
    words = [_found(item, axes) for item in decoder.feed(data)]
    return "; ".join(words + [tr("a piece of a frame")] * decoder.unfinished)


def _found(found: Found, axes: _Axes) -> str:
    if isinstance(found, BadFrame):
        return tr("no frame: {problem}", problem=PROBLEM_WORDS[found.problem])
    message = decode(found)
    if isinstance(message, Problem):
        return tr("{sequence}: says nothing: {problem}", sequence=found.sequence, problem=PROBLEM_WORDS[message])
    return f"{found.sequence}: {_WORDS[type(message)](message, axes)}"


def _set_points(message: SetPoints, axes: _Axes) -> str:
    told = [axis for axis, place in enumerate(message.places) if place is not None]
    if not told:
        return tr("no axis to anywhere")
    parts = ", ".join(f"{axes.name(axis)} to {axes.place(axis, message.places[axis])}" for axis in told)
    return f"{parts}{', together' if len(told) > 1 else ''} in {message.duration_ms} ms"


def _wake(message: Wake, axes: _Axes) -> str:
    if message.place is None:
        return tr("wake {name} where it is", name=axes.name(message.axis))
    return tr(
        "wake {name}, to {place} in {duration_ms} ms",
        name=axes.name(message.axis),
        place=axes.place(message.axis, message.place),
        duration_ms=message.duration_ms,
    )


def _identity(message: Identity, _: _Axes) -> str:
    grip = tr(" and a gripper") if message.gripper else ""
    return tr(
        "I am “{name}”, {joints} joints{grip}, version {version} of the protocol",
        name=message.name,
        joints=message.joints,
        grip=grip,
        version=message.version,
    )


def _encoders(message: Encoders, axes: _Axes) -> str:
    measured = ", ".join(
        f"{axes.name(axis)} {'has no encoder' if place is None else axes.place(axis, place)}"
        for axis, place in enumerate(message.places)
    )
    return tr(
        "measured at {timestamp_ms} ms: {measured} ({status})",
        timestamp_ms=message.timestamp_ms,
        measured=measured,
        status=_status(message.status),
    )


def _axes_told(message: Axes, axes: _Axes) -> str:
    told = ", ".join(
        f"{axes.name(axis)} {'asleep' if place is None else axes.place(axis, place)}{_fares(message, axis)}"
        for axis, place in enumerate(message.places)
    )
    return tr("told: {told} ({status})", told=told, status=_status(message.status))


def _fares(message: Axes, axis: int) -> str:
    return tr(" (does not follow)") * message.stalled[axis] + tr(" (at a limit)") * message.limit[axis]


def _status(status: Status) -> str:
    return ", ".join(word for word, on in zip(_STATUS_WORDS, status, strict=True) if on) or tr("at rest")


def _error(message: Error, axes: _Axes) -> str:
    where = "" if message.axis is None else f"{axes.name(message.axis)}: "
    return tr("not done: {where}{problem}", where=where, problem=PROBLEM_WORDS[message.problem])


_WORDS: dict[type, Callable[[Any, _Axes], str]] = {
    Identify: lambda *_: tr("what are you?"),
    Poll: lambda *_: tr("where are the axes?"),
    PollAxes: lambda *_: tr("what are the axes told?"),
    SetPoints: _set_points,
    Stop: lambda *_: tr("stop, all axes"),
    Clear: lambda *_: tr("leave the latched stop"),
    Wake: _wake,
    Limp: lambda message, axes: tr("{name} off (limp)", name=axes.name(message.axis)),
    Period: lambda message, _: (
        tr("report every {period_ms} ms", period_ms=message.period_ms) if message.period_ms else tr("report no more")
    ),
    Identity: _identity,
    Encoders: _encoders,
    Axes: _axes_told,
    Status: lambda message, _: tr("done ({status})", status=_status(message)),
    Error: _error,
}


def _hundredths(place: int) -> str:
    return f"{place / 100:.2f}".replace("-", "−")
