"""What is to be made small: the weighted error of one pose, with its slope, for joints within limits."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from rvsim.kinematics.jacobian import pose_and_jacobian
from rvsim.kinematics.numeric.bounds import bounds_of
from rvsim.kinematics.numeric.options import SolverOptions, Task
from rvsim.robot import Robot
from rvsim.spatial import rotation_error
from rvsim.spatial.arrays import FloatArray

# Below this sine of an obtuse angle its axis is better found by the careful formula.
_HALF_TURN = 1e-4
_SMALL_ANGLE = 1e-3


class Evaluation(NamedTuple):
    """Joints and how far they are from the target.

    Args:
        q: (n,) [rad, m].
        error: (k,) what is missing: rotation vector [rad] (task "pose" only), then position / length.
        J: (k, n) how the joints change it, to first order.
        cost: ½ Σ weight · error².
        gradient: (n,) of the cost, exactly.
        solution_error: |weight · error|.
        position_error, rotation_error: distance [m] and angle [rad], whatever the task.
    """

    q: FloatArray
    error: FloatArray
    J: FloatArray
    cost: float
    gradient: FloatArray
    solution_error: float
    position_error: float
    rotation_error: float


class Move(NamedTuple):
    """Where a step leads: the joints, and the motion that was possible."""

    q: FloatArray
    motion: FloatArray


class Problem:
    """An arm, a target T (4, 4), a task and the settings; `weights` (k,) are those of the task's error."""

    def __init__(self, robot: Robot, T: FloatArray, task: Task, options: SolverOptions) -> None:
        self.robot, self.options, self.task = robot, options, task
        self.bounds = bounds_of(robot, options.enforce_joint_limits)
        weights = np.array(options.weights)
        self.weights = weights if task == "pose" else weights[3:]
        self._R, self._p = T[:3, :3], T[:3, 3]

    def evaluate(self, q: FloatArray) -> Evaluation:
        """The errors and their slopes at q (n,)."""
        T, J = pose_and_jacobian(self.robot, q)
        missing = self._p - T[:3, 3]
        turn = _rotation_error(T[:3, :3], self._R)
        error, slopes = missing / self.options.length, J[:3] / self.options.length
        if self.task == "pose":
            error, slopes = np.concatenate([turn, error]), np.concatenate([J[3:], slopes])
        weighted = self.weights * error
        return Evaluation(
            q=q,
            error=error,
            J=slopes,
            cost=0.5 * float(weighted @ error),
            gradient=-(self._pulled_back(weighted, turn) @ slopes),
            solution_error=math.sqrt(weighted @ weighted),
            position_error=math.sqrt(missing @ missing),
            rotation_error=math.sqrt(turn @ turn),
        )

    def _pulled_back(self, weighted: FloatArray, turn: FloatArray) -> FloatArray:
        """The weighted error as the angular velocity feels it: the rotation vector's own rate is not ω (unless equal).

        J_r^-T v = v − ½ φ × v + c φ × (φ × v) (Chirikjian 2011, §10.8.5; Solà et al. 2018, eq. 144).
        """
        if self.task == "position" or np.ptp(self.weights[:3]) == 0.0:
            return weighted
        v = weighted[:3]
        once = np.cross(turn, v)
        pulled = v - 0.5 * once + _second_factor(math.sqrt(turn @ turn)) * np.cross(turn, once)
        return np.concatenate([pulled, weighted[3:]])

    def solved(self, here: Evaluation) -> bool:
        """Whether every tolerance of the task is kept."""
        options = self.options
        turned = self.task == "position" or here.rotation_error <= options.rotation_tolerance
        placed = here.position_error <= options.position_tolerance
        return placed and turned and here.solution_error <= options.solution_tolerance

    def free(self, here: Evaluation) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
        """(n,) which joints may move: not those that lean against a stop."""
        return np.logical_not(self.bounds.held(here.q, here.gradient))

    def move(self, q: FloatArray, motion: FloatArray) -> Move:
        """Go from q by a motion (n,), as far as the limits let each joint."""
        folded = self.bounds.folded(q + motion)
        there = self.bounds.clamped(folded)
        return Move(there, motion + (there - folded))

    def shortened(self, motion: FloatArray) -> FloatArray:
        """A motion in the same direction within the step limit."""
        longest = float(np.max(np.abs(motion)))
        return motion if longest <= self.options.step_limit else motion * (self.options.step_limit / longest)


def _rotation_error(R: FloatArray, R_target: FloatArray) -> FloatArray:
    """The rotation vector (3,) from R to the target; quick, because every iteration needs one."""
    E = R_target @ R.T
    double_sine = np.array([E[2, 1] - E[1, 2], E[0, 2] - E[2, 0], E[1, 0] - E[0, 1]])
    sine, cosine = 0.5 * math.sqrt(double_sine @ double_sine), 0.5 * (E[0, 0] + E[1, 1] + E[2, 2] - 1.0)
    if sine < _HALF_TURN and cosine < 0.0:
        return rotation_error(R, R_target)
    return np.asarray(double_sine * (0.5 * math.atan2(sine, cosine) / sine if sine > 0.0 else 0.5))


def _second_factor(angle: float) -> float:
    """c = 1/θ² − (1 + cos θ)/(2 θ sin θ), which is 1/12 at 0 and 1/π² at π."""
    if angle < _SMALL_ANGLE:
        return 1.0 / 12.0 + angle * angle / 720.0
    half = 0.5 * angle
    return (1.0 - half * math.cos(half) / math.sin(half)) / (angle * angle)
