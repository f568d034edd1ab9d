"""What a calibration has found: old value, new value, change, and what is odd about it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

from rvsim.device.calibration.fit import remarks_on
from rvsim.device.calibration.marks import usual_range
from rvsim.language import tr
from rvsim.robot import GripperServo, Joint, Robot, Servo
from rvsim.robot.servos import with_servo


class Change(NamedTuple):
    """One number of a servo; `unit` is "µs", "µs/°", "µs/mm" or ""."""

    what: str
    unit: str
    old: float
    new: float

    @property
    def difference(self) -> float:
        """New minus old."""
        return self.new - self.old


@dataclass(frozen=True)
class Result:
    """What was found of one joint (from 0), or of the gripper (None).

    Args:
        name: the joint's, or "gripper".
        old, new: its servo before and after.
        changes: number by number.
        remarks: what is odd, sentences.
    """

    joint: int | None
    name: str
    old: Servo | GripperServo
    new: Servo | GripperServo
    changes: tuple[Change, ...]
    remarks: tuple[str, ...]


def joint_result(robot: Robot, joint: int, new: Servo) -> Result:
    """Of a joint (from 0) of the arm as it was."""
    old, what = robot.servos[joint], robot.joints[joint]
    scale, step, unit = (math.radians(1.0), "degree", "µs/°") if what.revolute else (1e-3, "millimetre", "µs/mm")
    changes = (
        Change("direction", "", old.sign, new.sign),
        Change("pulse at zero", "µs", old.zero_us, new.zero_us),
        Change(f"pulse per {step}", unit, old.us_per_rad * scale, new.us_per_rad * scale),
        Change("shortest pulse", "µs", old.min_us, new.min_us),
        Change("longest pulse", "µs", old.max_us, new.max_us),
    )
    remarks = (
        *remarks_on(new, what.name, what.revolute),
        *_odd_directions(old, new, what),
        *_odd_range(robot, joint, new),
    )
    return Result(joint, what.name, old, new, changes, remarks)


def gripper_result(old: GripperServo, new: GripperServo) -> Result:
    """Of the gripper."""
    changes = (
        Change("open", "µs", old.open_us, new.open_us),
        Change("closed", "µs", old.closed_us, new.closed_us),
    )
    turned = (new.open_us > new.closed_us) != (old.open_us > old.closed_us)
    remarks = (tr("The gripper opens the other way round than before."),) if turned else ()
    return Result(None, "gripper", old, new, changes, remarks)


def _odd_directions(old: Servo, new: Servo, joint: Joint) -> tuple[str, ...]:
    if old.sign == new.sign:
        return ()
    return (tr("The {joint} turns the other way round than before.", joint=tr(joint.name)),)


def _odd_range(robot: Robot, joint: int, new: Servo) -> tuple[str, ...]:
    """Where arm and servo share little or nothing."""
    what = robot.joints[joint]
    least, largest = new.limits
    if min(largest, what.upper) <= max(least, what.lower):
        return (
            tr(
                "The servo would turn the {joint} outside of the arm's limits only. Mark its poses again.",
                joint=tr(what.name),
            ),
        )
    before, after = usual_range(robot, joint), usual_range(with_servo(robot, joint, new), joint)
    if after[1] - after[0] < 0.5 * (before[1] - before[0]):
        return (
            tr(
                "The {joint} would reach less than half of what it could before. Are both ends marked?",
                joint=tr(what.name),
            ),
        )
    return ()
