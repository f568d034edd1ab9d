"""A whole motion as curves over time: what the joints, the tool and the torques do, at evenly spaced moments."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from rvsim.dynamics import inverse_dynamics
from rvsim.errors import NoMassDataError
from rvsim.kinematics import forward_kinematics, jacobian
from rvsim.motion import Tracking, Trajectory
from rvsim.motion.between import offsets_from_path
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray, frozen_array

_MOST = 4000  # moments: more are not seen on any screen


@dataclass(frozen=True, eq=False)
class Curves:
    """A motion seen at times (m,) [s]; each curve is worked out when it is first asked for.

    Args:
        q, qd, qdd, jerk: (m, n) [rad or m, and s].
        path_index: (m,) how far along the tracked path, NaN on the way to it; None for a motion without a path.
    """

    robot: Robot
    times: FloatArray
    q: FloatArray
    qd: FloatArray
    qdd: FloatArray
    jerk: FloatArray
    tracking: Tracking | None = None
    path_index: FloatArray | None = None

    @cached_property
    def tool(self) -> FloatArray:
        """(m, 4, 4) T_base_tool."""
        return forward_kinematics(self.robot, self.q)

    @property
    def place(self) -> FloatArray:
        """(m, 3) where the tool is [m]."""
        return np.asarray(self.tool[:, :3, 3])

    @cached_property
    def _jacobians(self) -> FloatArray:
        return jacobian(self.robot, self.q)

    @cached_property
    def twist(self) -> FloatArray:
        """(m, 6) the tool's velocity [m/s, rad/s] in base axes, linear first."""
        return np.asarray((self._jacobians @ self.qd[..., None])[..., 0])

    @property
    def speed(self) -> FloatArray:
        """(m,) how fast the tool goes [m/s]."""
        return np.asarray(np.linalg.norm(self.twist[:, :3], axis=1))

    @cached_property
    def sigma_min(self) -> FloatArray:
        """(m,) the smallest singular value of J, lengths in metres."""
        return np.asarray(np.linalg.svd(self._jacobians, compute_uv=False)[:, -1])

    @cached_property
    def torque(self) -> FloatArray | None:
        """(m, n) what the joints must give [N m, N], None for an arm without masses."""
        try:
            return inverse_dynamics(self.robot, self.q, self.qd, self.qdd)
        except NoMassDataError:
            return None

    @cached_property
    def desired(self) -> FloatArray | None:
        """(m, 3) where the path wants the tool [m], NaN on the way to it; None without a path."""
        if self.tracking is None or self.path_index is None:
            return None
        points = self.tracking.path.points
        known = np.arange(len(points), dtype=np.float64)
        wanted = np.stack([np.interp(self.path_index, known, points[:, axis]) for axis in range(3)], axis=1)
        wanted[np.isnan(self.path_index)] = np.nan
        return wanted

    @cached_property
    def offset(self) -> FloatArray | None:
        """(m, 3) from the path to the tool [m], base axes, NaN on the way to it; None without a path.

        Measured from the nearest place on the pieces about where it should be, so that a tool that is only late or
        early on the path does not count as off it.
        """
        if self.tracking is None or self.path_index is None:
            return None
        away = offsets_from_path(self.tracking.path.points, self.place, self.path_index)
        return np.where(np.isnan(self.path_index)[:, None], np.nan, away)

    @property
    def deviation(self) -> FloatArray | None:
        """(m,) how far the tool is from the polyline of the path [m], NaN on the way to it; None without a path."""
        return None if self.offset is None else np.asarray(np.linalg.norm(self.offset, axis=1))


def curves_of(robot: Robot, trajectory: Trajectory, tracking: Tracking | None = None, samples: int = 1000) -> Curves:
    """A trajectory seen at `samples` moments, its beginning and its end among them."""
    times = np.linspace(0.0, trajectory.duration, min(max(samples, 2), _MOST))
    along = None
    if tracking is not None:
        along = np.array([trajectory.path_index(t) if trajectory.phase(t) == "path" else np.nan for t in times])
    return Curves(robot, frozen_array("times", times, (-1,)), *trajectory.at(times), tracking, along)


def largest(values: ArrayLike) -> float:
    """The largest of |values|, NaN left out; 0 for none."""
    found = np.abs(np.asarray(values, np.float64))
    return float(np.nanmax(found)) if np.isfinite(found).any() else 0.0
