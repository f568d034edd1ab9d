"""Whole turns: which copies q + 2πk of an angle lie within limits, and which one is near."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from rvsim.kinematics.inverse.copies import LIMIT_TOLERANCE
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

TURN = 2.0 * np.pi


@dataclass(frozen=True, eq=False)
class JointRange:
    """The limits that count: lower, upper (n,) with a little tolerance, and which joints may turn to another copy."""

    lower: FloatArray
    upper: FloatArray
    revolute: NDArray[np.bool_]

    @staticmethod
    @lru_cache(maxsize=64)
    def of(robot: Robot, ignore_limits: bool) -> JointRange:
        """Of an arm; without limits if they are to be ignored."""
        limits = np.array(robot.limits)
        if ignore_limits:
            limits[:, 0], limits[:, 1] = -np.inf, np.inf
        return JointRange(limits[:, 0] - LIMIT_TOLERANCE, limits[:, 1] + LIMIT_TOLERANCE, robot.is_revolute)

    @cached_property
    def all_revolute(self) -> bool:
        """Whether there are only angles."""
        return bool(self.revolute.all())

    @cached_property
    def periodic(self) -> NDArray[np.bool_]:
        """(n,) whether a joint can reach the same angle again by going on turning."""
        return np.asarray(self.revolute & (self.upper - self.lower >= TURN))

    def nearest_copy(self, q: FloatArray, near: FloatArray) -> FloatArray:
        """q (..., n) turned to the copies nearest to `near` within the limits; nearest to the limits if none is."""
        return q + TURN * np.where(self.revolute, self._turns(q, q, near - q), 0.0)

    def nearest_run(self, q: FloatArray, near: FloatArray) -> FloatArray:
        """A run of poses (k, n) turned as a whole so that it fits and begins as near to `near` (n,) as possible."""
        turns = self._turns(q.min(axis=0), q.max(axis=0), near - q[0])
        return np.asarray(q + TURN * np.where(self.revolute, turns, 0.0))

    def outside(self, q: FloatArray) -> FloatArray:
        """(..., n) how far each joint lies outside its limits, 0 within."""
        return np.asarray(np.maximum(np.maximum(self.lower - q, q - self.upper), 0.0))

    def holds(self, q: FloatArray) -> bool:
        """Whether all of q (..., n) lies within the limits."""
        return not ((q < self.lower).any() or (q > self.upper).any())

    def fits(self, low: FloatArray, high: FloatArray) -> NDArray[np.bool_]:
        """(...) whether runs that span low … high (..., n) fit into the limits after some whole turns."""
        least, most = self._fewest(low), self._most(high)
        straight = (low >= self.lower) & (high <= self.upper)
        return np.asarray(np.where(self.revolute, least <= most, straight).all(axis=-1))

    def _turns(self, low: FloatArray, high: FloatArray, wanted: FloatArray) -> FloatArray:
        """Whole turns nearest to `wanted` that bring low … high inside; where none does, those of the least excess."""
        least, most = self._fewest(low), self._most(high)
        fits = least <= most
        turns = np.minimum(np.maximum(np.rint(wanted / TURN), least), np.maximum(least, most))
        if fits.all():
            return np.asarray(turns)
        with np.errstate(invalid="ignore"):  # without a limit: inf − inf, not used
            # No copy fits: `least` clears the lower stop, a turn less clears the upper one; take what exceeds less.
            excess_above = high + TURN * least - self.upper
            excess_below = self.lower - (low + TURN * (least - 1.0))
        lesser = least - np.where(excess_below < excess_above, 1.0, 0.0)
        return np.asarray(np.where(fits, turns, lesser))

    def _fewest(self, low: FloatArray) -> FloatArray:
        return np.asarray(np.ceil((self.lower - low) / TURN))

    def _most(self, high: FloatArray) -> FloatArray:
        return np.asarray(np.floor((self.upper - high) / TURN))


def existing(q: FloatArray) -> NDArray[np.bool_]:
    """(...) whether poses (..., n) exist: a branch that does not is NaN."""
    finite = np.isfinite(q)
    if finite.all():  # as a rule, and quicker to ask than each pose
        return np.ones(q.shape[:-1], dtype=bool)
    return np.asarray(finite.all(axis=-1))


def nearest_turn(difference: FloatArray, periodic: NDArray[np.bool_]) -> FloatArray:
    """Differences (..., n) of joints; a periodic one goes the short way round."""
    turned = np.rint(difference * (1.0 / TURN))
    turned *= -TURN * periodic
    turned += difference
    return np.asarray(turned)


def whole_turns(q: FloatArray, periodic: NDArray[np.bool_]) -> FloatArray:
    """(k, n) what to add to poses (k, n) so that no periodic joint leaps by a whole turn from one to the next."""
    leaps = np.where(periodic, np.round(np.diff(q, axis=0) / TURN), 0.0)
    return np.concatenate([np.zeros((1, q.shape[1])), -TURN * np.cumsum(leaps, axis=0)])
