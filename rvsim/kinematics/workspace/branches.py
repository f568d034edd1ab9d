"""In how many ways the arm can do it: the closed form asked of many poses, or of many places with the tool held."""

from __future__ import annotations

import math

import numpy as np

from rvsim.errors import NoClosedFormError
from rvsim.kinematics.forward import forward_kinematics
from rvsim.kinematics.inverse.batch import inverse_kinematics_batch
from rvsim.kinematics.inverse.copies import LIMIT_TOLERANCE
from rvsim.kinematics.inverse.families import closed_form
from rvsim.kinematics.inverse.five_axis import FiveAxis
from rvsim.kinematics.inverse.projection import has_tip_on_roll_axis, turned_about_vertical
from rvsim.kinematics.inverse.spherical_wrist import SphericalWrist
from rvsim.kinematics.inverse.textbook import Scara
from rvsim.kinematics.inverse.ur import ParallelAxes
from rvsim.kinematics.workspace.grid import BoolArray
from rvsim.kinematics.workspace.place import places_and_manipulability
from rvsim.language import tr
from rvsim.robot import Robot
from rvsim.spatial.arrays import FloatArray

_TURN = 2.0 * math.pi
_SINGULAR = 1e-5  # of the largest manipulability


def branch_counts(robot: Robot, q: FloatArray, *, ignore_limits: bool = False) -> FloatArray:
    """(m,) how many branches, within the limits, bring the tool where q (m, n) does; each pose is one itself.

    The task is the arm's own. At singular poses branches fall together: there only the pose itself is counted.

    Raises:
        NoClosedFormError: the arm has no closed form.
    """
    branches = inverse_kinematics_batch(robot, forward_kinematics(robot, q))
    exist = ~np.isnan(branches[..., 0]) if ignore_limits else within_limits(robot, branches)
    measure = places_and_manipulability(robot, q)[1]
    singular = measure <= _SINGULAR * measure.max(initial=0.0)
    return np.where(singular, 1.0, np.maximum(exist.sum(axis=1), 1.0))


def held_branches(robot: Robot, places: FloatArray, R: FloatArray) -> FloatArray:
    """q (m, branches, n) that bring the tool to places (m, 3) with its orientation R (3, 3), NaN where there is none.

    A 5R arm keeps the pitch and the roll of R and turns with the place.

    Raises:
        NoClosedFormError: the arm has no closed form, or cannot hold an orientation.
    """
    form = closed_form(robot)
    if not holds_orientation(robot):
        raise NoClosedFormError(robot.name, tr("it cannot hold an orientation all over an area."))
    T = np.zeros((len(places), 4, 4))
    T[:, :3, :3], T[:, :3, 3], T[:, 3, 3] = R, places, 1.0
    return inverse_kinematics_batch(robot, turned_about_vertical(form.chain, T) if isinstance(form, FiveAxis) else T)


def holds_orientation(robot: Robot) -> bool:
    """Whether the arm can keep the tool's orientation (a 5R arm: pitch and roll) all over a part of its workspace."""
    try:
        form = closed_form(robot)
    except NoClosedFormError:
        return False
    if isinstance(form, FiveAxis):
        return has_tip_on_roll_axis(form.chain)
    return isinstance(form, ParallelAxes | SphericalWrist | Scara)


def has_branches(robot: Robot) -> bool:
    """Whether the arm has a closed form, so that its branches can be counted."""
    try:
        closed_form(robot)
    except NoClosedFormError:
        return False
    return True


def within_limits(robot: Robot, q: FloatArray) -> BoolArray:
    """Which poses (..., n) have a copy, by whole turns, within the limits (...); NaN has none.

    It says what `limit_copies` says, for millions: the copies themselves are not made.
    """
    within = ~np.isnan(q[..., 0])
    for joint, (lower, upper) in enumerate(robot.limits.tolist()):
        beyond, span = q[..., joint] - (lower - LIMIT_TOLERANCE), upper - lower + 2.0 * LIMIT_TOLERANCE
        if not robot.is_revolute[joint]:
            within &= (beyond >= 0.0) & (q[..., joint] <= upper + LIMIT_TOLERANCE)
        elif span < _TURN:
            within &= beyond - _TURN * np.floor(beyond * (1.0 / _TURN)) <= span
    return within
