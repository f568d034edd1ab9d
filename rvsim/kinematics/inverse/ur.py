"""6R arms with three parallel axes and an offset wrist: UR5e and its relatives. Up to eight branches.

The last axis but one carries the offset d4 beside the arm's plane, which gives joint 1; the plane's normal, seen from
the flange, gives the wrist; what is left is two links in a plane. Hawkins (2013), with the offsets kept general.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rvsim.kinematics.inverse.chain import Chain, wrap
from rvsim.kinematics.inverse.closed_form import ClosedForm, Condition, intersecting, long_enough, parallel, right_angle
from rvsim.kinematics.inverse.elbow import Mask, elbow_up, empty_rows, erase, solve_elbow
from rvsim.kinematics.inverse.spherical_wrist import plane_entries
from rvsim.kinematics.inverse.waist import Side, solve_waist
from rvsim.kinematics.inverse.words import ELBOW, combine, side_names, wrist_names
from rvsim.spatial.arrays import FloatArray

Rows = NDArray[np.intp]
SINGULAR = 5e-10  # sin θ5: below it axis 6 is parallel to axes 2, 3, 4, and θ6 is free
UNCERTAIN = 1e-4  # sin θ5: below it rounding moves θ6 so far that a stretched elbow may seem out of reach
HARMLESS = 1e-10  # sin θ5 times a turn of θ6: what such a turn changes of the pose


class _Wrist(NamedTuple):
    """One of two wrists: the elbow's end (u, w) in the plane, bend = θ2 + θ3 + θ4, and θ6."""

    u: FloatArray
    w: FloatArray
    bend: FloatArray
    theta6: FloatArray


class ParallelAxes(ClosedForm):
    """Waist, three parallel axes, two wrist axes at right angles."""

    title = "6R arm with three parallel axes"
    joints = "RRRRRR"

    @classmethod
    def conditions(cls, chain: Chain) -> Iterable[Condition]:
        """Axis 1 square to axes 2, 3, 4, which are parallel; axis 5 square to them, axis 6 to axis 5 and meeting it."""
        yield right_angle(chain, 0)
        yield parallel(chain, 1)
        yield parallel(chain, 2)
        yield from (long_enough(chain, i) for i in (1, 2))
        yield from (right_angle(chain, i) for i in (3, 4))
        yield intersecting(chain, 4)

    def __init__(self, chain: Chain) -> None:
        super().__init__(chain)
        self.a1, self.a2, self.a3, self.a4 = (float(a) for a in chain.a[:4])
        self.d1, self.d5, self.d6 = (float(chain.d[i]) for i in (0, 4, 5))
        self.offset = float(chain.d[1:4].sum())
        self.up = elbow_up(self.a2, self.a3)
        self.labels = combine(side_names(chain, ("left shoulder", "right shoulder")), wrist_names(chain, 4), ELBOW)

    def solve(self, S: FloatArray, free: FloatArray) -> FloatArray:
        """Shoulder, then wrist, then elbow."""
        x, y, z = S[:, 3] - self.d6 * S[:, 2]
        waist = solve_waist(x, y, self.offset, self.chain.size, float(free[0]))
        q = empty_rows(2, 2, 2, 6, x.size)
        for k, side in enumerate(waist.sides):
            q[k, :, :, 0] = side.theta1
            self._solve_side(S, side, z - self.d1, q[k], waist.missing, (-1.0) ** k * self.up, float(free[5]))
        return q.reshape(8, 6, -1)

    def _solve_side(
        self, S: FloatArray, side: Side, w: FloatArray, q: FloatArray, missing: Mask, up: float, free6: float
    ) -> None:
        """θ2 … θ6 into q (2, 2, 6, m). Axis 4 (z4) lies in the plane: it is s6 x + c6 y of the flange's x and y."""
        (xr, yr, _), (xz, yz, _), (xn, yn, an) = plane_entries(S, side)
        u = side.out - self.a1
        sine = np.sqrt(xn * xn + yn * yn)
        c6, s6 = xn / sine, -yn / sine
        uncertain = np.flatnonzero(sine < UNCERTAIN)
        if uncertain.size:
            free = sine < SINGULAR
            c6[free], s6[free] = math.cos(free6), math.sin(free6)
        r4, z4 = s6 * xr + c6 * yr, s6 * xz + c6 * yz
        along, across = self.d5 * r4 - self.a4 * z4, self.d5 * z4 + self.a4 * r4
        theta5, theta6, bend = np.arctan2(sine, -an), np.arctan2(s6, c6), np.arctan2(r4, -z4)
        for flip, branches in enumerate(q):
            sign, turn = 1.0 - 2.0 * flip, math.pi * flip
            wrist = _Wrist(u - sign * along, w - sign * across, bend + turn, theta6 + turn)
            if uncertain.size:
                sense = np.where(xr * yz - xz * yr > 0.0, -1.0, 1.0)
                self._turn_into_reach(wrist, u, w, uncertain, sine, sense)
            branches[:, 4], branches[:, 5] = sign * theta5, wrist.theta6
            erase(branches, self._fold(wrist, branches, up) | missing)

    def _fold(self, wrist: _Wrist, q: FloatArray, up: float) -> Mask:
        """θ2, θ3, θ4 into q (2, 6, m)."""
        elbow = solve_elbow(wrist.u, wrist.w, self.a2, self.a3)
        for branch, sign in zip(q, (up, -up), strict=True):
            np.subtract(elbow.direction, sign * elbow.lean, out=branch[1])
            np.multiply(elbow.bend, sign, out=branch[2])
            np.subtract(wrist.bend, branch[1], out=branch[3])
            branch[3] -= branch[2]
        return elbow.missing

    def _turn_into_reach(
        self, wrist: _Wrist, u: FloatArray, w: FloatArray, rows: Rows, sine: FloatArray, sense: FloatArray
    ) -> None:
        """Where θ6 is free, or known badly: the least turn, in place, that lets the links reach; (u, w) is axis 5.

        As θ6 grows, axis 4 turns from the flange's y to its x: `sense` tells which way round that is in the plane.
        """
        link_u, link_w = u[rows] - wrist.u[rows], w[rows] - wrist.w[rows]
        opening = wrap(np.arctan2(link_w, link_u) - np.arctan2(w[rows], u[rows]))
        least, most = self._openings(np.hypot(u[rows], w[rows]))
        turn = np.copysign(np.clip(np.abs(opening), least, most), opening) - opening
        turn[(sine[rows] >= SINGULAR) & (sine[rows] * np.abs(turn) > HARMLESS)] = 0.0
        c, s = np.cos(turn), np.sin(turn)
        wrist.u[rows], wrist.w[rows] = u[rows] - (c * link_u - s * link_w), w[rows] - (s * link_u + c * link_w)
        wrist.bend[rows] += turn
        wrist.theta6[rows] += sense[rows] * turn

    def _openings(self, away: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The least and the greatest angle at the shoulder-to-wrist line with which d5, a4 leave the elbow in reach."""
        length = math.hypot(self.d5, self.a4)
        nearest, farthest = abs(abs(self.a2) - abs(self.a3)), abs(self.a2) + abs(self.a3)
        scale = 1.0 / np.maximum(2.0 * away * length, 1e-300)
        squares = away * away + length * length
        cosines = ((squares - nearest**2) * scale, (squares - farthest**2) * scale)
        least, most = (np.arccos(np.clip(cosine, -1.0, 1.0)) for cosine in cosines)
        return least, most
