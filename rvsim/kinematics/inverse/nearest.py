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
from rvsim.kinematics.jacobian import jacobian
from rvsim.robot import Robot
from rvsim.spatial import rotation_error
from rvsim.spatial.arrays import FloatArray

_STARTS = 48
_PLACE_STEPS, _POSE_STEPS, _FINAL_STEPS = 60, 120, 20
_PLACE_WEIGHT = 1e3  # the place over the angle, while both are improved together
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


def _turn_towards(place: _Search, q: FloatArray) -> FloatArray:
    """From the nearest places: the least angle there, each start keeping to the best place found."""
    miss = np.linalg.norm(_places(place.robot, q) - place.goal[:3, 3], axis=1)
    goal = place.goal.copy()
    goal[:3, 3] = _places(place.robot, q[[np.argmin(miss)]])[0]
    weights = np.repeat([_PLACE_WEIGHT / place.robot.size, 1.0], 3)
    turned = _descend(place._replace(goal=goal, weights=weights), q, _POSE_STEPS)
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


def _errors(search: _Search, q: FloatArray) -> FloatArray:
    """(k, 6) weighted errors, what is still to be moved and turned."""
    T = forward_kinematics(search.robot, q)
    turn = rotation_error(T[:, :3, :3], search.goal[:3, :3]) if search.weights[3] else np.zeros((len(q), 3))
    return np.concatenate([search.goal[:3, 3] - T[:, :3, 3], turn], axis=1) * search.weights


def _descend(search: _Search, q: FloatArray, steps: int) -> FloatArray:
    """Each row of q (k, n) improved; a step that does not improve is taken back and damped more."""
    errors = _errors(search, q)
    cost = np.linalg.norm(errors, axis=1)
    damping = np.full(len(q), 0.5)
    for _ in range(steps):
        moved = np.clip(q + _step(search, q, errors, damping), search.bounds[:, 0], search.bounds[:, 1])
        new_errors = _errors(search, moved)
        new_cost = np.linalg.norm(new_errors, axis=1)
        better = new_cost < cost
        q, errors = np.where(better[:, None], moved, q), np.where(better[:, None], new_errors, errors)
        cost = np.where(better, new_cost, cost)
        damping = np.clip(damping * np.where(better, 0.4, 4.0), 1e-6, 1e6)
        if not better.any() and damping.min() > 1e3:
            break
    return q


def _step(search: _Search, q: FloatArray, errors: FloatArray, damping: FloatArray) -> FloatArray:
    """Joint steps (k, n); a joint at its bound that would be pushed through it stays where it is."""
    J = jacobian(search.robot, q) * search.weights[:, None]
    gradient = np.einsum("kij,ki->kj", J, errors)
    stuck = ((q <= search.bounds[:, 0]) & (gradient < 0.0)) | ((q >= search.bounds[:, 1]) & (gradient > 0.0))
    J = np.where(stuck[:, None, :], 0.0, J)
    normal = np.einsum("kij,kil->kjl", J, J)
    scale = damping * np.linalg.norm(errors, axis=1) + 1e-14
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
