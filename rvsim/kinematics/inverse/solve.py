"""Inverse kinematics of one pose: every branch with its verdict, or why not and what is nearest."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import PoseError, ShapeError
from rvsim.kinematics.dh import one_pose
from rvsim.kinematics.inverse.batch import solve_block
from rvsim.kinematics.inverse.closed_form import ClosedForm
from rvsim.kinematics.inverse.families import closed_form
from rvsim.kinematics.inverse.result import DEFAULT_ORDER, Branch, Failure, InverseResult, in_order
from rvsim.kinematics.inverse.task import Candidates, candidates, tasks
from rvsim.kinematics.inverse.ur import ParallelAxes
from rvsim.kinematics.inverse.ur_scalar import ScalarParallelAxes
from rvsim.kinematics.inverse.verdict import branches_of
from rvsim.kinematics.inverse.why_not import limits_failure, reach_failure
from rvsim.language import tr
from rvsim.robot import Robot
from rvsim.spatial import nearest_rotation
from rvsim.spatial.arrays import FloatArray, floats

_ROTATION = 1e-2  # a rotation part that far from orthogonal is a mistake, not rounding


def inverse_tasks(robot: Robot) -> tuple[str, ...]:
    """What can be asked of this arm's tool in closed form, its own task first, for instance "pose", "position".

    Raises:
        NoClosedFormError: the arm has no closed form.
    """
    return tasks(closed_form(robot))


def inverse_kinematics(
    robot: Robot,
    T: ArrayLike,
    *,
    task: str | None = None,
    near: ArrayLike | None = None,
    order: Sequence[str] = DEFAULT_ORDER,
) -> InverseResult:
    """Every joint pose that brings the tool to T (4, 4), each checked by forward kinematics; or why there is none.

    Args:
        robot: any arm whose DH rows fit one of the families; a rotation part of T that is off by rounding is mended.
        T: T_base_tool.
        task: what of T counts, one of `inverse_tasks`; None is the arm's own: the pose, or "position", "position+yaw",
            "x,y" where the arm has fewer joints. "position+pitch+roll" lets a 5R arm turn T about the vertical.
            "position" leaves the orientation free: a 6R arm keeps T's where a branch can, else turns it least.
        near: (n,) where the arm is [rad, m], for the order, the copies by whole turns, and joints that are free; None
            is its home.
        order: the criteria that put the branches in order, of `ORDER_CRITERIA`, the most important first.

    Raises:
        NoClosedFormError: the arm has no closed form.
        UnknownNameError: a task or a criterion that does not exist.
        PoseError: T is no pose. ShapeError: T is not (4, 4), near not (n,). SettingError: near is not finite.
    """
    tried = attempt(robot, T, task=task, near=near, order=order)
    return InverseResult(tried.branches, None if tried.reached else tried.failure())


@dataclass(frozen=True, eq=False)
class Attempt:
    """All branches for a target, best first, before anybody asks why there are none.

    Args:
        form: the family's closed form.
        found: the candidates, and the target as the arm can understand it.
        branches: those of them that are right, in order.
        here: (n,) where the arm is.
        order: the criteria of the order.
    """

    form: ClosedForm
    found: Candidates
    branches: tuple[Branch, ...]
    here: FloatArray
    order: Sequence[str]

    @property
    def reached(self) -> bool:
        """Whether a branch is within the limits."""
        return any(branch.within_limits for branch in self.branches)

    def failure(self) -> Failure:
        """Why no branch will do. To tell whether the place alone is in reach can take 10 ms."""
        if self.branches:
            return limits_failure(self.form, self.found, self.branches, self.here)
        return reach_failure(self.form, self.found, self.here, self.order)


def attempt(
    robot: Robot,
    T: ArrayLike,
    *,
    task: str | None = None,
    near: ArrayLike | None = None,
    order: Sequence[str] = DEFAULT_ORDER,
) -> Attempt:
    """The branches alone: `inverse_kinematics` for somebody in a hurry, with the same arguments and errors."""
    form = closed_form(robot)
    target = _pose(T)
    here = robot.home if near is None else one_pose(robot, near, "near")
    found = candidates(form, task, target, here)
    return Attempt(form, found, in_order(branches_of(robot, found, here), order), here, order)


def inverse_branches(robot: Robot, T: ArrayLike) -> FloatArray:
    """Every branch (b, n) for one pose T (4, 4) and the arm's own task: the fast single call, without verdicts.

    Raises:
        NoClosedFormError: the arm has no closed form.
        ShapeError: T is not (4, 4).
    """
    pose = np.asarray(T, np.float64)
    if pose.shape != (4, 4):
        raise ShapeError("T", "(4, 4)", pose.shape)
    form, scalar = _forms(robot)
    q = scalar.solve(pose) if scalar else None
    if q is not None:
        return q
    q = solve_block(form, pose[None], robot.home)[:, :, 0]
    return np.asarray(q[~np.isnan(q).any(axis=1)])


@lru_cache(maxsize=64)
def _forms(robot: Robot) -> tuple[ClosedForm, ScalarParallelAxes | None]:
    form = closed_form(robot)
    scalar = ScalarParallelAxes(form) if isinstance(form, ParallelAxes) else None
    return form, scalar if scalar and scalar.fits else None


def _pose(T: ArrayLike) -> FloatArray:
    """T with the nearest rotation in its rotation part (the polar factor)."""
    pose = floats("T", T, 4, 4)
    if pose.ndim != 2:
        raise ShapeError("T", "(4, 4)", pose.shape)
    if not np.isfinite(pose).all() or not np.array_equal(pose[3], (0.0, 0.0, 0.0, 1.0)):
        raise PoseError(tr("its entries must be finite and its last row 0 0 0 1."))
    R = pose[:3, :3]
    astray = float(np.abs(R.T @ R - np.eye(3)).max())
    if astray > _ROTATION or np.linalg.det(R) < 0.0:
        raise PoseError(
            tr("its columns are no right-handed, orthogonal unit vectors (off by {astray:.3g}).", astray=astray)
        )
    if astray < 1e-14:
        return pose
    mended = pose.copy()
    mended[:3, :3] = nearest_rotation(R)
    return mended
