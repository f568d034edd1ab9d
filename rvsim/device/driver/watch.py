"""Does the board do what it was told? What it reports is held against what should be, without nerves, without sleep."""

from __future__ import annotations

import numpy as np

from rvsim.device.driver.belief import Belief
from rvsim.language import tr, tr_later
from rvsim.robot.arrays import FloatArray

FORGOTTEN = tr_later(
    "The controller has forgotten where its servos are, as after a brown-out: the supply may be too weak. "
    "All joints are asleep again; wake them one after the other."
)
_STRIKES = 3
_MARGIN = 0.1  # [s] a board needs some frames until it reports what it was just told


class Watch:
    """Remembers when axes were woken, and how often in a row a report was wrong."""

    def __init__(self, axes: int) -> None:
        self._woken, self._steady = np.full(axes, np.inf), np.full(axes, np.inf)
        self._strikes = 0

    def woke(self, axes: FloatArray, now: float, seconds: float) -> None:
        """Those of axes (m,) that are not NaN were told to wake, and in so many seconds to be where they were sent."""
        self._woken[np.isfinite(axes)] = now
        self._steady[np.isfinite(axes)] = now + seconds
        self._strikes = 0

    def forgotten(self, belief: Belief, reported: FloatArray, asked: float) -> bool:
        """Whether an axis (m,) that should hold has no pulse, though the question came well after it woke."""
        settled = self._woken + _MARGIN < asked
        return bool(np.any(belief.awake & settled & np.isnan(reported)))

    def astray(
        self, belief: Belief, reported: FloatArray, asked: float, now: float, tolerance: FloatArray
    ) -> int | None:
        """The axis that is, for the third time in a row, far from all places where it should have been lately."""
        least, most = belief.between(asked - _MARGIN, now)
        settled = self._steady + _MARGIN < asked
        excess = np.maximum(least - reported, reported - most) - tolerance
        excess = np.where(settled & np.isfinite(excess), excess, -np.inf)
        worst = int(np.argmax(excess))
        self._strikes = self._strikes + 1 if excess[worst] > 0.0 else 0
        return worst if self._strikes >= _STRIKES else None


def disobeyed(name: str, should: str, reported: str) -> str:
    """What to say then."""
    return tr(
        "The controller does not do what it is told: {joint} should be at {should}, it reports {reported}. "
        "Another program may use it, or lines get lost.",
        joint=name,
        should=should,
        reported=reported,
    )
