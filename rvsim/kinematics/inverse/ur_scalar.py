"""The closed form of `ur` for one pose in plain floats: below some twenty poses this beats arrays by far."""

from __future__ import annotations

import math
from math import atan2, remainder, sqrt

import numpy as np

from rvsim.kinematics.inverse.chain import TOLERANCE, TURN
from rvsim.kinematics.inverse.elbow import COSINE_TOLERANCE, folded_tolerance
from rvsim.kinematics.inverse.ur import UNCERTAIN, ParallelAxes
from rvsim.spatial.arrays import FloatArray

_PI = math.pi


class ScalarParallelAxes:
    """One arm's closed form in floats.

    It `fits` where the joint zeros are those of the DH rows but for half turns of joints 1, 5 and 6.
    """

    def __init__(self, form: ParallelAxes) -> None:
        a2, a3, chain = form.a2, form.a3, form.chain
        self.chain = chain
        self.lengths = (form.a1, form.a4, form.d1, form.d5, form.d6, form.offset)
        self.elbow = (
            (a2 + a3) ** 2,
            (a2 - a3) ** 2,
            0.5 / (a2 * a3),
            a2 * a2 - a3 * a3,
            0.5 / a2,
            a3,
            folded_tolerance(a2, a3),
        )
        self.halves = tuple(math.copysign(1.0, math.cos(chain.offset[i])) for i in (0, 4, 5))
        self.up = form.up
        self.smallest = (1e-6 * chain.size) ** 2
        turned = np.abs(np.sin(chain.offset[[0, 4, 5]])).max() > TOLERANCE or chain.offset[1:4].any()
        self.fits = not turned and bool((chain.sign > 0.0).all())

        self.bare = np.array_equal(chain.T_0_base, np.eye(4)) and np.array_equal(chain.T_tool_n, np.eye(4))

    def solve(self, T: FloatArray) -> list[float] | None:
        """Joints within [−π, π] of every branch of T_base_tool (4, 4), six a branch, in the order of the labels.

        None where a joint is free: that is for arrays to do.
        """
        if self.bare:
            return self._branches(T)
        return self._branches(self.chain.T_0_base @ T @ self.chain.T_tool_n)

    def _branches(self, T: FloatArray) -> list[float] | None:
        (xx, yx, ax, px), (xy, yy, ay, py), (xz, yz, az, pz), _ = T.tolist()
        a1, a4, d1, d5, d6, offset = self.lengths
        half1, half5, half6 = self.halves
        px, py, w = px - d6 * ax, py - d6 * ay, pz - d6 * az - d1
        square = px * px + py * py
        inside = square - offset * offset
        if square < self.smallest:
            return None
        if inside < -2.0 * COSINE_TOLERANCE * offset * offset:
            return []
        length = sqrt(max(inside, 0.0))
        joints: list[float] = []
        for out, up in ((length, self.up), (-length, -self.up)):
            c, s = (px * out - py * offset) / square, (py * out + px * offset) / square
            xn, yn, an = s * xx - c * xy, s * yx - c * yy, s * ax - c * ay
            sine = sqrt(xn * xn + yn * yn)
            if sine < UNCERTAIN:
                return None
            c6, s6 = xn / sine, -yn / sine
            r4, z4 = s6 * (c * xx + s * xy) + c6 * (c * yx + s * yy), s6 * xz + c6 * yz
            along, across, u = d5 * r4 - a4 * z4, d5 * z4 + a4 * r4, out - a1
            bend = atan2(r4, -z4)
            q1, q5, q6 = atan2(half1 * s, half1 * c), atan2(half5 * sine, -half5 * an), atan2(half6 * s6, half6 * c6)
            self._fold(joints, u - along, w - across, bend, up, q1, q5, q6)
            self._fold(joints, u + along, w + across, bend + _PI, up, q1, -q5, q6 - _PI if q6 > 0.0 else q6 + _PI)
        return joints

    def _fold(
        self, joints: list[float], u: float, w: float, bend: float, up: float, q1: float, q5: float, q6: float
    ) -> None:
        """Both elbows for the elbow's end at (u, w) and bend = θ2 + θ3 + θ4."""
        stretched, folded, half, difference, scale, a3, slack = self.elbow
        square = u * u + w * w
        minus, plus = (stretched - square) * half, (square - folded) * half
        if minus < 0.0 or plus < 0.0:
            if minus < -COSINE_TOLERANCE or plus < -slack:
                return
            minus, plus = max(minus, 0.0), max(plus, 0.0)
        minus, plus = sqrt(minus), sqrt(plus)
        q3 = up * 2.0 * atan2(minus, plus)
        lean = up * atan2(a3 * minus * plus, (square + difference) * scale)
        direction = atan2(w, u)
        q2 = direction - lean
        joints += (q1, remainder(q2, TURN), q3, remainder(bend - q2 - q3, TURN), q5, q6)
        q2 = direction + lean
        joints += (q1, remainder(q2, TURN), -q3, remainder(bend - q2 + q3, TURN), q5, q6)
