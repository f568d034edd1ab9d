"""A 4×4 transform as the textbook prints it: brackets, columns n o a p, numbers aligned at the decimal point."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPainterPath, QPaintEvent, QPalette, QPen
from PySide6.QtWidgets import QWidget

from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Kind, display, format_number
from rvsim.gui.theme import number_font
from rvsim.gui.widgets import PaintedLines
from rvsim.language import tr
from rvsim.robot.arrays import FloatArray
from rvsim.scene.palette import axis_colors
from rvsim.scene.primitives import Color

_COLUMNS = ("n", "o", "a", "p")
_ENTRY_DECIMALS = 4
_TICK = 6.0  # the short arms of a bracket
_PADDING = 6.0  # between the numbers and the edge of their tint
_MARGIN = 13.0  # between a bracket and the numbers
_TINT = 26  # of 255: a column's colour behind its numbers


class MatrixView(PaintedLines):
    """Shows a transform; its translation in the user's unit; `text()` is what it shows, for screen readers."""

    narrowest = 240

    def __init__(self, preferences: Preferences, title: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._preferences, self._title = preferences, title
        self._matrix: FloatArray = np.eye(4)
        self._kind: Kind = "length"
        self._cells: list[list[str]] = []
        self.setAccessibleName(tr(title))
        self.setLayoutDirection(Qt.LayoutDirection.LeftToRight)
        self.show_matrix(self._matrix, self._kind)

    def show_matrix(self, matrix: FloatArray, length: Kind) -> None:
        """Show T (4, 4), its translation as that kind of length [m]."""
        self._matrix, self._kind = matrix, length
        cells = _cells(matrix, length, self._preferences)
        if cells != self._cells:
            self._cells = cells
            self.setAccessibleDescription(self.text())
            self.update()

    def retranslate_units(self) -> None:
        """Show the same matrix under changed preferences."""
        self.show_matrix(self._matrix, self._kind)

    def text(self) -> str:
        """The numbers as they are shown, row by row."""
        return "\n".join("  ".join(row) for row in self._cells)

    def sizeHint(self) -> QSize:
        """Four rows, the letters above, the last column's unit below."""
        return QSize(320, int(5.2 * self._line_height() + 8))

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Letters, tints, numbers, brackets."""
        painter = QPainter(self)
        painter.setLayoutDirection(Qt.LayoutDirection.LeftToRight)  # it takes that of the application by itself
        painter.setFont(number_font(self.font()))
        metrics = QFontMetricsF(painter.font())
        height = self._line_height()
        columns = self._columns(metrics)
        top = height + 4
        for column, (left, width) in enumerate(columns):
            self._paint_column(painter, column, QRectF(left, 0, width, height), top)
        inner = QRectF(columns[0][0], top, columns[-1][0] + columns[-1][1] - columns[0][0], 4 * height)
        painter.setPen(QPen(self.palette().color(QPalette.ColorRole.WindowText), 1.5))
        painter.drawPath(_bracket(inner.left() - _MARGIN, inner, 1.0))
        painter.drawPath(_bracket(inner.right() + _MARGIN, inner, -1.0))

    def _paint_column(self, painter: QPainter, column: int, head: QRectF, top: float) -> None:
        palette = self.palette()
        text, muted = palette.color(QPalette.ColorRole.WindowText), palette.color(QPalette.ColorRole.PlaceholderText)
        color = self._axis_color(column)
        tint = QColor(color)
        tint.setAlpha(_TINT)
        body = QRectF(head.left() - _PADDING, top, head.width() + 2 * _PADDING, 3 * head.height())
        painter.fillRect(body.toRect(), tint)  # plain: a rounded one takes fifty times as long
        painter.setPen(color)
        painter.drawText(head, Qt.AlignmentFlag.AlignCenter, self._head(column))
        for row in range(4):
            cell = QRectF(head.left(), top + row * head.height(), head.width(), head.height())
            painter.setPen(text if row < 3 else muted)
            painter.drawText(
                cell, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter, self._cells[row][column]
            )

    def _fraction_width(self, painter: QPainter, column: int) -> float:
        """How far the decimals of a column reach, so that the last row aligns at the decimal point."""
        _, point, decimals = self._cells[0][column].partition(".")
        return QFontMetricsF(painter.font()).horizontalAdvance(point + decimals)

    def _head(self, column: int) -> str:
        unit = display(self._kind, self._preferences).suffix.strip()
        return f"p  {unit}" if column == 3 else _COLUMNS[column]

    def _columns(self, metrics: QFontMetricsF) -> list[tuple[float, float]]:
        """(left, width) of each column; the room that is left over goes between them, the whole stands centred."""
        # The widest number of the kind, so that the columns stand still while the arm moves.
        widths = [metrics.horizontalAdvance("\u22120.0000")] * 3
        widest = max((row[3] for row in self._cells), key=len)
        widths.append(max(metrics.horizontalAdvance(text) for text in (widest, "\u22120000.0", self._head(3))))
        room = self.width() - sum(widths) - 2 * (_MARGIN + _TICK)
        gap = min(max(room / 3, 6.0), 2.2 * metrics.averageCharWidth() + 8)
        left = (self.width() - sum(widths) - 3 * gap) / 2
        lefts = np.cumsum([left, *(width + gap for width in widths[:-1])])
        return [(float(x), float(width)) for x, width in zip(lefts, widths, strict=True)]

    def _axis_color(self, column: int) -> QColor:
        palette = self.palette()
        if column == 3:
            return palette.color(QPalette.ColorRole.PlaceholderText)
        ground = palette.color(QPalette.ColorRole.Window)
        color = axis_colors(Color(ground.redF(), ground.greenF(), ground.blueF()))[column]
        return QColor.fromRgbF(*color)

    def _line_height(self) -> float:
        return 1.5 * QFontMetricsF(self.font()).height()


def _cells(matrix: FloatArray, length: Kind, preferences: Preferences) -> list[list[str]]:
    shown = display(length, preferences)
    decimals = _ENTRY_DECIMALS + preferences["extra_decimals"]
    rows = [
        [*(format_number(value, decimals) for value in row[:3]), format_number(row[3] * shown.factor, shown.decimals)]
        for row in matrix[:3]
    ]
    return [*rows, ["0", "0", "0", "1"]]


def _bracket(x: float, inner: QRectF, direction: float) -> QPainterPath:
    path = QPainterPath(QPointF(x + direction * _TICK, inner.top()))
    path.lineTo(x, inner.top())
    path.lineTo(x, inner.bottom())
    path.lineTo(x + direction * _TICK, inner.bottom())
    return path
