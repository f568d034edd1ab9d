"""What a singular arm cannot do, as motions one can point at: along a line, or about an axis.

A twist that no joint speed makes is a direction square to all columns of J. As a wrench w = (f, m) at the tool it asks
no joint torque at all, Jᵀ w = 0: the arm bears it as a wall does. A pure force along a line says that no point of that
line can move along it; a pure moment, that the tool cannot turn about that direction. Where w is neither, or its
line is far from the tip, two motions are told that are each lost on their own, though not together.
Sources: Davidson and Hunt, Robots and screw theory (2004), chapter 6; Lynch and Park, Modern Robotics (2017), §5.3.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from rvsim.kinematics.singularity import Measures
from rvsim.spatial.arrays import FloatArray

_ZERO = 1e-6  # of a unit direction, lengths in arm sizes
_NEAR = 0.15  # of the arm's size: a line so near the tip can be pointed at


@dataclass(frozen=True, eq=False)
class LostMotion:
    """One motion that is missing.

    Args:
        kind: "move" along a line, or "turn" about a direction.
        direction: (3,) a unit vector in base axes, its largest entry positive.
        offset: (3,) from the tool origin to the nearest point of the line [m]; zeros for a turn, which has no line.
        alone: whether it is lost only on its own: a move without any turning, a turn with the tip at rest.
    """

    kind: Literal["move", "turn"]
    direction: FloatArray
    offset: FloatArray
    alone: bool = False


def lost_motions(measures: Measures, length: float) -> tuple[LostMotion, ...]:
    """What is lost at a singular pose, () at any other; `length` [m] weighs moments against forces.

    For an arm with fewer than six joints a lost motion is known only up to motions it can never do; then the purest
    of them is told, and never-possible ones that are pure as well come along with it.
    """
    if measures.lost is None:
        return ()
    if measures.lost.size < 6:
        unit = np.zeros(3)
        unit[: measures.lost.size] = measures.lost[:3]
        return (LostMotion("move", _upright(unit), np.zeros(3)),)
    basis = np.column_stack([measures.lost, measures.never])
    scaled = np.linalg.qr(basis * np.repeat([1.0, 1.0 / length], 3)[:, None])[0]
    pure = (*_pure(scaled, 0), *_pure(scaled, 1))
    return pure or _told(_purest(measures.lost, measures.never), length)


def _pure(basis: FloatArray, half: int) -> tuple[LostMotion, ...]:
    """The forces (half 0) without moment, or moments (half 1) without force, in the space of basis (6, k)."""
    own, other = basis[3 * half : 3 * half + 3], basis[3 - 3 * half : 6 - 3 * half]
    _, sigma, Vt = np.linalg.svd(other)
    idle = np.ones(basis.shape[1], bool)
    idle[: sigma.size] = sigma[: basis.shape[1]] <= _ZERO
    kind: Literal["move", "turn"] = "turn" if half else "move"
    return tuple(LostMotion(kind, _upright(own @ row), np.zeros(3)) for row in Vt[idle])


def _purest(lost: FloatArray, never: FloatArray) -> FloatArray:
    """Of lost + t · never: a force along a line if there is one, that with the smallest t; else lost itself."""
    if never.shape[1] != 1:
        return lost
    other = never[:, 0]
    cross = float(lost[:3] @ other[3:] + other[:3] @ lost[3:])
    roots = np.roots([float(other[:3] @ other[3:]), cross, float(lost[:3] @ lost[3:])])
    real = roots[np.abs(roots.imag) < 1e-9].real
    return np.asarray(lost + real[np.argmin(np.abs(real))] * other) if real.size else lost


def _told(wrench: FloatArray, length: float) -> tuple[LostMotion, ...]:
    """A force along a line near the tip as one motion; any other wrench as its force and its moment at the tip."""
    f, m = wrench[:3], wrench[3:]
    square = float(f @ f)
    offset = np.cross(f, m) / square
    if abs(float(f @ m)) < _ZERO * square * length and np.linalg.norm(offset) < _NEAR * length:
        return (LostMotion("move", _upright(f), offset),)
    here = np.zeros(3)
    return LostMotion("move", _upright(f), here, alone=True), LostMotion("turn", _upright(m), here, alone=True)


def _upright(vector: FloatArray) -> FloatArray:
    unit = vector / np.linalg.norm(vector)
    return np.asarray(unit * math.copysign(1.0, unit[np.argmax(np.abs(unit))]))
