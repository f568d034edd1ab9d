"""The classic arms of the textbooks, asked for what they can do: a place, a place and a yaw, or a point of a plane.

Spong, Hutchinson, Vidyasagar (2006), chapters 1 and 3; source 004, §2.1. Each allows offsets and a tool of any shape.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from rvsim.kinematics.inverse.chain import Chain
from rvsim.kinematics.inverse.closed_form import ClosedForm, Condition, is_zero, long_enough, parallel, right_angle
from rvsim.kinematics.inverse.elbow import empty_rows, erase, solve_elbow
from rvsim.kinematics.inverse.extension import extension_labels, solve_extension
from rvsim.kinematics.inverse.regional import Regional, regional_conditions
from rvsim.kinematics.inverse.waist import solve_waist
from rvsim.kinematics.inverse.words import ELBOW, ELBOW_SIDES, EXTENSION, FACING, ONLY, combine, side_names
from rvsim.language import tr, tr_later
from rvsim.spatial.arrays import FloatArray


class Planar(ClosedForm):
    """Two links in a plane."""

    title = tr_later("planar RR arm")
    joints = "RR"
    task = "x,y"
    place_only = True
    labels = ELBOW

    @classmethod
    def conditions(cls, chain: Chain) -> Iterable[Condition]:
        """Parallel axes, two links."""
        yield parallel(chain, 0)
        yield long_enough(chain, 0)
        yield not is_zero(math.hypot(*chain.T_n_tool[:2, 3])), tr("the second link must have a length.")

    def solve(self, S: FloatArray, free: FloatArray) -> FloatArray:  # noqa: ARG002 (nothing is free)
        """The law of cosines."""
        tip_x, tip_y = self.chain.T_n_tool[:2, 3]
        elbow = solve_elbow(S[0, 3], S[1, 3], float(self.chain.a[0]), math.hypot(tip_x, tip_y))
        up = -math.copysign(1.0, self.chain.a[0])
        q = empty_rows(2, 2, S.shape[2])
        for branch, sign in zip(q, (up, -up), strict=True):
            branch[0] = elbow.direction - sign * elbow.lean
            branch[1] = sign * elbow.bend - math.atan2(tip_y, tip_x)
        erase(q, elbow.missing)
        return q


class Articulated(ClosedForm):
    """Waist, shoulder, elbow."""

    title = tr_later("articulated RRR arm")
    joints = "RRR"
    task = "position"
    place_only = True

    @classmethod
    def conditions(cls, chain: Chain) -> Iterable[Condition]:
        """Axis 1 square to two parallel axes, two links."""
        yield from regional_conditions(chain)
        yield not is_zero(math.hypot(*chain.T_n_tool[:2, 3])), tr("the forearm must have a length.")

    def __init__(self, chain: Chain) -> None:
        super().__init__(chain)
        x, y, z = (float(v) for v in chain.T_n_tool[:3, 3])
        self.regional = Regional.of(chain, (x, y, z))
        self.labels = combine(side_names(chain), ELBOW)

    def solve(self, S: FloatArray, free: FloatArray) -> FloatArray:
        """Two sides, two elbows."""
        q = empty_rows(4, 3, S.shape[2])
        self.regional.solve(S[:, 3], q, float(free[0]))
        return q


class Spherical(ClosedForm):
    """Waist, shoulder, extension: the Stanford arm's first three joints."""

    title = tr_later("spherical RRP arm")
    joints = "RRP"
    task = "position"
    place_only = True

    @classmethod
    def conditions(cls, chain: Chain) -> Iterable[Condition]:
        """Three axes square in turn."""
        yield right_angle(chain, 0)
        yield right_angle(chain, 1)

    def __init__(self, chain: Chain) -> None:
        super().__init__(chain)
        self.labels = extension_labels(chain)

    def solve(self, S: FloatArray, free: FloatArray) -> FloatArray:
        """Two sides, two directions of the extension."""
        chain, tip = self.chain, self.chain.T_n_tool[:3, 3]
        c, s = math.cos(chain.theta[2]), math.sin(chain.theta[2])
        across, offset = chain.a[1] + c * tip[0] - s * tip[1], chain.d[1] + s * tip[0] + c * tip[1]
        q = empty_rows(4, 3, S.shape[2])
        q[:, 0], q[:, 1], length = solve_extension(chain, S[:, 3], float(across), float(offset), free)
        q[:, 2] = length - tip[2]
        q[np.broadcast_to(np.isnan(length)[:, None], q.shape)] = np.nan
        return q


class Scara(ClosedForm):
    """Two links in a horizontal plane, a vertical stroke, a yaw."""

    title = tr_later("SCARA, RRPR")
    joints = "RRPR"
    task = "position+yaw"
    place_only = True
    labels = ELBOW_SIDES

    @classmethod
    def conditions(cls, chain: Chain) -> Iterable[Condition]:
        """Four parallel axes, two links."""
        yield from (parallel(chain, i) for i in range(3))
        yield long_enough(chain, 0)
        yield not is_zero(abs(_second_link(chain))), tr("the second link must have a length.")

    def solve(self, S: FloatArray, free: FloatArray) -> FloatArray:  # noqa: ARG002 (nothing is free)
        """The yaw nearest to the wanted rotation, then the axis of the stroke, then the two links."""
        chain, E = self.chain, self.chain.T_n_tool
        turn = yaw_of(S, E[:3, :3])
        c, s = np.cos(turn), np.sin(turn)
        x = S[0, 3] - (c * E[0, 3] - s * E[1, 3])
        y = S[1, 3] - (s * E[0, 3] + c * E[1, 3])
        link = _second_link(chain)
        elbow = solve_elbow(x, y, float(chain.a[0]), abs(link))
        left = -math.copysign(1.0, chain.a[0])
        q = empty_rows(2, 4, S.shape[2])
        for branch, sign in zip(q, (left, -left), strict=True):
            branch[0] = elbow.direction - sign * elbow.lean
            branch[1] = sign * elbow.bend - math.atan2(link.imag, link.real)
            branch[2] = S[2, 3] - E[2, 3] - chain.d.sum()
            branch[3] = turn - branch[0] - branch[1] - chain.theta[2]
        erase(q, elbow.missing)
        return q


def yaw_of(S: FloatArray, zero: FloatArray) -> FloatArray:
    """The angle (m,) about z that brings the rotation `zero` (3, 3) nearest to the rotations of S (3, 4, m)."""
    M = np.einsum("ijm,kj->ikm", S[:2, :3], zero[:2])
    return np.asarray(np.arctan2(M[1, 0] - M[0, 1], M[0, 0] + M[1, 1]))


def _second_link(chain: Chain) -> complex:
    """From axis 2 to axis 4, in the frame of joint 2; the stroke's fixed angle turns its second part."""
    return complex(chain.a[1]) + complex(chain.a[2]) * complex(math.cos(chain.theta[2]), math.sin(chain.theta[2]))


class Cylindrical(ClosedForm):
    """Turn, lift, extend."""

    title = tr_later("cylindrical RPP arm")
    joints = "RPP"
    task = "position"
    place_only = True

    @classmethod
    def conditions(cls, chain: Chain) -> Iterable[Condition]:
        """The lift along axis 1, the extension square to it."""
        yield parallel(chain, 0)
        yield right_angle(chain, 1)

    def __init__(self, chain: Chain) -> None:
        super().__init__(chain)
        self.origin = chain.place((0.0, 0.0, 0.0))
        self.outward = chain.place((0.0, 0.0, 1.0)) - self.origin
        self.labels = tuple(", ".join(words) for words in zip(FACING, EXTENSION, strict=True))

    def solve(self, S: FloatArray, free: FloatArray) -> FloatArray:
        """What stands across the extension is the plane's offset; the rest is a waist."""
        x, y, z = S[:, 3]
        ox, oy = self.outward[:2]
        offset = self.origin[0] * oy - self.origin[1] * ox
        azimuth = math.atan2(oy, ox)
        offset = 0.0 if is_zero(offset) else float(offset)
        waist = solve_waist(x, y, offset, self.chain.size, float(free[0]) + azimuth)
        q = empty_rows(2, 3, x.size)
        for branch, side in zip(q, waist.sides, strict=True):
            branch[0] = side.theta1 - azimuth
            branch[1] = z - self.origin[2]
            branch[2] = side.out - (self.origin[0] * ox + self.origin[1] * oy)
        erase(q, waist.missing)
        return q


class Cartesian(ClosedForm):
    """Three strokes."""

    title = tr_later("Cartesian PPP arm")
    joints = "PPP"
    task = "position"
    place_only = True
    labels = (ONLY,)

    @classmethod
    def conditions(cls, chain: Chain) -> Iterable[Condition]:
        """Strokes that span space."""
        yield abs(np.linalg.det(_strokes(chain))) > 1e-6, tr("the three strokes must not lie in one plane.")

    def __init__(self, chain: Chain) -> None:
        super().__init__(chain)
        self.origin = chain.place((0.0, 0.0, 0.0))
        self.inverse = np.linalg.inv(_strokes(chain))

    def solve(self, S: FloatArray, free: FloatArray) -> FloatArray:  # noqa: ARG002 (nothing is free)
        """One linear system."""
        return np.asarray(self.inverse @ (S[:, 3] - self.origin[:, None]))[None]


def _strokes(chain: Chain) -> FloatArray:
    """The directions of the three strokes in frame 0, as columns."""
    unit = np.eye(3)
    return np.stack([chain.place(list(row)) - chain.place((0.0, 0.0, 0.0)) for row in unit], axis=1)
