"""Tables as strips: three rules, columns as wide as what is in them, the head repeated on the next page."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from PySide6.QtCore import QPointF
from PySide6.QtGui import QPainter, QPen

from rvsim.gui.report import typography as faces
from rvsim.gui.report.strips import Set, Strip, caption_runs, set_formula, text_strips
from rvsim.gui.report.typography import RULE, Face, Text, aside, from_right, text_width
from rvsim.lab.report.values import ASSUMED, Align, Column, Run, Table, Words, is_marked, runs

_PAD, _FAIR_PAD, _LEAST_PAD = 7.0, 3.5, 2.5  # at each side of a cell
_FAIR_SCALE, _LEAST_SCALE = 0.93, 0.74  # of letters
_BROKEN = 0.62  # of the width that its text has in one line is enough for a column that may break it
_SPREAD = 0.85  # of the page: a table as wide as that takes all of it
_MATH_SIZE = 9.5
_THICK, _THIN = 1.0, 0.5
_SMALL = 14  # rows
_MARK = f" {ASSUMED}"


class _Grid(NamedTuple):
    """Where the columns are: left edges and widths without their padding; how much smaller than usual all of it is.

    `left` is where the table begins; `mirrored`: its columns are read from right to left; `hanging`: those in which
    numbers leave room for a mark.
    """

    lefts: tuple[float, ...]
    widths: tuple[float, ...]
    width: float
    scale: float
    left: float = 0.0
    mirrored: bool = False
    hanging: tuple[bool, ...] = ()


def table_strips(table: Table, width: float) -> Iterator[Strip]:
    """Caption, head, rows, note."""
    grid = _grid(table, width)
    caption = Text(caption_runs(table.caption), faces.CAPTION, width)
    yield Strip(caption.height, caption.draw, 14.0, keep=True, floats="table" if len(table.rows) <= _SMALL else "")
    head = _row(tuple(column.head for column in table.columns), table.columns, grid, faces.HEAD, (_THICK, _THIN))
    if any(_is_head(column.head) for column in table.columns):
        yield head._replace(above=4.0, keep=True)
    else:
        head = _rule(grid)
        yield head._replace(above=4.0, keep=True)
    yield from _rows(table, grid, head)
    note = list(text_strips(table.note, faces.NOTE, width, above=3.0)) if table.note else []
    *kept, last = [_rule(grid), *note]
    yield from (strip._replace(keep=True) for strip in kept)
    yield last._replace(below=8.0)


def _is_head(head: Words) -> bool:
    return any(run.text for run in runs(head))


def _rows(table: Table, grid: _Grid, head: Strip) -> Iterator[Strip]:
    """A small table stays in one piece; of a long one two rows stay with the head, and two with the rule below."""
    count = len(table.rows)
    whole = count <= _SMALL
    for number, row in enumerate(table.rows):
        rule = _THIN if table.totals and number == count - table.totals else 0.0
        strip = _row(row, table.columns, grid, faces.CELL, (rule, 0.0))
        yield strip._replace(keep=whole or number in (0, count - 2, count - 1), again=(head,))


def _rule(grid: _Grid) -> Strip:
    return Strip(_THICK, lambda painter, x, y: _line(painter, x + grid.left, y, grid.width, _THICK))


def _line(painter: QPainter, x: float, y: float, width: float, thickness: float) -> None:
    painter.setPen(QPen(RULE, thickness))
    painter.drawLine(QPointF(x, y), QPointF(x + width, y))


def _grid(table: Table, width: float) -> _Grid:
    natural = [_natural(index, column, table) for index, column in enumerate(table.columns)]
    natural = _broken(natural, table.columns, width - 2.0 * _FAIR_PAD * len(natural))
    pad = _PAD
    while sum(natural) + 2.0 * pad * len(natural) > width and pad > _LEAST_PAD:
        pad -= 0.5
    scale = min(1.0, max(_LEAST_SCALE, (width - 2.0 * pad * len(natural)) / sum(natural)))
    widths = [scale * each for each in natural]
    over = sum(widths) + 2.0 * pad * len(widths) - width
    if over > 0.0:
        widths = _narrowed(widths, table.columns, over)
    used = sum(widths) + 2.0 * pad * len(widths)
    if used > _SPREAD * width:
        pad += max(0.0, width - used) / (2.0 * len(widths))
        used = max(used, width)
    lefts, at = [], 0.0
    for each in widths:
        lefts.append(at + pad)
        at += each + 2.0 * pad
    left = aside(width, 0.0, used)
    mirrored = from_right() and not table.of_numbers
    if mirrored:
        lefts = [used - begin - each for begin, each in zip(lefts, widths, strict=True)]
    hanging = tuple(map(table.hanging, range(len(widths))))
    return _Grid(tuple(left + begin for begin in lefts), tuple(widths), used, scale, left, mirrored, hanging)


def _natural(index: int, column: Column, table: Table) -> float:
    room = text_width(_MARK, faces.CELL) if table.hanging(index) else 0.0
    cells = (_cell_width(row[index]) + (0.0 if is_marked(row[index]) else room) for row in table.rows)
    return max(text_width(column.head, faces.HEAD), *cells, 4.0) + 0.5


def _cell_width(words: Words) -> float:
    formula = _math(words)
    return set_formula(formula, _MATH_SIZE, 1e4).width if formula else text_width(words, faces.CELL)


def _math(words: Words) -> str:
    """The LaTeX of a cell that is a formula."""
    first = runs(words)[0] if runs(words) else Run("")
    return first.text if first.style == "math" else ""


def _broken(widths: list[float], columns: tuple[Column, ...], most: float) -> list[float]:
    """Text that may stand in two lines does so before all letters become much smaller."""
    over, count = sum(widths) - most, sum(column.wide for column in columns)
    if _FAIR_SCALE * sum(widths) <= most:
        return widths
    return [
        max(each - over / count, _BROKEN * each) if column.wide else each
        for each, column in zip(widths, columns, strict=True)
    ]


def _narrowed(widths: list[float], columns: tuple[Column, ...], over: float) -> list[float]:
    """The columns whose text may break give what is missing; where there is none, the widest of words does."""
    wide = [i for i, column in enumerate(columns) if column.wide] or [
        max((i for i, column in enumerate(columns) if column.align == "left"), key=lambda i: widths[i], default=0)
    ]
    share = over / len(wide)
    return [max(each - share, 30.0) if i in wide else each for i, each in enumerate(widths)]


def _row(
    cells: tuple[Words, ...], columns: tuple[Column, ...], grid: _Grid, face: Face, rules: tuple[float, float]
) -> Strip:
    """One row on a common baseline; `rules` are the thicknesses of the lines above and below it."""
    made = [_cell(cell, face, width, grid.scale) for cell, width in zip(cells, grid.widths, strict=True)]
    air = 2.0 if face is faces.CELL else 3.0
    mark = grid.scale * text_width(_MARK, face) if face is faces.CELL else 0.0
    shifts = [
        _shift(column.align, width - cell.width, mark if bare and not is_marked(words) else 0.0, mirrored=grid.mirrored)
        for words, cell, column, width, bare in zip(cells, made, columns, grid.widths, grid.hanging, strict=True)
    ]
    ascent = max(cell.ascent for cell in made)
    height = air + max(ascent + max(cell.descent for cell in made), face.leading * grid.scale)

    def draw(painter: QPainter, x: float, y: float) -> None:
        for thickness, at in ((rules[0], y), (rules[1], y + height)):
            if thickness:
                _line(painter, x + grid.left, at, grid.width, thickness)
        for cell, left, shift in zip(made, grid.lefts, shifts, strict=True):
            _draw_cell(cell, painter, x + left + shift, y + 0.5 * air + ascent)

    return Strip(height, draw)


def _shift(align: Align, free: float, mark: float, *, mirrored: bool) -> float:
    """How far from the left of its column a cell begins, with so much free space beside it, or left for a mark."""
    return {"left": free if mirrored else 0.0, "center": 0.5 * free, "right": free - mark}[align]


def _cell(words: Words, face: Face, width: float, scale: float) -> Text | Set:
    formula = _math(words)
    if formula:
        return set_formula(formula, _MATH_SIZE * scale, width)
    return Text(words, face, width + 1.0, scale=scale)


def _draw_cell(cell: Text | Set, painter: QPainter, x: float, baseline: float) -> None:
    if isinstance(cell, Text):
        cell.draw(painter, x - cell.left, baseline - cell.ascent)
    else:
        cell.draw(painter, x, baseline)
