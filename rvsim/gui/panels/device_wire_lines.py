"""The log's entries with what is to be known about each: what it answers, whether it is polling. No Qt in here."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator
from typing import Literal, NamedTuple, TypeAlias

from rvsim.device.bridge.frames import Frame, next_frame
from rvsim.device.bridge.messages import Axes, Encoders, Poll, PollAxes, Stop, decode
from rvsim.device.wire_log import Direction, WireEntry, printable

Language = Literal["ssc32", "bridge"]
SENT: Direction = "→"
_QUESTION = re.compile(rb"[\x1b \t\n]*(?:[QVA-F]|RDFLT|R *\d+ *\r|SS *\r)", re.IGNORECASE)
_POLLING = re.compile(rb"[\x1b \t\n]*(?:Q|(?:V[A-H][ \t]*)+\r|[A-F][A-FL \t]*\r)", re.IGNORECASE)
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
    """Frames of the encoder bridge say themselves what they are; a board's answers repeat the number of the question.

    They come as they like: a frame that is not whole yet waits for its rest, and two at once are two lines.
    """

    def __init__(self) -> None:
        self._count = 0
        self._asked: dict[int, float] = {}  # when the question of that number was sent [s]
        self._rest = b""

    def feed(self, entries: Iterable[WireEntry]) -> tuple[Line, ...]:
        """The lines of these entries, which come after those of before."""
        return tuple(line for entry in entries for line in self._lines(entry))

    def _lines(self, entry: WireEntry) -> Iterator[Line]:
        sent = entry.direction == SENT
        rest = entry.data if sent else self._rest + entry.data
        while (cut := next_frame(rest))[0]:
            consumed, found = cut
            yield self._line(entry._replace(data=rest[:consumed]), found if isinstance(found, Frame) else None)
            rest = rest[consumed:]
        if not sent:
            self._rest = rest
        elif rest:
            yield self._line(entry._replace(data=rest), None)

    def _line(self, entry: WireEntry, frame: Frame | None) -> Line:
        number, self._count = self._count, self._count + 1
        if frame is None:
            return Line(number, entry, whole=False)
        said = decode(frame)
        polling, stops = isinstance(said, _POLLS), isinstance(said, Stop)
        return Line(number, entry, polling=polling, stops=stops, latency=self._latency(entry, frame.sequence))

    def _latency(self, entry: WireEntry, sequence: int) -> float:
        if entry.direction == SENT:
            self._asked[sequence] = entry.time
            return math.nan
        return max(entry.time - self._asked.pop(sequence, math.nan), 0.0)


Reader: TypeAlias = Ssc32Reader | BridgeReader
READERS: dict[Language, type[Ssc32Reader] | type[BridgeReader]] = {"ssc32": Ssc32Reader, "bridge": BridgeReader}


def shown_bytes(line: Line, language: Language) -> str:
    """The bytes as text; those of frames, which are no text, as hexadecimal numbers."""
    return line.entry.data.hex(" ").upper() if language == "bridge" else printable(line.entry.data)
