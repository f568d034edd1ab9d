"""The log's entries with what is to be known about each: what it answers, whether it is polling. No Qt in here."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from typing import Literal, NamedTuple, TypeAlias

from rvsim.device.bridge.frames import Frame, FrameDecoder
from rvsim.device.bridge.messages import Axes, Encoders, Poll, PollAxes, Stop, decode
from rvsim.device.wire_log import Direction, WireEntry, printable

Language = Literal["ssc32", "bridge"]
SENT: Direction = "→"
_QUESTION = re.compile(rb"[\x1b \t\n]*(?:[QVA-F]|RDFLT|R *\d+ *\r|SS *\r)", re.IGNORECASE)
_POLLING = re.compile(rb"[\x1b \t\n]*(?:Q|V[A-H]|[A-F][A-FL \t]*\r)", re.IGNORECASE)
_POLLS = Poll | PollAxes | Encoders | Axes


class Line(NamedTuple):
    """An entry of the log, a whole line or answer as the driver writes them there.

    Args:
        number: counts the lines of a reader from 0.
        entry: time [s], direction, bytes.
        question: the line that it answers, None if nothing had been asked (or it was sent).
        polling: asks again and again where the arm is, or answers that.
        whole: False for a sent line that was cut off before its end.
        stops: an axis or all of them.
        latency: from the question to its answer [s]; NaN for everything else.
    """

    number: int
    entry: WireEntry
    question: bytes | None = None
    polling: bool = False
    whole: bool = True
    stops: bool = False
    latency: float = math.nan

    @property
    def sent(self) -> bool:
        """Whether it went to the arm."""
        return self.entry.direction == SENT


class Ssc32Reader:
    """Answers carry no name: they belong to the question before them."""

    def __init__(self) -> None:
        self._count = 0
        self._question: Line | None = None

    def feed(self, entries: Iterable[WireEntry]) -> tuple[Line, ...]:
        """The lines of these entries, which come after those of before."""
        return tuple(self._sent(entry) if entry.direction == SENT else self._came(entry) for entry in entries)

    def _sent(self, entry: WireEntry) -> Line:
        data = entry.data
        whole = data.endswith(b"\r")
        asks = whole and _QUESTION.match(data) is not None
        polling = asks and _POLLING.match(data) is not None
        line = Line(self._next(), entry, polling=polling, whole=whole, stops=b"STOP" in data.upper())
        if asks:
            self._question = line
        return line

    def _came(self, entry: WireEntry) -> Line:
        asked, self._question = self._question, None
        if asked is None:
            return Line(self._next(), entry)
        latency = max(entry.time - asked.entry.time, 0.0)
        return Line(self._next(), entry, asked.entry.data, asked.polling, latency=latency)

    def _next(self) -> int:
        self._count += 1
        return self._count - 1


class BridgeReader:
    """Frames of the encoder bridge say themselves what they are."""

    def __init__(self) -> None:
        self._count = 0
        self._asked = math.nan

    def feed(self, entries: Iterable[WireEntry]) -> tuple[Line, ...]:
        """The lines of these entries, which come after those of before."""
        return tuple(map(self._line, entries))

    def _line(self, entry: WireEntry) -> Line:
        latency = math.nan
        if entry.direction == SENT:
            self._asked = entry.time
        else:
            latency, self._asked = max(entry.time - self._asked, 0.0), math.nan
        said = [decode(found) for found in FrameDecoder().feed(entry.data) if isinstance(found, Frame)]
        polling = bool(said) and all(isinstance(message, _POLLS) for message in said)
        stops = any(isinstance(message, Stop) for message in said)
        self._count += 1
        return Line(self._count - 1, entry, polling=polling, whole=bool(said), stops=stops, latency=latency)


Reader: TypeAlias = Ssc32Reader | BridgeReader
READERS: dict[Language, type[Ssc32Reader] | type[BridgeReader]] = {"ssc32": Ssc32Reader, "bridge": BridgeReader}


def shown_bytes(line: Line, language: Language) -> str:
    """The bytes as text; those of frames, which are no text, as hexadecimal numbers."""
    return line.entry.data.hex(" ").upper() if language == "bridge" else printable(line.entry.data)
