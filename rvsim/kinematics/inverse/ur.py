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
from rvsim.kinematics.inverse.elbow import Mask, elbow_up, empty_rows, solve_elbow
from rvsim.kinematics.inverse.waist import Side, solve_waist
from rvsim.kinematics.inverse.words import ELBOW, SHOULDERS, combine, side_names, wrist_names
from rvsim.language import tr_later
from rvsim.spatial.arrays import FloatArray

Rows = tuple[NDArray[np.intp], ...]
SINGULAR = 5e-10  # sin θ5: below it axis 6 is parallel to axes 2, 3, 4, and θ6 is free
UNCERTAIN = 1e-4  # sin θ5: below it rounding moves θ6 so far that a stretched elbow may seem out of reach
HARMLESS = 1e-10  # sin θ5 times a turn of θ6: what such a turn changes of the pose

_FLIP, _HALF_TURN = np.array([[1.0], [-1.0]]), np.array([[0.0], [math.pi]])  # of one wrist and of the other


class _Wrist(NamedTuple):
    """Two wrists of each side: the elbow's end (u, w) in the plane, bend = θ2 + θ3 + θ4, and θ6; (..., m)."""

    u: FloatArray
    w: FloatArray
    bend: FloatArray
    theta6: FloatArray


class ParallelAxes(ClosedForm):
    """Waist, three parallel axes, two wrist axes at right angles."""

    title = tr_later("6R arm with three parallel axes")
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
        self._up = np.array([self.up, -self.up])[:, None, None]
        self.labels = combine(side_names(chain, SHOULDERS), wrist_names(chain, 4), ELBOW)

    def solve(self, S: FloatArray, free: FloatArray) -> FloatArray:
        """Shoulder, then wrist, then elbow; a numpy call works on all sides, wrists and elbows at once."""
        x, y, z = S[:, 3] - self.d6 * S[:, 2]
        waist = solve_waist(x, y, self.offset, self.chain.size, float(free[0]))
        theta1, c, s, out = waist.both
        q = empty_rows(2, 2, 2, 6, x.size)
        q[..., 0, :] = theta1[:, None, None]
        wrist = self._wrists(S, Side(theta1, c, s, out - self.a1), z - self.d1, q, float(free[5]))
        q[..., 5, :] = wrist.theta6[:, :, None]
        missing = self._fold(wrist, q) | waist.missing
        if missing.any():
            side, flip, row = np.nonzero(missing)
            q[side, flip, :, :, row] = np.nan
        return q.reshape(8, 6, -1)

    def _wrists(self, S: FloatArray, side: Side, w: FloatArray, q: FloatArray, free6: float) -> _Wrist:
        """Both wrists of both sides (2, 2, m), and θ5 into q. Axis 4 (z4) lies in the plane.

        It is s6 x + c6 y of the flange's x and y.
        """
        c, s, u = side.c[:, None], side.s[:, None], side.out
        xr, yr = (c * S[0, :2] + s * S[1, :2]).swapaxes(0, 1)
        xn, yn, an = (s * S[0, :3] - c * S[1, :3]).swapaxes(0, 1)
        xz, yz = S[2, :2]
        sine = np.sqrt(xn * xn + yn * yn)
        c6, s6 = xn / sine, -yn / sine
        uncertain = sine < UNCERTAIN
        doubtful = uncertain.any()
        if doubtful:
            free = sine < SINGULAR
            c6[free], s6[free] = math.cos(free6), math.sin(free6)
        r4, z4 = s6 * xr + c6 * yr, s6 * xz + c6 * yz
        along, across = self.d5 * r4 - self.a4 * z4, self.d5 * z4 + self.a4 * r4
        theta5 = np.arctan2(sine, -an)[:, None]
        q[:, 0, :, 4], q[:, 1, :, 4] = theta5, -theta5
        bend, theta6 = np.arctan2(r4, -z4)[:, None] + _HALF_TURN, np.arctan2(s6, c6)[:, None] + _HALF_TURN
        wrist = _Wrist(u[:, None] - _FLIP * along[:, None], w - _FLIP * across[:, None], bend, theta6)
        if doubtful:
            sense = np.where(xr * yz - xz * yr > 0.0, -1.0, 1.0)
            self._turn_all_into_reach(wrist, u, np.broadcast_to(w, u.shape), np.nonzero(uncertain), sine, sense)
        return wrist

    def _fold(self, wrist: _Wrist, q: FloatArray) -> Mask:
        """θ2, θ3, θ4 into q (2, 2, 2, 6, m); where the elbow does not reach (2, 2, m)."""
        elbow = solve_elbow(wrist.u, wrist.w, self.a2, self.a3)
        lean, bend = self._up * elbow.lean, self._up * elbow.bend
        theta2, theta3 = q[..., 1, :], q[..., 2, :]
        np.subtract(elbow.direction, lean, out=theta2[:, :, 0])
        np.add(elbow.direction, lean, out=theta2[:, :, 1])
        theta3[:, :, 0] = bend
        np.negative(bend, out=theta3[:, :, 1])
        theta4 = np.subtract(wrist.bend[:, :, None], theta2, out=q[..., 3, :])
        theta4 -= theta3
        return elbow.missing

    def _turn_all_into_reach(
        self, wrist: _Wrist, u: FloatArray, w: FloatArray, rows: Rows, sine: FloatArray, sense: FloatArray
    ) -> None:
        """Either wrist of each side; u, w, sine, sense (2, m)."""
        for flip in range(2):
            self._turn_into_reach(_Wrist(*(entry[:, flip] for entry in wrist)), u, w, rows, sine, sense)

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
