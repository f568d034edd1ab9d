"""The geometric Jacobian: how fast the tool moves and turns when the joints do."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

from numpy.typing import ArrayLike

from rvsim.kinematics.chain import Axis, Frame, Vector, Walk, combined, cross
from rvsim.kinematics.tape import Number, Player, Tape
from rvsim.robot import Joint, Robot
from rvsim.spatial.arrays import FloatArray


class PoseAndJacobian(NamedTuple):
    """T_base_tool (..., 4, 4) and J (..., 6, n) of the same joint values."""

    T: FloatArray
    J: FloatArray


def jacobian(robot: Robot, q: ArrayLike) -> FloatArray:
    """J (..., 6, n) of q (..., n): (v, ω) = J qd, in base axes, v that of the tool origin; the linear rows first.

    A turning joint with axis z through o contributes (z × (p − o), z), a sliding one (z, 0).
    Source: Siciliano et al., Robotics (2009), eq. (3.30).

    Raises:
        ShapeError: the last axis of q is not the number of joints.
    """
    return _jacobian_player(robot).play(q)


def pose_and_jacobian(robot: Robot, q: ArrayLike) -> PoseAndJacobian:
    """Both at once for q (..., n), which costs little more than the Jacobian alone; the arrays are views of one.

    Raises:
        ShapeError: the last axis of q is not the number of joints.
    """
    entries = _both_player(robot).play(q)
    leading = entries.shape[:-1]
    return PoseAndJacobian(entries[..., :16].reshape(*leading, 4, 4), entries[..., 16:].reshape(*leading, 6, robot.dof))


@lru_cache(maxsize=64)
def _jacobian_player(robot: Robot) -> Player:
    tape = Tape(robot.dof)
    _, entries = record_pose_and_jacobian(robot, tape)
    return tape.player(entries, (6, robot.dof))


@lru_cache(maxsize=64)
def _both_player(robot: Robot) -> Player:
    tape = Tape(robot.dof)
    tool, entries = record_pose_and_jacobian(robot, tape)
    return tape.player([*tool.entries, *entries], (16 + 6 * robot.dof,))


def record_pose_and_jacobian(robot: Robot, tape: Tape) -> tuple[Frame, list[Number]]:
    """Write both on a tape: the tool's frame, and the entries of J row by row."""
    walk = Walk(tape, robot.T_base_0)
    axes = [walk.pass_joint(robot, index) for index in range(robot.dof)]
    walk.pass_transform(robot.T_flange_tool)
    tool = walk.frame
    columns = [_column(joint, axis, tool.origin) for joint, axis in zip(robot.joints, axes, strict=True)]
    return tool, [column[row] for row in range(6) for column in columns]


def _column(joint: Joint, axis: Axis, tool_origin: Vector) -> tuple[Number, ...]:
    if not joint.revolute:
        return (*axis.direction, 0.0, 0.0, 0.0)
    arm = combined((1.0, tool_origin), (-1.0, axis.point))
    return (*cross(axis.direction, arm), *axis.direction)
