"""What the wizard asks for, one thing after the other, in words."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from rvsim.device.calibration.marks import MarkPlan
from rvsim.device.calibration.words import number_words, pose_words
from rvsim.language import tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

Stage = Literal["first pose", "second pose", "least end", "largest end", "open", "closed"]
GRIPPER_STAGES: tuple[Stage, ...] = ("open", "closed")
POSES: tuple[Stage, ...] = ("first pose", "second pose")
ENDS: tuple[Stage, ...] = ("least end", "largest end")
_TITLES: dict[Stage, str] = {
    "first pose": tr_later("first pose"),
    "second pose": tr_later("second pose"),
    "least end": tr_later("how far one way"),
    "largest end": tr_later("how far the other way"),
    "open": "open",
    "closed": "closed",
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
    return f"{name[:1].upper()}{name[1:]}: {_TITLES[stage]}"


def instruction(robot: Robot, joint: int | None, stage: Stage, plan: MarkPlan) -> str:
    """What to do, in words."""
    if joint is None:
        what = tr("are as far apart as they go") if stage == "open" else tr("just touch, without humming")
        return tr("Nudge the gripper until its fingers {what}, then press Mark.", what=what)
    name, pose = robot.joints[joint].name, plan.postures[stage in ("second pose", "largest end")]
    words = pose_words(robot, joint, pose)
    if stage in POSES:
        return tr(
            "Nudge the {name} until {words}, then press Mark.{others}",
            name=name,
            words=words,
            others=_others(robot, joint, plan),
        )
    return tr(
        "Nudge the {name} on, past where {words}, as far as it may go without humming or touching anything, "
        "then press Mark.",
        name=name,
        words=words,
    )


def skip(joint: int | None, stage: Stage) -> str:
    """What skipping does."""
    if stage in ENDS:
        return tr("The joint may go as far as it could before, measured in degrees.")
    return tr("The {value} keeps its present calibration.", value="gripper" if joint is None else "joint")


def _others(robot: Robot, joint: int, plan: MarkPlan) -> str:
    """How the rest of the arm should stand, where it is not at home."""
    posture = plan.postures[0]
    away = [
        tr("{name} about {number}", name=other.name, number=number_words(robot, index, float(posture[index])))
        for index, other in enumerate(robot.joints)
        if index != joint and posture[index] != robot.home[index]
    ]
    if not away:
        return tr(" The other joints stand about as at home.")
    return tr(" The other joints stand about as the scene shows: {away}.", away=", ".join(away))
