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
from typing import Literal, NamedTuple

import numpy as np

from rvsim.kinematics.singularity import Measures
from rvsim.spatial.arrays import FloatArray

_ZERO = 1e-6  # of a unit direction, lengths in arm sizes
_NEW = 1e-3  # of a wrench: with more it says something that the others did not
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


def lost_motions(measures: Measures, length: float, axes: FloatArray | None = None) -> tuple[LostMotion, ...]:
    """What is lost at a singular pose, () at any other; `length` [m] weighs moments against forces.

    Where more than one motion is lost at once there is a choice of what to name: then those along or about `axes`
    (k, 3), unit vectors in base axes, come first, the earlier and the nearer to the tip the sooner; without, the axes
    of the base. What is told spans all that is missing.

    For an arm with fewer than six joints a lost motion is known only up to motions it can never do; then the purest
    of them is told, and never-possible ones that are pure as well come along with it.
    """
    if measures.lost is None:
        return ()
    known = np.eye(3) if axes is None else axes
    if measures.full_rank - measures.rank > 1:
        return _named(_as_wrenches(measures.missing), length, known)
    if measures.lost.size < 6:
        return _told(_as_wrenches(measures.lost[:, None])[:, 0], length)
    basis = np.column_stack([measures.lost, measures.never])
    scaled = np.linalg.qr(basis * np.repeat([1.0, 1.0 / length], 3)[:, None])[0]
    pure = (*_pure(scaled, 0), *_pure(scaled, 1))
    return pure or _told(_purest(measures.lost, measures.never), length)


def _as_wrenches(missing: FloatArray) -> FloatArray:
    """(6, k) of (m, k): the rows of a smaller task are x, y, z, and the turn about z."""
    wrenches = np.zeros((6, missing.shape[1]))
    wrenches[{6: [0, 1, 2, 3, 4, 5], 4: [0, 1, 2, 5]}.get(len(missing), list(range(len(missing))))] = missing
    return wrenches


# --- several at once -----------------------------------------------------------------------------------------------


class _Named(NamedTuple):
    """A motion, its wrench (6,) with moments in arm sizes, and how far from the tip it lies in arm sizes."""

    motion: LostMotion
    wrench: FloatArray
    away: float


def _named(basis: FloatArray, length: float, axes: FloatArray) -> tuple[LostMotion, ...]:
    """So many motions as basis (6, k) has columns, none of which follows from the others."""
    scaled = np.linalg.qr(basis * np.repeat([1.0, 1.0 / length], 3)[:, None])[0]
    candidates = [found for axis in axes for half in (0, 1) if (found := _along(scaled, axis, half, length))]
    told: list[LostMotion] = []
    left = scaled
    for motion, wrench, _ in sorted(candidates, key=lambda found: round(found.away, 6)):
        rest = left @ (left.T @ wrench)
        if np.linalg.norm(rest) > _NEW * np.linalg.norm(wrench):
            told.append(motion)
            left = _without(left, rest)
    pure = (*_pure(left, 0), *_pure(left, 1))
    return (*told, *(pure if len(pure) == left.shape[1] else _each_told(left, length)))


def _along(scaled: FloatArray, axis: FloatArray, half: int, length: float) -> _Named | None:
    """The force (half 0) along an axis (3,) on the line nearest to the tip, or the pure moment about it, in a space."""
    own, other = scaled[3 * half : 3 * half + 3], scaled[3 - 3 * half : 6 - 3 * half]
    targets = np.concatenate([own, other]) if half else own
    wanted = np.concatenate([axis, np.zeros(3)]) if half else axis
    shares = np.linalg.lstsq(targets, wanted, rcond=_ZERO)[0]
    if np.linalg.norm(targets @ shares - wanted) > _ZERO:
        return None
    if half:
        return _Named(LostMotion("turn", _upright(axis), np.zeros(3)), scaled @ shares, 0.0)
    wrench = scaled @ (shares + _least_moment(own, other, shares))
    offset = np.cross(axis, wrench[3:])
    if abs(float(axis @ wrench[3:])) > _ZERO:
        return None
    return _Named(LostMotion("move", _upright(axis), length * offset), wrench, float(np.linalg.norm(offset)))


def _least_moment(force: FloatArray, moment: FloatArray, shares: FloatArray) -> FloatArray:
    """(k,) what to add to the shares (k,) of a space's columns so that the force stays and the moment is least."""
    _, sigma, Vt = np.linalg.svd(force)
    idle = Vt[int((sigma > _ZERO).sum()) :].T
    return np.asarray(idle @ np.linalg.lstsq(moment @ idle, -moment @ shares, rcond=_ZERO)[0])


def _without(basis: FloatArray, vector: FloatArray) -> FloatArray:
    """(6, k - 1) the part of basis (6, k), orthonormal, that is square to a vector (6,) in it."""
    _, _, Vt = np.linalg.svd((basis.T @ vector)[None])
    return np.asarray(basis @ Vt[1:].T)


def _each_told(scaled: FloatArray, length: float) -> tuple[LostMotion, ...]:
    columns = (scaled * np.repeat([1.0, length], 3)[:, None]).T
    return tuple(motion for wrench in columns for motion in _told(wrench, length))


# --- one -----------------------------------------------------------------------------------------------------------


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
    if square < _ZERO**2:
        return (LostMotion("turn", _upright(m), np.zeros(3)),)
    offset = np.cross(f, m) / square
    if abs(float(f @ m)) < _ZERO * square * length and np.linalg.norm(offset) < _NEAR * length:
        return (LostMotion("move", _upright(f), offset),)
    here = np.zeros(3)
    return LostMotion("move", _upright(f), here, alone=True), LostMotion("turn", _upright(m), here, alone=True)


def _upright(vector: FloatArray) -> FloatArray:
    unit = vector / np.linalg.norm(vector)
    return np.asarray(unit * math.copysign(1.0, unit[np.argmax(np.abs(unit))]))
