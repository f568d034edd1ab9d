"""The floor: a plate with a grid, numbers along two edges in the unit that is shown. Made once for each size."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rvsim.scene.palette import ScenePalette
from rvsim.scene.primitives import Box, Color, Item, Label, Labels, Segments
from rvsim.units import millimetres_from_metres

FloatArray = NDArray[np.float64]

_FIELDS = 8.0  # major fields along the longer side, about
FLOOR_KEY = "floor"  # an item whose key begins so lies under everything else
FLOOR_NUMBERS_KEY = f"{FLOOR_KEY}.numbers"


def nice_step(rough: float) -> float:
    """The largest of 1, 2, 5 times a power of ten that is not above `rough` (> 0)."""
    power = 10.0 ** math.floor(math.log10(rough) + 1e-9)
    return float(max(factor * power for factor in (1.0, 2.0, 5.0) if factor * power <= rough * (1 + 1e-9)))


class Extent(NamedTuple):
    """The rectangle that the floor must cover [m]."""

    x_min: float
    x_max: float
    y_min: float
    y_max: float


@lru_cache(maxsize=16)
def floor_items(palette: ScenePalette, extent: Extent, unit: str) -> tuple[Item, ...]:
    """The floor under an arm that reaches over `extent` [m]; its numbers are in `unit`, "mm", "m" or the word for unit.

    The same arguments give the same objects, so that a renderer draws them again without looking.
    """
    step = _major_step(extent)
    grid = _rounded_out(extent, step)
    return (
        _plate(palette, grid),
        Segments(f"{FLOOR_KEY}.minor", _lines(grid, step / 2), palette.floor_minor, 1.0),
        Segments(f"{FLOOR_KEY}.major", _lines(grid, step), palette.floor_major, 1.0),
        Segments(f"{FLOOR_KEY}.axes", _cross(grid), palette.floor_axis, 1.0),
        Labels(FLOOR_NUMBERS_KEY, _labels(palette, grid, step, unit)),
    )


def line_distance(extent: Extent) -> float:
    """How far neighbouring lines of that floor are apart [m]: the minor ones lie between the major ones."""
    return 0.5 * _major_step(extent)


def _major_step(extent: Extent) -> float:
    return nice_step(max(extent.x_max - extent.x_min, extent.y_max - extent.y_min) / _FIELDS)


def _rounded_out(extent: Extent, step: float) -> Extent:
    lower = [step * math.floor(value / step + 1e-9) for value in (extent.x_min, extent.y_min)]
    upper = [step * math.ceil(value / step - 1e-9) for value in (extent.x_max, extent.y_max)]
    return Extent(lower[0], upper[0], lower[1], upper[1])


def _plate(palette: ScenePalette, grid: Extent) -> Box:
    width, depth = grid.x_max - grid.x_min, grid.y_max - grid.y_min
    thickness = 0.005 * max(width, depth)
    T = np.eye(4)
    # Just below the grid, so that a depth buffer keeps them apart.
    T[:3, 3] = (grid.x_min + grid.x_max) / 2, (grid.y_min + grid.y_max) / 2, -0.6 * thickness
    return Box(f"{FLOOR_KEY}.plate", T, np.array([width, depth, thickness]), palette.floor)


def _places(lower: float, upper: float, step: float) -> FloatArray:
    return np.asarray(step * np.arange(round(lower / step), round(upper / step) + 1), dtype=np.float64)


def _lines(grid: Extent, step: float) -> FloatArray:
    """Line pieces (2 k, 3) along both directions."""
    x, y = _places(grid.x_min, grid.x_max, step), _places(grid.y_min, grid.y_max, step)
    along_y = np.stack([np.repeat(x, 2), np.tile([grid.y_min, grid.y_max], len(x))], axis=1)
    along_x = np.stack([np.tile([grid.x_min, grid.x_max], len(y)), np.repeat(y, 2)], axis=1)
    flat = np.concatenate([along_y, along_x])
    return np.column_stack([flat, np.zeros(len(flat))])


def _cross(grid: Extent) -> FloatArray:
    return np.array([[grid.x_min, 0, 0], [grid.x_max, 0, 0], [0, grid.y_min, 0], [0, grid.y_max, 0]], dtype=np.float64)


def _labels(palette: ScenePalette, grid: Extent, step: float, unit: str) -> tuple[Label, ...]:
    """Numbers along the edges that the usual views have in front; the axis' name stands where its last one would."""
    muted = palette.muted_text
    beside_x, beside_y = grid.y_min - 0.3 * step, grid.x_max + 0.3 * step
    x, y = _places(grid.x_min, grid.x_max, step)[:-1], _places(grid.y_min, grid.y_max, step)[1:-1]
    numbers = [_centred((place, beside_x, 0.0), _number(place, unit), muted) for place in x.tolist()]
    numbers += [_centred((beside_y, place, 0.0), _number(place, unit), muted) for place in y.tolist()]
    ends = ((grid.x_max, beside_x, 0.0), f"x [{unit}]"), ((beside_y, grid.y_max, 0.0), f"y [{unit}]")
    # The names first: where texts would lie on one another, the later ones are left out.
    return (*(_centred(place, text, palette.text) for place, text in ends), *numbers)


def _centred(position: tuple[float, float, float], text: str, color: Color) -> Label:
    # A label's shift is its left end on the base line; half a digit is about 3.2 pixels wide.
    return Label(np.array(position), text, color, (-3.2 * len(text), 4.0), 11.0)


def _number(place: float, unit: str) -> str:
    value = millimetres_from_metres(place) if unit == "mm" else place
    return f"{round(value, 9) + 0.0:.6g}".replace("-", "−")
