"""Branches in words: the limit one breaks, how far one is from its limits, and what is lost near a singularity."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import format_number, format_quantity, joint_kind
from rvsim.kinematics import Branch, jacobian
from rvsim.language import tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_TOUCHES = 1e-9  # [rad, m] a limit is reached, not broken, up to here
_BESIDE = 0.03  # [rad, sizes]
_BOTH = 0.1
_SINGULAR = 1e-6
_NEAR_SINGULAR = 0.02  # of the tool's motion in sizes of the arm a radian of the joints

# Whether it is lost altogether, whether it is a shift or a turn, and whether only one without the other.
_LOST = {
    (True, True, False): tr_later("Singular: the tool cannot move along {direction}."),
    (True, True, True): tr_later("Singular: the tool cannot move along {direction} without turning."),
    (True, False, False): tr_later("Singular: the tool cannot turn about {direction}."),
    (True, False, True): tr_later("Singular: the tool cannot turn about {direction} in place."),
    (False, True, False): tr_later("Near a singularity: the tool can hardly move along {direction}."),
    (False, True, True): tr_later("Near a singularity: the tool can hardly move along {direction} without turning."),
    (False, False, False): tr_later("Near a singularity: the tool can hardly turn about {direction}."),
    (False, False, True): tr_later("Near a singularity: the tool can hardly turn about {direction} in place."),
}


def circled(name: str) -> str:
    """A branch's number as it is written in scene and table: "3" as "③"; other names as they are."""
    return chr(0x245F + int(name)) if name.isdigit() and 1 <= int(name) <= 20 else name


def limit_words(robot: Robot, branch: Branch, preferences: Preferences, between: str = "; ") -> str:
    """Which joints leave their limits: "elbow −156.7° stops at −110.0°"; nothing for a branch within them."""
    broken = broken_joints(branch).tolist()
    return between.join(_broken(robot, joint, float(branch.q[joint]), preferences) for joint in broken)


def _broken(robot: Robot, joint: int, value: float, preferences: Preferences) -> str:
    lower, upper = robot.limits[joint]
    kind = joint_kind(robot, joint)
    texts = [format_quantity(number, kind, preferences) for number in (value, lower if value < lower else upper)]
    return tr("{joint} {value} stops at {limit}", joint=tr(robot.joint_names[joint]), value=texts[0], limit=texts[1])


def short_limit_words(robot: Robot, branch: Branch, preferences: Preferences) -> str:
    """The limits that are broken, short: "elbow stops at −110.0°", or of several joints "shoulder, elbow stop"."""
    broken = broken_joints(branch).tolist() or [int(np.argmin(branch.limit_margin))]
    if len(broken) > 1:
        return tr("{joints} stop", joints=tr(", ").join(tr(robot.joint_names[joint]) for joint in broken))
    (joint,) = broken
    lower, upper = robot.limits[joint]
    stop = format_quantity(lower if branch.q[joint] < lower else upper, joint_kind(robot, joint), preferences)
    return tr("{joint} stops at {limit}", joint=tr(robot.joint_names[joint]), limit=stop)


def broken_joints(branch: Branch) -> NDArray[np.intp]:
    """The joints (from 0) that a branch takes beyond their limits."""
    return np.flatnonzero(branch.limit_margin < -_TOUCHES)


def margin_words(robot: Robot, branch: Branch, preferences: Preferences) -> str:
    """How far the joint that is nearest to a limit is from it: "elbow 46.7° before its limit"."""
    joint = int(np.argmin(branch.limit_margin))
    margin = float(branch.limit_margin[joint])
    if np.isinf(margin):
        return tr("no joint has a limit")
    return tr(
        "{joint} {distance} before its limit",
        joint=tr(robot.joint_names[joint]),
        distance=format_quantity(margin, joint_kind(robot, joint), preferences),
    )


def singular_words(robot: Robot, q: FloatArray) -> str:
    """What the tool can hardly do at q (n,): a sentence near a singularity, else nothing.

    The left singular vector of the least singular value of J is the motion that is lost; lengths count in sizes of
    the arm. An arm of few joints has lost nothing by having few.
    """
    _, least, idle = _least_motion(robot, q)
    if least > _NEAR_SINGULAR:
        return ""
    # At the pose itself what is lost cannot be told from what the arm never had: a little beside it can.
    beside = q + _BESIDE * np.where(robot.is_revolute, 1.0, robot.size) * idle
    left, _, _ = _least_motion(robot, beside)
    shift, turn = left[:3], left[3:]
    # A motion is lost as far as it lies along this one: a shift alone, a turn alone, or only one without the other.
    shifts = bool(np.linalg.norm(shift) >= np.linalg.norm(turn))
    main, other = (shift, turn) if shifts else (turn, shift)
    sentence = _LOST[least < _SINGULAR, shifts, bool(np.linalg.norm(other) > _BOTH)]
    return tr(sentence, direction=_direction(main))


def _least_motion(robot: Robot, q: FloatArray) -> tuple[FloatArray, float, FloatArray]:
    """The tool's motion (6,) that takes most of the joints, its singular value, and those joints (n,), scaled."""
    lengths = np.where(robot.is_revolute, 1.0, robot.size)
    J = jacobian(robot, q) * lengths
    J[:3] /= robot.size
    left, sigma, right = np.linalg.svd(J, full_matrices=False)
    return left[:, -1], float(sigma[-1]), right[-1]


def _direction(vector: FloatArray) -> str:
    """A direction by the axis it lies on, else by its numbers."""
    unit = vector / np.linalg.norm(vector)
    axis = int(np.argmax(np.abs(unit)))
    if abs(unit[axis]) > 0.995:
        return "xyz"[axis]
    unit = unit * np.sign(unit[axis])
    return f"({', '.join(format_number(float(part), 2) for part in unit)})"
