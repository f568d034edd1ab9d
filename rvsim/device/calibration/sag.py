"""How far an arm gives way under its own weight, as the virtual arm does: the pulse asks for more than one sees."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from rvsim.device.virtual.servo import servo_bank
from rvsim.dynamics import gravity_torques
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray


def sag_of(robot: Robot, q: ArrayLike) -> FloatArray:
    """(..., n) what must be added to poses q (..., n) that one sees to get those that the pulses ask for [rad, m].

    An estimate: a servo is taken for a spring that gives way by 5° under its largest torque. Zeros without masses.
    """
    pose = np.asarray(q, dtype=np.float64)
    if not (robot.masses and robot.servos):
        return np.zeros(pose.shape)
    bank = servo_bank(robot, robot.servos, None)
    return np.asarray(np.clip(gravity_torques(robot, pose) * bank.give, -bank.most, bank.most))
