"""Poses of single joints in words that people check by eye, a set square and a spirit level."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.device.calibration.bodies import Body, Kind, body_of
from rvsim.kinematics import link_transforms
from rvsim.language import tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.units import degrees_from_radians, millimetres_from_metres

_PARTS = {
    "base": "arm",
    "waist": "arm",
    "shoulder": tr_later("upper arm"),
    "elbow": "forearm",
    "wrist": "hand",
    "wrist pitch": "hand",
}
_UP = np.array([0.0, 0.0, 1.0])
_AHEAD = np.array([1.0, 0.0, 0.0])
_SEEN = 0.05  # sine of an angle that one sees


def pose_words(robot: Robot, joint: int, q: ArrayLike) -> str:
    """What one sees of joint `joint` (from 0) in the pose q (n,) [rad, m]: "the upper arm stands straight up"."""
    pose = np.asarray(q, dtype=np.float64)
    body = body_of(robot, joint, pose)
    return tr(
        "the {part_name} {words}",
        part_name=part_name(robot, joint),
        words=_WORDS[body.kind](_Seen(robot, joint, pose, body)),
    )


def part_name(robot: Robot, joint: int) -> str:
    """What a joint moves, in the words of people: the shoulder moves the upper arm."""
    name = robot.joints[joint].name.lower()
    return _PARTS.get(name, "hand" if joint == robot.dof - 1 else f"link behind the joint “{name}”")


def number_words(robot: Robot, joint: int, value: float) -> str:
    """A joint's value with its unit, on whole ones rounded where it is whole."""
    turning = robot.joints[joint].revolute
    number = degrees_from_radians(value) if turning else millimetres_from_metres(value)
    text = f"{number:.1f}".removesuffix(".0").replace("-", "−")
    return f"{text}°" if turning else f"{text} mm"


class _Seen(NamedTuple):
    robot: Robot
    joint: int
    q: FloatArray
    body: Body


def _turn(seen: _Seen) -> str:
    heading = _whole(math.atan2(seen.body.along[1], seen.body.along[0]))
    side = "left" if heading > 0 else "right"
    if heading == 0:
        return tr("points straight ahead, along the x axis of the base")
    if abs(heading) == 180:
        return tr("points straight back, against the x axis of the base")
    if abs(heading) == 90:
        return tr(
            "points to the {side}, at a right angle to straight ahead (seen from above, looking along x)", side=side
        )
    return tr(
        "points {heading}° to the {side} of straight ahead (seen from above, looking along x)",
        heading=abs(heading),
        side=side,
    )


def _tilt(seen: _Seen) -> str:
    elevation = _whole(math.atan2(seen.body.along @ _UP, seen.body.along @ _forward(seen.body)))
    known = {
        0: tr("lies level, pointing forward"),
        90: tr("stands straight up"),
        -90: tr("hangs straight down"),
        180: tr("lies level, pointing backward"),
        -180: tr("lies level, pointing backward"),
    }
    if elevation in known:
        return known[elevation]
    over = "above" if elevation > 0 else "below"
    lean = min(abs(elevation), 180 - abs(elevation))
    return tr(
        "points {value}, {lean}° {over} the level",
        value="forward" if abs(elevation) < 90 else "backward",
        lean=lean,
        over=over,
    )


def _bend(seen: _Seen) -> str:
    cosine = float(np.clip(seen.body.along @ seen.body.before, -1.0, 1.0))
    angle, before = _whole(math.acos(cosine)), part_name(seen.robot, seen.joint - 1)
    if angle == 0:
        return tr("is in line with the {before}", before=before)
    if angle == 180:
        return tr("is folded back onto the {before}", before=before)
    side = _side(seen.body, seen.body.along - cosine * seen.body.before)
    if angle == 90:
        return tr("is at a right angle to the {before}, bent {side}", before=before, side=side)
    return tr("is bent {angle}° {side} from the line of the {before}", angle=angle, side=side, before=before)


def _roll(seen: _Seen) -> str:
    """From where the fingers are side by side; without fingers, from where the joint is at zero."""
    turned = _whole(float(seen.q[seen.joint]))
    if turned == 0:
        return (
            tr("is not turned: its two fingers are side by side, level") if _side_by_side(seen) else tr("is not turned")
        )
    outward = link_transforms(seen.robot, seen.q)[-1, :3, 3] - link_transforms(seen.robot, seen.q)[seen.joint, :3, 3]
    clockwise = turned * float(seen.body.axis @ outward) > 0.0
    start = tr("the pose with its fingers side by side") if _side_by_side(seen) else tr("its middle")
    return tr(
        "is turned {turned}° {value}clockwise from {start}, seen from the arm",
        turned=abs(turned),
        value="" if clockwise else "counter-",
        start=start,
    )


def _other(seen: _Seen) -> str:
    return tr(
        "stands at {number}, as the scene shows", number=number_words(seen.robot, seen.joint, float(seen.q[seen.joint]))
    )


def _side_by_side(seen: _Seen) -> bool:
    """Whether the fingers are level beside each other when the joint is at zero, and visibly not when it is turned."""
    gripper = seen.robot.gripper
    if gripper is None or not np.any(gripper.closing):
        return False
    poses = np.stack([seen.q, seen.q])
    poses[:, seen.joint] = 0.0, math.pi / 2.0
    across = link_transforms(seen.robot, poses)[:, -1, :3, :3] @ (gripper.closing / np.linalg.norm(gripper.closing))
    return bool(abs(across[0, 2]) < _SEEN < abs(across[1, 2]))


def _side(body: Body, across: FloatArray) -> str:
    """Which way a bend goes."""
    height, ahead = float(across @ _UP), float(across @ _forward(body))
    if max(abs(height), abs(ahead)) < _SEEN:
        return tr("to the left") if across[1] > 0.0 else tr("to the right")
    if abs(height) >= abs(ahead):
        return "upward" if height > 0.0 else "downward"
    return "forward" if ahead > 0.0 else "backward"


def _forward(body: Body) -> FloatArray:
    """The level direction in the plane in which the body moves; ahead rather than back, left rather than right."""
    level = np.cross(body.axis, _UP)
    length = float(np.linalg.norm(level))
    if length < _SEEN:
        return _AHEAD
    level /= length
    ahead = level[0] if abs(level[0]) > _SEEN else level[1]
    return level if ahead > 0.0 else -level


def _whole(angle: float) -> int:
    return round(math.degrees(angle))


_WORDS: dict[Kind, Callable[[_Seen], str]] = {
    "turn": _turn,
    "tilt": _tilt,
    "bend": _bend,
    "roll": _roll,
    "other": _other,
}
