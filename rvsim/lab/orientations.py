"""What an orientation's name means for an arm and a path: "down", "free", "keep", or the "source"'s own."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import get_args

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import UnknownNameError
from rvsim.experiment import PathOrientation
from rvsim.kinematics import forward_kinematics
from rvsim.motion import TOOL_DOWN, Path
from rvsim.motion.path import radial_rotations
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.spatial import rot_x, rot_z, rotation_from_vector

ORIENTATIONS: tuple[PathOrientation, ...] = get_args(PathOrientation)

SourceRotations = Callable[[FloatArray], FloatArray]

# Arms whose wrist is made to look the other way hold their tools so: turned about the vertical by half a turn.
_DOWN_TURNED = np.diag([-1.0, 1.0, -1.0])
_UPRIGHT_CUT = 1e-9
# Arms of three joints or fewer place the tool; how it is turned follows.
_FEWEST_JOINTS_TO_TURN = 4


def down_rotation(robot: Robot) -> FloatArray:
    """(3, 3) tool-down: that of source 000, or turned by half a turn where the wrist lies nearer to that at home."""
    lowered = _lowered(forward_kinematics(robot, robot.home)[:3, :3])
    turned = lowered[0, 0] - lowered[1, 1] < -_UPRIGHT_CUT
    return _DOWN_TURNED if turned else np.asarray(TOOL_DOWN)


def _lowered(rotation: FloatArray) -> FloatArray:
    """A rotation (3, 3) turned as little as possible until its z axis points down."""
    axis = np.cross(rotation[:, 2], (0.0, 0.0, -1.0))
    sine = float(np.linalg.norm(axis))
    if sine < _UPRIGHT_CUT:
        return rotation if rotation[2, 2] < 0.0 else np.asarray(rot_x(np.pi) @ rotation)
    angle = np.arctan2(sine, -rotation[2, 2])
    return np.asarray(rotation_from_vector(axis / sine * angle) @ rotation)


def level_rotations(points: FloatArray) -> FloatArray:
    """(m, 3, 3) the tool level, pointing away from the base axis: pitch 0."""
    return radial_rotations(points)


def oriented(
    robot: Robot, path: Path, orientation: PathOrientation, source: SourceRotations | None, q: ArrayLike | None = None
) -> Path:
    """The path with the orientation of that name.

    Args:
        source: the source's own rotations of points (m, 3), None for tool-down.
        q: (n,) the pose whose orientation "keep" keeps; None for home.

    Raises:
        UnknownNameError: no such orientation.
    """
    if orientation not in ORIENTATIONS:
        raise UnknownNameError("orientation", orientation, ORIENTATIONS)
    if orientation == "free" or robot.dof < _FEWEST_JOINTS_TO_TURN:
        return path.with_rotation(None)
    if orientation == "keep":
        return path.with_rotation(_kept(robot, path.points, robot.home if q is None else np.asarray(q)))
    if orientation == "source" and source is not None:
        return replace(path, rotations=source(path.points))
    return path.with_rotation(down_rotation(robot))


def _kept(robot: Robot, points: FloatArray, q: FloatArray) -> FloatArray:
    """(m, 3, 3) as the tool is now; the tool of a 5R arm turns along with its waist, as it must."""
    T = forward_kinematics(robot, q)
    if robot.dof != 5:
        return np.broadcast_to(T[:3, :3], (len(points), 3, 3))
    turn = np.arctan2(points[:, 1], points[:, 0]) - np.arctan2(T[1, 3], T[0, 3])
    return np.asarray(rot_z(turn) @ T[:3, :3])
