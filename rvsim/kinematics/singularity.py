"""How near an arm is to a singularity, which motion fades there, and how to get into one.

The numbers are those of the geometric Jacobian in metres and radians, so σ of a whole twist mixes units: it compares
poses of one arm, not arms of different size. Where an arm's task is a place (planar, SCARA …), its 6 × n Jacobian
keeps its rank although the arm is singular for its task: `task` has the numbers that matter, `families` are the task's.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import NoClosedFormError
from rvsim.kinematics.inverse.families import closed_form
from rvsim.kinematics.jacobian import jacobian
from rvsim.kinematics.rates import jacobian_dot
from rvsim.kinematics.singular_families import ACTIVE, SingularFamily, singular_families
from rvsim.robot import Robot
from rvsim.spatial.arrays import FloatArray, floats

RANK = 1e-6  # singular values above it count
_VECTOR_LOST = 1e-9  # below it, the singular vector of σ_min is rounding where the arm has fewer joints than rows
_ALL = (0, 1, 2, 3, 4, 5)
_TASK_ROWS = {"pose": _ALL, "position": (0, 1, 2), "position+yaw": (0, 1, 2, 5), "x,y": (0, 1)}


@dataclass(frozen=True, eq=False)
class Measures:
    """What the singular values of a Jacobian J (m, n) say.

    Args:
        singular_values: (min(m, n),) the largest first.
        fading: (m,) the unit motion that is hardest to make, that of the smallest singular value; its largest entry
            is positive.
        lost: `fading` where it is lost, the rank being below min(m, n); else None. What the arm can never do, having
            fewer joints than rows, is not counted as lost.
        never: (m, max(0, m − n)) unit motions that no joint makes here for want of joints, besides what is lost.
        missing: (m, m − rank) an orthonormal basis of all motions that no joint makes here.
    """

    singular_values: FloatArray
    fading: FloatArray
    lost: FloatArray | None
    never: FloatArray
    missing: FloatArray

    @property
    def sigma_min(self) -> float:
        """The smallest singular value."""
        return float(self.singular_values[-1])

    @property
    def rank(self) -> int:
        """How many singular values are above 1e-6."""
        return int((self.singular_values > RANK).sum())

    @property
    def full_rank(self) -> int:
        """The rank away from singularities."""
        return self.singular_values.size

    @property
    def ratio(self) -> float:
        """The smallest over the largest singular value, 0…1; 0 too where no joint moves anything."""
        largest = float(self.singular_values[0])
        return self.sigma_min / largest if largest else 0.0

    @property
    def condition(self) -> float:
        """The largest over the smallest singular value; inf where that is lost."""
        return float(self.singular_values[0]) / self.sigma_min if self.rank == self.full_rank else math.inf

    @property
    def manipulability(self) -> float:
        """√det(J Jᵀ) or √det(Jᵀ J), whichever is not 0 by shape: the product of all. Yoshikawa (1985)."""
        return float(self.singular_values.prod())


@dataclass(frozen=True, eq=False)
class Singularity:
    """The verdict on one pose. `whole` is of the 6 × n Jacobian, `position` of its linear rows, `task` of the task's.

    Args:
        families: the active families of the arm's own task, each with .name and .kind; () when none is, or when the
            arm's shape has none that is known.
        position_families: the active families that concern the position alone.
    """

    robot: Robot
    q: FloatArray
    J: FloatArray
    families: tuple[SingularFamily, ...]
    position_families: tuple[SingularFamily, ...]

    @cached_property
    def whole(self) -> Measures:
        """Of all six rows."""
        return _measures(self.robot, self.q, self.J, _ALL)

    @cached_property
    def position(self) -> Measures:
        """Of the three linear rows."""
        return _measures(self.robot, self.q, self.J, (0, 1, 2))

    @cached_property
    def task(self) -> Measures:
        """Of the rows that the arm's own task asks for."""
        rows = task_rows(self.robot)
        return self.whole if len(rows) == 6 else _measures(self.robot, self.q, self.J, rows)

    @property
    def singular_values(self) -> FloatArray:
        """(min(6, n),) of the 6 × n Jacobian, the largest first."""
        return self.whole.singular_values

    @property
    def sigma_min(self) -> float:
        """The smallest of them."""
        return self.whole.sigma_min

    @property
    def rank(self) -> int:
        """How many of them are above 1e-6."""
        return self.whole.rank

    @property
    def condition(self) -> float:
        """Their largest over their smallest; inf where the rank is below what it could be."""
        return self.whole.condition

    @property
    def manipulability(self) -> float:
        """Their product."""
        return self.whole.manipulability

    @property
    def lost(self) -> FloatArray | None:
        """(6,) the unit twist that is lost here, or None."""
        return self.whole.lost


def singularity(robot: Robot, q: ArrayLike) -> Singularity:
    """Judge the pose q (n,).

    Raises:
        ShapeError: q is not one value a joint.
    """
    joints = np.array(floats("q", q, robot.dof))
    active = [family for family in singular_families(robot) if family.measure(joints) <= ACTIVE]
    own, position = (tuple(f for f in active if f.part == part) for part in ("pose", "position"))
    return Singularity(robot, joints, jacobian(robot, joints), own, position)


def task_rows(robot: Robot) -> tuple[int, ...]:
    """The rows of the Jacobian that the arm's own task asks for; all six where no closed form tells."""
    try:
        return _TASK_ROWS[closed_form(robot).task]
    except NoClosedFormError:
        return _ALL


def _measures(robot: Robot, q: FloatArray, J: FloatArray, rows: tuple[int, ...]) -> Measures:
    part = J[list(rows)]
    U, sigma, Vt = np.linalg.svd(part)
    count = sigma.size
    fading = U[:, count - 1]
    spare = U[:, count:]
    if spare.shape[1] and sigma[-1] < _VECTOR_LOST:
        rank = int((sigma > _VECTOR_LOST).sum())
        U_null = U[:, rank:]
        opened = _opened(robot, q, list(rows), U_null, Vt[rank:count])
        fading, spare = opened[:, 0], opened[:, count - rank :]
    fading = fading * math.copysign(1.0, fading[np.argmax(np.abs(fading))])
    missing = U[:, int((sigma > RANK).sum()) :]
    return Measures(sigma, fading, fading if sigma[-1] <= RANK else None, spare, missing)


def _opened(robot: Robot, q: FloatArray, rows: list[int], U_null: FloatArray, V_null: FloatArray) -> FloatArray:
    """The motions U_null (m, k) that are missing here, those first that come back when the arm leaves this pose.

    To first order, a step of joint i out of the pose lets the idle joint motion v (J v = 0) make (∂J/∂qᵢ) v: what of
    this lies outside of what the arm can do here is what was lost; the rest the arm can never do.
    """
    change = jacobian_dot(robot, np.broadcast_to(q, (robot.dof, robot.dof)), np.eye(robot.dof))[:, rows]
    comes_back = np.einsum("mk,imn,jn->kij", U_null, change, V_null).reshape(U_null.shape[1], -1)
    order, _, _ = np.linalg.svd(comes_back)
    return np.asarray(U_null @ order)
