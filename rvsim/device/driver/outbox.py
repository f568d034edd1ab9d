"""What is to be written, no faster than the wire carries it: one line at a time, in small pieces."""

from __future__ import annotations

BITS = 10  # of a byte with its start and stop bit
AHEAD = 0.016  # [s] so much may lie in the system's buffers: enough for an uneven thread, little enough for a stop


class Outbox:
    """One line at a time. What has not been taken can still be thrown away.

    Args:
        baud: [bit/s].
    """

    def __init__(self, baud: int) -> None:
        self._byte = BITS / baud
        self._rest = b""
        self._until = 0.0  # when what has been taken will be through [s]
        self.sent = 0

    def seconds(self, count: int) -> float:
        """How long so many bytes take [s]."""
        return count * self._byte

    @property
    def until(self) -> float:
        """When all that is in it or has been taken will be through, if taken without delay [s]."""
        return self._until + self.seconds(len(self._rest))

    @property
    def empty(self) -> bool:
        """Whether nothing waits to be taken."""
        return not self._rest

    def free(self, now: float) -> bool:
        """Whether the next line may be put in: nothing waits, and the wire is at rest but for a moment."""
        return not self._rest and self._until <= now + self._byte

    def put(self, line: bytes, now: float) -> None:
        """The next line."""
        self._rest += line
        self._until = max(self._until, now)

    def take(self, now: float) -> bytes:
        """As many bytes as the wire has room for."""
        start = max(self._until, now)
        room = int((now + AHEAD - start) / self._byte + 1e-9)
        piece, self._rest = self._rest[: max(room, 0)], self._rest[max(room, 0) :]
        if piece:
            self._until = start + self.seconds(len(piece))
            self.sent += len(piece)
        return piece

    def clear(self, now: float) -> None:
        """Throw away what waits; what lies in the system's buffers is thrown away by whoever owns the port."""
        self._rest = b""
        self._until = now

    def take_all(self, now: float) -> bytes:
        """Everything at once: for what is urgent."""
        piece, self._rest = self._rest, b""
        self._until = max(self._until, now) + self.seconds(len(piece))
        self.sent += len(piece)
        return piece
