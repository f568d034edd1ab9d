"""Letters on paper: the faces of a report, and text set in lines. All lengths are points, 1/72 inch."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from functools import cache
from importlib import resources
from typing import NamedTuple

from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontDatabase,
    QFontInfo,
    QFontMetricsF,
    QPainter,
    QTextCharFormat,
    QTextLayout,
    QTextOption,
)

from rvsim.gui.text_box import wrap_mode
from rvsim.lab.report.values import Run, Style, Words, runs, unbroken
from rvsim.language import has_right_to_left, language

FINE = 20.0  # text is set in twentieths of a point, so that rounding is not seen
INK, MUTED, RULE = QColor("#1D2733"), QColor("#566373"), QColor("#1D2733")
ACCENT = QColor("#2F55D4")
_COLORS = {"good": QColor("#00664B"), "warning": QColor("#8A4B00"), "bad": QColor("#B3261E"), "muted": MUTED}
_LOWERED: Style = "index"  # what is left of such a run is its index alone
_LOWER = 6.0  # [%] of the height of a line, which is large in fonts of formulas
_ARABIC = "Noto Sans Arabic UI"  # which comes with rvsim, and has no other letters
_SANS = ["Helvetica Neue", "Helvetica", "Arial", "Liberation Sans", "Nimbus Sans", _ARABIC, "DejaVu Sans"]
_SERIF = ["Times New Roman", "Liberation Serif", "Nimbus Roman", _ARABIC, "DejaVu Serif"]
_MONO = ["DejaVu Sans Mono", "Consolas", "Menlo", "Liberation Mono", "Courier New", "monospace", _ARABIC]


class Face(NamedTuple):
    """A way to set text: which letters, how large, how far from line to line [pt]."""

    size: float
    leading: float
    sans: bool = False
    bold: bool = False
    color: QColor = INK


BODY = Face(10.5, 14.2)
LEAD = Face(11.5, 16.0)
NOTE = Face(8.0, 10.6, sans=True, color=MUTED)
CAPTION = Face(8.6, 11.4, sans=True)
CELL = Face(9.5, 13.6)
HEAD = Face(8.0, 11.0, sans=True, bold=True)
TITLE = Face(22.0, 27.0, sans=True, bold=True)
SECTION = Face(14.0, 18.0, sans=True, bold=True)
SUBHEAD = Face(10.5, 14.0, sans=True, bold=True)
SMALL = Face(8.0, 10.0, sans=True, color=MUTED)


@cache
def serif_families() -> list[str]:
    """The letters that belong to the formulas, which come with them, then those that are like them."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of the library's own import of a font, on some Pythons
        fonts = resources.files("ziamath") / "fonts"
    with resources.as_file(fonts / "STIXTwoMath-Regular.ttf") as file:
        number = QFontDatabase.addApplicationFont(str(file))
    own = QFontDatabase.applicationFontFamilies(number) if number >= 0 else []
    return ["STIX Two Text", *own, *_SERIF]


@cache
def sans_family() -> str:
    """The letters of captions: a drawing in SVG takes one name only."""
    return QFontInfo(font(CAPTION)).family()


def font(face: Face, style: str = "", scale: float = FINE) -> QFont:
    """The font of a face, `scale` times as large."""
    made = QFont(_MONO if style == "code" else _SANS if face.sans or style == "bold" else serif_families())
    size = face.size * (0.86 if style == "code" or (style == "bold" and not face.sans) else 1.0)
    made.setPixelSize(max(1, round(size * scale)))
    made.setHintingPreference(QFont.HintingPreference.PreferNoHinting)
    made.setKerning(not from_right())  # the Arabic font kerns letters within a word as far apart as words
    if face.bold or style in ("bold", "bad"):
        made.setWeight(QFont.Weight.DemiBold if not face.bold else QFont.Weight.Bold)
    return made


def from_right() -> bool:
    """Whether the pages are laid out from right to left."""
    return language().right_to_left


def aside(whole: float, left: float, width: float) -> float:
    """Where something of a width begins on the page, counted from its left edge: `left` is from where reading begins.

    All that is placed beside or inside something else is placed by this, so that a page can be laid out both ways.
    """
    return whole - left - width if from_right() else left


class Text:
    """Words in lines of a width, at the side of it where reading begins."""

    def __init__(self, words: Words, face: Face, width: float, *, justified: bool = False, scale: float = 1.0) -> None:
        self.face, self._scale, self.room = face, scale, width
        pieces = [run for run in _letters(words) if run.text]
        text = "".join(run.text for run in pieces)
        self._layout = QTextLayout(text, font(face))
        side = Qt.AlignmentFlag.AlignRight if from_right() else Qt.AlignmentFlag.AlignLeft
        # Qt widens lines at numbers and foreign words alone where they are written from right to left.
        option = QTextOption(Qt.AlignmentFlag.AlignJustify if justified and not from_right() else side)
        option.setWrapMode(wrap_mode(text))
        if from_right():
            option.setTextDirection(_direction(text))
        self._layout.setTextOption(option)
        self._layout.setFormats(_formats(pieces, face))
        self._layout.beginLayout()
        while (line := self._layout.createLine()).isValid():
            line.setLineWidth(width * FINE / scale)
        self._layout.endLayout()

    @property
    def left(self) -> float:
        """From where it is drawn to the left end of its longest line."""
        return aside(self.room, 0.0, self.width)

    @property
    def count(self) -> int:
        """How many lines."""
        return self._layout.lineCount()

    @property
    def leading(self) -> float:
        """From line to line."""
        return self.face.leading * self._scale

    @property
    def height(self) -> float:
        """Of all lines."""
        return self.count * self.leading

    @property
    def ascent(self) -> float:
        """From the upper edge to the first baseline."""
        return self._scale * (0.5 * self.face.leading + 0.34 * self.face.size)

    @property
    def descent(self) -> float:
        """From the first baseline to the lower edge."""
        return self.height - self.ascent

    @property
    def width(self) -> float:
        """Of the longest line."""
        lines = (self._layout.lineAt(number).naturalTextWidth() for number in range(self.count))
        return max(lines, default=0.0) * self._scale / FINE

    def draw(self, painter: QPainter, x: float, y: float, first: int = 0, last: int | None = None) -> None:
        """Some of its lines, the first one's upper edge at y."""
        painter.save()
        painter.translate(x, y)
        painter.scale(self._scale / FINE, self._scale / FINE)
        painter.setPen(self.face.color)
        for row, number in enumerate(range(first, self.count if last is None else last)):
            line = self._layout.lineAt(number)
            baseline = FINE * (row * self.face.leading + self.ascent / self._scale)
            line.draw(painter, QPointF(-line.x(), baseline - line.ascent() - line.y()))
        painter.restore()


def _letters(words: Words) -> Iterator[Run]:
    """Runs of letters: an index is one of its own, lower and smaller."""
    for run in runs(words):
        if run.style != "index":
            yield Run(unbroken(run.text), run.style)
            continue
        letter, _, index = run.text.partition("_")
        yield Run(letter)
        yield Run(index, _LOWERED)


def _direction(text: str) -> Qt.LayoutDirection:
    """On a page that is read from right to left numbers and formulas are not."""
    return Qt.LayoutDirection.RightToLeft if has_right_to_left(text) else Qt.LayoutDirection.LeftToRight


def _formats(pieces: list[Run], face: Face) -> list[QTextLayout.FormatRange]:
    formats, start = [], 0
    for run in pieces:
        length = _utf16(run.text)
        if run.style:
            made = QTextLayout.FormatRange()
            made.start, made.length = start, length
            look = QTextCharFormat()
            look.setFont(font(face, run.style))
            if run.style == _LOWERED:
                look.setVerticalAlignment(QTextCharFormat.VerticalAlignment.AlignSubScript)
                look.setSubScriptBaseline(_LOWER)
            look.setForeground(_COLORS.get(run.style, face.color))
            made.format = look
            formats.append(made)
        start += length
    return formats


def _utf16(text: str) -> int:
    """How long Qt finds it."""
    return len(text.encode("utf-16-le")) // 2


def text_width(words: Words, face: Face) -> float:
    """Of one line."""
    return sum(QFontMetricsF(font(face, run.style)).horizontalAdvance(run.text) for run in runs(words)) / FINE
