"""Cosine and sine at the price of one tangent: numpy's tangent is vectorised where its cosine and sine are not."""

from __future__ import annotations

import numpy as np

from rvsim.spatial.arrays import FloatArray


def cosine_and_sine(angle: FloatArray) -> tuple[FloatArray, FloatArray]:
    """cos and sin of angles of any shape, to a few units in the last place, at odd multiples of π too.

    t = tan(angle/2) is finite for every float; where its square is not, 2/(1 + t²) is 0 and the cosine −1.
    """
    t = np.tan(0.5 * angle)
    q = 2.0 / (1.0 + t * t)
    return q - 1.0, q * t
