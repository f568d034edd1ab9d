"""The moves that the Add buttons make: of the arm as it stands, behind the moves that are there."""

from __future__ import annotations

import numpy as np

from rvsim.experiment import Experiment
from rvsim.experiment.program import ArcMove, Gripper, JointMove, LineMove, Move, Program, ToolRule, Triple, Wait
from rvsim.kinematics import forward_kinematics
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.spatial import rpy_from_rotation

_ARC_HEIGHT = 0.35  # of the chord: where a new arc passes at first
_FEWEST_JOINTS_TO_POINT = 5
_SHORTEST_CHORD = 0.1  # sizes: for its height, where it begins and ends in one place


def new_move(kind: str, experiment: Experiment, index: int) -> Move:
    """A move of that kind to where the arm is now, to be put before the move of that index."""
    before = experiment.program[:index]
    here = _place(experiment.robot, experiment.q)
    # Whoever drove the arm there wants the tool as it is there, if the arm can turn it at all.
    tool: ToolRule = "turn" if experiment.robot.dof >= _FEWEST_JOINTS_TO_POINT else "keep"
    rpy = _triple(rpy_from_rotation(forward_kinematics(experiment.robot, experiment.q)[:3, :3]))
    if kind == "line":
        return LineMove(here, tool, rpy)
    if kind == "arc":
        return ArcMove(_over(experiment.robot, _end_of(before, experiment), here), here, tool, rpy)
    if kind == "joint":
        return JointMove(tuple(experiment.q.tolist()))
    return Wait() if kind == "wait" else Gripper(0.0 if _opening_after(before) > 0.0 else 1.0)


def _opening_after(moves: Program) -> float:
    return next((move.opening for move in reversed(moves) if isinstance(move, Gripper)), 1.0)


def _over(robot: Robot, start: Triple, end: Triple) -> Triple:
    """Above the middle of the way."""
    first, last = np.array(start), np.array(end)
    rise = _ARC_HEIGHT * max(float(np.linalg.norm(last - first)), _SHORTEST_CHORD * robot.size)
    return _triple(0.5 * (first + last) + (0.0, 0.0, rise))


def _end_of(moves: Program, experiment: Experiment) -> Triple:
    """Where the tool is after these moves."""
    robot, poses = experiment.robot, {pose.name: pose.q for pose in experiment.poses}
    for move in reversed(moves):
        if isinstance(move, LineMove | ArcMove):
            return move.to
        if isinstance(move, JointMove):
            q = poses.get(move.pose, experiment.q) if move.pose else np.array(move.q)
            return _place(robot, q if len(q) == robot.dof else experiment.q)
    return _place(robot, experiment.q)


def _place(robot: Robot, q: FloatArray) -> Triple:
    return _triple(forward_kinematics(robot, q)[:3, 3])


def _triple(point: FloatArray) -> Triple:
    x, y, z = point.tolist()
    return x, y, z
