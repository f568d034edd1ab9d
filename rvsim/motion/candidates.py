"""All the joint poses that put the tool on each point of a path: the material from which a sequence is chosen."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

import numpy as np
from numpy.typing import NDArray

from rvsim.kinematics.forward import forward_kinematics
from rvsim.kinematics.inverse import free_pitch_batch, inverse_kinematics_batch, inverse_tasks
from rvsim.kinematics.inverse.batch import inverse_kinematics_rows
from rvsim.kinematics.inverse.families import closed_form
from rvsim.kinematics.inverse.task import candidates
from rvsim.kinematics.jacobian import jacobian
from rvsim.motion.path import Path
from rvsim.motion.turns import JointRange, existing
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

# A free pitch is sampled this finely [rad].
_PITCH_STEP = np.radians(1.5)
# Among columns that reach as much, the one nearer to the present pose.
_NEARNESS = 1e-6
_SAME_PLACE = 1e-7


def branches_on(robot: Robot, path: Path, near: FloatArray) -> FloatArray:
    """(m, s, n) every branch at every point, NaN where one does not exist; limits are not asked.

    Where the orientation is free it is sampled, and a last joint that only turns the tool in its place stays as it is
    in `near` (n,).

    Raises:
        NoClosedFormError: the arm has no closed form.
    """
    if path.rotations is not None or robot.dof < 4:
        q = inverse_kinematics_rows(robot, path.poses()).transpose(2, 0, 1)
        return q if closed_form(robot).task == "pose" else _on_the_points(robot, q, path.points)
    q = _free(robot, path.points, near)
    if _last_joint_only_turns(robot):
        q[..., -1] = np.where(np.isnan(q[..., -1]), np.nan, near[-1])
    return _on_the_points(robot, q, path.points)


def _on_the_points(robot: Robot, q: FloatArray, points: FloatArray) -> FloatArray:
    """Branches q (m, s, n), NaN rows where they miss their point: a planar arm's own task does not ask for z."""
    missed = np.linalg.norm(forward_kinematics(robot, q)[..., :3, 3] - points[:, None], axis=-1, keepdims=True)
    return np.where(missed < _SAME_PLACE * robot.size, q, np.nan)


def _free(robot: Robot, points: FloatArray, near: FloatArray) -> FloatArray:
    """(m, s, n): every pitch (5R), directions all around (6R), the place alone or as it is in `near` (4 joints)."""
    if robot.dof == 5:
        pitches = np.arange(-np.pi, np.pi, _PITCH_STEP)
        q = free_pitch_batch(robot, points, pitches, float(near[-1]))
    elif robot.dof == 6:
        q = inverse_kinematics_batch(robot, _all_around(robot, points, near).reshape(-1, 4, 4))
    elif "position" in inverse_tasks(robot):
        form = closed_form(robot)
        q = np.array([candidates(form, "position", T, near).q for T in _as_it_is(robot, points, near)])
    else:
        q = inverse_kinematics_batch(robot, _as_it_is(robot, points, near))
    return q.reshape(len(points), -1, robot.dof)


def useful_columns(q: FloatArray, near: FloatArray, joints: JointRange, before: Sequence[int], most: int) -> list[int]:
    """At most `most` columns of sampled branches q (m, s, n): those that reach the points not yet reached often.

    Args:
        before: the columns chosen for the points before: those that still exist are kept, up to half of `most`, so that
            a sequence can go on in them.
    """
    if q.shape[1] <= most:
        return list(range(q.shape[1]))
    exists = existing(q)
    kept = [column for column in before if exists[:, column].any()][: most // 2]
    covered = exists[:, kept].sum(axis=1).astype(np.float64)
    distance = _mean_distance(q, exists, near, joints)
    while len(kept) < most:
        score = exists.T @ (1.0 / (1.0 + covered)) - _NEARNESS * distance
        score[kept] = -np.inf
        kept.append(int(np.argmax(score)))
        covered += exists[:, kept[-1]]
    return kept


def _mean_distance(q: FloatArray, exists: NDArray[np.bool_], near: FloatArray, joints: JointRange) -> FloatArray:
    """(s,) how far from `near` the branches of a column are on average, 0 where there are none."""
    step = np.where(exists, np.linalg.norm(joints.nearest_copy(q, near) - near, axis=2), 0.0)
    return np.asarray(step.sum(axis=0) / np.maximum(exists.sum(axis=0), 1))


def _as_it_is(robot: Robot, points: FloatArray, near: FloatArray) -> FloatArray:
    """(m, 4, 4) the points with the orientation of `near`."""
    T = np.tile(forward_kinematics(robot, near), (len(points), 1, 1))
    T[:, :3, 3] = points
    return T


def _all_around(robot: Robot, points: FloatArray, near: FloatArray) -> FloatArray:
    """(m, s, 4, 4) the points with sampled directions of the tool."""
    axes = _axes_around(robot, near)
    T = np.zeros((len(points), len(axes), 4, 4))
    T[..., :3, :3] = _frames(axes)
    T[..., :3, 3] = points[:, None]
    T[..., 3, 3] = 1.0
    return T


def _axes_around(robot: Robot, near: FloatArray) -> FloatArray:
    """(s, 3) the tool axis as it is in `near`, and the directions to points spread over the faces of a cube."""
    grid = np.array(list(product((-2.0, -1.0, 0.0, 1.0, 2.0), repeat=3)))
    shell = grid[np.abs(grid).max(axis=1) == 2.0]
    around = shell / np.linalg.norm(shell, axis=1, keepdims=True)
    return np.concatenate([forward_kinematics(robot, near)[None, :3, 2], around])


def _frames(axes: FloatArray) -> FloatArray:
    """(..., 3, 3) rotations whose z axes are the unit vectors (..., 3)."""
    helper = np.where(np.abs(axes[..., 2:]) < 0.9, [0.0, 0.0, 1.0], [1.0, 0.0, 0.0])
    x = np.cross(helper, axes)
    x /= np.linalg.norm(x, axis=-1, keepdims=True)
    return np.stack([x, np.cross(axes, x), axes], axis=-1)


def _last_joint_only_turns(robot: Robot) -> bool:
    """Whether the tool's place does not depend on the last joint."""
    return bool(np.linalg.norm(jacobian(robot, robot.home)[:3, -1]) < _SAME_PLACE * robot.size)
