"""The Jacobian a second way: by differences of the forward kinematics. To check formulas with, not to compute with."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import UnknownNameError
from rvsim.kinematics.forward import forward_kinematics
from rvsim.robot import Robot
from rvsim.spatial import rotation_vector, rpy_from_rotation, zyz_from_rotation
from rvsim.spatial.arrays import FloatArray, floats

Rows = Literal["base", "tool", "rpy", "zyz"]

_STEP = 6e-6  # the cube root of the machine's precision: rounding and the neglected term weigh alike


def jacobian_by_differences(robot: Robot, q: ArrayLike, rows: Rows = "base") -> FloatArray:
    """J (6, n) at q (n,) from T(q ± h): right to some 1e-9.

    Args:
        rows: "base" or "tool" axes, or the rates of roll, pitch, yaw ("rpy") or of the ZYZ angles ("zyz").

    Raises:
        ShapeError: q is not one pose.
        UnknownNameError: no such rows.
    """
    middle = floats("q", q, robot.dof)
    steps = _STEP * np.eye(robot.dof)
    T = forward_kinematics(robot, np.concatenate([middle + steps, middle - steps]))
    after, before = T[: robot.dof], T[robot.dof :]
    linear = (after[:, :3, 3] - before[:, :3, 3]) / (2.0 * _STEP)
    angular = _turned(before[:, :3, :3], after[:, :3, :3], rows) / (2.0 * _STEP)
    if rows == "tool":
        R = forward_kinematics(robot, middle)[:3, :3]
        linear, angular = linear @ R, angular @ R
    return np.concatenate([linear, angular], axis=1).T


def _turned(before: FloatArray, after: FloatArray, rows: str) -> FloatArray:
    """(n, 3) what has turned between rotations (n, 3, 3)."""
    if rows in ("base", "tool"):
        return rotation_vector(after @ np.swapaxes(before, -1, -2))
    readers: dict[str, Callable[[FloatArray], FloatArray]] = {"rpy": rpy_from_rotation, "zyz": zyz_from_rotation}
    if rows not in readers:
        raise UnknownNameError("rows of a Jacobian", rows, ("base", "tool", "rpy", "zyz"))
    change = readers[rows](after) - readers[rows](before)
    return np.asarray((change + np.pi) % (2.0 * np.pi) - np.pi)
