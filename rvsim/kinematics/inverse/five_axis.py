"""5R arms whose joints 2, 3 and 4 bend in one vertical plane: the RV-M1, the AL5B and their relatives.

The tool axis stays in the vertical plane through the base axis, so a pose is feasible only if it does; then there are
four branches, all or none. Source 000, eqs (10)-(17), with the corrections its signs need; source 004, eqs 3.20-3.29.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from rvsim.kinematics.inverse.chain import Chain
from rvsim.kinematics.inverse.closed_form import ClosedForm, Condition, is_zero, long_enough, parallel, right_angle
from rvsim.kinematics.inverse.elbow import Elbow, Mask, elbow_up, empty_rows, erase, links_reach, solve_elbow
from rvsim.kinematics.inverse.projection import has_tip_on_roll_axis
from rvsim.kinematics.inverse.words import ELBOW, combine, side_names
from rvsim.language import tr, tr_later
from rvsim.spatial.arrays import FloatArray

FEASIBLE = 1e-9  # [rad] how far the tool axis may lean out of the plane; the same of the arm's size for the tip
_NEAR_AXIS = 1e-6  # of the size: closer to the base axis the tip no longer tells the plane well enough
_ON_AXIS = 1e-10  # of the size, and [rad] of tilt: a vertical tool on the base axis leaves the plane free


class Plane(NamedTuple):
    """The vertical plane of each pose: its outward direction (x, y), and where a pose leans out of every plane."""

    x: FloatArray
    y: FloatArray
    infeasible: Mask


class FiveAxis(ClosedForm):
    """Waist, three parallel axes, roll."""

    title = tr_later("5R arm with a waist, three parallel axes and a roll")
    joints = "RRRRR"

    @classmethod
    def conditions(cls, chain: Chain) -> Iterable[Condition]:
        """Axis 1 square to axes 2, 3, 4, which are parallel and lie in line; the roll axis square to them."""
        yield right_angle(chain, 0)
        yield parallel(chain, 1)
        yield parallel(chain, 2)
        yield right_angle(chain, 3)
        yield long_enough(chain, 1)
        yield long_enough(chain, 2)
        yield is_zero(chain.d[1:4].sum()), tr("the offsets d along the parallel axes 2, 3 and 4 must cancel.")

    def __init__(self, chain: Chain) -> None:
        super().__init__(chain)
        self.a1, self.a2, self.a3, self.a4 = (float(a) for a in chain.a[:4])
        self.d1, self.d5 = float(chain.d[0]), float(chain.d[4])
        self.labels = combine(side_names(chain), ELBOW)
        self.up = elbow_up(self.a2, self.a3)

    def solve(self, S: FloatArray, free: FloatArray) -> FloatArray:
        """The plane gives θ1, pitch and roll; the wrist in it gives the elbow."""
        (xx, xy, _), (yx, yy, _), (ax, ay, az), (x, y, z) = (S[:, j] for j in range(4))
        plane = tool_plane(x, y, ax, ay, self.chain.size, float(free[0]))
        r, ar = x * plane.x + y * plane.y, ax * plane.x + ay * plane.y
        q = empty_rows(4, 5, x.size)
        q[:2, 0] = np.arctan2(plane.y, plane.x)
        q[:2, 4] = np.arctan2(xx * plane.y - xy * plane.x, yx * plane.y - yy * plane.x)
        q[2:, 0], q[2:, 4] = q[0, 0] + math.pi, q[0, 4] + math.pi
        u, w = r - self.d5 * ar, z - self.d1 - self.d5 * az
        bend = np.arctan2(ar, -az)
        front = solve_elbow(u + self.a4 * az - self.a1, w - self.a4 * ar, self.a2, self.a3)
        # The back is the front's mirror image, unless axis 2 passes beside axis 1 or axis 5 beside axis 4.
        mirrored = front._replace(direction=math.pi - front.direction)
        beside = self.a1 or self.a4
        back = solve_elbow(-u + self.a4 * az - self.a1, w + self.a4 * ar, self.a2, self.a3) if beside else mirrored
        _fill(q[:2], front, bend, self.up)
        _fill(q[2:], back, -bend, -self.up)
        erase(q[:2], front.missing | plane.infeasible)
        erase(q[2:], back.missing | plane.infeasible)
        return q

    def reaches(self, place: FloatArray) -> bool | None:
        """Three links in the plane of either side; a tip beside the roll axis is not known here."""
        if not has_tip_on_roll_axis(self.chain):
            return None
        last = math.hypot(self.d5 + self.chain.T_n_tool[2, 3], self.a4)
        out, up = math.hypot(place[0], place[1]), float(place[2]) - self.d1
        return any(links_reach(math.hypot(side - self.a1, up), self.a2, self.a3, last) for side in (out, -out))

    def fill_side(self, side: FloatArray, u: FloatArray, w: FloatArray, bend: FloatArray, up: float) -> Mask:
        """θ2, θ3, θ4 of one side (2, 5, ...), elbow up first, for the wrist (u, w) and bend = θ2 + θ3 + θ4."""
        elbow = solve_elbow(u, w, self.a2, self.a3)
        _fill(side, elbow, bend, up)
        return elbow.missing


def _fill(side: FloatArray, elbow: Elbow, bend: FloatArray, up: float) -> None:
    for branch, sign in zip(side, (up, -up), strict=True):
        np.subtract(elbow.direction, sign * elbow.lean, out=branch[1])
        np.multiply(elbow.bend, sign, out=branch[2])
        np.subtract(bend, branch[1], out=branch[3])
        branch[3] -= branch[2]


def tool_plane(x: FloatArray, y: FloatArray, ax: FloatArray, ay: FloatArray, size: float, free: float) -> Plane:
    """The vertical plane through the base axis that holds the tip (x, y) and the tool axis (ax, ay), each (m,).

    The tip tells it; where it is on the base axis, the tool axis; where that is vertical too, `free` [rad] is taken.
    """
    rho = np.sqrt(x * x + y * y)
    near = rho <= _NEAR_AXIS * size
    if not near.any():
        dx, dy = x / rho, y / rho
        return Plane(dx, dy, np.abs(ax * dy - ay * dx) > FEASIBLE)
    tilt = np.sqrt(ax * ax + ay * ay)
    by_tool = near & (tilt > rho / size)
    turned = np.where(by_tool & (x * ax + y * ay < 0.0), -1.0, 1.0)
    dx, dy = np.where(by_tool, turned * ax, x), np.where(by_tool, turned * ay, y)
    anything = (rho <= _ON_AXIS * size) & (tilt <= _ON_AXIS)
    dx[anything], dy[anything] = math.cos(free), math.sin(free)
    norm = np.sqrt(dx * dx + dy * dy)
    dx, dy = dx / norm, dy / norm
    leans = np.abs(ax * dy - ay * dx) > FEASIBLE
    return Plane(dx, dy, leans | (np.abs(x * dy - y * dx) > FEASIBLE * size))
