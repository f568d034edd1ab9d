"""Every byte that went over the wire, with its time and direction. Written by one thread, read by others."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Iterable
from itertools import islice
from pathlib import Path
from typing import Literal, NamedTuple

from rvsim.errors import FileWriteError
from rvsim.files.atomic import write_atomically

Direction = Literal["→", "←"]
MOST_ENTRIES = 100_000
_NAMED = {ord("\r"): r"\r", ord("\n"): r"\n", ord("\t"): r"\t", ord("\\"): "\\\\"}
_FORMS = tuple(_NAMED.get(byte, chr(byte) if 0x20 <= byte < 0x7F else f"\\x{byte:02x}") for byte in range(256))


class WireEntry(NamedTuple):
    """Bytes that were sent (→) or came (←) at a time [s] of the driver's clock."""

    time: float
    direction: Direction
    data: bytes

    @property
    def printable(self) -> str:
        """Its bytes as text."""
        return printable(self.data)


def printable(data: bytes) -> str:
    r"""Bytes as ASCII, the others as `\r`, `\n`, `\t`, `\\` and `\x1b`. No two byte strings look the same."""
    return "".join(_FORMS[byte] for byte in data)


def text(entries: Iterable[WireEntry]) -> str:
    """One line an entry: time [s], direction, bytes."""
    return "".join(f"{entry.time:10.3f} {entry.direction} {entry.printable}\n" for entry in entries)


class WireLog:
    """The newest entries; older ones than `most` make room. All methods may be called from any thread."""

    def __init__(self, most: int = MOST_ENTRIES) -> None:
        self._entries: deque[WireEntry] = deque(maxlen=most)
        self._count = 0
        self._lock = threading.Lock()

    @property
    def count(self) -> int:
        """How many entries there have ever been."""
        return self._count

    def add(self, time: float, direction: Direction, data: bytes) -> None:
        """Remember bytes that went over the wire at `time` [s]; empty ones are none."""
        if data:
            with self._lock:
                self._entries.append(WireEntry(time, direction, bytes(data)))
                self._count += 1

    def since(self, count: int) -> tuple[int, tuple[WireEntry, ...]]:
        """The count now, and the entries that have come since it was `count`, as far as they are still there.

        A view begins with 0 and asks each time with the count that it got last.
        """
        with self._lock:
            newest = islice(reversed(self._entries), max(self._count - count, 0))
            return self._count, tuple(newest)[::-1]

    def search(self, wanted: str) -> tuple[WireEntry, ...]:
        r"""The entries whose printable bytes contain `wanted`, small letters as capitals; `\r` finds a CR."""
        folded = wanted.casefold()
        return tuple(entry for entry in self.since(0)[1] if folded in entry.printable.casefold())

    def text(self, entries: Iterable[WireEntry] | None = None) -> str:
        """One line an entry: time [s], direction, bytes; of all entries where none are given."""
        return text(self.since(0)[1] if entries is None else entries)

    def save(self, path: Path) -> None:
        """Write all entries to a text file (UTF-8), whole or not at all.

        Raises:
            FileWriteError: it cannot be written.
        """
        try:
            write_atomically(path, self.text().encode("utf-8"))
        except OSError as problem:
            raise FileWriteError(path, (problem.strerror or str(problem)).lower()) from None
