"""Tables of numbers: separators, headers and units are understood, and a spoilt cell is named by row and column."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim.errors import PathFileError
from rvsim.lab.table_file import Column, column_for, raw_table, table_values, unit_of

FILE = Path("t.csv")


@given(
    st.lists(st.tuples(*[st.floats(-1e6, 1e6)] * 3), min_size=1, max_size=20),
    st.sampled_from([",", ";", "\t", " "]),
    st.booleans(),
)
def test_numbers_read_back_whatever_separates_them(rows: list[tuple[float, ...]], delimiter: str, header: bool) -> None:
    comma = delimiter == ";"
    lines = [delimiter.join(repr(value).replace(".", "," if comma else ".") for value in row) for row in rows]
    text = "\n".join([delimiter.join(("q1", "q2", "q3")), *lines] if header else lines)
    table = raw_table(FILE, text)
    assert (table.delimiter, table.has_header) == (delimiter, header)
    columns = [Column(index, table.names[index]) for index in (2, 0)]
    np.testing.assert_allclose(table_values(table, columns), np.array(rows)[:, [2, 0]], rtol=1e-12)


def test_units_stand_behind_the_names_and_count() -> None:
    table = raw_table(FILE, "t [s],q1 [deg],x_mm,q2 (rad)\n1,180,500,2\n")
    assert [unit_of(name) for name in table.names] == ["s", "deg", "mm", "rad"]
    assert column_for(table, ("waist", "q2")) == 3
    assert column_for(table, ("q9",)) is None
    columns = [Column(index, name, unit_of(name)) for index, name in enumerate(table.names)]
    np.testing.assert_allclose(table_values(table, columns), [[1.0, np.pi, 0.5, 2.0]])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("1,2\n3,left\n", "row 2, column 2 (b): found “left”, expected a number"),
        ("# note\n\n1,2\n3\n", "row 4, column 2 (b): found nothing"),
        ("1,2\n3,\n", "row 2, column 2 (b): found an empty cell"),
    ],
)
def test_a_spoilt_cell_is_named(text: str, message: str) -> None:
    with pytest.raises(PathFileError) as refused:
        table_values(raw_table(FILE, text), [Column(0, "a"), Column(1, "b")])
    assert message in str(refused.value)


def test_a_file_without_rows_is_refused() -> None:
    for text in ("", "# only a note\n", "q1,q2\n"):
        with pytest.raises(PathFileError):
            raw_table(FILE, text)
