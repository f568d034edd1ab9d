"""The moment of a motion in which the arm stands in a given pose."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from rvsim.playback.player import Playable
from rvsim.robot.arrays import FloatArray

_SAME = 1e-9  # [rad, m] between poses that are one
_COARSE, _FINE = 2001, 41  # moments that are looked at in the whole motion, and about one that is near
_ZOOMS = 8  # each a twentieth of the one before: far below _SAME at any speed
_LIKELIEST = 8


def moment_of(motion: Playable, q: FloatArray, likely: Iterable[float]) -> float | None:
    """The moment [s] of a motion in which it passes the pose q (n,) [rad, m]; None if it never does.

    Args:
        likely: moments [s] that are tried first, the likeliest first. Of others, that nearest to the first one counts.
    """
    tried = [*likely, 0.0, motion.duration]
    if np.shape(motion.q(0.0)) != np.shape(q):
        return None
    known = next((time for time in tried if _miss(motion, q, np.array([time]))[0] <= _SAME), None)
    if known is not None:
        return known
    found = [time for time in _nearest(motion, q) if _miss(motion, q, np.array([time]))[0] <= _SAME]
    return min(found, key=lambda time: abs(time - tried[0]), default=None)


def _miss(motion: Playable, q: FloatArray, times: FloatArray) -> FloatArray:
    """(k,) by how much each of the moments (k,) misses the pose [rad, m]."""
    return np.asarray(np.linalg.norm(motion.q(times) - q, axis=1))


def _nearest(motion: Playable, q: FloatArray) -> list[float]:
    """Moments [s] in which it comes nearer to the pose than just before and just after, the nearest first."""
    times = np.linspace(0.0, motion.duration, _COARSE)
    miss = _miss(motion, q, times)
    inner = (miss[1:-1] <= miss[:-2]) & (miss[1:-1] <= miss[2:])
    lows = np.flatnonzero(np.concatenate([[miss[0] <= miss[1]], inner, [miss[-1] <= miss[-2]]]))
    likeliest = lows[np.argsort(miss[lows], kind="stable")][:_LIKELIEST]
    # A motion cannot be nearer than a coarse step lets it be: what is farther off is not looked at closely.
    reach = 2.0 * float(np.abs(np.diff(motion.q(times), axis=0)).sum(axis=1).max())
    return [_refined(motion, q, float(times[low]), float(times[1])) for low in likeliest if miss[low] <= reach]


def _refined(motion: Playable, q: FloatArray, time: float, step: float) -> float:
    for _ in range(_ZOOMS):
        times = np.clip(np.linspace(time - step, time + step, _FINE), 0.0, motion.duration)
        time = float(times[np.argmin(_miss(motion, q, times))])
        step *= 2.0 / (_FINE - 1)
    return time
