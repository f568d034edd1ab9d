"""Homogeneous transforms T (..., 4, 4): put together, inverted, moved along a twist, compared. Any leading shape."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.spatial.arrays import FloatArray, floats
from rvsim.spatial.rotation_vectors import rotation_error, rotation_from_vector


class PoseDifference(NamedTuple):
    """How far one pose is from another: `position` (...) [m] and `angle` (...) [rad] in [0, π]."""

    position: FloatArray
    angle: FloatArray


def transform(R: ArrayLike, p: ArrayLike) -> FloatArray:
    """T (..., 4, 4) of a rotation R (..., 3, 3) and an origin p (..., 3) [m]; leading shapes broadcast."""
    rotation, origin = floats("R", R, 3, 3), floats("p", p, 3)
    leading = np.broadcast_shapes(rotation.shape[:-2], origin.shape[:-1])
    T = np.zeros((*leading, 4, 4))
    T[..., :3, :3], T[..., :3, 3], T[..., 3, 3] = rotation, origin, 1.0
    return T


def translation(p: ArrayLike) -> FloatArray:
    """T (..., 4, 4) that shifts by p (..., 3) [m]."""
    return transform(np.eye(3), p)


def inverse_transform(T: ArrayLike) -> FloatArray:
    """T_b_a (..., 4, 4) of T_a_b (..., 4, 4): (Rᵀ, −Rᵀ p), exact where a general inverse would not be."""
    matrix = floats("T", T, 4, 4)
    R_inverse = np.swapaxes(matrix[..., :3, :3], -1, -2)
    return transform(R_inverse, -(R_inverse @ matrix[..., :3, 3:])[..., 0])


def transform_from_twist(twist: ArrayLike) -> FloatArray:
    """The exponential: twist (..., 6), linear part first [m, rad] -> T (..., 4, 4).

    Source: Murray, Li, Sastry (1994), eq. (2.36), written so that a twist without rotation needs no case of its own.
    """
    xi = floats("twist", twist, 6)
    v, w = xi[..., :3], xi[..., 3:]
    angle = np.linalg.norm(w, axis=-1, keepdims=True)
    turned = np.cross(w, v)
    first = 0.5 * np.sinc(0.5 * angle / np.pi) ** 2  # (1 − cos θ)/θ²
    p = v + first * turned + _sine_remainder(angle) * np.cross(w, turned)
    return transform(rotation_from_vector(w), p)


def pose_difference(T_actual: ArrayLike, T_target: ArrayLike) -> PoseDifference:
    """How far two poses (..., 4, 4) are apart: distance of the origins and the angle between the axes."""
    actual, target = floats("T_actual", T_actual, 4, 4), floats("T_target", T_target, 4, 4)
    distance = np.linalg.norm(target[..., :3, 3] - actual[..., :3, 3], axis=-1)
    error = rotation_error(actual[..., :3, :3], target[..., :3, :3])
    return PoseDifference(np.asarray(distance), np.asarray(np.linalg.norm(error, axis=-1)))


def _sine_remainder(angle: FloatArray) -> FloatArray:
    """(θ − sin θ)/θ³; what cancels near 0 is multiplied by θ² later, so only θ³ itself must not underflow."""
    tiny = angle < 1e-5
    safe = np.where(tiny, 1.0, angle)
    return np.where(tiny, 1.0 / 6.0, (safe - np.sin(safe)) / safe**3)
