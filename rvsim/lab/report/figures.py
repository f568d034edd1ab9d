"""Numbers of a report: texts with fixed decimals, units in the heads, matrices whose digits stand below each other."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rvsim.lab.report.values import ASSUMED, Words
from rvsim.lab.sentences import Units
from rvsim.language import left_to_right, tr, tr_later, trn
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.units import degrees_from_radians, millimetres_from_metres

MINUS, DASH = "\u2212", "–"
Row = tuple[Words, ...]
_TYPED_MINUS = re.compile(r"(?:(?<=\s)|(?<=\u2066))-(?=\s?(?:\d|[qxyz]\d?\b))|(?<=\()-(?=\d)|^-(?=\d)")
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


@dataclass(frozen=True)
class Measure:
    """How one kind of number is written: shown = factor · value, with that unit and so many decimals."""

    factor: float
    unit: str
    decimals: int

    def text(self, value: float, fewer: int = 0) -> str:
        """The number alone; ∞ and a dash for what is none."""
        return number(value * self.factor, max(self.decimals - fewer, 0))

    def amount(self, value: float) -> str:
        """The number with its unit."""
        space = "" if self.unit == "°" else " "
        return left_to_right(f"{self.text(value)}{space}{self.unit}" if self.unit else self.text(value))

    def shorter(self, value: float) -> str:
        """A round number with its unit, without decimals that say nothing."""
        return left_to_right(f"{value * self.factor:.6g} {self.unit}".replace("-", MINUS))

    def per(self, below: str) -> Measure:
        """The rate of it: "°/s"."""
        return Measure(self.factor, f"{self.unit}{below}", self.decimals)


PLAIN = Measure(1.0, "", 4)
_ANGLES = {
    "deg": Measure(degrees_from_radians(1.0), "°", 2),
    "rad": Measure(1.0, "rad", 4),
}
_LENGTHS = {"mm": Measure(millimetres_from_metres(1.0), "mm", 2), "m": Measure(1.0, "m", 5)}


class Measures:
    """The measures of one arm in the wanted units; lengths in the arm's own where its source gives them none."""

    def __init__(self, robot: Robot, units: Units) -> None:
        self.robot, self.units = robot, units
        self.angle = _ANGLES[units.angle]
        self.length = Measure(1.0, tr("units"), 3) if robot.length_unit == "unit" else _LENGTHS[units.length]
        self.metre = tr("units") if robot.length_unit == "unit" else "m"  # what Jacobians are written in

    def joint(self, index: int) -> Measure:
        """Of joint `index` (from 0)."""
        return self.angle if self.robot.joints[index].revolute else self.length

    def torque(self, index: int) -> Measure:
        """What joint `index` gives."""
        return Measure(1.0, "N m" if self.robot.joints[index].revolute else "N", 3)

    @property
    def joint_unit(self) -> str:
        """Of the axis of all joints: "°", or "°, mm" where the arm turns and slides."""
        return ", ".join(dict.fromkeys(self.joint(index).unit for index in range(self.robot.dof)))

    @property
    def in_heads(self) -> bool:
        """Whether all joints have one unit, which the heads of columns can say; else each row has its own."""
        return len({self.joint(index).unit for index in range(self.robot.dof)}) == 1

    def head(self, words: str, below: str = "") -> str:
        """The head of a column of joint values or of their rates ("/s"): "limit [°/s]", or "limit [1/s]" for rows
        that have units of their own."""
        unit = f"{self.joint_unit}{below}" if self.in_heads else below.replace("/", "1/")
        return f"{words} {left_to_right(f'[{unit}]')}" if unit else words

    def unit_cell(self, index: int) -> tuple[str, ...]:
        """The unit in the row of a joint, where the heads do not say it."""
        return () if self.in_heads else (self.joint(index).unit,)


def number(value: float, decimals: int) -> str:
    """Fixed decimals, a true minus sign, no minus before zero."""
    if math.isnan(value):
        return DASH
    if math.isinf(value):
        return "∞" if value > 0 else f"{MINUS}∞"
    return f"{round(value, decimals) + 0.0:.{decimals}f}".replace("-", MINUS)


_NUMBER = re.compile(rf"({MINUS}?\d+)(?:\.(\d+))?((?: {ASSUMED})?)")


def lined_up(rows: Sequence[Row]) -> tuple[Row, ...]:
    """Rows of a table whose points stand below each other: each column's numbers have the decimals of its longest."""
    columns = [_with_decimals(column) for column in zip(*rows, strict=True)]
    return tuple(zip(*columns, strict=True))


def _with_decimals(column: Row) -> Row:
    found = [_NUMBER.fullmatch(cell) if isinstance(cell, str) else None for cell in column]
    most = max((len(match[2] or "") for match in found if match), default=0)
    return tuple(
        f"{match[1]}.{(match[2] or '').ljust(most, '0')}{match[3]}" if match and most else cell
        for cell, match in zip(column, found, strict=True)
    )


def with_minus(text: str) -> str:
    """What somebody has typed, with true minus signs before numbers: "-90", "q4 - 90" and "-x"."""
    return _TYPED_MINUS.sub(MINUS, text)


def scientific(value: float) -> str:
    """An error or a residual: 3.1·10⁻¹⁶, never rounded to 0."""
    if value == 0.0 or not math.isfinite(value):
        return "0" if value == 0.0 else number(value, 0)
    mantissa, exponent = f"{value:.1e}".split("e")
    return f"{mantissa}·10{str(int(exponent)).translate(_SUPERSCRIPTS)}".replace("-", MINUS)


def small(value: float) -> str:
    """Four decimals, powers of ten where these would show nothing, 0 where only rounding is left."""
    if abs(value) < 1e-12:
        return "0"
    return number(value, 4) if abs(value) >= 1e-3 else scientific(value)


def matrix_latex(cells: Sequence[Sequence[str]]) -> str:
    """Rows of numbers, written with ASCII minus signs; those of a column end at the same place."""
    widths = [max(map(_digits, column)) for column in zip(*cells, strict=True)]
    signs = [any(cell.startswith("-") for cell in column) for column in zip(*cells, strict=True)]
    lines = (" & ".join(_padded(*entry) for entry in zip(row, widths, signs, strict=True)) for row in cells)
    body = " \\\\ ".join(lines)
    return f"\\begin{{bmatrix}} {body} \\end{{bmatrix}}"


def _digits(cell: str) -> int:
    return sum(letter.isdigit() for letter in cell)


def _padded(cell: str, width: int, signed: bool) -> str:
    """With places that stay empty for a sign and for digits, which the typesetter keeps as wide as these."""
    digits = cell.lstrip("-")
    sign = "{-}" if digits != cell else "\\phantom{-}" if signed else ""
    return sign + "\\phantom{0}" * (width - _digits(cell)) + digits


def entry(value: float, measure: Measure, fewer: int = 0) -> str:
    """An entry of a matrix."""
    return measure.text(value, fewer).replace(MINUS, "-")


def transform_latex(T: FloatArray, length: Measure) -> str:
    """A transform (4, 4), its last column in that unit."""
    rows = [[*(entry(float(v), PLAIN) for v in row[:3]), entry(float(row[3]), length)] for row in np.asarray(T)[:3]]
    return matrix_latex([*rows, ["0", "0", "0", "1"]])


def table_latex(values: FloatArray, decimals: int) -> str:
    """A matrix (m, n) or vector (n,) of plain numbers."""
    rows = np.asarray(values, dtype=np.float64)
    rows = rows[:, None] if rows.ndim == 1 else rows
    plain = Measure(1.0, "", decimals)
    return matrix_latex([[entry(float(value), plain) for value in row] for row in rows])


def subscript(index: int) -> str:
    """3 as ₃."""
    return str(index).translate(_SUBSCRIPTS)


_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


_NUMBERS = (
    tr_later("no"), tr_later("one"), tr_later("two"), tr_later("three"), tr_later("four"), tr_later("five"),
    tr_later("six"), tr_later("seven"), tr_later("eight"), tr_later("nine"), tr_later("ten"), tr_later("eleven"),
    tr_later("twelve"),
)  # fmt: skip


def number_word(count: int) -> str:
    """ "four"; larger ones as digits."""
    return tr(_NUMBERS[count]) if count < len(_NUMBERS) else str(count)


def within_limits_words(within: int, count: int) -> str:
    """How many of some solutions lie within the limits, as a sentence."""
    if count == 1:
        return tr("It lies within the limits.") if within else tr("It does not lie within the limits.")
    if not within:
        return tr("None of them lies within the limits.")
    return trn(
        "Of these, {count} lies within the limits.",
        "Of these, {count} lie within the limits.",
        within,
        count=number_word(within),
    )
