"""What the functions of this floor take: arms with masses, values a joint, and further numbers a pose."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import NoMassDataError, ShapeError
from rvsim.robot import Robot
from rvsim.spatial.arrays import FloatArray


def massive(robot: Robot) -> Robot:
    """The arm itself.

    Raises:
        NoMassDataError: it has no masses.
    """
    if not robot.masses:
        raise NoMassDataError(robot.name)
    return robot


def joint_values(robot: Robot, name: str, values: ArrayLike) -> FloatArray:
    """Values as float64 (..., n) for this arm.

    Raises:
        ShapeError: the last axis is not the number of joints.
    """
    array: FloatArray = np.asarray(values, dtype=np.float64)
    if array.ndim == 0 or array.shape[-1] != robot.dof:
        raise ShapeError(name, f"(..., {robot.dof})", array.shape)
    return array


def stacked(columns: Sequence[FloatArray], scalars: Sequence[ArrayLike]) -> FloatArray:
    """All of them side by side, (..., k): arrays (..., n), then scalars (...), their leading shapes broadcast."""
    numbers = [np.asarray(scalar, dtype=np.float64)[..., None] for scalar in scalars]
    parts = [*columns, *numbers]
    if all(part.ndim == 1 for part in parts):
        return np.concatenate(parts)
    shape = np.broadcast_shapes(*(part.shape[:-1] for part in parts))
    # Column by column in memory: that is how the players read it.
    inputs = np.empty((sum(part.shape[-1] for part in parts), *shape))
    start = 0
    for part in parts:
        inputs[start : start + part.shape[-1]] = np.moveaxis(np.broadcast_to(part, (*shape, part.shape[-1])), -1, 0)
        start += part.shape[-1]
    return np.moveaxis(inputs, 0, -1)
