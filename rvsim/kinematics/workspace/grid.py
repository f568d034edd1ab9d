"""Flat maps of a workspace: a plane cut into square cells, and the best of what falls into each."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from rvsim.spatial.arrays import FloatArray

BoolArray = np.ndarray[Any, np.dtype[np.bool_]]
IntArray = np.ndarray[Any, np.dtype[np.intp]]


@dataclass(frozen=True, eq=False)
class Grid:
    """Square cells of a plane: `shape` (columns along u, rows along v) from the corner `lower` (2,) on [m]."""

    lower: FloatArray
    cell: float
    shape: tuple[int, int]

    @classmethod
    def over(cls, low: FloatArray, high: FloatArray, cells: int) -> Grid:
        """Over a box (2,) to (2,) with a margin, `cells` along its longer side."""
        span = max(float((high - low).max()), 1e-6)
        cell = span / (cells - 4)
        columns, rows = (max(int(np.ceil(length / cell)) + 4, 5) for length in (high - low).tolist())
        middle = 0.5 * (low + high)
        return cls(middle - 0.5 * cell * np.array([columns, rows]), cell, (columns, rows))

    @property
    def size(self) -> int:
        """The number of cells."""
        return self.shape[0] * self.shape[1]

    @property
    def upper(self) -> FloatArray:
        """(2,) the opposite corner."""
        return np.asarray(self.lower + self.cell * np.array(self.shape))

    def cells(self, u: FloatArray, v: FloatArray) -> IntArray:
        """The number (m,) of each point's cell, row after row of constant u; `size` for points outside."""
        scale = 1.0 / self.cell
        i, j = np.floor((u - self.lower[0]) * scale), np.floor((v - self.lower[1]) * scale)
        inside = (i >= 0) & (j >= 0) & (i < self.shape[0]) & (j < self.shape[1])
        return np.where(inside, i * self.shape[1] + j, self.size).astype(np.intp)

    def centers(self) -> FloatArray:
        """(size, 2) the middle of each cell, in the order of their numbers."""
        u, v = (low + self.cell * (np.arange(n) + 0.5) for low, n in zip(self.lower, self.shape, strict=True))
        return np.stack(np.meshgrid(u, v, indexing="ij"), axis=-1).reshape(-1, 2)


class Tally:
    """The largest value that fell into each cell of a grid, and which cells were hit at all."""

    def __init__(self, grid: Grid) -> None:
        self.grid = grid
        self._best = np.full(grid.size + 1, -np.inf)  # the last one is for what falls outside

    def add(self, u: FloatArray, v: FloatArray, values: FloatArray) -> None:
        """Points (m,), (m,) with their values (m,)."""
        np.maximum.at(self._best, self.grid.cells(u, v), values)

    def add_cells(self, values: FloatArray) -> None:
        """A value for every cell; −inf is none."""
        np.maximum(self._best[:-1], values, out=self._best[:-1])

    @property
    def values(self) -> FloatArray:
        """(columns, rows) the largest values, NaN in cells without any."""
        best = self._best[:-1].reshape(self.grid.shape)
        return np.where(np.isneginf(best), np.nan, best)


def mended(values: FloatArray) -> FloatArray:
    """Values (columns, rows) with small gaps filled in: a NaN cell with values on three sides was missed by samples.

    Twice, for gaps of two cells; the value is the mean of those beside it.
    """
    for _ in range(2):
        padded = np.pad(values, 1, constant_values=np.nan)
        sides = np.stack([padded[:-2, 1:-1], padded[2:, 1:-1], padded[1:-1, :-2], padded[1:-1, 2:]])
        there = ~np.isnan(sides)
        count = there.sum(axis=0)
        mean = np.where(there, sides, 0.0).sum(axis=0) / np.maximum(count, 1)
        values = np.where(np.isnan(values) & (count >= 3), mean, values)
    return values


def lattice(low: FloatArray, high: FloatArray, count: int, seed: int) -> FloatArray:
    """About `count` places (m, 3) all over a box (3,) to (3,), each moved a little so that no moiré shows."""
    spans = np.maximum(high - low, 1e-9)
    step = float((spans.prod() / count) ** (1.0 / 3.0))
    axes = [a + np.arange(0.5 * min(step, span), span, step) for a, span in zip(low, spans, strict=True)]
    places = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    return np.asarray(places + np.random.default_rng(seed).uniform(-0.4, 0.4, places.shape) * step)
