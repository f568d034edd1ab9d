"""How far from its command a virtual arm may come to rest, and how long that may take."""

from __future__ import annotations

import math

import numpy as np

from rvsim.device.virtual.calibration import GAIN_SPREAD
from rvsim.device.virtual.faults import NO_FAULTS, SAG_FACTOR, Fault, Faults
from rvsim.device.virtual.servo import (
    DEAD_BAND_US,
    FALL_RATE,
    FULL_FORCE_AT,
    FULL_TORQUE_AT,
    LOOP_TIME,
    SLIDING,
    STATIC,
    USUAL_SPEED,
    USUAL_TORQUE,
)
from rvsim.dynamics import STANDARD_GRAVITY
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

ROUNDING_US = 0.5  # pulses are whole microseconds


def largest_loads(robot: Robot) -> FloatArray:
    """(n,) no pose of the arm loads a joint more [N m, N]: each link's weight at the end of the longest lever there is.

    A joint about a vertical axis, as the base is in most arms, carries no weight.
    """
    loads = np.zeros(robot.dof)
    if robot.masses:
        for index in range(robot.dof):
            loads[index] = STANDARD_GRAVITY * sum(_moments(robot, index))
        loads[0] *= _slope(robot) if robot.joints[0].revolute else 1.0
    return loads


def settling_bound(robot: Robot, faults: Faults = NO_FAULTS) -> FloatArray:
    """(n,) how far a driven joint may rest from what its pulse says [rad, m]: sag, dead band and rounding together.

    The pulse means what the hidden servos say, and poses beyond an end stop mean the stop. A stalled joint rests
    anywhere: its bound is infinite.
    """
    torque = np.array([j.max_torque.value if j.max_torque else USUAL_TORQUE for j in robot.joints])
    most = np.where(robot.is_revolute, FULL_TORQUE_AT, FULL_FORCE_AT)
    sag = most * np.minimum(largest_loads(robot) / torque, 1.0)
    gain = np.array([servo.us_per_rad for servo in robot.servos]) * (1.0 - GAIN_SPREAD)
    sag[faults.servos(Fault.SAGGING_SERVO, robot.dof)] *= SAG_FACTOR
    bound = sag + (DEAD_BAND_US + ROUNDING_US) / gain
    bound[faults.servos(Fault.STALLED_SERVO, robot.dof)] = math.inf
    return np.asarray(bound)


def settling_time(robot: Robot, *, limp: bool = True) -> float:
    """After its last pulse changed, an arm lies still in this time [s]: driven joints soon, limp ones sink slowly.

    One joint after the other crosses its whole range at its slowest pace, and one second for what is left.

    Args:
        robot: an arm with servos.
        limp: False where all its joints are driven.
    """
    ranges = np.array([servo.limits[1] - servo.limits[0] for servo in robot.servos])
    speed = np.array([joint.max_speed.value if joint.max_speed else USUAL_SPEED for joint in robot.joints])
    slowest = np.minimum(speed, FALL_RATE * (STATIC - SLIDING)) if limp else speed
    return float(np.sum(ranges / slowest)) + 25.0 * LOOP_TIME


def _moments(robot: Robot, index: int) -> list[float]:
    """Mass times longest lever [kg m] (a mass itself for a sliding joint) of the links beyond a joint."""
    moments: list[float] = []
    reach = 0.0
    standard = robot.convention == "standard"
    for far in range(index, robot.dof):
        joint, link = robot.joints[far], robot.masses[far]
        own = math.hypot(joint.a, joint.d) if standard or far > index else 0.0
        if not joint.revolute and far > index:
            own += max(abs(joint.lower), abs(joint.upper))
        reach += own
        lever = reach + float(np.linalg.norm(link.com)) if robot.joints[index].revolute else 1.0
        moments.append(link.mass * lever)
    return moments


def _slope(robot: Robot) -> float:
    """Sine of the angle between the first joint's axis and the vertical."""
    tilt = robot.joints[0].alpha if robot.convention == "modified" else 0.0
    axis = robot.T_base_0[:3, :3] @ (0.0, -math.sin(tilt), math.cos(tilt))
    return float(math.hypot(axis[0], axis[1]))
