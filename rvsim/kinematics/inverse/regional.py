"""Waist, shoulder and elbow: the three joints that bring a point of the forearm to a place, in four ways."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from rvsim.kinematics.inverse.chain import Chain
from rvsim.kinematics.inverse.closed_form import Condition, is_zero, long_enough, parallel, right_angle
from rvsim.kinematics.inverse.elbow import elbow_up, erase, solve_elbow
from rvsim.kinematics.inverse.waist import Waist, solve_waist
from rvsim.spatial.arrays import FloatArray


class Regional(NamedTuple):
    """The lengths: (forearm, lift) is the point in the elbow's frame, `offset` the plane's distance from the axis."""

    d1: float
    a1: float
    offset: float
    a2: float
    forearm: float
    lift: float
    size: float

    @classmethod
    def of(cls, chain: Chain, point: tuple[float, float, float]) -> Regional:
        """For a point (3,) given in the frame that turns with joint 3."""
        a1, a2, d1 = float(chain.a[0]), float(chain.a[1]), float(chain.d[0])
        offset = float(chain.d[1] + chain.d[2]) + point[2]
        offset = 0.0 if is_zero(offset) else offset
        return cls(d1, a1, offset, a2, math.hypot(*point[:2]), math.atan2(point[1], point[0]), chain.size)

    def solve(self, place: FloatArray, q: FloatArray, free: float) -> Waist:
        """θ1, θ2, θ3 into q (4, 3, m) for places (3, m) in frame 0: two sides, elbow up and down on each.

        Spong, Hutchinson, Vidyasagar (2006), §3.3.
        """
        x, y, z = place
        waist = solve_waist(x, y, self.offset, self.size, free)
        up = elbow_up(self.a2, self.forearm)
        for k, side in enumerate(waist.sides):
            elbow = solve_elbow(side.out - self.a1, z - self.d1, self.a2, self.forearm)
            for branch, sign in zip(q[2 * k : 2 * k + 2], (up, -up) if k == 0 else (-up, up), strict=True):
                branch[0] = side.theta1
                np.subtract(elbow.direction, sign * elbow.lean, out=branch[1])
                np.subtract(sign * elbow.bend, self.lift, out=branch[2])
            erase(q[2 * k : 2 * k + 2], elbow.missing | waist.missing)
        return waist


def regional_conditions(chain: Chain) -> Iterable[Condition]:
    """Axis 1 square to axes 2 and 3, which are parallel and apart."""
    yield right_angle(chain, 0)
    yield parallel(chain, 1)
    yield long_enough(chain, 1)
