"""The DH rows a solution is written with: the arm's own where its twists are 0 and ±90°, else the normal form's."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rvsim.kinematics.inverse.chain import TOLERANCE, Chain, place_by_rows
from rvsim.robot import Robot
from rvsim.spatial import inverse_transform, rot_x, transform
from rvsim.spatial.arrays import FloatArray


@dataclass(frozen=True, eq=False)
class Rows:
    """Standard DH rows, T_base_tool = T_base_0 · Π Rz(θi) Tz(di) Tx(ai) Rx(αi) · T_n_tool.

    `sign` and `offset` lead from q to the θi (di of a prismatic joint); `theta`, `d` are the other, constant ones;
    `turn` is ±1 where αi is ±90°, 0 where it is 0; `sine` is ±1: the sine of θi over that of the arm's own DH angle.
    """

    robot: Robot
    sign: FloatArray
    offset: FloatArray
    theta: FloatArray
    d: FloatArray
    a: FloatArray
    turn: FloatArray
    sine: FloatArray
    alpha: FloatArray
    T_base_0: FloatArray
    T_n_tool: FloatArray

    def a_symbol(self, i: int) -> str:
        """The name of length a of row i (from 0) in the arm's own table: Craig's rows count it one further."""
        return f"a_{i + 1 if self.robot.convention == 'standard' else i + 2}"

    def d_symbol(self, i: int) -> str:
        """The name of length d of row i (from 0)."""
        return f"d_{i + 1}"

    def plain(self, i: int) -> bool:
        """Whether θi (di) of row i (from 0) is the joint variable itself."""
        return bool(self.sign[i] > 0.0) and abs(math.remainder(float(self.offset[i]), 2.0 * math.pi)) <= TOLERANCE

    def symbol(self, i: int) -> str:
        """What the angle (length) of row i (from 0) is called."""
        letter = "\\theta" if self.robot.joints[i].revolute else "\\delta"
        return f"q_{i + 1}" if self.plain(i) else f"{letter}_{i + 1}"

    def joint(self, i: int, value: float) -> float:
        """The joint variable of an angle (length) of row i (from 0)."""
        return float(self.sign[i] * (value - self.offset[i]))

    def inner(self, i: int, q: float) -> float:
        """The angle (length) of row i (from 0) of a joint variable."""
        return float(self.sign[i] * q + self.offset[i])

    def place(self, values: Sequence[float]) -> FloatArray:
        """The tool's origin (3,) in frame 0 for angles (lengths) of the rows."""
        return place_by_rows(self, values)

    def T_0_n(self, T: FloatArray) -> FloatArray:
        """The last frame (4, 4) in frame 0 of a tool pose (4, 4)."""
        return np.asarray(self.T_0_tool(T) @ inverse_transform(self.T_n_tool))

    def T_0_tool(self, T: FloatArray) -> FloatArray:
        """The tool (4, 4) in frame 0 of a tool pose (4, 4)."""
        return np.asarray(inverse_transform(self.T_base_0) @ T)


def rows_of(chain: Chain) -> Rows:
    """The rows to write an arm's solution with."""
    robot = chain.robot
    before, dh = _standard_rows(robot)
    alpha = np.array([math.remainder(value, 2.0 * math.pi) for value in dh[:, 3].tolist()])
    if np.abs(np.abs(alpha) - math.pi).min() <= TOLERANCE:
        return _normal_rows(chain)
    after = transform(rot_x(alpha[-1]), np.array([dh[-1, 2], 0.0, 0.0])) @ robot.T_flange_tool
    dh[-1, 2] = alpha[-1] = 0.0
    revolute, ones = robot.is_revolute, np.ones(robot.dof)
    offset, theta, d = (
        np.where(revolute, dh[:, 0], dh[:, 1]),
        np.where(revolute, 0.0, dh[:, 0]),
        np.where(revolute, dh[:, 1], 0.0),
    )
    return Rows(robot, ones, offset, theta, d, dh[:, 2], np.rint(np.sin(alpha)), ones, alpha, before, after)


def _normal_rows(chain: Chain) -> Rows:
    sine = np.array([chain.sine_sign(i) for i in range(chain.robot.dof)])
    turn = np.rint(np.sin(chain.alpha))
    return Rows(
        chain.robot,
        chain.sign,
        chain.offset,
        chain.theta,
        chain.d,
        chain.a,
        turn,
        sine,
        chain.alpha,
        chain.T_base_0,
        chain.T_n_tool,
    )


def _standard_rows(robot: Robot) -> tuple[FloatArray, FloatArray]:
    """What stands before the first row, and rows theta, d, a, alpha (n, 4) of the standard convention."""
    rows = np.array(robot.dh)
    if robot.convention == "standard":
        return robot.T_base_0, rows
    first = rows[0, 2:].copy()
    rows[:, 2:] = np.roll(rows[:, 2:], -1, axis=0)
    rows[-1, 2:] = 0.0
    return robot.T_base_0 @ transform(rot_x(first[1]), np.array([first[0], 0.0, 0.0])), rows
