"""Thousands of poses at once: damped Gauss–Newton steps on all that are left, first from the nearest start of a table.

What takes the time is calling numpy, not arithmetic, once few poses are left. So each round gives the poses that are
left more starts at a time: the last ones run from hundreds side by side.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import ShapeError
from rvsim.kinematics.numeric.bounds import Bounds, bounds_of
from rvsim.kinematics.numeric.normal_equations import (
    TARGET_ENTRIES,
    NormalEquations,
    Rows,
    normal_equations,
    solve_rows,
)
from rvsim.kinematics.numeric.options import Task, checked_task
from rvsim.kinematics.numeric.start_table import Features, Indices, StartTable, start_table
from rvsim.kinematics.numeric.target import target_poses
from rvsim.robot import Robot
from rvsim.spatial.arrays import FloatArray

# Poses whose rows fit the cache.
_BLOCK = 2048
# Damping by the error (Chan and Lawrence 1988), and what stays so that a redundant arm's system is not singular.
_ERROR_DAMPING, _LEAST_DAMPING = 0.05, 1e-9
_STEP_LIMIT = 1.0  # [rad, m]
# A start is let go when its step promises to lower the cost by less than this part; sorting out waits for enough such.
_HOPELESS, _CROWDED = 1e-2, 0.75


class Round(NamedTuple):
    """How many starts each pose gets, and how many steps each of them."""

    starts: int
    steps: int


ROUNDS = (Round(1, 7), Round(6, 8), Round(24, 12), Round(96, 20), Round(256, 40))


class BatchResult(NamedTuple):
    """`q` (m, n) [rad, m], NaN where there is none, and whether each pose `converged` (m,)."""

    q: FloatArray
    converged: np.ndarray[Any, np.dtype[np.bool_]]


def solve_numeric_batch(
    robot: Robot,
    T: ArrayLike,
    *,
    task: str = "pose",
    position_tolerance: float = 1e-6,
    rotation_tolerance: float = 1e-6,
    enforce_joint_limits: bool = True,
) -> BatchResult:
    """Joints for each pose T (m, 4, 4), found by error-damped least squares from a table of starts.

    Every q returned keeps both tolerances [m], [rad] and, if asked, the limits. The same poses give the same joints.
    Sources: Sugihara, IEEE T-RO 27 (2011), eq. (5)–(11); Chan and Lawrence, ICRA (1988).

    Raises:
        ShapeError: T is not (m, 4, 4). PoseError: a T is no pose. UnknownNameError: no such task.
    """
    chosen = checked_task(task)
    poses = target_poses(T, chosen)
    if poses.ndim != 3:
        raise ShapeError("T", "(m, 4, 4)", poses.shape)
    search = _Search(robot, chosen, poses, (position_tolerance, rotation_tolerance), enforce_joint_limits)
    for each in ROUNDS:
        search.do(each)
    return BatchResult(search.q, search.converged)


class _Search:
    """What is known of each pose so far."""

    def __init__(
        self, robot: Robot, task: Task, T: FloatArray, tolerances: tuple[float, float], enforce_joint_limits: bool
    ) -> None:
        self._table: StartTable = start_table(robot, task, enforce_joint_limits)
        self._equations: NormalEquations = normal_equations(robot, task)
        self._bounds: Bounds = bounds_of(robot, enforce_joint_limits).as_rows
        self._tolerances, self._dof = tolerances, robot.dof
        self._features = self._table.features(T)
        self._targets = np.ascontiguousarray(T[:, :3].reshape(len(T), TARGET_ENTRIES).T)
        self.q = np.full((len(T), robot.dof), np.nan)
        self.converged = np.zeros(len(T), np.bool_)

    def do(self, each: Round) -> None:
        """Try those that are left once more."""
        left = np.flatnonzero(~self.converged)
        block = max(1, _BLOCK // each.starts)
        for start in range(0, len(left), block):
            self._try(left[start : start + block], each)

    def _try(self, poses: Indices, each: Round) -> None:
        entries = self._table.nearest(Features(*(part[poses] for part in self._features)), each.starts)
        poses = np.repeat(poses, entries.shape[1])
        starts = self._table.starts(entries.ravel(), Features(*(part[poses] for part in self._features)))
        inputs = np.empty((self._dof + len(self._targets), len(poses)))
        inputs[: self._dof] = self._bounds.clamped(starts.T)
        inputs[self._dof :] = self._targets[:, poses]
        for _ in range(each.steps):
            inputs, poses = self._step(inputs, poses)
            if not len(poses):
                return

    def _step(self, inputs: FloatArray, poses: Indices) -> tuple[FloatArray, Indices]:
        """Note what has converged, move the rest, and let go of starts that lead nowhere."""
        rows = self._equations.evaluate(inputs)
        solved = self._solved(rows)
        if solved.any():
            found = poses[solved]
            self.q[found], self.converged[found] = inputs[: self._dof, solved].T, True
            left = np.flatnonzero(~self.converged[poses])
            inputs, poses = inputs.take(left, axis=1), poses[left]
            rows = Rows(*(part.take(left, axis=-1) for part in rows))
        hopeful = self._move(inputs[: self._dof], rows)
        if len(hopeful) < _CROWDED * len(poses):
            inputs, poses = inputs.take(hopeful, axis=1), poses[hopeful]
        return inputs, poses

    def _move(self, q: FloatArray, rows: Rows) -> Indices:
        """Move q (n, m) in place; those whose cost is about to fall."""
        gradient = rows.system[:, -1].copy()
        folded = self._bounds.folded(q + (steps := _damped_steps(rows)))
        q[:] = self._bounds.clamped(folded)
        promise = np.sum(gradient * (steps + (q - folded)), axis=0)
        return np.flatnonzero(promise > _HOPELESS * rows.cost)

    def _solved(self, rows: Rows) -> np.ndarray[Any, np.dtype[np.bool_]]:
        position, rotation = self._tolerances
        near = (rows.position_squared < position**2) & (rows.sine_squared < rotation**2)
        return np.asarray(near & (rows.cosine > 0.0))


def _damped_steps(rows: Rows) -> FloatArray:
    """(n, m) the solutions of (JᵀJ + λ 1) Δq = Jᵀe with λ from the cost, shortened to the step limit."""
    diagonal = np.arange(len(rows.system))
    rows.system[diagonal, diagonal] += _ERROR_DAMPING * rows.cost + _LEAST_DAMPING
    steps = solve_rows(rows.system)
    longest = np.max(np.abs(steps), axis=0)
    return np.asarray(steps * (_STEP_LIMIT / np.maximum(longest, _STEP_LIMIT)))
