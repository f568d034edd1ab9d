"""A chart as SVG: lines and letters, the same in a browser and on paper. Lengths are points of the page."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape

import numpy as np

from rvsim.lab.report.chart import Axis, Chart, Curve, axis, thinned, time_axis, value_axis
from rvsim.language import in_its_order, language
from rvsim.robot.arrays import FloatArray

WIDTH = 453.0
_LEFT, _RIGHT, _TOP, _BOTTOM = 50.0, 8.0, 18.0, 30.0
_UNIT_LEFT = 24.0
_LEGEND_LEFT, _LEGEND_ROW, _LEGEND_STROKE = 24.0, 12.0, 18.0
_DASHES = ("", *(f' stroke-dasharray="{d}"' for d in ("6 3", "2 2", "8 2.5 2 2.5", "8 2 2 2 2 2")))
_INK, _MUTED, _GRID = "#1D2733", "#4A5665", "#DFE5ED"
FONTS = "Helvetica, Arial, Liberation Sans, Nimbus Sans, Noto Sans Arabic UI, DejaVu Sans, sans-serif"
_HATCH, _HATCH_STEP = 3.0, 9.0


def chart_svg(chart: Chart, fonts: str = FONTS) -> str:
    """The drawing with its title, axes, grid, limits, curves and their names."""
    legend = list(_legend(chart))
    rows = 1 + max((row for row, _, _ in legend), default=-1)
    height = chart.height + _LEGEND_ROW * rows
    x, y = time_axis(chart), value_axis(chart)
    if chart.equal:
        x, y = _equal(x, y, (WIDTH - _LEFT - _RIGHT) / (chart.height - _TOP - _BOTTOM))
    frame = _Frame(x, y, chart.height)
    body = (*_grid(frame), *_limits(chart, frame), *_marks(chart, frame), *_curves(chart, frame), *_titles(chart))
    names = (_legend_entry(chart.height + _LEGEND_ROW * row, left, curve) for row, left, curve in legend)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH:g} {height:g}" width="{WIDTH:g}" '
        f'height="{height:g}" font-family="{escape(fonts)}" font-size="8" role="img"{_direction()}>'
        f"<title>{escape(chart.title)}</title>{''.join(body)}{''.join(names)}</svg>"
    )


def chart_height(chart: Chart) -> float:
    """How high `chart_svg` is [pt]."""
    return chart.height + _LEGEND_ROW * (1 + max((row for row, _, _ in _legend(chart)), default=-1))


def _direction() -> str:
    """Curves run from left to right, also on a page that does not."""
    return ' direction="ltr"' if language().right_to_left else ""


class _Frame:
    """From values to places on the page."""

    def __init__(self, x: Axis, y: Axis, height: float) -> None:
        self.x, self.y = x, y
        self.left, self.right, self.top, self.bottom = _LEFT, WIDTH - _RIGHT, _TOP, height - _BOTTOM

    def across(self, values: FloatArray) -> FloatArray:
        """Places from the left."""
        return self.left + self.x.share(values) * (self.right - self.left)

    def down(self, values: FloatArray) -> FloatArray:
        """Places from the top."""
        return self.bottom - self.y.share(values) * (self.bottom - self.top)


def _equal(x: Axis, y: Axis, aspect: float) -> tuple[Axis, Axis]:
    """Both axes in one scale: the one with too little is widened."""
    wide, high = x.high - x.low, y.high - y.low
    if wide < aspect * high:
        middle = 0.5 * (x.low + x.high)
        return axis(middle - 0.5 * aspect * high, middle + 0.5 * aspect * high, 9, tight=True), y
    middle = 0.5 * (y.low + y.high)
    return x, axis(middle - 0.5 * wide / aspect, middle + 0.5 * wide / aspect, 5, tight=True)


def _line(x1: float, y1: float, x2: float, y2: float, color: str, width: float, more: str = "") -> str:
    return (
        f'<path d="M{x1:.2f} {y1:.2f}L{x2:.2f} {y2:.2f}" stroke="{color}" stroke-width="{width:g}" fill="none"{more}/>'
    )


def _text(x: float, y: float, text: str, anchor: str = "start", color: str = _INK, more: str = "") -> str:
    return (
        f'<text x="{x:.2f}" y="{y:.2f}" text-anchor="{anchor}" fill="{color}"{more}>{escape(in_its_order(text))}</text>'
    )


def _grid(frame: _Frame) -> Iterator[str]:
    for place, text in zip(frame.across(np.array(frame.x.ticks)), frame.x.texts, strict=True):
        yield _line(place, frame.top, place, frame.bottom, _GRID, 0.6)
        yield _text(place, frame.bottom + 10.0, text, "middle")
    for place, text in zip(frame.down(np.array(frame.y.ticks)), frame.y.texts, strict=True):
        yield _line(frame.left, place, frame.right, place, _GRID, 0.6)
        yield _text(frame.left - 4.0, place + 2.8, text, "end")
    yield _line(frame.left, frame.bottom, frame.right, frame.bottom, _MUTED, 0.8)
    yield _line(frame.left, frame.top, frame.left, frame.bottom, _MUTED, 0.8)


def _limits(chart: Chart, frame: _Frame) -> Iterator[str]:
    """A thin line in the colour of its joint, hatched on the forbidden side, so that it is no curve to any eye."""
    for value, color, side in chart.limits:
        if frame.y.low <= value <= frame.y.high:
            place = float(frame.down(np.array(value)))
            strokes = "".join(
                f"M{left:.1f} {place:.2f}l{_HATCH:g} {-side * _HATCH:g}"
                for left in np.arange(frame.left + 2.0, frame.right - _HATCH, _HATCH_STEP)
            )
            yield _line(frame.left, place, frame.right, place, color, 0.6)
            yield f'<path d="{strokes}" stroke="{color}" stroke-width="0.5" fill="none"/>'


def _marks(chart: Chart, frame: _Frame) -> Iterator[str]:
    for mark in chart.marks:
        if frame.x.low < mark < frame.x.high:
            place = float(frame.across(np.array(mark)))
            yield _line(place, frame.top, place, frame.bottom, _MUTED, 0.6, ' stroke-dasharray="3 2"')


def _curves(chart: Chart, frame: _Frame) -> Iterator[str]:
    for curve in chart.curves:
        shown = curve if chart.equal else thinned(curve)
        d = _path(frame.across(shown.x), frame.down(shown.y))
        if d:
            yield (
                f'<path d="{d}" stroke="{curve.color}" stroke-width="1.3" fill="none" stroke-linejoin="round"'
                f"{_DASHES[curve.dash]}/>"
            )


def _path(x: FloatArray, y: FloatArray) -> str:
    parts, pen_down = [], False
    for left, down in zip(x.tolist(), y.tolist(), strict=True):
        known = left == left and down == down
        if known:
            parts.append(f"{'L' if pen_down else 'M'}{left:.2f} {down:.2f}")
        pen_down = known
    return "".join(parts)


def _titles(chart: Chart) -> Iterator[str]:
    left = max(_LEFT, _UNIT_LEFT + _name_width(chart.y_title) + 8.0)
    yield _text(left, 10.0, chart.title, more=' font-weight="bold" font-size="8.5"')
    yield _text(WIDTH - _RIGHT, chart.height - 8.0, chart.x_title, "end", _MUTED)
    yield _text(_UNIT_LEFT, 10.0, chart.y_title, color=_MUTED)


def _legend(chart: Chart) -> Iterator[tuple[int, float, Curve]]:
    """Row, place from the left, and curve; a chart of one curve says in its title what it is."""
    if len(chart.curves) < 2 or not chart.named:
        return
    row, left = 0, _LEGEND_LEFT
    for curve in chart.curves:
        width = _LEGEND_STROKE + 4.0 + _name_width(curve.name) + 10.0
        if left + width > WIDTH and left > _LEGEND_LEFT:
            row, left = row + 1, _LEGEND_LEFT
        yield row, left, curve
        left += width


def _name_width(name: str) -> float:
    """About how wide a name is: letters are known to be narrow or wide, whatever the font."""
    return sum(2.4 if letter in "ijlt rf" else 7.2 if letter in "mwMW" else 4.7 for letter in name)


def _legend_entry(top: float, left: float, curve: Curve) -> str:
    middle = top + 4.0
    stroke = _line(left, middle, left + _LEGEND_STROKE, middle, curve.color, 1.8, _DASHES[curve.dash])
    return stroke + _text(left + _LEGEND_STROKE + 4.0, middle + 2.8, curve.name)
