"""What a singular arm cannot do, as motions one can point at: along a line, or about an axis.

A twist that no joint speed makes is a direction square to all columns of J. As a wrench w = (f, m) at the tool it asks
no joint torque at all, Jᵀ w = 0: the arm bears it as a wall does. A pure force along a line says that no point of that
line can move along it; a pure moment, that the tool cannot turn about that direction.
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


@dataclass(frozen=True, eq=False)
class LostMotion:
    """One motion that is missing.

    Args:
        kind: "move": no point of the line can move along it; "turn": no turn about the direction; "screw": no motion
            along the line together with a turn about it.
        direction: (3,) a unit vector in base axes, its largest entry positive.
        offset: (3,) from the tool origin to the nearest point of the line [m]; zeros for a turn, which has no line.
        pitch: of a screw [m/rad], the way along a turn; 0 for the others.
    """

    kind: Literal["move", "turn", "screw"]
    direction: FloatArray
    offset: FloatArray
    pitch: float = 0.0


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
    return pure if pure else (_purest(measures.lost, measures.never),)


def _pure(basis: FloatArray, half: int) -> tuple[LostMotion, ...]:
    """The forces (half 0) without moment, or moments (half 1) without force, in the space of basis (6, k)."""
    own, other = basis[3 * half : 3 * half + 3], basis[3 - 3 * half : 6 - 3 * half]
    _, sigma, Vt = np.linalg.svd(other)
    idle = np.ones(basis.shape[1], bool)
    idle[: sigma.size] = sigma[: basis.shape[1]] <= _ZERO
    kind: Literal["move", "turn"] = "turn" if half else "move"
    return tuple(LostMotion(kind, _upright(own @ row), np.zeros(3)) for row in Vt[idle])


def _purest(lost: FloatArray, never: FloatArray) -> LostMotion:
    """Of lost + t · never: a force along a line if there is one, that with the smallest t."""
    wrench = lost
    if never.shape[1] == 1:
        other = never[:, 0]
        cross = float(lost[:3] @ other[3:] + other[:3] @ lost[3:])
        roots = np.roots([float(other[:3] @ other[3:]), cross, float(lost[:3] @ lost[3:])])
        real = roots[np.abs(roots.imag) < 1e-9].real
        if real.size:
            wrench = lost + real[np.argmin(np.abs(real))] * other
    f, m = wrench[:3], wrench[3:]
    square = float(f @ f)
    pitch = float(f @ m) / square
    line = LostMotion("move", _upright(f), np.cross(f, m) / square)
    return line if abs(pitch) < _ZERO else LostMotion("screw", line.direction, line.offset, pitch)


def _upright(vector: FloatArray) -> FloatArray:
    unit = vector / np.linalg.norm(vector)
    return np.asarray(unit * math.copysign(1.0, unit[np.argmax(np.abs(unit))]))
