"""Points from a CSV file: as spreadsheets write them, and one clear error for everything else."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim import load_robot
from rvsim.errors import PathFileError
from rvsim.lab import named_path, read_path
from rvsim.lab.path_file import points_mm_of

WANTED = np.array([[0.3, -0.1, 0.2], [0.31, 0.0, 0.2055]])


@pytest.mark.parametrize(
    "text",
    [
        "300,-100,200\n310,0,205.5\n",
        "x,y,z\n300,-100,200\n310,0,205.5",
        "x_mm, y_mm, z_mm\r\n300, -100, 200\r\n310, 0, 205.5\r\n",
        "\ufeffz [mm];t;x [mm];y [mm]\n200;0;300;-100\n205,5;1;310;0\n",
        "# drawn by hand\n\n300\t-100\t200\n310\t0\t205,5\n",
        "300,-100,200,7\n310,0,411/2,8\n",
    ],
)
def test_headers_separators_decimal_commas_and_expressions(tmp_path: Path, text: str) -> None:
    file = tmp_path / "points.csv"
    file.write_bytes(text.encode())
    assert np.allclose(read_path(file).points, WANTED)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("300,0,200\n310,left,200\n", "row 2, column 2 (y): found “left”, expected a number in millimetres"),
        ("300,0,200\n\n310,0\n", "row 3, column 3 (z): found nothing, expected a number in millimetres"),
        ("300,,200\n", "row 1, column 2 (y): found an empty cell"),
        ("a,b,c\n1,2,3\n", "row 1: found a header without x, y and z (a, b, c)"),
        ("x,y,z\n", "found a header only"),
        ("", "found nothing"),
        ("300,inf,200\n", "row 1, column 2 (y): found “inf”"),
    ],
)
def test_what_is_wrong_is_said_with_row_and_column(tmp_path: Path, text: str, message: str) -> None:
    file = tmp_path / "points.csv"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(PathFileError) as problem:
        read_path(file)
    assert message in str(problem.value)
    assert str(file) in str(problem.value)


def test_bytes_that_are_no_text(tmp_path: Path) -> None:
    file = tmp_path / "points.csv"
    file.write_bytes(b"\xff\xfe\x00\x01")
    with pytest.raises(PathFileError, match="bytes that are no text"):
        read_path(file)


@given(st.text(max_size=60))
def test_any_text_is_points_or_a_path_file_error(text: str) -> None:
    try:
        points = points_mm_of(Path("any.csv"), text)
    except PathFileError:
        return
    assert np.isfinite(points).all()
    assert np.shape(points)[1] == 3


def test_a_file_is_a_path_by_its_name_with_a_free_orientation(tmp_path: Path) -> None:
    file = tmp_path / "My Points.CSV"
    file.write_text("300,0,200\n310,0,200\n", encoding="utf-8")
    path = named_path(str(file), load_robot("rv-m1"))
    assert path.rotations is None
    assert path.title == "My Points.CSV"
    assert named_path(str(file), load_robot("rv-m1"), orientation="down").rotations is not None
