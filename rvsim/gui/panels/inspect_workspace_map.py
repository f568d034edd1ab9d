"""The flat map of a workspace, and the bar that says what its colours mean. Importing this imports pyqtgraph."""

from __future__ import annotations

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QLinearGradient, QMouseEvent, QPainter, QPaintEvent, QWheelEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from rvsim.gui.panels.inspect_workspace_words import Values
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Display, format_number
from rvsim.gui.theme import THEMES
from rvsim.kinematics.workspace import SectionMap
from rvsim.language import tr
from rvsim.robot.arrays import FloatArray
from rvsim.scene.cloud import scale_color

_STEPS = 64
_PLAIN = 0.45  # where on the scale the one colour is that says nothing but "reached"
_LEAST_HEIGHT, _LIKED_HEIGHT = 220, 300
_AXIS_WIDTH = 52


def scale_bytes(steps: int, *, dark: bool) -> np.ndarray:
    """(steps, 4) the scale as red, green, blue, alpha, each 0…255."""
    colors = [scale_color(step / max(steps - 1, 1), dark=dark) for step in range(steps)]
    return np.round(255.0 * np.array(colors)).astype(np.uint8)


def map_image(values: Values, reached: np.ndarray, *, dark: bool) -> np.ndarray:
    """(columns, rows, 4) the picture of a map; what is not reached is see-through."""
    image = np.zeros((*reached.shape, 4), dtype=np.uint8)
    if values.values is None:
        image[reached] = scale_bytes(101, dark=dark)[round(100 * _PLAIN)]
        return image
    if values.whole:
        steps, index = max(int(values.largest), 1), np.nan_to_num(values.values, nan=1.0) - 1.0
    else:
        steps, index = _STEPS, np.nan_to_num(values.values) * (_STEPS - 1) / max(values.largest, 1e-300)
    palette = scale_bytes(steps, dark=dark)
    image[reached] = palette[np.clip(index[reached].round().astype(int), 0, steps - 1)]
    return image


class _MinusAxis(pg.AxisItem):  # type: ignore[misc]
    """An axis whose numbers have the minus sign of all others on the screen."""

    def tickStrings(self, values: list[float], scale: float, spacing: float) -> list[str]:
        return [text.replace("-", "\u2212") for text in super().tickStrings(values, scale, spacing)]


class SectionPlot(pg.PlotWidget):  # type: ignore[misc]
    """A section in its own plane: cells, rim, and the tool where it is now. Nothing in it is dragged or zoomed.

    Signals:
        pointed(u, v): the pointer is there [m]; nan when it has left.
        clicked(u, v): there was a click [m].
    """

    pointed = Signal(float, float)
    clicked = Signal(float, float)

    def __init__(self, preferences: Preferences) -> None:
        axes = {side: _MinusAxis(side) for side in ("left", "bottom")}
        super().__init__(background=None, axisItems=axes, enableMenu=False)
        self._preferences = preferences
        self._factor = 1.0
        self.setMouseTracking(True)
        self.getPlotItem().setLayoutDirection(Qt.LayoutDirection.LeftToRight)
        self.setObjectName("workspace_map")
        self.setAccessibleName(tr("Section of the workspace"))
        self.setMouseEnabled(x=False, y=False)
        self.hideButtons()
        self.setAspectLocked(True)
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Expanding)
        self.setMinimumHeight(_LEAST_HEIGHT)
        self.getAxis("left").setWidth(_AXIS_WIDTH)
        self.cells, self.rim = pg.ImageItem(), pg.PlotDataItem(connect="pairs", antialias=True)
        self.tool = pg.ScatterPlotItem(size=12, symbol="+", pxMode=True)
        for order, item in enumerate((self.cells, self.rim, self.tool)):
            item.setZValue(order)
            self.addItem(item)

    def sizeHint(self) -> QSize:
        """As much as is liked; it takes what room there is."""
        return QSize(200, _LIKED_HEIGHT)

    def show_section(self, section: SectionMap, values: Values, titles: tuple[str, str], shown: Display) -> None:
        """Another section, in the unit that is shown."""
        theme, self._factor = THEMES[self._preferences["theme"]], shown.factor
        self.setBackground(theme.base)
        low, high = section.grid.lower * shown.factor, section.grid.upper * shown.factor
        self.cells.setImage(map_image(values, section.reached, dark=theme.dark), levels=(0, 255))
        self.cells.setRect(QRectF(low[0], low[1], high[0] - low[0], high[1] - low[1]))
        rim = section.outline.reshape(-1, 2) * shown.factor
        self.rim.setData(rim[:, 0], rim[:, 1])
        self.rim.setPen(pg.mkPen(theme.text, width=1.4))
        for side, title in zip(("bottom", "left"), titles, strict=True):
            self._dress_axis(side, f"{title} [{shown.suffix.strip()}]")
        self._fit(section, shown)

    def _fit(self, section: SectionMap, shown: Display) -> None:
        """What is reached, with a little room around it."""
        centers = section.grid.centers()[section.reached.reshape(-1)]
        if len(centers):
            (left, below), (right, above) = centers.min(axis=0) * shown.factor, centers.max(axis=0) * shown.factor
            self.setRange(xRange=(left, right), yRange=(below, above), padding=0.06)

    def _dress_axis(self, side: str, title: str) -> None:
        theme, axis = THEMES[self._preferences["theme"]], self.getAxis(side)
        axis.setPen(theme.border)
        axis.setTextPen(theme.muted)
        axis.enableAutoSIPrefix(False)
        axis.setStyle(tickLength=-4, tickFont=self.font())
        axis.setLabel(title, **{"color": theme.muted, "font-size": f"{self.font().pointSizeF():.1f}pt"})

    def show_tool(self, point: FloatArray, *, inside: bool, shown: Display) -> None:
        """The tool at (u, v) [m]; a ring where it stands beside the section's plane, a cross in it."""
        color = QColor(THEMES[self._preferences["theme"]].error)
        self.tool.setSymbol("+" if inside else "o")
        self.tool.setPen(pg.mkPen(color, width=2.0))
        self.tool.setBrush(color if inside else None)
        self.tool.setData([point[0] * shown.factor], [point[1] * shown.factor])

    def clear_section(self) -> None:
        """Nothing to show."""
        self.cells.clear()
        self.rim.setData([], [])
        self.tool.setData([], [])

    def place_at(self, position: QPointF) -> tuple[float, float]:
        """(u, v) [m] at a pixel of the widget."""
        place = self.getViewBox().mapSceneToView(self.mapToScene(position.toPoint()))
        return place.x() / self._factor, place.y() / self._factor

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Tell where the pointer is."""
        self.pointed.emit(*self.place_at(event.position()))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Somebody asks for that place."""
        if event.button() == Qt.MouseButton.LeftButton:
            self.clicked.emit(*self.place_at(event.position()))

    def leaveEvent(self, event: QEvent) -> None:
        """The pointer is elsewhere."""
        super().leaveEvent(event)
        self.pointed.emit(float("nan"), float("nan"))

    def wheelEvent(self, event: QWheelEvent) -> None:
        """What is around may scroll."""
        event.ignore()


class ScaleBar(QWidget):
    """The colours with their numbers: a band for what goes on evenly, a box each for what is counted."""

    def __init__(self, preferences: Preferences) -> None:
        super().__init__()
        self._preferences = preferences
        self._values: Values | None = None
        self.setObjectName("workspace_scale")
        self.setLayoutDirection(Qt.LayoutDirection.LeftToRight)
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)

    def show_values(self, values: Values | None) -> None:
        """Explain these values; None or values without colours: nothing."""
        self._values = values
        self.setVisible(values is not None and values.values is not None)
        self.setAccessibleName(values.title if values else "")
        self.setToolTip(values.title if values else "")
        self.updateGeometry()
        self.update()

    def sizeHint(self) -> QSize:
        """Two lines of text and the band."""
        return QSize(200, 2 * self.fontMetrics().height() + 16)

    def minimumSizeHint(self) -> QSize:
        """The same height."""
        return QSize(40, self.sizeHint().height())

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Title, band, numbers."""
        values, theme = self._values, THEMES[self._preferences["theme"]]
        if values is None or values.values is None:
            return
        line = self.fontMetrics().height()
        band = QRectF(0.5, line + 2.5, self.width() - 1.0, 10.0)
        with QPainter(self) as painter:
            painter.setPen(QColor(theme.muted))
            title = self.fontMetrics().elidedText(values.title, Qt.TextElideMode.ElideRight, self.width())
            painter.drawText(QRectF(0, 0, self.width(), line), Qt.AlignmentFlag.AlignLeft, title)
            painter.setLayoutDirection(self.layoutDirection())  # of numbers; the words before have the program's
            (self._paint_boxes if values.whole else self._paint_band)(painter, band, values, theme.dark)

    def _paint_band(self, painter: QPainter, band: QRectF, values: Values, dark: bool) -> None:
        gradient = QLinearGradient(band.topLeft(), band.topRight())
        for step, color in enumerate(scale_bytes(11, dark=dark).tolist()):
            gradient.setColorAt(step / 10, QColor(*color))
        painter.fillRect(band, gradient)
        below = QRectF(0.0, band.bottom() + 2.0, self.width(), self.fontMetrics().height())
        places = (Qt.AlignmentFlag.AlignLeft, Qt.AlignmentFlag.AlignHCenter, Qt.AlignmentFlag.AlignRight)
        decimals = int(np.clip(2 - np.floor(np.log10(max(values.largest, 1e-6))), 0, 6))
        for place, share in zip(places, (0.0, 0.5, 1.0), strict=True):
            painter.drawText(below, place, format_number(share * values.largest, decimals))

    def _paint_boxes(self, painter: QPainter, band: QRectF, values: Values, dark: bool) -> None:
        count = max(int(values.largest), 1)
        width = band.width() / count
        for number, color in enumerate(scale_bytes(count, dark=dark).tolist()):
            box = QRectF(number * width, band.top(), width - 2.0, band.height())
            painter.fillRect(box, QColor(*color))
            below = QRectF(box.left(), box.bottom() + 2.0, box.width(), self.fontMetrics().height())
            painter.drawText(below, Qt.AlignmentFlag.AlignHCenter, str(number + 1))
