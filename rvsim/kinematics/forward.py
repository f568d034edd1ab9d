"""Forward kinematics: where the tool and every link stand for given joint values."""

from __future__ import annotations

from functools import lru_cache

from numpy.typing import ArrayLike

from rvsim.kinematics.chain import Walk
from rvsim.kinematics.tape import Number, Player, Tape
from rvsim.robot import Robot
from rvsim.spatial.arrays import FloatArray


def forward_kinematics(robot: Robot, q: ArrayLike) -> FloatArray:
    """T_base_tool (..., 4, 4) = T_base_0 · A1 … An · T_flange_tool of q (..., n) [rad, m].

    Raises:
        ShapeError: the last axis of q is not the number of joints.
    """
    return _tool_player(robot).play(q)


def link_transforms(robot: Robot, q: ArrayLike) -> FloatArray:
    """T_base_0 … T_base_n (..., n + 1, 4, 4) of q (..., n) [rad, m]: the base transform first, then one a joint.

    Raises:
        ShapeError: the last axis of q is not the number of joints.
    """
    return _links_player(robot).play(q)


@lru_cache(maxsize=64)
def _tool_player(robot: Robot) -> Player:
    tape = Tape(robot.dof)
    walk = Walk(tape, robot.T_base_0)
    for index in range(robot.dof):
        walk.pass_joint(robot, index)
    walk.pass_transform(robot.T_flange_tool)
    return tape.player(walk.frame.entries, (4, 4))


@lru_cache(maxsize=64)
def _links_player(robot: Robot) -> Player:
    tape = Tape(robot.dof)
    walk = Walk(tape, robot.T_base_0)
    entries: list[Number] = [*walk.frame.entries]
    for index in range(robot.dof):
        walk.pass_joint(robot, index)
        entries += walk.frame.entries
    return tape.player(entries, (robot.dof + 1, 4, 4))
