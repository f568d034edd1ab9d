"""Arrays and named values as text to paste elsewhere: plain text, NumPy, LaTeX, tab-separated. ASCII, full precision.

Every number is written so that it reads back as the same float: near-zero stays what it is, only −0 loses its sign.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rvsim.errors import ShapeError

FloatArray = NDArray[np.float64]


class NamedValue(NamedTuple):
    """A number with its name and unit, for instance ("x", 363.7, "mm"); the unit may be empty."""

    name: str
    value: float
    unit: str = ""


def number_text(value: float) -> str:
    """The shortest text that reads back as the same float: 0.1, 6.123e-17, inf, nan; −0 is 0."""
    return repr(float(value) + 0.0)


def matrix_text(matrix: ArrayLike) -> str:
    """Rows of a vector (n,) or matrix (m, n), the numbers of a column right-aligned.

    Raises:
        ShapeError: it has more than two axes.
    """
    rows = [[number_text(value) for value in row] for row in _two_axes(matrix)]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return "\n".join("  ".join(cell.rjust(w) for cell, w in zip(row, widths, strict=True)) for row in rows)


def matrix_numpy(matrix: ArrayLike) -> str:
    """An expression that evaluates to the same array where `np` is NumPy; (n,) stays (n,).

    Raises:
        ShapeError: it has more than two axes.
    """
    rows = ["[" + ", ".join(map(_numpy_number, row)) + "]" for row in _two_axes(matrix)]
    if np.ndim(matrix) == 1:
        return f"np.array({rows[0]})"
    return "np.array([\n" + "".join(f"    {row},\n" for row in rows) + "])"


def matrix_latex(matrix: ArrayLike) -> str:
    r"""A `bmatrix` of amsmath; powers of ten are written out, a vector (n,) is one column.

    Raises:
        ShapeError: it has more than two axes.
    """
    table = _two_axes(matrix)
    rows = table.T if np.ndim(matrix) == 1 else table
    body = " \\\\\n".join("  " + " & ".join(map(number_latex, row)) for row in rows)
    return f"\\begin{{bmatrix}}\n{body}\n\\end{{bmatrix}}"


def number_latex(value: float) -> str:
    r"""A number in LaTeX's mathematics: 0.25, 6.1 \times 10^{-17}, \infty."""
    if not math.isfinite(value):
        return "\\mathrm{nan}" if math.isnan(value) else ("\\infty" if value > 0 else "-\\infty")
    mantissa, _, exponent = number_text(value).partition("e")
    return f"{mantissa} \\times 10^{{{int(exponent)}}}" if exponent else mantissa


def table_tsv(header: Sequence[str], rows: Iterable[Sequence[str | float]]) -> str:
    """Tab-separated lines with a header, as a spreadsheet takes them; numbers in full precision."""
    cells = [[cell if isinstance(cell, str) else number_text(cell) for cell in row] for row in rows]
    return "\n".join("\t".join(line) for line in [list(header), *cells])


def values_text(values: Sequence[NamedValue]) -> str:
    """One line a value: x = 363.7 mm."""
    width = max(len(value.name) for value in values)
    return "\n".join(f"{name:<{width}} = {number_text(value)} {unit}".rstrip() for name, value, unit in values)


def values_numpy(values: Sequence[NamedValue]) -> str:
    """A comment that names the values and their units, and one array of them."""
    names = ", ".join(f"{name} [{unit}]" if unit else name for name, _, unit in values)
    return f"# {names}\n{matrix_numpy([value for _, value, _ in values])}"


def values_latex(values: Sequence[NamedValue]) -> str:
    """An `aligned` block of amsmath, one line a value."""
    lines = (f"  {_latex_name(name)} &= {number_latex(value)}{_latex_unit(unit)}" for name, value, unit in values)
    return "\\begin{aligned}\n" + " \\\\\n".join(lines) + "\n\\end{aligned}"


def pose_text(T: ArrayLike) -> str:
    """The columns n, o, a, p of a pose (4, 4) under their names.

    Raises:
        ShapeError: it is no (4, 4).
    """
    matrix = np.asarray(T, dtype=np.float64)
    if matrix.shape != (4, 4):
        raise ShapeError("T", "(4, 4)", matrix.shape)
    return "\n".join(f"{name} = ({', '.join(map(number_text, matrix[:3, i]))})" for i, name in enumerate("noap"))


def _two_axes(matrix: ArrayLike) -> FloatArray:
    array = np.atleast_2d(np.asarray(matrix, dtype=np.float64))
    if array.ndim != 2:
        raise ShapeError("matrix", "(m, n)", array.shape)
    return array


def _numpy_number(value: float) -> str:
    return (
        number_text(value)
        if math.isfinite(value)
        else number_text(value).replace("inf", "np.inf").replace("nan", "np.nan")
    )


_LATEX_UNITS = {"deg": "^{\\circ}", "": ""}


def _latex_unit(unit: str) -> str:
    return _LATEX_UNITS.get(unit, f"\\,\\mathrm{{{unit}}}")


def _latex_name(name: str) -> str:
    return name if len(name) == 1 else f"\\mathrm{{{name}}}"
