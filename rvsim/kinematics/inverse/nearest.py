"""The best an arm can do when a target cannot be had: least position error first, then least angle.

A damped Gauss-Newton search (Levenberg 1944; Marquardt 1963) from many fixed starts at once, inside the limits if
they count. The damping grows with the remaining error, which keeps the arm converging where it is stretched out
towards a place beyond its reach, and its Jacobian is singular. What it finds is checked by forward kinematics.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rvsim.kinematics.forward import forward_kinematics
from rvsim.kinematics.inverse.chain import TURN
from rvsim.kinematics.inverse.copies import limit_copies
from rvsim.kinematics.inverse.result import Nearest
from rvsim.kinematics.jacobian import pose_and_jacobian
from rvsim.robot import Robot
from rvsim.spatial import rotation_error
from rvsim.spatial.arrays import FloatArray

_STARTS, _FEW_STARTS = 48, 16
_PLACE_STEPS, _POSE_STEPS, _FINAL_STEPS = 60, 120, 20
_PLACE_WEIGHT = 1e3  # the place over the angle, while both are improved together
_DONE, _WORTH, _IDLE = 1e-13, 1e-7, 4  # over when for so many steps no start has gained that share of its error
_IN_REACH = 1e-6  # of the size: a place approached so closely is in reach
_REGULAR = 1e-13  # of the trace of JᵀJ: the least damping
_SAME_PLACE = 1e-7  # of the size: position errors closer than this count as equal


class _Search(NamedTuple):
    """One search: the arm, the goal (4, 4), the bounds (n, 2), and the weights of its six errors."""

    robot: Robot
    goal: FloatArray
    bounds: FloatArray
    weights: FloatArray


def nearest_configuration(
    robot: Robot, goal: FloatArray, near: FloatArray, bounds: FloatArray, starts: FloatArray, *, place_only: bool
) -> Nearest:
    """The joints within `bounds` (n, 2) whose tool is nearest to the goal (4, 4); of equal places nearest to `near`.

    `starts` (k, n) are tried beside fixed ones.
    """
    place = _Search(robot, goal, bounds, np.repeat([1.0 / robot.size, 0.0], 3))
    q = _descend(place, _starts(robot, near, bounds, starts), _PLACE_STEPS)
    if not place_only:
        q = _turn_towards(place, q)
    return _choose(robot, goal, near, q, place_only=place_only)


def place_in_reach(robot: Robot, goal: FloatArray, near: FloatArray) -> bool:
    """Whether the tool can be at the goal's place in some orientation, limits aside, as far as a search can tell."""
    anywhere = np.tile([-np.inf, np.inf], (robot.dof, 1))
    place = _Search(robot, goal, anywhere, np.repeat([1.0 / robot.size, 0.0], 3))
    q = _descend(place, _starts(robot, near, anywhere, near[None])[:_FEW_STARTS], _PLACE_STEPS)
    miss = np.linalg.norm(_places(robot, q) - goal[:3, 3], axis=1)
    return bool(miss.min() <= _IN_REACH * robot.size)


def _turn_towards(place: _Search, q: FloatArray) -> FloatArray:
    """From the nearest places: the least angle there, each start keeping to the best place found."""
    miss = np.linalg.norm(_places(place.robot, q) - place.goal[:3, 3], axis=1)
    goal = place.goal.copy()
    goal[:3, 3] = _places(place.robot, q[[np.argmin(miss)]])[0]
    weights = np.repeat([_PLACE_WEIGHT / place.robot.size, 1.0], 3)
    turned = _descend(place._replace(goal=goal, weights=weights), q.copy(), _POSE_STEPS)
    return np.concatenate([q, _descend(place._replace(goal=goal), turned, _FINAL_STEPS)])


def _starts(robot: Robot, near: FloatArray, bounds: FloatArray, given: FloatArray) -> FloatArray:
    """(k, n) where the arm is, its home, and fixed poses all over its range."""
    lower = np.where(
        np.isfinite(bounds[:, 0]), bounds[:, 0], near - np.where(robot.is_revolute, 0.5 * TURN, robot.size)
    )
    upper = np.where(
        np.isfinite(bounds[:, 1]), bounds[:, 1], near + np.where(robot.is_revolute, 0.5 * TURN, robot.size)
    )
    spread = np.random.default_rng(0).uniform(lower, upper, (_STARTS, robot.dof))
    return np.clip(np.vstack([near, robot.home, given, spread]), bounds[:, 0], bounds[:, 1])


def _places(robot: Robot, q: FloatArray) -> FloatArray:
    return np.asarray(forward_kinematics(robot, q)[:, :3, 3])


def _evaluate(search: _Search, q: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Weighted errors (k, 6), what is still to be moved and turned, and weighted Jacobians (k, 6, n)."""
    T, J = pose_and_jacobian(search.robot, q)
    errors = np.zeros((len(q), 6))
    errors[:, :3] = search.goal[:3, 3] - T[:, :3, 3]
    if search.weights[3]:
        errors[:, 3:] = rotation_error(T[:, :3, :3], search.goal[:3, :3])
    return errors * search.weights, J * search.weights[:, None]


def _descend(search: _Search, q: FloatArray, steps: int) -> FloatArray:
    """Each row of q (k, n) improved; a step that does not improve is taken back and damped more."""
    errors, J = _evaluate(search, q)
    cost, damping, idle = np.linalg.norm(errors, axis=1), np.full(len(q), 0.5), 0
    for _ in range(steps):
        moved = np.clip(q + _step(search, q, errors, J, damping), search.bounds[:, 0], search.bounds[:, 1])
        new_errors, new_J = _evaluate(search, moved)
        new_cost = np.linalg.norm(new_errors, axis=1)
        better = new_cost < cost
        worth = (new_cost < (1.0 - _WORTH) * cost) & (cost > _DONE)
        q[better], errors[better], J[better], cost[better] = (
            moved[better],
            new_errors[better],
            new_J[better],
            new_cost[better],
        )
        damping = np.clip(damping * np.where(better, 0.4, 4.0), 1e-6, 1e6)
        idle = 0 if worth.any() else idle + 1
        if idle == _IDLE:
            break
    return q


def _step(search: _Search, q: FloatArray, errors: FloatArray, J: FloatArray, damping: FloatArray) -> FloatArray:
    """Joint steps (k, n); a joint at its bound that would be pushed through it stays where it is."""
    gradient = np.einsum("kij,ki->kj", J, errors)
    stuck = ((q <= search.bounds[:, 0]) & (gradient < 0.0)) | ((q >= search.bounds[:, 1]) & (gradient > 0.0))
    free = np.where(stuck[:, None, :], 0.0, J)
    normal = free.transpose(0, 2, 1) @ free
    # Where two axes lie in one line, rounding must not swallow what keeps the system regular.
    least = 1e-14 + _REGULAR * np.trace(normal, axis1=1, axis2=2)
    scale = damping * np.linalg.norm(errors, axis=1) + least
    normal += scale[:, None, None] * np.eye(q.shape[1])
    return np.asarray(np.linalg.solve(normal, np.where(stuck, 0.0, gradient)[..., None])[..., 0])


def _choose(robot: Robot, goal: FloatArray, near: FloatArray, q: FloatArray, *, place_only: bool) -> Nearest:
    T = forward_kinematics(robot, q)
    miss = np.linalg.norm(T[:, :3, 3] - goal[:3, 3], axis=1)
    angle = np.linalg.norm(rotation_error(T[:, :3, :3], goal[:3, :3]), axis=1)
    second = np.abs(q - near).max(axis=1) if place_only else angle
    allowed = miss <= miss.min() + _SAME_PLACE * robot.size
    best = int(np.argmin(np.where(allowed, second, np.inf)))
    return Nearest(limit_copies(robot, q[best], near).q, T[best], float(miss[best]), float(angle[best]))
