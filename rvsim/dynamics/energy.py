"""The energies of an arm with mass. Source: Siciliano et al., Robotics (2009), eqs. (7.30) and (7.36)."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from rvsim.dynamics.inertia import mass_matrix
from rvsim.dynamics.inputs import joint_values, massive, stacked
from rvsim.dynamics.newton_euler import STANDARD_GRAVITY
from rvsim.kinematics.chain import Walk
from rvsim.kinematics.tape import Number, Player, Tape
from rvsim.robot import Robot
from rvsim.spatial.arrays import FloatArray


def kinetic_energy(robot: Robot, q: ArrayLike, qd: ArrayLike, *, payload: ArrayLike = 0.0) -> FloatArray:
    """T = ½ q̇ᵀ M q̇ (...) [J] at q, qd (..., n), with a payload [kg] at the tool origin.

    Raises:
        NoMassDataError: the arm has no masses.
        ShapeError: a last axis is not the number of joints.
    """
    rate = joint_values(robot, "qd", qd)
    doubled: FloatArray = np.einsum("...i,...ij,...j->...", rate, mass_matrix(robot, q, payload=payload), rate)
    return 0.5 * doubled


def potential_energy(
    robot: Robot, q: ArrayLike, *, gravity: ArrayLike = STANDARD_GRAVITY, payload: ArrayLike = 0.0
) -> FloatArray:
    """V = g · Σ m z (...) [J] at q (..., n): 0 would be all mass at the height of the base's origin.

    Raises:
        NoMassDataError: the arm has no masses.
        ShapeError: the last axis of q is not the number of joints.
    """
    inputs = stacked([joint_values(robot, "q", q)], (gravity, payload))
    return _potential_player(massive(robot)).play(inputs)[..., 0]


@lru_cache(maxsize=64)
def _potential_player(robot: Robot) -> Player:
    tape = Tape(robot.dof + 2)
    walk = Walk(tape, robot.T_base_0)
    lifted: Number = 0.0
    for index, link in enumerate(robot.masses):
        walk.pass_joint(robot, index)
        factors = (*(float(value) for value in link.com), 1.0)
        height = sum((factor * axis[2] for factor, axis in zip(factors, walk.frame, strict=True)), start=0.0)
        lifted = lifted + float(link.mass) * height
    walk.pass_transform(robot.T_flange_tool)
    lifted = lifted + tape.joint(robot.dof + 1) * walk.origin[2]
    return tape.player([tape.joint(robot.dof) * lifted], (1,))
