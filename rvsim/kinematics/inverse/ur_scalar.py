"""The closed form of `ur` for one pose in plain floats: below some twenty poses this beats arrays by far."""

from __future__ import annotations

import math
from collections.abc import Callable
from math import atan2, remainder, sqrt
from struct import Struct

import numpy as np

from rvsim.kinematics.inverse.chain import TOLERANCE, TURN
from rvsim.kinematics.inverse.elbow import COSINE_TOLERANCE, folded_tolerance
from rvsim.kinematics.inverse.ur import UNCERTAIN, ParallelAxes
from rvsim.spatial.arrays import FloatArray

_PI = math.pi
_Wrist = tuple[float, float, float, float, float, float, float]  # θ1, u, w, bend = θ2 + θ3 + θ4, up, θ5, θ6
_upper_rows = Struct("12d").unpack_from
# Packed into an array made for them, the joints cost half of what `np.array` of a list takes.
_writers: tuple[Callable[..., None], ...] = tuple(Struct(f"{count}d").pack_into for count in range(49))


class ScalarParallelAxes:
    """One arm's closed form in floats.

    It `fits` where the joint zeros are those of the DH rows but for half turns of joints 1, 5 and 6.
    """

    def __init__(self, form: ParallelAxes) -> None:
        a2, a3, chain = form.a2, form.a3, form.chain
        self.chain = chain
        nearest = form.offset**2 * (1.0 - 2.0 * COSINE_TOLERANCE)
        self.lengths = (form.a1, form.a4, form.d1, form.d5, form.d6, form.offset, nearest)
        half, slack = 0.5 / (a2 * a3), folded_tolerance(a2, a3)
        self.elbow = ((a2 + a3) ** 2, (a2 - a3) ** 2, half, a2 * a2 - a3 * a3, 0.5 / a2, a3, slack)
        self.halves = tuple(math.copysign(1.0, math.cos(chain.offset[i])) for i in (0, 4, 5))
        self.up = form.up
        self.smallest = (1e-6 * chain.size) ** 2
        turned = np.abs(np.sin(chain.offset[[0, 4, 5]])).max() > TOLERANCE or chain.offset[1:4].any()
        self.fits = not turned and bool((chain.sign > 0.0).all())
        self.bare = np.array_equal(chain.T_0_base, np.eye(4)) and np.array_equal(chain.T_tool_n, np.eye(4))

    def solve(self, T: FloatArray) -> FloatArray | None:
        """Joints (b, 6) within [−π, π] of every branch of T_base_tool (4, 4), in the order of the labels.

        None where a joint is free, or nearly so: that is for arrays to do.
        """
        if not self.bare:
            T = self.chain.T_0_base @ T @ self.chain.T_tool_n
        wrists = self._wrists(_upper_rows(T.tobytes()))
        if wrists is None:
            return None
        joints = self._folds(wrists)
        q = np.empty((len(joints) // 6, 6))
        _writers[len(joints)](q, 0, *joints)
        return q

    def _wrists(self, entries: tuple[float, ...]) -> list[_Wrist] | None:
        """Both wrists of both sides. With axis 6 reaching ar outwards and az up, axis 4, square to it, is (az, −ar)."""
        xx, yx, ax, px, xy, yy, ay, py, _, _, az, pz = entries
        a1, a4, d1, d5, d6, offset, nearest = self.lengths
        half1, half5, half6 = self.halves
        px, py, w = px - d6 * ax, py - d6 * ay, pz - d6 * az - d1
        square = px * px + py * py
        if not square >= self.smallest:
            return None
        if square < nearest:
            return []
        inside = square - offset * offset
        length = sqrt(inside) if inside > 0.0 else 0.0
        wrists = []
        for out, up in ((length, self.up), (-length, -self.up)):
            c, s = (px * out - py * offset) / square, (py * out + px * offset) / square
            xn, yn, an, ar = s * xx - c * xy, s * yx - c * yy, s * ax - c * ay, c * ax + s * ay
            sine = sqrt(ar * ar + az * az)
            if not sine >= UNCERTAIN:
                return None
            along, across, u = (d5 * az + a4 * ar) / sine, (a4 * az - d5 * ar) / sine, out - a1
            q1, q5, q6 = atan2(half1 * s, half1 * c), atan2(half5 * sine, -half5 * an), atan2(-half6 * yn, half6 * xn)
            bend = atan2(az, ar)
            wrists.append((q1, u - along, w - across, bend, up, q5, q6))
            wrists.append((q1, u + along, w + across, bend + _PI, up, -q5, q6 - _PI if q6 > 0.0 else q6 + _PI))
        return wrists

    def _folds(self, wrists: list[_Wrist]) -> list[float]:
        """Six joints of each branch, two elbows a wrist, by the formulas of `solve_elbow`."""
        stretched, folded, half, difference, scale, a3, slack = self.elbow
        joints: list[float] = []
        for q1, u, w, bend, up, q5, q6 in wrists:
            square = u * u + w * w
            minus, plus = (stretched - square) * half, (square - folded) * half
            product = minus * plus
            if not product >= 0.0:
                if not (minus >= -COSINE_TOLERANCE and plus >= -slack):
                    continue
                product = 0.0
            sine = up * sqrt(product)
            q3, lean, direction = atan2(sine, 1.0 - minus), atan2(a3 * sine, (square + difference) * scale), atan2(w, u)
            rest, turn = bend - direction, lean - q3
            q2, q4 = remainder(direction - lean, TURN), remainder(rest + turn, TURN)
            other2, other4 = remainder(direction + lean, TURN), remainder(rest - turn, TURN)
            joints += (q1, q2, q3, q4, q5, q6, q1, other2, -q3, other4, q5, q6)
        return joints
