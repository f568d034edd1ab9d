"""Unit quaternions w, x, y, z: the scalar first, and of the two for each rotation the one with w ≥ 0."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from rvsim.spatial.arrays import FloatArray, floats
from rvsim.spatial.rotations import skew


def rotation_from_quaternion(quaternion: ArrayLike) -> FloatArray:
    """R (..., 3, 3) of a quaternion (..., 4) w, x, y, z of any length but 0 (a zero quaternion gives nan)."""
    q = floats("quaternion", quaternion, 4)
    with np.errstate(invalid="ignore"):
        q = q / np.linalg.norm(q, axis=-1, keepdims=True)
    w, v = q[..., :1, None], q[..., 1:]
    outer = v[..., :, None] * v[..., None, :]
    K = 2.0 * (w * skew(v) + outer)
    R: FloatArray = K + (2.0 * w**2 - 1.0) * np.eye(3)
    return R


def quaternion_from_rotation(R: ArrayLike) -> FloatArray:
    """The unit quaternion (..., 4) w, x, y, z of R (..., 3, 3), with w ≥ 0.

    At a half turn (w = 0) the first of x, y, z that is not 0 is positive. The matrix 4·q qᵀ is linear in R;
    its row with the largest diagonal entry is q without loss of digits (Shepperd 1978).
    """
    r = floats("R", R, 3, 3)
    products = _quaternion_products(r)
    largest = np.argmax(np.diagonal(products, axis1=-2, axis2=-1), axis=-1)
    row = np.take_along_axis(products, largest[..., None, None], axis=-2)[..., 0, :]
    return _upper_half(row / np.linalg.norm(row, axis=-1, keepdims=True))


def _quaternion_products(r: FloatArray) -> FloatArray:
    """4·q qᵀ (..., 4, 4) of R (..., 3, 3), for q = (w, x, y, z)."""
    products = np.empty((*r.shape[:-2], 4, 4))
    trace = np.trace(r, axis1=-2, axis2=-1)[..., None, None]
    products[..., 1:, 1:] = r + np.swapaxes(r, -1, -2) + (1.0 - trace) * np.eye(3)
    products[..., 0, 0] = 1.0 + trace[..., 0, 0]
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        products[..., 0, 1 + i] = products[..., 1 + i, 0] = r[..., k, j] - r[..., j, k]
    return products


def _upper_half(quaternion: FloatArray) -> FloatArray:
    """Of q and −q, which are the same rotation, the one whose first entry that is not 0 is positive."""
    first = np.argmax(quaternion != 0.0, axis=-1)
    sign = np.sign(np.take_along_axis(quaternion, first[..., None], axis=-1))
    upper: FloatArray = quaternion * sign
    return upper
