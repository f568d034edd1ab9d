"""A small table of numbers, painted: aligned at the right, wrong ones tinted; as wide as it is, never wider."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPaintEvent, QPalette, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from rvsim.gui.panels.inspect_source_words import Sheet
from rvsim.gui.theme import number_font

_GAP, _HEAD_GAP, _MARGIN = 6.0, 8.0, 4.0  # between columns, behind the rows' names, at the sides of a tint
_WIDEST_COLUMN = 92.0  # [px] at most, at a font of 12 px: numbers far apart are hard to compare
_TINT = 46  # of 255
_LINE = 1.55  # a row, in heights of the font
_WRONG = QColor("#d9480f")
_FEWEST = 3  # decimals are given up as often as that before anything is cut

MakeSheet = Callable[[int], Sheet]


class Grid(QWidget):
    """Shows a sheet; `make(fewer)` makes it with so many decimals fewer, until it fits."""

    def __init__(self, name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName(name)
        self.setLayoutDirection(Qt.LayoutDirection.LeftToRight)
        self._make: MakeSheet | None = None
        self._fewer = -1
        self.sheet: Sheet | None = None
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)

    def show_sheet(self, title: str, make: MakeSheet) -> None:
        """Show what `make` makes; the title is for screen readers."""
        self._make = make
        rows = -1 if self.sheet is None else len(self.sheet.cells)
        self._fit()
        assert self.sheet is not None
        self.setAccessibleName(title)
        self.setAccessibleDescription(self.text())
        if len(self.sheet.cells) != rows:
            self.updateGeometry()
        self.update()

    def text(self) -> str:
        """The numbers as they are shown, row by row."""
        return "" if self.sheet is None else "\n".join("  ".join(row) for row in self.sheet.cells)

    # --- fitting ---------------------------------------------------------------------------------------------------

    def _fit(self) -> None:
        """Give up decimals until the columns fit."""
        if self._make is None:
            return
        for fewer in range(_FEWEST + 1):
            self.sheet = self._make(fewer)
            if self._needed(self.sheet) <= self.width():
                return

    def _needed(self, sheet: Sheet) -> float:
        return self._head_width(sheet) + sum(self._widths(sheet)) + _GAP * (len(sheet.cells[0]) - 1) + _MARGIN

    def _metrics(self) -> QFontMetricsF:
        return QFontMetricsF(number_font(self.font()))

    def _head_width(self, sheet: Sheet) -> float:
        metrics = self._metrics()
        return max((metrics.horizontalAdvance(row) for row in sheet.rows), default=0.0) + (
            _HEAD_GAP if sheet.rows else 0
        )

    def _widths(self, sheet: Sheet) -> list[float]:
        """Of the columns: all alike, as wide as the widest head, or the widest entry if it were bold."""
        bold = number_font(self.font())
        bold.setBold(True)
        wide, plain = QFontMetricsF(bold), self._metrics()
        heads = (plain.horizontalAdvance(head) for head in sheet.columns)
        entries = (wide.horizontalAdvance(text) for row in sheet.cells for text in row)
        return [max(*heads, *entries, 1.0)] * len(sheet.cells[0])

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Another width: other decimals."""
        super().resizeEvent(event)
        self._fit()

    def changeEvent(self, event: QEvent) -> None:
        """Another font: another height."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._fit()
            self.updateGeometry()

    def sizeHint(self) -> QSize:
        """As high as its rows and their head."""
        sheet = self.sheet
        rows = 0 if sheet is None else len(sheet.cells) + bool(sheet.columns)
        return QSize(200, round(rows * self._line()) + 2)

    def minimumSizeHint(self) -> QSize:
        """As low as the hint, as narrow as you like."""
        return QSize(80, self.sizeHint().height())

    def _line(self) -> float:
        return _LINE * QFontMetricsF(self.font()).height()

    # --- painting --------------------------------------------------------------------------------------------------

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Heads, tints, numbers."""
        sheet = self.sheet
        if sheet is None:
            return
        painter = QPainter(self)
        painter.setLayoutDirection(self.layoutDirection())  # else it has that of the program
        painter.setFont(number_font(self.font()))
        lefts, width = self._columns(sheet)
        line, top = self._line(), 0.0
        if sheet.columns:
            for left, head in zip(lefts, sheet.columns, strict=True):
                self._write(painter, QRectF(left, 0.0, width, line), head, muted=True)
            top = line
        for index in range(len(sheet.cells)):
            self._paint_row(painter, sheet, index, QRectF(0.0, top + index * line, width, line), lefts)

    def _columns(self, sheet: Sheet) -> tuple[list[float], float]:
        """The left ends of the columns and their common width; the room that is left over widens them somewhat."""
        count, head = len(sheet.cells[0]), self._head_width(sheet)
        most = _WIDEST_COLUMN * self._metrics().height() / 15.0
        wanted = (self.width() - head - _MARGIN - _GAP * (count - 1)) / count
        width = max(self._widths(sheet)[0], min(wanted, most))
        return [head + index * (width + _GAP) for index in range(count)], width

    def _paint_row(self, painter: QPainter, sheet: Sheet, index: int, place: QRectF, lefts: list[float]) -> None:
        if sheet.rows:
            self._write(painter, place, sheet.rows[index], muted=True, left=True)
        for left, text, wrong in zip(lefts, sheet.cells[index], sheet.wrong[index], strict=True):
            box = QRectF(left, place.top(), place.width(), place.height())
            if wrong:
                tint = QColor(_WRONG)
                tint.setAlpha(_TINT)
                painter.fillRect(box.adjusted(0, 1, _MARGIN, -1).toRect(), tint)
            self._write(painter, box, text, bold=bool(wrong))

    def _write(
        self, painter: QPainter, box: QRectF, text: str, *, muted: bool = False, left: bool = False, bold: bool = False
    ) -> None:
        role = QPalette.ColorRole.PlaceholderText if muted else QPalette.ColorRole.WindowText
        font = painter.font()
        font.setBold(bold)
        painter.setFont(font)
        painter.setPen(self.palette().color(role))
        side = Qt.AlignmentFlag.AlignLeft if left else Qt.AlignmentFlag.AlignRight
        painter.setLayoutDirection(Qt.LayoutDirection.LeftToRight)
        painter.drawText(box, side | Qt.AlignmentFlag.AlignVCenter, text)
