"""Joint 1 of an arm whose remaining plane stands at an offset D beside the base axis: two sides."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from rvsim.kinematics.inverse.elbow import COSINE_TOLERANCE, Mask
from rvsim.spatial.arrays import FloatArray

_ON_AXIS = 1e-10  # of the size: here joint 1 is free


class Side(NamedTuple):
    """One side: θ1, its cosine and sine, and how far out the point lies in the plane (negative: behind)."""

    theta1: FloatArray
    c: FloatArray
    s: FloatArray
    out: FloatArray


class Waist(NamedTuple):
    """Both sides, where the point is nearer to the axis than the plane's offset, and both sides as an array.

    `both` (4, 2, m) holds the entries of a `Side`, of each side.
    """

    sides: tuple[Side, Side]
    missing: Mask
    both: FloatArray


def solve_waist(x: FloatArray, y: FloatArray, offset: float, size: float, free: float) -> Waist:
    """Points (x, y), each (m,), in the plane with normal (sin θ1, −cos θ1) at the distance `offset`.

    x + iy = exp(iθ1) (out − i·offset). A point on the base axis leaves θ1 free: it takes the value `free`.
    """
    square = x * x + y * y
    inside = square - offset * offset
    out = np.sqrt(np.maximum(inside, 0.0))
    azimuth = np.arctan2(y, x)
    turn = np.arctan2(offset, out) if offset else np.zeros(1)
    scale = 1.0 / square
    x_out, y_out, x_side, y_side = x * out * scale, y * out * scale, x * offset * scale, y * offset * scale
    both = np.empty((4, 2, x.size))
    front, back = Side(*both[:, 0]), Side(*both[:, 1])
    np.add(azimuth, turn, out=front.theta1)
    np.add(azimuth, math.pi - turn, out=back.theta1)
    np.subtract(x_out, y_side, out=front.c)
    np.subtract(-x_out, y_side, out=back.c)
    np.add(y_out, x_side, out=front.s)
    np.subtract(x_side, y_out, out=back.s)
    front.out[:] = out
    np.negative(out, out=back.out)
    if not offset:
        _set_free(front, back, square <= (_ON_AXIS * size) ** 2, free)
    return Waist((front, back), inside < -2.0 * COSINE_TOLERANCE * offset * offset, both)


def _set_free(front: Side, back: Side, on_axis: Mask, free: float) -> None:
    if on_axis.any():
        front.theta1[on_axis], back.theta1[on_axis] = free, free + math.pi
        front.c[on_axis], front.s[on_axis] = math.cos(free), math.sin(free)
        back.c[on_axis], back.s[on_axis] = -math.cos(free), -math.sin(free)
