"""The worked solution of one arm and one target: which family writes it, and which branch each end is."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from rvsim.kinematics.dh import one_pose
from rvsim.kinematics.inverse import Branch, inverse_kinematics
from rvsim.kinematics.inverse.batch import solve_block
from rvsim.kinematics.inverse.closed_form import ClosedForm
from rvsim.kinematics.inverse.copies import LIMIT_TOLERANCE
from rvsim.kinematics.inverse.families import closed_form
from rvsim.kinematics.inverse.five_axis import FiveAxis
from rvsim.kinematics.inverse.rrrp import RollAndExtend
from rvsim.kinematics.inverse.spherical_wrist import SphericalWrist
from rvsim.kinematics.inverse.textbook import Articulated, Cartesian, Cylindrical, Planar, Scara, Spherical
from rvsim.kinematics.inverse.ur import ParallelAxes
from rvsim.lab.sentences import Units
from rvsim.lab.worked.figures import Figures, Kind
from rvsim.lab.worked.five_axis import solve_five_axis
from rvsim.lab.worked.notebook import Notebook
from rvsim.lab.worked.parallel_axes import solve_parallel_axes
from rvsim.lab.worked.rows import rows_of
from rvsim.lab.worked.rrrp import solve_rrrp
from rvsim.lab.worked.spherical_wrist import solve_spherical_wrist
from rvsim.lab.worked.textbook import (
    solve_articulated,
    solve_cartesian,
    solve_cylindrical,
    solve_planar,
    solve_scara,
    solve_spherical,
)
from rvsim.lab.worked.values import WorkedBranch, WorkedSolution
from rvsim.language import sentences, tr, tr_later
from rvsim.robot import Robot
from rvsim.spatial.arrays import FloatArray, floats

Writer = Callable[[Notebook, FloatArray], None]
_WRITERS: dict[type[ClosedForm], Writer] = {
    FiveAxis: solve_five_axis,
    ParallelAxes: solve_parallel_axes,
    SphericalWrist: solve_spherical_wrist,
    RollAndExtend: solve_rrrp,
    Planar: solve_planar,
    Articulated: solve_articulated,
    Spherical: solve_spherical,
    Scara: solve_scara,
    Cylindrical: solve_cylindrical,
    Cartesian: solve_cartesian,
}
_UNCONFIRMED = tr_later(
    "No solution: so close to a singular pose rounding is too large, and forward kinematics does not confirm it."
)
_TITLE = "{robot}: {family}"
_DEFAULT = Units()
_SAME = 1e-4  # [rad, m] an end and a branch closer than this are one


def worked_solution(
    robot: Robot, T: ArrayLike, near: ArrayLike | None = None, units: Units = _DEFAULT
) -> WorkedSolution:
    """The closed form of an arm, step by step, for the tool pose T (4, 4) and the arm's own task.

    Args:
        robot: an arm with a closed form.
        T: T_base_tool.
        near: (n,) where the arm is [rad, m]: it chooses the copies by whole turns, and the values of free joints.
        units: what angles and lengths are written in; an arm without a unit of length keeps its own.

    Raises:
        NoClosedFormError: the arm has none; the message says which condition it breaks.
        ShapeError: T is not (4, 4), near not (n,). SettingError: near is not finite.
        PoseError: T is no pose.
    """
    form = closed_form(robot)
    here = robot.home if near is None else one_pose(robot, near, "near")
    result = inverse_kinematics(robot, T, near=here)
    pose = floats("T", T, 4, 4)
    known = dict(zip(form.labels, solve_block(form, pose[None], here)[:, :, 0], strict=True))
    book = Notebook(rows_of(form.chain), known, here, units)
    _WRITERS[type(form)](book, pose)
    ends = tuple(_with_verdict(book.figures, robot, end, result.branches) for end in book.ends)
    return WorkedSolution(tr(_TITLE, robot=tr(robot.title), family=tr(form.title)), tuple(book.steps), ends)


def _with_verdict(figures: Figures, robot: Robot, end: WorkedBranch, branches: Sequence[Branch]) -> WorkedBranch:
    if end.q is None:
        return end
    q = end.q
    branch = min(branches, key=lambda found: _distance(robot, found.q, q), default=None)
    if branch is None or _distance(robot, branch.q, q) > _SAME:
        return replace(end, q=None, reason=tr(_UNCONFIRMED))
    return replace(end, branch=branch, reason="" if branch.within_limits else _broken_limits(figures, robot, branch))


def _distance(robot: Robot, a: FloatArray, b: FloatArray) -> float:
    """The largest joint difference, whole turns aside."""
    difference = a - b
    turns = 2.0 * np.pi * np.rint(difference / (2.0 * np.pi))
    return float(np.abs(difference - np.where(robot.is_revolute, turns, 0.0)).max())


def _broken_limits(figures: Figures, robot: Robot, branch: Branch) -> str:
    """Which joints stop too early, with numbers."""
    text = figures.text
    broken = []
    for joint, value, margin in zip(robot.joints, branch.q.tolist(), branch.limit_margin.tolist(), strict=True):
        if margin < -LIMIT_TOLERANCE:
            kind: Kind = "angle" if joint.revolute else "length"
            stop = joint.lower if value < joint.lower else joint.upper
            broken.append(
                tr(
                    "{joint} needs {needed}, stops at {stop}",
                    joint=tr(joint.name),
                    needed=text(value, kind),
                    stop=text(stop, kind),
                )
            )
    return sentences(*broken, between=tr("; "))
