"""Where a workspace ends: the outline of its cells, and the exact curves on which the tool stops."""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations, product

import numpy as np

from rvsim.kinematics.workspace.grid import BoolArray, Grid, IntArray
from rvsim.spatial.arrays import FloatArray

_SWEEP = 361  # points of a curve
_ROOTS = 73  # steps between which a critical angle is looked for
_BISECTIONS = 30

_BESIDE = 1.3  # cells: what lies there is another cell, at either side

Section = Callable[[FloatArray], FloatArray]  # joints (m, k) -> points (m, 2)
Measure = Callable[[FloatArray], FloatArray]  # joints (m, k) -> numbers (m,)


def cell_outline(grid: Grid, reached: BoolArray) -> FloatArray:
    """Line pieces (k, 2, 2) around the cells that are reached (columns, rows), smoothed over a cell [m]."""
    padded = np.pad(reached.astype(np.float64), 2)
    columns, rows = (length - 2 for length in padded.shape)
    field = np.zeros((columns, rows))
    for i, j in product(range(3), range(3)):
        field += padded[i : i + columns, j : j + rows]
    u = grid.lower[0] + grid.cell * (np.arange(columns) - 0.5)
    v = grid.lower[1] + grid.cell * (np.arange(rows) - 0.5)
    corners = np.stack(np.meshgrid(u, v, indexing="ij"), axis=-1)
    height = field / 9.0 - 0.5 + 1e-9  # never exactly on a corner
    a, b, c, d = (np.s_[:-1, :-1], np.s_[1:, :-1], np.s_[1:, 1:], np.s_[:-1, 1:])
    triangles = [(a, b, c), (a, c, d)]
    return np.concatenate([_crossed(*((corners[k], height[k]) for k in triangle)) for triangle in triangles])


def _crossed(*corners: tuple[FloatArray, FloatArray]) -> FloatArray:
    """The pieces (k, 2, 2) along which the height is 0 in triangles, one corner's (place, height) after another."""
    places = np.stack([place.reshape(-1, 2) for place, _ in corners], axis=1)
    heights = np.stack([height.reshape(-1) for _, height in corners], axis=1)
    above = heights > 0.0
    count = above.sum(axis=1)
    mixed = (count == 1) | (count == 2)
    places, heights, above, count = places[mixed], heights[mixed], above[mixed], count[mixed]
    alone = np.argmax(above == (count == 1)[:, None], axis=1)
    rows = np.arange(len(alone))
    ends = []
    for step in (1, 2):
        other = (alone + step) % 3
        low, high = heights[rows, alone], heights[rows, other]
        share = (low / (low - high))[:, None]
        ends.append(places[rows, alone] + share * (places[rows, other] - places[rows, alone]))
    return np.stack(ends, axis=1)


def stopping_curves(section: Section, ranges: FloatArray, edges: tuple[FloatArray, ...]) -> list[FloatArray]:
    """Curves of joints (m, k) on which the image of k joints in a plane may end.

    An image ends where all joints but one stand at a stop, or where all but two do and these two are singular: both
    move the point along one line. `edges` holds each joint's stops, and the values that bring links into line.
    """
    count = len(ranges)
    curves = []
    for free in range(count):
        others = [joint for joint in range(count) if joint != free]
        curves += [_swept(ranges, free, others, values) for values in product(*(edges[joint] for joint in others))]
    for pair in combinations(range(count), 2):
        others = [joint for joint in range(count) if joint not in pair]
        for values in product(*(edges[joint] for joint in others)):
            curves += _critical(section, ranges, pair, others, values)
    return curves


def _swept(ranges: FloatArray, free: int, others: list[int], values: tuple[float, ...]) -> FloatArray:
    q = np.empty((_SWEEP, len(ranges)))
    q[:, free] = np.linspace(ranges[free, 0], ranges[free, 1], _SWEEP)
    q[:, others] = values
    return q


def _critical(
    section: Section, ranges: FloatArray, pair: tuple[int, int], others: list[int], values: tuple[float, ...]
) -> list[FloatArray]:
    """Where two joints move the point along one line."""
    return zero_curves(lambda q: _area(section, q, pair), ranges, pair, others, values)


def zero_curves(
    function: Measure, ranges: FloatArray, pair: tuple[int, int], others: list[int], values: tuple[float, ...]
) -> list[FloatArray]:
    """Curves of joints (m, k) where a function of them is 0: for each value of the first, the roots of the second."""
    first, second = pair
    q = np.empty((_SWEEP, _ROOTS, len(ranges)))
    q[..., first] = np.linspace(ranges[first, 0], ranges[first, 1], _SWEEP)[:, None]
    q[..., second] = np.linspace(ranges[second, 0], ranges[second, 1], _ROOTS)
    q[..., others] = values
    area = function(q.reshape(-1, len(ranges))).reshape(_SWEEP, _ROOTS)
    size = np.abs(area).max()
    if size < 1e-15:
        return []
    rows, columns = np.nonzero((area[:, :-1] > 0.0) != (area[:, 1:] > 0.0))
    if not len(rows):
        return []
    roots = _bisected(function, q[rows, columns], q[rows, columns + 1])
    return _threads(roots, rows, second, 4.0 * float(np.ptp(ranges[second])) / _ROOTS)


def _bisected(function: Measure, low: FloatArray, high: FloatArray) -> FloatArray:
    low, high = low.copy(), high.copy()
    positive = function(low) > 0.0
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        same = (function(middle) > 0.0) == positive
        low[same], high[~same] = middle[same], middle[~same]
    return 0.5 * (low + high)


def _threads(roots: FloatArray, rows: IntArray, second: int, gap: float) -> list[FloatArray]:
    """Roots (m, k) of successive rows put together to curves: each goes on with the root nearest in the next row."""
    curves = []
    ranks = np.arange(len(rows)) - np.searchsorted(rows, rows)
    for rank in range(int(ranks.max()) + 1):
        chosen = roots[ranks == rank]
        breaks = np.flatnonzero((np.abs(np.diff(chosen[:, second])) > gap) | (np.diff(rows[ranks == rank]) > 1)) + 1
        curves += [piece for piece in np.split(chosen, breaks) if len(piece) > 1]
    return curves


def _area(section: Section, q: FloatArray, pair: tuple[int, int]) -> FloatArray:
    """How far two joints are from moving the point along one line: the area their velocities span."""
    step = 1e-6
    velocities = []
    for joint in pair:
        ahead, behind = q.copy(), q.copy()
        ahead[:, joint] += step
        behind[:, joint] -= step
        velocities.append((section(ahead) - section(behind)) / (2.0 * step))
    (a, b), (c, d) = (velocity.T for velocity in velocities)
    return np.asarray(a * d - b * c)


def border_pieces(grid: Grid, reached: BoolArray, pieces: FloatArray) -> BoolArray:
    """Which line pieces (k, 2, 2) have places that are not reached at one side: the others end at the border."""
    if not len(pieces):
        return np.zeros(0, dtype=bool)
    along = pieces[:, 1] - pieces[:, 0]
    across = np.stack([-along[:, 1], along[:, 0]], axis=-1)
    across *= _BESIDE * grid.cell / np.maximum(np.linalg.norm(across, axis=-1, keepdims=True), 1e-300)
    middle = pieces.mean(axis=1)
    columns, rows = grid.shape
    padded = np.pad(reached, 1)
    sides = []
    for beside in (middle + across, middle - across):
        index = np.clip(np.floor((beside - grid.lower) / grid.cell).astype(np.intp) + 1, 0, (columns + 1, rows + 1))
        sides.append(padded[index[:, 0], index[:, 1]])
    return np.asarray(~(sides[0] & sides[1]))


def at_an_edge(grid: Grid, reached: BoolArray, points: FloatArray) -> BoolArray:
    """Which points (m, 2) have a cell beside theirs, or their own, that is not reached: the workspace ends there."""
    columns, rows = grid.shape
    padded = np.pad(reached, 2)
    whole = np.ones((columns + 2, rows + 2), dtype=bool)
    for i, j in product(range(3), range(3)):
        whole &= padded[i : i + columns + 2, j : j + rows + 2]
    index = np.clip(np.floor((points - grid.lower) / grid.cell).astype(np.intp) + 1, 0, np.array(whole.shape) - 1)
    return np.asarray(~whole[index[:, 0], index[:, 1]])
