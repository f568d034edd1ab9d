"""The top section of an arm on a turntable: a sample at a height is an arc, for joint 1 turns it."""

from __future__ import annotations

import math

import numpy as np

from rvsim.kinematics.workspace.grid import Grid
from rvsim.kinematics.workspace.place import Turntable
from rvsim.spatial.arrays import FloatArray

_TURN = 2.0 * math.pi
_AZIMUTHS = 720
_MOST_AT_ONCE = 128  # samples that are turned all around of each block: a flat arm has thousands, and no need of them


class Rings:
    """Rings around the axis, a cell wide and cut into sectors, with the largest value of each."""

    def __init__(self, table: Turntable, limits: FloatArray, grid: Grid) -> None:
        self._table, self._limits, self._grid = table, limits, grid
        reach = max(grid.shape) + 1
        self._best = np.full((reach + 1, _AZIMUTHS), -np.inf)
        self._azimuths = (np.arange(_AZIMUTHS) + 0.5) * (_TURN / _AZIMUTHS)
        self._whole = table.goes_round(limits)

    def add(self, rho: FloatArray, phi: FloatArray, values: FloatArray) -> None:
        """Samples (m,) at distance rho from the axis and azimuth phi at q1 = 0."""
        ring = np.minimum(rho / self._grid.cell, len(self._best) - 1).astype(np.intp)
        if self._whole:
            np.maximum.at(self._best[:, 0], ring, values)
            return
        ring, values = ring[:_MOST_AT_ONCE], values[:_MOST_AT_ONCE]
        turned = self._azimuths - phi[:_MOST_AT_ONCE, None]
        rows, columns = np.nonzero(self._table.turns_to(turned, self._limits))
        np.maximum.at(self._best, (ring[rows], columns), values[rows])

    def cells(self) -> FloatArray:
        """The value of every cell of the grid, −inf for none."""
        x, y = (self._grid.centers() - self._table.point).T
        ring = np.minimum(np.hypot(x, y) / self._grid.cell, len(self._best) - 1).astype(np.intp)
        if self._whole:
            return np.asarray(self._best[ring, 0])
        column = (np.arctan2(y, x) % _TURN * (_AZIMUTHS / _TURN)).astype(np.intp) % _AZIMUTHS
        return np.asarray(self._best[ring, column])
