"""Points from a table: a CSV file with x, y, z in millimetres, with or without a header, as spreadsheets write it.

`named_path` takes the same numbers as units for an arm whose lengths have no other.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from pathlib import Path as FilePath
from typing import NamedTuple

from rvsim.errors import ExpressionError, PathFileError
from rvsim.expressions import evaluate
from rvsim.motion import Path, through_points
from rvsim.units import metres_from_millimetres

_COLUMNS = ("x", "y", "z")
_LARGEST_BYTES = 20_000_000
_DELIMITERS = ";\t,"
_COLUMN_UNIT = re.compile(r"(\[(mm|units?)\]|\((mm|units?)\)|_(mm|unit))$")


class _Row(NamedTuple):
    number: int
    cells: list[str]


def read_path(file: FilePath | str) -> Path:
    """The path through the points of a CSV file, orientation free.

    Columns x, y, z in millimetres: by their names if there is a header ("x", "y_mm", "z [mm]", any order, others are
    ignored), else the first three. Separated by commas, semicolons or tabs; with the latter two a decimal comma is
    understood. Empty lines and lines that begin with # are skipped.

    Raises:
        PathFileError: with row and column, what was found and what is expected.
        OSError: the file cannot be read.
    """
    path = FilePath(file)
    if path.stat().st_size > _LARGEST_BYTES:
        raise PathFileError(path, "the file", f"{path.stat().st_size} bytes", f"at most {_LARGEST_BYTES}")
    try:
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError:
        raise PathFileError(path, "the file", "bytes that are no text", "a CSV file in UTF-8") from None
    return through_points(metres_from_millimetres(points_mm_of(path, text)), name=path.name)


def points_mm_of(path: FilePath, text: str) -> list[tuple[float, ...]]:
    """The points x, y, z in millimetres that the text of a CSV file means; `path` is for messages.

    Raises:
        PathFileError: it means none.
    """
    rows = _rows(path, text)
    columns = _header(path, rows[0])
    if columns is not None:
        rows = rows[1:]
    if not rows:
        raise PathFileError(path, "the file", "a header only", "at least one row of x, y, z in millimetres")
    return [_point(path, row, columns or (0, 1, 2)) for row in rows]


def _rows(path: FilePath, text: str) -> list[_Row]:
    lines = [(number, line) for number, line in enumerate(text.splitlines(), start=1) if _counts(line)]
    if not lines:
        raise PathFileError(path, "the file", "nothing", "rows of x, y, z in millimetres")
    delimiter = next((mark for mark in _DELIMITERS if mark in lines[0][1]), ",")
    return [_Row(number, _cells(line, delimiter)) for number, line in lines]


def _counts(line: str) -> bool:
    return bool(line.strip()) and not line.lstrip().startswith("#")


def _cells(line: str, delimiter: str) -> list[str]:
    return [cell.strip() for cell in next(csv.reader([line.replace("\0", "")], delimiter=delimiter))]


def _header(path: FilePath, row: _Row) -> tuple[int, ...] | None:
    """The columns of x, y and z if the row names columns; None if it holds numbers."""
    if any(_is_number(cell) for cell in row.cells):
        return None
    names = [_plain(cell) for cell in row.cells]
    missing = [name for name in _COLUMNS if name not in names]
    if missing:
        found = f"a header without {' and '.join(missing)} ({', '.join(row.cells)[:60]})"
        raise PathFileError(path, f"row {row.number}", found, "columns x, y, z in millimetres")
    return tuple(names.index(name) for name in _COLUMNS)


def _plain(cell: str) -> str:
    """A column's name without its unit."""
    return _COLUMN_UNIT.sub("", cell.lower()).strip()


def _is_number(cell: str) -> bool:
    try:
        evaluate(cell)
    except ExpressionError:
        return False
    return True


def _point(path: FilePath, row: _Row, columns: Sequence[int]) -> tuple[float, ...]:
    return tuple(_value(path, row, column, name) for column, name in zip(columns, _COLUMNS, strict=True))


def _value(path: FilePath, row: _Row, column: int, name: str) -> float:
    where = f"row {row.number}, column {column + 1} ({name})"
    if column >= len(row.cells):
        raise PathFileError(path, where, "nothing", "a number in millimetres")
    try:
        return evaluate(row.cells[column])
    except ExpressionError:
        found = f"“{row.cells[column][:30]}”" if row.cells[column] else "an empty cell"
        raise PathFileError(path, where, found, "a number in millimetres") from None
