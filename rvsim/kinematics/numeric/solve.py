"""The front door of the numeric solvers: one pose, one start, and random restarts if they are allowed."""

from __future__ import annotations

import time

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import ShapeError
from rvsim.kinematics.dh import one_pose
from rvsim.kinematics.numeric.attempt import Attempt, Budget, Clock, attempt
from rvsim.kinematics.numeric.bounds import start_ranges
from rvsim.kinematics.numeric.methods import new_method
from rvsim.kinematics.numeric.options import Solver, SolverOptions, checked_solver, checked_task
from rvsim.kinematics.numeric.problem import Problem
from rvsim.kinematics.numeric.result import ENDING, Kind, NumericResult, reason_in_words
from rvsim.kinematics.numeric.target import target_poses
from rvsim.robot import Robot
from rvsim.spatial.arrays import FloatArray

_DEFAULTS = SolverOptions()


def solve_numeric(
    robot: Robot,
    T: ArrayLike,
    q0: ArrayLike | None = None,
    solver: str = "lm",
    *,
    task: str = "pose",
    options: SolverOptions = _DEFAULTS,
    clock: Clock = time.perf_counter,
) -> NumericResult:
    """Joints for the pose T (4, 4), by iteration from q0 (n,).

    Works for every arm. `converged` means that the residual is below the tolerances and, if enforced, q within the
    limits; a pose that the arm cannot take ends with `converged` False, a reason, and the least residual found.

    Args:
        robot: the arm.
        T: the target, base → tool.
        q0: the start [rad, m], None for the arm's home; put into the limits if they are enforced.
        solver: "newton" (Newton–Raphson), "dls" (damped least squares), "lm" (error-damped Levenberg–Marquardt),
            "bfgs" (BFGS gradient projection).
        task: "pose", or "position" if any orientation will do.
        options: tolerances, weights, and the rules by which it ends.
        clock: tells the seconds for `max_time` and `elapsed`.

    Raises:
        ShapeError: T is not (4, 4), q0 not (n,). PoseError: T is no pose. SettingError: q0 is not finite.
        UnknownNameError: no such solver or task.
    """
    chosen, asked = checked_solver(solver), checked_task(task)
    target = target_poses(T, asked)
    if target.ndim != 2:
        raise ShapeError("T", "(4, 4)", target.shape)
    start = robot.home if q0 is None else one_pose(robot, q0, "q0")
    return _search(Problem(robot, target, asked, options), chosen, start, Budget(options, clock))


def _search(problem: Problem, solver: Solver, start: FloatArray, budget: Budget) -> NumericResult:
    """Tries until one solves it or nothing is left; the best is kept."""
    best = _attempt(problem, solver, start, budget)
    kind, restarts = best.kind, 0
    random = np.random.default_rng(problem.options.seed)
    low, high = start_ranges(problem.robot, problem.bounds).T
    while problem.options.allow_random_restarts and kind not in ENDING:
        another = _attempt(problem, solver, random.uniform(low, high), budget)
        restarts += 1
        # A try that ends where it began has used up nothing: of such there would be no end.
        budget.iterations += len(another.iterates) == 1
        kind = another.kind if another.kind in ENDING else budget.spent() or another.kind
        if kind == "solved" or another.end.cost < best.end.cost:
            best = another
    return _result(best, kind, restarts, budget)


def _attempt(problem: Problem, solver: Solver, start: FloatArray, budget: Budget) -> Attempt:
    return attempt(problem, new_method(solver, problem), solver, start, budget)


def _result(best: Attempt, kind: Kind, restarts: int, budget: Budget) -> NumericResult:
    return NumericResult(
        q=best.end.q,
        converged=kind == "solved",
        kind=kind,
        reason=reason_in_words(kind, best.kind, restarts),
        iterations=budget.iterations,
        restarts=restarts,
        position_error=best.end.position_error,
        rotation_error=best.end.rotation_error,
        elapsed=budget.elapsed,
        history=best.history,
    )
