"""From joints to the pulses of their servos and back, and the limits that an arm and its servos have in common."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import RobotDefinitionError
from rvsim.language import tr
from rvsim.robot.arrays import FloatArray
from rvsim.robot.robot import Robot
from rvsim.robot.servo import Servo


def pulses_of(servos: Sequence[Servo], q: ArrayLike) -> FloatArray:
    """Pulses (..., n) [µs] for joints q (..., n) [rad]; not clamped."""
    return np.asarray(_zeros(servos) + _gains(servos) * np.asarray(q, dtype=np.float64))


def joints_of(servos: Sequence[Servo], pulses_us: ArrayLike) -> FloatArray:
    """Joints (..., n) [rad] at pulses (..., n) [µs]."""
    return np.asarray((np.asarray(pulses_us, dtype=np.float64) - _zeros(servos)) / _gains(servos))


def clamped_pulses(servos: Sequence[Servo], pulses_us: ArrayLike) -> FloatArray:
    """Pulses (..., n) held within what each servo may get [µs]."""
    lower, upper = np.array([(servo.min_us, servo.max_us) for servo in servos]).T
    return np.asarray(np.clip(np.asarray(pulses_us, dtype=np.float64), lower, upper))


def servo_limits(servos: Sequence[Servo]) -> FloatArray:
    """(n, 2) least and largest q that the servos' pulses allow [rad]."""
    return np.array([servo.limits for servo in servos])


def within_servos(robot: Robot) -> Robot:
    """A copy whose joint limits are those that both the arm and its servos allow; home is brought inside them.

    Raises:
        RobotDefinitionError: some joint has no value that both allow; its calibration must be wrong.
    """
    narrowed = robot
    for index, (joint, servo) in enumerate(zip(robot.joints, robot.servos, strict=False)):
        least, largest = servo.limits
        lower, upper = max(joint.lower, least), min(joint.upper, largest)
        if not lower < upper:
            raise RobotDefinitionError(
                robot.name,
                tr(
                    "joint {name!r}: its servo turns from {least:.1f}° to "
                    "{largest:.1f}°, wholly outside the joint's limits. Calibrate it again.",
                    name=joint.name,
                    least=math.degrees(least),
                    largest=math.degrees(largest),
                ),
            )
        home = min(max(joint.home, lower), upper)
        narrowed = narrowed.with_joint(index, lower=lower, upper=upper, home=home)
    return narrowed


def with_servo(robot: Robot, index: int, servo: Servo) -> Robot:
    """A copy whose joint `index` (from 0) has another servo."""
    servos = list(robot.servos)
    servos[index] = servo
    return replace(robot, servos=tuple(servos))


def _zeros(servos: Sequence[Servo]) -> FloatArray:
    return np.array([servo.zero_us for servo in servos])


def _gains(servos: Sequence[Servo]) -> FloatArray:
    return np.array([servo.gain for servo in servos])
