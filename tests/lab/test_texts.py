"""What is copied reads back as the same numbers."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from rvsim.errors import ShapeError
from rvsim.lab.texts import (
    NamedValue,
    matrix_latex,
    matrix_numpy,
    matrix_text,
    number_latex,
    number_text,
    pose_text,
    table_tsv,
    values_latex,
    values_numpy,
    values_text,
)

MATRICES = arrays(np.float64, array_shapes(min_dims=1, max_dims=2, max_side=6))
FINITE = arrays(
    np.float64,
    array_shapes(min_dims=2, max_dims=2, max_side=6),
    elements=st.floats(allow_nan=False, allow_infinity=False),
)


def evaluated(text: str) -> np.ndarray:
    return eval(text, {"np": np})


@given(MATRICES)
def test_the_numpy_text_evaluates_to_the_same_array(matrix):
    np.testing.assert_array_equal(evaluated(matrix_numpy(matrix)), matrix)


@given(MATRICES)
def test_every_copy_is_ascii_and_holds_no_negative_zero(matrix):
    for text in (matrix_text(matrix), matrix_numpy(matrix), matrix_latex(matrix)):
        assert text.isascii()
    read_back = evaluated(matrix_numpy(matrix))
    assert not np.signbit(read_back[read_back == 0.0]).any()


@given(FINITE)
def test_the_plain_text_has_columns_of_one_width_and_full_precision(matrix):
    lines = matrix_text(matrix).split("\n")
    assert len({len(line) for line in lines}) == 1
    np.testing.assert_array_equal([[float(cell) for cell in line.split()] for line in lines], matrix)


@given(FINITE)
def test_the_latex_has_one_cell_for_each_entry(matrix):
    body = matrix_latex(matrix).removeprefix("\\begin{bmatrix}\n").removesuffix("\n\\end{bmatrix}")
    cells = [row.split("&") for row in body.split("\\\\")]
    plain = [[float(cell.replace(" \\times 10^{", "e").replace("}", "")) for cell in row] for row in cells]
    np.testing.assert_array_equal(plain, matrix)


@pytest.mark.parametrize(
    ("value", "plain", "latex"),
    [
        (-0.0, "0.0", "0.0"),
        (0.1, "0.1", "0.1"),
        (6.123233995736766e-17, "6.123233995736766e-17", "6.123233995736766 \\times 10^{-17}"),
        (1e22, "1e+22", "1 \\times 10^{22}"),
        (-np.inf, "-inf", "-\\infty"),
        (np.nan, "nan", "\\mathrm{nan}"),
    ],
)
def test_a_number_is_neither_rounded_nor_given_a_sign_it_has_not(value, plain, latex):
    assert number_text(value) == plain
    assert number_latex(value) == latex


def test_a_vector_stays_a_vector_in_numpy_and_is_a_column_in_latex():
    assert matrix_numpy([1, 2]) == "np.array([1.0, 2.0])"
    assert matrix_latex([1, 2]) == "\\begin{bmatrix}\n  1.0 \\\\\n  2.0\n\\end{bmatrix}"


def test_more_than_two_axes_are_refused():
    with pytest.raises(ShapeError, match=r"\(m, n\)"):
        matrix_numpy(np.zeros((2, 2, 2)))


def test_named_values_carry_their_units_in_every_form():
    values = [NamedValue("x", 363.5, "mm"), NamedValue("roll", -90.0, "deg"), NamedValue("w", 0.5)]
    assert values_text(values) == "x    = 363.5 mm\nroll = -90.0 deg\nw    = 0.5"
    assert values_numpy(values) == "# x [mm], roll [deg], w\nnp.array([363.5, -90.0, 0.5])"
    assert "x &= 363.5\\,\\mathrm{mm}" in values_latex(values)
    assert "\\mathrm{roll} &= -90.0^{\\circ}" in values_latex(values)


def test_a_table_is_tab_separated_and_keeps_words_and_numbers():
    assert table_tsv(("point", "x"), [("base", -0.0), ("wrist", 0.1)]) == "point\tx\nbase\t0.0\nwrist\t0.1"


def test_a_pose_names_its_columns():
    T = np.eye(4)
    T[:3, 3] = 0.1, -0.2, 0.3
    assert pose_text(T).split("\n")[0] == "n = (1.0, 0.0, 0.0)"
    assert pose_text(T).split("\n")[3] == "p = (0.1, -0.2, 0.3)"
    with pytest.raises(ShapeError):
        pose_text(np.eye(3))
