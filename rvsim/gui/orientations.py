"""The notations of an orientation on the screen: what their numbers are called, and which convention they follow."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.gui.quantities import Kind
from rvsim.robot.arrays import FloatArray
from rvsim.spatial import (
    axis_angle_from_rotation,
    quaternion_from_rotation,
    rotation_from_rpy,
    rotation_from_zyz,
    rpy_from_rotation,
    zyz_from_rotation,
)


class Notation(NamedTuple):
    """A notation: `read` gives its numbers of R (3, 3); `write` gives R of the numbers, where each may be changed."""

    title: str
    convention: str
    names: tuple[str, ...]
    kinds: tuple[Kind, ...]
    read: Callable[[FloatArray], FloatArray]
    write: Callable[[ArrayLike], FloatArray] | None = None


def _axis_and_angle(R: FloatArray) -> FloatArray:
    axis, angle = axis_angle_from_rotation(R)
    return np.append(axis, angle)


_ANGLES: tuple[Kind, ...] = ("angle", "angle", "angle")
NOTATIONS = {
    "rpy": Notation(
        "Roll, pitch, yaw",
        "R = Rz(yaw) · Ry(pitch) · Rx(roll), about the axes of the base. At pitch ±90° roll is shown as 0.",
        ("roll", "pitch", "yaw"),
        _ANGLES,
        rpy_from_rotation,
        rotation_from_rpy,
    ),
    "zyz": Notation(
        "ZYZ Euler angles",
        "R = Rz(φ) · Ry(θ) · Rz(ψ), about the moving axes. At θ = 0° or 180° φ is shown as 0.",
        ("φ", "θ", "ψ"),
        _ANGLES,
        zyz_from_rotation,
        rotation_from_zyz,
    ),
    "quaternion": Notation(
        "Quaternion",
        "q = w + x i + y j + z k, a unit quaternion with the scalar first and w ≥ 0.",
        ("w", "x", "y", "z"),
        ("number", "number", "number", "number"),
        quaternion_from_rotation,
    ),
    "axis_angle": Notation(
        "Axis and angle",
        "A turn by the angle, 0° to 180°, about a unit axis in base coordinates.",
        ("axis x", "axis y", "axis z", "angle"),
        ("number", "number", "number", "angle"),
        _axis_and_angle,
    ),
}
MATRIX = "matrix"
MATRIX_TITLE = "Matrix n o a p"
MATRIX_CONVENTION = "n, o, a are the tool's axes and p is its origin, in base coordinates."


def notation_titles() -> dict[str, str]:
    """The choices: the value of the preference "orientation" → its title."""
    return {name: notation.title for name, notation in NOTATIONS.items()} | {MATRIX: MATRIX_TITLE}
