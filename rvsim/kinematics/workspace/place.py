"""Where the tool is and how nimble it is there, for a million poses: only what a workspace needs, on one tape.

The manipulability of Yoshikawa (1985), √det(J Jᵀ) or √det(Jᵀ J), is that of the arm's own task: J has the rows of
x and y for a planar arm, of the place for three joints. It does not change when joint 1 moves the whole arm, so joint 1
is left out of it: the Jacobian is written for q1 = 0.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from rvsim.kinematics.chain import Axis, Vector, Walk, combined, cross
from rvsim.kinematics.forward import link_transforms
from rvsim.kinematics.singularity import task_rows
from rvsim.kinematics.tape import Number, Player, Tape
from rvsim.kinematics.workspace.grid import BoolArray
from rvsim.robot import Joint, Robot
from rvsim.spatial.arrays import FloatArray

_UPRIGHT = 1e-9
_TURN = 2.0 * math.pi


@dataclass(frozen=True, eq=False)
class Turntable:
    """Joint 1 where it turns the whole arm about a vertical axis through `point` (2,), to the left for `sense` +1."""

    point: FloatArray
    sense: float

    def placed(self, places: FloatArray, q1: FloatArray) -> FloatArray:
        """Places (m, 3) for q1 = 0, turned by q1 (m,)."""
        x, y = (places[:, :2] - self.point).T
        c, s = np.cos(q1), self.sense * np.sin(q1)
        return np.stack([self.point[0] + c * x - s * y, self.point[1] + s * x + c * y, places[:, 2]], axis=-1)

    def with_turn(self, q: FloatArray, azimuth: FloatArray) -> FloatArray:
        """Poses (m, n) with joint 1 so that the tool is turned by an azimuth (m,) from where it is at q1 = 0."""
        turned = q.copy()
        turned[:, 0] = self.sense * azimuth
        return turned

    def cylindrical(self, places: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Distance from the axis, azimuth and height (m,) of places (m, 3)."""
        x, y = (places[:, :2] - self.point).T
        return np.hypot(x, y), np.arctan2(y, x), places[:, 2]

    def goes_round(self, limits: FloatArray) -> bool:
        """Whether limits (2,) let joint 1 make a whole turn."""
        return bool(limits[1] - limits[0] >= _TURN - _UPRIGHT)

    def turns_to(self, azimuth: FloatArray, limits: FloatArray) -> BoolArray:
        """Whether joint 1, within limits (2,), turns the tool by an azimuth (...), whole turns aside."""
        if self.goes_round(limits):
            return np.ones(np.shape(azimuth), dtype=bool)
        span = float(limits[1] - limits[0])
        beyond = self.sense * azimuth - (limits[0] - _UPRIGHT)
        return np.asarray(beyond - _TURN * np.floor(beyond / _TURN) <= span + 2.0 * _UPRIGHT)


def turntable(robot: Robot) -> Turntable | None:
    """The arm's turntable; None where joint 1 slides or leans."""
    first = _first_axis(robot)
    upright = math.hypot(*first.direction[:2]) <= _UPRIGHT  # type: ignore[arg-type]
    if not (robot.joints[0].revolute and upright):
        return None
    return Turntable(np.array(first.point[:2], dtype=np.float64), math.copysign(1.0, first.direction[2]))  # type: ignore[arg-type]


def places_and_manipulability(robot: Robot, q: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The tool's places (m, 3) and manipulabilities (m,) of q (m, n).

    The places of an arm on a turntable are those at q1 = 0: `Turntable.placed` brings them to q1.
    """
    values = _player(robot).play(q)
    det = values[:, 3]
    return values[:, :3], np.abs(det) if robot.dof == len(task_rows(robot)) else np.sqrt(np.maximum(det, 0.0))


@lru_cache(maxsize=16)
def _player(robot: Robot) -> Player:
    tape = Tape(robot.dof)
    place, axes = _recorded(robot, tape)
    if turntable(robot) is None:
        walk = Walk(tape, robot.T_base_0)
        for index in range(robot.dof):
            walk.pass_joint(robot, index)
        walk.pass_transform(robot.T_flange_tool)
        tool = walk.origin
    else:
        tool = place
    rows = task_rows(robot)
    whole = (_column(joint, axis, place) for joint, axis in zip(robot.joints, axes, strict=True))
    columns = [[column[row] for row in rows] for column in whole]
    return tape.player([*tool, _squared_measure(columns)], (4,))


def _recorded(robot: Robot, tape: Tape) -> tuple[Vector, list[Axis]]:
    """The tool's place and the joints' axes at q1 = 0."""
    walk = Walk(tape, link_transforms(robot, np.zeros(robot.dof))[1])
    axes = [_first_axis(robot), *(walk.pass_joint(robot, index) for index in range(1, robot.dof))]
    walk.pass_transform(robot.T_flange_tool)
    return walk.origin, axes


@lru_cache(maxsize=16)
def _first_axis(robot: Robot) -> Axis:
    return Walk(Tape(robot.dof), robot.T_base_0).pass_joint(robot, 0)


def _column(joint: Joint, axis: Axis, tool: Vector) -> list[Number]:
    """The joint's column of J: (z × (p − o), z) of one that turns, (z, 0) of one that slides."""
    if not joint.revolute:
        return [*axis.direction, 0.0, 0.0, 0.0]
    return [*cross(axis.direction, combined((1.0, tool), (-1.0, axis.point))), *axis.direction]


def _squared_measure(columns: list[list[Number]]) -> Number:
    """det J of as many joints as rows; det(Jᵀ J) of fewer, det(J Jᵀ) of more."""
    rows = len(columns[0])
    if len(columns) == rows:
        return determinant(columns)
    vectors = columns if len(columns) < rows else [list(row) for row in zip(*columns, strict=True)]
    return determinant([[_dot(a, b) for b in vectors] for a in vectors])


def _dot(a: Sequence[Number], b: Sequence[Number]) -> Number:
    total: Number = 0.0
    for left, right in zip(a, b, strict=True):
        total = total + left * right
    return total


def determinant(rows: Sequence[Sequence[Number]]) -> Number:
    """By Laplace's expansion, each minor of the last rows worked out once: n · 2ⁿ⁻¹ products instead of n!."""
    minors: dict[tuple[int, ...], Number] = {(): 1.0}

    def minor(columns: tuple[int, ...]) -> Number:
        if columns not in minors:
            row, total, sign = rows[len(rows) - len(columns)], 0.0, 1.0
            result: Number = total
            for place, column in enumerate(columns):
                if row[column] != 0.0:
                    result = result + sign * row[column] * minor(columns[:place] + columns[place + 1 :])
                sign = -sign
            minors[columns] = result
        return minors[columns]

    return minor(tuple(range(len(rows))))
