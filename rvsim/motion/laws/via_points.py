"""Cubic splines through poses at given times: natural, clamped or not-a-knot at the ends."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import ShapeError
from rvsim.motion.laws.piecewise import PiecewisePolynomial
from rvsim.motion.spline import knot_slopes
from rvsim.robot.arrays import FloatArray

SplineEnds = Literal["natural", "clamped", "not-a-knot"]


def spline_through(
    times: ArrayLike, poses: ArrayLike, ends: SplineEnds = "clamped", qd0: ArrayLike = 0.0, qd1: ArrayLike = 0.0
) -> PiecewisePolynomial:
    """The cubic spline through poses (k, n) at times (k,) [s], with continuous speed and acceleration.

    de Boor, A Practical Guide to Splines, ch. IV.

    Args:
        ends: "natural" ends without acceleration, "clamped" with the speeds qd0 and qd1 (rest, if nothing is said),
            "not-a-knot" without a jump of jerk at the second and the last but one pose.

    Raises:
        ShapeError: fewer than two poses (four for "not-a-knot"), times that do not increase, or not one for each pose.
    """
    x = np.atleast_1d(np.asarray(times, np.float64))
    y = np.atleast_2d(np.asarray(poses, np.float64))
    least = 4 if ends == "not-a-knot" else 2
    if x.ndim != 1 or y.ndim != 2 or len(x) != len(y) or len(x) < least or not (np.diff(x) > 0.0).all():
        raise ShapeError("times", f"({max(len(y), least)},), increasing", x.shape)
    slopes = knot_slopes(x, y, ends, np.broadcast_to(qd0, y.shape[1:]), np.broadcast_to(qd1, y.shape[1:]))
    return PiecewisePolynomial(x, _hermite_coefficients(np.diff(x)[:, None], y, slopes))


def _hermite_coefficients(h: FloatArray, y: FloatArray, slopes: FloatArray) -> FloatArray:
    rise = np.diff(y, axis=0) / h
    second = (3.0 * rise - 2.0 * slopes[:-1] - slopes[1:]) / h
    third = (slopes[:-1] + slopes[1:] - 2.0 * rise) / h**2
    return np.stack([y[:-1], slopes[:-1], second, third], axis=1)
