"""The workspace of an arm: two sections and a thinned cloud, worked out in parts, to be watched and given up.

Free to turn, the arm is sampled: millions of poses forward. With its orientation held it is asked: the closed form at
every cell. On a turntable (a vertical joint 1) a section through its axis needs no luck:
for every pose of the other joints there is one q1 that brings the tool into the plane.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from rvsim.kinematics.forward import forward_kinematics
from rvsim.kinematics.workspace.branches import branch_counts, held_branches, within_limits
from rvsim.kinematics.workspace.grid import BoolArray, Grid, Tally, lattice, mended
from rvsim.kinematics.workspace.outline import cell_outline
from rvsim.kinematics.workspace.place import Turntable, places_and_manipulability, turntable
from rvsim.kinematics.workspace.rim import Rim
from rvsim.kinematics.workspace.rings import Rings
from rvsim.kinematics.workspace.sampling import PoseSampler, joint_ranges
from rvsim.kinematics.workspace.values import SectionMap, Workspace, WorkspaceTask
from rvsim.spatial.arrays import FloatArray

BLOCK = 8192  # poses at a time
_PILOT = 4 * BLOCK
_CELLS = 48, 160  # fewest and most along the longer side of a section of samples
_ASKED_CELLS = 120  # of one whose cells are asked one by one
_TURNED, _TURNS = 128, 32  # poses of a block that are turned, and how often, where limits of joint 1 matter
_SLICE = 0.06  # of the height: how thick a section must be where no joint brings a sample into it
_CLOUD = 20_000
_UP = np.array([0.0, 0.0, 1.0])


def workspace(task: WorkspaceTask) -> Workspace:
    """All of it in one go.

    Raises:
        NoClosedFormError: branches are wanted, or an orientation kept, of an arm without a closed form for it.
    """
    *_, result = workspace_parts(task)
    assert isinstance(result, Workspace)
    return result


def workspace_parts(task: WorkspaceTask) -> Iterator[float | Workspace]:
    """The same part by part: the share 0…1 that is done, again and again, and at last the workspace.

    Raises:
        NoClosedFormError: branches are wanted, or an orientation kept, of an arm without a closed form for it.
    """
    survey = _Survey(task)
    for share in survey.asked() if task.fixed else survey.sampled():
        yield 0.95 * share
    yield survey.result()


class _Survey:
    """The maps while they are being filled."""

    def __init__(self, task: WorkspaceTask) -> None:
        self._task, robot = task, task.robot
        self._table = turntable(robot)
        self._sampler = PoseSampler(robot, joint_ranges(robot, ignore_limits=task.ignore_limits), task.seed)
        self._tool = forward_kinematics(robot, task.q)
        self._height = float(self._tool[2, 3])
        self._place_side()
        self._make_maps()
        self._side_counts, self._top_counts = Tally(self._side.grid), Tally(self._top.grid)
        self._rings, self._count_rings = self._new_rings(), self._new_rings()
        self._cloud: list[FloatArray] = []
        self._measures: list[FloatArray] = []
        self._cloud_counts: list[FloatArray] = []

    # --- where the maps lie ------------------------------------------------------------------------------------------

    def _place_side(self) -> None:
        """The side section goes through the tool: through the turntable's axis, or square to y where there is none."""
        x, y, _ = self._tool[:3, 3].tolist()
        self._azimuth, self._origin = 0.0, np.array([0.0, y, 0.0])
        if self._table is not None:
            x, y = x - self._table.point[0], y - self._table.point[1]
            on_axis = math.hypot(x, y) <= 1e-9 * self._task.robot.size
            self._azimuth, self._origin = 0.0 if on_axis else math.atan2(y, x), np.array([*self._table.point, 0.0])
        self._axis = np.array([math.cos(self._azimuth), math.sin(self._azimuth), 0.0])

    def _make_maps(self) -> None:
        """Around a few thousand poses, corners among them."""
        places, _ = places_and_manipulability(self._task.robot, self._sampler.block(0, _PILOT))
        low, high = places.min(axis=0), places.max(axis=0)
        side_low, side_high = low[[0, 2]], high[[0, 2]]
        if self._table is not None:
            reach = float(self._table.cylindrical(places)[0].max())
            low[:2], high[:2] = self._table.point - reach, self._table.point + reach
            side_low[0], side_high[0] = -reach, reach
        cells = _cells(self._task)
        self._side = Tally(Grid.over(side_low, side_high, cells))
        self._top = Tally(Grid.over(low[:2], high[:2], cells))
        self._box = low, high

    # --- forward: a million poses ------------------------------------------------------------------------------------

    def sampled(self) -> Iterator[float]:
        """Block after block of poses into the maps."""
        poses = max(self._task.poses, 1)
        for start in range(0, poses, BLOCK):
            q = self._sampler.block(start, min(BLOCK, poses - start))
            places, measure = places_and_manipulability(self._task.robot, q)
            if self._table is None:
                self._add_projected(q, places, measure)
            else:
                self._add_turned(self._table, q, places, measure)
            self._add_to_cloud(q, places, measure, slice(-start % self._thin, None, self._thin))
            yield min((start + BLOCK) / poses, 1.0)
        for tally, rings in ((self._top, self._rings), (self._top_counts, self._count_rings)):
            if rings is not None:
                tally.add_cells(rings.cells())

    def _new_rings(self) -> Rings | None:
        return Rings(self._table, self._sampler.ranges[0], self._top.grid) if self._table else None

    @property
    def _thin(self) -> int:
        """Every so manyth pose is in the cloud."""
        return max(math.ceil(self._task.poses / _CLOUD), 1)

    def _counts(self, q: FloatArray) -> FloatArray:
        return branch_counts(self._task.robot, q, ignore_limits=self._task.ignore_limits)

    def _add_to_cloud(self, q: FloatArray, places: FloatArray, measure: FloatArray, few: slice) -> None:
        chosen = places[few] if self._table is None else self._table.placed(places[few], q[few, 0])
        self._cloud.append(chosen)
        self._measures.append(measure[few])
        if self._task.branches:
            self._cloud_counts.append(self._counts(q[few]))

    def _add_projected(self, q: FloatArray, places: FloatArray, measure: FloatArray) -> None:
        """Without a turntable: all poses seen from the side, and those about as high as the tool."""
        x, y, z = places.T
        near = np.abs(z - self._height) <= max(_SLICE * float(self._box[1][2] - self._box[0][2]), self._top.grid.cell)
        self._side.add(x, z, measure)
        self._top.add(x[near], y[near], measure[near])
        if self._task.branches:
            counts = self._counts(q)
            self._side_counts.add(x, z, counts)
            self._top_counts.add(x[near], y[near], counts[near])

    def _add_turned(self, table: Turntable, q: FloatArray, places: FloatArray, measure: FloatArray) -> None:
        """On both sides of the axis where joint 1 turns there; at the tool's height all that it can turn to."""
        rho, phi, z = table.cylindrical(places)
        for side in (0.0, math.pi):
            turned = table.turns_to(self._azimuth + side - phi, self._sampler.ranges[0])
            self._side.add(math.cos(side) * rho[turned], z[turned], measure[turned])
        near = np.abs(z - self._height) <= self._top.grid.cell
        if self._rings is not None:
            self._rings.add(rho[near], phi[near], measure[near])
        if self._task.branches:
            counted = self._count_everywhere if table.goes_round(self._sampler.ranges[0]) else self._count_turned
            counted(table, q, places, near)

    def _count_everywhere(self, table: Turntable, q: FloatArray, places: FloatArray, near: BoolArray) -> None:
        """Joint 1 goes all around: a pose has as many branches wherever it is turned to."""
        rho, phi, z = table.cylindrical(places)
        counts = self._counts(q)
        for sign in (1.0, -1.0):
            self._side_counts.add(sign * rho, z, counts)
        if self._count_rings is not None:
            self._count_rings.add(rho[near], phi[near], counts[near])

    def _count_turned(self, table: Turntable, q: FloatArray, places: FloatArray, near: BoolArray) -> None:
        """Joint 1 has limits: how many of the branches are within them depends on where a pose is turned to."""
        rho, phi, z = table.cylindrical(places)
        for side in (0.0, math.pi):
            turn = self._azimuth + side - phi
            turned = table.turns_to(turn, self._sampler.ranges[0])
            if turned.any():
                counts = self._counts(table.with_turn(q[turned], turn[turned]))
                self._side_counts.add(math.cos(side) * rho[turned], z[turned], counts)
        few = np.flatnonzero(near)[:_TURNED]
        if len(few):
            self._add_turns(table, q[few], places[few])

    def _add_turns(self, table: Turntable, q: FloatArray, places: FloatArray) -> None:
        """The branches of poses at the tool's height, each turned all around in steps."""
        lower, upper = self._sampler.ranges[0].tolist()
        shift = np.random.default_rng(self._task.seed).random((len(q), 1))
        q1 = (lower + (np.arange(_TURNS) + shift) / _TURNS * (upper - lower)).reshape(-1)
        turned = np.repeat(q, _TURNS, axis=0)
        turned[:, 0] = q1
        x, y, _ = table.placed(np.repeat(places, _TURNS, axis=0), q1).T
        self._top_counts.add(x, y, self._counts(turned))

    # --- backward: the closed form, cell by cell ---------------------------------------------------------------------

    def asked(self) -> Iterator[float]:
        """Every cell of both sections, then a lattice of places for the cloud."""
        groups = [self._side_places(), self._top_places(), lattice(*self._box, _CLOUD, self._task.seed)]
        places, cuts = np.concatenate(groups), np.cumsum([len(group) for group in groups])[:-1]
        measure, count = np.empty(len(places)), np.empty(len(places))
        for start in range(0, len(places), BLOCK):
            part = slice(start, start + BLOCK)
            measure[part], count[part] = self._answered(places[part])
            yield min((start + BLOCK) / len(places), 1.0)
        measures, counts = np.split(measure, cuts), np.split(count, cuts)
        for tally, values in zip((self._side, self._top), measures, strict=False):
            tally.add_cells(values)
        for tally, values in zip((self._side_counts, self._top_counts), counts, strict=False):
            tally.add_cells(values)
        hit = counts[2] > 0.0
        self._cloud, self._measures, self._cloud_counts = [groups[2][hit]], [measures[2][hit]], [counts[2][hit]]

    def _side_places(self) -> FloatArray:
        uv = self._side.grid.centers()
        return np.asarray(self._origin + uv[:, :1] * self._axis + uv[:, 1:] * _UP)

    def _top_places(self) -> FloatArray:
        uv = self._top.grid.centers()
        return np.column_stack([uv, np.full(len(uv), self._height)])

    def _answered(self, places: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The largest manipulability and the number of branches (m,) at places (m, 3), −inf for none."""
        robot = self._task.robot
        q = held_branches(robot, places, self._tool[:3, :3])
        exist = ~np.isnan(q[..., 0]) if self._task.ignore_limits else within_limits(robot, q)
        best, counts = np.full(len(q), -np.inf), exist.sum(axis=1)
        np.maximum.at(best, np.nonzero(exist)[0], places_and_manipulability(robot, q[exist])[1])
        return best, np.where(counts > 0, counts, -np.inf)

    # --- the end -----------------------------------------------------------------------------------------------------

    def result(self) -> Workspace:
        """Both maps with their outlines, and the cloud."""
        cloud, measures = np.concatenate(self._cloud), np.concatenate(self._measures)
        counts = np.concatenate(self._cloud_counts) if self._task.counts else None
        return Workspace(self._task, self._side_map(), self._top_map(), cloud, measures, counts)

    def _side_map(self) -> SectionMap:
        values, grid = self._values(self._side), self._side.grid
        rim = None
        if self._table is not None and not self._task.fixed:
            rim = Rim(self._sampler, self._table, self._azimuth).pieces(grid, ~np.isnan(values))
        outline = cell_outline(grid, ~np.isnan(values)) if rim is None else rim
        frame = self._origin, self._axis, _UP
        projected = self._table is None and not self._task.fixed
        return SectionMap(grid, *frame, values, self._numbers(self._side_counts), outline, rim is not None, projected)

    def _top_map(self) -> SectionMap:
        values, grid = self._values(self._top), self._top.grid
        frame = np.array([0.0, 0.0, self._height]), np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0])
        outline, counts = cell_outline(grid, ~np.isnan(values)), self._numbers(self._top_counts)
        return SectionMap(grid, *frame, values, counts, outline, False)

    def _numbers(self, tally: Tally) -> FloatArray | None:
        return self._values(tally) if self._task.counts else None

    def _values(self, tally: Tally) -> FloatArray:
        return tally.values if self._task.fixed else mended(tally.values)


def _cells(task: WorkspaceTask) -> int:
    """How many cells along the longer side: as many as so many poses fill."""
    if task.fixed:
        return _ASKED_CELLS
    return int(np.clip(0.16 * math.sqrt(task.poses), *_CELLS))
