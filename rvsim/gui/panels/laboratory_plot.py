"""A plot of errors on a logarithmic axis. Importing this imports pyqtgraph: do it when the first plot is needed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QSize
from PySide6.QtGui import QColor, QResizeEvent, QWheelEvent
from PySide6.QtWidgets import QSizePolicy

from rvsim.gui.panels.laboratory_looks import CurveLook
from rvsim.gui.preferences import Preferences
from rvsim.gui.theme import THEMES
from rvsim.language import tr
from rvsim.robot.arrays import FloatArray

_FLOOR = 1e-17  # what an error of 0 is drawn as: a logarithm needs something
_MOST_MARKERS = 80
_AXIS_WIDTH = 58
_LEAST_HEIGHT, _LIKED_HEIGHT, _TITLE_HEIGHT = 56, 88, 34
_TITLE_ROOM = 12  # [pixels] at the ends of a title beside the axis
_SMALLEST = 0.7  # of the usual letters
_DIM = 70  # alpha of curves beside the lit one


class LogPlot(pg.PlotWidget):  # type: ignore[misc]
    """Curves by name over 0, 1, 2 …; the one that is lit stands out. Nothing in it is dragged or zoomed."""

    def __init__(self, looks: Mapping[str, CurveLook], titles: tuple[str, str], preferences: Preferences) -> None:
        super().__init__(background=None, enableMenu=False)
        self._looks, self._titles, self._preferences = looks, titles, preferences
        self._values: dict[str, FloatArray] = {}
        self._limit, self._lit = 0.0, ""
        self.setMouseEnabled(x=False, y=False)
        for part in (self, self.getPlotItem()):  # iterations run from left to right in every language
            part.setLayoutDirection(pg.QtCore.Qt.LayoutDirection.LeftToRight)
        self.hideButtons()
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Expanding)
        self.setLogMode(y=True)
        self.getAxis("left").setWidth(_AXIS_WIDTH)
        self.curves = {name: self.plot(antialias=True) for name in looks}
        ends = {"position": 0.01, "anchors": [(0, 0), (0, 0)]}
        self.threshold = pg.InfiniteLine(angle=0, label=tr("tolerance"), labelOpts=ends)
        self.addItem(self.threshold, ignoreBounds=True)
        self.dress()

    def sizeHint(self) -> QSize:
        """As little as can be read; it takes what room there is."""
        return QSize(200, self.minimumHeight() + _LIKED_HEIGHT - _LEAST_HEIGHT)

    def set_titles(self, below: str, beside: str) -> None:
        """Name the axes."""
        if (below, beside) != self._titles:
            self._titles = (below, beside)
            self.setAccessibleName(
                tr("{beside}, by {below}, logarithmic", beside=beside, below=below or tr("iteration"))
            )
            self.dress()

    def show_curves(self, values: Mapping[str, Sequence[float] | FloatArray], limit: float = 0.0) -> None:
        """Show other curves, and a line at the limit (0 for none)."""
        self._values = {name: np.maximum(np.asarray(curve, dtype=np.float64), _FLOOR) for name, curve in values.items()}
        self._limit = limit
        for name, curve in self.curves.items():
            shown = self._values.get(name, np.empty(0))
            curve.setData(np.arange(len(shown)), shown)
        self.threshold.setVisible(limit > 0.0)
        if limit > 0.0:
            self.threshold.setValue(np.log10(limit))
        self._fit()
        self._dress_curves()

    def light(self, name: str) -> None:
        """Let one curve stand out, or none."""
        self._lit = name
        self._dress_curves()

    def dress(self) -> None:
        """The colours of the present theme."""
        theme = THEMES[self._preferences["theme"]]
        self.setMinimumHeight(_LEAST_HEIGHT + (_TITLE_HEIGHT if self._titles[0] else 0))
        self.setBackground(theme.base)
        for side, title in zip(("bottom", "left"), self._titles, strict=True):
            axis = self.getAxis(side)
            axis.setPen(theme.border)
            axis.setTextPen(theme.muted)
            axis.setStyle(tickLength=-4, tickFont=self.font(), showValues=bool(title))
            axis.showLabel(bool(title))
        self._write_titles()
        self.showGrid(x=False, y=True, alpha=0.25)
        self.threshold.setPen(pg.mkPen(theme.muted, width=1, style=pg.QtCore.Qt.PenStyle.DashLine))
        self.threshold.label.setColor(theme.muted)
        self._dress_curves()

    def _write_titles(self) -> None:
        """The one beside the axis in smaller letters where the axis is shorter."""
        below, beside = self._titles
        room = self.height() - (_TITLE_HEIGHT if below else 0) - _TITLE_ROOM
        share = room / max(self.fontMetrics().horizontalAdvance(beside), 1)
        color = THEMES[self._preferences["theme"]].muted
        for side, title, smaller in (("bottom", below, 1.0), ("left", beside, max(min(share, 1.0), _SMALLEST))):
            size = f"{self.font().pointSizeF() * smaller:.1f}pt"
            self.getAxis(side).setLabel(title, **{"color": color, "font-size": size})

    def _dress_curves(self) -> None:
        dark = THEMES[self._preferences["theme"]].dark
        for name, curve in self.curves.items():
            look, lit = self._looks[name], name == self._lit
            color = QColor(look.color(dark))
            pen = look.pen(dark, 2.6 if lit else 1.6)
            if self._lit and not lit:
                color.setAlpha(_DIM)
                pen.setColor(color)
            many = len(self._values.get(name, ())) > _MOST_MARKERS
            curve.setPen(pen)
            curve.setSymbol(None if many else look.symbol)
            curve.setSymbolSize(8 if lit else 6)
            curve.setSymbolPen(None)
            curve.setSymbolBrush(color)
            curve.setZValue(10 if lit else 1)

    def _fit(self) -> None:
        """All of every curve, with whole numbers below."""
        shown = [curve for curve in self._values.values() if len(curve)]
        if not shown:
            return
        least, most = min(curve.min() for curve in shown), max(curve.max() for curve in shown)
        if self._limit > 0.0:
            least = min(least, self._limit)
        longest = max(max(len(curve) for curve in shown) - 1, 1)
        self.setXRange(0, longest, padding=0.02)
        self.setYRange(np.log10(least), np.log10(most), padding=0.06)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Another room for the title."""
        super().resizeEvent(event)
        if hasattr(self, "_titles"):  # pyqtgraph resizes what is not made yet
            self._write_titles()

    def wheelEvent(self, event: QWheelEvent) -> None:
        """What is around may scroll."""
        event.ignore()
