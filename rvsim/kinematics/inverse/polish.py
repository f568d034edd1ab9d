"""What rounding has moved is put right: onto the pose, onto where the arm is, onto a stop.

At a singular pose FK hardly feels some motion of the joints: there a closed form's joints may be off by the root of
the rounding, 1e-8 at a straight elbow and 1e-4 where two singularities meet.
"""

from __future__ import annotations

import numpy as np

from rvsim.kinematics.forward import forward_kinematics
from rvsim.kinematics.inverse.chain import TURN
from rvsim.kinematics.inverse.copies import LimitCopies
from rvsim.kinematics.inverse.task import POSE_ENTRIES, Candidates
from rvsim.kinematics.jacobian import jacobian
from rvsim.robot import Robot
from rvsim.spatial import rotation_error
from rvsim.spatial.arrays import FloatArray

RESIDUAL = 1e-9  # a branch whose forward kinematics is further off than this is none
_POLISH = 1e-4  # a residual up to here is rounding worth one Newton step
_HERE = 1e-3  # [rad, m] a branch further from where the arm is, is another
_EXACT = 1e-9  # [rad, m] a branch so close to where the arm is needs no help
_AT_STOP = 1e-7  # [rad, m] so far beyond its stop a joint may be by rounding


def residuals(robot: Robot, q: FloatArray, found: Candidates) -> FloatArray:
    """(b,) the largest entry of |FK − T| of those that count."""
    difference = np.abs(forward_kinematics(robot, q) - found.T_goal)
    counted = difference if found.entries == POSE_ENTRIES else difference[:, :3, 3:]
    return np.asarray(counted.max(axis=(1, 2), initial=0.0))


def polished(robot: Robot, q: FloatArray, found: Candidates, here: FloatArray) -> FloatArray:
    """Branches (b, n) that are right within rounding; of two that FK cannot tell apart, that where the arm is."""
    residual = residuals(robot, q, found)
    for i in np.flatnonzero((residual > RESIDUAL) & (residual < _POLISH)):
        q[i] += _newton_step(robot, q[i], found)
    return _as_it_stands(robot, q, found, here)


def _newton_step(robot: Robot, q: FloatArray, found: Candidates, free: FloatArray | None = None) -> FloatArray:
    """(n,) towards the target; only joints that are `free` (n,) move."""
    T = forward_kinematics(robot, q)
    turn = rotation_error(T[:3, :3], found.T_goal[:3, :3])
    error = np.concatenate([found.T_goal[:3, 3] - T[:3, 3], turn])[: found.entries]
    J = jacobian(robot, q)[: found.entries]
    return np.asarray(np.linalg.pinv(J if free is None else J * free, rcond=1e-6) @ error)


def _as_it_stands(robot: Robot, q: FloatArray, found: Candidates, here: FloatArray) -> FloatArray:
    """The branch (of (b, n)) on which the arm stands, exactly as it stands there."""
    difference = q - here
    difference -= np.where(robot.is_revolute, TURN * np.rint(difference / TURN), 0.0)
    distance = np.abs(difference).max(axis=1, initial=0.0)
    nearest = int(np.argmin(distance)) if len(q) else 0
    if len(q) and _EXACT < distance[nearest] < _HERE and residuals(robot, here[None], found)[0] <= RESIDUAL:
        q[nearest] = here
    return q


def on_stops(robot: Robot, copies: LimitCopies, found: Candidates) -> LimitCopies:
    """Copies (b, n) that only rounding brings beyond a stop, put onto it; the other joints make up for it."""
    lower, upper = robot.limits.T
    over = np.maximum(lower - copies.q, copies.q - upper).max(axis=1, initial=-np.inf)
    for i in np.flatnonzero(~copies.within & (over <= _AT_STOP)):
        q = np.clip(copies.q[i], lower, upper)
        q = np.clip(q + _newton_step(robot, q, found, free=q == copies.q[i]), lower, upper)
        if residuals(robot, q[None], found)[0] <= RESIDUAL:
            copies.q[i], copies.within[i] = q, True
    return copies
