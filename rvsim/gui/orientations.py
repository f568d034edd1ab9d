"""The notations of an orientation on the screen: what their numbers are called, and which convention they follow."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from rvsim.gui.quantities import Kind
from rvsim.language import tr, tr_later
from rvsim.robot.arrays import FloatArray
from rvsim.spatial import (
    axis_angle_from_rotation,
    quaternion_from_rotation,
    rotation_from_axis_angle,
    rotation_from_quaternion,
    rotation_from_rpy,
    rotation_from_zyz,
    rpy_from_rotation,
    zyz_from_rotation,
)

_NO_DIRECTION = 1e-9  # a length below it has no direction
_ROUNDING = 1e-9


class Notation(NamedTuple):
    """A notation: `read` gives its numbers of R (3, 3); `write` gives R of the numbers, where each may be changed.

    Its first `direction` numbers only count by their ratios: they are brought to length 1. Its texts are English.
    """

    title: str
    convention: str
    names: tuple[str, ...]
    kinds: tuple[Kind, ...]
    read: Callable[[FloatArray], FloatArray]
    write: Callable[[FloatArray], FloatArray]
    hint: str
    direction: int = 0

    def problem(self, values: FloatArray) -> str:
        """Why the numbers (k,) mean no orientation, or nothing."""
        if not self.direction or float(np.linalg.norm(values[: self.direction])) >= _NO_DIRECTION:
            return ""
        return tr(
            "{zeros} has no direction: one of {names} must be other than 0. The tool stays.",
            zeros=" ".join("0" * self.direction),
            names=", ".join(map(tr, self.names[: self.direction])),
        )


def _quaternion(R: FloatArray) -> FloatArray:
    q = quaternion_from_rotation(R)
    return q * _sign_of_first(q[1:]) if q[0] < _ROUNDING else q


def _axis_and_angle(R: FloatArray) -> FloatArray:
    axis, angle = axis_angle_from_rotation(R)
    return np.append(axis * _sign_of_first(axis) if np.pi - angle < _ROUNDING else axis, angle)


def _sign_of_first(direction: FloatArray) -> float:
    """±1: at half a turn both senses are right, and rounding must not choose: the first entry other than 0 is > 0."""
    first = int(np.argmax(np.abs(direction) > _ROUNDING))
    return -1.0 if direction[first] < 0.0 else 1.0


def _rotation_of_axis_and_angle(numbers: FloatArray) -> FloatArray:
    return rotation_from_axis_angle(numbers[:3], numbers[3])


_PASTE_THREE = tr_later("Three numbers can be pasted or typed into any of the boxes.")
_PASTE_QUATERNION = tr_later(
    "Type one after the other: each stays as it is typed until you leave the boxes,\n"
    "then the four are shown brought to length 1, as the tool has taken them.\n"
    "Four numbers can be pasted or typed into any of the boxes."
)
_PASTE_AXIS = tr_later(
    "Type one after the other: each stays as it is typed until you leave the boxes,\n"
    "then the axis is shown brought to length 1, as the tool has taken it.\n"
    "Four numbers can be pasted or typed into any of the boxes."
)
_ANGLES: tuple[Kind, ...] = ("angle", "angle", "angle")
NOTATIONS = {
    "rpy": Notation(
        tr_later("Roll, pitch, yaw"),
        tr_later("R = Rz(yaw) · Ry(pitch) · Rx(roll), about the axes of the base. At pitch ±90° roll is shown as 0."),
        (tr_later("roll"), tr_later("pitch"), tr_later("yaw")),
        _ANGLES,
        rpy_from_rotation,
        rotation_from_rpy,
        _PASTE_THREE,
    ),
    "zyz": Notation(
        tr_later("ZYZ Euler angles"),
        tr_later("R = Rz(φ) · Ry(θ) · Rz(ψ), about the moving axes. At θ = 0° or 180° φ is shown as 0."),
        ("φ", "θ", "ψ"),
        _ANGLES,
        zyz_from_rotation,
        rotation_from_zyz,
        _PASTE_THREE,
    ),
    "quaternion": Notation(
        tr_later("Quaternion"),
        tr_later("q = w + x i + y j + z k, a unit quaternion with the scalar first and w ≥ 0."),
        ("w", "x", "y", "z"),
        ("number", "number", "number", "number"),
        _quaternion,
        rotation_from_quaternion,
        _PASTE_QUATERNION,
        4,
    ),
    "axis_angle": Notation(
        tr_later("Axis and angle"),
        tr_later("A turn by the angle, 0° to 180°, about a unit axis in base coordinates."),
        (tr_later("axis x"), tr_later("axis y"), tr_later("axis z"), tr_later("angle")),
        ("number", "number", "number", "angle"),
        _axis_and_angle,
        _rotation_of_axis_and_angle,
        _PASTE_AXIS,
        3,
    ),
}
MATRIX = "matrix"
MATRIX_TITLE = tr_later("Matrix n o a p")
MATRIX_CONVENTION = tr_later("n, o, a are the tool's axes and p is its origin, in base coordinates.")


def notation_titles() -> dict[str, str]:
    """The choices: the value of the preference "orientation" → its title."""
    return {name: notation.title for name, notation in NOTATIONS.items()} | {MATRIX: MATRIX_TITLE}
