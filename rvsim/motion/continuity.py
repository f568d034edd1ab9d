"""Whether an arm can go from one pose to the next along the path: the joint-space midpoint must stay on the way.

A step threshold cannot tell a jump from a fast motion near a singularity. The midpoint can: between two poses of one
branch it lies beside the tool's straight way, nearer by the square the finer the path; between two branches it stays
far off. Where it is neither near nor far, the midpoint is put on the way and both halves are asked again.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rvsim.kinematics.forward import forward_kinematics
from rvsim.kinematics.jacobian import jacobian
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.spatial.rotation_vectors import rotation_from_vector, rotation_vector

# How far the midpoint may lie off the way, in its lengths, and how far from where no halving will help.
_BESIDE, _FAR = 0.05, 0.75
# The same for the tool's orientation [rad].
_TILT, _FAR_TILT = 0.1, 1.5
_HARDLY = 1.0 + 2.0 * np.cos(0.5 * _TILT)
# What nobody would call a deviation, and what is a rounding, in sizes of the arm.
_NEGLIGIBLE, _SAME_PLACE = 1e-4, 1e-7
# The joints of a revolute arm that turn by so much in all bow its tool from the straight way by less than that.
_SMALL_STEP = 0.99 * np.sqrt(8.0 * _NEGLIGIBLE)
_HALVINGS = 8
# Newton's method: its steps, the longest of them [rad, sizes], how near is near enough, in lengths of the way.
_STEPS, _LONGEST_STEP, _NEAR_ENOUGH = 20, 0.5, 1e-3
# The place comes first: an error of orientation counts as so many sizes a radian.
_ORIENTATION_WEIGHT = 1e-3

Mask = NDArray[np.bool_]


def continuous_run(robot: Robot, q: FloatArray, with_rotation: bool) -> Mask:
    """(k − 1,) the same for each step of poses q (k, n), which are without whole turns between them."""
    if _in_small_steps(robot, q):
        return np.ones(len(q) - 1, dtype=bool)
    T = forward_kinematics(robot, np.concatenate([q, 0.5 * (q[:-1] + q[1:])]))
    result, far = beside(robot, T[: len(q) - 1], T[len(q) :], T[1 : len(q)], with_rotation)
    doubtful = np.flatnonzero(~(result | far))
    if len(doubtful):
        result[doubtful] = continuous(robot, q[doubtful], q[doubtful + 1], with_rotation)
    return result


def _in_small_steps(robot: Robot, q: FloatArray) -> bool:
    """Whether each step of poses (k, n) is so small that its midpoint cannot be anything but near the straight way.

    The tool of a revolute arm, no farther than its size r from any axis, feels at most r s² of the second derivative
    along a step that turns its joints by s in all, and so leaves its chord by at most r s²/8; it tilts by s at most.
    """
    return bool(robot.is_revolute.all() and np.abs(q[1:] - q[:-1]).sum(axis=1).max(initial=0.0) <= _SMALL_STEP)


def continuous(robot: Robot, q0: FloatArray, q1: FloatArray, with_rotation: bool) -> Mask:
    """(k,) whether the arm can go from poses q0 (k, n) to q1 (k, n) on the tool's straight way, within one branch."""
    result = np.ones(len(q0), dtype=bool)
    owner = np.arange(len(q0))
    for halving in range(_HALVINGS + 1):
        start, middle, end = forward_kinematics(robot, np.stack([q0, 0.5 * (q0 + q1), q1]))
        near, far = beside(robot, start, middle, end, with_rotation)
        result[owner[far]] = False
        doubtful = ~near & result[owner]
        q0, q1, owner = q0[doubtful], q1[doubtful], owner[doubtful]
        if not len(owner) or halving == _HALVINGS:
            break
        between, found = _onto_the_way(robot, q0, q1, with_rotation)
        result[owner[~found]] = False
        q0, q1, owner = np.concatenate([q0, between]), np.concatenate([between, q1]), np.tile(owner, 2)
    result[owner] = False
    return result


def beside(
    robot: Robot, start: FloatArray, middle: FloatArray, end: FloatArray, with_rotation: bool
) -> tuple[Mask, Mask]:
    """(k,) whether the tool in `middle` is near the straight way from `start` to `end`, poses (k, 4, 4), and if far."""
    chord, way = end[:, :3, 3] - start[:, :3, 3], middle[:, :3, 3] - start[:, :3, 3]
    squared = np.maximum(np.sum(chord**2, axis=-1), 1e-300)
    along = np.clip(np.sum(way * chord, axis=-1) / squared, 0.0, 1.0)
    sideways, length = np.linalg.norm(way - along[:, None] * chord, axis=-1), np.sqrt(squared)
    least = _NEGLIGIBLE * robot.size
    near, far = sideways <= _BESIDE * length + least, sideways > _FAR * length + least
    if with_rotation:
        turned = np.flatnonzero(~_hardly_turned(start, middle, end))
        if len(turned):
            tilt = _tilt(*(T[turned, :3, :3] for T in (start, middle, end)))
            near[turned] &= tilt <= _TILT
            far[turned] |= tilt > _FAR_TILT
    return np.asarray(near), np.asarray(far)


def _hardly_turned(start: FloatArray, middle: FloatArray, end: FloatArray) -> Mask:
    """(k,) whether the middle orientation is so near to both others that no tilt can count: half of it from each.

    The trace of a rotation is 1 + 2 cos of its angle, and that of AᵀB is the sum of products of their entries.
    """
    R = middle[:, :3, :3]
    traces = [np.einsum("kij,kij->k", T[:, :3, :3], R) for T in (start, end)]
    return np.asarray(np.minimum(*traces) > _HARDLY)


def _tilt(start: FloatArray, middle: FloatArray, end: FloatArray) -> FloatArray:
    """(k,) the angle between the middle orientation and the mean of the two others [rad]."""
    inverse = np.swapaxes(start, -1, -2)
    halfway = 0.5 * rotation_vector(inverse @ end) - rotation_vector(inverse @ middle)
    return np.asarray(np.linalg.norm(halfway, axis=-1))


def _onto_the_way(robot: Robot, q0: FloatArray, q1: FloatArray, with_rotation: bool) -> tuple[FloatArray, Mask]:
    """Poses (k, n) near the joint midpoints whose tool is halfway between those of q0 and q1, and which were found."""
    T0, T1 = forward_kinematics(robot, q0), forward_kinematics(robot, q1)
    halfway = _halfway(T0, T1)
    enough = _NEAR_ENOUGH * np.linalg.norm(T1[:, :3, 3] - T0[:, :3, 3], axis=1) + _SAME_PLACE * robot.size
    q = 0.5 * (q0 + q1)
    for _ in range(_STEPS):
        T = forward_kinematics(robot, q)
        error = halfway[:, :3, 3] - T[:, :3, 3]
        missing = np.linalg.norm(error, axis=1) > enough
        if not missing.any():
            break
        q[missing] += _newton_step(robot, q[missing], T[missing], halfway[missing], with_rotation)
    return q, ~missing


def _halfway(T0: FloatArray, T1: FloatArray) -> FloatArray:
    """(k, 4, 4) halfway between two poses each: the middle of the places, half of the turn."""
    T = 0.5 * (T0 + T1)
    turn = rotation_vector(np.swapaxes(T0[:, :3, :3], -1, -2) @ T1[:, :3, :3])
    T[:, :3, :3] = T0[:, :3, :3] @ rotation_from_vector(0.5 * turn)
    return np.asarray(T)


def _newton_step(robot: Robot, q: FloatArray, T: FloatArray, wanted: FloatArray, with_rotation: bool) -> FloatArray:
    """(k, n) the step towards `wanted` (k, 4, 4), shortened where it is long."""
    J, error = jacobian(robot, q), wanted[:, :3, 3] - T[:, :3, 3]
    if with_rotation:
        weight = _ORIENTATION_WEIGHT * robot.size
        J[:, 3:] *= weight
        turn = rotation_vector(wanted[:, :3, :3] @ np.swapaxes(T[:, :3, :3], -1, -2))
        error = np.concatenate([error, weight * turn], axis=1)
    step = (np.linalg.pinv(J[:, : error.shape[1]], rcond=1e-6) @ error[:, :, None])[:, :, 0]
    longest = np.max(np.abs(step) / np.where(robot.is_revolute, 1.0, robot.size), axis=1, keepdims=True)
    return np.asarray(step * np.minimum(1.0, _LONGEST_STEP / np.maximum(longest, 1e-300)))
