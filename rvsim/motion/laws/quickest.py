"""The quickest way along a given curve in joint space within the limits of speed and acceleration."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import SettingError
from rvsim.language import tr
from rvsim.motion.laws.piecewise import PiecewisePolynomial
from rvsim.robot.arrays import FloatArray

_STEPS_A_PIECE, _LEAST_STEPS, _MOST_STEPS = 8, 200, 4000
_TINY = 1e-12


def quickest_along(
    way: PiecewisePolynomial,
    max_speed: ArrayLike,
    max_acceleration: ArrayLike,
    pace: Callable[[FloatArray], FloatArray] | None = None,
) -> PiecewisePolynomial:
    """s(t), one column, from rest at the way's beginning to rest at its end: how to travel q = way(s) the quickest.

    Backward and forward pass over the squared path speed x = ṡ², whose limits are linear in x and u = s̈:
    |q' √x| ≤ max_speed and |q' u + q'' x| ≤ max_acceleration. Pham and Pham, A new approach to time-optimal path
    parameterization based on reachability analysis, IEEE T-RO 34 (2018), with the interpolation scheme of §V: the
    acceleration keeps its limits at both ends of each step. In between they can be exceeded by a trace.

    Args:
        way: the curve over a parameter s (not over time).
        max_speed, max_acceleration: (n,) or one number for all, positive; infinite where there is no limit.
        pace: ṡ at places s (m,), never to be exceeded either: then it is the law of that pace, slower where a limit
            needs it.

    Raises:
        SettingError: a limit that is not positive, or none at all, so that nothing ends the hurry.
    """
    s = _grid(way)
    _, slope, bend, _ = way.at(s)
    speed = _limit("max_speed", max_speed, slope.shape[1])
    acceleration = _limit("max_acceleration", max_acceleration, slope.shape[1])
    steps = np.diff(s)
    slopes, bends = _at_both_ends(slope, bend, steps)
    most = np.minimum(_by_speed(slope, speed), np.append(_by_bend(slopes, bends, np.tile(acceleration, 2)), 0.0))
    if pace is not None:
        most = np.minimum(most, pace(s) ** 2)
    lines = _lines(slopes, bends, np.tile(acceleration, 2))
    highest = _backwards(most, lines, steps)
    if not np.isfinite(highest).all():
        raise SettingError("max_acceleration", tr("infinite"), tr("finite for a joint that moves"))
    return _in_time(s, _forwards(highest, lines, steps))


def _grid(way: PiecewisePolynomial) -> FloatArray:
    """(m + 1,) places that divide each piece evenly, so that a kink of the bend lies on one; all evenly if too many."""
    pieces = len(way.coefficients)
    if pieces > _MOST_STEPS // 2:
        return np.linspace(way.start, way.end, _MOST_STEPS + 1)
    lengths = np.diff(way.breaks)
    enough = np.ceil(_LEAST_STEPS * lengths / way.duration).astype(int)
    steps = np.maximum(enough, min(_STEPS_A_PIECE, _MOST_STEPS // pieces))
    number = np.arange(steps.sum()) - np.repeat(np.cumsum(steps) - steps, steps)
    return np.append(np.repeat(way.breaks[:-1], steps) + number * np.repeat(lengths / steps, steps), way.end)


def _at_both_ends(slope: FloatArray, bend: FloatArray, steps: FloatArray) -> tuple[FloatArray, FloatArray]:
    """(m, 2n) slopes and bends of the limits of each step: at its beginning, and at its end, where x is x + 2 Δ u."""
    later = slope[1:] + 2.0 * steps[:, None] * bend[1:]
    return np.hstack([slope[:-1], later]), np.hstack([bend[:-1], bend[1:]])


def _limit(name: str, limit: ArrayLike, n: int) -> FloatArray:
    allowed = np.broadcast_to(np.asarray(limit, np.float64), (n,))
    if not (allowed > 0.0).all():
        raise SettingError(name, float(allowed.min()), "positive")
    return allowed


def _by_speed(slope: FloatArray, speed: FloatArray) -> FloatArray:
    """(m,) the largest x at each place by the speeds."""
    with np.errstate(divide="ignore"):
        most = np.where(np.abs(slope) > _TINY, (speed / np.abs(slope)) ** 2, math.inf)
    return np.asarray(most.min(axis=1))


def _by_bend(slopes: FloatArray, bends: FloatArray, acceleration: FloatArray) -> FloatArray:
    """(m,) the largest x by the accelerations of joints that do not go on, however s does."""
    still = (np.abs(slopes) <= _TINY) & (np.abs(bends) > _TINY)
    with np.errstate(divide="ignore", invalid="ignore"):
        most = np.where(still, acceleration / np.abs(bends), math.inf)
    return np.asarray(most.min(axis=1))


def _lines(slope: FloatArray, bend: FloatArray, acceleration: FloatArray) -> tuple[FloatArray, FloatArray]:
    """a (m, n) and b (m, n): each joint wants −a + b x ≤ u ≤ a + b x; a is infinite where it says nothing."""
    size = np.abs(slope)
    moving = size > _TINY
    safe = np.where(moving, slope, 1.0)
    return np.where(moving, acceleration / np.abs(safe), math.inf), np.where(moving, -bend / safe, 0.0)


def _backwards(most: FloatArray, lines: tuple[FloatArray, FloatArray], steps: FloatArray) -> FloatArray:
    """(m,) the largest x at each place from which the end can be reached at rest."""
    a, b = lines
    highest = most.copy()
    highest[-1] = 0.0
    for i in range(len(most) - 2, -1, -1):
        step = steps[i]
        # u ≤ (h − x) / 2Δ, the next place's own highest, is one more upper line, u ≥ −x / 2Δ one more lower one.
        upper_at, upper_by = np.append(a[i], highest[i + 1] / (2.0 * step)), np.append(b[i], -0.5 / step)
        lower_at, lower_by = np.append(-a[i], 0.0), np.append(b[i], -0.5 / step)
        highest[i] = min(most[i], _crossing(upper_at, upper_by, lower_at, lower_by))
    return highest


def _crossing(upper_at: FloatArray, upper_by: FloatArray, lower_at: FloatArray, lower_by: FloatArray) -> float:
    """The largest x ≥ 0 at which every lower line is still below every upper line; at 0 they are."""
    room = upper_at[:, None] - lower_at
    closing = lower_by - upper_by[:, None]
    meets = closing > _TINY
    return float((room[meets] / closing[meets]).min(initial=math.inf))


def _forwards(highest: FloatArray, lines: tuple[FloatArray, FloatArray], steps: FloatArray) -> FloatArray:
    """(m,) x when at each place it speeds up as much as it may."""
    a, b = lines
    x = np.zeros_like(highest)
    for i in range(len(x) - 1):
        u = float((a[i] + b[i] * x[i]).min())
        x[i + 1] = min(max(x[i] + 2.0 * steps[i] * u, 0.0), highest[i + 1])
    return x


def _in_time(s: FloatArray, x: FloatArray) -> PiecewisePolynomial:
    """Between two places the acceleration of s is even."""
    speeds = np.sqrt(x)
    sums = np.maximum(speeds[:-1] + speeds[1:], 1e-9)
    spans = 2.0 * np.diff(s) / sums
    bends = (speeds[1:] - speeds[:-1]) / spans
    coefficients = np.stack([s[:-1], speeds[:-1], 0.5 * bends], axis=1)[:, :, None]
    return PiecewisePolynomial(np.concatenate([[0.0], np.cumsum(spans)]), coefficients)
