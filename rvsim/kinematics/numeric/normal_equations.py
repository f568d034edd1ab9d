"""One Gauss–Newton step for many poses at once: the error, JᵀJ and Jᵀe of an arm as one recorded formula.

The cost is E = ½ |e_p|² + (1 − cos θ): the distance of the origins and the angle θ between the axes. Its negative
gradient is exactly Jᵀ e with e = (p_target − p, sin θ · axis), a polynomial in the entries of both rotations
(Luh, Walker and Paul 1980, eq. (23)), so the whole step needs no square root and no inverse trigonometry.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from itertools import product
from typing import NamedTuple

import numpy as np

from rvsim.kinematics.chain import Frame, Vector, combined, cross
from rvsim.kinematics.jacobian import record_pose_and_jacobian
from rvsim.kinematics.numeric.options import Task
from rvsim.kinematics.tape import Number, Tape
from rvsim.kinematics.tape.blocks import BlockPlan, block_plan
from rvsim.robot import Robot
from rvsim.spatial.arrays import FloatArray

TARGET_ENTRIES = 12  # of a pose: the upper three rows of T
_SCALARS = 3


class Rows(NamedTuple):
    """For m poses: `system` (n, n + 1, m), which is JᵀJ with Jᵀe as its last column; |e_p|², sin² θ and cos θ (m,)."""

    system: FloatArray
    position_squared: FloatArray
    sine_squared: FloatArray
    cosine: FloatArray

    @property
    def cost(self) -> FloatArray:
        """E (m,)."""
        return np.asarray(0.5 * self.position_squared + (1.0 - self.cosine))


class NormalEquations:
    """The recorded formula of an arm and a task; joints and targets come as rows (n + 12, m)."""

    def __init__(self, robot: Robot, task: Task) -> None:
        self._dof = robot.dof
        self._plan = _recorded(robot, task)

    def evaluate(self, inputs: FloatArray) -> Rows:
        """The rows for inputs (n + 12, m): q above the entries of the target."""
        entries = self._dof * (self._dof + 1)
        results = np.zeros((entries + _SCALARS, inputs.shape[1]))
        self._plan.play(inputs.T, results.T)
        return Rows(results[:entries].reshape(self._dof, self._dof + 1, -1), *results[entries:])


@lru_cache(maxsize=64)
def normal_equations(robot: Robot, task: Task) -> NormalEquations:
    """Recorded once for an arm and a task."""
    return NormalEquations(robot, task)


def _recorded(robot: Robot, task: Task) -> BlockPlan:
    n = robot.dof
    tape = Tape(n + TARGET_ENTRIES)
    tool, jacobian = record_pose_and_jacobian(robot, tape)
    target = _target(tape, n)
    position = combined((1.0, target.origin), (-1.0, tool.origin))
    error: tuple[Number, ...] = position
    sine_squared: Number = 0.0
    cosine: Number = 1.0
    if task == "pose":
        rotation = _sine_of_error(tool, target)
        error = (*position, *rotation)
        sine_squared, cosine = _dot(rotation, rotation), 0.5 * (_trace(tool, target) - 1.0)
    columns = [[jacobian[row * n + j] for row in range(len(error))] for j in range(n)]
    system = [_dot(left, right) for left, right in product(columns, [*columns, error])]
    return block_plan(tape.program([*system, _dot(position, position), sine_squared, cosine]))


def _target(tape: Tape, first: int) -> Frame:
    """The frame whose entries are inputs, row by row."""
    entry = [tape.joint(first + i) for i in range(TARGET_ENTRIES)]
    x, y, z, origin = ((entry[i], entry[4 + i], entry[8 + i]) for i in range(4))
    return Frame(x, y, z, origin)


def _sine_of_error(tool: Frame, target: Frame) -> Vector:
    """sin θ · axis of the turn from the tool's axes to the target's."""
    x, y, z = (cross(a, b) for a, b in zip(tool[:3], target[:3], strict=True))
    return combined((0.5, x), (0.5, y), (0.5, z))


def _trace(tool: Frame, target: Frame) -> Number:
    return sum((_dot(a, b) for a, b in zip(tool[:3], target[:3], strict=True)), 0.0)


def _dot(left: Sequence[Number], right: Sequence[Number]) -> Number:
    return sum((a * b for a, b in zip(left, right, strict=True)), 0.0)


def solve_rows(system: FloatArray) -> FloatArray:
    """x (n, m) of m symmetric positive definite systems (n, n + 1, m), the right side in the last column.

    Gauss elimination without pivots, which such systems do not need (Golub and Van Loan, §4.2).
    `system` is overwritten.
    """
    n = len(system)
    for k in range(n - 1):
        factors = system[k, k + 1 : n] / system[k, k]
        system[k + 1 :, k + 1 :] -= factors[:, None] * system[k, k + 1 :]
    x = np.empty((n, system.shape[2]))
    for k in reversed(range(n)):
        known = np.sum(system[k, k + 1 : n] * x[k + 1 :], axis=0)
        x[k] = (system[k, n] - known) / system[k, k]
    return x
