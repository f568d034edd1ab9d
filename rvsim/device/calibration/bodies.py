"""What of an arm one sees move when a joint moves: a direction, and whether it turns round, tilts, bends or rolls."""

from __future__ import annotations

from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.kinematics import forward_kinematics, link_transforms
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

# The arm swings round a vertical axis; a link tilts against the level; a link bends against the one before it; the hand
# rolls about its own length; or none of these: sliding, or hard to say.
Kind = Literal["turn", "tilt", "bend", "roll", "other"]
_ON_AXIS = 0.01  # of the arm's size
_UPRIGHT, _LEVEL = 0.99, 0.05  # of an axis' vertical part


class Body(NamedTuple):
    """What a joint moves, in a pose: unit vectors (3,) in base axes.

    Args:
        axis: of the joint.
        along: from the joint to what it carries, at a right angle to the axis; zeros where that lies on the axis.
        before: the same of the link that the joint hangs on; zeros for the first one.
        kind: see `Kind`.
    """

    axis: FloatArray
    along: FloatArray
    before: FloatArray
    kind: Kind


def body_of(robot: Robot, joint: int, q: ArrayLike) -> Body:
    """What joint `joint` (from 0) moves in the pose q (n,) [rad, m]."""
    axes, points = _axes_and_points(robot, q)
    axis, origin = axes[joint], points[joint]
    carried = points[[-1]] if abs(axis[2]) > _UPRIGHT else points[joint + 1 :]
    along = _first_off_axis(robot, axis, carried - origin)
    before = _first_off_axis(robot, axis, origin - points[:joint][::-1])
    return Body(axis, along, before, _kind(robot, joint, q, axis, along, before))


def _axes_and_points(robot: Robot, q: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """(n, 3) directions of the joints' axes; (n + 1, 3) a point on each, and the tool."""
    T = link_transforms(robot, q)
    frames = T[1:] if robot.convention == "modified" else T[:-1]
    tool = forward_kinematics(robot, q)[:3, 3]
    return frames[:, :3, 2], np.vstack([frames[:, :3, 3], tool])


def _first_off_axis(robot: Robot, axis: FloatArray, ways: FloatArray) -> FloatArray:
    for way in ways:
        across = way - axis * float(axis @ way)
        length = float(np.linalg.norm(across))
        if length > _ON_AXIS * robot.size:
            return np.asarray(across / length)
    return np.zeros(3)


def _kind(robot: Robot, joint: int, q: ArrayLike, axis: FloatArray, along: FloatArray, before: FloatArray) -> Kind:
    if not robot.joints[joint].revolute:
        return "other"
    if not along.any():
        return "roll"
    if abs(axis[2]) > _UPRIGHT:
        return "turn" if joint == 0 else "bend" if before.any() else "other"
    if abs(axis[2]) < _LEVEL and all(body_of(robot, earlier, q).kind == "turn" for earlier in range(joint)):
        return "tilt"
    return "bend" if before.any() else "other"
