"""Where to start: a table of configurations with their poses, and for a target the entries whose poses come nearest.

The table uses the arm's own symmetry. Turning the first joint turns the whole arm about its axis, turning the last one
turns the tool about its axis. So the table need not hold these two joints: entries and targets are compared by what
such turns leave unchanged, and then both joints are turned until entry and target agree best. That holds for every arm
whose first (or last) joint is revolute; it is no closed form, the joints between are guesses.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from rvsim.kinematics.forward import forward_kinematics
from rvsim.kinematics.jacobian import pose_and_jacobian
from rvsim.kinematics.numeric.bounds import TURN, bounds_of, start_ranges
from rvsim.kinematics.numeric.options import Task
from rvsim.robot import Robot
from rvsim.spatial.arrays import FloatArray

Indices = np.ndarray[Any, np.dtype[np.intp]]
TABLE_SIZE = 1024
# A block of targets whose distances to all entries stay in the cache.
_BLOCK = 128
# An error of one radian weighs as much as this part of the arm's size.
_RADIAN = 0.25


class _Line(NamedTuple):
    """An axis: a unit direction and the point on it that is nearest to the tool."""

    direction: FloatArray
    point: FloatArray


class Features(NamedTuple):
    """Of m poses: what is compared (m, f), the angle of the place about the first axis (m,), and the rotations."""

    compared: FloatArray
    azimuth: FloatArray
    R: FloatArray


class StartTable:
    """The table of one arm for one task; `q` (k, n) are its configurations."""

    def __init__(self, robot: Robot, task: Task, enforce_joint_limits: bool) -> None:
        self._turns_first = bool(robot.is_revolute[0])
        self._turns_last = robot.dof > 1 and bool(robot.is_revolute[-1]) and task == "pose"
        self._task: Task = task
        self._length = _RADIAN * robot.size
        T, J = pose_and_jacobian(robot, robot.home)
        self._first, last = _line(T, J[:, 0]), _line(T, J[:, -1])
        self._axes = _axes_along(self._first.direction)
        # The last axis as the tool sees it; where it does not count, the tool origin itself.
        self._last_direction = T[:3, :3].T @ last.direction
        self._last_point = T[:3, :3].T @ (last.point - T[:3, 3]) if self._turns_last else np.zeros(3)
        self.q = self._configurations(robot, start_ranges(robot, bounds_of(robot, enforce_joint_limits)))
        self._entries = self.features(forward_kinematics(robot, self.q))
        self._compared = self._entries.compared.astype(np.float32)
        self._half_squares = 0.5 * np.sum(self._compared**2, axis=1)

    def _configurations(self, robot: Robot, ranges: FloatArray) -> FloatArray:
        first, end = int(self._turns_first), robot.dof - int(self._turns_last)
        q = np.zeros((TABLE_SIZE if end > first else 1, robot.dof))
        low, high = ranges[first:end].T
        q[:, first:end] = low + _spread(len(q), end - first) * (high - low)
        return q

    def features(self, T: FloatArray) -> Features:
        """The features of poses (m, 4, 4)."""
        R = self._axes @ T[:, :3, :3]
        place = (T[:, :3, 3] - self._first.point) @ self._axes.T + R @ self._last_point
        azimuth = np.arctan2(place[:, 1], place[:, 0]) if self._turns_first else np.zeros(len(T))
        turned_place = _turned(-azimuth, place[..., None])[..., 0] / self._length
        if self._task == "position":
            return Features(turned_place, azimuth, R)
        direction = (R @ self._last_direction)[..., None] if self._turns_last else R
        turned = _turned(-azimuth, direction).reshape(len(T), 3 * direction.shape[2])
        return Features(np.concatenate([turned_place, turned], axis=1), azimuth, R)

    def nearest(self, features: Features, count: int) -> Indices:
        """(m, count) the nearest entries, in no order; fewer if the table is shorter."""
        count = min(count, len(self.q))
        found = np.empty((len(features.azimuth), count), np.intp)
        compared = features.compared.astype(np.float32)
        for start in range(0, len(found), _BLOCK):
            distance = self._half_squares - compared[start : start + _BLOCK] @ self._compared.T
            found[start : start + _BLOCK] = _smallest(distance, count)
        return found

    def starts(self, entries: Indices, features: Features) -> FloatArray:
        """(m, n) these entries, one for each target, with the first and the last joint turned towards it."""
        q = self.q[entries]
        if self._turns_first:
            turn = features.azimuth - self._entries.azimuth[entries]
            q[:, 0] = _wrapped(turn)
        if self._turns_last:
            R = _turned(turn, self._entries.R[entries]) if self._turns_first else self._entries.R[entries]
            q[:, -1] = self._roll(np.swapaxes(R, 1, 2) @ features.R)
        return q

    def _roll(self, R: FloatArray) -> FloatArray:
        """The angles (m,) about the last axis that come nearest to R (m, 3, 3): those that leave the largest trace."""
        axis = self._last_direction
        x, y, z = R[:, 2, 1] - R[:, 1, 2], R[:, 0, 2] - R[:, 2, 0], R[:, 1, 0] - R[:, 0, 1]
        sine = x * axis[0] + y * axis[1] + z * axis[2]
        return np.asarray(np.arctan2(sine, np.trace(R, axis1=1, axis2=2) - (R @ axis) @ axis))


@lru_cache(maxsize=64)
def start_table(robot: Robot, task: Task, enforce_joint_limits: bool) -> StartTable:
    """Made once for an arm, a task and a choice about limits, in a few milliseconds."""
    return StartTable(robot, task, enforce_joint_limits)


def _line(T: FloatArray, column: FloatArray) -> _Line:
    """The axis of a revolute joint from its column (v, ω) of J: v = ω × (p − point)."""
    return _Line(column[3:], T[:3, 3] - np.cross(column[:3], column[3:]))


def _axes_along(direction: FloatArray) -> FloatArray:
    """(3, 3) rows: right-handed axes whose z is this direction; the base axes for none (a prismatic joint)."""
    if not direction.any():
        return np.eye(3)
    x = np.cross(np.eye(3)[np.argmin(np.abs(direction))], direction)
    x /= np.linalg.norm(x)
    return np.stack([x, np.cross(direction, x), direction])


def _turned(angle: FloatArray, columns: FloatArray) -> FloatArray:
    """Columns (m, 3, c) turned about z by angles (m,)."""
    cosine, sine = np.cos(angle)[:, None], np.sin(angle)[:, None]
    x, y = columns[:, 0], columns[:, 1]
    return np.stack([cosine * x - sine * y, sine * x + cosine * y, columns[:, 2]], axis=1)


def _wrapped(angle: FloatArray) -> FloatArray:
    return np.asarray(angle - TURN * np.round(angle / TURN))


def _smallest(distance: FloatArray, count: int) -> Indices:
    if count == 1:
        return np.asarray(np.argmin(distance, axis=1)[:, None])
    return np.argpartition(distance, min(count, distance.shape[1] - 1), axis=1)[:, :count]


def _spread(count: int, dimensions: int) -> FloatArray:
    """`count` points spread evenly over the unit cube: the additive sequence of the root of x^(d+1) = x + 1.

    Source: Roberts, The unreasonable effectiveness of quasirandom sequences (2018).
    """
    root = 2.0
    for _ in range(40):
        root = (1.0 + root) ** (1.0 / (dimensions + 1))
    steps = root ** -np.arange(1.0, dimensions + 1.0)
    return np.asarray((0.5 + np.arange(1, count + 1)[:, None] * steps) % 1.0)
