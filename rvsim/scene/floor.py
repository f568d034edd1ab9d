"""The floor: a plate with a grid, numbers along two edges in the unit of the arm. Made once for each size."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rvsim.scene.palette import ScenePalette
from rvsim.scene.primitives import Box, Color, Item, Label, Labels, Segments
from rvsim.units import millimetres_from_metres

FloatArray = NDArray[np.float64]

FLOOR_KEY = "floor"  # an item whose key begins so lies under everything else


def nice_step(rough: float) -> float:
    """The largest of 1, 2, 5 times a power of ten that is not above `rough` (> 0)."""
    power = 10.0 ** math.floor(math.log10(rough) + 1e-9)
    return float(max(factor * power for factor in (1.0, 2.0, 5.0) if factor * power <= rough * (1 + 1e-9)))


@lru_cache(maxsize=16)
def floor_items(palette: ScenePalette, radius: float, unit: str) -> tuple[Item, ...]:
    """The floor of an arm that reaches `radius` [m] from the base; `unit` is "millimetre" or "unit".

    The same arguments give the same objects, so that a renderer draws them again without looking.
    """
    step = nice_step(radius / 4.0)
    half = step * math.ceil(radius / step - 1e-9)
    return (
        _plate(palette, half),
        Segments(f"{FLOOR_KEY}.minor", _grid(half, step / 2), palette.floor_minor, 1.0),
        Segments(f"{FLOOR_KEY}.major", _grid(half, step), palette.floor_major, 1.0),
        Segments(f"{FLOOR_KEY}.axes", _cross(half), palette.floor_axis, 1.2),
        Labels(f"{FLOOR_KEY}.numbers", _labels(palette, half, step, unit)),
    )


def _plate(palette: ScenePalette, half: float) -> Box:
    thickness = 0.01 * half
    T = np.eye(4)
    T[2, 3] = -0.6 * thickness  # just below the grid, so that a depth buffer keeps them apart
    return Box(f"{FLOOR_KEY}.plate", T, np.array([2 * half, 2 * half, thickness]), palette.floor)


def _grid(half: float, step: float) -> FloatArray:
    count = round(half / step)
    places = step * np.arange(-count, count + 1)
    edges = np.tile([-half, half], len(places))
    along = np.repeat(places, 2)
    level = np.zeros_like(along)
    return np.concatenate([np.stack([along, edges, level], 1), np.stack([edges, along, level], 1)])


def _cross(half: float) -> FloatArray:
    return np.array([[-half, 0.0, 0.0], [half, 0.0, 0.0], [0.0, -half, 0.0], [0.0, half, 0.0]])


def _labels(palette: ScenePalette, half: float, step: float, unit: str) -> tuple[Label, ...]:
    count = round(half / step)
    places = [step * index for index in range(-count, count + 1)]
    edge = half + 0.28 * step
    muted = palette.muted_text
    numbers = [_centred((place, -edge, 0.0), _number(place, unit), muted) for place in places]
    numbers += [_centred((edge, place, 0.0), _number(place, unit), muted) for place in places]
    name = "mm" if unit == "millimetre" else "unit"
    beyond = half + 0.85 * step
    axes = [_centred((0.0, -beyond, 0.0), f"x [{name}]", muted), _centred((beyond, 0.0, 0.0), f"y [{name}]", muted)]
    return tuple(numbers + axes)


def _centred(position: tuple[float, float, float], text: str, color: Color) -> Label:
    # A label's shift is its left end on the base line; half a digit is about 3.2 pixels wide.
    return Label(np.array(position), text, color, (-3.2 * len(text), 4.0), 11.0)


def _number(place: float, unit: str) -> str:
    value = millimetres_from_metres(place) if unit == "millimetre" else place
    return f"{value + 0.0:.6g}".replace("-", "−")
