"""The cubic and the quintic between two poses, with any speeds and accelerations at their ends, from any time t0."""

from __future__ import annotations

from math import factorial

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import SettingError
from rvsim.language import tr
from rvsim.motion.laws.piecewise import PiecewisePolynomial
from rvsim.robot.arrays import FloatArray


def cubic(
    t0: float, t1: float, q0: ArrayLike, q1: ArrayLike, qd0: ArrayLike = 0.0, qd1: ArrayLike = 0.0
) -> PiecewisePolynomial:
    """The cubic from q0 (n,) at t0 to q1 (n,) at t1 [s] with speeds qd0 and qd1.

    Craig, Introduction to Robotics, eq. (7.11).

    Raises:
        SettingError: t1 is not after t0.
    """
    return _between(t0, t1, (q0, qd0), (q1, qd1))


def quintic_between(
    t0: float,
    t1: float,
    q0: ArrayLike,
    q1: ArrayLike,
    qd0: ArrayLike = 0.0,
    qd1: ArrayLike = 0.0,
    qdd0: ArrayLike = 0.0,
    qdd1: ArrayLike = 0.0,
) -> PiecewisePolynomial:
    """The quintic from q0 (n,) at t0 to q1 (n,) at t1 [s] with speeds qd0, qd1 and accelerations qdd0, qdd1.

    Source 004, eq. (5.22) with its two misprints mended (entry [2, 4] is 3 t0², entry [6, 3] is 2): here the time is
    counted from t0, so that they cannot matter.

    Raises:
        SettingError: t1 is not after t0.
    """
    return _between(t0, t1, (q0, qd0, qdd0), (q1, qd1, qdd1))


def _between(t0: float, t1: float, first: tuple[ArrayLike, ...], last: tuple[ArrayLike, ...]) -> PiecewisePolynomial:
    """The polynomial with these values of q, qd, … at both ends."""
    if not np.isfinite([t0, t1]).all() or t1 <= t0:
        raise SettingError("t1", t1, tr("a time after t0 = {start:g} s", start=t0))
    n = max(np.atleast_1d(np.asarray(value)).shape[-1] for value in (*first, *last))
    known = len(first)
    T = t1 - t0
    low = np.array([np.broadcast_to(value, (n,)) / factorial(k) for k, value in enumerate(first)], np.float64)
    # In units of T all conditions are of like size, whatever the time is.
    scaled_low = low * T ** np.arange(known)[:, None]
    wanted = np.array([np.broadcast_to(value, (n,)) * T**k for k, value in enumerate(last)], np.float64)
    high = np.linalg.solve(_at_one(known, 2 * known), wanted - _at_one(0, known, known) @ scaled_low)
    coefficients = np.concatenate([low, high / T ** np.arange(known, 2 * known)[:, None]])
    return PiecewisePolynomial(np.array([t0, t1]), coefficients[None])


def _at_one(first: int, end: int, rows: int = 0) -> FloatArray:
    """The derivatives of τ^k at τ = 1: entry [i, k − first] is k! / (k − i)!, 0 where i > k."""
    height = rows or end - first
    return np.array(
        [[factorial(k) / factorial(k - i) if k >= i else 0.0 for k in range(first, end)] for i in range(height)]
    )
