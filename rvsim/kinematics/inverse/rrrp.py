"""Waist, shoulder, roll, and a prismatic joint along the roll axis (source 003): a pose has one solution.

Source 003's own inverse kinematics has misprints; this is derived from the DH rows. A full pose asks two things too
many: the tool axis must lie in the arm's plane, and pass beside the shoulder at the distance l5.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from rvsim.kinematics.inverse.chain import Chain
from rvsim.kinematics.inverse.closed_form import (
    ClosedForm,
    Condition,
    intersecting,
    is_zero,
    long_enough,
    parallel,
    right_angle,
)
from rvsim.kinematics.inverse.elbow import empty_rows, erase
from rvsim.kinematics.inverse.extension import extension_labels, solve_extension
from rvsim.kinematics.inverse.five_axis import FEASIBLE, tool_plane
from rvsim.kinematics.inverse.words import ONLY
from rvsim.language import tr, tr_later
from rvsim.spatial.arrays import FloatArray


class RollAndExtend(ClosedForm):
    """Waist, shoulder, roll, extension along the roll axis."""

    title = tr_later("RRRP arm whose prismatic joint lies on the roll axis")
    joints = "RRRP"
    labels = (ONLY,)

    @classmethod
    def conditions(cls, chain: Chain) -> Iterable[Condition]:
        """Axes 1, 2, 3 square in turn; axes 3 and 4 one line, beside axis 2; all in one plane with axis 1."""
        yield right_angle(chain, 0)
        yield right_angle(chain, 1)
        yield parallel(chain, 2)
        yield intersecting(chain, 2)
        yield is_zero(chain.d[1]), tr("the offset d along axis 2 must be 0.")
        yield long_enough(chain, 1)

    def __init__(self, chain: Chain) -> None:
        super().__init__(chain)
        self.a1, self.a2, self.d1, self.d3 = (float(v) for v in (*chain.a[:2], chain.d[0], chain.d[2]))
        self.place_labels = extension_labels(chain)

    def solve(self, S: FloatArray, free: FloatArray) -> FloatArray:
        """The plane gives θ1, the tool axis in it θ2, the rotation about it θ3, the way along it the extension."""
        (xx, xy, _), (yx, yy, _), (ax, ay, az), (x, y, z) = (S[:, j] for j in range(4))
        plane = tool_plane(x, y, ax, ay, self.chain.size, float(free[0]))
        r, ar, w = x * plane.x + y * plane.y, ax * plane.x + ay * plane.y, z - self.d1
        # How far the tool axis passes from where it should, if the arm faces the tool or is turned away from it.
        front = ar * w - az * (r - self.a1) - self.a2
        back = az * (r + self.a1) - ar * w - self.a2
        side = np.where(np.abs(front) <= np.abs(back), 1.0, -1.0)
        q = empty_rows(1, 4, x.size)
        dx, dy, ar = side * plane.x, side * plane.y, side * ar
        q[0, 0], q[0, 1] = np.arctan2(dy, dx), np.arctan2(ar, -az)
        q[0, 2] = np.arctan2(xx * dy - xy * dx, yx * dy - yy * dx) - self.chain.theta[3]
        q[0, 3] = (side * r - self.a1) * ar + w * az - self.d3
        astray = np.minimum(np.abs(front), np.abs(back)) > FEASIBLE * self.chain.size
        erase(q, plane.infeasible | astray)
        return q

    def reaches(self, place: FloatArray) -> bool | None:
        """Whether some branch brings the tool there with the roll at 0."""
        return not bool(np.isnan(self.solve_place(place[:, None], np.zeros(4))).all())

    @np.errstate(divide="ignore", invalid="ignore")
    def solve_place(self, place: FloatArray, free: FloatArray) -> FloatArray:
        """Variables of the normal form (4, 4, m) that bring the tool to places (3, m) in frame 0.

        The roll is that of `free` (n,), and so is any other joint that is free there.
        """
        theta3 = float(free[2])
        chain, tip = self.chain, self.chain.T_n_tool[:3, 3]
        c, s = math.cos(theta3 + chain.theta[3]), math.sin(theta3 + chain.theta[3])
        along, aside = c * tip[0] - s * tip[1], s * tip[0] + c * tip[1]
        q = empty_rows(4, 4, place.shape[1])
        q[:, 0], q[:, 1], length = solve_extension(chain, place, float(chain.a[1] + along), float(aside), free)
        q[:, 2], q[:, 3] = theta3, length - chain.d[2] - tip[2]
        q[np.broadcast_to(np.isnan(length)[:, None], q.shape)] = np.nan
        return q
