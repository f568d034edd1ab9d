"""What came of tracking a path: the joints, the points that were reached, and for the others the reason."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from rvsim.errors import ShapeError
from rvsim.kinematics.forward import forward_kinematics
from rvsim.motion.path import Path
from rvsim.motion.turns import existing
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray, frozen_array

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
        jumps: indices of points that follow the point before only by leaving the path (a change of branch).
        solve_seconds: the time it took to find q.
        ignore_limits: whether the joint limits were left out of account.
    """

    robot: Robot
    path: Path
    q: FloatArray
    unreached: tuple[Unreached, ...]
    jumps: tuple[int, ...] = ()
    solve_seconds: float = 0.0
    ignore_limits: bool = False
    reached: NDArray[np.bool_] = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "q", frozen_array("q", self.q, (self.path.samples, self.robot.dof)))
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
    def actual(self) -> FloatArray:
        """(m, 3) where the tool is [m], by forward kinematics; NaN rows where a point was not reached."""
        points = np.full((self.samples, 3), np.nan)
        points[self.reached] = forward_kinematics(self.robot, self.q[self.reached])[:, :3, 3]
        return frozen_array("actual", points, (self.samples, 3))

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

    @property
    def offsets(self) -> FloatArray:
        """(k, 3) from where the tool should be to where it is at the reached points [m], base axes."""
        return np.asarray((self.actual - self.path.points)[self.reached])

    @property
    def seconds_per_point(self) -> float:
        """The solving time divided by the number of points."""
        return self.solve_seconds / self.samples
