"""Whole turns: an angle and the same angle 2πk further on are one pose of the tool, but not one place within limits."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.kinematics.dh import joint_array
from rvsim.kinematics.inverse.chain import TURN
from rvsim.robot import Robot
from rvsim.spatial.arrays import FloatArray

LIMIT_TOLERANCE = 1e-9  # [rad, m] a limit is reached, not broken, up to here


class LimitCopies(NamedTuple):
    """`q` (..., n) shifted by whole turns, and whether all its joints are `within` the limits (...); NaN is not."""

    q: FloatArray
    within: np.ndarray[Any, np.dtype[np.bool_]]


def limit_copies(robot: Robot, q: ArrayLike, near: ArrayLike | None = None) -> LimitCopies:
    """Each angle of q (..., n) shifted by whole turns into its limits, where a copy is within them.

    Of several such copies the one nearest to `near` (..., n), by default the home pose. Where no copy is within the
    limits, the one that breaks them least. NaN stays NaN.
    """
    values = joint_array(robot, q)
    wanted = robot.home if near is None else joint_array(robot, near)
    lower, upper = robot.limits[:, 0] - LIMIT_TOLERANCE, robot.limits[:, 1] + LIMIT_TOLERANCE
    first = np.ceil((lower - values) / TURN)
    last = np.floor((upper - values) / TURN)
    # With no copy inside, `last` lies just below the lower limit and `first` just above the upper one.
    below, above = lower - (values + TURN * last), values + TURN * first - upper
    outside = np.where(below < above, last, first)
    turns = np.where(first <= last, np.clip(np.rint((wanted - values) / TURN), first, last), outside)
    copies = np.where(robot.is_revolute, values + TURN * turns, values)
    return LimitCopies(copies, np.all((copies >= lower) & (copies <= upper), axis=-1))


def limit_margins(robot: Robot, q: FloatArray) -> FloatArray:
    """How far each joint of q (..., n) is from its nearer limit [rad, m]; negative outside, inf where there is none."""
    return np.minimum(q - robot.limits[:, 0], robot.limits[:, 1] - q)
