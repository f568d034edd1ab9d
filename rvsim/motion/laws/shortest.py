"""The shortest time in which a law keeps the limits of the joints."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import SettingError
from rvsim.language import tr
from rvsim.motion.laws.piecewise import PiecewisePolynomial

_LEAST, _MOST = 1e-3, 1e5  # [s]
_GROWTH = 1.1


def shortest_time(
    law: Callable[[float], PiecewisePolynomial], max_speed: ArrayLike, max_acceleration: ArrayLike
) -> float:
    """The shortest duration [s] at which law(duration) exceeds no joint's speed and acceleration, to a millionth.

    With speeds at the ends there may be longer times that break the limits again; it is the first one from below.

    Args:
        law: makes the motion of a duration.
        max_speed, max_acceleration: (n,) or one number for all; infinite where there is no limit.

    Raises:
        SettingError: no time up to a day keeps them, for instance because an end is faster than its joint may be.
    """
    speed, acceleration = np.asarray(max_speed, np.float64), np.asarray(max_acceleration, np.float64)

    def keeps(duration: float) -> bool:
        peaks = law(duration).peaks()
        slack = 1.0 + 1e-9
        return bool((peaks.qd <= speed * slack).all() and (peaks.qdd <= acceleration * slack).all())

    high = _LEAST
    while not keeps(high):
        high *= _GROWTH
        if high > _MOST:
            raise SettingError(tr("the speeds at the ends"), tr("too high"), tr("within the limits of the joints"))
    if high == _LEAST:
        return high
    low = high / _GROWTH
    while high - low > 1e-6 * high:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if keeps(middle) else (middle, high)
    return high
