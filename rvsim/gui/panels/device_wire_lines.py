"""The log's entries with what is to be known about each: what it answers, whether it is polling. No Qt in here."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator
from functools import lru_cache
from typing import Literal, NamedTuple, TypeAlias

from rvsim.device.bridge.frames import Frame, next_frame
from rvsim.device.bridge.messages import Axes, Encoders, Poll, PollAxes, Stop, decode
from rvsim.device.ssc32.board_side import parse_line
from rvsim.device.ssc32.commands import Move, QueryPulses
from rvsim.device.wire_log import Direction, WireEntry, printable

Language = Literal["ssc32", "bridge"]
SENT: Direction = "→"
_QUESTION = re.compile(rb"[\x1b \t\n]*(?:[QVA-F]|RDFLT|R *\d+ *\r|SS *\r)", re.IGNORECASE)
_POLLING = re.compile(rb"[\x1b \t\n]*(?:Q|(?:V[A-H][ \t]*)+\r|[A-F][A-FL \t]*\r)", re.IGNORECASE)
_NO_PULSE = 10  # in an answer's byte: old firmware adds a channel's offset even where there is no pulse
_SETTLED = 0.2  # [s] after a move an answer to what was asked before it, or in its first frame, says nothing new
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
        wakes: channels that this line moves for the first time since they have pulses: they jump.
    """

    number: int
    entry: WireEntry
    question: bytes | None = None
    polling: bool = False
    whole: bool = True
    stops: bool = False
    latency: float = math.nan
    wakes: frozenset[int] = frozenset()

    @property
    def sent(self) -> bool:
        """Whether it went to the arm."""
        return self.entry.direction == SENT


class Ssc32Reader:
    """Answers carry no name: they belong to the question before them."""

    def __init__(self) -> None:
        self._count = 0
        self._question: Line | None = None
        self._awake = AwakeChannels()

    def feed(self, entries: Iterable[WireEntry]) -> tuple[Line, ...]:
        """The lines of these entries, which come after those of before."""
        return tuple(self._sent(entry) if entry.direction == SENT else self._came(entry) for entry in entries)

    def _sent(self, entry: WireEntry) -> Line:
        data = entry.data
        whole = data.endswith(b"\r")
        asks = whole and _QUESTION.match(data) is not None
        polling = asks and _POLLING.match(data) is not None
        line = Line(self._next(), entry, polling=polling, whole=whole, stops=b"STOP" in data.upper())
        if whole and b"#" in data:
            line = line._replace(wakes=self._awake.moved(data, entry.time))
        if asks:
            self._question = line
        return line

    def _came(self, entry: WireEntry) -> Line:
        asked, self._question = self._question, None
        if asked is None:
            return Line(self._next(), entry)
        self._awake.answered(asked.entry, entry.data)
        latency = max(entry.time - asked.entry.time, 0.0)
        return Line(self._next(), entry, asked.entry.data, asked.polling, latency=latency)

    def _next(self) -> int:
        self._count += 1
        return self._count - 1


class AwakeChannels:
    """Which channels have pulses, as far as a log tells: moves begin them, answers to QP tell of them."""

    def __init__(self) -> None:
        self._awake: set[int] = set()
        self._changed: dict[int, float] = {}  # when a line last moved a channel or let it go limp [s]

    def moved(self, data: bytes, time: float) -> frozenset[int]:
        """The channels that a sent line wakes."""
        move = _parsed(data)
        if not isinstance(move, Move):
            return frozenset()
        going = frozenset(servo.channel for servo in move.servos if servo.pulse_us)
        limp = {servo.channel for servo in move.servos} - going
        wakes = going - self._awake
        self._awake = (self._awake | going) - limp
        self._changed.update(dict.fromkeys(going | limp, time))
        return wakes

    def answered(self, asked: WireEntry, answer: bytes) -> None:
        """A pulse of 0 is none: the power has failed, or somebody else has let the channel go limp."""
        if not asked.data.lstrip(b"\x1b").startswith(b"QP"):
            return
        query = _parsed(asked.data)
        if not isinstance(query, QueryPulses) or len(query.channels) != len(answer):
            return
        for channel, pulse in zip(query.channels, answer, strict=True):
            if asked.time > self._changed.get(channel, -math.inf) + _SETTLED:
                (self._awake.add if pulse > _NO_PULSE else self._awake.discard)(channel)


@lru_cache(maxsize=256)
def _parsed(data: bytes) -> object:
    return parse_line(data.removesuffix(b"\r").rpartition(b"\x1b")[2])


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
