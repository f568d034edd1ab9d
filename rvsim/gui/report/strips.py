"""A document as strips of paper that are not cut: lines, rows, formulas, pictures, with what holds them together."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Literal, NamedTuple

from PySide6.QtCore import QByteArray, QPointF, QRectF
from PySide6.QtGui import QImage, QPainter, QPen
from PySide6.QtSvg import QSvgRenderer

from rvsim.gui.formula import Typeset, plain_text, typeset
from rvsim.gui.report import typography as faces
from rvsim.gui.report.artist import painted
from rvsim.gui.report.typography import ACCENT, INK, Face, Text, aside
from rvsim.lab.report.chart import Chart
from rvsim.lab.report.chart_svg import chart_height, chart_svg
from rvsim.lab.report.values import (
    Block,
    Figure,
    Formula,
    Formulas,
    Items,
    Paragraph,
    Run,
    ScenePicture,
    Section,
    Subheading,
    Words,
    runs,
)

FORMULA_SIZE = 10.5
_SET_AT = 16.0  # what formulas are set at
_ITEM = 18.0  # how far in an item stands: as wide as its mark
_INDENT, _LABEL, _GAP, _APART = 20.0, 44.0, 9.0, 28.0
_LEAST_FORMULA = 0.85  # of their size is what formulas in columns keep
_LABEL_ROOM, _LABEL_UP = 60.0, 7.4
_PICTURE_SHARE = 0.82  # of the width
_SMALLER = (0.92, 0.84, 0.76)  # of the height of a picture, where the page has no room for all of it
_FACES = {"body": faces.BODY, "note": faces.NOTE, "lead": faces.LEAD, "own": faces.BODY}

_LED_TO = (Formulas, Items)  # what the paragraph before speaks of

Draw = Callable[[QPainter, float, float], None]
Float = Literal["", "figure", "table"]


class Strip(NamedTuple):
    """A piece of the page.

    Args:
        height: [pt].
        draw: paints it with its upper left corner at x, y.
        above: the space above it, which the top of a page swallows.
        keep: not parted from the next one.
        below: the space below it, which the end of a page swallows.
        again: what is repeated above it where a page begins with it.
        floats: which queue it may wait in for the next page, while what follows fills this one; "" for none.
        begins: a section begins with it, for which the foot of a page is no place.
        goes_on: it belongs to what stands before it, so that no figure comes between.
        smaller: what may stand for it, and for what is kept with it, where the page has no room for them.
    """

    height: float
    draw: Draw
    above: float = 0.0
    keep: bool = False
    below: float = 0.0
    again: tuple[Strip, ...] = ()
    floats: Float = ""
    begins: bool = False
    goes_on: bool = False
    smaller: tuple[tuple[Strip, ...], ...] = ()


def section_strips(section: Section, width: float) -> Iterator[Strip]:
    """The title of a section, then all its blocks."""
    words = (Run(f"{section.number}  "), Run(section.title))
    title = Text(words, faces.SECTION, width)
    yield Strip(title.height, _section_title(section, title, width), 26.0, keep=True, begins=True)
    held = False
    for block, following in zip(section.blocks, (*section.blocks[1:], None), strict=True):
        goes_on, held = held, _belong_together(block, following)
        strips = list(block_strips(block, width))
        if held:
            strips[-1] = strips[-1]._replace(keep=True)
        for number, strip in enumerate(strips):
            yield strip._replace(goes_on=goes_on or number > 0)


def _belong_together(block: Block, following: Block | None) -> bool:
    """What a paragraph leads to, formulas that follow from each other, and what is remarked on a formula."""
    if isinstance(following, Paragraph):
        return isinstance(block, Formula) and following.role == "note"
    if isinstance(following, Formula):
        return isinstance(block, Paragraph | Formula)
    return isinstance(block, Paragraph) and isinstance(following, _LED_TO)


def _section_title(section: Section, title: Text, width: float) -> Draw:
    number = Text(section.number, faces.SECTION._replace(color=ACCENT), width)

    def draw(painter: QPainter, x: float, y: float) -> None:
        title.draw(painter, x, y)
        number.draw(painter, x, y)

    return draw


def block_strips(block: Block, width: float) -> Iterator[Strip]:
    """The strips of one block."""
    from rvsim.gui.report.table_strips import table_strips  # it is made of strips itself

    match block:
        case Paragraph():
            yield from text_strips(block.words, _FACES[block.role], width, above=5.0, justified=block.role != "note")
        case Subheading():
            title = Text(block.words, faces.SUBHEAD, width)
            yield Strip(title.height, title.draw, 14.0, keep=True)
        case Items():
            yield from _items(block, width)
        case Formula():
            yield from _formula(block, width)
        case Formulas():
            yield from _formulas(block, width)
        case Figure():
            yield from _figure(block, width)
        case _:
            yield from table_strips(block, width)


def text_strips(
    words: Words, face: Face, width: float, *, above: float, justified: bool = False, indent: float = 0.0
) -> Iterator[Strip]:
    """One strip a line; the first two stay together, and the last two."""
    text = Text(words, face, width - indent, justified=justified)
    for number in range(text.count):
        keep = text.count > 1 and number in (0, text.count - 2)
        left = aside(width, indent, text.room)
        yield Strip(text.leading, _line(text, number, left), above if number == 0 else 0.0, keep)


def _line(text: Text, number: int, left: float) -> Draw:
    return lambda painter, x, y: text.draw(painter, x + left, y, number, number + 1)


def _items(block: Items, width: float) -> Iterator[Strip]:
    """The first two items stay together, and the last two."""
    marks = block.marks or (Run("•"),) * len(block.items)
    for number, (mark, item) in enumerate(zip(marks, block.items, strict=True)):
        sign = Text(mark, faces.BODY, _ITEM)
        strips = list(text_strips(item, faces.BODY, width, above=3.0, indent=_ITEM))
        strips[0] = strips[0]._replace(draw=_both(sign, aside(width, 3.0, sign.room), 0.0, strips[0].draw))
        if number + 1 < len(block.items) and number in (0, len(block.items) - 2):
            strips[-1] = strips[-1]._replace(keep=True)
        yield from strips


def _both(sign: Text, left: float, down: float, rest: Draw) -> Draw:
    def draw(painter: QPainter, x: float, y: float) -> None:
        sign.draw(painter, x + left, y + down)
        rest(painter, x, y)

    return draw


# --- formulas ------------------------------------------------------------------------------------------------------


class Set(NamedTuple):
    """A formula in its size: how wide, how high above and below its baseline [pt], and what paints it there."""

    width: float
    ascent: float
    descent: float
    draw: Draw


def set_formula(latex: str, size: float, most: float) -> Set:
    """A formula no wider than `most`: smaller if it has to be; as text where it cannot be set."""
    found = typeset(latex)
    if found is None:
        text = Text(plain_text(latex), faces.BODY, most)
        return Set(text.width, 0.75 * text.leading, 0.25 * text.leading,
                   lambda painter, x, y: text.draw(painter, x, y - 0.75 * text.leading))  # fmt: skip
    scale = min(size / _SET_AT, most / max(found.width, 1.0))
    return Set(found.width * scale, found.ascent * scale, found.descent * scale, _painted(found, scale))


def _painted(found: Typeset, scale: float) -> Draw:
    def draw(painter: QPainter, x: float, y: float) -> None:
        painter.save()
        painter.translate(x, y)
        painter.scale(scale, scale)
        painter.fillPath(found.path, INK)
        painter.restore()

    return draw


def _formula(block: Formula, width: float) -> Iterator[Strip]:
    """Its parts side by side as long as there is room, then on lines of their own, further in."""
    left = _INDENT + (_LABEL if block.label else 0.0)
    parts = [
        set_formula(part, FORMULA_SIZE, width - left - (_INDENT if number else 0.0))
        for number, part in enumerate(block.parts)
    ]
    lines = _flowed(parts, width - left)
    begins = [left + (_INDENT if number else 0.0) for number in range(len(lines))]
    shift = _shift(lines, begins, width)
    label = Text(block.label.strip(), faces.NOTE, _LABEL_ROOM)
    for number, line in enumerate(lines):
        strip = _formula_line(begins[number] + shift, line, _GAP, keep=number < len(lines) - 1)
        raised = max(part.ascent for part in line) - _LABEL_UP
        named = _both(label, aside(width, _INDENT, label.room), raised, strip.draw)
        yield strip if number else strip._replace(draw=named)


def _formulas(block: Formulas, width: float) -> Iterator[Strip]:
    """In columns as wide as the widest of them, and a little smaller where one more column fits then."""
    room = width - _INDENT + _APART
    widest = max(set_formula(part, FORMULA_SIZE, width - _INDENT).width for part in block.parts)
    count = min(max(1, int(room / (_LEAST_FORMULA * widest + _APART))), len(block.parts))
    share = min(1.0, (room / count - _APART) / widest)
    parts = [set_formula(part, share * FORMULA_SIZE, width - _INDENT) for part in block.parts]
    column = share * widest
    begin = aside(width, _INDENT, count * (column + _APART) - _APART)
    for number in range(0, len(parts), count):
        yield _formula_line(begin, parts[number : number + count], _APART, column=column)


def _shift(lines: list[list[Set]], begins: list[float], width: float) -> float:
    """How far lines of formulas move together to where reading begins; each of them is read from the left."""
    ends = [begin + sum(part.width + _GAP for part in line) - _GAP for begin, line in zip(begins, lines, strict=True)]
    return aside(width, min(begins), max(ends) - min(begins)) - min(begins)


def _flowed(parts: list[Set], width: float) -> list[list[Set]]:
    """Parts in lines; those after the first begin further in."""
    lines: list[list[Set]] = []
    room = 0.0
    for part in parts:
        if lines and part.width + _GAP <= room:
            lines[-1].append(part)
            room -= part.width + _GAP
        else:
            room = width - part.width - (_INDENT if lines else 0.0)
            lines.append([part])
    return lines


def _formula_line(begin: float, line: list[Set], gap: float, *, column: float = 0.0, keep: bool = False) -> Strip:
    """Formulas on one baseline, each in a column of that width, if one is given."""
    ascent, descent = max(part.ascent for part in line), max(part.descent for part in line)

    def draw(painter: QPainter, x: float, y: float) -> None:
        at = x + begin
        for part in line:
            part.draw(painter, at, y + ascent)
            at += max(part.width, column) + gap

    return Strip(ascent + descent, draw, 6.0, keep)


# --- figures -------------------------------------------------------------------------------------------------------


def _figure(block: Figure, width: float) -> Iterator[Strip]:
    """Pictures with the caption below them, in one piece; smaller ones may stand for them."""
    first, *others = _pictures(block, width, 1.0)
    yield first._replace(smaller=tuple(tuple(_pictures(block, width, share)) for share in _SMALLER))
    yield from others


def _pictures(block: Figure, width: float, share: float) -> Iterator[Strip]:
    """The same with pictures that are lower."""
    for number, picture in enumerate(block.pictures):
        above = 14.0 if number == 0 else 8.0
        strip = _chart(picture, width, share) if isinstance(picture, Chart) else _picture(picture, width, share)
        yield strip._replace(above=above, keep=True, floats="figure")
    caption = Text(caption_runs(block.caption), faces.CAPTION, width)
    yield Strip(caption.height, caption.draw, 6.0, below=8.0)


def caption_runs(caption: str) -> tuple[Run, ...]:
    """ "Figure 1:" in bold, then its text."""
    name, colon, text = caption.partition(": ")
    return (Run(f"{name}:", "bold"), Run(f" {text}")) if colon else runs(caption)


def _chart(chart: Chart, width: float, share: float) -> Strip:
    """Curves are lower, their letters as large as ever."""
    chart = replace(chart, height=share * chart.height)
    height = chart_height(chart)

    def draw(painter: QPainter, x: float, y: float) -> None:
        drawing = QSvgRenderer(QByteArray(chart_svg(chart, faces.sans_family()).encode()))
        drawing.render(painter, QRectF(x, y, width, height))

    return Strip(height, draw)


def _picture(picture: ScenePicture, width: float, share: float) -> Strip:
    wide = _PICTURE_SHARE * share * width
    height = wide * picture.height / picture.width

    def draw(painter: QPainter, x: float, y: float) -> None:
        image = QImage(painted(picture))
        image.setDevicePixelRatio(1.0)
        box = QRectF(QPointF(x + 0.5 * (width - wide), y), QPointF(x + 0.5 * (width + wide), y + height))
        painter.drawImage(box, image)
        painter.setPen(QPen(faces.MUTED, 0.3))
        painter.drawRect(box)

    return Strip(height, draw)
