"""From a path to the joints: every branch at every point by the closed form, then the best sequence through them."""

from __future__ import annotations

from time import perf_counter

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rvsim.motion.candidates import branches_on, useful_columns
from rvsim.motion.coarse_to_fine import coarse_to_fine
from rvsim.motion.continuity import continuous
from rvsim.motion.path import Path
from rvsim.motion.reasons import limit_culprit
from rvsim.motion.sequence import Sequence, best_sequence
from rvsim.motion.tracking_result import Tracking, Unreached, UnreachedKind
from rvsim.motion.turns import JointRange, existing
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray, frozen_array

# How many points are solved at a time, and how many sampled branches of a point go into the choice: they enter squared.
_BLOCK = 256
_MOST = 48
# With so many joints a free orientation is sampled; from how many points on a few of them are solved first.
_SAMPLED, _LONG = (5, 6), 256

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
    with_rotation = path.rotations is not None and robot.dof > 3
    q, sure = _sequence(robot, path, present, joints, with_rotation)
    elapsed = perf_counter() - start
    return Tracking(
        robot,
        path,
        q,
        unreached=_reasons(robot, path, np.flatnonzero(~existing(q)), present),
        jumps=() if sure else find_jumps(robot, q, with_rotation),
        solve_seconds=elapsed,
        ignore_limits=ignore_limits,
    )


def _sequence(robot: Robot, path: Path, near: FloatArray, joints: JointRange, with_rotation: bool) -> Sequence:
    """The best sequence along a path; a long one of free orientation from a few of its points, if that will do."""
    if path.rotations is None and robot.dof in _SAMPLED and path.samples > _LONG:
        q = coarse_to_fine(robot, path, near, joints, lambda part: _usable(robot, part, near, joints))
        if q is not None:
            return Sequence(q, True)
    return best_sequence(robot, _usable(robot, path, near, joints), near, joints, with_rotation)


def find_jumps(robot: Robot, q: FloatArray, with_rotation: bool) -> tuple[int, ...]:
    """The indices of poses (m, n) that follow the pose before only by leaving the tool's straight way."""
    pairs = np.flatnonzero(existing(q[1:] + q[:-1]))
    return tuple(int(i) + 1 for i in pairs[~continuous(robot, q[pairs], q[pairs + 1], with_rotation)])


def _usable(robot: Robot, path: Path, near: FloatArray, joints: JointRange) -> FloatArray:
    """(m, s, n) the branches within the limits, of a sampled orientation the most useful ones.

    Block by block: a free orientation has hundreds of branches a point.
    """
    if path.rotations is not None or robot.dof < 4:
        return _within(branches_on(robot, path, near), near, joints)
    most = _MOST if path.samples <= _BLOCK else _MOST // 2
    pieces: list[FloatArray] = []
    columns: list[int] = []
    for first in range(0, path.samples, _BLOCK):
        branches = branches_on(robot, path.part(slice(first, first + _BLOCK)), near)
        usable = _within(branches, near, joints)
        columns = useful_columns(usable, near, joints, columns, most)
        pieces.append(usable[:, columns])
    return np.concatenate(pieces)


def _within(branches: FloatArray, near: FloatArray, joints: JointRange) -> FloatArray:
    """The branches (m, s, n) as copies within the limits, NaN rows where no copy is."""
    if joints.periodic.all():
        return branches  # some copy of each is within
    copies = joints.nearest_copy(branches, near)
    outside = np.any(joints.outside(copies) > 0.0, axis=-1, keepdims=True)
    return np.where(outside, np.nan, copies)


def _reasons(robot: Robot, path: Path, missed: NDArray[np.intp], near: FloatArray) -> tuple[Unreached, ...]:
    """Why the points of these indices were missed."""
    reasons: list[Unreached] = []
    for first in range(0, len(missed), _BLOCK):
        indices = missed[first : first + _BLOCK]
        piece = path.part(indices)
        branches = branches_on(robot, piece, near)
        reachable = _reachable(robot, piece, branches, near)
        reasons += [
            limit_culprit(robot, int(index), found)
            if existing(found).any()
            else Unreached(int(index), "orientation" if place else "reach")
            for index, found, place in zip(indices, branches, reachable, strict=True)
        ]
    return tuple(reasons)


def _reachable(robot: Robot, path: Path, branches: FloatArray, near: FloatArray) -> NDArray[np.bool_]:
    """(m,) whether the arm could be at each point in some orientation, limits left out of account."""
    some = np.asarray(existing(branches).any(axis=1))
    if path.rotations is not None and not some.all():
        some |= existing(branches_on(robot, path.with_rotation(None), near)).any(axis=1)
    return some
