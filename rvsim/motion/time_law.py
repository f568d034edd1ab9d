"""How far along at which time: the quintic from rest to rest, as a fraction of the way over a fraction of the time."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from rvsim.robot.arrays import FloatArray

# The largest speed and acceleration of the quintic, for a way of 1 in a time of 1.
QUINTIC_PEAK_SPEED = 15.0 / 8.0
QUINTIC_PEAK_ACCELERATION = 10.0 / np.sqrt(3.0)


def quintic(tau: ArrayLike) -> FloatArray:
    """s = 10τ³ − 15τ⁴ + 6τ⁵ for τ clamped to 0…1: rest to rest, without a jump of acceleration.

    Craig, Introduction to Robotics, §7.3, with zero speed and acceleration at both ends.
    """
    t = np.clip(np.asarray(tau, dtype=np.float64), 0.0, 1.0)
    return np.asarray(t**3 * (10.0 + t * (6.0 * t - 15.0)))


def quintic_speed(tau: ArrayLike) -> FloatArray:
    """ds/dτ = 30τ²(1 − τ)², 0 outside 0…1."""
    t = np.clip(np.asarray(tau, dtype=np.float64), 0.0, 1.0)
    return np.asarray(30.0 * t**2 * (1.0 - t) ** 2)


def quintic_acceleration(tau: ArrayLike) -> FloatArray:
    """d²s/dτ² = 60τ(1 − τ)(1 − 2τ), 0 outside 0…1."""
    t = np.clip(np.asarray(tau, dtype=np.float64), 0.0, 1.0)
    return np.asarray(60.0 * t * (1.0 - t) * (1.0 - 2.0 * t))
