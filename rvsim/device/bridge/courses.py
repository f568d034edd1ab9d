"""The axes of the virtual bridge: straight from place to place, all together, never quicker than they can."""

from __future__ import annotations

import numpy as np

from rvsim.device.virtual.clock import NANO
from rvsim.device.virtual.contract import BoolArray
from rvsim.robot.arrays import FloatArray

_ROUNDING = 1e-4  # a place on the wire is a hundredth of a degree, of a millimetre, of a percent


class Courses:
    """Where each of m axes is told to be, as a function of time [ns]; values are q [rad, m] and the opening.

    Args:
        lower, upper: (m,) limits.
        speed: (m,) top speeds [1/s].
    """

    def __init__(self, lower: FloatArray, upper: FloatArray, speed: FloatArray) -> None:
        self._lower, self._upper, self._speed = lower, upper, speed
        count = len(speed)
        self._start, self.end = np.full(count, np.nan), np.full(count, np.nan)
        self._begins, self._ends = np.zeros(count, dtype=np.int64), np.zeros(count, dtype=np.int64)
        self.limited = np.zeros(count, dtype=np.bool_)

    @property
    def awake(self) -> BoolArray:
        """(m,) which axes are powered."""
        return np.asarray(np.isfinite(self.end))

    def at(self, now: int) -> FloatArray:
        """(m,) where the axes are told to be; NaN where they are asleep."""
        span = np.maximum(self._ends - self._begins, 1)
        part = np.where(now >= self._ends, 1.0, np.clip((now - self._begins) / span, 0.0, 1.0))
        return np.asarray(self._start + part * (self.end - self._start))

    def moving(self, now: int) -> BoolArray:
        """(m,) which axes are under way."""
        return np.asarray(self.awake & (self._ends > now))

    def resting(self, now: int) -> FloatArray:
        """(m,) for how long the axes have been told the same [s]; negative while they are under way."""
        return np.asarray((now - self._ends) / NANO)

    def go(self, values: FloatArray, now: int, seconds: float) -> None:
        """Awake axes to values (m,), NaN: go on as before; together, in `seconds` or as long as the slowest needs."""
        told = np.isfinite(values)
        here = self.at(now)
        aims = np.clip(values, self._lower, self._upper)
        needed = np.abs(aims - here)[told] / self._speed[told]
        duration = max(seconds, float(needed.max(initial=0.0)))
        self._start[told], self.end[told] = here[told], aims[told]
        self._begins[told], self._ends[told] = now, now + round(duration * NANO)
        self.limited[told] = (np.abs(aims - values) > _ROUNDING)[told]

    def wake(self, axis: int, value: float, now: int) -> None:
        """Power a sleeping axis where it is."""
        self._start[axis] = self.end[axis] = value
        self._begins[axis] = self._ends[axis] = now
        self.limited[axis] = False

    def sleep(self, axis: int) -> None:
        """Switch an axis off."""
        self._start[axis] = self.end[axis] = np.nan
        self.limited[axis] = False

    def stop(self, now: int) -> None:
        """All axes stay where they are told to be now."""
        here, under_way = self.at(now), self.moving(now)
        self._start[under_way] = self.end[under_way] = here[under_way]
        self._begins[under_way] = self._ends[under_way] = now
