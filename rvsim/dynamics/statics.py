"""Forces at the tool and the torques that balance them: τ = Jᵀ F.

F = (f, m) is the wrench that the tool exerts on what it touches, at the tool origin: force [N], then moment [N m].
Source: Siciliano et al., Robotics (2009), eq. (3.111).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import SettingError, ShapeError
from rvsim.kinematics import forward_kinematics, jacobian
from rvsim.language import tr
from rvsim.robot import Robot
from rvsim.spatial.arrays import FloatArray

_NO_LEVER = 1e-12  # of the largest torque: rounding, no lever


class LargestForce(NamedTuple):
    """How much an arm can exert in a direction.

    Args:
        force: [N], or [N m] where the direction is a pure moment; inf where no joint has to hold it.
        joint: the joint (from 0) that reaches its torque limit first, None where the force is infinite.
        torques: (n,) of all joints at that force [N m, N]; nan where the force is infinite.
    """

    force: float
    joint: int | None
    torques: FloatArray


def joint_torques(robot: Robot, q: ArrayLike, wrench: ArrayLike) -> FloatArray:
    """τ = Jᵀ F (..., n) [N m; N for a sliding joint] for q (..., n) and F (..., 6), base axes, at the tool origin.

    Raises:
        ShapeError: the last axis of q is not the number of joints, or that of the wrench is not 6.
    """
    F = _wrench(wrench)
    torques: FloatArray = (F[..., None, :] @ jacobian(robot, q))[..., 0, :]
    return torques


def wrench_in_base(robot: Robot, q: ArrayLike, wrench_tool: ArrayLike) -> FloatArray:
    """A wrench (..., 6) given in tool axes, in base axes; its point stays the tool origin.

    Raises:
        ShapeError: as in `joint_torques`.
    """
    F = _wrench(wrench_tool)
    R_base_tool = forward_kinematics(robot, q)[..., :3, :3]
    parts = [(R_base_tool @ F[..., rows, None])[..., 0] for rows in (slice(0, 3), slice(3, 6))]
    return np.concatenate(parts, axis=-1)


def payload_wrench(mass: ArrayLike, gravity: float) -> FloatArray:
    """The wrench (..., 6) with which the tool carries a mass (...) [kg] at its origin: upwards, m g."""
    wrench = np.zeros((*np.shape(mass), 6))
    wrench[..., 2] = np.asarray(mass) * gravity
    return wrench


def largest_force(
    robot: Robot, q: ArrayLike, direction: ArrayLike, torque_limits: ArrayLike, *, holding: ArrayLike = 0.0
) -> LargestForce:
    """How strongly the tool can push along a direction until a joint reaches its torque limit.

    Args:
        robot: the arm.
        q: (n,) its pose [rad, m].
        direction: (3,) of a force, or (6,) of a wrench, base axes. Only its direction counts: its linear part is made
            a unit vector, its moment scaled along (a moment alone is made a unit vector itself).
        torque_limits: (n,) ≥ 0 [N m, N]; inf where none is known.
        holding: (n,) torques that are needed already, for instance for the arm's own weight.

    Raises:
        ShapeError: a vector has another length.
        SettingError: the direction is zero, or a limit is negative.
    """
    unit, limits = _unit_wrench(direction), _per_joint(robot, "torque_limits", torque_limits)
    if not np.all(limits >= 0.0):
        raise SettingError("torque_limits", float(limits.min()), tr("0 or more"))
    held = _per_joint(robot, "holding", holding)
    slope = joint_torques(robot, q, unit)
    slope = np.where(np.abs(slope) <= _NO_LEVER * np.abs(slope).max(), 0.0, slope)
    forces = _until_limits(slope, held, limits)
    joint = int(np.argmin(forces))
    force = float(forces[joint])
    if math.isinf(force):
        return LargestForce(math.inf, None, np.full(robot.dof, math.nan))
    return LargestForce(force, joint, held + force * slope)


def _until_limits(slope: FloatArray, held: FloatArray, limits: FloatArray) -> FloatArray:
    """(n,) the force at which each joint reaches its limit; 0 where it is beyond it already."""
    room = np.where(slope >= 0.0, limits - held, limits + held)
    room = np.where(np.abs(held) > limits, 0.0, room)
    with np.errstate(divide="ignore", invalid="ignore"):
        forces = room / np.abs(slope)
    return np.where((slope == 0.0) & (np.abs(held) <= limits), math.inf, np.where(slope == 0.0, 0.0, forces))


def _unit_wrench(direction: ArrayLike) -> FloatArray:
    given = np.asarray(direction, dtype=np.float64)
    if given.shape not in ((3,), (6,)):
        raise ShapeError("direction", "(3,) or (6,)", given.shape)
    wrench = np.zeros(6)
    wrench[: given.size] = given
    length = float(np.linalg.norm(wrench[:3])) or float(np.linalg.norm(wrench[3:]))
    if not 0.0 < length < math.inf:
        raise SettingError("direction", given.tolist(), tr("finite and not zero"))
    return wrench / length


def _per_joint(robot: Robot, name: str, values: ArrayLike) -> FloatArray:
    array = np.asarray(values, dtype=np.float64)
    if array.ndim and array.shape != (robot.dof,):
        raise ShapeError(name, f"({robot.dof},)", array.shape)
    return np.broadcast_to(array, (robot.dof,))


def _wrench(wrench: ArrayLike) -> FloatArray:
    F = np.asarray(wrench, dtype=np.float64)
    if F.ndim == 0 or F.shape[-1] != 6:
        raise ShapeError("wrench", "(..., 6)", F.shape)
    return F
