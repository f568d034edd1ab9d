"""Speeds and accelerations: of the tool for those of the joints, and of the joints for those of the tool.

Twists (..., 6) are (v, ω) in base axes, v that of the tool origin [m/s, rad/s]. To weigh metres against radians, the
inverse problem divides lengths by the size of the arm (`robot.size`, or the length that is given): a singular value
then says how fast the tool moves, in arm lengths or radians a second, for joint speeds of one radian (or one arm
length) a second.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import SettingError, UnknownNameError
from rvsim.kinematics.forward import forward_kinematics
from rvsim.kinematics.jacobian import jacobian, pose_and_jacobian
from rvsim.language import tr
from rvsim.robot import Robot
from rvsim.spatial import rpy_from_rotation, zyz_from_rotation
from rvsim.spatial.arrays import FloatArray, floats

Angles = Literal["rpy", "zyz"]

DAMPED_BELOW = 0.02  # of a scaled singular value: at most some 58 joint radians for a tool's radian or arm length
FEASIBLE = 1e-9  # a part this small of the wanted (scaled) motion is rounding, not lost
_GIMBAL_LOCK = 1e-12  # the measure below which the angles have no rates


def jacobian_dot(robot: Robot, q: ArrayLike, qd: ArrayLike) -> FloatArray:
    """J̇ (..., 6, n) at q (..., n) moving with qd (..., n), exact: the tool's acceleration is J q̈ + J̇ q̇.

    Column j changes with joint i by (ω_min × v_max, ω_i × ω_j if i < j), where min and max are the smaller and the
    greater of i and j. Source: Bruyninckx and De Schutter, Symbolic differentiation of the velocity mapping for a
    serial kinematic chain (1996).

    Raises:
        ShapeError: the last axis of q or qd is not the number of joints.
    """
    J, rates = jacobian(robot, q), floats("qd", qd, robot.dof)
    parts = J * rates[..., None, :]
    v, w = (np.swapaxes(np.broadcast_to(J, parts.shape)[..., rows, :], -1, -2) for rows in (_LINEAR, _ANGULAR))
    v_parts, w_parts = (np.swapaxes(parts[..., rows, :], -1, -2) for rows in (_LINEAR, _ANGULAR))
    up_to = np.cumsum(w_parts, axis=-2)
    after = v_parts.sum(axis=-2, keepdims=True) - np.cumsum(v_parts, axis=-2)
    columns = np.concatenate([_cross(up_to, v) + _cross(w, after), _cross(up_to, w)], axis=-1)
    return np.ascontiguousarray(np.swapaxes(columns, -1, -2))


_LINEAR, _ANGULAR = slice(0, 3), slice(3, 6)


def _cross(a: FloatArray, b: FloatArray) -> FloatArray:
    """a × b over the last axis, without the overhead of numpy's for small arrays."""
    turned = a[..., _NEXT] * b[..., _LAST]
    turned -= a[..., _LAST] * b[..., _NEXT]
    return turned


_NEXT, _LAST = np.array([1, 2, 0]), np.array([2, 0, 1])


def tool_jacobian(robot: Robot, q: ArrayLike) -> FloatArray:
    """J (..., 6, n) of q (..., n) in tool axes, at the tool origin.

    Raises:
        ShapeError: the last axis of q is not the number of joints.
    """
    T, J = pose_and_jacobian(robot, q)
    to_tool = np.swapaxes(T[..., :3, :3], -1, -2)
    return np.concatenate([to_tool @ J[..., :3, :], to_tool @ J[..., 3:, :]], axis=-2)


def analytic_jacobian(robot: Robot, q: ArrayLike, angles: Angles = "rpy") -> FloatArray:
    """J_A (..., 6, n) of q (..., n): the rates of x, y, z and of the three angles, in the order they are written.

    "rpy" is (roll, pitch, yaw) with R = Rz(yaw) Ry(pitch) Rx(roll); "zyz" is R = Rz Ry Rz. Where the angles
    themselves are singular (pitch = ±90°, or the second angle 0 or 180°; see `angle_measure`) their rows are nan: the
    arm may be well there, only the notation is not. Source: Siciliano et al., Robotics (2009), §3.6.

    Raises:
        ShapeError: the last axis of q is not the number of joints.
        UnknownNameError: no such angles.
    """
    T, J = pose_and_jacobian(robot, q)
    heading, measure, axial, upper = _euler(T[..., :3, :3], angles)
    c, s = np.cos(heading)[..., None], np.sin(heading)[..., None]
    wx, wy, wz = (J[..., row, :] for row in (3, 4, 5))
    safe = np.where(np.abs(measure) < _GIMBAL_LOCK, np.nan, measure)[..., None]
    last = (c * wx + s * wy) / safe
    middle = np.where(np.isnan(safe), np.nan, c * wy - s * wx)
    first = wz - axial[..., None] * last
    rows = (last, middle, first) if upper else (first, middle, last)
    return np.concatenate([J[..., :3, :], np.stack(rows, axis=-2)], axis=-2)


def angle_measure(robot: Robot, q: ArrayLike, angles: Angles = "rpy") -> FloatArray:
    """(...) how far the angles are from their own singularity: |cos pitch| for "rpy", the second sine for "zyz"; 0…1.

    Raises:
        ShapeError: the last axis of q is not the number of joints.
        UnknownNameError: no such angles.
    """
    return np.abs(_euler(forward_kinematics(robot, q)[..., :3, :3], angles).measure)


class _Euler(NamedTuple):
    """With ω = first·z + middle·(−s, c, 0) + last·(c·measure, s·measure, axial), c and s of the heading."""

    heading: FloatArray
    measure: FloatArray
    axial: FloatArray
    last_is_first: bool  # roll-pitch-yaw name the last turn first


def _euler(R: FloatArray, angles: Angles) -> _Euler:
    if angles == "rpy":
        rpy = rpy_from_rotation(R)
        # Not cos(pitch): near gimbal lock its digits are gone.
        return _Euler(rpy[..., 2], np.hypot(R[..., 0, 0], R[..., 1, 0]), R[..., 2, 0], True)
    if angles == "zyz":
        return _Euler(zyz_from_rotation(R)[..., 0], np.hypot(R[..., 0, 2], R[..., 1, 2]), R[..., 2, 2], False)
    raise UnknownNameError("set of angles", angles, ("rpy", "zyz"))


def tool_twist(robot: Robot, q: ArrayLike, qd: ArrayLike) -> FloatArray:
    """(v, ω) (..., 6) = J q̇ of q and qd, each (..., n).

    Raises:
        ShapeError: the last axis of q or qd is not the number of joints.
    """
    return _times(jacobian(robot, q), floats("qd", qd, robot.dof))


def tool_acceleration(robot: Robot, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike) -> FloatArray:
    """(v̇, ω̇) (..., 6) = J q̈ + J̇ q̇ of q, qd and qdd, each (..., n).

    Raises:
        ShapeError: the last axis of q, qd or qdd is not the number of joints.
    """
    drift = _times(jacobian_dot(robot, q, qd), floats("qd", qd, robot.dof))
    return drift + _times(jacobian(robot, q), floats("qdd", qdd, robot.dof))


def _times(matrix: FloatArray, vector: FloatArray) -> FloatArray:
    return np.asarray((matrix @ vector[..., None])[..., 0])


@dataclass(frozen=True, eq=False)
class JointRates:
    """Joint speeds for a wanted twist, and what becomes of it.

    Args:
        qd: (n,) [rad/s, m/s].
        damping: the largest damping factor λ in use; 0 when none was needed.
        achieved: (6,) the twist that the tool makes then.
        lost: (6,) the rest: what the arm cannot do here, or only with joint speeds beyond all measure.
        feasible: whether nothing is lost.
    """

    qd: FloatArray
    damping: float
    achieved: FloatArray
    lost: FloatArray
    feasible: bool


@dataclass(frozen=True, eq=False)
class JointAccelerations:
    """Joint accelerations for a wanted acceleration of the tool: as `JointRates`, qdd (n,) [rad/s², m/s²]."""

    qdd: FloatArray
    damping: float
    achieved: FloatArray
    lost: FloatArray
    feasible: bool


def joint_rates(
    robot: Robot, q: ArrayLike, twist: ArrayLike, *, threshold: float = DAMPED_BELOW, length: float | None = None
) -> JointRates:
    """The joint speeds that come nearest to a twist (6,) at q (n,), the smallest among equals.

    A pseudo-inverse by singular values σᵢ. Below `threshold` ε each is damped alone, 1/σ → σ/(σ² + λ²) with
    λ² = ¼ε² (1 − σ²/ε²), so that what the arm does well stays exact. Sources: Nakamura and Hanafusa (1986), damped
    least squares; Maciejewski and Klein, Numerical filtering for the operation of robotic manipulators through
    kinematically singular configurations (1988). Near and lost are judged with lengths divided by `length` [m], by
    default the arm's size.

    Raises:
        ShapeError: q or twist has the wrong shape.
        SettingError: a threshold below 0, a length not above 0.
    """
    wanted = floats("twist", twist, 6)
    J = jacobian(robot, q)
    solution = _damped(robot, J, wanted, threshold, length)
    achieved = J @ solution.x
    return JointRates(solution.x, solution.damping, achieved, wanted - achieved, solution.feasible)


def joint_accelerations(
    robot: Robot,
    q: ArrayLike,
    qd: ArrayLike,
    acceleration: ArrayLike,
    *,
    threshold: float = DAMPED_BELOW,
    length: float | None = None,
) -> JointAccelerations:
    """The joint accelerations (n,) nearest to an acceleration (6,) of the tool at q, moving with qd: J⁺ (a − J̇ q̇).

    Damped as in `joint_rates`.

    Raises:
        ShapeError: q, qd or acceleration has the wrong shape.
        SettingError: a threshold below 0, a length not above 0.
    """
    wanted = floats("acceleration", acceleration, 6)
    J, drift = jacobian(robot, q), _times(jacobian_dot(robot, q, qd), floats("qd", qd, robot.dof))
    solution = _damped(robot, J, wanted - drift, threshold, length)
    achieved = J @ solution.x + drift
    return JointAccelerations(solution.x, solution.damping, achieved, wanted - achieved, solution.feasible)


class _Damped(NamedTuple):
    """x (n,), the largest damping, and whether J x is all that was wanted."""

    x: FloatArray
    damping: float
    feasible: bool


def _damped(robot: Robot, J: FloatArray, wanted: FloatArray, threshold: float, length: float | None) -> _Damped:
    unit = robot.size if length is None else length
    _check(threshold, unit)
    rows, columns = row_scale(unit), np.where(robot.is_revolute, 1.0, unit)
    U, sigma, Vt = np.linalg.svd(rows[:, None] * J * columns, full_matrices=False)
    goal = rows * wanted
    ratio = np.minimum(sigma / threshold, 1.0) if threshold else np.ones_like(sigma)
    damping = 0.25 * threshold**2 * (1.0 - ratio**2)
    denominator = sigma**2 + damping
    gain = np.divide(sigma, denominator, out=np.zeros_like(sigma), where=denominator > 1e-24)
    parts = U.T @ goal
    missing = np.linalg.norm(goal - U @ (gain * sigma * parts))
    feasible = bool(missing <= FEASIBLE * max(float(np.linalg.norm(goal)), 1e-300))
    return _Damped(columns * (Vt.T @ (gain * parts)), float(np.sqrt(damping.max(initial=0.0))), feasible)


def row_scale(length: float) -> FloatArray:
    """(6,) the factors that turn a twist [m/s, rad/s] into arm lengths and radians a second."""
    return np.repeat([1.0 / length, 1.0], 3)


def _check(threshold: float, length: float) -> None:
    if not threshold >= 0.0:
        raise SettingError("threshold", threshold, tr("0 or more"))
    if not length > 0.0:
        raise SettingError("length", length, tr("above 0"))
