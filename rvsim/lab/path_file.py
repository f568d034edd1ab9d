"""Points from a table: a CSV file with x, y, z in millimetres, with or without a header, as spreadsheets write it.

`named_path` takes the same numbers as units for an arm whose lengths have no other.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path as FilePath

from rvsim.errors import ExpressionError, PathFileError
from rvsim.expressions import evaluate
from rvsim.lab.table_file import RawRow, cells_of, counts, is_number, plain_name, read_text
from rvsim.language import listed, tr
from rvsim.motion import Path, through_points
from rvsim.units import metres_from_millimetres

_COLUMNS = ("x", "y", "z")
_DELIMITERS = ";\t,"


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
    text = read_text(path)
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
        raise PathFileError(path, tr("the file"), tr("a header only"), tr("at least one row of x, y, z in millimetres"))
    return [_point(path, row, columns or (0, 1, 2)) for row in rows]


def _rows(path: FilePath, text: str) -> list[RawRow]:
    lines = [(number, line) for number, line in enumerate(text.splitlines(), start=1) if counts(line)]
    if not lines:
        raise PathFileError(path, tr("the file"), tr("nothing"), tr("rows of x, y, z in millimetres"))
    delimiter = next((mark for mark in _DELIMITERS if mark in lines[0][1]), ",")
    return [RawRow(number, cells_of(line, delimiter)) for number, line in lines]


def _header(path: FilePath, row: RawRow) -> tuple[int, ...] | None:
    """The columns of x, y and z if the row names columns; None if it holds numbers."""
    if any(is_number(cell) for cell in row.cells):
        return None
    names = [plain_name(cell) for cell in row.cells]
    missing = [name for name in _COLUMNS if name not in names]
    if missing:
        found = tr("a header without {missing} ({cells})", missing=listed(missing), cells=", ".join(row.cells)[:60])
        raise PathFileError(path, tr("row {row}", row=row.number), found, tr("columns x, y, z in millimetres"))
    return tuple(names.index(name) for name in _COLUMNS)


def _point(path: FilePath, row: RawRow, columns: Sequence[int]) -> tuple[float, ...]:
    return tuple(_value(path, row, column, name) for column, name in zip(columns, _COLUMNS, strict=True))


def _value(path: FilePath, row: RawRow, column: int, name: str) -> float:
    where = tr("row {row}, column {column} ({name})", row=row.number, column=column + 1, name=name)
    if column >= len(row.cells):
        raise PathFileError(path, where, tr("nothing"), tr("a number in millimetres"))
    try:
        return evaluate(row.cells[column])
    except ExpressionError:
        found = f"“{row.cells[column][:30]}”" if row.cells[column] else tr("an empty cell")
        raise PathFileError(path, where, found, tr("a number in millimetres")) from None
