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
from rvsim.device.words import in_a_row, one_after_another
from rvsim.language import tr, tr_later, trn
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
    tr_later("moving"),
    tr_later("not following"),
    tr_later("at a limit"),
    tr_later("stopped"),
    tr_later("some axis asleep"),
    tr_later("restarted"),
)


class _Axes:
    """Names and units of places, as far as the arm is known."""

    def __init__(self, robot: Robot | None) -> None:
        self._names = () if robot is None else axis_names(robot)
        self._sliding = () if robot is None else tuple(not joint.revolute for joint in robot.joints)
        self._joints = len(self._sliding)

    def name(self, axis: int) -> str:
        return tr(self._names[axis]) if axis < len(self._names) else tr("axis {number}", number=axis)

    def place(self, axis: int, place: Place) -> str:
        if place is None:
            return tr("nothing")
        if not self._names or axis > self._joints:
            return _hundredths(place)
        if axis == self._joints:
            return tr("{percent} % open", percent=_hundredths(place))
        return f"{_hundredths(place)} mm" if self._sliding[axis] else f"{_hundredths(place)}°"


def frame_in_words(data: bytes, robot: Robot | None = None) -> str:
    """What frames say, both ways, each with its number; of what is no whole frame that it is none.

    Args:
        robot: whose joints the axes are; without it they have numbers and no units.
    """
    axes, decoder = _Axes(robot), FrameDecoder()
    words = [_found(item, axes) for item in decoder.feed(data)]
    return one_after_another(words + [tr("a piece of a frame")] * decoder.unfinished)


def _found(found: Found, axes: _Axes) -> str:
    if isinstance(found, BadFrame):
        return tr("no frame: {problem}", problem=tr(PROBLEM_WORDS[found.problem]))
    message = decode(found)
    if isinstance(message, Problem):
        return tr("{number}: says nothing: {problem}", number=found.sequence, problem=tr(PROBLEM_WORDS[message]))
    return tr("{number}: {message}", number=found.sequence, message=_WORDS[type(message)](message, axes))


def _set_points(message: SetPoints, axes: _Axes) -> str:
    told = [axis for axis, place in enumerate(message.places) if place is not None]
    if not told:
        return tr("no axis to anywhere")
    moves = in_a_row(
        tr("{axis} to {place}", axis=axes.name(axis), place=axes.place(axis, message.places[axis])) for axis in told
    )
    if len(told) > 1:
        return tr("{moves}, together in {time} ms", moves=moves, time=message.duration_ms)
    return tr("{moves} in {time} ms", moves=moves, time=message.duration_ms)


def _wake(message: Wake, axes: _Axes) -> str:
    if message.place is None:
        return tr("wake {axis} where it is", axis=axes.name(message.axis))
    return tr(
        "wake {axis}, to {place} in {time} ms",
        axis=axes.name(message.axis),
        place=axes.place(message.axis, message.place),
        time=message.duration_ms,
    )


def _identity(message: Identity, _: _Axes) -> str:
    values = {"name": message.name, "version": message.version}
    if message.gripper:
        return trn(
            "I am “{name}”, {n} joint and a gripper, version {version} of the protocol",
            "I am “{name}”, {n} joints and a gripper, version {version} of the protocol",
            message.joints,
            **values,
        )
    return trn(
        "I am “{name}”, {n} joint, version {version} of the protocol",
        "I am “{name}”, {n} joints, version {version} of the protocol",
        message.joints,
        **values,
    )


def _encoders(message: Encoders, axes: _Axes) -> str:
    measured = in_a_row(
        tr("{axis} has no encoder", axis=axes.name(axis)) if place is None else _at(axis, place, axes)
        for axis, place in enumerate(message.places)
    )
    return tr(
        "measured at {time} ms: {measured} ({status})",
        time=message.timestamp_ms,
        measured=measured,
        status=_status(message.status),
    )


def _axes_told(message: Axes, axes: _Axes) -> str:
    told = in_a_row(_fares(message, axis, axes) for axis in range(len(message.places)))
    return tr("told: {told} ({status})", told=told, status=_status(message.status))


def _at(axis: int, place: Place, axes: _Axes) -> str:
    return tr("{axis} {place}", axis=axes.name(axis), place=axes.place(axis, place))


def _fares(message: Axes, axis: int, axes: _Axes) -> str:
    place = message.places[axis]
    told = tr("{axis} asleep", axis=axes.name(axis)) if place is None else _at(axis, place, axes)
    if message.stalled[axis]:
        told = tr("{axis} (does not follow)", axis=told)
    return tr("{axis} (at a limit)", axis=told) if message.limit[axis] else told


def _status(status: Status) -> str:
    return in_a_row(tr(word) for word, on in zip(_STATUS_WORDS, status, strict=True) if on) or tr("at rest")


def _error(message: Error, axes: _Axes) -> str:
    problem = tr(PROBLEM_WORDS[message.problem])
    if message.axis is None:
        return tr("not done: {problem}", problem=problem)
    return tr("not done: {axis}: {problem}", axis=axes.name(message.axis), problem=problem)


_WORDS: dict[type, Callable[[Any, _Axes], str]] = {
    Identify: lambda *_: tr("what are you?"),
    Poll: lambda *_: tr("where are the axes?"),
    PollAxes: lambda *_: tr("what are the axes told?"),
    SetPoints: _set_points,
    Stop: lambda *_: tr("stop, all axes"),
    Clear: lambda *_: tr("leave the latched stop"),
    Wake: _wake,
    Limp: lambda message, axes: tr("{servo} off (limp)", servo=axes.name(message.axis)),
    Period: lambda message, _: (
        tr("report every {time} ms", time=message.period_ms) if message.period_ms else tr("report no more")
    ),
    Identity: _identity,
    Encoders: _encoders,
    Axes: _axes_told,
    Status: lambda message, _: tr("done ({status})", status=_status(message)),
    Error: _error,
}


def _hundredths(place: int) -> str:
    return f"{place / 100:.2f}".replace("-", "−")
