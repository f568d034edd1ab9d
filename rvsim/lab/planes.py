"""The planes that a flat shape can be drawn in: named ones, one given by its normal, one through three points."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.experiment import Placement
from rvsim.language import tr_later
from rvsim.robot.arrays import FloatArray, frozen_array
from rvsim.spatial import rot_x, rot_z, rpy_from_rotation

_SAME = 1e-6  # of a unit axis: what rounded angles leave
_ON_THE_AXIS = 1e-9  # [m]
_LEAST_AREA = 1e-6  # of the square of the longest side: thinner triangles give no plane
_QUARTER = math.pi / 2


class Plane(NamedTuple):
    """A named plane: its title, a sentence about it, and its rotation (3, 3) for a shape at an azimuth [rad].

    The columns of the rotation are the shape's own axes: x along its lines of writing, y up the page, z the normal on
    the side from which it is read.
    """

    title: str
    tip: str
    rotation: Callable[[float], FloatArray]


PLANES = {
    "level": Plane(
        tr_later("Level (table)"), tr_later("Flat, as on a table; the normal points up"), lambda _: np.eye(3)
    ),
    "facing": Plane(
        tr_later("Upright, facing the arm"),
        tr_later("Like a board before the arm, read from the arm's side"),
        lambda azimuth: np.asarray(rot_z(azimuth - _QUARTER) @ rot_x(_QUARTER)),
    ),
    "sideways": Plane(
        tr_later("Upright, sideways"),
        tr_later("Like a board beside which the arm stretches out: straight ahead and up"),
        lambda azimuth: np.asarray(rot_z(azimuth) @ rot_x(_QUARTER)),
    ),
}


def _azimuth(center: FloatArray) -> float:
    """The direction from the base axis to a place (3,) [rad]; that of the x axis on the base axis itself."""
    return math.atan2(center[1], center[0]) if math.hypot(center[0], center[1]) > _ON_THE_AXIS else 0.0


def laid(where: Placement, name: str, level_yaw: float = 0.0) -> Placement:
    """The same middle and size in a named plane; a level shape is turned by `level_yaw` [rad] about the vertical."""
    R = rot_z(level_yaw) if name == "level" else PLANES[name].rotation(_azimuth(where.center))
    return Placement(where.center, rpy_from_rotation(R), where.scale)


def plane_name(center: ArrayLike, rotation: FloatArray) -> str | None:
    """Which named plane a rotation (3, 3) is at center (3,) [m], however it is turned about the vertical; else None.

    An upright plane faces the arm, or stands sideways, as its normal is within 45° of the one or the other.
    """
    normal, up = rotation[:, 2], rotation[:, 1]
    if math.hypot(normal[0], normal[1]) < _SAME and normal[2] > 0.0:
        return "level"
    if abs(normal[2]) > _SAME or math.hypot(up[0], up[1]) > _SAME or up[2] < 0.0:
        return None
    azimuth = _azimuth(np.asarray(center, dtype=np.float64))
    towards = -(normal[0] * math.cos(azimuth) + normal[1] * math.sin(azimuth))
    if towards > math.sqrt(0.5) - _SAME:
        return "facing"
    return "sideways" if towards > -math.sqrt(0.5) else None


def with_normal(where: Placement, normal: ArrayLike) -> Placement | None:
    """The same middle and size, square to a normal (3,) of any length; None where that is 0.

    Its y axis points up as far as it can; in a level plane along the base's.
    """
    n = frozen_array("normal", normal, (3,))
    length = float(np.linalg.norm(n))
    if length < _SAME:
        return None
    z = n / length
    aside = np.cross((0.0, 0.0, 1.0), z)
    if float(np.linalg.norm(aside)) < _SAME:
        aside = np.array([1.0, 0.0, 0.0])
    return Placement(where.center, rpy_from_rotation(_axes(aside, z)), where.scale)


def through_three(where: Placement, points: ArrayLike) -> Placement | None:
    """In the plane through points (3, 3) [m], its middle between them; None where they lie on a line.

    The shape's x axis goes from the first to the second, and the third lies on the side of its y axis.
    """
    first, second, third = frozen_array("points", points, (3, 3))
    normal = np.cross(second - first, third - first)
    longest = max(float(np.linalg.norm(side)) for side in (second - first, third - first, third - second))
    area = float(np.linalg.norm(normal))
    if area <= _LEAST_AREA * longest**2:
        return None
    R = _axes(second - first, normal / area)
    return Placement((first + second + third) / 3.0, rpy_from_rotation(R), where.scale)


def three_points(where: Placement, rotation: FloatArray, side: float) -> FloatArray:
    """(3, 3) points through which a shape's plane goes: an even triangle of that side [m] about its middle."""
    height = side * math.sqrt(0.75)
    corners = np.array([(-0.5 * side, -height / 3, 0.0), (0.5 * side, -height / 3, 0.0), (0.0, 2 * height / 3, 0.0)])
    return np.asarray(where.center + corners @ rotation.T)


def _axes(along: FloatArray, z: FloatArray) -> FloatArray:
    """(3, 3) axes whose z is given and whose x lies along a direction square to it."""
    x = along / np.linalg.norm(along)
    return np.column_stack([x, np.cross(z, x), z])
