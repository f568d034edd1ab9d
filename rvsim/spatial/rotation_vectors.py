"""Rotation vectors (..., 3), axis times angle [rad]: the exponential, the logarithm, and the distance of two rotations.

Every function takes any leading shape and broadcasts.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from rvsim.spatial.arrays import FloatArray, floats
from rvsim.spatial.quaternions import quaternion_from_rotation, rotation_from_quaternion


def rotation_from_vector(vector: ArrayLike) -> FloatArray:
    """The exponential: rotation vector (..., 3) [rad] -> R (..., 3, 3), orthogonal to the last digits at any angle.

    The unit quaternion cos(θ/2) + sin(θ/2) axis (Rodrigues 1840; Murray, Li, Sastry 1994, §2.3), which needs no
    division by θ.
    """
    v = floats("vector", vector, 3)
    half = 0.5 * np.linalg.norm(v, axis=-1, keepdims=True)
    # numpy's sinc is sin(πx)/(πx).
    return rotation_from_quaternion(np.concatenate([np.cos(half), 0.5 * np.sinc(half / np.pi) * v], axis=-1))


def rotation_vector(R: ArrayLike) -> FloatArray:
    """The logarithm: R (..., 3, 3) -> rotation vector (..., 3) [rad], its length in [0, π].

    Accurate near 0 and near π. At exactly π both signs of the axis are right: the first entry that is not 0
    is positive.
    """
    quaternion = quaternion_from_rotation(R)
    axis_part = quaternion[..., 1:]
    sine = np.linalg.norm(axis_part, axis=-1)  # sin(angle/2)
    angle = 2.0 * np.arctan2(sine, quaternion[..., 0])
    at_identity = sine == 0.0
    factor = np.where(at_identity, 2.0, angle / np.where(at_identity, 1.0, sine))
    return np.asarray(factor[..., None] * axis_part)


def rotation_error(R_actual: ArrayLike, R_target: ArrayLike) -> FloatArray:
    """The rotation vector (..., 3) [rad], in the common base axes, that turns R_actual into R_target."""
    actual, target = floats("R_actual", R_actual, 3, 3), floats("R_target", R_target, 3, 3)
    return rotation_vector(target @ np.swapaxes(actual, -1, -2))


def rotation_error_angle(R_actual: ArrayLike, R_target: ArrayLike) -> FloatArray:
    """The angle (...) [rad] in [0, π] between two rotations, accurate near 0 and near π."""
    return np.asarray(np.linalg.norm(rotation_error(R_actual, R_target), axis=-1))
