"""The exact rim of a side section: where the tool stops in the plane through the turntable's axis."""

from __future__ import annotations

import math
from functools import partial
from itertools import product

import numpy as np

from rvsim.kinematics.workspace.grid import BoolArray, Grid
from rvsim.kinematics.workspace.outline import at_an_edge, border_pieces, stopping_curves, zero_curves
from rvsim.kinematics.workspace.place import Turntable, places_and_manipulability
from rvsim.kinematics.workspace.sampling import PoseSampler, edge_values
from rvsim.spatial.arrays import FloatArray

_MOST_JOINTS = 3  # that move the tool in the plane; with more, edges come from too many poses to list


class Rim:
    """The arm of a sampler on its turntable, cut at an azimuth [rad]."""

    def __init__(self, sampler: PoseSampler, table: Turntable, azimuth: float) -> None:
        self._robot, self._ranges = sampler.robot, sampler.ranges
        self._table, self._azimuth = table, azimuth
        self._moving = self._moving_joints(sampler.block(0, 64))

    def pieces(self, grid: Grid, reached: BoolArray) -> FloatArray | None:
        """Line pieces (k, 2, 2) of the curves on which the tool may stop, where the section does end there.

        None for an arm with too many joints that move the tool in the plane.
        """
        moving = self._moving
        if not 1 <= len(moving) <= _MOST_JOINTS:
            return None
        edges = edge_values(self._robot, self._ranges)
        curves = stopping_curves(self._flat, self._ranges[moving], tuple(edges[joint] for joint in moving))
        curves += self._turned_out()
        pieces = np.concatenate([self._kept(curve, grid, reached) for curve in curves])
        return pieces[border_pieces(grid, reached, pieces)]

    def _turned_out(self) -> list[FloatArray]:
        """Curves of two moving joints (m, 2) on which joint 1 stands at a stop, and can turn them no further."""
        if len(self._moving) != 2 or self._table.goes_round(self._ranges[0]):
            return []
        ranges, curves = self._ranges[self._moving], []
        for side, stop, pair in product((0.0, math.pi), self._ranges[0].tolist(), ((0, 1), (1, 0))):
            curves += zero_curves(partial(self._beyond, side, stop), ranges, pair, [], ())
        return curves

    def _beyond(self, side: float, stop: float, values: FloatArray) -> FloatArray:
        """(m,) the sine of how far beyond a stop joint 1 would have to turn: 0 at the stop, and half a turn from it."""
        phi = self._cylindrical(self._poses(values))[1]
        return np.sin(self._table.sense * (self._azimuth + side - phi) - stop)

    def _moving_joints(self, q: FloatArray) -> list[int]:
        """The joints that move the tool within the plane."""
        here = np.stack(self._cylindrical(q)[::2])
        found = []
        for joint in range(1, self._robot.dof):
            moved = q.copy()
            moved[:, joint] += 0.1
            if np.abs(np.stack(self._cylindrical(moved)[::2]) - here).max() > 1e-9 * self._robot.size:
                found.append(joint)
        return found

    def _cylindrical(self, q: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        return self._table.cylindrical(places_and_manipulability(self._robot, q)[0])

    def _poses(self, values: FloatArray) -> FloatArray:
        q = np.zeros((len(values), self._robot.dof))
        q[:, self._moving] = values
        return q

    def _flat(self, values: FloatArray) -> FloatArray:
        """(m, 2) distance from the axis and height for the moving joints (m, k)."""
        rho, _, z = self._cylindrical(self._poses(values))
        return np.stack([rho, z], axis=-1)

    def _kept(self, curve: FloatArray, grid: Grid, reached: BoolArray) -> FloatArray:
        """The pieces of a curve on both sides of the axis, where joint 1 goes there and the section ends."""
        rho, phi, z = self._cylindrical(self._poses(curve))
        kept = []
        for side in (0.0, math.pi):
            flat = np.stack([math.cos(side) * rho, z], axis=-1)
            shown = self._table.turns_to(self._azimuth + side - phi, self._ranges[0])
            shown &= at_an_edge(grid, reached, flat)
            both = shown[:-1] & shown[1:]
            kept.append(np.stack([flat[:-1][both], flat[1:][both]], axis=1))
        return np.concatenate(kept)
