"""Curves over an axis as a value: what is drawn, its scale, and round numbers for the axes."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from rvsim.robot.arrays import FloatArray

_STEPS = (1.0, 2.0, 2.5, 5.0, 10.0)
_AIR = 0.06  # above and below the curves, of their height
_MOST_POINTS = 400
DASHES = 5  # ways to draw a line: none, long, short, dash and dot, dash and two dots


class Curve(NamedTuple):
    """A curve: its name, "#rrggbb", x and y (m,) with NaN for gaps, and the number of its dashes, 0 for none."""

    name: str
    color: str
    x: FloatArray
    y: FloatArray
    dash: int = 0


class Limit(NamedTuple):
    """A level that must not be passed: its colour, and where the forbidden side is: 1 above, −1 below."""

    value: float
    color: str
    side: int


@dataclass(frozen=True, eq=False)
class Chart:
    """One drawing of curves.

    Args:
        x_title, y_title: with their units.
        limits: levels that must not be passed; those that are near are shown.
        marks: x of vertical lines, for instance where the path begins.
        equal: both axes in the same scale.
        height: of the drawing [pt]; its width is that of the text.
        named: whether the names of the curves stand below it.
    """

    title: str
    x_title: str
    y_title: str
    curves: tuple[Curve, ...]
    limits: tuple[Limit, ...] = ()
    marks: tuple[float, ...] = ()
    height: float = 150.0
    equal: bool = False
    named: bool = True


class Axis(NamedTuple):
    """From `low` to `high`, with ticks at round numbers and their texts."""

    low: float
    high: float
    ticks: tuple[float, ...]
    texts: tuple[str, ...]

    def share(self, value: FloatArray) -> FloatArray:
        """Where values lie, 0…1."""
        return np.asarray((value - self.low) / (self.high - self.low))


def axis(low: float, high: float, most: int = 6, *, tight: bool = False) -> Axis:
    """An axis that shows low … high; `tight` ends exactly there."""
    if not (math.isfinite(low) and math.isfinite(high)):
        low, high = 0.0, 1.0
    size = max(abs(low), abs(high), 1e-12)
    if high - low < 1e-9 * size:  # a level curve
        low, high = low - max(0.05 * size, 1e-9), high + max(0.05 * size, 1e-9)
    if not tight:
        low, high = low - _AIR * (high - low), high + _AIR * (high - low)
    step = _step((high - low) / most)
    ticks = tuple(number * step for number in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1))
    return Axis(low, high, ticks, _texts(ticks, step))


def _step(least: float) -> float:
    power = 10.0 ** math.floor(math.log10(least))
    return next(step * power for step in _STEPS if step * power >= least * (1.0 - 1e-9))


def _texts(ticks: tuple[float, ...], step: float) -> tuple[str, ...]:
    largest = max(map(abs, ticks), default=1.0)
    if largest >= 1e5 or largest < 1e-3:
        return tuple(_power(tick) for tick in ticks)
    decimals = max(0, -math.floor(math.log10(step) + 1e-9))
    if step * 10.0**decimals % 1.0 > 1e-6:  # 2.5
        decimals += 1
    return tuple(f"{tick + 0.0:.{decimals}f}".replace("-", "\u2212") for tick in ticks)


def _power(value: float) -> str:
    if value == 0.0:
        return "0"
    mantissa, exponent = f"{value:.1e}".split("e")
    digits = str(int(exponent)).translate(_SUPERSCRIPTS)
    return f"{mantissa.removesuffix('.0')}·10{digits}".replace("-", "\u2212")


_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def value_axis(chart: Chart, most: int = 5) -> Axis:
    """The y axis: what the curves need, and a limit that is near."""
    values = np.concatenate([curve.y[np.isfinite(curve.y)] for curve in chart.curves] or [np.empty(0)])
    if not len(values):
        return axis(0.0, 1.0, most)
    low, high = float(values.min()), float(values.max())
    room = 0.25 * (high - low)
    near = [limit.value for limit in chart.limits if low - room <= limit.value <= high + room]
    return axis(min([low, *near]), max([high, *near]), most)


def time_axis(chart: Chart, most: int = 9) -> Axis:
    """The x axis: exactly what the curves have."""
    values = np.concatenate([curve.x[np.isfinite(curve.x)] for curve in chart.curves] or [np.zeros(1)])
    return axis(float(values.min()), float(values.max()), most, tight=not chart.equal)


def thinned(curve: Curve, most: int = _MOST_POINTS) -> Curve:
    """With fewer points, its highest and lowest kept: no eye sees the others."""
    count = len(curve.x)
    if count <= most:
        return curve
    edges = np.linspace(0, count, most // 2 + 1).astype(int)
    kept = {0, count - 1}
    for begin, end in pairwise(edges.tolist()):
        part = curve.y[begin:end]
        if np.isfinite(part).any():
            kept |= {begin + int(np.nanargmin(part)), begin + int(np.nanargmax(part))}
        if np.isnan(part).any():
            kept.add(begin + int(np.flatnonzero(np.isnan(part))[0]))
    rows = np.array(sorted(kept))
    return curve._replace(x=curve.x[rows], y=curve.y[rows])
