"""Two links in a plane that must reach a point: the step every arm with an elbow shares."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from rvsim.spatial.arrays import FloatArray

Mask = np.ndarray[Any, np.dtype[np.bool_]]
COSINE_TOLERANCE = 1e-9  # a cosine so little above 1 is rounding: the elbow is straight


class Elbow(NamedTuple):
    """The two solutions θ2 = direction ∓ lean, θ3 = ± bend, and where there is none."""

    direction: FloatArray
    lean: FloatArray
    bend: FloatArray
    missing: Mask


def solve_elbow(u: FloatArray, w: FloatArray, a2: float, a3: float) -> Elbow:
    """Links a2, a3 (any sign, not 0) from the origin to (u, w), each (m,) [m].

    The law of cosines in its half-angle form, tan²(θ3/2) = (1 − cos θ3)/(1 + cos θ3): it keeps its digits where
    the elbow is straight and where it is folded. Spong, Hutchinson, Vidyasagar (2006), §3.3.
    """
    square = u * u + w * w
    half = 0.5 / (a2 * a3)
    one_minus = ((a2 + a3) ** 2 - square) * half
    one_plus = (square - (a2 - a3) ** 2) * half
    missing = (one_minus < -COSINE_TOLERANCE) | (one_plus < -folded_tolerance(a2, a3))
    np.maximum(one_minus, 0.0, out=one_minus)
    np.maximum(one_plus, 0.0, out=one_plus)
    bend = 2.0 * np.arctan2(np.sqrt(one_minus), np.sqrt(one_plus))
    lean = np.arctan2(a3 * np.sqrt(one_minus * one_plus), (square + (a2 * a2 - a3 * a3)) * (0.5 / a2))
    return Elbow(np.arctan2(w, u), lean, bend, missing)


def folded_tolerance(a2: float, a3: float) -> float:
    """How far 1 + cos θ3 may be below 0: the wrist, close to the shoulder, moves much with the cosine."""
    return COSINE_TOLERANCE * abs(abs(a2) - abs(a3)) / (abs(a2) + abs(a3))


def elbow_up(a2: float, a3: float) -> float:
    """The sign of θ3 that lifts the elbow above the line from the shoulder to a wrist on the positive side (u > 0).

    A bend to the negative side does, unless one link has a negative a; on the other side the signs change places.
    """
    return -math.copysign(1.0, a2 * a3)


def links_reach(distance: float, a2: float, a3: float, last: float) -> bool:
    """Whether two links and a third that may point anywhere in the plane reach a point at some distance."""
    longest, rest = max(abs(a2), abs(a3), abs(last)), abs(a2) + abs(a3) + abs(last)
    slack = COSINE_TOLERANCE * rest
    return max(0.0, 2.0 * longest - rest) - slack <= distance <= rest + slack


def empty_rows(*shape: int) -> FloatArray:
    """An array (..., m) for values yet to come, whose rows do not fall on the same lines of the cache.

    Rows a multiple of 4096 bytes apart would: reading one entry of each costs three times as much.
    """
    return np.empty((*shape[:-1], shape[-1] + (0 if shape[-1] % 512 else 8)))[..., : shape[-1]]


def erase(branches: FloatArray, missing: Mask) -> None:
    """NaN in every joint (..., m) of the poses (m,) that have no solution."""
    if missing.any():
        branches[..., missing] = np.nan
