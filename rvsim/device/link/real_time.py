"""Real time handed on to a wire that reads no clock."""

from __future__ import annotations

import threading
import time

from rvsim.device.link.pacing import PacedArm

_PIECE, _LONGEST = 1.0, 120.0  # [s] at once, and in all after a long silence: two moves of the longest duration


class WallClock:
    """Real time; tests have others."""

    def now(self) -> float:
        """[s] since some moment."""
        return time.monotonic()

    def wait(self, changed: threading.Condition | threading.Event, seconds: float) -> None:
        """Let others work until they have changed something, or so much time has passed [s]."""
        changed.wait(seconds)

    def sleep(self, seconds: float) -> None:
        """Let so much time pass [s]."""
        time.sleep(seconds)


class RealTime:
    """Tells a wire how much time has passed.

    Args:
        wire: to be told.
        now: the time up to which it has been told already [s].
    """

    def __init__(self, wire: PacedArm, now: float) -> None:
        self._wire, self._told = wire, now

    def tell(self, now: float) -> None:
        """It is `now` [s]."""
        left, self._told = min(now - self._told, _LONGEST), now
        while left > 0.0:
            self._wire.process(min(left, _PIECE))
            left -= _PIECE
