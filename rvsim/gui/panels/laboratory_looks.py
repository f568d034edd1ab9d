"""How the curves of the laboratory look: colour, dash and marker of each, so that colour is never the only sign."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

from PySide6.QtCore import QPointF, QSize, Qt
from PySide6.QtGui import QColor, QIcon, QPainter, QPainterPath, QPaintEvent, QPen, QPixmap, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QWidget

from rvsim.gui.panels.tables import text_metrics
from rvsim.gui.preferences import Preferences
from rvsim.gui.theme import THEMES
from rvsim.kinematics.numeric import Solver
from rvsim.lab.laboratory import SHORT_TITLES, TITLES
from rvsim.language import tr, tr_later

_SAMPLE = QSize(30, 12)
_GAP = 14
_MARKER = 7.0


def _polygon(*corners: tuple[float, float]) -> QPainterPath:
    path = QPainterPath()
    path.addPolygon(QPolygonF([QPointF(*corner) for corner in corners]))
    path.closeSubpath()
    return path


def _circle() -> QPainterPath:
    path = QPainterPath()
    path.addEllipse(QPointF(0.0, 0.0), 0.5, 0.5)
    return path


# One unit wide, about the origin.
_MARKERS = {
    "circle": _circle(),
    "square": _polygon((-0.45, -0.45), (0.45, -0.45), (0.45, 0.45), (-0.45, 0.45)),
    "triangle": _polygon((0.0, -0.58), (0.55, 0.42), (-0.55, 0.42)),
    "diamond": _polygon((0.0, -0.62), (0.62, 0.0), (0.0, 0.62), (-0.62, 0.0)),
}


class CurveLook(NamedTuple):
    """A curve's short name and title, its colours on light and dark ground, dash pattern [widths], marker; English."""

    short: str
    title: str
    light: str
    dark: str
    dashes: tuple[float, ...]
    marker: str

    def color(self, dark: bool) -> QColor:
        """The colour for the theme's ground."""
        return QColor(self.dark if dark else self.light)

    def pen(self, dark: bool, width: float = 1.8) -> QPen:
        """The line."""
        pen = QPen(self.color(dark), width)
        pen.setCapStyle(Qt.PenCapStyle.FlatCap)
        pen.setCosmetic(True)
        if self.dashes:
            pen.setDashPattern(list(self.dashes))
        return pen

    @property
    def symbol(self) -> QPainterPath:
        """The marker's outline, one unit wide."""
        return _MARKERS[self.marker]


_SOLVER_STROKES: dict[Solver, tuple[str, str, tuple[float, ...], str]] = {
    "newton": ("#0b5fc0", "#58a6ff", (), "circle"),
    "dls": ("#b04a00", "#ffa657", (5.0, 2.5), "square"),
    "lm": ("#0b7a3e", "#56d18a", (7.0, 2.0, 1.5, 2.0), "triangle"),
    "bfgs": ("#9a1fb0", "#e58cf5", (1.5, 2.0), "diamond"),
}
SOLVER_LOOKS: dict[str, CurveLook] = {
    solver: CurveLook(SHORT_TITLES[solver], TITLES[solver], *stroke) for solver, stroke in _SOLVER_STROKES.items()
}
SOURCE_002_LOOKS = {
    "printed": CurveLook(
        tr_later("as printed"), tr_later("As printed: the real arm"), "#b42318", "#ff8a7a", (), "square"
    ),
    "believed": CurveLook(
        tr_later("believed"), tr_later("As printed: what it believes"), "#b04a00", "#ffa657", (5.0, 2.5), "triangle"
    ),
    "corrected": CurveLook(
        tr_later("corrected"), tr_later("Corrected: the real arm"), "#0b5fc0", "#58a6ff", (1.5, 2.0), "circle"
    ),
}


def is_dark(preferences: Preferences) -> bool:
    """Whether the present theme is a dark one."""
    return THEMES[preferences["theme"]].dark


@lru_cache(maxsize=32)
def sample_icon(look: CurveLook, theme: str) -> QIcon:
    """A piece of the curve with its marker; in a selected row in the colour of its text."""
    dark = THEMES[theme].dark
    icon = QIcon(_sample(look, dark))
    selected = look._replace(light=THEMES[theme].on_accent, dark=THEMES[theme].on_accent)
    icon.addPixmap(_sample(selected, dark), QIcon.Mode.Selected)
    return icon


def _sample(look: CurveLook, dark: bool) -> QPixmap:
    pixmap = QPixmap(_SAMPLE * 2)
    pixmap.setDevicePixelRatio(2.0)
    pixmap.fill(Qt.GlobalColor.transparent)
    painter = QPainter(pixmap)
    draw_sample(painter, look, dark, QPointF(0.0, _SAMPLE.height() / 2.0))
    painter.end()
    return pixmap


def draw_sample(painter: QPainter, look: CurveLook, dark: bool, left: QPointF) -> None:
    """Draw a piece of the curve with its marker, from a point to the right."""
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(look.pen(dark))
    painter.drawLine(left, left + QPointF(_SAMPLE.width(), 0.0))
    painter.save()
    painter.translate(left + QPointF(_SAMPLE.width() / 2.0, 0.0))
    painter.scale(_MARKER, _MARKER)
    painter.fillPath(look.symbol, look.color(dark))
    painter.restore()


class Legend(QWidget):
    """The curves' samples and names in a row, in full where there is room; the lit one in bold."""

    def __init__(self, looks: dict[str, CurveLook], preferences: Preferences) -> None:
        super().__init__()
        self._looks, self._preferences, self._lit = looks, preferences, ""
        curves = tr(", ").join(tr(look.title) for look in looks.values())
        self.setAccessibleName(tr("Legend: {curves}", curves=curves))
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)

    def light(self, name: str) -> None:
        """Set one name in bold."""
        self._lit = name
        self.update()

    def sizeHint(self) -> QSize:
        """One line of text high."""
        return QSize(200, text_metrics().height() + 4)

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Sample, name, sample, name …"""
        painter = QPainter(self)
        metrics, dark, x = self.fontMetrics(), is_dark(self._preferences), 2.0
        names = self._names()
        for key, text in names.items():
            font = self.font()
            font.setBold(key == self._lit)
            painter.setFont(font)
            draw_sample(painter, self._looks[key], dark, QPointF(x, self.height() / 2.0))
            painter.setPen(self.palette().windowText().color())
            base = (self.height() + metrics.ascent() - metrics.descent()) / 2.0
            painter.drawText(QPointF(x + _SAMPLE.width() + 5, base), text)
            x += _width(text, metrics.horizontalAdvance(text))

    def _names(self) -> dict[str, str]:
        metrics = self.fontMetrics()
        full = {key: tr(look.title) for key, look in self._looks.items()}
        width = sum(_width(text, metrics.horizontalAdvance(text)) for text in full.values())
        return full if width <= self.width() else {key: tr(look.short) for key, look in self._looks.items()}


def _width(text: str, advance: int) -> float:
    return _SAMPLE.width() + 5 + advance + _GAP if text else 0.0
