"""An arm in one normal form, so that a closed form is written once for both DH conventions and every sign of a twist.

    T_base_tool = T_base_0 · Π Rz(θi) Tz(di) Tx(ai) Rx(αi) · T_n_tool,   αi in [0, π), an and αn zero

`θi` (`di` for a prismatic joint) is `sign · q + offset`. A modified table becomes a standard one by moving each row's
a and α one row up. A negative twist turns positive because Rx(−α) = Rz(π) Rx(α) Rz(π); a twist of π moves to the
right through every later row, Rx(π) Rz(θ) Tz(d) = Rz(−θ) Tz(−d) Rx(π), and ends in the tool.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Protocol

import numpy as np

from rvsim.kinematics.dh import dh_transform
from rvsim.robot import Robot
from rvsim.spatial import inverse_transform, rot_x, rot_z, transform
from rvsim.spatial.arrays import FloatArray

TOLERANCE = 1e-9  # what counts as zero in a DH table [m, rad]
TURN = 2.0 * math.pi
_AT_ONCE = 16384  # numbers that the cache holds with what is made of them


@dataclass(frozen=True, eq=False)
class Chain:
    """The normal form of one arm.

    Args:
        sign, offset: (n,) from the joint variables q to the variables of the normal form.
        theta, d: (n,) the constant one of the two: d of a revolute joint, θ of a prismatic one; else 0.
        a, alpha: (n,) of the normal form.
        T_base_0, T_n_tool: (4, 4) what stands before the first row and behind the last.
        size: a length that bounds the reach [m].
    """

    robot: Robot
    sign: FloatArray
    offset: FloatArray
    theta: FloatArray
    d: FloatArray
    a: FloatArray
    alpha: FloatArray
    T_base_0: FloatArray
    T_n_tool: FloatArray
    size: float
    T_0_base: FloatArray = field(init=False)
    T_tool_n: FloatArray = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "T_0_base", inverse_transform(self.T_base_0))
        object.__setattr__(self, "T_tool_n", inverse_transform(self.T_n_tool))

    @cached_property
    def tool_is_last(self) -> bool:
        """Whether frame n is that of the tool."""
        return np.array_equal(self.T_n_tool, np.eye(4))

    @cached_property
    def base_is_first(self) -> bool:
        """Whether frame 0 is that of the base."""
        return np.array_equal(self.T_base_0, np.eye(4))

    @cached_property
    def _shifts(self) -> bool:
        return bool(self.offset.any())

    @cached_property
    def _reverses(self) -> bool:
        return bool((self.sign < 0.0).any())

    @property
    def joints(self) -> str:
        """The joint types as a word, for instance "RRP"."""
        return "".join("R" if joint.revolute else "P" for joint in self.robot.joints)

    def parallel(self, i: int) -> bool:
        """Whether axes i and i + 1 (from 0) are parallel."""
        return abs(float(self.alpha[i])) <= TOLERANCE

    def square(self, i: int) -> bool:
        """Whether axes i and i + 1 (from 0) are at a right angle."""
        return abs(float(self.alpha[i]) - 0.5 * math.pi) <= TOLERANCE

    def sine_sign(self, i: int) -> float:
        """±1: the sine of joint i's DH angle (from 0) over that of the normal form's angle."""
        turn = self.offset[i] - self.sign[i] * self.robot.dh[i, 0]
        return float(self.sign[i]) * math.copysign(1.0, math.cos(turn))

    def place(self, values: Sequence[float]) -> FloatArray:
        """The tool's origin (3,) in frame 0 for variables (n,) of the normal form, by the plain product of the rows."""
        return place_by_rows(self, values)

    def inner(self, q: FloatArray) -> FloatArray:
        """The variables of the normal form (..., n) of joint variables q (..., n)."""
        return self.sign * q + self.offset

    def to_joints(self, values: FloatArray) -> FloatArray:
        """Joint variables of the normal form's variables (branches, n, m), in place; angles within [−π, π]."""
        if self._shifts:
            values -= self.offset[:, None]
        if self._reverses:
            values *= self.sign[:, None]
        turning = self.robot.is_revolute
        if values.size <= _AT_ONCE:  # few calls for few poses; for many, parts that stay in the cache
            values -= (TURN * turning)[:, None] * np.rint(values * (1.0 / TURN))
        else:
            for i in np.flatnonzero(turning):
                wrap(values[:, i])
        return values


def wrap(angles: FloatArray) -> FloatArray:
    """Angles brought into [−π, π], in place."""
    angles -= TURN * np.rint(angles * (1.0 / TURN))
    return angles


def canonical_chain(robot: Robot) -> Chain:
    """The normal form of an arm. Any arm has one; nothing is assumed about its numbers."""
    before, rows = _standard_rows(robot)
    columns: list[tuple[float, float, float, float, float, float]] = []
    flipped, turn = False, 0.0
    for joint, (theta, d, a, alpha) in zip(robot.joints, rows, strict=True):
        sign = -1.0 if flipped else 1.0
        angle, length = sign * theta + turn, sign * d
        a, alpha, extra, flips = _positive_twist(a, alpha)
        flipped, turn, angle = flipped ^ flips, extra, angle + extra
        offset, theta_fixed, d_fixed = (angle, 0.0, length) if joint.revolute else (length, angle, 0.0)
        columns.append((sign, offset, theta_fixed, d_fixed, a, alpha))
    after = (
        _x_part(columns[-1][4], columns[-1][5]) @ transform(rot_z(turn), np.zeros(3)) @ _x_part(0.0, math.pi * flipped)
    )
    sign_, offset_, theta_, d_, a_, alpha_ = np.array(columns).T
    a_[-1] = alpha_[-1] = 0.0
    return Chain(robot, sign_, offset_, theta_, d_, a_, alpha_, before, after @ robot.T_flange_tool, robot.size)


def _standard_rows(robot: Robot) -> tuple[FloatArray, FloatArray]:
    """What stands before the first row, and rows theta, d, a, alpha of the standard convention."""
    if robot.convention == "standard":
        return robot.T_base_0, robot.dh
    rows = robot.dh.copy()
    rows[:, 2:] = np.roll(rows[:, 2:], -1, axis=0)
    rows[-1, 2:] = 0.0
    return robot.T_base_0 @ _x_part(*robot.dh[0, 2:]), rows


def _positive_twist(a: float, alpha: float) -> tuple[float, float, float, bool]:
    """a and alpha with alpha in [0, π), the turn about z this costs on both sides, and whether a twist of π is left."""
    alpha = math.remainder(alpha, TURN)
    if abs(alpha) >= math.pi - TOLERANCE:
        return a, 0.0, 0.0, True
    if alpha < -TOLERANCE:
        return -a, -alpha, math.pi, False
    return a, max(alpha, 0.0), 0.0, False


def _x_part(a: float, alpha: float) -> FloatArray:
    """Tx(a) Rx(alpha)."""
    return transform(rot_x(alpha), np.array([a, 0.0, 0.0]))


class StandardRows(Protocol):
    """Standard DH rows of an arm: the constants of each row, and the tool behind the last one."""

    @property
    def robot(self) -> Robot: ...  # noqa: D102

    @property
    def theta(self) -> FloatArray: ...  # noqa: D102

    @property
    def d(self) -> FloatArray: ...  # noqa: D102

    @property
    def a(self) -> FloatArray: ...  # noqa: D102

    @property
    def alpha(self) -> FloatArray: ...  # noqa: D102

    @property
    def T_n_tool(self) -> FloatArray: ...  # noqa: D102


def place_by_rows(rows: StandardRows, values: Sequence[float]) -> FloatArray:
    """The tool's origin (3,) in frame 0, by the plain product of the rows; `values` are their angles (lengths)."""
    T = np.eye(4)
    for i, (value, joint) in enumerate(zip(values, rows.robot.joints, strict=True)):
        theta, d = (value, rows.d[i]) if joint.revolute else (rows.theta[i], value)
        T = T @ dh_transform(theta, d, rows.a[i], rows.alpha[i], "standard")
    return np.asarray((T @ rows.T_n_tool)[:3, 3])
