"""What an edited tool pose means for the joints: the nearest branch, or the sentence that says why there is none."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rvsim.errors import NoClosedFormError
from rvsim.experiment import Experiment
from rvsim.kinematics import forward_kinematics
from rvsim.kinematics.inverse import Failure, inverse_kinematics, inverse_tasks
from rvsim.lab.sentences import Units, angle_text, failure_sentence
from rvsim.language import tr
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.spatial import pose_difference

_UPRIGHT = "position+pitch+roll"
_CLOSE = 1e-7  # [m, rad]: what an arm of fewer joints may leave of an edit before it counts as not followed


class ToolEdit(NamedTuple):
    """The joints (n,) that follow an edit [rad, m], or None; a sentence where there is something to say."""

    q: FloatArray | None = None
    sentence: str = ""


class _Solution(NamedTuple):
    q: FloatArray | None
    failure: Failure | None


def moved_tool(experiment: Experiment, T: FloatArray, p: FloatArray, units: Units) -> ToolEdit:
    """The tool of pose T (4, 4) moved to p (3,) [m]; sentences are in `units`.

    Its orientation stays; a 5R arm keeps pitch and roll and turns with its waist. Where the arm cannot keep it there,
    an arm that has a way to reach the place alone does so and says it.
    """
    robot = experiment.robot
    target = np.array(T)
    target[:3, 3] = p
    try:
        known = inverse_tasks(robot)
        first = _solve(experiment, target, _UPRIGHT if _UPRIGHT in known else None)
        if first.q is not None:
            return _followed(robot, first.q, target, position_only=True)
        if first.failure is not None and first.failure.kind == "orientation" and "position" in known[1:]:
            return _turned_along(experiment, target, units)
    except NoClosedFormError as problem:
        return ToolEdit(sentence=f"{problem} {tr('Set its joints instead.')}")
    return ToolEdit(sentence=_reason(robot, first.failure, units))


def turned_tool(experiment: Experiment, T: FloatArray, R: FloatArray, units: Units) -> ToolEdit:
    """The tool of pose T (4, 4) turned to R (3, 3), its origin kept; sentences are in `units`."""
    target = np.array(T)
    target[:3, :3] = R
    try:
        solution = _solve(experiment, target, None)
    except NoClosedFormError as problem:
        return ToolEdit(sentence=f"{problem} {tr('Set its joints instead.')}")
    if solution.q is None:
        return ToolEdit(sentence=_reason(experiment.robot, solution.failure, units))
    return _followed(experiment.robot, solution.q, target, position_only=False)


def _solve(experiment: Experiment, target: FloatArray, task: str | None) -> _Solution:
    """The branch nearest to the present pose; one outside the limits only if they are ignored."""
    result = inverse_kinematics(experiment.robot, target, task=task, near=experiment.q)
    if result.failure is None or (experiment.ignore_limits and result.branches):
        return _Solution(result.branches[0].q, None)
    return _Solution(None, result.failure)


def _followed(robot: Robot, q: FloatArray, target: FloatArray, *, position_only: bool) -> ToolEdit:
    """The solution, unless it leaves undone what was asked: an arm of few joints solves less than a pose."""
    difference = pose_difference(forward_kinematics(robot, q), target)
    left = difference.position if position_only else np.maximum(difference.position, difference.angle)
    if float(left) < _CLOSE:
        return ToolEdit(q)
    return ToolEdit(sentence=_too_few_joints(robot, position_only=position_only))


def _too_few_joints(robot: Robot, *, position_only: bool) -> str:
    title, dof = tr(robot.title), robot.dof
    if position_only:
        return tr("The tool cannot be moved that way: the {title} has {dof} joints.", title=title, dof=dof)
    return tr("The tool cannot be turned that way: the {title} has {dof} joints.", title=title, dof=dof)


def _turned_along(experiment: Experiment, target: FloatArray, units: Units) -> ToolEdit:
    """The place alone, the tool turned as far as it must."""
    solution = _solve(experiment, target, "position")
    if solution.q is None:
        return ToolEdit(sentence=_reason(experiment.robot, solution.failure, units))
    angle = pose_difference(forward_kinematics(experiment.robot, solution.q), target).angle
    return ToolEdit(
        solution.q, tr("The tool had to turn by {angle} to get there.", angle=angle_text(float(angle), units))
    )


def _reason(robot: Robot, failure: Failure | None, units: Units) -> str:
    assert failure is not None, "no solution without a reason"
    sentence = failure_sentence(failure, units)
    if failure.kind == "orientation" and robot.dof < 6:
        few = tr("With {dof} joints the tool's orientation is not free.", dof=robot.dof)
        return f"{sentence} {few}"
    if failure.kind == "limits":
        return f"{sentence} {tr('Switch “Ignore limits” on to go there.')}"
    return sentence
