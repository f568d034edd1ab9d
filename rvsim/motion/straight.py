"""The usual case made quick: one branch carries the whole path, and it can be proven that no change of branch pays.

A lower bound stands in for the dynamic programming. Between block ends, any way through any branches is at least as
long as the straight way in joint space (the triangle inequality); a way that leaves a branch and comes back to it
goes at least to the nearest other branch and back. Where even so no way is shorter than that of one branch, this
branch is the best, and only its own steps need the midpoint test.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rvsim.motion.continuity import continuous_run
from rvsim.motion.turns import TURN, JointRange, nearest_turn
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_BLOCK = 20  # points whose ways are bounded together where it does not do to take all at once
_ROUNDING = 1e-9


def straight_run(
    robot: Robot,
    q: FloatArray,
    first: FloatArray,
    adjacent: NDArray[np.bool_],
    joints: JointRange,
    weights: FloatArray,
    with_rotation: bool,
) -> FloatArray | None:
    """The branch of q (m, s, n) that is the best sequence alone and without jumps, (m, n); None if none surely is.

    It is without whole turns from one point to the next.

    Args:
        first: (s,) the way from the present pose to each branch of the first point, inf where there is none.
        adjacent: (m − 1,) which points follow each other on the path.
        weights: (n,) what a joint's motion counts.
    """
    rows = q.transpose(2, 1, 0)
    ways = _ways(rows[..., 1:] - rows[..., :-1], joints)
    steps = _lengths(ways, joints, weights)
    totals = first + steps.sum(axis=1)
    totals[np.isnan(totals)] = np.inf
    best = int(np.argmin(totals))
    enough = totals[best] - _ROUNDING * max(len(q), 1)
    if not any(_least(rows, first, steps, block, joints, weights) >= enough for block in (len(q), _BLOCK)):
        return None
    run = _run(rows[:, best], ways[:, best])
    return run if (continuous_run(robot, run, with_rotation) | ~adjacent).all() else None


def _run(q: FloatArray, ways: FloatArray) -> FloatArray:
    """(m, n) the poses (n, m) of one branch, without the whole turns that their ways (n, m − 1) do not make."""
    turns = np.rint((ways - (q[:, 1:] - q[:, :-1])) * (1.0 / TURN))
    if not turns.any():
        return q.T
    return np.concatenate((q[:, :1], q[:, 1:] + TURN * np.cumsum(turns, axis=1)), axis=1).T


def _least(
    q: FloatArray, first: FloatArray, steps: FloatArray, block: int, joints: JointRange, weights: FloatArray
) -> float:
    """What no way through the branches q (n, s, m) can undercut, bounded by blocks of so many points.

    Args:
        steps: (s, m − 1) the way of each branch from point to point, NaN where it breaks off.
    """
    last = q.shape[2] - 1
    if not last:
        return float(first.min())
    begins = np.arange(0, last, block)
    ends = np.minimum(begins + block, last)
    exists = ~np.isnan(q[0])
    somewhere = np.logical_or.reduceat(exists[:, :-1], begins, axis=1) | exists[:, ends]
    own = np.add.reduceat(steps, begins, axis=1)
    cost = first
    here, there = (q[..., points].swapaxes(1, 2) for points in (begins, ends))
    for bound in _bounds(here, there, own.T, somewhere.T, joints, weights):
        cost = (cost[:, None] + bound).min(axis=0)
    return float(cost.min())


def _bounds(
    here: FloatArray,
    there: FloatArray,
    own: FloatArray,
    somewhere: NDArray[np.bool_],
    joints: JointRange,
    weights: FloatArray,
) -> FloatArray:
    """(k, s, s) the least way from each branch of a block's first point to each of its last, inf where one is missing.

    Args:
        here, there: (n, k, s) the branches at the first and at the last point of each block.
        own: (k, s) the way of each branch through the block, NaN where it breaks off.
        somewhere: (k, s) whether the branch exists at any point of the block.
    """
    others = np.array((there, here)).transpose(1, 0, 2, 3)
    direct, apart = _lengths(_ways(others[..., None, :] - here[:, None, ..., None], joints), joints, weights)
    # To another branch and back, wherever in the block: that branch is at most `own` nearer than at the beginning.
    away = apart - own[:, None, :]
    away[np.isnan(away)] = 0.0
    away = np.where(somewhere[:, None, :], away, np.inf)
    _diagonal(away)[:] = np.inf
    straight = _diagonal(direct)
    there_and_back = 2.0 * away.min(axis=2) - straight
    straight[:] = np.fmin(own, np.maximum(straight, there_and_back))
    direct[np.isnan(direct)] = np.inf
    return np.asarray(direct)


def _diagonal(matrices: FloatArray) -> FloatArray:
    """(k, s) the diagonals of matrices (k, s, s), to be written to."""
    return np.asarray(np.einsum("kss->ks", matrices))


def _ways(steps: FloatArray, joints: JointRange) -> FloatArray:
    """Joint steps (n, ...), each the short way round."""
    return nearest_turn(steps.T, joints.periodic).T


def _lengths(ways: FloatArray, joints: JointRange, weights: FloatArray) -> FloatArray:
    """(...) the lengths of joint steps (n, ...); NaN where there is none."""
    weighted = ways if joints.all_revolute else (ways.T * weights).T
    return np.asarray(np.sqrt((weighted * weighted).sum(axis=0)))
