"""6R arms with three wrist axes that meet: RV-1A, PUMA and most industrial arms. Eight branches.

The wrist's centre depends on the first three joints alone, the rest of the rotation on the last three (Pieper 1968;
source 001 decouples the RV-1A in this way).
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from rvsim.kinematics.inverse.chain import Chain
from rvsim.kinematics.inverse.closed_form import ClosedForm, Condition, intersecting, is_zero, right_angle
from rvsim.kinematics.inverse.elbow import empty_rows, links_reach
from rvsim.kinematics.inverse.regional import Regional, regional_conditions
from rvsim.kinematics.inverse.trigonometry import cosine_and_sine
from rvsim.kinematics.inverse.waist import Side
from rvsim.kinematics.inverse.words import ELBOW, combine, side_names, wrist_names
from rvsim.language import tr, tr_later
from rvsim.spatial.arrays import FloatArray

_SINGULAR = 5e-10  # sin θ5: below it axes 4 and 6 are one, and θ4 is free


class SphericalWrist(ClosedForm):
    """Waist, shoulder, elbow, and a wrist of three axes through one point."""

    title = tr_later("6R arm with a spherical wrist")
    joints = "RRRRRR"

    @classmethod
    def conditions(cls, chain: Chain) -> Iterable[Condition]:
        """The first three axes as in an articulated arm; the last three square to each other, through one point."""
        yield from regional_conditions(chain)
        yield from (right_angle(chain, i) for i in (2, 3, 4))
        yield from (intersecting(chain, i) for i in (3, 4))
        yield is_zero(chain.d[4]), tr("axes 4, 5 and 6 must meet in one point: no offset d along axis 5.")
        forearm = math.hypot(chain.a[2], chain.d[3])
        yield not is_zero(forearm), tr("the forearm, a of axis 3 and d of axis 4, must have a length.")

    def __init__(self, chain: Chain) -> None:
        super().__init__(chain)
        self.regional = Regional.of(chain, (float(chain.a[2]), -float(chain.d[3]), 0.0))
        self.d6 = float(chain.d[5])
        self.labels = combine(side_names(chain), ELBOW, wrist_names(chain, 4))

    def reaches(self, place: FloatArray) -> bool | None:
        """The wrist turns the tool all around its centre; an arm with offsets at its waist is not known here."""
        arm = self.regional
        if arm.a1 or arm.offset:
            return None
        last = float(np.linalg.norm(self.chain.T_n_tool[:3, 3] + (0.0, 0.0, self.d6)))
        return links_reach(math.hypot(*place[:2], place[2] - arm.d1), arm.a2, arm.forearm, last)

    def solve(self, S: FloatArray, free: FloatArray) -> FloatArray:
        """The wrist's centre gives θ1, θ2, θ3; the rotation that is left gives the wrist."""
        arm = empty_rows(4, 3, S.shape[2])
        waist = self.regional.solve(S[:, 3] - self.d6 * S[:, 2], arm, float(free[0]))
        q = empty_rows(4, 2, 6, S.shape[2])
        q[:, :, :3] = arm[:, None]
        for k, side in enumerate(waist.sides):
            elbows = slice(2 * k, 2 * k + 2)
            solve_wrist(plane_entries(S, side), arm[elbows, 1] + arm[elbows, 2], float(free[3]), q[elbows])
        return q.reshape(8, 6, -1)


def plane_entries(S: FloatArray, side: Side) -> FloatArray:
    """The rotations' columns (3, 3, m) along the arm's plane outwards, up, and along the plane's normal."""
    entries = empty_rows(3, 3, S.shape[2])
    np.add(side.c * S[0, :3], side.s * S[1, :3], out=entries[0])
    entries[1] = S[2, :3]
    np.subtract(side.s * S[0, :3], side.c * S[1, :3], out=entries[2])
    return entries


def solve_wrist(in_plane: FloatArray, bend: FloatArray, free4: float, q: FloatArray) -> None:
    """θ4, θ5, θ6 into q (elbows, 2, 6, m), for sin θ5 above and below 0; bend = θ2 + θ3 is (elbows, m).

    With the rotation R of frame 6 in frame 3: (c4 s5, s4 s5, −c5) is its third column; then θ6 from the row across
    axis 4, which needs no division by sin θ5.
    """
    c, s = cosine_and_sine(bend)
    (xr, yr, ar), (xz, yz, az), (xn, yn, an) = in_plane
    along, down = c * ar + s * az, s * ar - c * az
    sine = np.sqrt(along * along + an * an)
    c4, s4 = along / sine, an / sine
    singular = sine < _SINGULAR
    if singular.any():
        c4[singular], s4[singular] = math.cos(free4), math.sin(free4)
    plus, minus = q[:, 0], q[:, 1]
    plus[:, 3] = np.arctan2(s4, c4)
    plus[:, 4] = np.arctan2(sine, -down)
    plus[:, 5] = np.arctan2(s4 * (c * xr + s * xz) - c4 * xn, s4 * (c * yr + s * yz) - c4 * yn)
    np.add(plus[:, 3], math.pi, out=minus[:, 3])
    np.negative(plus[:, 4], out=minus[:, 4])
    np.add(plus[:, 5], math.pi, out=minus[:, 5])
