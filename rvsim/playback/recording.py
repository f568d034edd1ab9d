"""What a motion was to be, what was sent and what came back: recorded while it runs, compared afterwards."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rvsim.errors import ShapeError
from rvsim.kinematics import forward_kinematics
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray, frozen_array

MOST_ROWS = 20_000
REPORTED = "commanded pulse"  # a kind that is no measurement: the controller says which pulses it sends
_STOPPED = 0.05  # [s] a motion that was recorded up to less than that before its end was not cut short


class Errors(NamedTuple):
    """Of absolute differences over the moments at which both sides are known; NaN where there is no such moment.

    One number a joint [rad, m], or one of the tool's place [m].
    """

    rms: FloatArray
    max: FloatArray
    mean: FloatArray


@dataclass(frozen=True, eq=False)
class Recording:
    """One motion, seen at times t (k,) [s], increasing or equal; 0 is the start of the trajectory.

    Args:
        desired, commanded, measured: (k, n) [rad, m]; NaN where nothing is known.
        kind: what "measured" is, in words.
        planned: how long the trajectory takes as a whole [s], NaN where that is not known.
        true: (k, n) where the joints of a virtual arm really were; NaN where nothing is known, None for a real arm.

    Raises:
        ShapeError: the arrays do not fit together.
    """

    t: FloatArray
    desired: FloatArray
    commanded: FloatArray
    measured: FloatArray
    kind: str = "nothing"
    planned: float = math.nan
    true: FloatArray | None = None

    def __post_init__(self) -> None:
        t = frozen_array("t", self.t, (-1,))
        object.__setattr__(self, "t", t)
        for name in self.sources:
            values = frozen_array(name, getattr(self, name), (len(t), -1))
            if values.shape != self.desired.shape:
                raise ShapeError(name, str(self.desired.shape), values.shape)
            object.__setattr__(self, name, values)

    @property
    def empty(self) -> bool:
        """Whether nothing was recorded."""
        return not len(self.t)

    @property
    def duration(self) -> float:
        """[s]."""
        return float(self.t[-1]) if len(self.t) else 0.0

    @property
    def sources(self) -> tuple[str, ...]:
        """The names of what is there, joint by joint; "true" only of a virtual arm."""
        return ("desired", "commanded", "measured", *(("true",) if self.true is not None else ()))

    @property
    def is_measured(self) -> bool:
        """Whether "measured" can be a measurement, and not what a controller reports of the pulses that it sends."""
        return self.kind != REPORTED

    @property
    def back_word(self) -> str:
        """What that which came back is to be called."""
        return "measured" if self.is_measured else "reported"

    @property
    def stopped_at(self) -> float | None:
        """When the trajectory was left before its end [s]; None where it was not, or that is not known."""
        return max(self.duration, 0.0) if self.duration < self.planned - _STOPPED else None

    def on_trajectory(self) -> Recording:
        """Without the way to the start of the trajectory and what came after its end."""
        return self._of_rows((self.t >= 0.0) & ~(self.t > self.planned))

    def with_true(self, times: FloatArray, q: FloatArray) -> Recording:
        """With the true poses (j, n) of times (j,) [s], which increase; straight lines in between."""
        if len(times) < 2:
            return self
        joints = [np.interp(self.t, times, column, left=np.nan, right=np.nan) for column in q.T]
        return replace(self, true=np.column_stack(joints))

    def _of_rows(self, rows: NDArray[np.bool_]) -> Recording:
        parts = {name: getattr(self, name)[rows] for name in self.sources}
        return replace(self, t=self.t[rows], **parts)

    @property
    def measured_rows(self) -> NDArray[np.intp]:
        """(j,) the indices of the moments at which every joint was measured."""
        return np.flatnonzero(np.isfinite(self.measured).all(axis=1))

    def joint_errors(self, of: str = "measured", against: str = "desired") -> Errors:
        """(n,) each: how far one of "desired", "commanded", "measured" is from another."""
        return _errors(np.abs(getattr(self, of) - getattr(self, against)))

    def tool_path(self, robot: Robot, of: str) -> FloatArray:
        """(k, 3) where the tool was [m], NaN where a joint is not known."""
        q = getattr(self, of)
        known = np.isfinite(q).all(axis=1)
        places = np.full((len(q), 3), np.nan)
        if known.any():
            places[known] = forward_kinematics(robot, q[known])[:, :3, 3]
        return places

    def tool_distances(self, robot: Robot, of: str = "measured", against: str = "desired") -> FloatArray:
        """(k,) how far apart the two tools are at the same moment [m], NaN where one is not known."""
        apart = self.tool_path(robot, of) - self.tool_path(robot, against)
        return np.asarray(np.linalg.norm(apart, axis=1))

    def tool_errors(self, robot: Robot, of: str = "measured", against: str = "desired") -> Errors:
        """Of the distances between the two tools at the same moments [m]; arrays without axes."""
        return _errors(self.tool_distances(robot, of, against))


def _errors(differences: FloatArray) -> Errors:
    """Over the first axis, leaving NaN out; no warning where there is nothing."""
    known = np.isfinite(differences)
    count = known.sum(axis=0)
    filled = np.where(known, differences, 0.0)
    some = np.maximum(count, 1)
    rms, mean = np.sqrt((filled**2).sum(axis=0) / some), filled.sum(axis=0) / some
    largest = filled.max(axis=0, initial=0.0)
    return Errors(*(np.where(count > 0, value, np.nan) for value in (rms, largest, mean)))


class Recorder:
    """Takes rows while a motion runs, in a fixed amount of memory.

    A motion that is longer than expected is kept as a whole: every other pair of rows is dropped, and from then on only
    each second new pair taken, and so on. Pairs, because set-points and measurements often come in turn.

    Args:
        joints: n.
        rows: how many at most; at least 4.
    """

    def __init__(self, joints: int, rows: int = MOST_ROWS) -> None:
        self._table = np.empty((rows - rows % 4, 1 + 3 * joints))
        self._joints = joints
        self.clear()

    def __len__(self) -> int:
        return self._count

    def clear(self, planned: float = math.nan) -> None:
        """Begin anew, with a trajectory of that duration [s]."""
        self._planned = planned
        self._count, self._stride, self._offered = 0, 1, 0

    def add(self, t: float, desired: FloatArray, commanded: FloatArray, measured: FloatArray | None = None) -> None:
        """One moment: poses (n,) [rad, m]; None: nothing was measured just then. Moments need not come in order."""
        pair, self._offered = self._offered // 2, self._offered + 1
        if pair % self._stride:
            return
        if self._count == len(self._table):
            self._thin()
        row = self._table[self._count]
        n = self._joints
        row[0] = t
        row[1 : 1 + n], row[1 + n : 1 + 2 * n] = desired, commanded
        row[1 + 2 * n :] = np.nan if measured is None else measured
        self._count += 1

    def _thin(self) -> None:
        kept = self._table[np.arange(self._count) // 2 % 2 == 0]
        self._table[: len(kept)] = kept
        self._count, self._stride = len(kept), 2 * self._stride

    def recording(self, kind: str = "nothing") -> Recording:
        """What has been taken so far; a copy that does not change any more."""
        n, table = self._joints, self._table[: self._count]
        table = table[np.argsort(table[:, 0], kind="stable")]
        columns = (table[:, 1 : 1 + n], table[:, 1 + n : 1 + 2 * n], table[:, 1 + 2 * n :])
        return Recording(table[:, 0], *columns, kind, self._planned)
