"""The quickest way from state to state within limits of speed, acceleration and jerk, all joints arriving together."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import SettingError
from rvsim.language import tr
from rvsim.motion.laws.piecewise import PiecewisePolynomial
from rvsim.robot.arrays import FloatArray

_SHORTEST = 1e-6  # [s] what takes no time at all still needs a piece


class Limits(NamedTuple):
    """Largest speeds, accelerations and jerks (n,) of the joints, all positive [rad, m, s]."""

    speed: FloatArray
    acceleration: FloatArray
    jerk: FloatArray


def jerk_limited(
    t0: float,
    q0: ArrayLike,
    q1: ArrayLike,
    limits: Limits,
    *,
    qd0: ArrayLike = 0.0,
    qd1: ArrayLike = 0.0,
    qdd0: ArrayLike = 0.0,
    qdd1: ArrayLike = 0.0,
    duration: float | None = None,
) -> PiecewisePolynomial:
    """From q0 (n,) at t0 [s] to q1 (n,) in the least time, or in `duration` if that is longer.

    Berscheid and Kröger, Jerk-limited real-time trajectory generation with arbitrary target states (2021), by their
    library ruckig. Joints that could be quicker take as long as the slowest one.

    Raises:
        SettingError: limits that are not positive, or a state at an end that no motion within them can have.
    """
    import ruckig  # not needed before somebody asks for it

    start, end = np.atleast_1d(np.asarray(q0, np.float64)), np.atleast_1d(np.asarray(q1, np.float64))
    n = len(start)
    asked: Any = ruckig.InputParameter(n)
    states = {
        "current_position": start, "current_velocity": qd0, "current_acceleration": qdd0,
        "target_position": end, "target_velocity": qd1, "target_acceleration": qdd1,
        "max_velocity": limits.speed, "max_acceleration": limits.acceleration, "max_jerk": limits.jerk,
    }  # fmt: skip
    for name, value in states.items():
        setattr(asked, name, np.broadcast_to(np.asarray(value, np.float64), (n,)).tolist())
    for name in ("max_velocity", "max_acceleration", "max_jerk"):
        if not all(0.0 < value < np.inf for value in getattr(asked, name)):
            raise SettingError(name.replace("velocity", "speed"), min(getattr(asked, name)), tr("positive and finite"))
    if duration is not None:
        asked.minimum_duration = duration
    found: Any = ruckig.Trajectory(n)
    try:
        result = ruckig.Ruckig(n).calculate(asked, found)
    except ruckig.RuckigError as problem:
        raise SettingError(
            tr("the motion"), str(problem).split("] ")[-1], tr("within the limits at both of its ends")
        ) from None
    if result not in (ruckig.Result.Working, ruckig.Result.Finished):
        raise SettingError(tr("the motion"), str(result).split(".")[-1], tr("within the limits at both of its ends"))
    return _pieces(t0, start, found)


def _pieces(t0: float, start: FloatArray, found: Any) -> PiecewisePolynomial:
    """The profiles of all joints, cut where any of them changes its jerk."""
    total = float(found.duration)
    if total < _SHORTEST:
        return PiecewisePolynomial(np.array([t0, t0 + _SHORTEST]), start[None, None])
    cuts = [0.0, total]
    for profile in found.profiles[0]:
        steps = [profile.brake.duration, *profile.t]
        cuts += np.cumsum(steps).tolist() + list(np.cumsum(profile.brake.t))
    times = np.unique(np.clip(cuts, 0.0, total))
    times = times[np.concatenate([[True], np.diff(times) > 1e-12 * max(total, 1.0)])]
    times[-1] = total
    middles = 0.5 * (times[:-1] + times[1:])
    pieces = [_piece(found, a, m, len(start)) for a, m in zip(times[:-1], middles, strict=True)]
    return PiecewisePolynomial(t0 + times, np.array(pieces))


def _piece(found: Any, start: float, middle: float, n: int) -> FloatArray:
    """(4, n) of the piece that begins at a time; its jerk is that in its middle, where no rounding changes it."""
    q, qd, qdd = (np.reshape(value, n) for value in found.at_time(middle)[:3])
    half = middle - start
    jerk = (qdd - np.reshape(found.at_time(start + 0.5 * half)[2], n)) / (0.5 * half)
    qdd0 = qdd - jerk * half
    qd0 = qd - qdd0 * half - 0.5 * jerk * half**2
    q0 = q - qd0 * half - 0.5 * qdd0 * half**2 - jerk * half**3 / 6.0
    return np.stack([q0, qd0, 0.5 * qdd0, jerk / 6.0])
