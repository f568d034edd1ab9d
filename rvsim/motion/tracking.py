"""From a path to the joints: every branch at every point by the closed form, then the best sequence through them."""

from __future__ import annotations

from dataclasses import replace
from time import perf_counter

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rvsim.kinematics.forward import forward_kinematics
from rvsim.motion.candidates import branches_on, thinned
from rvsim.motion.continuity import continuous
from rvsim.motion.path import Path
from rvsim.motion.reasons import limit_culprit
from rvsim.motion.sequence import best_sequence
from rvsim.motion.tracking_result import Tracking, Unreached, UnreachedKind
from rvsim.motion.turns import JointRange, existing
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray, frozen_array

__all__ = ["Tracking", "Unreached", "UnreachedKind", "track"]


def track(robot: Robot, path: Path, *, near: ArrayLike | None = None, ignore_limits: bool = False) -> Tracking:
    """The joints along a path by the arm's closed form: most points first, then no jumps, then the least motion.

    An arm of fewer than six joints does its own task (DESIGN: a 5R arm needs the tool axis in its vertical plane, an
    arm of three joints places the tool and turns it as it must). A free orientation is sampled.

    Args:
        near: (n,) the present pose, from which the motion counts; None for home.
        ignore_limits: leave the joint limits out of account.

    Raises:
        NoClosedFormError: the arm has no closed form.
        ShapeError: `near` has another shape.
    """
    start = perf_counter()
    present = robot.home if near is None else frozen_array("near", near, (robot.dof,))
    joints = JointRange.of(robot, ignore_limits)
    branches = branches_on(robot, path, present)
    usable = thinned(_within(branches, present, joints), present, joints)
    with_rotation = path.rotations is not None and robot.dof > 3
    q = best_sequence(robot, usable, present, joints, with_rotation)
    elapsed = perf_counter() - start
    return Tracking(
        robot,
        path,
        q,
        unreached=_reasons(robot, path, branches, q, present),
        actual=_tool_points(robot, q),
        jumps=find_jumps(robot, q, with_rotation),
        solve_seconds=elapsed,
        ignore_limits=ignore_limits,
    )


def find_jumps(robot: Robot, q: FloatArray, with_rotation: bool) -> tuple[int, ...]:
    """The indices of poses (m, n) that follow the pose before only by leaving the tool's straight way."""
    pairs = np.flatnonzero(existing(q[1:] + q[:-1]))
    return tuple(int(i) + 1 for i in pairs[~continuous(robot, q[pairs], q[pairs + 1], with_rotation)])


def _within(branches: FloatArray, near: FloatArray, joints: JointRange) -> FloatArray:
    """The branches (m, s, n) as copies within the limits, NaN rows where no copy is."""
    copies = joints.nearest_copy(branches, near)
    outside = np.any(joints.outside(copies) > 0.0, axis=-1, keepdims=True)
    return np.where(outside, np.nan, copies)


def _tool_points(robot: Robot, q: FloatArray) -> FloatArray:
    """(m, 3) where the tool is, NaN where q is."""
    points = np.full((len(q), 3), np.nan)
    known = existing(q)
    points[known] = forward_kinematics(robot, q[known])[:, :3, 3]
    return points


def _reasons(robot: Robot, path: Path, branches: FloatArray, q: FloatArray, near: FloatArray) -> tuple[Unreached, ...]:
    missed = np.flatnonzero(~existing(q))
    exists = _some_branch(branches)
    reachable = _reachable_places(robot, path, missed[~exists[missed]], near)
    return tuple(
        limit_culprit(robot, int(i), branches[i])
        if exists[i]
        else Unreached(int(i), "orientation" if i in reachable else "reach")
        for i in missed
    )


def _reachable_places(robot: Robot, path: Path, indices: NDArray[np.intp], near: FloatArray) -> frozenset[int]:
    """Those of the points that the tool could reach in some other orientation, limits left out of account."""
    if path.rotations is None or not len(indices):
        return frozenset()
    free = replace(path, points=path.points[indices], rotations=None)
    exists = _some_branch(branches_on(robot, free, near))
    return frozenset(int(i) for i in indices[exists])


def _some_branch(branches: FloatArray) -> NDArray[np.bool_]:
    """(m,) whether a point has any branch."""
    return np.asarray(existing(branches).any(axis=1))
