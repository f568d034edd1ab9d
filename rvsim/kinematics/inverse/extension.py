"""A waist, a shoulder and a prismatic joint square to it: they bring a point to a place in four ways."""

from __future__ import annotations

import numpy as np

from rvsim.kinematics.inverse.chain import Chain
from rvsim.kinematics.inverse.closed_form import is_zero
from rvsim.kinematics.inverse.elbow import COSINE_TOLERANCE, empty_rows, erase
from rvsim.kinematics.inverse.waist import solve_waist
from rvsim.kinematics.inverse.words import EXTENSION, combine, side_names
from rvsim.spatial.arrays import FloatArray

AT_SHOULDER = 1e-10  # of the size: here joint 2 is free


def extension_labels(chain: Chain) -> tuple[str, ...]:
    """Two sides, and on each the prismatic joint ahead of the shoulder or behind it."""
    return combine(side_names(chain), EXTENSION)


def solve_extension(
    chain: Chain, place: FloatArray, across: float, offset: float, free: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """θ1, θ2 and the extension L, each (4, m), for places (3, m) in frame 0.

    In the plane at `offset` beside the base axis the point stands at across · x2 + L · z2 from the shoulder, with
    x2 = (cos θ2, sin θ2) and z2 = (sin θ2, −cos θ2): L² is what `across` leaves of the squared distance. A point on
    the base axis leaves θ1 free, a point at the shoulder θ2: they take their values in `free` (n,).
    """
    x, y, z = place
    waist = solve_waist(x, y, offset, chain.size, float(free[0]))
    theta1, theta2, extension = empty_rows(3, 4, x.size)
    for k, side in enumerate(waist.sides):
        u, w = side.out - chain.a[0], z - chain.d[0]
        square = u * u + w * w - across * across
        length = np.sqrt(np.maximum(square, 0.0))
        for branch, signed in zip(range(2 * k, 2 * k + 2), (length, -length), strict=True):
            theta1[branch], extension[branch] = side.theta1, signed
            theta2[branch] = np.arctan2(w, u) + np.arctan2(signed, across)
            if is_zero(across):
                theta2[branch, square <= (AT_SHOULDER * chain.size) ** 2] = free[1]
        erase(extension[2 * k : 2 * k + 2], waist.missing | (square < -2.0 * COSINE_TOLERANCE * across * across))
    return theta1, theta2, extension
