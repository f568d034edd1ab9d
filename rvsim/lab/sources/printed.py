"""Scalar formulas exactly as the sources print them; the worked solutions and the list of errata share them.

Angles are radians. A formula that has no value (a root of a negative number, a division by 0) gives NaN.
"""

from __future__ import annotations

import math
from typing import NamedTuple

_NOTHING = 1e-6  # a divisor smaller than this is 0


class Triangle(NamedTuple):
    """Source 000's α = z_W − d1 and β, how far out the wrist is, with the lengths of upper arm and forearm [m]."""

    alpha: float
    beta: float
    a2: float
    a3: float


def root(value: float) -> float:
    """√value, NaN for a negative one."""
    return math.sqrt(value) if value >= 0.0 else math.nan


def waist_000(x: float, y: float) -> float:
    """(10): atan2(x_G, −y_G). By (9) the source's y_G is −y, as its waist turns clockwise."""
    return math.atan2(x, y)


def gamma_000(triangle: Triangle) -> float:
    """γ of (14): (a2² − a3² − α² − β²) / 2a2."""
    alpha, beta, a2, a3 = triangle
    return (a2 * a2 - a3 * a3 - alpha * alpha - beta * beta) / (2.0 * a2)


def gamma(triangle: Triangle) -> float:
    """γ as it must be: (a2² − a3² + α² + β²) / 2a2."""
    alpha, beta, a2, a3 = triangle
    return (a2 * a2 - a3 * a3 + alpha * alpha + beta * beta) / (2.0 * a2)


def shoulder_000(triangle: Triangle, q2: float, gamma: float) -> float:
    """(14): atan2(γ, ±√(r² − γ²)) − atan2(α, β) with this γ; the sign is that of q2 in the corrected (14)."""
    alpha, beta, *_ = triangle
    side = root(alpha * alpha + beta * beta - gamma * gamma)
    if math.isnan(side):
        return math.nan
    return math.atan2(gamma, _sign(triangle, q2) * side) - math.atan2(alpha, beta)


def _sign(triangle: Triangle, q2: float) -> float:
    """Which sign of the root gives q2 in the corrected (14)."""
    alpha, beta, *_ = triangle
    right = gamma(triangle)
    side, turn = math.sqrt(max(alpha * alpha + beta * beta - right * right, 0.0)), math.atan2(beta, alpha)

    def error(sign: float) -> float:
        return abs(math.remainder(math.atan2(right, sign * side) - turn - q2, math.tau))

    return min((1.0, -1.0), key=error)


def elbow_000(triangle: Triangle, q2: float) -> float:
    """(15): atan2(β − a2 c2, α − a2 s2) − θ2."""
    alpha, beta, a2, _ = triangle
    return math.atan2(beta - a2 * math.cos(q2), alpha - a2 * math.sin(q2)) - q2


def waist_003(x: float, y: float) -> float:
    """θ1 = tan⁻¹(Py / Px)."""
    return math.atan(y / x) if abs(x) > _NOTHING else math.nan


class Hand(NamedTuple):
    """The parts of n and o that source 003's θ3 asks for."""

    nx: float
    ny: float
    ox: float
    oy: float


def roll_003(q1: float, hand: Hand) -> float:
    """θ3 of the program: cosd and sind take degrees, but θ1 is in radians."""
    c, s = (f(math.radians(q1)) for f in (math.cos, math.sin))
    return math.atan2(s * hand.nx - c * hand.ny, s * hand.ox - c * hand.oy)


def extension_003(height: float, q2: float, l5: float, l7: float) -> float:
    """l6 = (w − l5 S2) / C2 − l7, w the height above the joint."""
    cosine = math.cos(q2)
    return (height - l5 * math.sin(q2)) / cosine - l7 if abs(cosine) > _NOTHING else math.nan


def beta_004(square: float, a3: float, a4: float) -> float:
    """β of (3.22): atan2(s² + a3² − a4², 2 a3 s), from s²."""
    return math.atan2(square + a3 * a3 - a4 * a4, 2.0 * a3 * math.sqrt(square))


def elbow_004(square: float, a3: float, a4: float) -> float:
    """θ3 of (3.23): atan2(s² − a3² − a4², 2 a3 a4), from s²."""
    return math.atan2(square - a3 * a3 - a4 * a4, 2.0 * a3 * a4)


def wrist_height_004(z: float, d1: float, d5: float, psi: float) -> float:
    """(3.26) with d5 brought to the other side: z − d1 − d5 cos ψ."""
    return z - d1 - d5 * math.cos(psi)
