"""What happens to bytes between a board and its port: answers take a moment, and faults of the wire do their work."""

from __future__ import annotations

import random
from collections import deque

from rvsim.device.virtual.clock import NANO
from rvsim.device.virtual.faults import (
    BUFFER_BYTES,
    BUFFER_RATE,
    CORRUPTED_SHARE,
    LATENESS,
    NO_FAULTS,
    SPLIT_PAUSE,
    Fault,
    Faults,
)

MOST_PIECES = 4096  # answers that nobody reads are forgotten, the oldest first
ANSWER_DELAY = 600_000  # [ns] the manual's transmit delay


class Wire:
    """Both directions; times are those of the arm [ns]."""

    def __init__(self) -> None:
        self._under_way: deque[tuple[int, bytes]] = deque(maxlen=MOST_PIECES)
        self._filled, self._filled_at = 0.0, 0
        self.use(NO_FAULTS)

    def use(self, faults: Faults) -> None:
        """From now on these faults; what is random in them begins anew."""
        self._faults = faults
        self._dice = random.Random(f"wire {faults.seed}")
        if Fault.PORT_VANISHES in faults:
            self.clear()

    def clear(self) -> None:
        """Answers that are under way are lost."""
        self._under_way.clear()

    def to_board(self, data: bytes, now: int) -> bytes:
        """What of these bytes gets to the board."""
        if Fault.PORT_VANISHES in self._faults:
            return b""
        if Fault.WRONG_BAUD in self._faults:
            data = self._garbage(data)
        return self._fitting(data, now) if Fault.SATURATED_BUFFER in self._faults else data

    def from_board(self, data: bytes, now: int) -> None:
        """The board answers now."""
        if not data or Fault.NO_REPLY in self._faults or Fault.PORT_VANISHES in self._faults:
            return
        at = now + ANSWER_DELAY + (int(LATENESS * NANO) if Fault.LATE_REPLY in self._faults else 0)
        for piece in self._pieces(self._spoilt(data)):
            self._under_way.append((at, piece))
            at += int(SPLIT_PAUSE * NANO)

    def read(self, now: int) -> bytes:
        """The answers that have come by now."""
        come = bytearray()
        while self._under_way and self._under_way[0][0] <= now:
            come += self._under_way.popleft()[1]
        return bytes(come)

    def _spoilt(self, data: bytes) -> bytes:
        if Fault.CORRUPTED_REPLY in self._faults:
            data = bytes(map(self._corrupted, data))
        if Fault.WRONG_BAUD in self._faults:
            data = self._garbage(data)
        return data * 2 if Fault.DUPLICATED_REPLY in self._faults else data

    def _corrupted(self, byte: int) -> int:
        return byte ^ 1 << self._dice.randrange(8) if self._dice.random() < CORRUPTED_SHARE else byte

    def _garbage(self, data: bytes) -> bytes:
        """As at a wrong speed: bytes above 127, so that by no chance a line comes out."""
        return bytes(0x80 | self._dice.randrange(128) for _ in data)

    def _pieces(self, data: bytes) -> list[bytes]:
        if Fault.SPLIT_REPLY not in self._faults:
            return [data]
        return [data[index : index + 1] for index in range(len(data))]

    def _fitting(self, data: bytes, now: int) -> bytes:
        emptied = (now - self._filled_at) / NANO * BUFFER_RATE
        self._filled, self._filled_at = max(self._filled - emptied, 0.0), now
        room = max(int(BUFFER_BYTES - self._filled), 0)
        self._filled += len(data[:room])
        return data[:room]
