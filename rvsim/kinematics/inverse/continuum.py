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
_STRIDE = 1e-2
_CORRECTIONS = 12


def are_continua(robot: Robot, q: FloatArray, J: FloatArray, entries: int) -> NDArray[np.bool_]:
    """(b,) which of the poses q (b, n), with their Jacobians J (b, 6, n), are one of infinitely many each."""
    if robot.dof > entries:
        return np.zeros(len(q), dtype=bool)  # by the task's nature there are always more: that is not worth a word
    singular = np.linalg.svd(J[:, :entries], compute_uv=False)[:, -1] <= _SINGULAR
    return np.array([bool(singular[i]) and _is_continuum(robot, q[i], J[i, :entries], entries) for i in range(len(q))])


def _is_continuum(robot: Robot, q: FloatArray, J: FloatArray, entries: int) -> bool:
    """Whether the arm can move away from q (n,) and keep the tool, at a singular pose with the Jacobian J
    (entries, n): entries = 6 its pose, 3 its place only.

    Asked by doing it: a stride along the motion the Jacobian does not see, then Newton back onto the pose. A singular
    pose that stands alone (a straight elbow) is pulled back to where it was; on a continuum it is not.
    """
    Vt = np.linalg.svd(J)[2]
    goal, moved = forward_kinematics(robot, q), q + _STRIDE * Vt[-1]
    for _ in range(_CORRECTIONS):
        T = forward_kinematics(robot, moved)
        error = np.concatenate([goal[:3, 3] - T[:3, 3], rotation_error(T[:3, :3], goal[:3, :3])])[:entries]
        moved = moved + np.linalg.pinv(jacobian(robot, moved)[:entries], rcond=1e-9) @ error
    return bool(np.abs(moved - q).max() > 0.1 * _STRIDE and np.abs(error).max() < 1e-9)
