"""A help page as a rich text: formulas become pictures in the letters' colour and size, tables and headings get air.

A formula stands in a block of its own, a line each,

    ```math
    \tau = J^T F
    ```

or in a line between dollar signs: $\tau$.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import (
    QBrush,
    QColor,
    QFont,
    QFontMetricsF,
    QImage,
    QPainter,
    QTextBlock,
    QTextBlockFormat,
    QTextCharFormat,
    QTextCursor,
    QTextDocument,
    QTextFormat,
    QTextFragment,
    QTextFrame,
    QTextFrameFormat,
    QTextImageFormat,
    QTextLength,
    QTextTable,
)

from rvsim.gui.formula import SIZE, plain_text, typeset
from rvsim.gui.help.library import slug_of
from rvsim.language import has_right_to_left

SCHEME = "math:"
_FENCE = re.compile(r"^```math\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_CODE = re.compile(r"(^```.*?^```$|`[^`\n]+`)", re.MULTILINE | re.DOTALL)
_INLINE = re.compile(r"\$([^$\n]+)\$")
_BLOCK = re.compile(r"(^```.*?^```$)", re.MULTILINE | re.DOTALL)
_ROW = re.compile(r"^\|(.*)\|[ \t]*$", re.MULTILINE)  # of a table
_BAR = re.compile(r"(?<!\\)\|")
_MARKS = re.compile(r"[^\w\s=+()/.,°·√×−]")  # others would be marks of Markdown, and break the words into pieces
_RELATIVE_SIZE = 1.16  # the letters of formulas are small for their size
_LARGER = {1: 2, 2: 1}  # headings, in steps of a fifth or so
_TRY = "▶"  # begins an example
_INDENT, _FLAT = 20.0, 4.0  # [pixels]
_TABLE = 99.0  # per cent of the width


class Look(NamedTuple):
    """What the pictures and tables are made for: the font, the colours, and the pixels of the screen a unit."""

    font: QFont
    text: QColor
    border: QColor
    ground: QColor
    ratio: float


class Prepared(NamedTuple):
    """A page ready for `setMarkdown`, and the formulas that its pictures `math:0`, `math:1`, … show."""

    markdown: str
    formulas: tuple[str, ...]


def prepared(source: str) -> Prepared:
    """A page with a picture for each of its formulas."""
    formulas: list[str] = []

    def picture(latex: str) -> str:
        formulas.append(latex.strip())
        words = _MARKS.sub(" ", plain_text(latex.strip()))
        return f"![{words}]({SCHEME}{len(formulas) - 1})"

    def block(found: re.Match[str]) -> str:
        return "\n\n".join(picture(line) for line in found[1].splitlines() if line.strip())

    parts = _CODE.split(_FENCE.sub(block, source))
    parts[::2] = [_INLINE.sub(lambda found: picture(found[1]), part) for part in parts[::2]]
    page = "".join(parts)
    if has_right_to_left(page.partition("\n")[0]):
        parts = _BLOCK.split(page)
        parts[::2] = [_ROW.sub(_turned, part) for part in parts[::2]]
        page = "".join(parts)
    return Prepared(page, tuple(formulas))


def _turned(row: re.Match[str]) -> str:
    """A row of a table with its last cell first: Qt lays tables out from left to right alone."""
    return "|".join(["", *reversed(_BAR.split(row[1])), ""])


# --- formulas ------------------------------------------------------------------------------------------------------


def formula_image(latex: str, look: Look) -> QImage:
    """A formula as a picture that, put in the middle of a line, has its baseline on the line's.

    One that cannot be set is written as text.
    """
    scale = _RELATIVE_SIZE * _pixels(look.font) / SIZE
    made = typeset(latex)
    width, ascent, descent = (
        (scale * made.width, scale * made.ascent, scale * made.descent) if made else _text_size(latex, look.font)
    )
    above, below = _balanced(ascent, descent, QFontMetricsF(look.font).xHeight())
    size = QRectF(0.0, 0.0, width + 2.0, above + below) if width else QRectF(0.0, 0.0, 2.0, 2.0)
    image = QImage(size.size().toSize() * look.ratio, QImage.Format.Format_ARGB32_Premultiplied)
    image.setDevicePixelRatio(look.ratio)
    image.fill(0)
    painter = QPainter(image)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.translate(1.0, above)
    if made:
        painter.scale(scale, scale)
        painter.fillPath(made.path, QBrush(look.text))
    else:
        painter.setPen(look.text)
        painter.setFont(look.font)
        painter.drawText(0, 0, plain_text(latex))
    painter.end()
    return image


def _balanced(ascent: float, descent: float, x_height: float) -> tuple[float, float]:
    """Room above and below a baseline that lies half an x-height under the middle: there Qt puts a picture's middle."""
    if ascent - descent > x_height:
        return ascent, ascent - x_height
    return descent + x_height, descent


def _text_size(latex: str, font: QFont) -> tuple[float, float, float]:
    metrics = QFontMetricsF(font)
    return metrics.horizontalAdvance(plain_text(latex)), metrics.ascent(), metrics.descent()


def _pixels(font: QFont) -> float:
    return QFontMetricsF(font).height() / 1.17


# --- the text ------------------------------------------------------------------------------------------------------


def dress(document: QTextDocument, look: Look, slugs: Sequence[str] = ()) -> None:
    """Give headings, paragraphs, formulas, code and tables their looks, and headings their anchors: `slugs`, in order.

    Headings for which there is no slug have one of their own words.
    """
    document.setIndentWidth(_INDENT)
    anchors = iter(slugs)
    for block in _blocks(document):
        _dress_block(block, look, anchors)
    for table in _tables(document.rootFrame()):
        _dress_table(table, look)
    if has_right_to_left(document.firstBlock().text()):
        _mirror(document)
    for block in reversed([block for block in _blocks(document) if block.text().startswith(_TRY)]):
        _frame(block, look)


def _mirror(document: QTextDocument) -> None:
    """Words from right to left, formulas on that side too; code stays where it is."""
    for block in _blocks(document):
        shape = QTextBlockFormat(block.blockFormat())
        if has_right_to_left(block.text()):
            shape.setLayoutDirection(Qt.LayoutDirection.RightToLeft)
        elif not _is_code(shape):
            shape.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignAbsolute)
            shape.setRightMargin(shape.leftMargin())
            shape.setLeftMargin(0.0)
        QTextCursor(block).setBlockFormat(shape)


def _is_code(shape: QTextBlockFormat) -> bool:
    properties = (QTextFormat.Property.BlockCodeLanguage, QTextFormat.Property.BlockCodeFence)
    return any(shape.hasProperty(one) for one in properties)


def _frame(block: QTextBlock, look: Look) -> None:
    """An example looks like a button as wide as the page."""
    shape = QTextFrameFormat()
    shape.setBackground(look.ground)
    shape.setBorder(1.0)
    shape.setBorderStyle(QTextFrameFormat.BorderStyle.BorderStyle_Solid)
    shape.setBorderBrush(look.border)
    shape.setPadding(4.0)
    cursor = QTextCursor(block)
    cursor.movePosition(QTextCursor.MoveOperation.EndOfBlock, QTextCursor.MoveMode.KeepAnchor)
    _flatten(cursor.insertFrame(shape))


def _flatten(frame: QTextFrame) -> None:
    """The empty lines that a frame puts before and behind itself."""
    before = frame.firstCursorPosition().block().previous()
    behind = frame.lastCursorPosition().block().next()
    for block in (before, behind):
        if block.isValid() and not block.text():
            shape = QTextBlockFormat()
            shape.setLineHeight(_FLAT, QTextBlockFormat.LineHeightTypes.FixedHeight.value)
            QTextCursor(block).setBlockFormat(shape)


def _blocks(document: QTextDocument) -> Iterator[QTextBlock]:
    block = document.begin()
    while block.isValid():
        yield block
        block = block.next()


def _dress_block(block: QTextBlock, look: Look, slugs: Iterator[str]) -> None:
    cursor, shape = QTextCursor(block), QTextBlockFormat(block.blockFormat())
    in_table = cursor.currentTable() is not None
    level = shape.headingLevel()
    if level:
        _dress_heading(block, level, next(slugs, slug_of(block.text())))
        shape.setTopMargin(0.0 if level == 1 else 16.0)
        shape.setBottomMargin(6.0)
    elif _is_code(shape):
        shape.setBackground(look.ground)
        shape.setLeftMargin(_INDENT)
        shape.setNonBreakableLines(False)  # nothing scrolls sideways
    elif not in_table:
        shape.setTopMargin(2.0 if block.textList() else 5.0)
        shape.setBottomMargin(2.0 if block.textList() else 5.0)
        shape.setLineHeight(118.0, QTextBlockFormat.LineHeightTypes.ProportionalHeight.value)
    cursor.setBlockFormat(shape)
    _dress_pictures(block, alone=not in_table)


def _dress_heading(block: QTextBlock, level: int, slug: str) -> None:
    cursor = QTextCursor(block)
    letters = QTextCharFormat()
    letters.setProperty(QTextFormat.Property.FontSizeAdjustment, _LARGER.get(level, 0))
    letters.setFontWeight(QFont.Weight.DemiBold)
    letters.setAnchor(True)
    letters.setAnchorNames([slug])
    cursor.movePosition(QTextCursor.MoveOperation.EndOfBlock, QTextCursor.MoveMode.KeepAnchor)
    cursor.mergeCharFormat(letters)


def _dress_pictures(block: QTextBlock, *, alone: bool) -> None:
    places = [
        (fragment.position(), fragment.charFormat().toImageFormat())
        for fragment in _fragments(block)
        if fragment.charFormat().isImageFormat()
    ]
    for position, image in places:
        _sit_on_the_line(block, position, image)
    if alone and places and len(block.text()) == 1:
        cursor = QTextCursor(block)
        shape = QTextBlockFormat(block.blockFormat())
        shape.setLeftMargin(_INDENT)
        cursor.setBlockFormat(shape)


def _fragments(block: QTextBlock) -> Iterator[QTextFragment]:
    at = block.begin()
    while not at.atEnd():
        yield at.fragment()
        at += 1


def _sit_on_the_line(block: QTextBlock, position: int, image: QTextImageFormat) -> None:
    if image.name().startswith(SCHEME):
        cursor = QTextCursor(block)
        cursor.setPosition(position)
        cursor.setPosition(position + 1, QTextCursor.MoveMode.KeepAnchor)
        image.setVerticalAlignment(QTextCharFormat.VerticalAlignment.AlignMiddle)
        cursor.setCharFormat(image)


def _tables(frame: QTextFrame) -> Iterator[QTextTable]:
    for child in frame.childFrames():
        if isinstance(child, QTextTable):
            yield child
        yield from _tables(child)


def _dress_table(table: QTextTable, look: Look) -> None:
    shape = table.format()
    shape.setBorderCollapse(True)
    shape.setBorder(1.0)
    shape.setBorderStyle(QTextFrameFormat.BorderStyle.BorderStyle_Solid)
    shape.setBorderBrush(look.border)
    shape.setCellPadding(4.0)
    shape.setCellSpacing(0.0)
    shape.setTopMargin(6.0)
    shape.setBottomMargin(8.0)
    shape.setWidth(QTextLength(QTextLength.Type.PercentageLength, _TABLE))
    table.setFormat(shape)
    for column in range(table.columns()):
        cell = table.cellAt(0, column)
        letters = cell.format()
        letters.setBackground(look.ground)
        cell.setFormat(letters)
