"""A program becomes a motion: move after move from where the arm is, until the end or the first that cannot be done."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import NoClosedFormError
from rvsim.kinematics import forward_kinematics
from rvsim.motion.moves import ArcMove, Gripper, JointMove, LineMove, Move, Wait
from rvsim.motion.path import Path
from rvsim.motion.shapes import arc_through
from rvsim.motion.tracking import find_jumps, track
from rvsim.motion.tracking_result import Tracking
from rvsim.motion.trajectory import Law, Stretch, Trajectory, joint_move, trajectory_of
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray, frozen_array
from rvsim.spatial import rot_y, rot_z, rotation_from_rpy, rotation_from_vector, rotation_vector

ProblemKind = Literal["pose", "joints", "limits", "path", "branch", "tolerance", "no closed form"]
TOLERANCE = 1e-4  # how far the tool may be beside its line or arc, in sizes of the arm

_STEP, _TURN_STEP = 0.01, math.radians(2.0)  # between the points of a line: in sizes of the arm, of its turning
_FEWEST, _MOST = 9, 2001
_BETWEEN = 4  # places on each piece where the tool is looked at
_DOUBLINGS = 3
_SHORTEST = 1e-3  # [s]
_SLOWEST = 0.01  # share of the speed
_IN_PLANE = 1e-6  # of a unit axis


@dataclass(frozen=True, eq=False)
class Problem:
    """Why a move cannot be done.

    Args:
        kind: "pose", no remembered pose has that name; "joints", the numbers are those of another arm; "limits",
            `joint` would be at `value` but stops at `limit` [rad, m]; "path", `tracking` has missed points; "branch",
            the arm would have to leave the way to change its branch; "tolerance", the tool would be `value` [m] beside
            its way; "no closed form", the arm has none.
    """

    kind: ProblemKind
    joint: str = ""
    value: float = 0.0
    limit: float = 0.0
    tracking: Tracking | None = None


class _CannotError(Exception):
    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        super().__init__(problem.kind)


@dataclass(frozen=True, eq=False)
class Plan:
    """What comes of a program that begins in q (n,).

    Args:
        steps: the stretch of each move that can be done, in order: all before the first that cannot.
        problem: why move number len(steps), counted from 0, cannot be done; None where all can.
    """

    robot: Robot
    q: FloatArray
    moves: tuple[Move, ...]
    steps: tuple[Stretch, ...]
    problem: Problem | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "q", frozen_array("q", self.q, (self.robot.dof,)))

    @property
    def complete(self) -> bool:
        """Whether every move can be done."""
        return self.problem is None

    @cached_property
    def trajectory(self) -> Trajectory | None:
        """The motion as far as it can be done; None when that is nothing."""
        return Trajectory(self.steps) if self.steps else None

    @cached_property
    def starts(self) -> FloatArray:
        """(steps + 1,) when each move begins, and the end [s]."""
        return np.concatenate([[0.0], np.cumsum([step.duration for step in self.steps])])

    def move_at(self, t: float) -> int:
        """The index of the move that is being done at t [s], clamped."""
        return int(np.clip(np.searchsorted(self.starts, t, side="right") - 1, 0, max(len(self.steps) - 1, 0)))

    def opening_at(self, t: float, before: float = 1.0) -> float:
        """How far the gripper is open at t [s], 0…1, when it was `before` open at first; it moves evenly."""
        opening = before
        for move, start, end in zip(self.moves, self.starts, self.starts[1:], strict=False):
            if isinstance(move, Gripper) and t > start:
                opening += (move.opening - opening) * min((t - start) / (end - start), 1.0)
        return float(opening)


def plan_program(
    robot: Robot,
    q: ArrayLike,
    moves: Sequence[Move],
    *,
    poses: Mapping[str, FloatArray] | None = None,
    ignore_limits: bool = False,
    law: Law = "quintic",
) -> Plan:
    """Each move from where the one before ends, from rest to rest, at its share of the speed that the joints may have.

    The tool stays within `TOLERANCE` of its lines and arcs.

    Args:
        q: (n,) where the arm is.
        poses: the remembered ones by name, (n,) each.
        ignore_limits: leave the joint limits out of account.
    """
    start = frozen_array("q", q, (robot.dof,))
    planner = _Planner(robot, dict(poses or {}), ignore_limits, law)
    steps: list[Stretch] = []
    for move in moves:
        try:
            steps.append(planner.stretch(steps[-1].q[-1] if steps else start, move))
        except _CannotError as cannot:
            return Plan(robot, start, tuple(moves), tuple(steps), cannot.problem)
    return Plan(robot, start, tuple(moves), tuple(steps))


@dataclass(frozen=True)
class _Planner:
    robot: Robot
    poses: dict[str, FloatArray]
    ignore_limits: bool
    law: Law

    def stretch(self, q: FloatArray, move: Move) -> Stretch:
        if isinstance(move, JointMove):
            return self._joint(q, move)
        if isinstance(move, LineMove | ArcMove):
            return self._cartesian(q, move)
        seconds = move.seconds if isinstance(move, Wait | Gripper) else 0.0
        return Stretch(max(seconds, _SHORTEST), np.array([0.0, 1.0]), np.array([q, q]), np.zeros(2))

    def _joint(self, q: FloatArray, move: JointMove) -> Stretch:
        goal = self._goal(move)
        outside = np.maximum(self.robot.limits[:, 0] - goal, goal - self.robot.limits[:, 1])
        worst = int(np.argmax(outside))
        if outside[worst] > 1e-9 and not self.ignore_limits:
            limit = self.robot.limits[worst, 0 if goal[worst] < self.robot.limits[worst, 0] else 1]
            name = self.robot.joint_names[worst]
            raise _CannotError(Problem("limits", name, float(goal[worst]), float(limit)))
        return _slowed(joint_move(self.robot, q, goal, seconds=0.0, law=self.law).stretches[0], move.speed)

    def _goal(self, move: JointMove) -> FloatArray:
        if move.pose and move.pose not in self.poses:
            raise _CannotError(Problem("pose"))
        goal = self.poses[move.pose] if move.pose else np.array(move.q)
        if len(goal) != self.robot.dof:
            raise _CannotError(Problem("joints"))
        return goal

    def _cartesian(self, q: FloatArray, move: LineMove | ArcMove) -> Stretch:
        samples = self._samples(q, move)
        for _ in range(_DOUBLINGS + 1):
            path, dense = self._path(q, move, samples)
            made = self._along(q, path)
            deviation = _deviation(self.robot, made, dense)
            if deviation <= TOLERANCE * self.robot.size:
                return _slowed(made, move.speed)
            samples = 2 * samples - 1
        raise _CannotError(Problem("tolerance", value=deviation))

    def _samples(self, q: FloatArray, move: LineMove | ArcMove) -> int:
        T = forward_kinematics(self.robot, q)
        points = _way(T[:3, 3], move, _FEWEST)
        length = float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
        angle = 0.0
        if move.tool == "turn":
            angle = float(np.linalg.norm(rotation_vector(rotation_from_rpy(move.rpy) @ T[:3, :3].T)))
        return int(np.clip(math.ceil(max(length / (_STEP * self.robot.size), angle / _TURN_STEP)) + 1, _FEWEST, _MOST))

    def _path(self, q: FloatArray, move: LineMove | ArcMove, samples: int) -> tuple[Path, FloatArray]:
        """The points to be tracked, and the places between them as well."""
        T = forward_kinematics(self.robot, q)
        dense = _way(T[:3, 3], move, (samples - 1) * _BETWEEN + 1)
        points = dense[::_BETWEEN]
        rotations = self._rotations(T, points, move)
        return Path("move", points, rotations, known_corners=np.empty(0, dtype=np.intp)), dense

    def _rotations(self, T: FloatArray, points: FloatArray, move: LineMove | ArcMove) -> FloatArray | None:
        if move.tool == "free" or self.robot.dof < 4:
            return None
        share = np.linspace(0.0, 1.0, len(points))[:, None]
        # The tool of a 5R arm goes round with its waist, as it must.
        round_z = rot_z(np.arctan2(points[:, 1], points[:, 0])) if self.robot.dof == 5 else np.eye(3)[None]
        first = round_z[0].T @ T[:3, :3]
        last = round_z[-1].T @ rotation_from_rpy(move.rpy) if move.tool == "turn" else first
        between = _pitched_and_rolled(first, last, share) if self.robot.dof == 5 else None
        if between is None:
            between = rotation_from_vector(share * rotation_vector(last @ first.T)) @ first
        return np.asarray(round_z @ between)

    def _along(self, q: FloatArray, path: Path) -> Stretch:
        """From q through all points but the first, where the arm is already, in whatever branch it is in."""
        try:
            tracking = track(self.robot, path.part(slice(1, None)), near=q, ignore_limits=self.ignore_limits)
        except NoClosedFormError:
            raise _CannotError(Problem("no closed form")) from None
        if not tracking.complete:
            raise _CannotError(Problem("path", tracking=tracking))
        all_q = np.concatenate([q[None], tracking.q])
        if find_jumps(self.robot, all_q, path.rotations is not None):
            raise _CannotError(Problem("branch"))
        whole = Tracking(self.robot, path, all_q, (), ignore_limits=self.ignore_limits)
        motion = trajectory_of(whole, q, path_seconds=0.0, approach_seconds=0.0, law=self.law)
        assert motion is not None
        return motion.stretches[-1]


def _way(start: FloatArray, move: LineMove | ArcMove, samples: int) -> FloatArray:
    """(samples, 3) evenly along the line or the arc."""
    share = np.linspace(0.0, 1.0, samples)[:, None]
    if isinstance(move, LineMove):
        return np.asarray((1.0 - share) * start + share * np.array(move.to))
    points = arc_through(start, move.via, move.to, samples)
    return points if len(points) == samples else np.asarray((1.0 - share) * start + share * np.array(move.to))


def _pitched_and_rolled(first: FloatArray, last: FloatArray, share: FloatArray) -> FloatArray | None:
    """(m, 3, 3) from one orientation to another with the tool axis in the xz plane all the way, as a 5R arm has it.

    Each is Ry(pitch) Rz(roll), and both angles change evenly. None where the axis of one of them leaves the plane.
    """
    if max(abs(first[1, 2]), abs(last[1, 2])) > _IN_PLANE:
        return None
    pitches, rolls = [], []
    for R in (first, last):
        pitches.append(math.atan2(R[0, 2], R[2, 2]))
        level = rot_y(-pitches[-1]) @ R
        rolls.append(math.atan2(level[1, 0], level[0, 0]))
    pitch, roll = (a + share[:, 0] * math.remainder(b - a, math.tau) for a, b in (pitches, rolls))
    return np.asarray(rot_y(pitch) @ rot_z(roll))


def _slowed(stretch: Stretch, speed: float) -> Stretch:
    """From the quickest to a share of its speed; all of it counts as the path."""
    duration = max(stretch.duration / min(max(speed, _SLOWEST), 1.0), _SHORTEST)
    return replace(stretch, duration=duration, progress=np.zeros(len(stretch.knots)), phase="path")


def _deviation(robot: Robot, stretch: Stretch, dense: FloatArray) -> float:
    """How far the tool leaves the way whose places (k, 3) are given, `_BETWEEN` a knot, across the way [m]."""
    between = np.interp(np.arange(len(dense)) / _BETWEEN, np.arange(len(stretch.knots)), stretch.knots)
    away = forward_kinematics(robot, stretch.way.at(between).q)[:, :3, 3] - dense
    tangents = np.gradient(dense, axis=0)
    tangents /= np.maximum(np.linalg.norm(tangents, axis=1, keepdims=True), 1e-300)
    across = away - np.sum(away * tangents, axis=1, keepdims=True) * tangents
    return float(np.linalg.norm(across, axis=1).max())
