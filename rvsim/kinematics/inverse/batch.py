"""All branches of many poses at once: blocks that fit the cache, entry by entry inside, pose by pose at the door."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import ShapeError
from rvsim.kinematics.inverse.chain import Chain
from rvsim.kinematics.inverse.closed_form import ClosedForm
from rvsim.kinematics.inverse.families import closed_form, five_axis
from rvsim.kinematics.inverse.projection import nearest_orientation
from rvsim.language import tr
from rvsim.robot import Robot
from rvsim.spatial.arrays import FloatArray, floats

BLOCK = 8192  # poses; measured: smaller pays for calls, larger falls out of the cache


def inverse_kinematics_batch(robot: Robot, T: ArrayLike, *, project: bool = False) -> FloatArray:
    """Every branch of every pose: T (m, 4, 4) -> q (m, branches, n) [rad, m], NaN where a branch does not exist.

    The columns are those of `branch_labels`; angles lie within [−π, π], limits are not asked. The task is the arm's
    own: the pose, or less where the arm has fewer joints. A free joint (a continuum of solutions) is at its home.

    Args:
        project: 5R arms only: solve the nearest orientation such an arm can have at that place.

    Raises:
        NoClosedFormError: the arm has no closed form.
        ShapeError: T is not (m, 4, 4).
    """
    poses = floats("T", T, 4, 4)
    if poses.ndim != 3:
        raise ShapeError("T", "(m, 4, 4)", poses.shape)
    form = closed_form(robot)
    if project:
        poses = nearest_orientation(five_axis(form, tr("an orientation is projected")).chain, poses)
    q = np.empty((len(poses), len(form.labels), robot.dof))
    for start in range(0, len(poses), BLOCK):
        block = slice(start, start + BLOCK)
        q[block] = solve_block(form, poses[block], robot.home).transpose(2, 0, 1)
    return q


def inverse_kinematics_rows(robot: Robot, T: FloatArray) -> FloatArray:
    """`inverse_kinematics_batch` as it is worked out, joint by joint: T (m, 4, 4) -> (branches, n, m).

    Raises:
        NoClosedFormError: the arm has no closed form.
    """
    form = closed_form(robot)
    if len(T) <= BLOCK:
        return solve_block(form, T, robot.home)
    q = np.empty((len(form.labels), robot.dof, len(T)))
    for start in range(0, len(T), BLOCK):
        block = slice(start, start + BLOCK)
        q[:, :, block] = solve_block(form, T[block], robot.home)
    return q


def nearest_feasible_poses(robot: Robot, T: ArrayLike) -> FloatArray:
    """T (m, 4, 4) of a 5R arm with each orientation turned as little as the arm needs, each place kept.

    Raises:
        NoClosedFormError: it is no such arm, or its tool tip lies beside the roll axis.
    """
    return nearest_orientation(
        five_axis(closed_form(robot), tr("an orientation is projected")).chain, floats("T", T, 4, 4)
    )


def solve_block(form: ClosedForm, poses: FloatArray, free: FloatArray) -> FloatArray:
    """Joint variables (branches, n, m) of poses (m, 4, 4); `free` (n,) are the values of joints that are free."""
    S = frame_entries(form.chain, poses, flange=not form.place_only)
    with np.errstate(divide="ignore", invalid="ignore"):
        values = form.solve(S, form.chain.inner(free))
        return form.chain.to_joints(values)


def frame_entries(chain: Chain, poses: FloatArray, *, flange: bool) -> FloatArray:
    """T_0_n, or T_0_tool, entry by entry (3, 4, m) of T_base_tool (m, 4, 4)."""
    if flange and not chain.tool_is_last:
        poses = (poses.reshape(-1, 4) @ chain.T_tool_n).reshape(-1, 4, 4)
    S = np.ascontiguousarray(poses[:, :3].transpose(1, 2, 0))
    if not chain.base_is_first:
        S = (chain.T_0_base[:3, :3] @ S.reshape(3, -1)).reshape(S.shape)
        S[:, 3] += chain.T_0_base[:3, 3:]
    return S
