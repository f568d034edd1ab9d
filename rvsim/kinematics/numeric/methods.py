"""The four solvers as one thing: a method that, from where it is, takes a step."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import Protocol

import numpy as np

from rvsim.kinematics.numeric.gradient_projection import GradientProjection
from rvsim.kinematics.numeric.options import Solver
from rvsim.kinematics.numeric.problem import Evaluation, Problem
from rvsim.kinematics.numeric.step import Step
from rvsim.spatial.arrays import FloatArray

# Singular values below this part of the largest one count as 0: their direction cannot be moved in.
_RANK = 1e-9
# The error (weighted, in radians and lengths) below which constant damping fades.
_SMALL_ERROR = 0.01
# How fast the damping grows after a step uphill, and up to which factor.
_MORE, _MOST_CAUTION = 8.0, 1e9


# λ of (JᵀWJ + λ 1) Δq = JᵀW e; 0 stands for the pseudoinverse.
Damping = Callable[[Problem, Evaluation], float]


class Method(Protocol):
    """One try of a solver; it may remember earlier steps."""

    def step(self, here: Evaluation) -> Step:
        """One iteration."""
        ...


class LeastSquares:
    """Newton–Raphson, damped least squares and Levenberg–Marquardt, which differ in their damping only.

    Joints that lean against a stop are left out of the system, so the others make up for them.
    """

    def __init__(self, problem: Problem, damping: Damping) -> None:
        self._problem, self._damping = problem, damping
        self._roots = np.sqrt(problem.weights)

    def step(self, here: Evaluation) -> Step:
        """Solve the linear system with the damping of the rule."""
        return self.damped_step(here, self._damping(self._problem, here))

    def damped_step(self, here: Evaluation, damping: float) -> Step:
        """Solve the linear system, shorten the motion to the step limit, stop at the limits."""
        problem = self._problem
        free = problem.free(here)
        motion = np.zeros(len(here.q))
        if free.any():
            J = (self._roots[:, None] * here.J)[:, free]
            motion[free] = _least_squares(J, self._roots * here.error, damping)
        q, motion = problem.move(here.q, problem.shortened(motion))
        return Step(problem.evaluate(q), motion, damping)


class LevenbergMarquardt:
    """Error-damped least squares that takes no step uphill: it damps more until the cost falls.

    The damping alone (Sugihara 2011) lets the iterates jump to and fro where the error is small and the cost curved;
    Marquardt's rule (1963, §3) ends that. The caution is kept for the next step, and relaxed when a step succeeds.
    """

    def __init__(self, problem: Problem) -> None:
        self._problem = problem
        self._system = LeastSquares(problem, _none)
        self._caution = 1.0

    def step(self, here: Evaluation) -> Step:
        """The least damped step that lowers the cost; the last one tried if none does."""
        damping = _by_error(self._problem, here)
        step = self._system.damped_step(here, damping * self._caution)
        while damping > 0.0 and step.there.cost > here.cost and self._caution < _MOST_CAUTION:
            self._caution *= _MORE
            step = self._system.damped_step(here, damping * self._caution)
        self._caution = max(1.0, self._caution / _MORE)
        return step


def _least_squares(J: FloatArray, error: FloatArray, damping: float) -> FloatArray:
    """Δq (n,) of (JᵀJ + λ 1) Δq = Jᵀ e; of least length where the damping is 0 or too small to count."""
    if damping > 0.0:
        with suppress(np.linalg.LinAlgError):
            return np.asarray(np.linalg.solve(J.T @ J + damping * np.eye(J.shape[1]), J.T @ error), np.float64)
    return np.asarray(np.linalg.lstsq(J, error, rcond=_RANK)[0])


def _none(_problem: Problem, _here: Evaluation) -> float:
    """Newton–Raphson: Δq = J⁺ e (source 002; Siciliano et al. 2009, §3.7.1)."""
    return 0.0


def _constant(problem: Problem, here: Evaluation) -> float:
    """Damped least squares: λ² (Wampler 1986, eq. 13; Nakamura and Hanafusa 1986), until the error is small.

    From there it fades with the error's square (after Chan and Lawrence 1988): a damping that stays would creep towards
    a target that is nearly singular, and never arrive.
    """
    return problem.options.damping**2 * min(1.0, here.solution_error / _SMALL_ERROR) ** 2


def _by_error(problem: Problem, here: Evaluation) -> float:
    """Levenberg–Marquardt: the cost and a bias (Sugihara 2011, eq. 10 and 13)."""
    options = problem.options
    return here.cost + options.damping_bias if options.use_error_damping else 0.0


_METHODS: dict[Solver, Callable[[Problem], Method]] = {
    "newton": lambda problem: LeastSquares(problem, _none),
    "dls": lambda problem: LeastSquares(problem, _constant),
    "lm": LevenbergMarquardt,
    "bfgs": GradientProjection,
}


def new_method(solver: Solver, problem: Problem) -> Method:
    """A method at the beginning of a try."""
    return _METHODS[solver](problem)
