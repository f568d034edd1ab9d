"""Whether a solution is one of infinitely many."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rvsim.kinematics.forward import forward_kinematics
from rvsim.kinematics.jacobian import jacobian
from rvsim.robot import Robot
from rvsim.spatial import rotation_error
from rvsim.spatial.arrays import FloatArray

_SINGULAR = 1e-7
_SHARE = 0.1  # joints that hardly take part lead nowhere
_STRIDE = 1e-2
_CORRECTIONS = 12


def are_continua(robot: Robot, q: FloatArray, J: FloatArray, entries: int) -> NDArray[np.bool_]:
    """(b,) which of the poses q (b, n), with their Jacobians J (b, 6, n), are one of infinitely many each."""
    if robot.dof > entries:
        return np.zeros(len(q), dtype=bool)  # by the task's nature there are always more: that is not worth a word
    lost = np.linalg.svd(J[:, :entries], compute_uv=False) <= _SINGULAR
    return np.array([bool(row.any()) and _is_continuum(robot, q[i], J[i], entries) for i, row in enumerate(lost)])


def _is_continuum(robot: Robot, q: FloatArray, J: FloatArray, entries: int) -> bool:
    """Whether the arm can move away from q (n,) and keep the tool, at a singular pose with the Jacobian J (6, n).

    Asked of every motion of its own that the Jacobian does not see: where two things are singular at once, a straight
    elbow may stand alone while the waist is free.
    """
    return any(_leads_away(robot, q, motion, entries) for motion in _unseen_motions(J[:entries]))


def _unseen_motions(J: FloatArray) -> FloatArray:
    """(k, n) unit motions of the joints that J (m, n) does not see: a basis, and each joint's share in them."""
    _, sigma, Vt = np.linalg.svd(J)
    basis = Vt[np.count_nonzero(sigma > _SINGULAR) :]
    if len(basis) == 1:
        return basis
    shares = basis.T @ basis
    lengths = np.linalg.norm(shares, axis=1)
    there = lengths > _SHARE
    return np.concatenate([basis, shares[there] / lengths[there, None]])


def _leads_away(robot: Robot, q: FloatArray, motion: FloatArray, entries: int) -> bool:
    """Whether a stride along a motion (n,), then Newton back onto the pose, ends elsewhere: entries = 6 keeps the
    pose, 3 the place only. A singular pose that stands alone is pulled back to where it was."""
    goal, moved = forward_kinematics(robot, q), q + _STRIDE * motion
    for _ in range(_CORRECTIONS):
        T = forward_kinematics(robot, moved)
        error = np.concatenate([goal[:3, 3] - T[:3, 3], rotation_error(T[:3, :3], goal[:3, :3])])[:entries]
        moved = moved + np.linalg.pinv(jacobian(robot, moved)[:entries], rcond=1e-9) @ error
    return bool(np.abs(moved - q).max() > 0.1 * _STRIDE and np.abs(error).max() < 1e-9)
