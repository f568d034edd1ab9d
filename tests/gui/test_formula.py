"""A formula whose digits were put into a known shape is the formula itself; one that cannot be set is text."""

import numpy as np
import pytest
from PySide6.QtCore import QRectF

from rvsim.files import load_robot
from rvsim.gui import formula
from rvsim.gui.formula import is_set, plain_text, typeset
from rvsim.kinematics import forward_kinematics
from rvsim.lab.worked import worked_solution


def formulas(name):
    robot = load_robot(name)
    for step in worked_solution(robot, forward_kinematics(robot, robot.home + 0.1)).steps:
        for equation in step.equations:
            yield from (f"= {text}" for text in (equation.formula, equation.substituted, equation.result) if text)


def drawn(path):
    """The outlines' points (k, 2)."""
    return [(path.elementAt(i).x, path.elementAt(i).y) for i in range(path.elementCount())]


@pytest.mark.parametrize(
    "latex",
    [
        "= \\frac{349.1^2+(-132.9)^2}{2\\cdot 250.0}",
        "= \\operatorname{atan2}(-145.4,\\,352.8)-(-20.17^\\circ)",
        "= \\sqrt{1-(-0.5731)^2}",
        "= 1_2^3+12.34",
    ],
)
def test_a_filled_shape_looks_like_the_formula_set_by_itself(qapp, latex):
    filled = typeset(latex)
    direct = formula._parsed(formula._svg(latex), formula.deque(formula._digits_and_signs(latex)))
    assert filled is not None
    alone = formula.QPainterPath()
    for outline, at, _ in direct.glyphs:
        alone.addPath(at.map(outline))
    for rule in direct.rules:
        alone.addRect(rule)
    # An exponent stands a little closer to a narrow digit.
    np.testing.assert_allclose(drawn(filled.path), drawn(alone), atol=1.0)


def test_a_minus_closes_up_to_its_number_over_an_empty_place(qapp):
    wide = "\\begin{bmatrix} {-}\\phantom{0}97.4 \\\\ {-}297.4 \\end{bmatrix}"
    near, far = typeset(wide), typeset(wide.replace("\\phantom{0}", "1"))
    assert near.width == far.width
    assert near.path.elementCount() < far.path.elementCount()


@pytest.mark.parametrize("name", ["rv-m1", "ur5e", "rv-1a"])
def test_every_formula_of_the_worked_solutions_can_be_set(qapp, name):
    for latex in set(formulas(name)):
        made = typeset(latex)
        assert made is not None, latex
        bounds = made.path.boundingRect()
        assert QRectF(-2, -made.ascent - 2, made.width + 4, made.ascent + made.descent + 4).contains(bounds), latex


def test_other_digits_are_no_new_work(qapp):
    assert typeset("= 12.3+\\cos 45.67^\\circ")
    assert is_set("= 98.7+\\cos 12.34^\\circ")
    assert not is_set("= 987.6+\\cos 12.34^\\circ")


@pytest.mark.parametrize("broken", ["\\frac{1", "\\nosuchcommand{}{", "\\begin{bmatrix} 1", ""])
def test_a_broken_formula_is_no_exception(qapp, broken):
    typeset(broken)
    assert isinstance(plain_text(broken), str)


def test_plain_text_can_be_read_aloud():
    latex = "C = \\cos q_3 = \\frac{u^2+w^2}{2\\,a_2\\,a_3}"
    assert plain_text("\\sigma_1 \\geq \\sigma_2 \\geq \\ldots") == "σ₁ ≥ σ₂ ≥ …"
    assert plain_text("\\ddot{q} = J^{+} \\dot{\\zeta}, \\; \\dot{q}_{max}") == "q\u0308 = J^+ ζ\u0307, q\u0307max"
    assert plain_text(latex) == "C = cos q₃ = (u²+w²)/(2 a₂ a₃)"
    assert (
        plain_text("\\operatorname{atan2}(-0.5,\\,\\sqrt{1-C^2}) = -30.00^\\circ") == "atan2(−0.5, √(1−C²)) = −30.00°"
    )


@pytest.mark.parametrize("rows", [2, 5, 6])
def test_a_bracket_reaches_from_the_first_row_to_the_last(qapp, rows):
    column = " \\\\ ".join(["1"] * rows)
    bare, bracketed = (typeset(f"\\begin{{{kind}}} {column} \\end{{{kind}}}") for kind in ("matrix", "bmatrix"))
    points = [bracketed.path.elementAt(i) for i in range(bracketed.path.elementCount())]
    heights = [point.y for point in points if point.x < 5.0]  # the left bracket stands there alone
    assert max(heights) - min(heights) >= bare.path.boundingRect().height() - 0.1


def test_logical_signs_are_read_in_any_language() -> None:
    assert plain_text(r"a = 0 \;\wedge\; b = 0 \;\vee\; c = 0") == "a = 0 ∧ b = 0 ∨ c = 0"
