"""What lies over the scene: the small axes in the corner that say where x, y, z point, and the box of the box zoom."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QWidget

from rvsim.gui.renderers.painter_ink import pen, qcolor
from rvsim.gui.renderers.painter_lines import draw_text
from rvsim.scene import Camera, Color
from rvsim.scene.palette import axis_colors, mixed

_SIZE = 84
_ARM = 25.0  # [pixels] the length of an axis that lies in the picture


class CornerAxes(QWidget):
    """The directions of the base axes as the camera sees them."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setObjectName("corner_axes")
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.setFixedSize(_SIZE, _SIZE)
        self._camera = Camera(np.zeros(3), 1.0)
        self._background = Color(1.0, 1.0, 1.0)

    def set_camera(self, camera: Camera) -> None:
        """Turns with the camera."""
        turned = (camera.azimuth, camera.elevation) != (self._camera.azimuth, self._camera.elevation)
        self._camera = camera
        if turned:
            self.update()

    def set_background(self, background: Color) -> None:
        """Chooses colours that can be seen on it."""
        if background != self._background:
            self._background = background
            self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Paints the three axes, the farthest first."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        middle, colors = QPointF(_SIZE / 2, _SIZE / 2), axis_colors(self._background)
        ends = self._camera.axes.T  # (3, 3) row i: base axis i in right, up, towards the eye
        for axis in np.argsort(ends[:, 2]).tolist():
            right, up, nearer = ends[axis].tolist()
            color = mixed(colors[axis], self._background, 0.35 * max(-nearer, 0.0))
            self._paint_axis(painter, middle, QPointF(right, -up), color, "xyz"[axis])
        painter.end()

    def _paint_axis(self, painter: QPainter, middle: QPointF, direction: QPointF, color: Color, letter: str) -> None:
        end = middle + direction * _ARM
        painter.setPen(pen(color, 2.4))
        painter.drawLine(middle, end)
        knob = end + direction * 4.0
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(qcolor(color))
        painter.drawEllipse(knob, 7.5, 7.5)
        draw_text(painter, (knob.x() - 3.2, knob.y() + 4.0), letter, self._background, 11.0, color)


class ZoomBox(QWidget):
    """The rectangle drawn with the mouse; hidden while there is none."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setObjectName("zoom_box")
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self._box = QRectF()
        self.hide()

    def stretch(self, start: QPointF, end: QPointF) -> None:
        """Lies between two points."""
        self._box = QRectF(start, end).normalized()
        self.show()
        self.raise_()
        self.update()

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Paints the rectangle in the accent colour."""
        accent = self.palette().highlight().color()
        fill = QColor(accent)
        fill.setAlphaF(0.14)
        painter = QPainter(self)
        painter.setPen(QPen(accent, 1.5))
        painter.setBrush(fill)
        painter.drawRect(self._box)
        painter.end()
