"""What marks say: the servo of a joint or of the gripper, and what is wrong with the last one."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from rvsim.device.calibration.fit import LEAST_TRAVEL_US, Fit, Objection, fit_from_samples
from rvsim.device.calibration.steps import ENDS, GRIPPER_STAGES, POSES, Stage
from rvsim.device.calibration.words import number_words
from rvsim.language import tr, tr_later
from rvsim.robot import GripperServo, Robot, Servo
from rvsim.robot.servo import LONGEST_US, SHORTEST_US

CLOSE, CLOSE_SLIDING = math.radians(20.0), 0.02  # [rad], [m] errors in reading grow between marks so close together
_SLACK_US = 5.0
_SHORTER = tr_later(
    "{end:g} µs is the wrong way: this end has shorter pulses than the pose at {pose:g} µs. "
    "Nudge on from that pose, not back through it."
)
_LONGER = tr_later(
    "{end:g} µs is the wrong way: this end has longer pulses than the pose at {pose:g} µs. "
    "Nudge on from that pose, not back through it."
)


@dataclass(frozen=True)
class Mark:
    """An answer to a step.

    Args:
        joint, stage: which step; no joint means the gripper.
        pulse_us: [µs]; None: it was skipped.
        value: what the pulse of a pose asked for [rad, m]: where the joint was seen, and how far it had given way.
    """

    joint: int | None
    stage: Stage
    pulse_us: float | None
    value: float = math.nan


Marks = Sequence[Mark]


def found_of(robot: Robot, marks: Marks, part: int | None) -> Servo | GripperServo | None:
    """The servo of a joint (from 0) or of the gripper (None) as marked; None until its marks are complete."""
    if part is None:
        return _gripper(robot, marks)
    servo = _line(robot, marks, part)
    if not isinstance(servo, Servo):
        return None
    least, largest = (_pulse(marks, part, stage) for stage in ENDS)
    shortest, longest = (least, largest) if servo.sign > 0 else (largest, least)
    return replace(
        servo,
        min_us=servo.min_us if shortest is None else shortest,
        max_us=servo.max_us if longest is None else longest,
    )


def objection_to_pulse(pulse_us: float) -> str:
    """Why no servo can have this pulse, or ""."""
    if not math.isfinite(pulse_us):
        return tr("The servo has no pulse: wake it first, then nudge it.")
    if not SHORTEST_US <= pulse_us <= LONGEST_US:
        return tr(
            "{pulse:g} µs is no pulse of the controller: its go from {shortest:g} to {longest:g} µs.",
            pulse=pulse_us,
            shortest=SHORTEST_US,
            longest=LONGEST_US,
        )
    return ""


def objection_to_last(robot: Robot, marks: Marks) -> str:
    """Why the last mark does not go with those before it, or ""."""
    last = marks[-1]
    if last.joint is None:
        return _wrong_gripper(marks)
    line = _line(robot, marks, last.joint)
    if line is None:
        return ""
    if isinstance(line, Objection):
        return line.sentence
    if last.stage in ENDS and last.pulse_us is not None:
        return _wrong_end([pulse for pulse, _ in _poses(marks, last.joint)], last.stage, last.pulse_us, line.sign)
    return _too_close(robot, marks, last.joint)


def _pulse(marks: Marks, joint: int | None, stage: Stage) -> float | None:
    """[µs]; None where it is not marked, or skipped."""
    found = [mark.pulse_us for mark in marks if (mark.joint, mark.stage) == (joint, stage)]
    return found[-1] if found else None


def _poses(marks: Marks, joint: int) -> list[tuple[float, float]]:
    """Pulse and value of the poses that are marked."""
    return [
        (mark.pulse_us, mark.value)
        for mark in marks
        if mark.joint == joint and mark.stage in POSES and mark.pulse_us is not None
    ]


def _line(robot: Robot, marks: Marks, joint: int) -> Servo | Objection | None:
    """Through both poses; None before they are marked."""
    poses = _poses(marks, joint)
    if len(poses) < len(POSES):
        return None
    pulses, values = zip(*poses, strict=True)
    fit = fit_from_samples(robot.servos[joint], pulses, values)
    return fit.servo if isinstance(fit, Fit) else fit


def _gripper(robot: Robot, marks: Marks) -> GripperServo | None:
    open_us, closed_us = (_pulse(marks, None, stage) for stage in GRIPPER_STAGES)
    if robot.gripper_servo is None or open_us is None or closed_us is None:
        return None
    return replace(robot.gripper_servo, open_us=open_us, closed_us=closed_us, assumed=False)


def _wrong_gripper(marks: Marks) -> str:
    open_us, closed_us = (_pulse(marks, None, stage) for stage in GRIPPER_STAGES)
    if open_us is None or closed_us is None or abs(open_us - closed_us) >= LEAST_TRAVEL_US:
        return ""
    return tr(
        "Open and closed have nearly the same pulse ({open:g} and {closed:g} µs): did the gripper move?",
        open=open_us,
        closed=closed_us,
    )


def _too_close(robot: Robot, marks: Marks, joint: int) -> str:
    (_, first), (_, second) = _poses(marks, joint)
    least = CLOSE if robot.joints[joint].revolute else CLOSE_SLIDING
    if abs(first - second) >= least:
        return ""
    return tr(
        "Both marks are only {distance} apart: errors in reading would grow. Choose poses at least {least} apart.",
        distance=number_words(robot, joint, abs(first - second)),
        least=number_words(robot, joint, least),
    )


def _wrong_end(poses_us: list[float], stage: Stage, end_us: float, sign: int) -> str:
    """An end lies beyond both poses, on its side."""
    shorter = (stage == "least end") == (sign > 0)
    pose = min(poses_us) if shorter else max(poses_us)
    if (end_us <= pose + _SLACK_US) if shorter else (end_us >= pose - _SLACK_US):
        return ""
    return tr(_SHORTER if shorter else _LONGER, end=end_us, pose=pose)
