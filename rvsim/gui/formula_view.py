"""Equations in a column as wide as its place: the formula, the same with numbers, the result."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from PySide6.QtCore import QEvent, QObject, QPointF, QRectF, QSize, Qt, QTimer, Signal
from PySide6.QtGui import QColor, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from rvsim.gui.formula import SIZE, Typeset, is_set, plain_text, typeset
from rvsim.lab.worked import Equation

_INDENT, _GAP, _LEADING = 18.0, 5.0, 6.0  # [px at a font of 16 px]: a line that goes on, between parts, between lines
_SMALLEST = 0.55  # a formula that is too wide is drawn smaller, but not smaller than this
_PAUSE_MS = 4  # between two formulas that are set: the window must live on
_RELATIVE_SIZE = 1.16  # the letters of formulas are small for their size


class Typesetter(QObject):
    """Sets formulas one by one while nothing else is to be done; `one_set` tells of each."""

    one_set = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._waiting: dict[str, None] = {}
        self._timer = QTimer(self)
        self._timer.setInterval(_PAUSE_MS)
        self._timer.timeout.connect(self._set_one)

    def want(self, latex: str) -> None:
        """This formula is to be seen."""
        self._waiting[latex] = None
        if not self._timer.isActive():
            self._timer.start()

    def forget(self) -> None:
        """Nothing of what was wanted is to be seen any more."""
        self._waiting.clear()

    @property
    def idle(self) -> bool:
        """Whether all that was wanted is set."""
        return not self._waiting

    def _set_one(self) -> None:
        if not self._waiting:
            self._timer.stop()
            return
        latex = next(iter(self._waiting))
        del self._waiting[latex]
        if not is_set(latex):
            typeset(latex)
            self.one_set.emit()


class _Part(NamedTuple):
    """A piece of a line: LaTeX and the palette role of its colour."""

    latex: str
    role: str


class _Placed(NamedTuple):
    """A part at its place: left end and baseline, its scale, and the formula if it is set."""

    part: _Part
    at: QPointF
    scale: float
    formula: Typeset | None


class _OnLine(NamedTuple):
    """A part that waits for the baseline of its line."""

    part: _Part
    x: float
    scale: float
    formula: Typeset | None


class _Layout(NamedTuple):
    """Everything at its place, for one width."""

    placed: tuple[_Placed, ...]
    height: float


class EquationsView(QWidget):
    """Shows equations; what is not set yet stands there as plain text."""

    def __init__(self, typesetter: Typesetter, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._typesetter = typesetter
        self._equations: tuple[tuple[_Part, ...], ...] = ()
        self._layouts: dict[int, _Layout] = {}
        self._unset: set[str] = set()
        policy = QSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        policy.setHeightForWidth(True)
        self.setSizePolicy(policy)
        self.setLayoutDirection(Qt.LayoutDirection.LeftToRight)
        typesetter.one_set.connect(self._on_one_set)

    def show_equations(self, equations: Sequence[Equation]) -> None:
        """Show these."""
        parts = tuple(_parts(equation) for equation in equations)
        if parts == self._equations:
            return
        self._equations = parts
        self.setAccessibleName("; ".join(plain_text(" ".join(part.latex for part in line)) for line in parts))
        self._lay_out_anew()

    def text(self) -> str:
        """What is shown, as plain text, one equation a line."""
        return "\n".join(plain_text(" ".join(part.latex for part in line)) for line in self._equations)

    # --- layout ----------------------------------------------------------------------------------------------------

    def hasHeightForWidth(self) -> bool:
        """A narrow column is a long one."""
        return True

    def heightForWidth(self, width: int) -> int:
        """The height all lines need at a width."""
        return round(self._lay_out(width).height)

    def sizeHint(self) -> QSize:
        """As wide as it is."""
        return QSize(200, self.heightForWidth(max(self.width(), 200)))

    def minimumSizeHint(self) -> QSize:
        """No narrower than a short formula."""
        return QSize(80, 0)

    def changeEvent(self, event: QEvent) -> None:
        """Another font: another size."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._lay_out_anew()

    def _on_one_set(self) -> None:
        if any(is_set(latex) for latex in self._unset):
            self._lay_out_anew()

    def _lay_out_anew(self) -> None:
        self._unset = {part.latex for line in self._equations for part in line if not is_set(part.latex)}
        self._layouts.clear()
        self.updateGeometry()
        self.update()

    def _lay_out(self, width: int) -> _Layout:
        if width not in self._layouts:
            zoom = self.fontInfo().pixelSize() * _RELATIVE_SIZE / SIZE
            placed: list[_Placed] = []
            top = 0.0
            for equation in self._equations:
                top = self._lay_out_equation(equation, width / zoom, top, zoom, placed)
            self._layouts[width] = _Layout(tuple(placed), top * zoom)
        return self._layouts[width]

    def _lay_out_equation(
        self, equation: tuple[_Part, ...], width: float, top: float, zoom: float, placed: list[_Placed]
    ) -> float:
        """Parts side by side as far as they fit; the rest goes on in the next line. Returns the new top."""
        line: list[_OnLine] = []
        x = 0.0
        formulas = [typeset(part.latex) if is_set(part.latex) else None for part in equation]
        widths = [
            formula.width if formula else self._text_width(part.latex) / zoom
            for part, formula in zip(equation, formulas, strict=True)
        ]
        for i, (part, formula, wide) in enumerate(zip(equation, formulas, widths, strict=True)):
            if line and _breaks(x, widths[i:], width):
                top, line, x = _end_line(line, top, zoom, placed), [], _INDENT
            scale = max(_SMALLEST, min(1.0, (width - x) / wide)) if wide > 0.0 else 1.0
            line.append(_OnLine(part, x, scale, formula))
            x += wide * scale + _GAP
        return _end_line(line, top, zoom, placed)

    def _text_width(self, latex: str) -> float:
        return float(self.fontMetrics().horizontalAdvance(plain_text(latex)))

    # --- painting --------------------------------------------------------------------------------------------------

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw what is in sight, and ask for what is not set yet."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setLayoutDirection(Qt.LayoutDirection.LeftToRight)  # of what stands there as text
        for placed in self._lay_out(self.width()).placed:
            if self._area(placed).intersects(QRectF(event.rect())):
                self._draw(painter, placed)

    def _area(self, placed: _Placed) -> QRectF:
        part, at, scale, formula = placed
        ascent, descent = _ascent(part, formula) * scale, _descent(part, formula) * scale
        return QRectF(0.0, at.y() - ascent, self.width(), ascent + descent)

    def _draw(self, painter: QPainter, placed: _Placed) -> None:
        part, at, scale, formula = placed
        color = self._color(part.role)
        if formula is None:
            self._typesetter.want(part.latex)
            painter.setPen(color)
            painter.drawText(at, plain_text(part.latex))
            return
        painter.save()
        painter.translate(at)
        painter.scale(scale, scale)
        painter.fillPath(formula.path, color)
        painter.restore()

    def _color(self, role: str) -> QColor:
        palette = self.palette()
        colors = {"formula": palette.text(), "numbers": palette.placeholderText(), "result": palette.link()}
        return colors[role].color()


def _parts(equation: Equation) -> tuple[_Part, ...]:
    """The formula with its left side, then the numbers, then the result."""
    found = [
        _Part(f"= {text}", role)
        for text, role in (
            (equation.formula, "formula"),
            (equation.substituted, "numbers"),
            (equation.result, "result"),
        )
        if text
    ]
    first = found[0] if found else _Part("", "formula")
    return (_Part(f"{equation.left} {first.latex}", first.role), *found[1:])


def _breaks(x: float, widths: Sequence[float], width: float) -> bool:
    """Whether a new line begins: the part does not fit, or its result would stand alone in the next line."""
    whole = sum(widths) + _GAP * (len(widths) - 1)
    return x + widths[0] > width or (x + whole > width >= _INDENT + whole)


def _end_line(line: list[_OnLine], top: float, zoom: float, placed: list[_Placed]) -> float:
    """Put a line on its baseline; returns the top of the next one."""
    ascent = max(_ascent(part, formula) * scale for part, _, scale, formula in line)
    descent = max(_descent(part, formula) * scale for part, _, scale, formula in line)
    baseline = top + ascent
    placed += (_Placed(p, QPointF(x * zoom, baseline * zoom), scale * zoom, formula) for p, x, scale, formula in line)
    return baseline + descent + _LEADING


def _ascent(part: _Part, formula: Typeset | None) -> float:
    """A line is at least as high as its digits; one that is not set yet as high as it is likely to be."""
    if formula is not None:
        return max(formula.ascent, 12.5)
    return 28.0 if "bmatrix" in part.latex else 22.0 if "frac" in part.latex else 12.5


def _descent(part: _Part, formula: Typeset | None) -> float:
    if formula is not None:
        return max(formula.descent, 4.0)
    return 20.0 if "bmatrix" in part.latex else 11.0 if "frac" in part.latex else 4.0
