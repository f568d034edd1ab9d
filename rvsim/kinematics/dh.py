"""One row of a DH table as a transform, and the transforms A1 … An of an arm: the plain matrices of the textbook.

standard          A = Rz(θ) Tz(d) Tx(a) Rx(α)      Denavit and Hartenberg 1955; Paul 1981
modified (Craig)  A = Rx(α) Tx(a) Tz(d) Rz(θ)      Craig 2005, eq. (3.6), with a and α of row i − 1
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import SettingError, ShapeError
from rvsim.language import tr
from rvsim.robot import Convention, Robot
from rvsim.spatial import rot_x, rot_z, transform
from rvsim.spatial.arrays import FloatArray


def joint_array(robot: Robot, q: ArrayLike) -> FloatArray:
    """q as float64 (..., n) for this arm.

    Raises:
        ShapeError: the last axis is not the number of joints.
    """
    array: FloatArray = np.asarray(q, dtype=np.float64)
    if array.ndim == 0 or array.shape[-1] != robot.dof:
        raise ShapeError("q", f"(..., {robot.dof})", array.shape)
    return array


def one_pose(robot: Robot, q: ArrayLike, name: str) -> FloatArray:
    """q as the one finite pose (n,) that is asked for under that name.

    Raises:
        ShapeError: it is not (n,). SettingError: it is not finite.
    """
    array: FloatArray = np.asarray(q, dtype=np.float64)
    if array.shape != (robot.dof,):
        raise ShapeError(name, f"({robot.dof},)", array.shape)
    if not np.isfinite(array).all():
        raise SettingError(name, array.tolist(), tr("finite"))
    return array


def dh_transform(theta: ArrayLike, d: ArrayLike, a: ArrayLike, alpha: ArrayLike, convention: Convention) -> FloatArray:
    """A (..., 4, 4) of one row: angles theta, alpha [rad] and lengths d, a [m], any shapes that broadcast."""
    angle, along_z, along_x, twist = np.broadcast_arrays(theta, d, a, alpha)
    zero = np.zeros(angle.shape)
    about_z = transform(rot_z(angle), np.stack([zero, zero, along_z], axis=-1))
    about_x = transform(rot_x(twist), np.stack([along_x, zero, zero], axis=-1))
    A: FloatArray = about_z @ about_x if convention == "standard" else about_x @ about_z
    return A


def joint_transforms(robot: Robot, q: ArrayLike) -> FloatArray:
    """A1 … An of the arm: q (..., n) [rad, m] -> (..., n, 4, 4).

    Raises:
        ShapeError: the last axis of q is not the number of joints.
    """
    values = joint_array(robot, q)
    theta = robot.dh[:, 0] + np.where(robot.is_revolute, values, 0.0)
    d = robot.dh[:, 1] + np.where(robot.is_revolute, 0.0, values)
    return dh_transform(theta, d, robot.dh[:, 2], robot.dh[:, 3], robot.convention)
