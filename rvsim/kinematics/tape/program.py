"""A straight line of additions, subtractions and multiplications: what a tape freezes and the players play.

Names: q0 … the joint variables, c0, s0 … cosine and sine of each angle, v0 … the results of the steps; every other name
is a number.
"""

from __future__ import annotations

from typing import NamedTuple


class Angle(NamedTuple):
    """The sum of some joint variables (one or more) and a constant [rad]; its number names its cosine and sine."""

    number: int
    joints: tuple[int, ...]
    constant: float


class Step(NamedTuple):
    """name = left operation right."""

    name: str
    operation: str
    left: str
    right: str


class Output(NamedTuple):
    """A value that is wanted: a name, or its negative."""

    name: str
    negative: bool


class Program(NamedTuple):
    """Steps that turn q (n) into the outputs (k), in the order in which they are to be done."""

    dof: int
    angles: tuple[Angle, ...]
    steps: tuple[Step, ...]
    outputs: tuple[Output, ...]


def is_constant(name: str) -> bool:
    """Whether a name is a number (inf and nan are numbers too: lengths near the largest float overflow)."""
    return name[0] not in "qcsv"
