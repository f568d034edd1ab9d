"""The geometric Jacobian: how fast the tool moves and turns when the joints do."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from rvsim.kinematics.forward import forward_kinematics, link_transforms
from rvsim.robot import Robot
from rvsim.spatial.arrays import FloatArray


def jacobian(robot: Robot, q: ArrayLike) -> FloatArray:
    """J (..., 6, n) of q (..., n): (v, ω) = J qd, in base axes, v that of the tool origin; the linear rows first.

    Raises:
        ShapeError: the last axis of q is not the number of joints.
    """
    links = link_transforms(robot, q)
    origin = forward_kinematics(robot, q)[..., None, :3, 3]
    frames = links[..., :-1, :, :] if robot.convention == "standard" else links[..., 1:, :, :]
    axes, points = frames[..., :3, 2], frames[..., :3, 3]
    turning = robot.is_revolute[:, None]
    linear = np.where(turning, np.cross(axes, origin - points), axes)
    columns = np.concatenate([linear, np.where(turning, axes, 0.0)], axis=-1)
    return np.ascontiguousarray(np.swapaxes(columns, -1, -2))
