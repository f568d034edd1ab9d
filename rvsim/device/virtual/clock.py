"""Time that is told, never read: whole nanoseconds, so that however it is cut into pieces it is the same time."""

from __future__ import annotations

import math

from rvsim.errors import SettingError
from rvsim.language import tr

NANO = 1_000_000_000
FRAME_NS = 20_000_000  # a hobby servo gets a pulse every 20 ms
FRAME = FRAME_NS / NANO  # [s]
_ROUNDING = 2.0**-51


class Clock:
    """The present in whole nanoseconds; what `advance` is given beyond whole ones is kept for the next time."""

    def __init__(self) -> None:
        self.now = 0
        self._rest = 0.0

    @property
    def seconds(self) -> float:
        """The present [s]."""
        return self.now / NANO

    def advance(self, dt: float) -> int:
        """Let dt [s] pass and return the new present [ns].

        Raises:
            SettingError: dt is negative or no number.
        """
        if not (math.isfinite(dt) and dt >= 0.0):
            raise SettingError("dt", dt, tr("a number of seconds, 0 or more"))
        passed = dt * NANO + self._rest
        whole = round(passed)
        rest = passed - whole
        # What is less than the rounding of long times is none: hours come out whole, and stay so.
        self._rest = rest if abs(rest) > passed * _ROUNDING else 0.0
        self.now += whole
        return self.now


def frame_after(now: int) -> int:
    """The first frame after a time [ns]."""
    return (now // FRAME_NS + 1) * FRAME_NS
