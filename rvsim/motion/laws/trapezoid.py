"""The trapezoid of speed: constant acceleration, constant speed, constant braking, all joints in step."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import SettingError
from rvsim.language import tr
from rvsim.motion.laws.piecewise import PiecewisePolynomial
from rvsim.robot.arrays import FloatArray

_SHORTEST = 1e-6  # [s]


class _Shape(NamedTuple):
    """How long it speeds up, and how long it keeps its speed [s]; as long as it speeds up it brakes."""

    blend: float
    cruise: float


def trapezoid(
    t0: float,
    q0: ArrayLike,
    q1: ArrayLike,
    max_speed: ArrayLike,
    max_acceleration: ArrayLike,
    *,
    duration: float | None = None,
) -> PiecewisePolynomial:
    """From rest in q0 (n,) at t0 [s] to rest in q1 (n,), straight in joint space.

    Craig, Introduction to Robotics, §7.3, "linear function with parabolic blends"; the joint that needs the longest
    sets the pace. Where nothing moves it takes no time but the shortest that is used, a microsecond.

    Args:
        max_speed, max_acceleration: (n,) or one number for all, positive.
        duration: [s] how long it is to take; None for as short as the limits let it be.

    Raises:
        SettingError: a limit that is not positive, or a duration too short for the limits.
    """
    start, end = np.atleast_1d(np.asarray(q0, np.float64)), np.atleast_1d(np.asarray(q1, np.float64))
    way = end - start
    speed, acceleration = _rates(way, max_speed, "max_speed"), _rates(way, max_acceleration, "max_acceleration")
    shape = _fastest(speed, acceleration)
    if duration is not None:
        shape = _slower(shape, acceleration, duration)
    return _pieces(t0, start, way, shape)


def _rates(way: FloatArray, limit: ArrayLike, name: str) -> float:
    """The largest rate of the common way 0…1 that keeps every joint's limit; infinite where nothing moves."""
    allowed = np.broadcast_to(np.asarray(limit, np.float64), way.shape)
    if not (allowed > 0.0).all():
        raise SettingError(name, float(allowed.min()), tr("a positive number"))
    moving = way != 0.0
    return float((allowed[moving] / np.abs(way[moving])).min()) if moving.any() else math.inf


def _fastest(speed: float, acceleration: float) -> _Shape:
    triangle = 1.0 / math.sqrt(acceleration)
    if triangle < 0.5 * _SHORTEST:
        return _Shape(0.5 * _SHORTEST, 0.0)
    blend = speed / acceleration
    if speed * blend >= 1.0:  # it brakes before it has its full speed
        return _Shape(triangle, 0.0)
    return _Shape(blend, 1.0 / speed - blend)


def _slower(fastest: _Shape, acceleration: float, duration: float) -> _Shape:
    """The same acceleration, and the speed at which it takes just as long as is asked for."""
    least = 2.0 * fastest.blend + fastest.cruise
    if not math.isfinite(duration) or duration < least * (1.0 - 1e-9):
        raise SettingError(
            "duration", duration, tr("at least {least:.4g} s, or the limits would be broken", least=least)
        )
    if math.isinf(acceleration):
        return _Shape(0.5 * duration, 0.0)
    root = math.sqrt(max(duration**2 - 4.0 / acceleration, 0.0))
    return _Shape(0.5 * (duration - root), root)


def _pieces(t0: float, start: FloatArray, way: FloatArray, shape: _Shape) -> PiecewisePolynomial:
    blend, cruise = shape
    speed = 1.0 / (blend + cruise)
    half = 0.5 * speed * blend  # the part of the way that is done while speeding up
    pieces = [(0.0, 0.0, 0.5 * speed / blend), (1.0 - half, speed, -0.5 * speed / blend)]
    times = [0.0, blend + cruise, 2.0 * blend + cruise]
    if cruise > 1e-12 * blend:
        pieces.insert(1, (half, speed, 0.0))
        times.insert(1, blend)
    coefficients = np.array([[[c] for c in piece] for piece in pieces]) * way
    coefficients[:, 0] += start
    return PiecewisePolynomial(t0 + np.array(times), coefficients)
