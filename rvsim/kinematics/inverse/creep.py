"""Towards a pose that cannot be had, from where the arm is: downhill within the limits, never by a jump.

Newton's method on the error itself, the place counting far more than the angle. Beyond its reach the arm is stretched
out and its Jacobian singular: there the curvature of the error, which a Gauss-Newton step leaves out, decides how far
to turn. It is known exactly: ∂²p/∂qᵢ∂qⱼ = zᵢ × Jⱼ for i ≤ j (Siciliano et al., Robotics (2009), §3.1: a column of J
is a vector of the link that the joints before it turn).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from rvsim.kinematics.jacobian import pose_and_jacobian
from rvsim.robot import Robot
from rvsim.spatial.arrays import FloatArray

_PLACE_WEIGHT = 300.0  # the place over the angle: an error of a size counts like so many radians
_LONGEST = 0.12  # [rad, sizes] of a joint in one step
_LEAST_CURVATURE = 1e-6  # of the greatest: flatter directions are not followed further than that
_SETTLED, _STILL = 1e-6, 1e-4  # [rad, sizes] a step so short does not count, nor all steps together
_SPAN = 0.25  # [rad, sizes] the furthest that a joint goes at a time
_WORTH = 1e-9  # a step that takes a smaller share of the cost away does not count
_SHORTER, _TRIES = 0.3, 5


class Crept(NamedTuple):
    """Where the arm has come: q (n,), and whether it can come no nearer from there."""

    q: FloatArray
    settled: bool


class _Goal(NamedTuple):
    """A wanted pose T (4, 4), whether its orientation counts, and the bounds (n,) of the joints in between."""

    robot: Robot
    T: FloatArray
    place_only: bool
    lower: FloatArray
    upper: FloatArray


class _Place(NamedTuple):
    """A pose on the way: joints (n,), errors (3,) [sizes] and [rad], Jacobian (6, n) in sizes, and the cost."""

    q: FloatArray
    away: FloatArray
    turn: FloatArray
    J: FloatArray
    cost: float


def creep(robot: Robot, q: FloatArray, T: FloatArray, bounds: FloatArray, *, place_only: bool, steps: int) -> Crept:
    """From q (n,) nearer to T (4, 4) within bounds (n, 2): least position error first, then least angle.

    Local, by at most so many `steps` and a quarter of a radian, so that the eye can follow: the arm stays on its
    branch, and may be asked again. Where it settles is the best among the poses nearby; `nearest_configuration` looks
    everywhere, and takes a hundred times as long.
    """
    begin = np.clip(q, bounds[:, 0], bounds[:, 1])
    span = _SPAN * np.where(robot.is_revolute, 1.0, robot.size)
    around = np.maximum(bounds[:, 0], begin - span), np.minimum(bounds[:, 1], begin + span)
    end, settled = _descended(_Goal(robot, T, place_only, *around), begin, steps)
    way = float(np.abs((end - begin) / span).max()) * _SPAN
    return Crept(end, (settled and way < 0.99 * _SPAN) or way < _STILL)


def _descended(goal: _Goal, begin: FloatArray, steps: int) -> Crept:
    """As far down as so many steps lead."""
    here = _evaluate(goal, begin)
    for _ in range(steps):
        there = _nearer(goal, here, _step(goal, here))
        if there is None:
            return Crept(here.q, True)
        way, gain = float(np.abs(there.q - here.q).max()), here.cost - there.cost
        here = there
        if way < _SETTLED or gain < _WORTH * here.cost:
            return Crept(here.q, True)
    return Crept(here.q, False)


def _evaluate(goal: _Goal, q: FloatArray) -> _Place:
    T, J = pose_and_jacobian(goal.robot, q)
    J[:3] /= goal.robot.size
    away = (goal.T[:3, 3] - T[:3, 3]) / goal.robot.size
    turn = np.zeros(3) if goal.place_only else _rotation_vector(goal.T[:3, :3] @ T[:3, :3].T)
    return _Place(q, away, turn, J, float(_PLACE_WEIGHT**2 * (away @ away) + turn @ turn))


def _rotation_vector(R: FloatArray) -> FloatArray:
    """(3,) [rad] of one rotation; half a turn has no direction in which it gets less, and gives 0."""
    (_, a, b), (c, _, d), (e, f, _) = R.tolist()
    twice = np.array([f - d, b - e, c - a])
    sine = 0.5 * math.sqrt(float(twice @ twice))
    angle = math.atan2(sine, 0.5 * (float(np.trace(R)) - 1.0))
    return twice * (0.5 * angle / sine) if sine > 1e-9 else np.zeros(3)


def _step(goal: _Goal, here: _Place) -> FloatArray:
    """The joint step (n,) towards the minimum of the parabola through here, within the bounds and not too long."""
    gradient, curvature = _slope(here)
    low, high = goal.lower - here.q, goal.upper - here.q
    step = np.zeros(len(here.q))
    free = ~(((low >= 0.0) & (gradient > 0.0)) | ((high <= 0.0) & (gradient < 0.0)))
    while free.any():
        pull = gradient + curvature[:, ~free] @ step[~free]
        step[free] = -np.linalg.solve(curvature[np.ix_(free, free)], pull[free])
        step = _shortened(goal.robot, step)
        outside = free & ((step < low) | (step > high))
        if not outside.any():
            break
        step = np.clip(step, low, high)
        free &= ~outside
    # Joints put onto their stops can leave the others a way uphill.
    return step if gradient @ step < 0.0 else np.clip(_shortened(goal.robot, -gradient), low, high)


def _shortened(robot: Robot, step: FloatArray) -> FloatArray:
    longest = float(np.abs(step / np.where(robot.is_revolute, 1.0, robot.size)).max())
    return np.asarray(step * min(1.0, _LONGEST / max(longest, 1e-300)))


def _slope(here: _Place) -> tuple[FloatArray, FloatArray]:
    """Gradient (n,) and curvature (n, n) of half the cost, the latter made positive: saddles are left downhill."""
    linear, angular = here.J[:3], here.J[3:]
    x, y, z = here.away.tolist()
    bent = np.triu((np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]) @ angular).T @ linear)
    bent += np.triu(bent, 1).T
    weight = _PLACE_WEIGHT**2
    values, vectors = np.linalg.eigh(weight * (linear.T @ linear - bent) + angular.T @ angular * bool(here.turn.any()))
    values = np.abs(values)
    positive = (vectors * np.maximum(values, _LEAST_CURVATURE * float(values.max()) + 1e-300)) @ vectors.T
    return -(weight * here.away @ linear + here.turn @ angular), positive


def _nearer(goal: _Goal, here: _Place, step: FloatArray) -> _Place | None:
    """The first of ever shorter steps that leads downhill; None if none does."""
    for _ in range(_TRIES):
        there = _evaluate(goal, np.clip(here.q + step, goal.lower, goal.upper))
        if there.cost < here.cost:
            return there
        step = _SHORTER * step
    return None
