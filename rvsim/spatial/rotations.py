"""Rotation matrices R (..., 3, 3): the elementary ones, the cross product, the nearest one. Any leading shape."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from rvsim.spatial.arrays import FloatArray, floats


def rot_x(angle: ArrayLike) -> FloatArray:
    """Turn about x: angle (...) [rad] -> R (..., 3, 3)."""
    return _turn_about(0, angle)


def rot_y(angle: ArrayLike) -> FloatArray:
    """Turn about y: angle (...) [rad] -> R (..., 3, 3)."""
    return _turn_about(1, angle)


def rot_z(angle: ArrayLike) -> FloatArray:
    """Turn about z: angle (...) [rad] -> R (..., 3, 3)."""
    return _turn_about(2, angle)


def _turn_about(axis: int, angle: ArrayLike) -> FloatArray:
    angles = floats("angle", angle)
    first, second = (axis + 1) % 3, (axis + 2) % 3
    R = np.zeros((*angles.shape, 3, 3))
    R[..., axis, axis] = 1.0
    R[..., first, first] = R[..., second, second] = np.cos(angles)
    R[..., second, first] = np.sin(angles)
    R[..., first, second] = -R[..., second, first]
    return R


def skew(vector: ArrayLike) -> FloatArray:
    """The matrix of the cross product: skew(v) @ w = v × w; (..., 3) -> (..., 3, 3)."""
    v = floats("vector", vector, 3)
    matrix = np.zeros((*v.shape[:-1], 3, 3))
    matrix[..., 2, 1], matrix[..., 0, 2], matrix[..., 1, 0] = v[..., 0], v[..., 1], v[..., 2]
    return matrix - np.swapaxes(matrix, -1, -2)


def nearest_rotation(matrix: ArrayLike) -> FloatArray:
    """The rotation nearest to a matrix (..., 3, 3) in the Frobenius norm: its polar factor, with determinant +1.

    Source: Higham, Functions of Matrices (2008), §8.4; the sign after Umeyama (1991), eq. (39)–(43).
    """
    U, _, Vt = np.linalg.svd(floats("matrix", matrix, 3, 3))
    signs = np.ones(U.shape[:-1])
    signs[..., 2] = np.sign(np.linalg.det(U @ Vt))
    R: FloatArray = (U * signs[..., None, :]) @ Vt
    return R
