"""Plays a program for q of any leading shape: one pose in plain Python, many in blocks."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import ShapeError
from rvsim.kinematics.tape.blocks import block_plan
from rvsim.kinematics.tape.program import Program
from rvsim.kinematics.tape.scalar import scalar_function
from rvsim.spatial.arrays import FloatArray

# Below some twenty poses plain Python is faster than any array.
_FEW = 20


class Player:
    """A program made ready; its outputs come in the shape (..., *shape)."""

    def __init__(self, program: Program, shape: tuple[int, ...]) -> None:
        self._shape, self._q_shape = shape, (program.dof,)
        self._one, self._plan = scalar_function(program), block_plan(program)

    def play(self, q: ArrayLike) -> FloatArray:
        """The outputs (..., *shape) for q (..., n).

        Raises:
            ShapeError: the last axis of q is not the number of joints.
        """
        values = np.asarray(q, np.float64)
        if values.shape[-1:] != self._q_shape:
            raise ShapeError("q", f"(..., {self._q_shape[0]})", values.shape)
        if values.ndim == 1:
            result = np.empty(self._shape)
            self._play_one(values.tolist(), result)
            return result
        results = np.zeros((*values.shape[:-1], *self._shape))
        self._play_rows(values.reshape(-1, *self._q_shape), results.reshape(-1, math.prod(self._shape)))
        return results

    def _play_rows(self, q: FloatArray, results: FloatArray) -> None:
        if len(q) > _FEW:
            self._plan.play(q, results)
            return
        for values, row in zip(q.tolist(), results, strict=True):
            self._play_one(values, row)

    def _play_one(self, q: list[float], result: FloatArray) -> None:
        try:
            self._one(q, result)
        except ValueError:  # math.sin refuses infinity, where numpy answers nan
            self._plan.play(np.array([q]), result.reshape(1, -1))
