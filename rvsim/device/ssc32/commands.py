"""What can be said to an SSC-32, as values. Pulses are µs and times ms, as on the wire.

Sources: Lynxmotion, "SSC-32 User Guide" (firmware 2.04GP) and "SSC-32U User Guide"; facts that the manuals leave out
are those of the vendor's forum.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, TypeAlias


class ServoMove(NamedTuple):
    """One servo of a move: `pulse_us` 0 switches it off (limp); `speed` is "not faster than" [µs/s]."""

    channel: int
    pulse_us: int
    speed: int | None = None


@dataclass(frozen=True)
class Move:
    """`#5P1600S750#6P1500T2000`: all servos start and end together, in at least `time_ms`."""

    servos: tuple[ServoMove, ...]
    time_ms: int | None = None


@dataclass(frozen=True)
class SetOffsets:
    """`#5PO15`: (channel, µs) pairs, ±100 µs."""

    offsets: tuple[tuple[int, int], ...]


@dataclass(frozen=True)
class SetLevels:
    """`#3H`: (channel, high) pairs: the pin is a switch, not a servo."""

    levels: tuple[tuple[int, bool], ...]


@dataclass(frozen=True)
class SetByte:
    """`#0:123`: eight pins of a bank at once."""

    bank: int
    value: int


@dataclass(frozen=True)
class QueryMoving:
    """`Q`: one byte, "." finished or "+" moving."""


@dataclass(frozen=True)
class QueryPulses:
    """`QP5`: one binary byte a channel, the commanded pulse / 10 µs."""

    channels: tuple[int, ...]


@dataclass(frozen=True)
class ReadDigital:
    """`A B CL`: (input 0…5, latched) pairs, one "0" or "1" each."""

    inputs: tuple[tuple[int, bool], ...]


@dataclass(frozen=True)
class ReadAnalog:
    """`VA VB`: inputs 0…7, one binary byte each, V = byte · 5 / 256."""

    inputs: tuple[int, ...]


@dataclass(frozen=True)
class QueryVersion:
    """`VER`: a text and CR."""


@dataclass(frozen=True)
class Stop:
    """`STOP5`: that servo stops where it is."""

    channel: int


@dataclass(frozen=True)
class ReadRegister:
    """`R4`: a number and CR."""

    register: int


@dataclass(frozen=True)
class WriteRegister:
    """`R4=115`: acts at the next power cycle."""

    register: int
    value: int


@dataclass(frozen=True)
class RestoreRegisters:
    """`RDFLT`: all registers as they left the factory; "OK" and CR after more than a second."""


@dataclass(frozen=True)
class ShowStartup:
    """`SS`: the startup text and CR."""


@dataclass(frozen=True)
class AppendStartup:
    """`SSCAT text`: more at the end of the startup text."""

    text: str


@dataclass(frozen=True)
class DeleteStartup:
    """`SSDEL 3`: so many characters off its end."""

    count: int


Query: TypeAlias = (
    QueryMoving | QueryPulses | ReadDigital | ReadAnalog | QueryVersion | ReadRegister | RestoreRegisters | ShowStartup
)
Command: TypeAlias = (
    Move | SetOffsets | SetLevels | SetByte | Stop | WriteRegister | AppendStartup | DeleteStartup | Query
)
