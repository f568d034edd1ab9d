"""Poses of single joints in words that people check by eye, a set square and a spirit level."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.device.calibration.bodies import Body, Kind, body_of
from rvsim.device.words import axis_name
from rvsim.kinematics import link_transforms
from rvsim.language import tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.units import degrees_from_radians, millimetres_from_metres

_PARTS = {
    "base": tr_later("arm"),
    "waist": tr_later("arm"),
    "shoulder": tr_later("upper arm"),
    "elbow": tr_later("forearm"),
    "wrist": tr_later("hand"),
    "wrist pitch": tr_later("hand"),
}
_UP = np.array([0.0, 0.0, 1.0])
_AHEAD = np.array([1.0, 0.0, 0.0])
_SEEN = 0.05  # sine of an angle that one sees


class Pose(NamedTuple):
    """What one sees of a joint: as a part of a sentence, and in a few words; "" where it needs more."""

    whole: str
    brief: str = ""


def pose_words(robot: Robot, joint: int, q: ArrayLike) -> str:
    """What one sees of joint `joint` (from 0) in the pose q (n,) [rad, m]: "the upper arm stands straight up"."""
    return _pose(robot, joint, q).whole


def brief_words(robot: Robot, joint: int, q: ArrayLike) -> str:
    """The same in a few words: "upper arm stands straight up"; "" for what they cannot say."""
    return _pose(robot, joint, q).brief


def _pose(robot: Robot, joint: int, q: ArrayLike) -> Pose:
    pose = np.asarray(q, dtype=np.float64)
    body = body_of(robot, joint, pose)
    return _WORDS[body.kind](_Seen(robot, joint, pose, body))


def part_name(robot: Robot, joint: int) -> str:
    """What a joint moves, in the words of people: the shoulder moves the upper arm."""
    known = _PARTS.get(robot.joints[joint].name.lower(), tr_later("hand") if joint == robot.dof - 1 else "")
    return tr(known) if known else tr("link behind the joint “{joint}”", joint=axis_name(robot, joint))


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

    def say(self, whole: str, brief: str = "", **values: object) -> Pose:
        """Texts about the part that the joint moves."""
        part = part_name(self.robot, self.joint)
        return Pose(tr(whole, part=part, **values), tr(brief, part=part, **values) if brief else "")


_Texts = tuple[str, str]  # a whole one and a brief one
_HEADINGS: dict[int, _Texts] = {
    0: (
        tr_later("the {part} points straight ahead, along the x axis of the base"),
        tr_later("{part} points straight ahead"),
    ),
    180: (
        tr_later("the {part} points straight back, against the x axis of the base"),
        tr_later("{part} points straight back"),
    ),
    90: (
        tr_later(
            "the {part} points to the left, at a right angle to straight ahead (seen from above, looking along x)"
        ),
        tr_later("{part} points to the left"),
    ),
    -90: (
        tr_later(
            "the {part} points to the right, at a right angle to straight ahead (seen from above, looking along x)"
        ),
        tr_later("{part} points to the right"),
    ),
}
_LEFT = tr_later("the {part} points {angle}° to the left of straight ahead (seen from above, looking along x)")
_RIGHT = tr_later("the {part} points {angle}° to the right of straight ahead (seen from above, looking along x)")
_BACKWARD: _Texts = (tr_later("the {part} lies level, pointing backward"), tr_later("{part} lies level"))
_ELEVATIONS: dict[int, _Texts] = {
    0: (tr_later("the {part} lies level, pointing forward"), tr_later("{part} lies level")),
    90: (tr_later("the {part} stands straight up"), tr_later("{part} stands straight up")),
    -90: (tr_later("the {part} hangs straight down"), tr_later("{part} hangs straight down")),
    180: _BACKWARD,
    -180: _BACKWARD,
}
# By whether it points forward, and whether above the level.
_LEANS: dict[tuple[bool, bool], _Texts] = {
    (True, True): (
        tr_later("the {part} points forward, {angle}° above the level"), tr_later("{part} points forward")
    ),
    (True, False): (
        tr_later("the {part} points forward, {angle}° below the level"), tr_later("{part} points forward")
    ),
    (False, True): (
        tr_later("the {part} points backward, {angle}° above the level"), tr_later("{part} points backward")
    ),
    (False, False): (
        tr_later("the {part} points backward, {angle}° below the level"), tr_later("{part} points backward")
    ),
}  # fmt: skip
# By whether it has fingers that are side by side at zero, and whether it is turned clockwise.
_TURNS = {
    (True, True): tr_later(
        "the {part} is turned {angle}° clockwise from the pose with its fingers side by side, seen from the arm"
    ),
    (True, False): tr_later(
        "the {part} is turned {angle}° counter-clockwise from the pose with its fingers side by side, seen from the arm"
    ),
    (False, True): tr_later("the {part} is turned {angle}° clockwise from its middle, seen from the arm"),
    (False, False): tr_later("the {part} is turned {angle}° counter-clockwise from its middle, seen from the arm"),
}


def _turn(seen: _Seen) -> Pose:
    heading = _whole(math.atan2(seen.body.along[1], seen.body.along[0]))
    known = _HEADINGS.get(180 if heading == -180 else heading)
    return seen.say(*known) if known else seen.say(_LEFT if heading > 0 else _RIGHT, angle=abs(heading))


def _tilt(seen: _Seen) -> Pose:
    elevation = _whole(math.atan2(seen.body.along @ _UP, seen.body.along @ _forward(seen.body)))
    known = _ELEVATIONS.get(elevation)
    if known:
        return seen.say(*known)
    lean = min(abs(elevation), 180 - abs(elevation))
    return seen.say(*_LEANS[abs(elevation) < 90, elevation > 0], angle=lean)


def _bend(seen: _Seen) -> Pose:
    cosine = float(np.clip(seen.body.along @ seen.body.before, -1.0, 1.0))
    angle, before = _whole(math.acos(cosine)), part_name(seen.robot, seen.joint - 1)
    if angle == 0:
        whole = tr_later("the {part} is in line with the {before}")
        return seen.say(whole, tr_later("{part} is in line with the {before}"), before=before)
    if angle == 180:
        whole = tr_later("the {part} is folded back onto the {before}")
        return seen.say(whole, tr_later("{part} is folded back onto the {before}"), before=before)
    side = _side(seen.body, seen.body.along - cosine * seen.body.before)
    if angle == 90:
        whole = tr_later("the {part} is at a right angle to the {before}, bent {side}")
        return seen.say(whole, before=before, side=side)
    whole = tr_later("the {part} is bent {angle}° {side} from the line of the {before}")
    return seen.say(whole, before=before, side=side, angle=angle)


def _roll(seen: _Seen) -> Pose:
    """From where the fingers are side by side; without fingers, from where the joint is at zero."""
    turned, fingers = _whole(float(seen.q[seen.joint])), _side_by_side(seen)
    if turned == 0 and fingers:
        return seen.say(tr_later("the {part} is not turned: its two fingers are side by side, level"))
    if turned == 0:
        return seen.say(tr_later("the {part} is not turned"), tr_later("{part} is not turned"))
    outward = link_transforms(seen.robot, seen.q)[-1, :3, 3] - link_transforms(seen.robot, seen.q)[seen.joint, :3, 3]
    clockwise = turned * float(seen.body.axis @ outward) > 0.0
    return seen.say(_TURNS[fingers, clockwise], angle=abs(turned))


def _other(seen: _Seen) -> Pose:
    number = number_words(seen.robot, seen.joint, float(seen.q[seen.joint]))
    return seen.say(
        tr_later("the {part} stands at {number}, as the scene shows"),
        tr_later("{part} stands at {number}"),
        number=number,
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
        return tr("upward") if height > 0.0 else tr("downward")
    return tr("forward") if ahead > 0.0 else tr("backward")


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


_WORDS: dict[Kind, Callable[[_Seen], Pose]] = {
    "turn": _turn,
    "tilt": _tilt,
    "bend": _bend,
    "roll": _roll,
    "other": _other,
}
