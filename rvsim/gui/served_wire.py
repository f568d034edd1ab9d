"""The bytes of a served arm as a log of whole lines and answers, as a driver would write it."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable

from rvsim.device.ssc32.board_side import parse_line
from rvsim.device.ssc32.commands import Query
from rvsim.device.ssc32.replies import ReplyDecoder
from rvsim.device.wire_log import Direction, WireLog

_PATIENCE = 1.0  # [s] until an answer will not come any more
_LONGEST = 4096  # bytes that are kept of a line without an end


class ServedWire:
    """Puts bytes together. Lines that come before an earlier question is answered are written after its answer, with
    their own time: answers carry no name. Used by the server's thread alone; its log may be read by all.

    Args:
        clock: seconds, 0 when serving begins.
    """

    def __init__(self, clock: Callable[[], float]) -> None:
        self.log = WireLog()
        self._clock, self._asked_at = clock, 0.0
        self._decoder = ReplyDecoder()
        self._lines: deque[tuple[float, bytes]] = deque()
        self._line, self._answer = bytearray(), bytearray()

    def add(self, direction: Direction, data: bytes) -> None:
        """Bytes that went to the arm (→) or came from it (←) just now."""
        now = self._clock()
        if self._decoder.pending and now - self._asked_at > _PATIENCE:
            self._give_up(now)
        if direction == "→":
            self._take_sent(data, now)
        else:
            self._take_answer(data, now)

    def _take_sent(self, data: bytes, now: float) -> None:
        self._line += data
        *whole, rest = bytes(self._line).split(b"\r")
        self._lines.extend((now, line + b"\r") for line in whole)
        self._line = bytearray(rest[-_LONGEST:])
        self._write_lines()

    def _take_answer(self, data: bytes, now: float) -> None:
        for byte in data:
            self._answer.append(byte)
            if self._decoder.feed(bytes((byte,))):
                self._write_answer(now)
                self._write_lines()
        if not self._decoder.pending:
            self._write_answer(now)

    def _write_lines(self) -> None:
        while self._lines and not self._decoder.pending:
            time, line = self._lines.popleft()
            self.log.add(time, "→", line)
            query = parse_line(line.removesuffix(b"\r").rpartition(b"\x1b")[2])
            if isinstance(query, Query):
                self._asked_at = time
                self._decoder.expect(query)

    def _write_answer(self, now: float) -> None:
        self.log.add(now, "←", bytes(self._answer))
        self._answer.clear()

    def _give_up(self, now: float) -> None:
        self._decoder.forget()
        self._write_answer(now)
        self._write_lines()
