"""Places in a robot file: xyz and roll-pitch-yaw to a 4×4 matrix and back, exact enough for 1e-12 everywhere."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from rvsim.robot.arrays import FloatArray


def transform_from(xyz: Sequence[float], rpy: Sequence[float]) -> FloatArray:
    """(4, 4) of a position [m] and roll, pitch, yaw [rad]: R = Rz(yaw) Ry(pitch) Rx(roll) (fixed axes x, y, z)."""
    (cr, sr), (cp, sp), (cy, sy) = ((math.cos(angle), math.sin(angle)) for angle in rpy)
    T = np.eye(4)
    T[:3, :3] = [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
    T[:3, 3] = xyz
    return T


def roll_pitch_yaw(T: FloatArray) -> tuple[float, float, float]:
    """Roll, pitch, yaw [rad] of T (4, 4). Also at pitch ±90°: the roll is taken from what the yaw left over."""
    R = T[:3, :3].tolist()
    yaw = math.atan2(R[1][0], R[0][0])
    pitch = math.atan2(-R[2][0], math.hypot(R[0][0], R[1][0]))
    cy, sy = math.cos(yaw), math.sin(yaw)
    roll = math.atan2(sy * R[0][2] - cy * R[1][2], cy * R[1][1] - sy * R[0][1])
    return roll, pitch, yaw
