"""What the numeric solvers can be told. The names are those of source 000 (MATLAB's inverse kinematics), §6.2."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, get_args

from rvsim.errors import SettingError, UnknownNameError
from rvsim.language import tr

Task = Literal["pose", "position"]
Solver = Literal["newton", "dls", "lm", "bfgs"]
TASKS: tuple[Task, ...] = get_args(Task)
SOLVERS: tuple[Solver, ...] = get_args(Solver)


@dataclass(frozen=True)
class SolverOptions:
    """Settings of `solve_numeric`; in brackets their MATLAB names, and which solvers read them if not all do.

    The error of a pose is (rotation vector [rad], distance / `length`), orientation first as in source 000; its cost is
    ½ Σ weight · error². A try ends at the first of these rules, a solution found comes first.

    Args:
        max_iterations: of all tries together [MaxIterations].
        max_time: of all tries together, in seconds of the clock given [MaxTime].
        gradient_tolerance: on the norm of the cost's gradient, without joints held at a stop [GradientTolerance].
        solution_tolerance: on the norm of weight · error; a solution must be below it as well [SolutionTolerance].
        step_tolerance: on the largest joint motion of a step [rad, m] [StepTolerance].
        enforce_joint_limits: no iterate ever leaves the limits [EnforceJointLimits].
        allow_random_restarts: after a try that failed, another from a random start [AllowRandomRestarts].
        error_change_tolerance: ends a try when no entry of the error changes more [ErrorChangeTolerance; lm].
        damping_bias: the damping that stays when the error is gone [DampingBias; lm].
        use_error_damping: damp by the cost plus the bias; if not, not at all [UseErrorDamping; lm].
        weights: six, of the rotation about x, y, z, then of the position along x, y, z, in base axes.
        length: the distance that counts as one [m]; 0.1 weighs as source 000 does, whose lengths are decimetres.
        position_tolerance, rotation_tolerance: what a solution must keep [m], [rad].
        damping: λ of damped least squares while the error is above 0.01; below it fades [dls].
        step_limit: the largest joint motion of one step [rad, m]; longer steps are shortened.
        patience: ends a try whose cost has not halved in so many iterations.
        seed: of the random restarts.
    """

    max_iterations: int = 1500
    max_time: float = 10.0
    gradient_tolerance: float = 1e-10
    solution_tolerance: float = 1e-6
    step_tolerance: float = 1e-14
    enforce_joint_limits: bool = True
    allow_random_restarts: bool = True
    error_change_tolerance: float = 1e-12
    damping_bias: float = 1e-10
    use_error_damping: bool = True
    weights: tuple[float, float, float, float, float, float] = (1.0, 1.0, 1.0, 1.0, 1.0, 1.0)
    length: float = 1.0
    position_tolerance: float = 1e-6
    rotation_tolerance: float = 1e-6
    damping: float = 0.03
    step_limit: float = 1.0
    patience: int = 25
    seed: int = 0

    def __post_init__(self) -> None:
        for name in _POSITIVE:
            if not getattr(self, name) > 0.0:
                raise SettingError(name, getattr(self, name), tr("above 0"))
        if len(self.weights) != 6 or not all(0.0 <= weight < math.inf for weight in self.weights):
            raise SettingError("weights", self.weights, tr("six numbers of at least 0"))
        _check_range("weights", max(self.weights), 0.0, _LARGEST)
        for name, (least, most) in _WITHIN.items():
            _check_range(name, getattr(self, name), least, most)


def _check_range(name: str, value: float, least: float, most: float) -> None:
    if not least <= value <= most:
        rule = tr("a finite number at least {least:g} and at most {most:g}", least=least, most=most)
        raise SettingError(name, value, rule)


_LARGEST = 1e9  # of what is squared and multiplied: beyond it there is nothing to find, and numbers overflow
_WITHIN = {
    "length": (1e-9, _LARGEST),
    "damping": (0.0, _LARGEST),
    "damping_bias": (0.0, _LARGEST),
    "seed": (0, 2**63 - 1),
}
_POSITIVE = ("max_iterations", "max_time", "length", "position_tolerance", "rotation_tolerance", "step_limit")


def checked_task(task: str) -> Task:
    """The task of that name.

    Raises:
        UnknownNameError: there is none.
    """
    for known in TASKS:
        if task == known:
            return known
    raise UnknownNameError("numeric task", task, TASKS)


def checked_solver(solver: str) -> Solver:
    """The solver of that name.

    Raises:
        UnknownNameError: there is none.
    """
    for known in SOLVERS:
        if solver == known:
            return known
    raise UnknownNameError("numeric solver", solver, SOLVERS)
