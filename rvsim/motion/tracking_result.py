"""What came of tracking a path: the joints, the points that were reached, and for the others the reason."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from rvsim.errors import ShapeError
from rvsim.kinematics import forward_kinematics
from rvsim.motion.path import Path
from rvsim.motion.turns import existing
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray, frozen_array

_SHARES = np.array([0.25, 0.5, 0.75])

UnreachedKind = Literal["reach", "orientation", "limits"]


@dataclass(frozen=True)
class Unreached:
    """A point that was not reached.

    kind: "reach", the place is out of reach; "orientation", the place is not, but this orientation there is; "limits",
    the arm could, but a joint would leave its limits: then `joint` is its name, `value` what it needs and `limit`
    where it stops [rad, m] (else None, None, None).
    """

    index: int
    kind: UnreachedKind
    joint: str | None = None
    value: float | None = None
    limit: float | None = None


@dataclass(frozen=True, eq=False)
class Tracking:
    """An arm along a path.

    Args:
        q: (m, n) joints [rad, m], unwrapped (no jumps by whole turns); NaN rows where a point was not reached.
        unreached: the points that were not reached, with the reasons.
        actual: (m, 3) where the tool is [m], NaN rows where a point was not reached.
        jumps: indices of points that follow the point before only by leaving the path (a change of branch).
        solve_seconds: the time it took to find q.
        ignore_limits: whether the joint limits were left out of account.
    """

    robot: Robot
    path: Path
    q: FloatArray
    unreached: tuple[Unreached, ...]
    actual: FloatArray
    jumps: tuple[int, ...] = ()
    solve_seconds: float = 0.0
    ignore_limits: bool = False
    reached: NDArray[np.bool_] = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "q", frozen_array("q", self.q, (self.path.samples, self.robot.dof)))
        object.__setattr__(self, "actual", frozen_array("actual", self.actual, (self.path.samples, 3)))
        reached = existing(self.q)
        reached.setflags(write=False)
        object.__setattr__(self, "reached", reached)
        if len(self.unreached) != self.samples - self.reached_count:
            raise ShapeError("unreached", f"({self.samples - self.reached_count},)", (len(self.unreached),))

    @property
    def samples(self) -> int:
        """The number of points, m."""
        return self.path.samples

    @property
    def reached_count(self) -> int:
        """The number of points that were reached."""
        return int(self.reached.sum())

    @property
    def complete(self) -> bool:
        """Whether every point was reached."""
        return bool(self.reached.all())

    @cached_property
    def deviation(self) -> FloatArray:
        """(m,) the distance between where the tool is and where it should be [m], NaN where it is not."""
        return frozen_array("deviation", np.linalg.norm(self.actual - self.path.points, axis=1), (self.samples,))

    @property
    def rms(self) -> float | None:
        """The root of the mean square deviation over the reached points [m], None when there is none."""
        deviation = self.deviation[self.reached]
        return float(np.sqrt(np.mean(deviation**2))) if deviation.size else None

    @property
    def max_deviation(self) -> float | None:
        """The largest deviation over the reached points [m], None when there is none."""
        deviation = self.deviation[self.reached]
        return float(deviation.max()) if deviation.size else None

    @cached_property
    def way_deviation(self) -> float | None:
        """How far the tool leaves the straight way between neighbouring points when the joints move evenly [m].

        The largest of a few places on each way between two reached points that is no jump; None when there is no such
        way. Denser points make it smaller.
        """
        ways = np.flatnonzero(self.reached[:-1] & self.reached[1:])
        ways = ways[~np.isin(ways + 1, self.jumps)]
        if not len(ways):
            return None
        share = _SHARES[:, None, None]
        q = (1.0 - share) * self.q[ways] + share * self.q[ways + 1]
        starts, steps = self.path.points[ways], self.path.points[ways + 1] - self.path.points[ways]
        offsets = forward_kinematics(self.robot, q)[..., :3, 3] - starts
        lengths = np.maximum(np.sum(steps**2, axis=-1), 1e-30)
        along = np.clip(np.sum(offsets * steps, axis=-1) / lengths, 0.0, 1.0)
        return float(np.linalg.norm(offsets - along[..., None] * steps, axis=-1).max())

    @property
    def seconds_per_point(self) -> float:
        """The solving time divided by the number of points."""
        return self.solve_seconds / self.samples
