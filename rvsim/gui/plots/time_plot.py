"""One plot over time. Importing this imports pyqtgraph: do it when the first plot is needed."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QEvent, QPointF, QRect, Qt, QTimer, Signal
from PySide6.QtGui import (
    QColor,
    QContextMenuEvent,
    QEnterEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPixmap,
    QResizeEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QSizePolicy, QWidget

from rvsim.gui.plots.catalogue import Band, Drawing, Line
from rvsim.gui.plots.saving import plot_menu
from rvsim.gui.preferences import Preferences
from rvsim.gui.theme import THEMES, Theme
from rvsim.gui.widgets import clear_scenes
from rvsim.language import left_to_right, tr
from rvsim.robot.arrays import FloatArray

_AXIS_WIDTH = 52
_TITLE_MARGIN = 4  # [pixels]
_ROOM = 0.06  # of the range, above and below
_NEAR = 0.4  # a limit that far beyond a curve, in parts of its range, is shown
_BAND_ALPHA = 26


class TimePlot(QWidget):
    """Curves over time with a cursor. The curves are painted once; moving the cursor paints a line over them.

    Signals:
        picked(time): the mouse pressed or dragged at a time [s].
        entered(): the mouse has come.
    """

    picked = Signal(float)
    entered = Signal()

    def __init__(self, preferences: Preferences, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._preferences = preferences
        self._drawing = Drawing("", "")
        self._times: FloatArray = np.zeros(1)
        self._time = 0.0
        self._picture = QPixmap()
        self._marks: tuple[float, ...] = ()
        # It is a brush: what it paints is kept. A child, so that it goes with this widget and never in another thread,
        # where the garbage of one without a parent could be collected.
        self.plot = pg.PlotWidget(self, background=None, enableMenu=False)
        self.plot.hide()
        for part in (self.plot, self.plot.getPlotItem()):  # time runs from left to right in every language
            part.setLayoutDirection(Qt.LayoutDirection.LeftToRight)
        self.plot.setMouseEnabled(x=False, y=False)
        self.plot.hideButtons()
        self.plot.getAxis("left").setWidth(_AXIS_WIDTH)
        self._later = QTimer(self, singleShot=True, interval=0)  # a window that is being resized paints once a frame
        self._later.timeout.connect(self.repaint_curves)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(96, 84)
        self.setCursor(Qt.CursorShape.SplitHCursor)

    # --- what is shown ---------------------------------------------------------------------------------------------

    def show_drawing(self, drawing: Drawing, times: FloatArray, marks: tuple[float, ...]) -> None:
        """Show curves over times (m,) [s], with marks at some of them."""
        self._drawing, self._times, self._marks = drawing, times, marks
        self.setAccessibleName(tr("{title} over time", title=tr(drawing.title)))
        self.repaint_curves()

    def set_time(self, time: float) -> None:
        """Put the cursor at a time [s]."""
        if time != self._time:
            self._time = time
            self.update()

    def repaint_curves(self) -> None:
        """Paint the curves anew: others, another theme, or another size."""
        theme = THEMES[self._preferences["theme"]]
        self.plot.resize(self.size())
        self.plot.clear()
        self.plot.setBackground(theme.base)
        self._dress_axes(theme)
        bands = tuple(band for band in self._drawing.bands if self._is_near(band))
        low, high = _span(self._drawing.lines, bands)
        self.plot.setYRange(low, high, padding=0.0)
        self.plot.setXRange(0.0, max(float(self._times[-1]), 1e-3), padding=0.0)
        for band in bands:
            self._add_band(band, low, high)
        for line in self._drawing.lines:
            style = Qt.PenStyle.DashLine if line.dashed else Qt.PenStyle.SolidLine
            pen = pg.mkPen(_visible(line.color, theme), width=1.0 if line.dashed else 1.8, style=style)
            self.plot.plot(self._times, line.values, pen=pen, antialias=True, connect="finite")
        self.plot.grab(QRect(0, 0, 1, 1))  # which tells it, hidden as it is, of its size
        self.plot.getPlotItem().layout.activate()
        self._picture = self.plot.grab()
        self.update()

    @property
    def drawing(self) -> Drawing:
        """What is shown."""
        return self._drawing

    def value_texts(self) -> list[tuple[str, str, float]]:
        """(name, colour, value at the cursor) of each curve that is not dashed, in shown units."""
        theme = THEMES[self._preferences["theme"]]
        return [
            (line.name, _visible(line.color, theme).name(), float(np.interp(self._time, self._times, line.values)))
            for line in self._drawing.lines
            if not line.dashed
        ]

    def largest(self) -> tuple[str, float, float] | None:
        """(name, value, time [s]) of the largest of all values without their signs, None where there is none."""
        found = [line for line in self._drawing.lines if not line.dashed and np.isfinite(line.values).any()]
        if not found:
            return None
        line = max(found, key=lambda line: float(np.nanmax(np.abs(line.values))))
        at = int(np.nanargmax(np.abs(line.values)))
        return line.name, float(line.values[at]), float(self._times[at])

    def _dress_axes(self, theme: Theme) -> None:
        for side in ("bottom", "left"):
            axis = self.plot.getAxis(side)
            axis.setPen(theme.border)
            axis.setTextPen(theme.muted)
            axis.setStyle(tickLength=-4, tickFont=self.font())
            axis.enableAutoSIPrefix(False)
        self.plot.showGrid(x=True, y=True, alpha=0.15)
        unit = f" {left_to_right(f'[{self._drawing.unit}]')}" if self._drawing.unit else ""
        size = f"{self.font().pointSizeF():.1f}pt"
        whole, short = tr(self._drawing.title), self._short_title(unit)
        self.plot.setTitle(f"{short}{unit}", color=theme.text, size=size)
        tip = tr("Click or drag to go to that moment")
        self.setToolTip(tip if short == whole else f"{whole}\n{tip}")

    def _short_title(self, unit: str) -> str:
        """The title as far as there is room beside its unit: a longer one would push the curves out of sight."""
        metrics = self.fontMetrics()
        room = self.width() - _AXIS_WIDTH - metrics.horizontalAdvance(unit) - _TITLE_MARGIN
        return metrics.elidedText(tr(self._drawing.title), Qt.TextElideMode.ElideRight, room)

    def _is_near(self, band: Band) -> bool:
        """Whether its curve comes near to the limit: all limits of all joints at once would hide the curves."""
        own = [line.values for line in self._drawing.lines if line.color == band.color or len(self._drawing.bands) == 1]
        values = own[0][np.isfinite(own[0])] if own else np.empty(0)
        if not values.size:
            return False
        reach = _NEAR * max(float(np.ptp(values)), 1e-9)
        return bool(values.min() - reach < band.low or values.max() + reach > band.high)

    def _add_band(self, band: Band, low: float, high: float) -> None:
        """What is outside the limits, shaded in the colour of its curve, with the limit as a dashed line."""
        color = QColor(band.color)
        shade = QColor(color)
        shade.setAlpha(_BAND_ALPHA)
        for limit, far in ((band.low, low), (band.high, high)):
            if math.isfinite(limit) and low < limit < high:
                region = pg.LinearRegionItem(sorted((limit, far)), "horizontal", movable=False, brush=shade, pen=None)
                edge = pg.InfiniteLine(limit, angle=0, pen=pg.mkPen(color, width=1, style=Qt.PenStyle.DashLine))
                self.plot.addItem(region, ignoreBounds=True)
                self.plot.addItem(edge, ignoreBounds=True)

    # --- painting and hands ----------------------------------------------------------------------------------------

    def event(self, event: QEvent) -> bool:
        """Empty the plot before it is destroyed."""
        if event.type() == QEvent.Type.DeferredDelete:
            clear_scenes(self)
        return super().event(event)

    def paintEvent(self, _event: QPaintEvent) -> None:
        """The curves, and the cursor over them."""
        painter = QPainter(self)
        painter.drawPixmap(0, 0, self._picture)
        theme = THEMES[self._preferences["theme"]]
        if self._drawing.empty:
            painter.setPen(QColor(theme.muted))
            room = self.rect().adjusted(_AXIS_WIDTH + 8, 24, -8, -24)
            painter.drawText(room, Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap, self._drawing.empty)
            return
        view = self.plot.getViewBox().sceneBoundingRect()
        painter.setPen(QColor(theme.muted))
        painter.drawText(QPointF(6.0, self.height() - 5.0), left_to_right("t [s]"))
        for mark in self._marks:
            x = self._x_of(mark)
            painter.setPen(QColor(theme.error))
            painter.drawText(QPointF(x - 3.0, view.top() + 9.0), "▾")
        painter.setPen(QPen(QColor(theme.accent), 1.5))
        x = self._x_of(self._time)
        painter.drawLine(QPointF(x, view.top()), QPointF(x, view.bottom()))

    def _x_of(self, time: float) -> float:
        view = self.plot.getViewBox().sceneBoundingRect()
        return float(view.left() + view.width() * time / max(float(self._times[-1]), 1e-3))

    def _pick(self, event: QMouseEvent) -> None:
        view = self.plot.getViewBox().sceneBoundingRect()
        share = (event.position().x() - view.left()) / max(view.width(), 1.0)
        self.picked.emit(float(np.clip(share, 0.0, 1.0)) * float(self._times[-1]))

    def enterEvent(self, event: QEnterEvent) -> None:
        """Its values are those that are read out."""
        super().enterEvent(event)
        self.entered.emit()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Go to that moment."""
        if event.button() == Qt.MouseButton.LeftButton:
            self._pick(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Drag through the moments."""
        if event.buttons() & Qt.MouseButton.LeftButton:
            self._pick(event)

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """Save or copy it."""
        plot_menu(self).popup(event.globalPos())

    def wheelEvent(self, event: QWheelEvent) -> None:
        """What is around may scroll."""
        event.ignore()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """The curves in the new size."""
        super().resizeEvent(event)
        self._later.start()


def _span(lines: Sequence[Line], bands: Sequence[Band]) -> tuple[float, float]:
    """From the least to the largest value and the limits that are near, with a little room."""
    values = [line.values[np.isfinite(line.values)] for line in lines]
    flat = np.concatenate(values) if values else np.zeros(1)
    if not flat.size:
        return -1.0, 1.0
    least, most = float(flat.min()), float(flat.max())
    near = [limit for band in bands for limit in (band.low, band.high) if math.isfinite(limit)]
    reach = _NEAR * max(most - least, 1e-9)
    low = min([least, *(limit for limit in near if limit > least - reach)])
    high = max([most, *(limit for limit in near if limit < most + reach)])
    room = _ROOM * max(high - low, 1e-9 * max(abs(low), abs(high), 1e-3))
    return low - room, high + room


def _visible(color: str, theme: Theme) -> QColor:
    """A joint's colour, darker on white and lighter on black, so that yellow can be seen too."""
    shown = QColor(color)
    bright = 0.2126 * shown.redF() + 0.7152 * shown.greenF() + 0.0722 * shown.blueF()
    if theme.dark:
        return shown.lighter(150) if bright < 0.35 else shown
    return shown.darker(160) if bright > 0.75 else shown.darker(112) if bright > 0.55 else shown
