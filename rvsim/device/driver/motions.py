"""What is under way and needs one set-point after the other: following the newest pose, or a trajectory."""

from __future__ import annotations

import math

import numpy as np

from rvsim.device.driver.plan import Plan
from rvsim.robot.arrays import FloatArray

LINGER = 0.5  # [s] at the newest pose, streaming is over
_MOST_OF_A_STEP = 1.5  # a trajectory waits rather than catches up: its time goes on by so many set-points at most


class Following:
    """The newest pose counts. Steps are held to a pace, on a straight way in joint space.

    Args:
        pace: (n,) the most that each joint may move in a second.
    """

    def __init__(self, pace: FloatArray) -> None:
        self._pace = pace
        self._place: FloatArray | None = None
        self._target: FloatArray | None = None
        self._unsent = False
        self._since = math.nan

    def follow(self, target: FloatArray) -> bool:
        """A newer pose (n,); whether it takes the place of one that was never sent."""
        superseded = self._unsent
        self._target, self._unsent, self._since = target, True, math.nan
        return superseded

    def next(self, here: FloatArray, seconds: float) -> FloatArray | None:
        """Where the joints (n,) should be when so many seconds have passed; None: they are there already."""
        if self._target is None or self._is_there:
            self._unsent = False
            return None
        place = here if self._place is None else self._place
        step = self._target - place
        part = min(1.0, 1.0 / max(float(np.max(np.abs(step) / (self._pace * seconds))), 1e-9))
        self._place = self._target.copy() if part >= 1.0 else place + part * step
        self._unsent = False
        return self._place

    def over(self, now: float, moving: bool) -> bool:
        """Whether the newest pose was reached a while ago; where set-points are held up, it waits for them."""
        if moving or self._unsent or not self._is_there:
            self._since = math.nan
        elif math.isnan(self._since):
            self._since = now
        return now - self._since > LINGER

    @property
    def _is_there(self) -> bool:
        return self._place is not None and self._target is not None and np.array_equal(self._place, self._target)


class Running:
    """Along a plan. Where set-points were held up, its time waits: the arm never hurries to catch up."""

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self._elapsed, self._last = plan.begins, math.nan
        self._all_sent = False

    def next(self, now: float, ahead: float, period: float) -> FloatArray | None:
        """The pose (n,) to be sent now: that of `ahead` seconds later, when the arm is there. None: all is sent."""
        if self._all_sent:
            return None
        self._elapsed, self._last = self.time(now, period), now
        self._all_sent = self._elapsed + ahead >= self.plan.duration
        return self.plan.q(self._elapsed + ahead)

    def time(self, now: float, period: float) -> float:
        """The time of the trajectory [s], below 0 on the way to its start; it goes on after the end."""
        if math.isnan(self._last):
            return self._elapsed
        passed = now - self._last
        return self._elapsed + (passed if self._all_sent else min(passed, _MOST_OF_A_STEP * period))

    def shown(self, now: float, period: float) -> float:
        """The time of the trajectory [s], 0…duration."""
        return min(max(self.time(now, period), 0.0), self.plan.duration)

    def over(self, moving: bool) -> bool:
        """Whether the last set-point is sent and reached."""
        return self._all_sent and not moving
