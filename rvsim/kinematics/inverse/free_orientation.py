"""The place alone for a 6R arm: its orientation is free, and each branch shows the one nearest to the wanted.

That is a continuum of three dimensions, of which one representative is given a branch: T's own orientation where the
branch exists there, else the least turned one in which it does. So the tool keeps its orientation while it can, and
gives way no more than it must.
"""

from __future__ import annotations

from functools import partial

import numpy as np

from rvsim.kinematics.inverse.batch import frame_entries, solve_block
from rvsim.kinematics.inverse.chain import TOLERANCE
from rvsim.kinematics.inverse.copies import limit_copies, limit_margins
from rvsim.kinematics.inverse.least_turn import least_turns
from rvsim.kinematics.inverse.spherical_wrist import SphericalWrist, plane_entries
from rvsim.kinematics.inverse.ur import ParallelAxes
from rvsim.kinematics.inverse.waist import Side, solve_waist
from rvsim.spatial import rotation_from_vector
from rvsim.spatial.arrays import FloatArray

SixAxis = SphericalWrist | ParallelAxes
_BEYOND = -1e-3  # the slack of a branch that does not exist although its links would reach: rounding at its end


def place_branches(form: SixAxis, T: FloatArray, near: FloatArray) -> FloatArray:
    """Joints (8, 6) [rad] of every branch at the place of T (4, 4), NaN rows where no orientation gives the branch.

    Limits are not asked, unless no branch found is within them: then one is replaced by the least turned pose that is,
    if the search finds it.
    """
    q = solve_block(form, T[None], near)[:, :, 0]
    missing = np.isnan(q).any(axis=1)
    if missing.any():
        q[missing] = _turned_branches(form, T, near)[missing]
    if not np.isnan(q).all() and not limit_copies(form.chain.robot, q, near).within.any():
        _put_within_limits(form, T, near, q)
    return q


def _turned_branches(form: SixAxis, T: FloatArray, near: FloatArray) -> FloatArray:
    """(8, 6) each branch in the least turned orientation that gives it."""
    slack = partial(_reach_slack, form, T)
    count = slack(np.eye(3)[None]).shape[0]
    turns = least_turns(slack, _idle_axis(form, T), np.arange(count))
    q = solve_block(form, _turned(T, rotation_from_vector(turns)), near)
    # The labels of one group follow each other, or those of one side do: groups × branches of a group.
    return np.concatenate([q[block, :, group] for group, block in enumerate(_blocks(count))])


def _blocks(count: int) -> list[slice]:
    """Which labels each of `count` groups has."""
    each = 8 // count
    return [slice(group * each, (group + 1) * each) for group in range(count)]


def _put_within_limits(form: SixAxis, T: FloatArray, near: FloatArray, q: FloatArray) -> None:
    """Replace one branch of q (8, 6) by the least turned one within the limits, if there is one."""
    turns = least_turns(partial(_limit_slack, form, T, near), None, np.zeros(1, np.intp))
    turned = solve_block(form, _turned(T, rotation_from_vector(turns)), near)[:, :, 0]
    within = limit_copies(form.chain.robot, turned, near).within
    q[within] = turned[within]


def _turned(T: FloatArray, turns: FloatArray) -> FloatArray:
    """(m, 4, 4) the pose T (4, 4) turned in its place."""
    poses = np.tile(T, (len(turns), 1, 1))
    poses[:, :3, :3] = turns @ T[:3, :3]
    return poses


def _idle_axis(form: SixAxis, T: FloatArray) -> FloatArray | None:
    """(3,) the axis about which the tool may turn without moving what the arm must reach, in base coordinates.

    With a spherical wrist it goes from the wrist's centre to the tip; else it is axis 6, if the tip lies on it.
    """
    chain = form.chain
    lever = chain.T_n_tool[:3, 3] + (0.0, 0.0, form.d6)
    length = float(np.linalg.norm(lever))
    if isinstance(form, ParallelAxes) or length <= TOLERANCE:
        if np.abs(lever[:2]).max() > TOLERANCE:
            return None
        lever, length = np.array([0.0, 0.0, 1.0]), 1.0
    return np.asarray(T[:3, :3] @ chain.T_tool_n[:3, :3] @ (lever / length))


def _reach_slack(form: SixAxis, T: FloatArray, turns: FloatArray) -> FloatArray:
    """(groups, m) by how much the branches reach the turned poses, in squares of the arm's size; negative: not."""
    S = frame_entries(form.chain, _turned(T, turns), flange=True)
    x, y, z = S[:, 3] - form.d6 * S[:, 2]
    with np.errstate(divide="ignore", invalid="ignore"):
        if isinstance(form, SphericalWrist):
            arm = form.regional
            waist = solve_waist(x, y, arm.offset, arm.size, 0.0)
            groups = [_links_slack(side.out - arm.a1, z - arm.d1, arm.a2, arm.forearm) for side in waist.sides]
            beside = x * x + y * y - arm.offset**2
        else:
            waist = solve_waist(x, y, form.offset, form.chain.size, 0.0)
            groups = [slack for side in waist.sides for slack in _wrist_slacks(form, S, side, z - form.d1)]
            beside = x * x + y * y - form.offset**2
    slacks = np.minimum(groups, beside) / form.chain.size**2
    return np.where(np.isnan(slacks), _BEYOND, slacks)


def _wrist_slacks(form: ParallelAxes, S: FloatArray, side: Side, w: FloatArray) -> list[FloatArray]:
    """The same of both wrists on one side of an arm with three parallel axes; see `ParallelAxes`."""
    (xr, yr, _), (xz, yz, _), (xn, yn, _) = plane_entries(S, side)
    sine = np.maximum(np.sqrt(xn * xn + yn * yn), 1e-300)
    c6, s6 = xn / sine, -yn / sine
    r4, z4 = s6 * xr + c6 * yr, s6 * xz + c6 * yz
    along, across = form.d5 * r4 - form.a4 * z4, form.d5 * z4 + form.a4 * r4
    u = side.out - form.a1
    return [_links_slack(u - sign * along, w - sign * across, form.a2, form.a3) for sign in (1.0, -1.0)]


def _links_slack(u: FloatArray, w: FloatArray, a2: float, a3: float) -> FloatArray:
    """(m,) by how much two links reach (u, w), in squares of lengths."""
    square = u * u + w * w
    return np.asarray(np.minimum((abs(a2) + abs(a3)) ** 2 - square, square - (abs(a2) - abs(a3)) ** 2))


def _limit_slack(form: SixAxis, T: FloatArray, near: FloatArray, turns: FloatArray) -> FloatArray:
    """(1, m) how far the best branch of the turned poses is within the limits [rad]; where there is none, −π."""
    robot = form.chain.robot
    q = np.ascontiguousarray(solve_block(form, _turned(T, turns), near).transpose(0, 2, 1))
    margins = limit_margins(robot, limit_copies(robot, q, near).q).min(axis=2)
    return np.asarray(np.where(np.isnan(margins), -np.pi, margins).max(axis=0, keepdims=True))
