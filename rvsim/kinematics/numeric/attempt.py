"""One try of a solver: steps from one start until a rule ends it."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from rvsim.kinematics.numeric.methods import Method
from rvsim.kinematics.numeric.options import Solver, SolverOptions
from rvsim.kinematics.numeric.problem import Evaluation, Problem
from rvsim.kinematics.numeric.result import History, Kind
from rvsim.kinematics.numeric.step import Step
from rvsim.spatial.arrays import FloatArray

Clock = Callable[[], float]
# The cost must fall to this part to count as progress; slower, a thousand iterations would not be enough.
_PROGRESS = 0.5


class Budget:
    """Iterations and time, shared by all tries."""

    def __init__(self, options: SolverOptions, clock: Clock) -> None:
        self._options, self._clock = options, clock
        self._began = clock()
        self.iterations = 0

    @property
    def elapsed(self) -> float:
        """Seconds since the beginning."""
        return self._clock() - self._began

    def spent(self) -> Kind | None:
        """The rule by which nothing is left."""
        if self.iterations >= self._options.max_iterations:
            return "iterations"
        return "time" if self.elapsed >= self._options.max_time else None


class Attempt(NamedTuple):
    """A try that has ended: the rule, the iterates with the damping that led to each, the last being its result."""

    kind: Kind
    iterates: list[tuple[Evaluation, float]]

    @property
    def end(self) -> Evaluation:
        """Its result."""
        return self.iterates[-1][0]

    @property
    def history(self) -> History:
        """Its iterates as arrays."""
        places = [place for place, _ in self.iterates]
        return History(
            np.array([place.q for place in places]),
            np.array([place.position_error for place in places]),
            np.array([place.rotation_error for place in places]),
            np.array([damping for _, damping in self.iterates]),
        )


def attempt(problem: Problem, method: Method, solver: Solver, q0: FloatArray, budget: Budget) -> Attempt:
    """Step from q0 (n,), put into the limits, until a rule says stop."""
    here = problem.evaluate(problem.bounds.clamped(problem.bounds.folded(q0)))
    iterates = [(here, 0.0)]
    rules = _Rules(problem, solver, here)
    kind = rules.at(here)
    while kind is None:
        kind = budget.spent()
        if kind is None:
            step = method.step(here)
            budget.iterations += 1
            kind = rules.after(here, step)
            here = step.there
            iterates.append((here, step.damping))
    best = min(iterates, key=lambda iterate: iterate[0].cost)
    if kind != "solved" and best[0].cost < here.cost:
        iterates.append((best[0], 0.0))
    return Attempt(kind, iterates)


class _Rules:
    """The rules that end a try; they remember when it last came nearer."""

    def __init__(self, problem: Problem, solver: Solver, start: Evaluation) -> None:
        self._problem, self._solver = problem, solver
        self._best, self._waited = start.cost, 0

    def at(self, here: Evaluation) -> Kind | None:
        """What the place alone says."""
        if self._problem.solved(here):
            return "solved"
        slope = float(np.linalg.norm(here.gradient[self._problem.free(here)]))
        return "gradient" if slope < self._problem.options.gradient_tolerance else None

    def after(self, here: Evaluation, step: Step) -> Kind | None:
        """What the place reached and the step to it say."""
        options, there = self._problem.options, step.there
        if kind := self.at(there):
            return kind
        if np.max(np.abs(step.motion)) < options.step_tolerance:
            return "step"
        if self._solver == "lm" and np.max(np.abs(there.error - here.error)) < options.error_change_tolerance:
            return "change"
        return "progress" if self._stuck(there.cost) else None

    def _stuck(self, cost: float) -> bool:
        if cost < _PROGRESS * self._best:
            self._best, self._waited = cost, 0
        else:
            self._waited += 1
        return self._waited >= self._problem.options.patience
