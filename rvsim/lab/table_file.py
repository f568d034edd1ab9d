"""Tables of numbers as spreadsheets write them: CSV with any usual separator, with or without a header."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, NamedTuple

import numpy as np

from rvsim.errors import ExpressionError, PathFileError
from rvsim.expressions import evaluate
from rvsim.language import tr, trn
from rvsim.robot.arrays import FloatArray
from rvsim.units import metres_from_millimetres, radians_from_degrees

ColumnUnit = Literal["deg", "rad", "mm", "m", "unit", "s", ""]

LARGEST_BYTES = 20_000_000
DELIMITERS = (";", "\t", ",", " ")  # the first of these that is in the first line separates
_UNIT = re.compile(r"(?:\[(\w+)\]|\((\w+)\)|_(deg|rad|mm|m|units?))$")
_NUMBER = re.compile(r"[+-]?(\d{1,20}([.,]\d*)?|[.,]\d+)([eE][+-]?\d{1,3})?")
_SPELLINGS = {"units": "unit", "degree": "deg", "degrees": "deg", "°": "deg", "seconds": "s", "radians": "rad"}
_FACTORS: dict[ColumnUnit, float] = {
    "deg": radians_from_degrees(1.0), "rad": 1.0, "mm": metres_from_millimetres(1.0), "m": 1.0, "unit": 1.0,
    "s": 1.0, "": 1.0,
}  # fmt: skip


class RawRow(NamedTuple):
    """A line of the file, counted from 1, and its cells."""

    number: int
    cells: list[str]


class RawTable(NamedTuple):
    """The cells of a file: `names` of the columns, from its header or "column 1" …, and the rows below it."""

    path: Path
    delimiter: str
    has_header: bool
    names: tuple[str, ...]
    rows: list[RawRow]


@dataclass(frozen=True)
class Column:
    """Which column of a file (from 0) a wanted value stands in, what it is called in messages, and its unit."""

    index: int
    name: str
    unit: ColumnUnit = ""


def read_text(file: Path | str) -> str:
    """The text of a file of numbers.

    Raises:
        PathFileError: it is too large, or no UTF-8 text.
        OSError: the file cannot be read.
    """
    path = Path(file)
    if path.stat().st_size > LARGEST_BYTES:
        raise PathFileError(
            path,
            tr("the file"),
            trn("{n} byte", "{n} bytes", path.stat().st_size),
            tr("at most {most}", most=LARGEST_BYTES),
        )
    try:
        return path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError:
        raise PathFileError(path, tr("the file"), tr("bytes that are no text"), tr("a CSV file in UTF-8")) from None


def raw_table(path: Path, text: str, delimiter: str = "", has_header: bool | None = None) -> RawTable:
    """The cells; what is not said is guessed: the first separator of `DELIMITERS`, a header where no cell is a number.

    Empty lines and lines that begin with # are skipped.

    Raises:
        PathFileError: there is no row of values.
    """
    lines = [(number, line) for number, line in enumerate(text.splitlines(), 1) if counts(line)]
    if not lines:
        raise PathFileError(path, tr("the file"), tr("nothing"), tr("rows of numbers"))
    mark = delimiter or next((mark for mark in DELIMITERS if mark in lines[0][1].strip()), ",")
    rows = [RawRow(number, cells_of(line, mark)) for number, line in lines]
    header = not any(is_number(cell) for cell in rows[0].cells) if has_header is None else has_header
    width = max(len(row.cells) for row in rows)
    names = [tr("column {number}", number=number) for number in range(1, width + 1)]
    if header:
        names[: len(rows[0].cells)] = rows[0].cells
    body = rows[1:] if header else rows
    if not body:
        raise PathFileError(path, tr("the file"), tr("a header only"), tr("at least one row of numbers"))
    return RawTable(path, mark, header, tuple(names), body)


def counts(line: str) -> bool:
    """Whether a line is neither empty nor a comment."""
    return bool(line.strip()) and not line.lstrip().startswith("#")


def cells_of(line: str, delimiter: str) -> list[str]:
    """The cells of a line, without blanks around them."""
    if delimiter == " ":
        return line.split()
    return [cell.strip() for cell in next(csv.reader([line.replace("\0", "")], delimiter=delimiter))]


def number_in(cell: str) -> float:
    """What a cell says: a number with a decimal point or comma, or an expression for one.

    Raises:
        ExpressionError: it says none.
    """
    return float(cell.replace(",", ".")) if _NUMBER.fullmatch(cell) else evaluate(cell)


def is_number(cell: str) -> bool:
    """Whether a cell is a number or an expression for one."""
    try:
        number_in(cell)
    except ExpressionError:
        return False
    return True


def plain_name(name: str) -> str:
    """A column's name without its unit."""
    return _UNIT.sub("", name.lower()).strip()


def unit_of(name: str) -> ColumnUnit:
    """The unit that a column's name ends in, or nothing: "q1 [deg]", "x_mm"."""
    found = _UNIT.search(name.lower())
    word = "" if found is None else next(group for group in found.groups() if group)
    word = _SPELLINGS.get(word, word)
    return next((unit for unit in _FACTORS if unit == word), "")


def column_for(table: RawTable, spellings: Sequence[str]) -> int | None:
    """The column whose name, without its unit, is one of these; the earlier spelling counts."""
    names = [plain_name(name) for name in table.names]
    return next((names.index(each.lower()) for each in spellings if each.lower() in names), None)


def table_values(table: RawTable, columns: Sequence[Column]) -> FloatArray:
    """(rows, columns) the numbers in SI.

    Raises:
        PathFileError: a cell is no number, with its row, its column and what stands there.
    """
    factors = np.array([_FACTORS[column.unit] for column in columns])
    values = [[_value(table.path, row, column) for column in columns] for row in table.rows]
    return np.asarray(np.array(values) * factors)


def _value(path: Path, row: RawRow, column: Column) -> float:
    where = tr("row {row}, column {column} ({name})", row=row.number, column=column.index + 1, name=column.name)
    if column.index >= len(row.cells):
        raise PathFileError(path, where, tr("nothing"), tr("a number"))
    cell = row.cells[column.index]
    try:
        value = number_in(cell)
    except ExpressionError:
        found = f"“{cell[:30]}”" if cell else tr("an empty cell")
        raise PathFileError(path, where, found, tr("a number")) from None
    if not math.isfinite(value):
        raise PathFileError(path, where, f"“{cell[:30]}”", tr("a number of usual size"))
    return value
