"""Where the axes should be by now, from what has been sent: the board interpolates, and so does the belief."""

from __future__ import annotations

from collections import deque

import numpy as np
from numpy.typing import NDArray

from rvsim.robot.arrays import FloatArray

_REMEMBERED = 16  # goals


class Course:
    """Each of m axes from one raw number to another between two times [s]."""

    def __init__(self, axes: int) -> None:
        self.start, self.goal = np.full(axes, np.nan), np.full(axes, np.nan)
        self.begins, self.ends = np.zeros(axes), np.zeros(axes)

    def at(self, time: float) -> FloatArray:
        """(m,) raw numbers at a time [s]."""
        span = np.maximum(self.ends - self.begins, 1e-9)
        part = np.clip((time - self.begins) / span, 0.0, 1.0)
        return np.asarray(self.start + part * (self.goal - self.start))

    def take(self, other: Course, axes: NDArray[np.bool_]) -> None:
        """These axes go as in the other course."""
        for name in ("start", "goal", "begins", "ends"):
            getattr(self, name)[axes] = getattr(other, name)[axes]


class Belief:
    """Raw numbers of m axes over time; NaN where nothing is known: such an axis is asleep."""

    def __init__(self, axes: int) -> None:
        self._course, self._before = Course(axes), Course(axes)  # what was sent last holds when it has arrived
        self._told: deque[tuple[float, FloatArray]] = deque(maxlen=_REMEMBERED)

    @property
    def goal(self) -> FloatArray:
        """(m,) where what was sent leads."""
        return self._course.goal

    @property
    def awake(self) -> NDArray[np.bool_]:
        """(m,) whether each axis holds a place that we know."""
        return np.asarray(np.isfinite(self._course.goal))

    def at(self, time: float) -> FloatArray:
        """(m,) raw numbers at a time [s]."""
        early = (time < self._course.begins) & np.isfinite(self._before.goal)
        return np.where(early, self._before.at(time), self._course.at(time))

    def send(self, raw: FloatArray, arrives: float, seconds: float, wakes_at: FloatArray | None = None) -> None:
        """Axes that are not NaN in raw (m,) were sent there; the line arrives at a time and asks for so many seconds.

        An axis that was asleep begins at `wakes_at` (m,) where that is known, and jumps where not.
        """
        told = np.isfinite(raw)
        here = self.at(arrives)
        if wakes_at is not None:
            here = np.where(np.isfinite(here), here, wakes_at)
        self._before.take(self._course, told)
        self._course.start[told] = np.where(np.isfinite(here), here, raw)[told]
        self._course.goal[told] = raw[told]
        self._course.begins[told], self._course.ends[told] = arrives, arrives + seconds
        self._told.append((arrives + seconds, self.goal.copy()))

    def hold(self, raw: FloatArray) -> None:
        """All axes rest at raw (m,); NaN: asleep."""
        self._course, self._before = Course(len(raw)), Course(len(raw))
        self._course.start, self._course.goal = raw.copy(), raw.copy()
        self._told.clear()

    def sleep(self, axis: int) -> None:
        """Nothing is known of an axis any more."""
        self._course.goal[axis] = self._before.goal[axis] = np.nan

    def moving(self, time: float) -> bool:
        """Whether an axis should still be on its way."""
        return bool(np.any(self.awake & (self._course.ends > time)))

    def between(self, first: float, last: float) -> tuple[FloatArray, FloatArray]:
        """(m,) the least and the largest raw number that each axis may have had between two times."""
        goals = [goal for ends, goal in self._told if ends >= first]
        places = np.stack([self.at(first), self.at(last), *goals])
        return np.fmin.reduce(places), np.fmax.reduce(places)
