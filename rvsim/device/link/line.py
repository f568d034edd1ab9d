"""One direction of a wire: bytes one after the other, ten bits each, and what a receiver at another rate makes of them.

Asynchronous serial, 8N1: the line rests high; a byte is a low start bit, eight data bits, the least first, and a high
stop bit.
"""

from __future__ import annotations

from collections import deque

from rvsim.device.virtual.clock import NANO

BITS = 10  # of a byte with its start and stop bit


def bit_time(baud: int) -> float:
    """How long a bit takes [ns]."""
    return NANO / baud


class Line:
    """Bytes on their way.

    Args:
        baud: of the sender [bit/s].
        heard_at: the receiver's rate [bit/s]; where it is another one, what arrives is garbage.
    """

    def __init__(self, baud: int, heard_at: int) -> None:
        self._queue: deque[int] = deque()
        self._under_way = -1  # a byte, or −1 where the line rests
        self.arrives = 0  # when it will have arrived [ns]
        self.set_rates(baud, heard_at)

    def set_rates(self, baud: int, heard_at: int) -> None:
        """From the next byte on."""
        self._byte_ns = round(BITS * bit_time(baud))
        self._receiver = None if baud == heard_at else Receiver(bit_time(baud), bit_time(heard_at))

    @property
    def resting(self) -> bool:
        """Whether nothing is under way."""
        return self._under_way < 0

    @property
    def waiting(self) -> int:
        """How many bytes have not arrived."""
        return len(self._queue) + (not self.resting)

    def send(self, data: bytes, now: int) -> None:
        """Bytes are handed to the sender at a time [ns]."""
        self._queue.extend(data)
        if self.resting:
            self._start(now)

    def cancel(self) -> None:
        """Forget what has not begun; a byte under way cannot be called back."""
        self._queue.clear()

    def arrive(self) -> bytes:
        """End the byte under way and begin the next one; what the receiver got."""
        byte, self._under_way = self._under_way, -1
        self._start(self.arrives)
        return bytes((byte,)) if self._receiver is None else b""

    def misheard(self, now: int) -> bytes:
        """What a receiver at another rate has made of the line by now."""
        return b"" if self._receiver is None else self._receiver.heard(now)

    def _start(self, now: int) -> None:
        if not self._queue:
            return
        self._under_way, self.arrives = self._queue.popleft(), now + self._byte_ns
        if self._receiver is not None:
            self._receiver.see(now, self._under_way)


class Receiver:
    """A receiver that looks at the line in the middles of its own bits, which are not the sender's.

    It waits for a fall of the line, takes the eight samples after the start bit for a byte, and minds no framing error,
    as the controllers of small boards do.

    Args:
        sent_bit: the sender's bit [ns].
        bit: the receiver's bit [ns].
    """

    def __init__(self, sent_bit: float, bit: float) -> None:
        self._sent_bit, self._bit = sent_bit, bit
        self._seen: deque[tuple[int, int]] = deque()  # begin [ns] and frame of each byte on the line
        self._ready = 0.0  # when it looks for a start bit again [ns]

    def see(self, start: int, byte: int) -> None:
        """A byte begins on the line [ns]."""
        self._seen.append((start, byte << 1 | 1 << BITS - 1))

    def heard(self, now: int) -> bytes:
        """The bytes that it has taken by now [ns]."""
        heard = bytearray()
        while (fall := self._next_fall()) is not None and fall + (BITS - 0.5) * self._bit <= now:
            samples = [self._level(fall + (index + 0.5) * self._bit) for index in range(BITS)]
            started = not samples[0]
            if started:
                heard.append(sum(level << index for index, level in enumerate(samples[1:-1])))
            self._ready = fall + (BITS - 0.5 if started else 0.5) * self._bit
        return bytes(heard)

    def _next_fall(self) -> float | None:
        """When the line falls for the next time [ns]; forgets the bytes before."""
        while self._seen:
            start, frame = self._seen[0]
            before = 1
            for index in range(BITS):
                level = frame >> index & 1
                fall = start + index * self._sent_bit
                if before and not level and fall >= self._ready:
                    return fall
                before = level
            self._seen.popleft()
        return None

    def _level(self, time: float) -> int:
        for start, frame in self._seen:
            if start <= time < start + BITS * self._sent_bit:
                return frame >> min(int((time - start) / self._sent_bit), BITS - 1) & 1
        return 1
