"""How a row of the branch table is painted: its title across on the first line, its joints in columns below.

A drag repaints the whole table at every step: texts alone, a row at a time, take a tenth of what the style sheet's way
of painting cell by cell takes.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any, NamedTuple

from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QColor, QFont, QFontMetrics, QGuiApplication, QPainter, QPalette
from PySide6.QtWidgets import QStyle, QStyledItemDelegate, QStyleOptionViewItem

from rvsim.gui.panels.tables import LEFT, RIGHT, Index
from rvsim.language import language, left_to_right

PAD, GAP = 4, 8
_CENTER = Qt.AlignmentFlag.AlignCenter
_SMALLEST, _FINER = 0.6, 0.25  # of the font: narrower than this a number is no longer read; and steps of it [pt]


class RowText(NamedTuple):
    """What is written in a row: its name, its title, the limit that its branch breaks, and its numbers."""

    name: str
    title: str
    stop: str
    numbers: tuple[str, ...]
    usable: bool
    here: bool


def fitting_font(font: QFont, text: str, room: int) -> QFont:
    """The font, as much smaller as it takes for a text to have room, within reason."""
    fitting = QFont(font)
    while QFontMetrics(fitting).horizontalAdvance(text) > room and fitting.pointSizeF() > _SMALLEST * font.pointSizeF():
        fitting.setPointSizeF(fitting.pointSizeF() - _FINER)
    return fitting


class GroundDelegate(QStyledItemDelegate):
    """Paints the ground of a chosen row, and no text."""

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, _index: Index) -> None:
        """The highlight."""
        view: Any = option  # its fields are known to no type checker
        if view.state & QStyle.StateFlag.State_Selected:
            painter.fillRect(view.rect, view.palette.highlight())


class RowInk:
    """Fonts for a table's rows.

    The numbers' font may be smaller than the window's; the title of the row where the arm stands is a little heavier.
    """

    def __init__(self, widest: str = "", room: int = 0) -> None:
        self.plain, self.bold = QFont(QGuiApplication.font()), QFont(QGuiApplication.font())
        self.bold.setWeight(QFont.Weight.DemiBold)
        self.small = fitting_font(self.plain, widest, room) if widest else self.plain
        self.metrics = {False: QFontMetrics(self.plain), True: QFontMetrics(self.bold)}
        self.line = self.metrics[True].height()

    def fits_beside(self, row: RowText, room: int) -> bool:
        """Whether a title and what its branch breaks have room in one line."""
        metrics = self.metrics[row.here]
        return not row.stop or metrics.horizontalAdvance(row.title) + GAP + metrics.horizontalAdvance(row.stop) <= room

    def paint(self, painter: QPainter, rect: QRect, ends: Sequence[int], row: RowText) -> None:
        """A row: its name at the left, the title from where one reads, the stop at its end or below it, the numbers."""
        painter.setFont(self.bold if row.here else self.plain)
        painter.drawText(QRect(0, rect.y(), ends[0], rect.height()), _CENTER, row.name)
        self._paint_title(painter, QRect(ends[0], rect.y() + 2, rect.width() - ends[0] - PAD, self.line), row)
        painter.setFont(self.small)
        top = rect.y() + rect.height() - self.line - 2
        for (start, end), number in zip(pairwise(ends), row.numbers, strict=True):
            painter.drawText(QRect(start, top, end - start - PAD, self.line), RIGHT, left_to_right(number))

    def _paint_title(self, painter: QPainter, line: QRect, row: RowText) -> None:
        first, last = (RIGHT, LEFT) if language().right_to_left else (LEFT, RIGHT)
        title = self.metrics[row.here].elidedText(row.title, Qt.TextElideMode.ElideRight, line.width())
        painter.drawText(line, first, title)
        if row.stop:
            beside = self.fits_beside(row, line.width())
            stop = self.metrics[row.here].elidedText(row.stop, Qt.TextElideMode.ElideRight, line.width())
            painter.drawText(line if beside else line.translated(0, self.line), last if beside else first, stop)


def row_color(palette: QPalette, *, usable: bool, chosen: bool) -> QColor:
    """The colour of a row's texts."""
    roles = QPalette.ColorRole
    return palette.color(roles.HighlightedText if chosen else roles.Text if usable else roles.PlaceholderText)
