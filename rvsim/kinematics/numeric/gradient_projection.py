"""BFGS gradient projection: the cost modelled by a parabola learnt from gradients alone, the path bent at the limits.

A method of our own rather than scipy's L-BFGS-B: its iterates, each within the limits, are what the laboratory draws,
and with at most a handful of joints a full matrix is smaller than a limited memory.
Sources: Bertsekas, SIAM J. Control Optim. 20 (1982), for the joints that are held and the projected path; Nocedal and
Wright, Numerical Optimization (2006), §6.1, for the update.
"""

from __future__ import annotations

from contextlib import suppress

import numpy as np

from rvsim.kinematics.numeric.problem import Evaluation, Problem
from rvsim.kinematics.numeric.step import Step
from rvsim.spatial.arrays import FloatArray

# A step must lower the cost by this part of what the slope promises (Armijo).
_SUFFICIENT = 1e-4
_HALVINGS = 40
# The model learns from a step only if the curvature along it is at least this part of the model's own; what it learns
# from a saddle would make it singular (Li and Fukushima 2001, the cautious update).
_LEAST_CURVATURE = 1e-3
_SMALLEST = 1e-30  # below it, products of motions are rounding


class GradientProjection:
    """One try; `_model` (n, n) is the estimate of the cost's second derivatives, always positive definite."""

    def __init__(self, problem: Problem) -> None:
        self._problem = problem
        self._model: FloatArray | None = None

    def step(self, here: Evaluation) -> Step:
        """Go down the model's slope in the free joints; a model that shows no way down is given up for a new one."""
        first = self._first_model(here)
        for model in (first,) if self._model is None else (self._model, first):
            step = self._search(here, model)
            if step is not None:
                self._model = _updated(model, step.motion, step.there.gradient - here.gradient)
                return step
        return Step(here, np.zeros(len(here.q)), 0.0)

    def _first_model(self, here: Evaluation) -> FloatArray:
        """A sphere as steep as the cost is on average, so that the first step has the right size."""
        n = len(here.q)
        steepness = float(np.sum(self._problem.weights[:, None] * here.J**2)) / n
        return np.eye(n) * max(steepness, 1e-9)

    def _search(self, here: Evaluation, model: FloatArray) -> Step | None:
        """Half as far until the cost falls enough; None if it does not."""
        free = self._problem.free(here)
        direction = np.zeros(len(here.q))
        with suppress(np.linalg.LinAlgError):  # then it stays 0 and leads nowhere
            direction[free] = -np.linalg.solve(model[np.ix_(free, free)], here.gradient[free])
        part = self._problem.shortened(direction)
        for _ in range(_HALVINGS):
            q, motion = self._problem.move(here.q, part)
            there = self._problem.evaluate(q)
            if there.cost < here.cost + _SUFFICIENT * min(0.0, float(here.gradient @ motion)):
                return Step(there, motion, 0.0)
            part = 0.5 * part
        return None


def _updated(model: FloatArray, motion: FloatArray, change: FloatArray) -> FloatArray:
    """The BFGS update for a motion and the change of the gradient along it."""
    modelled = model @ motion
    curvature, measured = float(motion @ modelled), float(motion @ change)
    if measured < max(_LEAST_CURVATURE * curvature, _SMALLEST):
        return model
    return np.asarray(model + np.outer(change, change) / measured - np.outer(modelled, modelled) / curvature)
