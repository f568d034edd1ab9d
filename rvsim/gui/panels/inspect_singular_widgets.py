"""The small widgets of the Singular page: the light, the bars of the singular values, a grid of numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFontMetricsF, QPainter, QPaintEvent, QPalette, QPen
from PySide6.QtWidgets import QHBoxLayout, QLabel, QWidget

from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.inspect_singular_words import CLEAR, Light, small_number
from rvsim.gui.theme import THEMES, number_font, set_role
from rvsim.gui.widgets import PaintedLines
from rvsim.language import tr
from rvsim.robot.arrays import FloatArray

_DECADES = 4.0  # the bars reach from σ max down to a ten thousandth of it
_LOW = "₀₁₂₃₄₅₆₇₈₉"


class LightLabel(QWidget):
    """A traffic light that needs no colour: a symbol of its own for each state, and the word."""

    def __init__(self) -> None:
        super().__init__()
        self.symbol, self.word = QLabel(), wrapped_label("title")
        self.symbol.setObjectName("singular_light")
        self.word.setObjectName("singular_verdict")
        self.symbol.setStyleSheet("font-size: 18pt;")
        self.symbol.setFixedWidth(34)
        self.symbol.setAlignment(Qt.AlignmentFlag.AlignCenter)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(8)
        row.addWidget(self.symbol)
        row.addWidget(self.word, 1)
        self.show_light(CLEAR, "")

    def show_light(self, light: Light, detail: str) -> None:
        """Switch to this light; `detail` follows its word."""
        self.symbol.setText(light.symbol)
        word = tr(light.word)
        self.word.setText(tr("{light}: {families}", light=word, families=detail) if detail else word)
        set_role(self.symbol, level=light.level)
        set_role(self.word, level=light.level)


class SigmaBars(PaintedLines):
    """The singular values as bars on a logarithmic scale, the threshold as a line."""

    def __init__(self) -> None:
        super().__init__()
        self._values: tuple[float, ...] = ()
        self._threshold = 0.0
        self._level = "good"
        self.setObjectName("singular_bars")
        self.setLayoutDirection(Qt.LayoutDirection.LeftToRight)
        self.setAccessibleName(tr("Singular values"))
        self.setToolTip(
            tr(
                "All singular values of J, the largest on top, on a logarithmic scale of four decades. The line marks "
                "where the light turns: the lowest bar should reach beyond it."
            )
        )

    def show_values(self, values: FloatArray, threshold: float, level: str) -> None:
        """Show them (k,); `threshold` is a share of the largest, `level` the light of the smallest."""
        shown = tuple(float(value) for value in values)
        if len(shown) != len(self._values):
            self.updateGeometry()
        self._values, self._threshold, self._level = shown, threshold, level
        self.setAccessibleDescription(", ".join(small_number(value) for value in shown))
        self.update()

    def sizeHint(self) -> QSize:
        """One line a value."""
        return QSize(240, int(len(self._values) * self._line() + 2))

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Names, bars, numbers, and the threshold."""
        painter = QPainter(self)
        painter.setLayoutDirection(Qt.LayoutDirection.LeftToRight)
        painter.setFont(number_font(self.font()))
        metrics, line = QFontMetricsF(painter.font()), self._line()
        left = metrics.horizontalAdvance("σ₆") + 8.0
        right = self.width() - metrics.horizontalAdvance(f"0.0000{small_number(1e-9)}"[-7:]) - 12.0
        largest = max(self._values, default=1.0) or 1.0
        for row, value in enumerate(self._values):
            area = QRectF(left, row * line + 0.22 * line, right - left, 0.56 * line)
            self._paint_bar(painter, area, _share(value / largest), row == len(self._values) - 1)
            text = QRectF(0, row * line, self.width(), line)
            painter.setPen(self.palette().color(QPalette.ColorRole.WindowText))
            painter.drawText(text, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter, f"σ{_LOW[row + 1]}")
            painter.drawText(text, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter, small_number(value))
        if self._threshold > 0.0:
            x = left + _share(self._threshold) * (right - left)
            painter.setPen(QPen(self.palette().color(QPalette.ColorRole.PlaceholderText), 1.5, Qt.PenStyle.DashLine))
            painter.drawLine(int(x), 0, int(x), self.height())

    def _paint_bar(self, painter: QPainter, area: QRectF, share: float, last: bool) -> None:
        palette = self.palette()
        painter.fillRect(area, palette.color(QPalette.ColorRole.Mid))
        color = palette.color(QPalette.ColorRole.Highlight)
        if last and self._level != "good":
            color = QColor(_signal(self._level, palette.color(QPalette.ColorRole.Window).lightnessF() < 0.5))
        painter.fillRect(QRectF(area.left(), area.top(), max(2.0, share * area.width()), area.height()), color)

    def _line(self) -> float:
        return 1.25 * QFontMetricsF(self.font()).height()


def _signal(level: str, dark: bool) -> str:
    theme = THEMES["dark" if dark else "light"]
    return theme.error if level == "error" else theme.warning


def _share(ratio: float) -> float:
    """0…1 along the logarithmic scale."""
    return 0.0 if ratio <= 0.0 else min(1.0, max(0.0, 1.0 + math.log10(ratio) / _DECADES))


class NumberGrid(PaintedLines):
    """A small matrix in brackets, numbers aligned, a name above each column."""

    def __init__(self, title: str) -> None:
        super().__init__()
        self._rows: tuple[tuple[str, ...], ...] = ()
        self._heads: tuple[str, ...] = ()
        self.setLayoutDirection(Qt.LayoutDirection.LeftToRight)
        self.setAccessibleName(title)

    def show_numbers(self, rows: Sequence[Sequence[str]], heads: Sequence[str]) -> None:
        """Show these texts under these heads."""
        shown = tuple(tuple(row) for row in rows)
        if len(shown) != len(self._rows):
            self.updateGeometry()
        self._rows, self._heads = shown, tuple(heads)
        self.setAccessibleDescription(self.text())
        self.update()

    def text(self) -> str:
        """The numbers, row by row."""
        return "\n".join("  ".join(row) for row in self._rows)

    def sizeHint(self) -> QSize:
        """The heads and the rows."""
        return QSize(260, int((len(self._rows) + 1) * self._line() + 4))

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Heads, numbers, brackets."""
        if not self._rows:
            return
        painter, line, columns = QPainter(self), self._line(), len(self._rows[0])
        painter.setLayoutDirection(self.layoutDirection())
        painter.setLayoutDirection(Qt.LayoutDirection.LeftToRight)
        painter.setFont(number_font(self.font()))
        width = min((self.width() - 20.0) / columns, 5.5 * QFontMetricsF(painter.font()).averageCharWidth() + 26.0)
        right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        for column, head in enumerate(self._heads):
            painter.setPen(self.palette().color(QPalette.ColorRole.PlaceholderText))
            painter.drawText(QRectF(6.0 + column * width, 0, width - 4.0, line), right, head)
            painter.setPen(self.palette().color(QPalette.ColorRole.WindowText))
            for row, texts in enumerate(self._rows):
                cell = QRectF(6.0 + column * width, (row + 1) * line, width - 4.0, line)
                painter.drawText(cell, right, texts[column])
        self._paint_brackets(painter, line, 12.0 + columns * width)

    def _paint_brackets(self, painter: QPainter, line: float, right: float) -> None:
        painter.setPen(QPen(self.palette().color(QPalette.ColorRole.WindowText), 1.5))
        top, bottom = int(line), int(line * (len(self._rows) + 1))
        for x, tick in ((1, 6), (int(right), -6)):
            painter.drawLine(x, top, x, bottom)
            painter.drawLine(x, top, x + tick, top)
            painter.drawLine(x, bottom, x + tick, bottom)

    def _line(self) -> float:
        return 1.3 * QFontMetricsF(self.font()).height()
