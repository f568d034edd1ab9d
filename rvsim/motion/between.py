"""How far a motion leaves its path between the points that it passes exactly."""

from __future__ import annotations

import numpy as np

from rvsim.kinematics import forward_kinematics
from rvsim.motion.tracking_result import Tracking
from rvsim.motion.trajectory import Trajectory
from rvsim.robot.arrays import FloatArray

_SHARES = np.linspace(0.0, 1.0, 6)[1:-1]


def way_deviation(trajectory: Trajectory, tracking: Tracking) -> float | None:
    """The largest distance between the tool and the straight way between neighbouring points of the path [m].

    Asked at a few places of each piece of the splines that the joints follow. Ways that leave the path on purpose, at
    a jump or over missed points, do not count; None when there are no others. Denser points make it smaller.
    """
    pieces = [_on_pieces(trajectory, number) for number in range(len(trajectory.stretches))]
    q, index = (np.concatenate(part) for part in zip(*pieces, strict=True))
    if not len(q):
        return None
    points, place = tracking.path.points, forward_kinematics(tracking.robot, q)[:, :3, 3]
    neighbours = (np.clip(index + shift, 0, len(points) - 2) for shift in (-1, 0, 1))
    return float(np.min([_distances(place, points[i], points[i + 1]) for i in neighbours], axis=0).max())


def _on_pieces(trajectory: Trajectory, number: int) -> tuple[FloatArray, FloatArray]:
    """Poses (k, n) between the knots of a stretch, and the index (k,) of the path's point before each."""
    stretch = trajectory.stretches[number]
    ways = np.flatnonzero(np.diff(stretch.progress) == 1.0) if stretch.phase == "path" else np.empty(0, dtype=int)
    starts, steps = stretch.knots[ways, None], np.diff(stretch.knots)[ways, None]
    q = stretch.way.at((starts + _SHARES * steps).ravel()).q
    return q, np.repeat(stretch.progress[ways].astype(int), len(_SHARES))


def _distances(places: FloatArray, starts: FloatArray, ends: FloatArray) -> FloatArray:
    """(m,) from places (m, 3) to the pieces from starts to ends (m, 3)."""
    steps, offsets = ends - starts, places - starts
    along = np.sum(offsets * steps, axis=1) / np.maximum(np.sum(steps**2, axis=1), 1e-30)
    return np.asarray(np.linalg.norm(offsets - np.clip(along, 0.0, 1.0)[:, None] * steps, axis=1))
