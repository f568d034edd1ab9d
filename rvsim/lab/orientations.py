"""What an orientation's name means for an arm and a path.

"down", "free", "keep" as it is now, the "source"'s own, "turn" evenly from one to another, "normal" to the path's
plane, or with the "pitch" held.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple, get_args

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import NoClosedFormError, UnknownNameError
from rvsim.experiment import PathOrientation
from rvsim.kinematics import forward_kinematics
from rvsim.kinematics.inverse import nearest_feasible_poses
from rvsim.language import tr_later
from rvsim.motion import TOOL_DOWN, Path
from rvsim.motion.path import radial_rotations
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.spatial import rot_x, rot_z, rotation_from_rpy, rotation_from_vector, rotation_vector

ORIENTATIONS: tuple[PathOrientation, ...] = get_args(PathOrientation)

SourceRotations = Callable[[FloatArray], FloatArray]

# Arms whose wrist is made to look the other way hold their tools so: turned about the vertical by half a turn.
_DOWN_TURNED = np.diag([-1.0, 1.0, -1.0])
_UPRIGHT_CUT = 1e-9
# Arms of three joints or fewer place the tool; how it is turned follows.
_FEWEST_JOINTS_TO_TURN = 4
_FEWEST_JOINTS_TO_POINT = 5  # with fewer the tool cannot point where one likes
_FLAT = 1e-9  # of the length: a path that leaves the plane by less, or a line, which lies in many

Angles = tuple[float, float, float]


class Wanted(NamedTuple):
    """What some orientations need to know besides: see `TrajectoryTask`; `normal` (3,) is of the path's plane."""

    turn_from: Angles | None = None
    turn_to: Angles | None = None
    pitch: float = -math.pi / 2
    normal: FloatArray | None = None


def down_rotation(robot: Robot) -> FloatArray:
    """(3, 3) tool-down: that of source 000, or turned by half a turn where the wrist lies nearer to that at home."""
    lowered = _lowered(forward_kinematics(robot, robot.home)[:3, :3])
    turned = lowered[0, 0] - lowered[1, 1] < -_UPRIGHT_CUT
    return _DOWN_TURNED if turned else np.asarray(TOOL_DOWN)


def _lowered(rotation: FloatArray) -> FloatArray:
    """A rotation (3, 3) turned as little as possible until its z axis points down."""
    if math.hypot(rotation[0, 2], rotation[1, 2]) < _UPRIGHT_CUT:
        return rotation if rotation[2, 2] < 0.0 else np.asarray(rot_x(np.pi) @ rotation)
    return _brought_onto(rotation, np.array([0.0, 0.0, -1.0]))


def level_rotations(points: FloatArray) -> FloatArray:
    """(m, 3, 3) the tool level, pointing away from the base axis: pitch 0."""
    return radial_rotations(points)


def oriented(
    robot: Robot,
    path: Path,
    orientation: PathOrientation,
    source: SourceRotations | None,
    q: ArrayLike | None = None,
    wanted: Wanted | None = None,
) -> Path:
    """The path with the orientation of that name.

    Args:
        source: the source's own rotations of points (m, 3), None for tool-down.
        q: (n,) the pose whose orientation "keep" keeps and from which "turn" turns; None for home.
        wanted: what "turn", "normal" and "pitch" are to do; the path's own plane where no normal is given.

    Raises:
        UnknownNameError: no such orientation.
    """
    if orientation not in ORIENTATIONS:
        raise UnknownNameError(tr_later("orientation"), orientation, ORIENTATIONS)
    if orientation == "free" or robot.dof < _FEWEST_JOINTS_TO_TURN:
        return path.with_rotation(None)
    present = robot.home if q is None else np.asarray(q)
    wish = wanted or Wanted()
    if orientation == "keep":
        return path.with_rotation(_kept(robot, path.points, present))
    if orientation == "source" and source is not None:
        return replace(path, rotations=source(path.points))
    if orientation in ("turn", "normal", "pitch") and robot.dof < _FEWEST_JOINTS_TO_POINT and not _points_down(robot):
        return path.with_rotation(None)
    if orientation == "turn":
        return path.with_rotation(feasible_rotations(robot, path.points, _turning(robot, path, present, wish)))
    if orientation in ("normal", "pitch") and robot.dof < _FEWEST_JOINTS_TO_POINT:
        return path.with_rotation(down_rotation(robot))
    if orientation == "normal":
        return path.with_rotation(normal_rotations(robot, path.points, _normal_of(path.points, wish.normal)))
    if orientation == "pitch":
        return path.with_rotation(radial_rotations(path.points) @ rot_x(-wish.pitch))
    return path.with_rotation(down_rotation(robot))


def _points_down(robot: Robot) -> bool:
    """Whether an arm that cannot tilt its tool holds it downwards."""
    return bool(forward_kinematics(robot, robot.home)[2, 2] < _UPRIGHT_CUT - 1.0)


def normal_rotations(robot: Robot, points: FloatArray, normal: FloatArray) -> FloatArray:
    """(m, 3, 3) the tool square to a plane, on its near side; of a 5R arm the nearest that it can have at each point.

    Args:
        normal: (3,) of the plane, either way.
    """
    middle = points.mean(axis=0)
    away = np.array([middle[0], middle[1], 0.0])
    away /= max(float(np.linalg.norm(away)), 1e-12)
    axis = normal if float(normal @ (0.75 * away - (0.0, 0.0, 1.0))) >= 0.0 else -normal
    rotation = _brought_onto(down_rotation(robot), axis / np.linalg.norm(axis))
    return feasible_rotations(robot, points, np.broadcast_to(rotation, (len(points), 3, 3)))


def feasible_rotations(robot: Robot, points: FloatArray, wanted: FloatArray) -> FloatArray:
    """(m, 3, 3) of a 5R arm the orientations that it can have at points (m, 3), nearest to those wanted; else these."""
    if robot.dof != 5:
        return wanted
    T = np.tile(np.eye(4), (len(points), 1, 1))
    T[:, :3, :3], T[:, :3, 3] = wanted, points
    try:
        return np.asarray(nearest_feasible_poses(robot, T)[:, :3, :3])
    except NoClosedFormError:
        return wanted


def normal_gap(path: Path, normal: FloatArray) -> float:
    """The largest angle [rad] between the tool axis along a path and its plane's normal (3,), either way; 0 if free."""
    if path.rotations is None:
        return 0.0
    axes, unit = path.rotations[:, :, 2], normal / np.linalg.norm(normal)
    sines = np.linalg.norm(np.cross(axes, unit), axis=1)
    return float(np.arctan2(sines, np.abs(axes @ unit)).max())


def _normal_of(points: FloatArray, normal: FloatArray | None) -> FloatArray:
    """The given one, or of the plane that fits best; of a line, which lies in many, the steepest one's."""
    if normal is not None:
        return normal
    _, spread, axes = np.linalg.svd(points - points.mean(axis=0), full_matrices=True)
    if spread[0] <= 0.0:
        return np.array([0.0, 0.0, 1.0])
    if len(spread) < 2 or spread[1] > _FLAT * spread[0]:
        return np.asarray(axes[2])
    along = axes[0]
    up = np.array([0.0, 0.0, 1.0]) - along[2] * along
    return np.asarray(up if float(np.linalg.norm(up)) > _FLAT else axes[2])


def _brought_onto(rotation: FloatArray, axis: FloatArray) -> FloatArray:
    """A rotation (3, 3) turned as little as possible until its z axis is `axis` (3,)."""
    across = np.cross(rotation[:, 2], axis)
    sine = float(np.linalg.norm(across))
    if sine < _UPRIGHT_CUT:
        return rotation if float(rotation[:, 2] @ axis) > 0.0 else np.asarray(rotation @ rot_x(np.pi))
    angle = math.atan2(sine, float(rotation[:, 2] @ axis))
    return np.asarray(rotation_from_vector(across / sine * angle) @ rotation)


def _turning(robot: Robot, path: Path, q: FloatArray, wish: Wanted) -> FloatArray:
    """(m, 3, 3) from one orientation to another about one axis, evenly along the path (slerp)."""
    now = forward_kinematics(robot, q)[:3, :3]
    first = now if wish.turn_from is None else rotation_from_rpy(wish.turn_from)
    last = now if wish.turn_to is None else rotation_from_rpy(wish.turn_to)
    lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(path.points, axis=0), axis=1))])
    share = lengths / lengths[-1] if lengths[-1] > 0.0 else np.linspace(0.0, 1.0, path.samples)
    return np.asarray(rotation_from_vector(share[:, None] * rotation_vector(last @ first.T)) @ first)


def _kept(robot: Robot, points: FloatArray, q: FloatArray) -> FloatArray:
    """(m, 3, 3) as the tool is now; the tool of a 5R arm turns along with its waist, as it must."""
    T = forward_kinematics(robot, q)
    if robot.dof != 5:
        return np.broadcast_to(T[:3, :3], (len(points), 3, 3))
    turn = np.arctan2(points[:, 1], points[:, 0]) - np.arctan2(T[1, 3], T[0, 3])
    return np.asarray(rot_z(turn) @ T[:3, :3])
