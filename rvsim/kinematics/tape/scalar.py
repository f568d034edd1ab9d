"""A program as a Python function for one pose: no array, no loop, no look-up; nothing in plain Python is faster."""

from __future__ import annotations

import math
import struct
from collections import Counter
from collections.abc import Callable, Iterator
from typing import Any

from rvsim.kinematics.tape.program import Angle, Program
from rvsim.spatial.arrays import FloatArray

Play = Callable[[list[float], FloatArray], None]
# Expressions are put into one another up to this length: the parser's depth is limited, an arm's is not.
_LONGEST = 200


def scalar_function(program: Program) -> Play:
    """The function (q, result) that fills the array `result` with the outputs for one pose, a list of n floats.

    Its source is made of the program's own names and numbers only. Raises ValueError for an infinite angle.
    """
    namespace: dict[str, Any] = {"cos": math.cos, "sin": math.sin, "inf": math.inf, "nan": math.nan}
    namespace["pack_into"] = struct.Struct(f"{len(program.outputs)}d").pack_into
    exec("\n    ".join(_source(program)), namespace)
    play: Play = namespace["play"]
    return play


def _source(program: Program) -> Iterator[str]:
    yield "def play(q, result):"
    yield "".join(f"q{i}, " for i in range(program.dof)) + "= q"
    for angle in program.angles:
        yield f"angle = {_sum(angle)}"
        yield f"c{angle.number} = cos(angle)"
        yield f"s{angle.number} = sin(angle)"
    expressions: dict[str, str] = {}
    yield from _assignments(program, expressions)
    values = ("-" * output.negative + expressions.get(output.name, output.name) for output in program.outputs)
    yield f"pack_into(result, 0, {', '.join(values)})"


def _sum(angle: Angle) -> str:
    joints = [f"q{joint}" for joint in angle.joints]
    return " + ".join([*joints, repr(angle.constant)] if angle.constant else joints)


def _assignments(program: Program, expressions: dict[str, str]) -> Iterator[str]:
    """A line for each value used more than once; the others are collected in `expressions`, to stand where used."""
    uses = Counter(name for step in program.steps for name in (step.left, step.right))
    uses.update(output.name for output in program.outputs)
    for step in program.steps:
        left, right = (expressions.get(name, name) for name in (step.left, step.right))
        expression = f"{left} {step.operation} {right}"
        if uses[step.name] == 1 and len(expression) < _LONGEST:
            expressions[step.name] = f"({expression})"
        else:
            yield f"{step.name} = {expression}"
