"""What the wizard asks for, one thing after the other, in words."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from rvsim.device.calibration.marks import MarkPlan
from rvsim.device.calibration.words import number_words, pose_words
from rvsim.device.words import axis_name, in_a_row, with_capital
from rvsim.language import tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

Stage = Literal["first pose", "second pose", "least end", "largest end", "open", "closed"]
GRIPPER_STAGES: tuple[Stage, ...] = ("open", "closed")
POSES: tuple[Stage, ...] = ("first pose", "second pose")
ENDS: tuple[Stage, ...] = ("least end", "largest end")
_TITLES: dict[Stage, str] = {
    "first pose": tr_later("{axis}: first pose"),
    "second pose": tr_later("{axis}: second pose"),
    "least end": tr_later("{axis}: how far one way"),
    "largest end": tr_later("{axis}: how far the other way"),
    "open": tr_later("{axis}: open"),
    "closed": tr_later("{axis}: closed"),
}


@dataclass(frozen=True, eq=False)
class Step:
    """One thing to do.

    Args:
        joint: which one (from 0), or None: the gripper.
        stage: what is to be found.
        title: "Shoulder: first pose".
        instruction: what to do, whole sentences.
        value: where the joint should be [rad, m]; None where any place may be marked (ends, gripper).
        posture: (n,) how the arm should stand meanwhile [rad, m]; a scene may show it.
        channel: of the servo to be nudged.
        expected_us: the pulse that the calibration so far would give there [µs]; None where it says nothing.
        skip: what skipping does, a sentence.
        number, count: this is the number-th of count steps.
    """

    joint: int | None
    stage: Stage
    title: str
    instruction: str
    value: float | None
    posture: FloatArray
    channel: int
    expected_us: float | None
    skip: str
    number: int
    count: int


def title(name: str, stage: Stage) -> str:
    """Short, for above the instruction."""
    return tr(_TITLES[stage], axis=with_capital(name))


def instruction(robot: Robot, joint: int | None, stage: Stage, plan: MarkPlan) -> str:
    """What to do, in words."""
    if joint is None:
        if stage == "open":
            return tr("Nudge the gripper until its fingers are as far apart as they go, then press Mark.")
        return tr("Nudge the gripper until its fingers just touch, without humming, then press Mark.")
    name, pose = axis_name(robot, joint), plan.postures[stage in ("second pose", "largest end")]
    words = pose_words(robot, joint, pose)
    if stage in POSES:
        nudge = tr("Nudge the {joint} until {pose}, then press Mark.", joint=name, pose=words)
        return f"{nudge} {_others(robot, joint, plan)}"
    return tr(
        "Nudge the {joint} on, past where {pose}, as far as it may go without humming or touching anything, "
        "then press Mark.",
        joint=name,
        pose=words,
    )


def skip(joint: int | None, stage: Stage) -> str:
    """What skipping does."""
    if stage in ENDS:
        return tr("The joint may go as far as it could before, measured in degrees.")
    if joint is None:
        return tr("The gripper keeps its present calibration.")
    return tr("The joint keeps its present calibration.")


def _others(robot: Robot, joint: int, plan: MarkPlan) -> str:
    """How the rest of the arm should stand, where it is not at home."""
    posture = plan.postures[0]
    away = [
        tr(
            "{joint} about {number}",
            joint=axis_name(robot, index),
            number=number_words(robot, index, float(posture[index])),
        )
        for index in range(robot.dof)
        if index != joint and posture[index] != robot.home[index]
    ]
    if not away:
        return tr("The other joints stand about as at home.")
    return tr("The other joints stand about as the scene shows: {joints}.", joints=in_a_row(away))
