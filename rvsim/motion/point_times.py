"""When a motion passes the points of the path that it follows."""

from __future__ import annotations

import numpy as np

from rvsim.motion.tracking_result import Tracking
from rvsim.motion.trajectory import Stretch, Trajectory
from rvsim.robot.arrays import FloatArray

_HALVINGS = 60


def point_times(trajectory: Trajectory, tracking: Tracking) -> FloatArray | None:
    """The times (k,) [s] at which it passes the reached points first; None for the motion of another path."""
    found: dict[int, float] = {}
    for start, stretch in zip(trajectory.starts, trajectory.stretches, strict=False):
        when = start + _knot_times(stretch)
        for time, q, index in zip(when, stretch.q, stretch.progress, strict=True):
            if index not in found and _is_pose_of(tracking, int(index), q):
                found[int(index)] = float(time)
    reached = np.flatnonzero(tracking.reached).tolist()
    return np.array([found[index] for index in reached]) if found.keys() >= set(reached) else None


def _is_pose_of(tracking: Tracking, index: int, q: FloatArray) -> bool:
    return index < tracking.samples and np.array_equal(tracking.q[index], q)


def _knot_times(stretch: Stretch) -> FloatArray:
    """When its knots are passed [s from its start], by bisection: a law only grows."""
    early, late = np.zeros(len(stretch.knots)), np.ones(len(stretch.knots))
    for _ in range(_HALVINGS):
        middle = 0.5 * (early + late)
        before = stretch.law.q(middle)[:, 0] < stretch.knots
        early, late = np.where(before, middle, early), np.where(before, late, middle)
    late[stretch.knots <= 0.0], late[stretch.knots >= 1.0] = 0.0, 1.0
    return np.asarray(stretch.duration * late)
