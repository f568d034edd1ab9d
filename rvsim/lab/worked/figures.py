"""Numbers in formulas: angles, lengths in the wanted (or the arm's own) unit and plain numbers, put into templates.

A template is LaTeX with `<name>` where a quantity stands and `*` for a product: symbols are set side by side, numbers
with a dot between. A negative number gets parentheses, unless its name ends in a comma: `<name,>`. Fixed angles in it
are written in degrees, `180^\\circ`; in radians they become parts of π.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import ClassVar, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.lab.sentences import Units
from rvsim.lab.worked.values import Equation
from rvsim.language import tr, tr_later
from rvsim.robot import Robot

Kind = Literal["angle", "length", "number"]
_HOLE = re.compile(r"<(\w+)(,?)>")
_MINUS_ZERO = re.compile(r"((?:^|[({,]|\\,) *)-(?=0(?:\.0+)?(?![\d.]))")  # a sign before what is rounded to 0
_FIXED_ANGLE = re.compile(r"([\d.]+)\^\\circ")
_ROUNDING = 1e-9
_DEFAULT = Units()
_UNITS = tr_later("{number} units")


class _Style(NamedTuple):
    """How one kind of number is written: factor · SI value; the sign of its unit in a formula and in a sentence.

    A degree sign stands in the middle of a formula too, other units beside its result alone.
    """

    factor: float
    decimals: str
    unit: str
    word: str


_STYLES = {
    "deg": _Style(180.0 / math.pi, "degrees", "^\\circ", "°"),
    "rad": _Style(1.0, "radians", "\\,\\mathrm{rad}", " rad"),
    "mm": _Style(1e3, "millimetres", "\\,\\mathrm{mm}", " mm"),
    "m": _Style(1.0, "metres", "\\,\\mathrm{m}", " m"),
    "units": _Style(1.0, "units", "", _UNITS),
    "number": _Style(1.0, "number", "", ""),
}


class Quantity(NamedTuple):
    """A symbol and its value [rad, m, 1]."""

    symbol: str
    value: float
    kind: Kind = "length"


class Figures:
    """How the numbers of one arm are written: in these units, lengths in the arm's own where it has one."""

    DECIMALS: ClassVar[dict[str, int]] = {
        "degrees": 2, "radians": 4, "number": 4, "millimetres": 1, "metres": 4, "units": 3,
    }  # fmt: skip

    def __init__(self, robot: Robot, units: Units = _DEFAULT) -> None:
        length = units.length if robot.length_unit == "millimetre" else "units"
        self._styles = {"angle": _STYLES[units.angle], "length": _STYLES[length], "number": _STYLES["number"]}
        self.in_degrees = units.angle == "deg"

    def number(self, value: float, kind: Kind) -> str:
        """A number for the middle of a formula: an angle in degrees has its sign, no other unit is written."""
        sign = "^\\circ" if kind == "angle" and self.in_degrees else ""
        return self._bare(value, kind) + sign

    def result(self, value: float, kind: Kind) -> str:
        """A number with its unit."""
        return self._bare(value, kind) + self._styles[kind].unit

    def text(self, value: float, kind: Kind) -> str:
        """A number with its unit for a sentence."""
        number, word = self._bare(value, kind).replace("-", "\u2212"), self._styles[kind].word
        return number + word if word != _UNITS else tr(_UNITS, number=number)

    def constant(self, value: float, kind: Kind) -> str:
        """A positive number of the arm's table, as short as it can be said: 90°, π/2."""
        if kind == "angle" and not self.in_degrees:
            return _part_of_pi(value) or self.number(value, kind)
        return self.number(value, kind).replace(".00^", "^")

    def _bare(self, value: float, kind: Kind) -> str:
        style = self._styles[kind]
        return _fixed(style.factor * value, self.DECIMALS[style.decimals])

    def _fixed_angles(self, template: str, *, exact: bool) -> str:
        """A template with its fixed angles in the present unit: for the formula exact, for its numbers decimal."""
        if self.in_degrees:
            return template
        write = self.constant if exact else self.number
        return _FIXED_ANGLE.sub(lambda angle: write(math.radians(float(angle[1])), "angle"), template)

    def equation(self, result: Quantity, template: str, *quantities: Quantity, **named: Quantity) -> Equation:
        """The formula, its numbers and its result; quantities answer to their symbols without backslash and braces.

        An angle beyond half a turn is shown as it comes out, and as the same angle within [−π, π].
        """
        known = {_name(quantity.symbol): quantity for quantity in quantities} | named
        symbolic = _HOLE.sub(lambda hole: known[hole[1]].symbol, self._fixed_angles(template, exact=True)).replace(
            "*", "\\,"
        )
        numbers = _HOLE.sub(
            lambda hole: self._operand(known[hole[1]], bool(hole[2])), self._fixed_angles(template, exact=False)
        )
        shown, value = self.result(result.value, result.kind), result.value
        if result.kind == "angle" and abs(wrapped(value) - value) > _ROUNDING:
            value = wrapped(value)
            shown += f" \\equiv {self.result(value, 'angle')}"
        substituted = _MINUS_ZERO.sub(r"\1", numbers).replace("*", "\\cdot ")
        return Equation(result.symbol, symbolic, "" if substituted in (symbolic, shown) else substituted, shown, value)

    def matrix(self, left: str, formula: str, entries: ArrayLike, kinds: Sequence[Kind]) -> Equation:
        """A matrix (m, k) of numbers, `kinds` one a column; the digits of a column stand below each other."""
        rows = np.asarray(entries, dtype=np.float64)
        cells = np.array([[self.number(v, kind) for v, kind in zip(row, kinds, strict=True)] for row in rows])
        widths = [max(5, *(len(cell.lstrip("-")) for cell in column)) for column in cells.T]
        padded = [[_padded(cell, width) for cell, width in zip(row, widths, strict=True)] for row in cells]
        body = " \\\\ ".join(" & ".join(row) for row in padded)
        return Equation(left, formula, f"\\begin{{bmatrix}} {body} \\end{{bmatrix}}", "")

    def _operand(self, quantity: Quantity, bare: bool) -> str:
        text = self.number(quantity.value, quantity.kind)
        return text if bare or not text.startswith("-") else f"({text})"


def wrapped(angle: float) -> float:
    """The same angle within [−π, π]."""
    return math.remainder(angle, 2.0 * math.pi)


def _part_of_pi(angle: float) -> str:
    """A positive angle as π, or π over a small number, or "" where it is neither."""
    for below in range(1, 7):
        if abs(angle * below - math.pi) <= _ROUNDING:
            return "\\pi" if below == 1 else f"\\frac{{\\pi}}{{{below}}}"
    return ""


def _name(symbol: str) -> str:
    """What a template calls a symbol: q_1 is q1, \\varphi is varphi."""
    return re.sub(r"\W|_", "", symbol)


def _fixed(value: float, decimals: int) -> str:
    text = f"{value:.{decimals}f}"
    return text.lstrip("-") if float(text) == 0.0 else text


def _padded(cell: str, width: int) -> str:
    digits = cell.lstrip("-")
    sign = "{-}" if digits != cell else "\\phantom{-}"
    return sign + "\\phantom{0}" * (width - len(digits)) + digits
