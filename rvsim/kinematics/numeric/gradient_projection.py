"""BFGS gradient projection: the cost modelled by a parabola learnt from gradients alone, the path bent at the limits.

A method of our own rather than scipy's L-BFGS-B: its iterates, each within the limits, are what the laboratory draws,
and with at most a handful of joints a full matrix is smaller than a limited memory.
Sources: Bertsekas, SIAM J. Control Optim. 20 (1982), for the joints that are held and the projected path; Nocedal and
Wright, Numerical Optimization (2006), §6.1 and procedure 18.2, for the update.
"""

from __future__ import annotations

import numpy as np

from rvsim.kinematics.numeric.problem import Evaluation, Problem
from rvsim.kinematics.numeric.step import Step
from rvsim.spatial.arrays import FloatArray

# A step must lower the cost by this part of what the slope promises (Armijo).
_SUFFICIENT = 1e-4
_HALVINGS = 50
# The curvature along a step is taken to be at least this part of the model's (Powell).
_LEAST_CURVATURE = 0.2


class GradientProjection:
    """One try; `_model` (n, n) is the estimate of the cost's second derivatives, always positive definite."""

    def __init__(self, problem: Problem) -> None:
        self._problem = problem
        self._model: FloatArray | None = None

    def step(self, here: Evaluation) -> Step:
        """Go down the model's slope in the free joints, half as far until the cost falls enough."""
        model = self._first_model(here) if self._model is None else self._model
        free = self._problem.free(here)
        direction = np.zeros(len(here.q))
        direction[free] = -np.linalg.solve(model[np.ix_(free, free)], here.gradient[free])
        step = self._search(here, self._problem.shortened(direction))
        self._model = _updated(model, step.motion, step.there.gradient - here.gradient)
        return step

    def _first_model(self, here: Evaluation) -> FloatArray:
        """A sphere as steep as the cost is on average, so that the first step has the right size."""
        n = len(here.q)
        steepness = float(np.sum(self._problem.weights[:, None] * here.J**2)) / n
        return np.eye(n) * max(steepness, 1e-9)

    def _search(self, here: Evaluation, direction: FloatArray) -> Step:
        part = 1.0
        for _ in range(_HALVINGS):
            q, motion = self._problem.move(here.q, part * direction)
            there = self._problem.evaluate(q)
            if there.cost <= here.cost + _SUFFICIENT * float(here.gradient @ motion):
                return Step(there, motion, 0.0)
            part *= 0.5
        return Step(here, np.zeros(len(here.q)), 0.0)


def _updated(model: FloatArray, motion: FloatArray, change: FloatArray) -> FloatArray:
    """The BFGS update for a motion and the gradient's change, damped so that the model stays positive definite."""
    modelled = model @ motion
    curvature = float(motion @ modelled)
    if curvature <= 0.0:
        return model
    measured = float(motion @ change)
    if measured < _LEAST_CURVATURE * curvature:
        share = (1.0 - _LEAST_CURVATURE) * curvature / (curvature - measured)
        change = share * change + (1.0 - share) * modelled
        measured = float(motion @ change)
    return np.asarray(model + np.outer(change, change) / measured - np.outer(modelled, modelled) / curvature)
