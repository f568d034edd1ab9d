"""Whether an arm can go from one pose to the next along the path: the joint-space midpoint must stay on the way.

A step threshold cannot tell a jump from a fast motion near a singularity. The midpoint can: between two poses of one
branch it lies beside the segment, nearer by the square the finer the path; between two branches it stays far off.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rvsim.kinematics.forward import forward_kinematics
from rvsim.kinematics.jacobian import jacobian
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.spatial.rotation_vectors import rotation_from_vector, rotation_vector

# How far the midpoint may lie off the segment, in its lengths; how far its orientation off the mean one [rad].
_SIDEWAYS = 0.25
_TILT = 0.25
# What counts as the same place, in sizes of the arm.
_SAME_PLACE = 1e-7
_DEPTH = 9
_NEWTON_STEPS = 25


def beside_segment(robot: Robot, q0: FloatArray, q1: FloatArray, with_rotation: bool) -> NDArray[np.bool_]:
    """(k,) whether the midpoints of poses (k, n) and (k, n) keep to the tool's straight way from one to the other."""
    T0, T1 = forward_kinematics(robot, q0), forward_kinematics(robot, q1)
    return keeps_to_segment(robot, T0, forward_kinematics(robot, 0.5 * (q0 + q1)), T1, with_rotation)


def keeps_to_segment(
    robot: Robot, start: FloatArray, middle: FloatArray, end: FloatArray, with_rotation: bool
) -> NDArray[np.bool_]:
    """(k,) whether the tool in `middle` is on the straight way from `start` to `end`, poses (k, 4, 4) each."""
    chord, way = end[:, :3, 3] - start[:, :3, 3], middle[:, :3, 3] - start[:, :3, 3]
    squared = np.maximum(np.sum(chord**2, axis=-1), 1e-300)
    along = np.clip(np.sum(way * chord, axis=-1) / squared, 0.0, 1.0)
    sideways = np.linalg.norm(way - along[:, None] * chord, axis=-1)
    near = sideways <= _SIDEWAYS * np.sqrt(squared) + _SAME_PLACE * robot.size
    if with_rotation:
        near &= _tilt(start[:, :3, :3], middle[:, :3, :3], end[:, :3, :3]) <= _TILT
    return np.asarray(near)


def _tilt(start: FloatArray, middle: FloatArray, end: FloatArray) -> FloatArray:
    """(k,) the angle between the middle orientation and the mean of the two others [rad]."""
    inverse = np.swapaxes(start, -1, -2)
    halfway = 0.5 * rotation_vector(inverse @ end) - rotation_vector(inverse @ middle)
    return np.asarray(np.linalg.norm(halfway, axis=-1))


def is_continuous(robot: Robot, q0: FloatArray, q1: FloatArray, with_rotation: bool, depth: int = _DEPTH) -> bool:
    """Whether the arm can go from q0 (n,) to q1 (n,) along the tool's straight way without changing its branch.

    Where the midpoint lies too far off it is put on the way (Newton's method) and both halves are asked again: on one
    branch that soon agrees, across two it never does.
    """
    if bool(beside_segment(robot, q0[None], q1[None], with_rotation)[0]):
        return True
    middle = _onto_the_way(robot, q0, q1, with_rotation) if depth else None
    if middle is None:
        return False
    halves = ((q0, middle), (middle, q1))
    return all(is_continuous(robot, before, after, with_rotation, depth - 1) for before, after in halves)


def _onto_the_way(robot: Robot, q0: FloatArray, q1: FloatArray, with_rotation: bool) -> FloatArray | None:
    """The pose near the joint midpoint whose tool is halfway between those of q0 and q1; None if none is found."""
    T0, T1 = forward_kinematics(robot, np.stack([q0, q1]))
    turn = rotation_vector(T0[:3, :3].T @ T1[:3, :3])
    place, rotation = 0.5 * (T0[:3, 3] + T1[:3, 3]), T0[:3, :3] @ rotation_from_vector(0.5 * turn)
    q = 0.5 * (q0 + q1)
    for _ in range(_NEWTON_STEPS):
        T, J = forward_kinematics(robot, q), jacobian(robot, q)
        error = np.concatenate([place - T[:3, 3], rotation_vector(rotation @ T[:3, :3].T)])
        if np.linalg.norm(error[:3]) < _SAME_PLACE * robot.size:
            return np.asarray(q)
        rows = slice(None) if with_rotation else slice(3)
        q = q + np.linalg.lstsq(J[rows], error[rows], rcond=1e-6)[0]
    return None
