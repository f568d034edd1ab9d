"""Inverse dynamics: the joint torques that move an arm with mass, whole and in its parts.

τ = M(q) q̈ + C(q, q̇) q̇ + g(q) + Jᵀ F: inertia, Coriolis and centrifugal, gravity, and a wrench the tool exerts.
Source: Siciliano et al., Robotics (2009), eq. (7.42). Gravity points along −z of the base.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.dynamics.inputs import joint_values, massive, stacked
from rvsim.dynamics.recursion import Rates, record_torques
from rvsim.dynamics.statics import joint_torques
from rvsim.kinematics.tape import Number, Player, Tape
from rvsim.robot import Robot
from rvsim.spatial.arrays import FloatArray

STANDARD_GRAVITY = 9.80665  # [m/s²] CGPM 1901, the value that defines the kilogram-force


class DynamicsParts(NamedTuple):
    """Joint torques (..., n) [N m; N for a sliding joint] by their cause."""

    gravity: FloatArray
    coriolis: FloatArray
    inertia: FloatArray

    @property
    def total(self) -> FloatArray:
        """Their sum: the inverse dynamics."""
        return self.gravity + self.coriolis + self.inertia


def inverse_dynamics(
    robot: Robot,
    q: ArrayLike,
    qd: ArrayLike,
    qdd: ArrayLike,
    *,
    gravity: ArrayLike = STANDARD_GRAVITY,
    payload: ArrayLike = 0.0,
    wrench: ArrayLike | None = None,
) -> FloatArray:
    """The torques (..., n) [N m; N for a sliding joint] that give q (..., n) [rad, m] these rates (..., n).

    Args:
        robot: an arm with masses.
        q, qd, qdd: joint values, velocities and accelerations; their leading shapes broadcast.
        gravity: (...) its strength [m/s²]; it points along −z of the base.
        payload: (...) a point mass at the tool origin [kg].
        wrench: (..., 6) what the tool exerts, as in `joint_torques`, or None.

    Raises:
        NoMassDataError: the arm has no masses.
        ShapeError: a last axis is not the number of joints.
    """
    loaded = bool(np.any(np.asarray(payload)))
    columns = [joint_values(robot, name, value) for name, value in (("q", q), ("qd", qd), ("qdd", qdd))]
    extra = (gravity, payload) if loaded else (gravity,)
    torques = _full_player(massive(robot), loaded).play(stacked(columns, extra))
    return torques if wrench is None else torques + joint_torques(robot, q, wrench)


def gravity_torques(
    robot: Robot, q: ArrayLike, *, gravity: ArrayLike = STANDARD_GRAVITY, payload: ArrayLike = 0.0
) -> FloatArray:
    """g(q) (..., n): the torques that hold the arm still at q (..., n), and a payload [kg] at the tool origin.

    Raises:
        NoMassDataError: the arm has no masses.
        ShapeError: the last axis of q is not the number of joints.
    """
    columns = [joint_values(robot, "q", q)]
    return _gravity_player(massive(robot)).play(stacked(columns, (gravity, payload)))


def coriolis_torques(robot: Robot, q: ArrayLike, qd: ArrayLike, *, payload: ArrayLike = 0.0) -> FloatArray:
    """C(q, q̇) q̇ (..., n): Coriolis and centrifugal torques.

    Raises:
        NoMassDataError: the arm has no masses.
        ShapeError: a last axis is not the number of joints.
    """
    columns = [joint_values(robot, "q", q), joint_values(robot, "qd", qd)]
    return _coriolis_player(massive(robot)).play(stacked(columns, (payload,)))


def inertia_torques(robot: Robot, q: ArrayLike, qdd: ArrayLike, *, payload: ArrayLike = 0.0) -> FloatArray:
    """M(q) q̈ (..., n): the torques that accelerate the arm from rest.

    Raises:
        NoMassDataError: the arm has no masses.
        ShapeError: a last axis is not the number of joints.
    """
    columns = [joint_values(robot, "q", q), joint_values(robot, "qdd", qdd)]
    return _inertia_player(massive(robot)).play(stacked(columns, (payload,)))


def dynamics_parts(
    robot: Robot,
    q: ArrayLike,
    qd: ArrayLike,
    qdd: ArrayLike,
    *,
    gravity: ArrayLike = STANDARD_GRAVITY,
    payload: ArrayLike = 0.0,
) -> DynamicsParts:
    """The parts of `inverse_dynamics` apart; they sum to it.

    Raises:
        NoMassDataError, ShapeError: as there.
    """
    return DynamicsParts(
        gravity_torques(robot, q, gravity=gravity, payload=payload),
        coriolis_torques(robot, q, qd, payload=payload),
        inertia_torques(robot, q, qdd, payload=payload),
    )


# A tape knows inputs by their number: q first, then what the player is given after it.


@lru_cache(maxsize=64)
def _full_player(robot: Robot, loaded: bool) -> Player:
    n = robot.dof
    tape = Tape(3 * n + 1 + loaded)
    rates = Rates(_inputs(tape, n, n), _inputs(tape, 2 * n, n), tape.joint(3 * n))
    payload = tape.joint(3 * n + 1) if loaded else 0.0
    return tape.player(record_torques(robot, tape, rates, payload), (n,))


@lru_cache(maxsize=64)
def _gravity_player(robot: Robot) -> Player:
    n = robot.dof
    tape = Tape(n + 2)
    rates = Rates([0.0] * n, [0.0] * n, tape.joint(n))
    return tape.player(record_torques(robot, tape, rates, tape.joint(n + 1)), (n,))


@lru_cache(maxsize=64)
def _coriolis_player(robot: Robot) -> Player:
    n = robot.dof
    tape = Tape(2 * n + 1)
    rates = Rates(_inputs(tape, n, n), [0.0] * n, 0.0)
    return tape.player(record_torques(robot, tape, rates, tape.joint(2 * n)), (n,))


@lru_cache(maxsize=64)
def _inertia_player(robot: Robot) -> Player:
    n = robot.dof
    tape = Tape(2 * n + 1)
    rates = Rates([0.0] * n, _inputs(tape, n, n), 0.0)
    return tape.player(record_torques(robot, tape, rates, tape.joint(2 * n)), (n,))


def _inputs(tape: Tape, first: int, count: int) -> list[Number]:
    return [tape.joint(first + index) for index in range(count)]
