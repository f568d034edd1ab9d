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
from rvsim.language import tr
from rvsim.motion.jog import JogStep
from rvsim.motion.jog_course import Limit
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_NEAR = 0.25  # of a family's scaled terms
_PROBE = 1e-4


def stop_text(robot: Robot, step: JogStep, preferences: Preferences) -> str:
    """The sentence for a step at the end of its course."""
    if isinstance(step.cause, Limit):
        return _limit_text(robot, step.cause, float(step.q[step.cause.joint]), preferences)
    families = [family for family in singular_families(robot) if family.measure(step.q) < _NEAR]
    if step.cause is None or not families:
        return step.stopped_reason
    family = min(families, key=lambda family: float(family.measure(step.q)))
    lost = _lost_words(robot, family, step.q)
    there = tr(": there the tool cannot {lost}", lost=lost) if lost else ""
    return tr(
        "Stopped before the {title}, {where}{there}.",
        title=family.title,
        where=_where(robot, family, step.q, preferences),
        there=there,
    )


def _limit_text(robot: Robot, limit: Limit, value: float, preferences: Preferences) -> str:
    number = format_quantity(limit.value, joint_kind(robot, limit.joint), preferences)
    beyond = value < limit.value if limit.side == 0 else value > limit.value
    where = "beyond" if beyond and abs(value - limit.value) > _PROBE else "at"
    return tr(
        "Stopped: the {joint_names} is {where} its {side_name} limit, {number}.",
        joint_names=robot.joint_names[limit.joint],
        where=where,
        side_name=limit.side_name,
        number=number,
    )


def _where(robot: Robot, family: SingularFamily, q: FloatArray, preferences: Preferences) -> str:
    """Where the arm is: the joint that alone makes the singularity, else the family's terms."""
    probes = family.values(q + _PROBE * np.eye(robot.dof)) - family.values(q)
    joints = np.flatnonzero(np.abs(probes).max(axis=-1) > 1e-9)
    if len(joints) != 1:
        return value_text(family, q, robot, preferences)
    joint = int(joints[0])
    return f"J{joint + 1} = {format_quantity(float(q[joint]), joint_kind(robot, joint), preferences)}"


def _lost_words(robot: Robot, family: SingularFamily, q: FloatArray) -> str:
    way = go_to_singularity(robot, family, q)
    there = way.outside if way.q is None else way.q
    if there is None:
        return ""
    found = singularity(robot, there)
    measures = found.task if found.task.lost is not None else found.position
    return " or ".join(map(_motion_words, lost_motions(measures, robot.size)))


def _motion_words(motion: LostMotion) -> str:
    way = direction_text(motion.direction)
    if motion.kind == "move":
        return tr("move along {way}{value}", way=way, value=tr(" without turning") if motion.alone else "")
    return tr("turn about {way}{value}", way=way, value=tr(" in place") if motion.alone else "")
