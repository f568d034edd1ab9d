"""Bytes from the board to the answers of what was asked. They carry no name: they come in the order of the queries."""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple, TypeAlias

from rvsim.device.ssc32.commands import (
    Query,
    QueryMoving,
    QueryPulses,
    QueryVersion,
    ReadAnalog,
    ReadDigital,
    ReadRegister,
    RestoreRegisters,
    ShowStartup,
)
from rvsim.device.ssc32.lines import CR

Value: TypeAlias = bool | int | str | tuple[bool, ...] | tuple[int, ...] | tuple[float, ...]
MOST_STRAY = 1024  # bytes
PULSE_STEP_US = 10
VOLTS_PER_STEP = 5.0 / 256.0
_LONGEST_TEXT = 256


class Reply(NamedTuple):
    """An answer and what it answers.

    Its value: QueryMoving → bool; QueryPulses → µs a channel (int, 0 = no pulse); ReadDigital → bool an input;
    ReadAnalog → volts an input; ReadRegister → int; QueryVersion, RestoreRegisters, ShowStartup (without its
    quotation marks) → str.
    """

    query: Query
    value: Value


class _Answer(NamedTuple):
    """What the answer to a query looks like: its bytes, when it is whole, and its value (None: it is no answer)."""

    allowed: frozenset[int]
    whole: Callable[[bytes], bool]
    value: Callable[[bytes], Value | None]


_EVERY = frozenset(range(256))
# Old firmware adds the offset of up to 100 µs to a pulse, and perhaps to 0 where there is none. Answers to Q would be
# pulses of 430 µs ("+") and 460 µs ("."): one of these that comes late or twice is not taken for a pulse.
_LARGEST_OFFSET = 10  # in a pulse's byte
_PULSES = frozenset((*range(_LARGEST_OFFSET + 1), *range(50 - _LARGEST_OFFSET, 256))) - frozenset(b"+.")
_TEXT = frozenset((*range(0x20, 0x7F), *CR))


def _bytes(allowed: frozenset[int], count: int, value: Callable[[bytes], Value]) -> _Answer:
    return _Answer(allowed, lambda data: len(data) >= count, value)


def _text(pattern: str, value: Callable[[str], Value] = str) -> _Answer:
    wanted = re.compile(f"({pattern})\r")

    def read(data: bytes) -> Value | None:
        found = wanted.fullmatch(data.decode("ascii"))
        return value(found[1]) if found else None

    return _Answer(_TEXT, lambda data: data.endswith(CR) or len(data) > _LONGEST_TEXT, read)


def _pulse_us(byte: int) -> int:
    return PULSE_STEP_US * byte if byte > _LARGEST_OFFSET else 0


_ANSWERS: dict[type[Any], Callable[[Any], _Answer]] = {
    QueryMoving: lambda _: _bytes(frozenset(b"+."), 1, lambda data: data == b"+"),
    QueryPulses: lambda query: _bytes(_PULSES, len(query.channels), lambda data: tuple(map(_pulse_us, data))),
    ReadDigital: lambda query: _bytes(
        frozenset(b"01"), len(query.inputs), lambda data: tuple(byte == ord("1") for byte in data)
    ),
    ReadAnalog: lambda query: _bytes(
        _EVERY, len(query.inputs), lambda data: tuple(VOLTS_PER_STEP * byte for byte in data)
    ),
    ReadRegister: lambda _: _text(r" *[+-]?\d{1,9} *", int),
    QueryVersion: lambda _: _text(r".+"),
    RestoreRegisters: lambda _: _text(r".+"),
    ShowStartup: lambda _: _text(r'".*"', lambda text: text[1:-1]),
}


class ReplyDecoder:
    """Bytes as they come, in chunks of any size, to the answers of the queries that were announced by `expect`.

    A byte that cannot belong to the oldest open query is stray: it is kept apart, and the query stays open. Nobody but
    the clock can know that an answer will not come any more: its owner calls `forget` then.
    """

    def __init__(self) -> None:
        self._open: deque[tuple[Query, _Answer]] = deque()
        self._partial = b""
        self._stray: deque[int] = deque(maxlen=MOST_STRAY)

    @property
    def pending(self) -> int:
        """How many queries have no answer yet."""
        return len(self._open)

    def expect(self, query: Query) -> None:
        """This query has been sent; its answer comes after those of the queries before it."""
        self._open.append((query, _ANSWERS[type(query)](query)))

    def forget(self) -> None:
        """Nothing is awaited any more; of an answer that came in part its bytes become stray."""
        self._open.clear()
        self._give_up()

    def feed(self, data: bytes) -> tuple[Reply, ...]:
        """The answers that these bytes complete, in order."""
        return tuple(self._replies(data))

    def take_stray(self) -> bytes:
        """The bytes that belong to no query since the last call; the newest 1024 of them."""
        stray = bytes(self._stray)
        self._stray.clear()
        return stray

    def _replies(self, data: bytes) -> Iterator[Reply]:
        for byte in data:
            if self._open and byte in self._open[0][1].allowed:
                self._partial += bytes((byte,))
                yield from self._finished(*self._open[0])
            else:
                self._stray.append(byte)

    def _finished(self, query: Query, answer: _Answer) -> Iterator[Reply]:
        if not answer.whole(self._partial):
            return
        value = answer.value(self._partial)
        if value is None:
            self._give_up()
            return
        self._open.popleft()
        self._partial = b""
        yield Reply(query, value)

    def _give_up(self) -> None:
        self._stray.extend(self._partial)
        self._partial = b""
