"""Forward kinematics: where the tool and every link stand for given joint values."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from rvsim.kinematics.dh import joint_transforms
from rvsim.robot import Robot
from rvsim.spatial.arrays import FloatArray


def forward_kinematics(robot: Robot, q: ArrayLike) -> FloatArray:
    """T_base_tool (..., 4, 4) = T_base_0 · A1 … An · T_flange_tool of q (..., n) [rad, m].

    Raises:
        ShapeError: the last axis of q is not the number of joints.
    """
    T_base_tool: FloatArray = link_transforms(robot, q)[..., -1, :, :] @ robot.T_flange_tool
    return T_base_tool


def link_transforms(robot: Robot, q: ArrayLike) -> FloatArray:
    """T_base_0 … T_base_n (..., n + 1, 4, 4) of q (..., n) [rad, m]: the base transform first, then one a joint.

    Raises:
        ShapeError: the last axis of q is not the number of joints.
    """
    A = joint_transforms(robot, q)
    T = np.empty((*A.shape[:-3], robot.dof + 1, 4, 4))
    T[..., 0, :, :] = robot.T_base_0
    for i in range(robot.dof):
        T[..., i + 1, :, :] = T[..., i, :, :] @ A[..., i, :, :]
    return T
