"""What stands against letting a real arm do a motion: limits, speeds, the table and the arm itself, in sentences."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rvsim.kinematics.clearance import clearance
from rvsim.lab.findings import length_words
from rvsim.lab.sentences import Units, joint_amount
from rvsim.language import tr, tr_later
from rvsim.motion import joint_move
from rvsim.playback.player import Playable
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_MOMENTS = 401
_ROUNDING = 1e-9
_FULL = 1.02  # of a joint's speed, which is measured between moments
# What touches the table, and what the arm itself: on the motion, and before it.
_DURING = (
    tr_later("At {seconds:.2f} s the arm would touch the table, {depth} deep."),
    tr_later("At {seconds:.2f} s the arm would touch itself, {depth} deep."),
)
_BEFORE = (
    tr_later("On the way to its start: at {seconds:.2f} s the arm would touch the table, {depth} deep."),
    tr_later("On the way to its start: at {seconds:.2f} s the arm would touch itself, {depth} deep."),
)


def objections(
    robot: Robot, motion: Playable, units: Units, *, table: float | None = 0.0, here: FloatArray | None = None
) -> tuple[str, ...]:
    """Sentences, none if the motion may run.

    Args:
        table: its height [m], None where there is none.
        here: (n,) from where the arm goes calmly to the motion's start; None or NaN: nobody knows.
    """
    times = np.linspace(0.0, motion.duration, _MOMENTS)
    q = np.asarray(motion.q(times), dtype=np.float64)
    if q.shape != (_MOMENTS, robot.dof):
        return (tr("It is a motion of {joints} joints, and the arm has {dof}.", joints=q.shape[-1], dof=robot.dof),)
    return (
        *_on_the_way(robot, here, q[0], table, units),
        *_limits(robot, times, q, units),
        *_speeds(robot, times, q),
        *_clearances(robot, times, q, table, units, _DURING),
    )


def what_is_touched(robot: Robot, q: FloatArray, *, table: float | None = 0.0) -> str:
    """What the arm would touch in a pose (n,): "the table", "itself", or "" for nothing."""
    clear = clearance(robot, q, table=0.0 if table is None else table)
    if table is not None and clear.table < 0.0:
        return tr("the table")
    return tr("itself") if clear.own < 0.0 else ""


def _on_the_way(
    robot: Robot, here: FloatArray | None, start: FloatArray, table: float | None, units: Units
) -> Iterator[str]:
    """What would be touched before the motion begins; its limits are between those of its ends, its speed is calm."""
    if here is None or not np.isfinite(here).all():
        return
    move = joint_move(robot, here, start)
    times = np.linspace(0.0, move.duration, _MOMENTS)
    yield from _clearances(robot, times, move.q(times), table, units, _BEFORE)


def _limits(robot: Robot, times: FloatArray, q: FloatArray, units: Units) -> Iterator[str]:
    for index, (lower, upper) in enumerate(robot.limits):
        beyond = np.maximum(lower - q[:, index], q[:, index] - upper)
        worst = int(np.argmax(beyond))
        if beyond[worst] > _ROUNDING:
            value = float(q[worst, index])
            limit = float(lower if value < lower else upper)
            name = robot.joint_names[index]
            needs, ends = (joint_amount(robot, name, angle, units) for angle in (value, limit))
            yield tr(
                "At {seconds:.2f} s {joint} would be at {needs}; arm and servos stop at {ends}.",
                seconds=times[worst],
                joint=tr(name),
                needs=needs,
                ends=ends,
            )


def _speeds(robot: Robot, times: FloatArray, q: FloatArray) -> Iterator[str]:
    rates = np.abs(np.diff(q, axis=0)) / max(float(times[1] - times[0]), 1e-9)
    for index, joint in enumerate(robot.joints):
        if joint.max_speed is None:
            continue
        share = float(rates[:, index].max()) / joint.max_speed.value
        if share > _FULL:
            yield tr(
                "{joint} would turn at {share:.0%} of its top speed: give the motion more time.",
                joint=tr(joint.name),
                share=share,
            )


def _clearances(
    robot: Robot, times: FloatArray, q: FloatArray, table: float | None, units: Units, sentences: tuple[str, str]
) -> Iterator[str]:
    """The sentences for the table and for the arm itself, in their order."""
    clear = clearance(robot, q, table=0.0 if table is None else table)
    for sentence, found in zip(sentences, (clear.table if table is not None else None, clear.own), strict=True):
        if found is None or not len(found):
            continue
        worst = int(np.argmin(found))
        if found[worst] < 0.0:
            depth = length_words(robot, -float(found[worst]), units)
            yield tr(sentence, seconds=times[worst], depth=depth)
