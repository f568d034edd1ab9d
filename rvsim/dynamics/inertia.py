"""The mass matrix M(q), by composite rigid bodies, and the accelerations that torques cause.

Source: Featherstone, Rigid Body Dynamics Algorithms (2008), section 6.2, all in base axes about the base's origin,
where the inertias of the links beyond a joint simply add up.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.dynamics.inputs import joint_values, massive, stacked
from rvsim.dynamics.newton_euler import STANDARD_GRAVITY, inverse_dynamics
from rvsim.errors import RobotDefinitionError
from rvsim.kinematics.chain import Axis, Frame, Vector, Walk, combined, cross
from rvsim.kinematics.tape import Number, Player, Tape
from rvsim.language import tr
from rvsim.robot import LinkMass, Robot
from rvsim.spatial.arrays import FloatArray

_SINGULAR = 1e-12  # of the largest entry of M


class _Body(NamedTuple):
    """A body seen from the base's origin: mass, mass times centre of mass, and rows of the inertia about the origin."""

    mass: Number
    moment: Vector
    inertia: tuple[Vector, Vector, Vector]

    def momentum(self, v: Vector, w: Vector) -> tuple[Vector, Vector]:
        """Linear and angular momentum of a motion: v of the point at the origin, and w."""
        linear = combined((self.mass, v), (1.0, cross(w, self.moment)))
        angular = combined((1.0, cross(self.moment, v)), *zip(w, self.inertia, strict=True))
        return linear, angular

    def joined(self, other: _Body) -> _Body:
        """Both as one."""
        rows = [combined((1.0, a), (1.0, b)) for a, b in zip(self.inertia, other.inertia, strict=True)]
        moment = combined((1.0, self.moment), (1.0, other.moment))
        return _Body(self.mass + other.mass, moment, (rows[0], rows[1], rows[2]))


def mass_matrix(robot: Robot, q: ArrayLike, *, payload: ArrayLike = 0.0) -> FloatArray:
    """M (..., n, n) of q (..., n), symmetric: kinetic energy = ½ q̇ᵀ M q̇ [kg m², kg m, kg].

    Args:
        robot: an arm with masses.
        q: joint values [rad, m].
        payload: (...) a point mass at the tool origin [kg].

    Raises:
        NoMassDataError: the arm has no masses.
        ShapeError: the last axis of q is not the number of joints.
    """
    return _mass_player(massive(robot)).play(stacked([joint_values(robot, "q", q)], (payload,)))


def forward_dynamics(
    robot: Robot,
    q: ArrayLike,
    qd: ArrayLike,
    torques: ArrayLike,
    *,
    gravity: ArrayLike = STANDARD_GRAVITY,
    payload: ArrayLike = 0.0,
) -> FloatArray:
    """q̈ (..., n) that these torques (..., n) cause at q, qd (..., n), without friction.

    Raises:
        NoMassDataError: the arm has no masses.
        RobotDefinitionError: a joint moves nothing that has inertia, so that its acceleration is not defined.
        ShapeError: a last axis is not the number of joints.
    """
    at_rest = np.zeros(robot.dof)
    needed = inverse_dynamics(robot, q, qd, at_rest, gravity=gravity, payload=payload)
    M = mass_matrix(robot, q, payload=payload)
    if np.any(np.linalg.eigvalsh(M)[..., 0] <= _SINGULAR * np.abs(M).max(axis=(-1, -2))):
        raise RobotDefinitionError(robot.name, tr("a joint moves nothing that has inertia: give its link an inertia."))
    net = joint_values(robot, "torques", torques) - needed
    return np.asarray(np.linalg.solve(M, net[..., None])[..., 0], dtype=np.float64)


@lru_cache(maxsize=64)
def _mass_player(robot: Robot) -> Player:
    tape = Tape(robot.dof + 1)
    entries = record_mass_matrix(robot, tape, tape.joint(robot.dof))
    return tape.player([entry for row in entries for entry in row], (robot.dof, robot.dof))


def record_mass_matrix(robot: Robot, tape: Tape, payload: Number) -> list[list[Number]]:
    """The entries of M on the tape, row by row."""
    walk = Walk(tape, robot.T_base_0)
    screws, bodies = list[tuple[Vector, Vector]](), list[_Body]()
    for index, link in enumerate(robot.masses):
        screws.append(_screw(robot.joints[index].revolute, walk.pass_joint(robot, index)))
        bodies.append(_body(link, walk.frame))
    walk.pass_transform(robot.T_flange_tool)
    composite = _point(payload, walk.origin)
    M: list[list[Number]] = [[0.0] * robot.dof for _ in range(robot.dof)]
    for j in reversed(range(robot.dof)):
        composite = composite.joined(bodies[j])
        linear, angular = composite.momentum(*screws[j])
        for i in range(j + 1):
            v, w = screws[i]
            M[i][j] = M[j][i] = _dot(v, linear) + _dot(w, angular)
    return M


def _screw(revolute: bool, axis: Axis) -> tuple[Vector, Vector]:
    """The motion of a joint at unit speed: v of the body's point at the base's origin, and w."""
    still: Vector = (0.0, 0.0, 0.0)
    return (cross(axis.point, axis.direction), axis.direction) if revolute else (axis.direction, still)


def _body(link: LinkMass, frame: Frame) -> _Body:
    factors = (*(float(value) for value in link.com), 1.0)
    com = combined(*zip(factors, frame, strict=True))
    point, own = _point(float(link.mass), com), _turned_inertia(link.inertia, frame)
    rows = [combined((1.0, a), (1.0, b)) for a, b in zip(point.inertia, own, strict=True)]
    return point._replace(inertia=(rows[0], rows[1], rows[2]))


def _turned_inertia(inertia: FloatArray, frame: Frame) -> list[Vector]:
    """Rows of R I Rᵀ."""
    axes = frame[:3]
    rows = [combined(*zip((float(value) for value in row), axes, strict=True)) for row in inertia]
    return [combined(*((axis[k], row) for axis, row in zip(axes, rows, strict=True))) for k in range(3)]


def _point(mass: Number, at: Vector) -> _Body:
    moment = combined((mass, at))
    (x, y, z), (mx, my, mz) = at, moment
    xx, yy, zz = mx * x, my * y, mz * z
    xy, xz, yz = mx * y, mx * z, my * z
    return _Body(mass, moment, ((yy + zz, -xy, -xz), (-xy, xx + zz, -yz), (-xz, -yz, xx + yy)))


def _dot(a: Vector, b: Vector) -> Number:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
