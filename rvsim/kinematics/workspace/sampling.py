"""Poses spread evenly over what the joints can do, with more of them where the edges of a workspace come from.

Evenly: the Kronecker sequence of the generalised golden ratio (Roberts, 2018), whose points keep apart in any number
of dimensions. An edge is reached with joints at their stops or links in line, which hardly any even sample has.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rvsim.robot import Robot
from rvsim.spatial.arrays import FloatArray

_TURN = 2.0 * math.pi
_AT_EDGE = 0.25  # how often a joint takes one of its edge values
_ALIKE = 1e-9


def joint_ranges(robot: Robot, *, ignore_limits: bool = False) -> FloatArray:
    """(n, 2) what each joint goes through [rad, m]: its limits, or one turn where it has none, has more or they are
    ignored. A slide keeps its ends; one without ends goes as far as the arm is long.
    """
    spans = np.where(robot.is_revolute, np.pi, robot.size)[:, None] * (-1.0, 1.0)
    ranges = np.where(np.isfinite(robot.limits), robot.limits, spans)
    whole = robot.is_revolute & (ignore_limits | (ranges[:, 1] - ranges[:, 0] >= _TURN - _ALIKE))
    return np.where(whole[:, None], (-np.pi, np.pi), ranges)


def edge_values(robot: Robot, ranges: FloatArray) -> tuple[FloatArray, ...]:
    """For each joint the values from which edges come: its stops, and quarter turns of its DH angle between them."""
    return tuple(_edges(robot, ranges, joint) for joint in range(robot.dof))


def _edges(robot: Robot, ranges: FloatArray, joint: int) -> FloatArray:
    lower, upper = ranges[joint].tolist()
    if not robot.joints[joint].revolute:
        return np.array([lower, upper])
    quarter = 0.5 * math.pi
    theta = float(robot.dh[joint, 0])
    first, last = math.ceil((lower + theta) / quarter - _ALIKE), math.floor((upper + theta) / quarter + _ALIKE)
    numbers = np.arange(first, last + 1)
    return np.unique(np.round(np.concatenate([[lower, upper], numbers * quarter - theta]), 12))


@dataclass(frozen=True, eq=False)
class PoseSampler:
    """Poses of an arm, the same for the same seed."""

    robot: Robot
    ranges: FloatArray
    seed: int = 0

    def block(self, start: int, count: int) -> FloatArray:
        """The poses (count, n) with the numbers from `start` on."""
        generator = np.random.default_rng((self.seed, start))
        dof = self.robot.dof
        shift = np.random.default_rng(self.seed).random(dof)
        numbers = np.arange(start + 1, start + count + 1, dtype=np.float64)[:, None]
        shares = (shift + numbers * _steps(dof)) % 1.0
        q = self.ranges[:, 0] + shares * (self.ranges[:, 1] - self.ranges[:, 0])
        for joint, values in enumerate(edge_values(self.robot, self.ranges)):
            rows = np.flatnonzero(generator.random(count) < _AT_EDGE)
            q[rows, joint] = values[generator.integers(0, len(values), len(rows))]
        return np.asarray(q)


def _steps(dimensions: int) -> FloatArray:
    """(d,) powers of 1/φ, φ the positive root of x^(d+1) = x + 1."""
    root = 2.0
    for _ in range(60):
        root = (1.0 + root) ** (1.0 / (dimensions + 1))
    return np.asarray(root ** -np.arange(1.0, dimensions + 1.0))
