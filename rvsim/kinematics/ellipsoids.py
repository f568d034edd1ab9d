"""Velocity and force ellipsoids: what the tool can do with joint speeds, or torques, of unit length."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import UnknownNameError
from rvsim.spatial.arrays import FloatArray, floats

Part = Literal["linear", "angular"]
Kind = Literal["velocity", "force"]

_ROWS = {"linear": slice(0, 3), "angular": slice(3, 6)}
_KINDS = ("velocity", "force")
_NOTHING = 1e-12  # of the largest: a radius this small is 0


@dataclass(frozen=True, eq=False)
class Ellipsoid:
    """axes (3, 3): unit vectors as columns in base axes; radii (3,): largest first for velocities.

    A radius is 0 where the tool cannot move, and inf where it bears any force.
    """

    axes: FloatArray
    radii: FloatArray


def ellipsoid(J: ArrayLike, part: Part = "linear", kind: Kind = "velocity") -> Ellipsoid:
    """Of a Jacobian J (6, n): "velocity" {J_p q̇ : |q̇| ≤ 1}, "force" {f : |J_pᵀ f| ≤ 1}, J_p its linear or angular rows.

    The axes are the left singular vectors of J_p, the radii its singular values, for forces their inverses: where the
    tool moves well it pushes badly. Sources: Yoshikawa, Manipulability of robotic mechanisms (1985); Siciliano et
    al., Robotics (2009), §3.9.

    Raises:
        ShapeError: J has not six rows.
        UnknownNameError: no such part or kind.
    """
    _check("part", part, tuple(_ROWS))
    _check("kind of ellipsoid", kind, _KINDS)
    matrix = floats("the transpose of J", np.asarray(J, np.float64).T, 6).T
    U, sigma, _ = np.linalg.svd(matrix[_ROWS[part]])
    values = np.zeros(3)
    values[: sigma.size] = sigma
    values[values <= _NOTHING * max(float(values[0]), _NOTHING)] = 0.0
    return Ellipsoid(U, values if kind == "velocity" else _inverse(values))


def _inverse(radii: FloatArray) -> FloatArray:
    return np.asarray(np.divide(1.0, radii, out=np.full(3, np.inf), where=radii > 0.0))


def _check(what: str, name: str, known: tuple[str, ...]) -> None:
    if name not in known:
        raise UnknownNameError(what, name, known)
