"""Numbers in formulas: degrees, millimetres (or the arm's own unit) and plain numbers, put into templates.

A template is LaTeX with `<name>` where a quantity stands and `*` for a product: symbols are set side by side, numbers
with a dot between. A negative number gets parentheses, unless its name ends in a comma: `<name,>`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import ClassVar, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.lab.worked.values import Equation
from rvsim.robot import Robot
from rvsim.units import degrees_from_radians, millimetres_from_metres

Kind = Literal["angle", "length", "number"]
_HOLE = re.compile(r"<(\w+)(,?)>")
_ROUNDING = 1e-9


class Quantity(NamedTuple):
    """A symbol and its value [rad, m, 1]."""

    symbol: str
    value: float
    kind: Kind = "length"


class Figures:
    """How the numbers of one arm are written."""

    DECIMALS: ClassVar[dict[str, int]] = {"angle": 2, "number": 4, "length": 1, "unit_length": 3}

    def __init__(self, robot: Robot) -> None:
        self._millimetres = robot.length_unit == "millimetre"

    def number(self, value: float, kind: Kind) -> str:
        """A bare number; an angle has its degree sign, a length no unit."""
        if kind == "angle":
            return f"{_fixed(degrees_from_radians(value), self.DECIMALS[kind])}^\\circ"
        if kind == "number":
            return _fixed(value, self.DECIMALS[kind])
        if self._millimetres:
            return _fixed(millimetres_from_metres(value), self.DECIMALS[kind])
        return _fixed(value, self.DECIMALS["unit_length"])

    def result(self, value: float, kind: Kind) -> str:
        """A number with its unit."""
        unit = "\\,\\mathrm{mm}" if self._millimetres else ""
        return self.number(value, kind) + (unit if kind == "length" else "")

    def text(self, value: float, kind: Kind) -> str:
        """A number with its unit for a sentence."""
        number = self.number(value, kind).replace("^\\circ", "°").replace("-", "\u2212")
        unit = " mm" if self._millimetres else " units"
        return number + (unit if kind == "length" else "")

    def equation(self, result: Quantity, template: str, *quantities: Quantity, **named: Quantity) -> Equation:
        """The formula, its numbers and its result; quantities answer to their symbols without backslash and braces.

        An angle beyond half a turn is shown as it comes out, and as the same angle within [−π, π].
        """
        known = {_name(quantity.symbol): quantity for quantity in quantities} | named
        symbolic = _HOLE.sub(lambda hole: known[hole[1]].symbol, template).replace("*", "\\,")
        numbers = _HOLE.sub(lambda hole: self._operand(known[hole[1]], bool(hole[2])), template)
        shown, value = self.result(result.value, result.kind), result.value
        if result.kind == "angle" and abs(wrapped(value) - value) > _ROUNDING:
            value = wrapped(value)
            shown += f" \\equiv {self.result(value, 'angle')}"
        substituted = numbers.replace("*", "\\cdot ")
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
