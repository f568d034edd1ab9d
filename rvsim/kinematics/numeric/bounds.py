"""Joint limits as the iterations see them: a stop is a wall, unless the joint can come from the other side."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from rvsim.robot import Robot
from rvsim.spatial.arrays import FloatArray

TURN = 2.0 * math.pi
Mask = np.ndarray[Any, np.dtype[np.bool_]]


class Bounds(NamedTuple):
    """`lower`, `upper` [rad, m], ±inf where nothing stops the joint, and which joints have a `full_turn` of room.

    Such a joint never gets stuck at a stop: a turn further back it is the same pose with room ahead.
    """

    lower: FloatArray
    upper: FloatArray
    full_turn: Mask

    def folded(self, q: FloatArray) -> FloatArray:
        """q with joints that left their full turn of room brought back by 2π; the pose is the same."""
        outside = np.where(q > self.upper, 1.0, 0.0) - np.where(q < self.lower, 1.0, 0.0)
        return np.asarray(q - TURN * (outside * self.full_turn))

    def clamped(self, q: FloatArray) -> FloatArray:
        """q with joints beyond a stop put onto it."""
        return np.clip(q, self.lower, self.upper)

    def held(self, q: FloatArray, gradient: FloatArray) -> Mask:
        """Which joints stand at a stop and would have to go further for the cost with this gradient to fall."""
        pushed = ((q <= self.lower) & (gradient > 0.0)) | ((q >= self.upper) & (gradient < 0.0))
        return np.asarray(pushed & ~self.full_turn)

    @property
    def as_rows(self) -> Bounds:
        """The same for arrays (n, m) that hold a joint in each row."""
        return Bounds(self.lower[:, None], self.upper[:, None], self.full_turn[:, None])


def bounds_of(robot: Robot, enforced: bool) -> Bounds:
    """The arm's limits, or none."""
    limits = robot.limits if enforced else np.broadcast_to([-math.inf, math.inf], (robot.dof, 2))
    room = limits[:, 1] - limits[:, 0]
    return Bounds(limits[:, 0], limits[:, 1], np.asarray(robot.is_revolute & (room >= TURN * (1.0 - 1e-12))))


def start_ranges(robot: Robot, bounds: Bounds) -> FloatArray:
    """(n, 2) from where to draw starts: the limits, of an angle at most one turn, of a length at most ± the arm's size.

    A joint with one stop only has its range from there.
    """
    widest = np.where(robot.is_revolute, math.pi, robot.size)
    below = np.where(np.isfinite(bounds.upper), bounds.upper - 2.0 * widest, -widest)
    lower = np.where(np.isfinite(bounds.lower), bounds.lower, below)
    upper = np.where(np.isfinite(bounds.upper), bounds.upper, lower + 2.0 * widest)
    middle, half = 0.5 * (lower + upper), np.minimum(0.5 * (upper - lower), widest)
    return np.stack([np.maximum(middle - half, lower), np.minimum(middle + half, upper)], axis=-1)
