"""The same orientation in the notations of the field: roll-pitch-yaw, ZYX and ZYZ Euler angles, axis and angle.

All angles in radians; every function takes any leading shape. Where a notation is not unique (gimbal lock: two of its
axes coincide) the docstring says which representative is returned. Each set of Euler angles is read off so that
putting it back gives the same matrix, also close to gimbal lock: the last angle is taken from what the others leave.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.spatial.arrays import FloatArray, floats
from rvsim.spatial.rotation_vectors import rotation_from_vector, rotation_vector
from rvsim.spatial.rotations import rot_x, rot_y, rot_z

# Below this sine or cosine, two axes coincide as far as float64 can tell.
_GIMBAL_LOCK = 1e-12


class AxisAngle(NamedTuple):
    """A unit axis (..., 3) and an angle (...) [rad] in [0, π]."""

    axis: FloatArray
    angle: FloatArray


def rotation_from_rpy(rpy: ArrayLike) -> FloatArray:
    """R = Rz(yaw) Ry(pitch) Rx(roll) of (..., 3) roll, pitch, yaw [rad]."""
    angles = floats("rpy", rpy, 3)
    R: FloatArray = rot_z(angles[..., 2]) @ rot_y(angles[..., 1]) @ rot_x(angles[..., 0])
    return R


def rpy_from_rotation(R: ArrayLike) -> FloatArray:
    """(..., 3) roll, pitch, yaw [rad] with R = Rz(yaw) Ry(pitch) Rx(roll) and pitch in [−π/2, π/2].

    In gimbal lock (pitch = ±π/2) roll is 0 and yaw holds the whole turn.
    """
    r = floats("R", R, 3, 3)
    cos_pitch = np.hypot(r[..., 2, 1], r[..., 2, 2])
    roll = np.where(cos_pitch < _GIMBAL_LOCK, 0.0, np.arctan2(r[..., 2, 1], r[..., 2, 2]))
    pitch = np.arctan2(0.0 - r[..., 2, 0], cos_pitch)
    # The y axis of R Rx(−roll) = Rz(yaw) Ry(pitch) is (−sin yaw, cos yaw, 0).
    y_axis = np.cos(roll)[..., None] * r[..., :, 1] - np.sin(roll)[..., None] * r[..., :, 2]
    return np.stack([roll, pitch, np.arctan2(0.0 - y_axis[..., 0], y_axis[..., 1])], axis=-1)


def rotation_from_zyx(zyx: ArrayLike) -> FloatArray:
    """R = Rz(zyx[0]) Ry(zyx[1]) Rx(zyx[2]) of (..., 3) Euler angles [rad]: roll-pitch-yaw in the other order."""
    return rotation_from_rpy(floats("zyx", zyx, 3)[..., ::-1])


def zyx_from_rotation(R: ArrayLike) -> FloatArray:
    """(..., 3) Euler angles [rad] with R = Rz(zyx[0]) Ry(zyx[1]) Rx(zyx[2]); in gimbal lock the last is 0."""
    return np.ascontiguousarray(rpy_from_rotation(R)[..., ::-1])


def rotation_from_zyz(zyz: ArrayLike) -> FloatArray:
    """R = Rz(zyz[0]) Ry(zyz[1]) Rz(zyz[2]) of (..., 3) Euler angles [rad]."""
    angles = floats("zyz", zyz, 3)
    R: FloatArray = rot_z(angles[..., 0]) @ rot_y(angles[..., 1]) @ rot_z(angles[..., 2])
    return R


def zyz_from_rotation(R: ArrayLike) -> FloatArray:
    """(..., 3) Euler angles [rad] with R = Rz(zyz[0]) Ry(zyz[1]) Rz(zyz[2]) and zyz[1] in [0, π].

    In gimbal lock (zyz[1] = 0 or π) zyz[0] is 0 and zyz[2] holds the whole turn.
    """
    r = floats("R", R, 3, 3)
    sin_nutation = np.hypot(r[..., 0, 2], r[..., 1, 2])
    first = np.where(sin_nutation < _GIMBAL_LOCK, 0.0, np.arctan2(r[..., 1, 2], r[..., 0, 2]))
    # The second row of Rz(−first) R = Ry Rz is (sin last, cos last, 0).
    row = np.cos(first)[..., None] * r[..., 1, :] - np.sin(first)[..., None] * r[..., 0, :]
    nutation = np.arctan2(sin_nutation, r[..., 2, 2])
    return np.stack([first, nutation, np.arctan2(row[..., 0], row[..., 1])], axis=-1)


def rotation_from_axis_angle(axis: ArrayLike, angle: ArrayLike) -> FloatArray:
    """R (..., 3, 3) of an axis (..., 3) of any length but 0 and an angle (...) [rad]."""
    direction = floats("axis", axis, 3)
    unit = direction / np.linalg.norm(direction, axis=-1, keepdims=True)
    return rotation_from_vector(unit * floats("angle", angle)[..., None])


def axis_angle_from_rotation(R: ArrayLike) -> AxisAngle:
    """Axis and angle of R (..., 3, 3), accurate near 0 and near π.

    At the identity the axis is z. At a half turn its first entry that is not 0 is positive.
    """
    vector = rotation_vector(R)
    angle = np.asarray(np.linalg.norm(vector, axis=-1))
    no_turn = (angle == 0.0)[..., None]
    axis = np.where(no_turn, [0.0, 0.0, 1.0], vector / np.where(no_turn, 1.0, angle[..., None]))
    return AxisAngle(axis, angle)
