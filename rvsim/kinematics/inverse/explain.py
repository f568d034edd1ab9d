"""Failures in sentences a student can act on: numbers in degrees and millimetres."""

from __future__ import annotations

import math

from rvsim.kinematics.inverse.copies import LIMIT_TOLERANCE
from rvsim.kinematics.inverse.result import Branch, Failure
from rvsim.robot import Joint, Robot


def angle_text(value: float) -> str:
    """An angle [rad] for a sentence."""
    return f"{math.degrees(value):.1f}°".replace("-", "−")


def length_text(robot: Robot, value: float) -> str:
    """A length [m] for a sentence, in the unit the arm is shown in."""
    text = f"{1e3 * value:.1f} mm" if robot.length_unit == "millimetre" else f"{value:.3f} units"
    return text.replace("-", "−")


def explain_reach(robot: Robot, failure: Failure) -> str:
    """Why a place cannot be reached."""
    away = length_text(robot, failure.nearest.position_error)
    return f"The place is out of reach: the nearest the tool gets is {away} away."


def explain_orientation(failure: Failure) -> str:
    """Why an orientation cannot be had."""
    turn = angle_text(failure.nearest.rotation_error)
    return f"The place can be reached, but not in this orientation: the nearest there is turned by {turn}."


def explain_limits(robot: Robot, branch: Branch, count: int) -> str:
    """Why no branch is within the limits; `branch` is the one nearest to them, of `count`."""
    broken = [
        f"{joint.name} needs {_value(robot, joint, value)}, stops at {_value(robot, joint, broken_limit(joint, value))}"
        for joint, value, margin in zip(robot.joints, branch.q.tolist(), branch.limit_margin.tolist(), strict=True)
        if margin < -LIMIT_TOLERANCE
    ]
    which = "The only branch is outside the limits" if count == 1 else f"All {count} branches are outside the limits"
    return f"{which}; nearest is “{branch.label}”: {'; '.join(broken)}."


def broken_limit(joint: Joint, value: float) -> float:
    """The limit a value breaks."""
    return joint.lower if value < joint.lower else joint.upper


def _value(robot: Robot, joint: Joint, value: float) -> str:
    return angle_text(value) if joint.revolute else length_text(robot, value)
