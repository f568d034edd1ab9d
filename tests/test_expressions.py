"""Typed numbers with a unit behind: of the same kind they are converted, of another kind refused."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim.errors import ExpressionError
from rvsim.expressions import evaluate, evaluate_formula, evaluate_in


@pytest.mark.parametrize(
    ("unit", "text", "value"),
    [
        ("deg", "pi/4 rad", 45.0),
        ("°", "0.5 rad", math.degrees(0.5)),
        ("°", "45deg", 45.0),
        ("rad", "45°", math.pi / 4),
        ("rad", "-2*30 deg", -math.pi / 3),
        ("mm", "12 cm", 120.0),
        ("mm", "0,3 m", 300.0),
        ("mm", "\u0661\u066c\u0662\u0663\u0664\u066b\u0665", 1234.5),
        ("m", "300 mm", 0.3),
        ("m", "sqrt(4)m", 2.0),
        ("unit", "2.5 units", 2.5),
        ("deg", "degrees(pi/4)", 45.0),
    ],
)
def test_a_unit_behind_a_number_counts(unit: str, text: str, value: float) -> None:
    assert evaluate_in(unit, text) == pytest.approx(value, abs=1e-12)


@given(st.floats(-1e6, 1e6), st.sampled_from(["°", "rad", "mm", "m", "unit"]))
def test_a_plain_number_is_in_the_shown_unit_and_stays_as_it_is(number: float, unit: str) -> None:
    assert (
        evaluate_in(unit, repr(number)) == evaluate_in(unit, f"{number!r} {unit}") == evaluate(repr(number)) == number
    )


@pytest.mark.parametrize(
    ("unit", "text", "words"),
    [
        ("deg", "3 mm", "“mm” makes it a length, and wanted is an angle"),
        ("mm", "3 rad", "“rad” makes it an angle, and wanted is a length"),
        ("unit", "300 mm", "wanted is a length without a unit"),
        ("", "3 mm", "wanted is a plain number"),
        ("deg", "deg", "it is empty"),
        ("deg", "five rad", "“five rad” is no number: it cannot be read"),
    ],
)
def test_another_kind_of_unit_is_refused(unit: str, text: str, words: str) -> None:
    with pytest.raises(ExpressionError) as problem:
        evaluate_in(unit, text)
    assert words in str(problem.value)


@pytest.mark.parametrize("text", ["9**3999999", "2^99999", "exp(9999)"])
def test_what_is_too_large_is_refused_at_once(text: str) -> None:
    with pytest.raises(ExpressionError, match=r"too large|not finite"):
        evaluate(text)


@pytest.mark.parametrize("text", ["x = 5", "1; 2", "1\n2"])
def test_only_one_expression_is_taken(text: str) -> None:
    for read in (evaluate, lambda formula: evaluate_formula(formula, np.zeros(1))):
        with pytest.raises(ExpressionError, match="cannot be read"):
            read(text)
