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
from rvsim.motion.turns import JointRange, nearest_turn, whole_turns
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_BLOCK = 20  # points whose ways are bounded together
_ROUNDING = 1e-9


def straight_column(
    robot: Robot,
    q: FloatArray,
    first: FloatArray,
    adjacent: NDArray[np.bool_],
    joints: JointRange,
    weights: FloatArray,
    with_rotation: bool,
) -> int | None:
    """The column of branches q (m, s, n) that is the best sequence alone and without jumps; None if that is not sure.

    Args:
        first: (s,) the way from the present pose to each branch of the first point, inf where there is none.
        adjacent: (m − 1,) which points follow each other on the path.
        weights: (n,) what a joint's motion counts.
    """
    steps = _lengths(q[1:] - q[:-1], joints, weights)
    totals = first + steps.sum(axis=0)
    totals[np.isnan(totals)] = np.inf
    best = int(np.argmin(totals))
    if not totals[best] <= _least(q, first, steps, joints, weights) + _ROUNDING * max(len(q), 1):
        return None
    way = q[:, best] + whole_turns(q[:, best], joints.periodic)
    return best if (continuous_run(robot, way, with_rotation) | ~adjacent).all() else None


def _least(q: FloatArray, first: FloatArray, steps: FloatArray, joints: JointRange, weights: FloatArray) -> float:
    """What no way through the branches q (m, s, n) can undercut."""
    ends = np.append(np.arange(0, len(q) - 1, _BLOCK), len(q) - 1)
    if len(ends) == 1:
        return float(first.min())
    exists = ~np.isnan(q[..., 0])
    somewhere = np.logical_or.reduceat(exists[:-1], ends[:-1], axis=0) | exists[ends[1:]]
    bounds = _bounds(q[ends], np.add.reduceat(steps, ends[:-1], axis=0), somewhere, joints, weights)
    cost = first
    for bound in bounds:
        cost = (cost[:, None] + bound).min(axis=0)
    return float(cost.min())


def _bounds(
    q: FloatArray, own: FloatArray, somewhere: NDArray[np.bool_], joints: JointRange, weights: FloatArray
) -> FloatArray:
    """(k, s, s) the least way from each branch of a block's first point to each of its last, inf where one is missing.

    Args:
        q: (k + 1, s, n) the branches at the ends of the blocks.
        own: (k, s) the way of each branch through the block, NaN where it breaks off.
        somewhere: (k, s) whether the branch exists at any point of the block.
    """
    here = q[:-1, :, None]
    others = np.stack([q[1:, None], q[:-1, None]])
    direct, apart = _lengths(others - here, joints, weights)
    column = np.arange(q.shape[1])
    # To another branch and back, wherever in the block: that branch is at most `own` nearer than at the beginning.
    away = np.where(somewhere[:, None, :], np.nan_to_num(apart - own[:, None, :]), np.inf)
    away[:, column, column] = np.inf
    straight = direct[:, column, column]
    there_and_back = 2.0 * away.min(axis=2) - straight
    direct[:, column, column] = np.fmin(own, np.maximum(straight, there_and_back))
    direct[np.isnan(direct)] = np.inf
    return np.asarray(direct)


def _lengths(steps: FloatArray, joints: JointRange, weights: FloatArray) -> FloatArray:
    """(...) the lengths of joint steps (..., n), each the short way round; NaN where there is none."""
    way = nearest_turn(steps, joints.periodic)
    if not joints.revolute.all():
        way *= weights
    return np.asarray(np.sqrt(np.einsum("...n,...n->...", way, way)))
