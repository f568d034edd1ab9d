"""What the lines of a tracked path mean: a small card in the corner of the scene."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from PySide6.QtCore import QEvent, QObject, QPointF, QRect, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QStyle, QWidget

from rvsim.gui.renderers.painter_ink import qcolor
from rvsim.language import tr
from rvsim.motion import Tracking
from rvsim.scene.palette import ScenePalette
from rvsim.scene.primitives import Color

_SWATCH, _PAD, _FROM_EDGE = 26.0, 8.0, 8


class Entry(NamedTuple):
    """A line of the legend: its colour, whether it is dashed, a sign on it, and what it means."""

    color: Color
    text: str
    dashed: bool = False
    sign: str = ""


def path_entries(tracking: Tracking | None, palette: ScenePalette, *, trail: bool) -> tuple[Entry, ...]:
    """What there is to tell of a tracked path: only what can be seen of it."""
    if tracking is None:
        return ()
    entries = [Entry(palette.desired, tr("path asked for"))]
    if not tracking.complete:
        entries.append(Entry(palette.unreached, tr("not reached"), dashed=True, sign="×"))
    if trail and tracking.reached_count:
        entries.append(Entry(palette.actual, tr("where the tool went")))
    return tuple(entries)


class PathLegend(QWidget):
    """Lies in the lower right corner of its parent, and lets the mouse through."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setObjectName("path_legend")
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.entries: tuple[Entry, ...] = ()
        self._ground, self._ink = Color(1.0, 1.0, 1.0), Color(0.0, 0.0, 0.0)
        parent.installEventFilter(self)
        self.hide()

    def show_entries(self, entries: Sequence[Entry], palette: ScenePalette) -> None:
        """Show these, or nothing where there are none."""
        self.entries, self._ground, self._ink = tuple(entries), palette.background, palette.text
        self.setAccessibleName("; ".join(entry.text for entry in self.entries))
        self.setVisible(bool(self.entries))
        self._place()
        self.update()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """The corner moves with the parent's size."""
        if watched is self.parent() and event.type() == QEvent.Type.Resize:
            self._place()
        return False

    def changeEvent(self, event: QEvent) -> None:
        """Larger letters need more room."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._place()

    def _line(self) -> int:
        return self.fontMetrics().height() + 2

    def _place(self) -> None:
        widths = [self.fontMetrics().horizontalAdvance(entry.text) for entry in self.entries]
        width = round(max(widths, default=0) + _SWATCH + 3.0 * _PAD)
        self.resize(width, round(self._line() * len(self.entries) + _PAD))
        above = self.parentWidget()
        assert above is not None
        self.move(above.width() - width - _FROM_EDGE, above.height() - self.height() - _FROM_EDGE)

    def paintEvent(self, _event: QPaintEvent) -> None:
        """A line, a sign on it, and what it means."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        ground = QColor(qcolor(self._ground))
        ground.setAlphaF(0.85)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(ground)
        painter.drawRoundedRect(QRectF(self.rect()), 4.0, 4.0)
        for number, entry in enumerate(self.entries):
            self._paint_entry(painter, entry, _PAD / 2 + number * self._line())
        painter.end()

    def _paint_entry(self, painter: QPainter, entry: Entry, top: float) -> None:
        middle = top + self._line() / 2
        style = Qt.PenStyle.DashLine if entry.dashed else Qt.PenStyle.SolidLine
        painter.setPen(QPen(qcolor(entry.color), 2.2, style))
        box = self._placed(_PAD, top, _SWATCH)
        painter.drawLine(QPointF(box.left(), middle), QPointF(box.left() + _SWATCH, middle))
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, entry.sign)
        painter.setPen(qcolor(self._ink))
        text = self._placed(2.0 * _PAD + _SWATCH, top, self.width() - 2.0 * _PAD - _SWATCH)
        side = QStyle.visualAlignment(self.layoutDirection(), Qt.AlignmentFlag.AlignLeft)
        painter.drawText(text, side | Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignAbsolute, entry.text)

    def _placed(self, left: float, top: float, width: float) -> QRectF:
        """The box of a line, counted from the side where the language begins to be read."""
        box = QRect(round(left), round(top), round(width), self._line())
        return QRectF(QStyle.visualRect(self.layoutDirection(), self.rect(), box))
