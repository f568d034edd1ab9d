"""A long path with a free orientation: a few of its points by the closed form, the others warm-started between them.

Of each of the few all branches in all sampled orientations are asked. The best of those that keep their orientation
all the way is taken, as the long way would: between near points another one is a detour. Where none does, it is the
best sequence. The others begin on splines through those joints and are put onto their points by Newton's method with
the least motion (Siciliano et al., Robotics (2009), §3.5.1: the right pseudo-inverse). What comes of it is verified
point by point and step by step; where anything fails the whole path is solved the long way.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from rvsim.kinematics.jacobian import pose_and_jacobian
from rvsim.motion.continuity import continuous_run
from rvsim.motion.laws import spline_through
from rvsim.motion.path import Path
from rvsim.motion.sequence import best_sequence, motion_weights
from rvsim.motion.turns import JointRange, existing, nearest_turn
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

FEW = 97  # points that are solved by the closed form, beside the corners
_MOST_CORNERS = 160
_TRIED = 8  # columns, the shortest first
_STEPS = 12
_ON_THE_POINT = 1e-14  # sizes: nothing is left to correct
_CLOSE_ENOUGH = 1e-12  # sizes: what a verified point may be off
_REGULAR = 1e-12  # of the trace: keeps a stretched arm from dividing by 0

Usable = Callable[[Path], FloatArray]


def coarse_to_fine(robot: Robot, path: Path, near: FloatArray, joints: JointRange, usable: Usable) -> FloatArray | None:
    """Joints (m, n) along a path of free orientation, without jumps; None where it has to be solved the long way.

    Args:
        near: (n,) the present pose.
        usable: the branches (k, s, n) within the limits at the points of a part of the path, a column an orientation.
    """
    few = _few(path)
    if few is None:
        return None
    branches, weights = usable(path.part(few)), motion_weights(robot)
    known = _steady(robot, branches, near, joints, weights)
    if known is None:
        known = best_sequence(robot, branches, near, joints, with_rotation=False).q
    if not existing(known).all() or not continuous_run(robot, known, with_rotation=False).all():
        return None
    q = _on_the_points(robot, path.points, _between(path, few, known), weights)
    if q is None or not joints.holds(q) or not continuous_run(robot, q, with_rotation=False).all():
        return None
    q[few] = known
    return q


def _steady(
    robot: Robot, q: FloatArray, near: FloatArray, joints: JointRange, weights: FloatArray
) -> FloatArray | None:
    """(k, n) the shortest of the columns of q (k, s, n) that never leave the path; None if there is none."""
    q = q[:, existing(q).all(axis=0)]
    ways = nearest_turn(np.diff(q, axis=0), joints.periodic)
    first = np.linalg.norm(weights * (joints.nearest_copy(q[0], near) - near), axis=-1)
    total = first + np.linalg.norm(weights * ways, axis=-1).sum(axis=0)
    for column in np.argsort(total)[:_TRIED].tolist():
        run = np.concatenate([q[:1, column], q[0, column] + np.cumsum(ways[:, column], axis=0)])
        run = joints.nearest_run(run, near)
        if joints.holds(run) and continuous_run(robot, run, with_rotation=False).all():
            return run
    return None


def _few(path: Path) -> NDArray[np.intp] | None:
    """Indices of a few points, evenly along the path, the corners among them; None where there are too many."""
    if len(path.corners) > _MOST_CORNERS:
        return None
    way = _way(path)
    even = np.searchsorted(way, np.linspace(0.0, way[-1], FEW))
    return np.unique(np.concatenate([np.minimum(even, path.samples - 1), path.corners, [0, path.samples - 1]]))


def _way(path: Path) -> FloatArray:
    """(m,) how far along the path each point is [m], growing by a trace where points are the same."""
    steps = np.linalg.norm(np.diff(path.points, axis=0), axis=1)
    least = 1e-6 * max(float(steps.max()), 1e-9)
    return np.concatenate([[0.0], np.cumsum(np.maximum(steps, least))])


def _between(path: Path, few: NDArray[np.intp], known: FloatArray) -> FloatArray:
    """(m, n) where joints that pass `known` (k, n) at those points would be at all of them, from corner to corner."""
    way, q = _way(path), np.empty((path.samples, known.shape[1]))
    ends = np.unique(np.concatenate([[0, path.samples - 1], path.corners]))
    for first, last in pairwise(ends.tolist()):
        rows = np.flatnonzero((few >= first) & (few <= last))
        spline = spline_through(way[few[rows]], known[rows], "not-a-knot" if len(rows) > 3 else "natural")
        q[first : last + 1] = spline.q(way[first : last + 1])
    return q


def _on_the_points(robot: Robot, points: FloatArray, q: FloatArray, weights: FloatArray) -> FloatArray | None:
    """The poses near q (m, n) that put the tool on its points (m, 3), by the least motion; None if some were not found.

    Only those are worked on that are still off.
    """
    left = np.arange(len(q))
    for _ in range(_STEPS):
        T, J = pose_and_jacobian(robot, q[left])
        error = points[left] - T[:, :3, 3]
        off = np.abs(error).max(axis=1)
        still = off > _ON_THE_POINT * robot.size
        if not still.any():
            return q
        left, error = left[still], error[still]
        q[left] += _least_motion(J[still, :3] / weights, error) / weights
    T, _ = pose_and_jacobian(robot, q[left])
    missed = np.abs(points[left] - T[:, :3, 3]).max(initial=0.0)
    return q if missed <= _CLOSE_ENOUGH * robot.size else None


def _least_motion(J: FloatArray, error: FloatArray) -> FloatArray:
    """(k, n) the shortest steps with J (k, 3, n) that make up for errors (k, 3)."""
    normal = J @ J.transpose(0, 2, 1)
    normal += _REGULAR * np.trace(normal, axis1=1, axis2=2)[:, None, None] * np.eye(3)
    pull = np.linalg.solve(normal, error[..., None])
    return np.asarray((J.transpose(0, 2, 1) @ pull)[..., 0])
