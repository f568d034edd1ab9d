"""A formula on a tape gives what it gives on plain floats, for one pose and for many, with no step too many."""

from __future__ import annotations

import math
import operator

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim.kinematics.tape import Tape, snapped

DOF = 3
constants = st.sampled_from([0.0, 1.0, -1.0, 0.5, -2.0, 0.3])
angles = st.tuples(
    st.lists(st.integers(0, DOF - 1), max_size=DOF, unique=True), st.sampled_from([0.0, math.pi / 2, -math.pi, 0.7])
)
leaves = st.one_of(
    constants, st.integers(0, DOF - 1).map(lambda i: ("q", i)), st.tuples(st.sampled_from(["cos", "sin"]), angles)
)
trees = st.recursive(leaves, lambda inner: st.tuples(st.sampled_from(["+", "-", "*"]), inner, inner), max_leaves=12)
OPERATIONS = {"+": operator.add, "-": operator.sub, "*": operator.mul}


def on_tape(tree, tape):
    match tree:
        case float():
            return tree
        case ("q", joint):
            return tape.joint(joint)
        case ("cos" | "sin" as function, (joints, constant)):
            return tape.cos_sin(joints, constant)[function == "sin"]
        case (operation, left, right):
            return OPERATIONS[operation](on_tape(left, tape), on_tape(right, tape))


def on_floats(tree, q):
    match tree:
        case float():
            return tree
        case ("q", joint):
            return q[joint]
        case ("cos" | "sin" as function, (joints, constant)):
            return getattr(math, function)(sum(q[joint] for joint in joints) + constant)
        case (operation, left, right):
            return OPERATIONS[operation](on_floats(left, q), on_floats(right, q))


@given(st.lists(trees, min_size=1, max_size=4))
def test_a_formula_on_a_tape_gives_what_it_gives_on_floats(formulas):
    tape = Tape(DOF)
    player = tape.player([on_tape(formula, tape) for formula in formulas], (len(formulas),))
    q = np.random.default_rng(0).uniform(-2.0, 2.0, (30, DOF))
    expected = np.array([[on_floats(formula, pose) for formula in formulas] for pose in q.tolist()])
    scale = 1.0 + np.abs(expected).max()
    np.testing.assert_allclose(player.play(q), expected, atol=1e-13 * scale)
    np.testing.assert_allclose(player.play(q[0]), expected[0], atol=1e-13 * scale)


def test_what_is_constant_takes_no_step():
    tape = Tape(1)
    q, (cosine, sine) = tape.joint(0), tape.cos_sin([], math.pi / 2)
    outputs = [cosine * q, sine * q, -(sine * q) + 0.0, q - q, 0.0 - q * 1.0]
    assert tape.program(outputs).steps == ()
    np.testing.assert_array_equal(tape.player(outputs, (5,)).play([0.25]), [0.0, 0.25, -0.25, 0.0, -0.25])


def test_equal_steps_are_taken_once_and_unneeded_ones_not_at_all():
    tape = Tape(2)
    a, b = tape.joint(0), tape.joint(1)
    tape.cos_sin([0, 1], 0.1)[0] * b
    program = tape.program([a * b + b, b + b * a, a * (-b)])
    assert len(program.steps) == 2
    assert program.angles == ()


@pytest.mark.parametrize(("value", "expected"), [(6e-17, 0.0), (1.0 - 1e-16, 1.0), (-1.0, -1.0), (1e-14, 1e-14)])
def test_only_rounding_is_snapped(value, expected):
    assert snapped(value) == expected
