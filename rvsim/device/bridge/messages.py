"""What frames of the encoder bridge say, as values, and their bytes. resources/help/encoder-bridge.md specifies them.

Places are whole numbers as on the wire: hundredths of a degree (of a millimetre for a sliding joint, of a percent of
the gripper's opening); None is "nothing": leave it alone, not measured, asleep. axes.py turns them into q.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Sequence
from dataclasses import astuple, dataclass, fields
from typing import Any, NamedTuple, TypeAlias

from rvsim.device.bridge.frames import Frame, Problem, frame_bytes
from rvsim.errors import SettingError
from rvsim.language import tr

MOST_AXES = 16
LONGEST_MS = 0xFFFF
LARGEST = 0x7FFF  # of a place, either way
LONGEST_NAME = 32  # characters
NO_AXIS = 0xFF
_NONE = -0x8000

Place: TypeAlias = int | None


# --- from the host ---------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Identify:
    """What are you? Any sequence number is right. Answer: Identity."""


@dataclass(frozen=True)
class Poll:
    """Where are the axes? Answer: Encoders."""


@dataclass(frozen=True)
class PollAxes:
    """What are the axes told, and how do they fare? Answer: Axes."""


@dataclass(frozen=True)
class SetPoints:
    """All axes together to places, in a time; an axis with None is left alone. Answer: Status."""

    places: tuple[Place, ...]
    duration_ms: int

    def __post_init__(self) -> None:
        _check_places(self.places)
        _check("duration_ms", self.duration_ms, LONGEST_MS)


@dataclass(frozen=True)
class Stop:
    """All axes stop where they are; nothing moves until Clear. Any sequence number is right. Answer: Status."""


@dataclass(frozen=True)
class Clear:
    """Leave the latched stop. Nothing moves. Answer: Status."""


@dataclass(frozen=True)
class Wake:
    """Power an axis where its encoder says it is, then go to a place in a time; None: stay there. Answer: Status."""

    axis: int
    place: Place
    duration_ms: int

    def __post_init__(self) -> None:
        _check("axis", self.axis, MOST_AXES - 1)
        _check_places((self.place,))
        _check("duration_ms", self.duration_ms, LONGEST_MS)


@dataclass(frozen=True)
class Limp:
    """Switch an axis off: it falls under its weight and is asleep. Answer: Status."""

    axis: int

    def __post_init__(self) -> None:
        _check("axis", self.axis, MOST_AXES - 1)


@dataclass(frozen=True)
class Period:
    """Send Encoders unasked every so many milliseconds, 0: no more. Answer: Status."""

    period_ms: int

    def __post_init__(self) -> None:
        _check("period_ms", self.period_ms, LONGEST_MS)


# --- from the board --------------------------------------------------------------------------------------------------


class Status(NamedTuple):
    """How the arm is; it answers each command that was accepted.

    Args:
        moving: a move is under way.
        stalled: an axis does not follow.
        limit: a place that was asked for lies beyond a limit; the axis goes to the limit.
        stopped: a stop has latched.
        asleep: some axis is.
        restarted: the power has come on since the last Identify: nothing is known of what was before.
    """

    moving: bool = False
    stalled: bool = False
    limit: bool = False
    stopped: bool = False
    asleep: bool = False
    restarted: bool = False


@dataclass(frozen=True)
class Identity:
    """The version of this protocol, the number of joints, whether there is a gripper (one more axis), and a name."""

    version: int
    joints: int
    gripper: bool
    name: str

    def __post_init__(self) -> None:
        _check("version", self.version, 0xFF)
        _check("joints", self.joints, MOST_AXES)
        if not (self.name.isascii() and self.name.isprintable() and len(self.name) <= LONGEST_NAME):
            raise SettingError("name", self.name, tr("at most {most} printable ASCII characters", most=LONGEST_NAME))


@dataclass(frozen=True)
class Encoders:
    """Where the axes were at a time [ms] since the power came on (mod 2³²); None: the axis has no encoder."""

    timestamp_ms: int
    status: Status
    places: tuple[Place, ...]

    def __post_init__(self) -> None:
        _check("timestamp_ms", self.timestamp_ms, 0xFFFF_FFFF)
        _check_places(self.places)


@dataclass(frozen=True)
class Axes:
    """Where each axis is told to be just now (None: asleep), whether it does not follow, and whether at a limit."""

    status: Status
    places: tuple[Place, ...]
    stalled: tuple[bool, ...]
    limit: tuple[bool, ...]

    def __post_init__(self) -> None:
        _check_places(self.places)
        if not len(self.places) == len(self.stalled) == len(self.limit):
            raise SettingError(
                "axes", (len(self.stalled), len(self.limit)), tr("{count} flags each", count=len(self.places))
            )


@dataclass(frozen=True)
class Error:
    """A frame was not acted upon; the axis that is to blame, if one is. Nothing has moved because of it."""

    problem: Problem
    axis: int | None = None

    def __post_init__(self) -> None:
        if self.axis is not None:
            _check("axis", self.axis, MOST_AXES - 1)


HostMessage: TypeAlias = Identify | Poll | PollAxes | SetPoints | Stop | Clear | Wake | Limp | Period
BoardMessage: TypeAlias = Status | Identity | Encoders | Axes | Error
Message: TypeAlias = HostMessage | BoardMessage


def encode(message: Message, sequence: int) -> bytes:
    """The frame of a message, whose sequence number (mod 256) answers repeat."""
    code = _CODES[type(message)]
    return frame_bytes(Frame(sequence % 256, code, _FORMS[code].pack(message)))


def decode(frame: Frame) -> Message | Problem:
    """What a frame says; Problem.TYPE, LENGTH or VALUE where it says nothing that there is."""
    form = _FORMS.get(frame.type)
    if form is None:
        return Problem.TYPE
    try:
        message: Message = form.unpack(frame.payload)
    except struct.error:
        return Problem.LENGTH
    except (SettingError, ValueError):
        return Problem.VALUE
    return message


# --- payloads: little-endian -----------------------------------------------------------------------------------------


class _Form(NamedTuple):
    message: type
    pack: Callable[[Any], bytes]
    unpack: Callable[[bytes], Any]


def _plain(message: type, layout: str = "<") -> _Form:
    """Whole numbers only, in the order of the fields."""
    count = len(fields(message))
    pack = struct.Struct(layout)
    return _Form(message, lambda m: pack.pack(*astuple(m)) if count else b"", lambda data: message(*pack.unpack(data)))


def _place_bytes(places: Sequence[Place]) -> bytes:
    return struct.pack(f"<{len(places)}h", *(_NONE if place is None else place for place in places))


def _places_in(data: bytes) -> tuple[Place, ...]:
    return tuple(None if place == _NONE else place for place in struct.unpack(f"<{len(data) // 2}h", data))


def _bits(flags: Sequence[bool]) -> int:
    return sum(1 << index for index, flag in enumerate(flags) if flag)


def _flags(bits: int, count: int) -> tuple[bool, ...]:
    """So many flags; a bit beyond them is no value."""
    if bits >> count:
        raise ValueError(bits)
    return tuple(bool(bits >> index & 1) for index in range(count))


def _status_in(byte: int) -> Status:
    return Status(*_flags(byte, len(Status._fields)))


def _wake_in(data: bytes) -> Wake:
    axis, place, duration_ms = struct.unpack("<BhH", data)
    return Wake(axis, None if place == _NONE else place, duration_ms)


def _wake_bytes(wake: Wake) -> bytes:
    return struct.pack("<BhH", wake.axis, _NONE if wake.place is None else wake.place, wake.duration_ms)


def _set_points_in(data: bytes) -> SetPoints:
    (duration_ms,) = struct.unpack_from("<H", data)
    return SetPoints(_places_in(data[2:]), duration_ms)


def _identity_in(data: bytes) -> Identity:
    version, joints, gripper = struct.unpack_from("<BBB", data)
    return Identity(version, joints, _flags(gripper, 1)[0], data[3:].decode("ascii"))


def _encoders_in(data: bytes) -> Encoders:
    timestamp_ms, status = struct.unpack_from("<IB", data)
    return Encoders(timestamp_ms, _status_in(status), _places_in(data[5:]))


def _encoders_bytes(message: Encoders) -> bytes:
    return struct.pack("<IB", message.timestamp_ms, _bits(message.status)) + _place_bytes(message.places)


def _axes_in(data: bytes) -> Axes:
    status, stalled, limit = struct.unpack_from("<BHH", data)
    places = _places_in(data[5:])
    return Axes(_status_in(status), places, _flags(stalled, len(places)), _flags(limit, len(places)))


def _axes_bytes(message: Axes) -> bytes:
    head = struct.pack("<BHH", _bits(message.status), _bits(message.stalled), _bits(message.limit))
    return head + _place_bytes(message.places)


def _error_in(data: bytes) -> Error:
    problem, axis = struct.unpack("<BB", data)
    return Error(Problem(problem), None if axis == NO_AXIS else axis)


def _error_bytes(message: Error) -> bytes:
    return struct.pack("<BB", message.problem, NO_AXIS if message.axis is None else message.axis)


_FORMS: dict[int, _Form] = {
    0x01: _plain(Identify),
    0x02: _plain(Poll),
    0x03: _plain(PollAxes),
    0x04: _Form(SetPoints, lambda m: struct.pack("<H", m.duration_ms) + _place_bytes(m.places), _set_points_in),
    0x05: _plain(Stop),
    0x06: _plain(Clear),
    0x07: _Form(Wake, _wake_bytes, _wake_in),
    0x08: _plain(Limp, "<B"),
    0x09: _plain(Period, "<H"),
    0x81: _Form(Identity, lambda m: bytes((m.version, m.joints, m.gripper)) + m.name.encode("ascii"), _identity_in),
    0x82: _Form(Encoders, _encoders_bytes, _encoders_in),
    0x83: _Form(Axes, _axes_bytes, _axes_in),
    0x84: _Form(Status, lambda m: bytes((_bits(m),)), lambda data: _status_in(*struct.unpack("<B", data))),
    0x85: _Form(Error, _error_bytes, _error_in),
}
_CODES: dict[type, int] = {form.message: code for code, form in _FORMS.items()}


def _check(name: str, value: int, most: int) -> None:
    if not 0 <= value <= most:
        raise SettingError(name, value, tr("a whole number from {least} to {most}", least=0, most=most))


def _check_places(places: Sequence[Place]) -> None:
    if len(places) > MOST_AXES:
        raise SettingError("places", len(places), tr("at most {most} axes", most=MOST_AXES))
    for place in places:
        if place is not None and abs(place) > LARGEST:
            raise SettingError(
                "place", place, tr("a whole number from {least} to {most}", least=-LARGEST, most=LARGEST)
            )
