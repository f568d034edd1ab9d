"""Why a jog has come to its end, with names and numbers: the limit, or the singularity and what is lost there."""

from __future__ import annotations

import numpy as np

from rvsim.gui.panels.inspect_singular_words import direction_text, value_text
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import format_quantity, joint_kind
from rvsim.kinematics import (
    LostMotion,
    SingularFamily,
    go_to_singularity,
    lost_motions,
    singular_families,
    singularity,
)
from rvsim.language import left_to_right, tr, tr_later
from rvsim.motion.jog import JogStep
from rvsim.motion.jog_course import Limit
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_NEAR = 0.25  # of a family's scaled terms
_PROBE = 1e-4
# By the side, lower or upper, and whether the joint is beyond it.
_STOPPED = {
    (0, False): tr_later("Stopped: the {joint} is at its lower limit, {limit}."),
    (0, True): tr_later("Stopped: the {joint} is beyond its lower limit, {limit}."),
    (1, False): tr_later("Stopped: the {joint} is at its upper limit, {limit}."),
    (1, True): tr_later("Stopped: the {joint} is beyond its upper limit, {limit}."),
}


def stop_text(robot: Robot, step: JogStep, preferences: Preferences) -> str:
    """The sentence for a step at the end of its course."""
    if isinstance(step.cause, Limit):
        return _limit_text(robot, step.cause, float(step.q[step.cause.joint]), preferences)
    families = [family for family in singular_families(robot) if family.measure(step.q) < _NEAR]
    if step.cause is None or not families:
        return step.stopped_reason
    family = min(families, key=lambda family: float(family.measure(step.q)))
    where = _where(robot, family, step.q, preferences)
    lost = _lost_words(robot, family, step.q)
    if not lost:
        return tr("Stopped before the {singularity}, {where}.", singularity=family.title, where=where)
    return tr(
        "Stopped before the {singularity}, {where}: there the tool cannot {motions}.",
        singularity=family.title,
        where=where,
        motions=lost,
    )


def _limit_text(robot: Robot, limit: Limit, value: float, preferences: Preferences) -> str:
    number = format_quantity(limit.value, joint_kind(robot, limit.joint), preferences)
    beyond = value < limit.value if limit.side == 0 else value > limit.value
    template = _STOPPED[limit.side, beyond and abs(value - limit.value) > _PROBE]
    return tr(template, joint=tr(robot.joint_names[limit.joint]), limit=number)


def _where(robot: Robot, family: SingularFamily, q: FloatArray, preferences: Preferences) -> str:
    """Where the arm is: the joint that alone makes the singularity, else the family's terms."""
    probes = family.values(q + _PROBE * np.eye(robot.dof)) - family.values(q)
    joints = np.flatnonzero(np.abs(probes).max(axis=-1) > 1e-9)
    if len(joints) != 1:
        return value_text(family, q, robot, preferences)
    joint = int(joints[0])
    value = format_quantity(float(q[joint]), joint_kind(robot, joint), preferences)
    return left_to_right(f"J{joint + 1} = {value}")


def _lost_words(robot: Robot, family: SingularFamily, q: FloatArray) -> str:
    way = go_to_singularity(robot, family, q)
    there = way.outside if way.q is None else way.q
    if there is None:
        return ""
    found = singularity(robot, there)
    measures = found.task if found.task.lost is not None else found.position
    return tr(" or ").join(map(_motion_words, lost_motions(measures, robot.size)))


def _motion_words(motion: LostMotion) -> str:
    way = direction_text(motion.direction)
    if motion.kind == "move":
        return tr("move along {axis} without turning", axis=way) if motion.alone else tr("move along {axis}", axis=way)
    return tr("turn about {axis} in place", axis=way) if motion.alone else tr("turn about {axis}", axis=way)
