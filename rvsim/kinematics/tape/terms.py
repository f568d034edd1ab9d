"""Arithmetic that is recorded once for an arm and then played for one pose or for a hundred thousand.

A formula written with `Number`s runs on plain floats and on `Term`s alike: a float is a constant, a `Term` a value that
depends on q. Recording drops what is constant (0 · x, 1 · x, x + 0) and keeps equal steps once, so the zeros and the
right angles of a DH table cost nothing; `Tape.program` keeps the steps that the wanted outputs need.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from rvsim.kinematics.tape.player import Player
from rvsim.kinematics.tape.program import Angle, Output, Program, Step

# Cosines of right angles come out of floating point as 6e-17: 0 is meant.
_ROUNDING = 1e-15


def snapped(value: float) -> float:
    """`value`, or the whole number that it misses by rounding only."""
    nearest = float(round(value)) if math.isfinite(value) else value
    return nearest if abs(value - nearest) <= _ROUNDING else value


class Term:
    """A value on a tape, or its negative: a change of sign costs no step."""

    __slots__ = ("name", "negative", "tape")

    def __init__(self, tape: Tape, name: str, negative: bool = False) -> None:
        self.tape, self.name, self.negative = tape, name, negative

    def __neg__(self) -> Term:
        return Term(self.tape, self.name, not self.negative)

    def __add__(self, other: Number) -> Number:
        return self if other == 0.0 else self.tape.sum(self, self.tape.term(other))

    def __mul__(self, other: Number) -> Number:
        if isinstance(other, Term):
            return self.tape.product(self, other)
        if abs(other) == 1.0:
            return self if other > 0.0 else -self
        return self.tape.product(self, self.tape.term(other)) if other != 0.0 else 0.0

    def __sub__(self, other: Number) -> Number:
        return self + (-other)

    def __rsub__(self, other: float) -> Number:
        return -self + other

    __radd__ = __add__
    __rmul__ = __mul__


Number = float | Term


class Tape:
    """The record of all steps so far. Names are Python expressions: q0, c1, s1, v7, 0.425."""

    def __init__(self, dof: int) -> None:
        self._dof = dof
        self._angles: dict[tuple[tuple[int, ...], float], Angle] = {}
        self._steps: dict[tuple[str, str, str], str] = {}

    def joint(self, index: int) -> Term:
        """The joint variable itself."""
        return Term(self, f"q{index}")

    def term(self, value: Number) -> Term:
        """A constant as a term, its sign apart so that steps with 0.4 and −0.4 are the same."""
        if isinstance(value, Term):
            return value
        number = float(value)  # numpy's own floats are written in another way
        return Term(self, repr(abs(number)), number < 0.0)

    def cos_sin(self, joints: Sequence[int], constant: float) -> tuple[Number, Number]:
        """Cosine and sine of the sum of some joint variables and a constant [rad]; quarter turns are exact."""
        constant = float(constant)
        quarters = round(constant / (0.5 * math.pi))
        rest = constant - quarters * (0.5 * math.pi)
        cosine, sine = self._plain_cos_sin(tuple(joints), 0.0 if abs(rest) <= _ROUNDING else rest)
        for _ in range(quarters % 4):
            cosine, sine = -sine, cosine
        return cosine, sine

    def _plain_cos_sin(self, joints: tuple[int, ...], constant: float) -> tuple[Number, Number]:
        if not joints:
            return snapped(math.cos(constant)), snapped(math.sin(constant))
        angle = self._angles.setdefault((joints, constant), Angle(len(self._angles), joints, constant))
        return Term(self, f"c{angle.number}"), Term(self, f"s{angle.number}")

    def sum(self, left: Term, right: Term) -> Number:
        """left + right, as one step."""
        if left.negative == right.negative:
            first, second = sorted((left.name, right.name))
            return self._step("+", first, second, left.negative)
        plus, minus = (right, left) if left.negative else (left, right)
        return 0.0 if plus.name == minus.name else self._step("-", plus.name, minus.name, False)

    def product(self, left: Term, right: Term) -> Term:
        """left · right, as one step."""
        first, second = sorted((left.name, right.name))
        return self._step("*", first, second, left.negative != right.negative)

    def _step(self, operation: str, left: str, right: str, negative: bool) -> Term:
        name = self._steps.setdefault((operation, left, right), f"v{len(self._steps)}")
        return Term(self, name, negative)

    def player(self, outputs: Sequence[Number], shape: tuple[int, ...]) -> Player:
        """Plays these outputs in that shape."""
        return Player(self.program(outputs), shape)

    def program(self, outputs: Sequence[Number]) -> Program:
        """The frozen program of these outputs; angles and steps that none of them needs are left out."""
        terms = [self.term(output) for output in outputs]
        needed = {term.name for term in terms}
        steps: list[Step] = []
        for (operation, left, right), name in reversed(self._steps.items()):
            if name in needed:
                needed |= {left, right}
                steps.append(Step(name, operation, left, right))
        angles = (a for a in self._angles.values() if not needed.isdisjoint((f"c{a.number}", f"s{a.number}")))
        written = (Output(term.name, term.negative) for term in terms)
        return Program(self._dof, tuple(angles), tuple(reversed(steps)), tuple(written))
