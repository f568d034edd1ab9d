"""What lines, dots and texts are painted with: pens, polygons made from arrays, texts kept as small pictures."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
import shiboken6
from numpy.typing import NDArray
from PySide6.QtCore import QCoreApplication, QPointF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QImage, QPainter, QPainterPath, QPen, QPolygonF

from rvsim.scene import Color

FloatArray = NDArray[np.float64]
HALO = 3.0  # [pixels]


class Stroke(NamedTuple):
    """Something to be painted, the farthest first."""

    depth: float
    draw: Callable[[QPainter], None]


def qcolor(color: Color) -> QColor:
    """The colour as Qt has it."""
    return QColor.fromRgbF(*(min(max(channel, 0.0), 1.0) for channel in color))


DASH, GAP = 8.0, 5.0  # [pixels]


@lru_cache(maxsize=512)
def pen(color: Color, width: float, flat: bool = False) -> QPen:
    """A pen with round ends, or with flat ones, so that the gaps between dashes stay open."""
    cap = Qt.PenCapStyle.FlatCap if flat else Qt.PenCapStyle.RoundCap
    return QPen(qcolor(color), width, Qt.PenStyle.SolidLine, cap, Qt.PenJoinStyle.RoundJoin)


def shaded(color: Color, factor: float) -> Color:
    """Darker (factor < 1), or lighter (factor > 1, towards white)."""
    if factor <= 1.0:
        return Color(color.red * factor, color.green * factor, color.blue * factor, color.alpha)
    share = min(factor - 1.0, 1.0)
    red, green, blue = (channel + share * (1.0 - channel) for channel in color[:3])
    return Color(red, green, blue, color.alpha)


def polygon(pixels: FloatArray) -> QPolygonF:
    """Points (k, 2) as Qt has them, copied in one go."""
    made = QPolygonF()
    if len(pixels):
        made.resize(len(pixels))
        memory: Any = shiboken6.VoidPtr(made.data(), 16 * len(pixels), True)  # type: ignore[call-arg,arg-type]
        np.frombuffer(memory, dtype=np.float64)[:] = np.ascontiguousarray(pixels, dtype=np.float64).reshape(-1)
    return made


@lru_cache(maxsize=1024)
def text_picture(text: str, color: Color, size: float, halo: Color, ratio: float) -> QImage:
    """A text with a halo as a picture with transparent ground; its left base point is at `text_anchor`."""
    font = _font(size)
    metrics = QFontMetricsF(font)
    width, height = metrics.horizontalAdvance(text) + 2 * HALO, metrics.height() + 2 * HALO
    picture = QImage(int(width * ratio) + 1, int(height * ratio) + 1, QImage.Format.Format_ARGB32_Premultiplied)
    picture.setDevicePixelRatio(ratio)
    picture.fill(Qt.GlobalColor.transparent)
    path = QPainterPath()
    path.addText(QPointF(HALO, HALO + metrics.ascent()), font, text)
    with QPainter(picture) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.strokePath(path, pen(halo.faded(0.85), HALO))
        painter.fillPath(path, qcolor(color))
    return picture


@lru_cache(maxsize=64)
def text_anchor(size: float) -> tuple[float, float]:
    """Where the left end of the base line lies in a `text_picture` (right, down) [pixels]."""
    return HALO, HALO + QFontMetricsF(_font(size)).ascent()


def text_scale() -> float:
    """How much larger than usual texts are to be: the theme says so, for a projector."""
    app = QCoreApplication.instance()
    return float((app.property("text_scale") if app is not None else None) or 1.0)


def _font(size: float) -> QFont:
    font = QFont()
    font.setPixelSize(max(round(size), 1))
    font.setWeight(QFont.Weight.Medium)
    return font
