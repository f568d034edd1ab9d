"""Candidates become branches: checked by forward kinematics, doubles merged, each with its verdict."""

from __future__ import annotations

import numpy as np

from rvsim.kinematics.forward import forward_kinematics
from rvsim.kinematics.inverse.chain import TURN
from rvsim.kinematics.inverse.continuum import is_continuum
from rvsim.kinematics.inverse.copies import limit_copies, limit_margins
from rvsim.kinematics.inverse.result import Branch
from rvsim.kinematics.inverse.task import POSE_ENTRIES, Candidates
from rvsim.kinematics.jacobian import jacobian
from rvsim.robot import Robot
from rvsim.spatial import rotation_error
from rvsim.spatial.arrays import FloatArray

RESIDUAL = 1e-9  # a branch whose forward kinematics is further off than this is none
_SAME = 1e-5  # [rad, m] branches closer than this are one
_POLISH = 1e-4  # a residual up to here is rounding worth one Newton step


def _residuals(robot: Robot, q: FloatArray, found: Candidates) -> FloatArray:
    """(b,) the largest entry of |FK − T| of those that count."""
    difference = np.abs(forward_kinematics(robot, q) - found.T_goal)
    counted = difference if found.entries == POSE_ENTRIES else difference[:, :3, 3:]
    return np.asarray(counted.max(axis=(1, 2), initial=0.0))


def _polished(robot: Robot, q: FloatArray, found: Candidates) -> FloatArray:
    """One Newton step for branches (b, n) that rounding has moved a little."""
    residual = _residuals(robot, q, found)
    for i in np.flatnonzero((residual > RESIDUAL) & (residual < _POLISH)):
        T = forward_kinematics(robot, q[i])
        turn = rotation_error(T[:3, :3], found.T_goal[:3, :3])
        error = np.concatenate([found.T_goal[:3, 3] - T[:3, 3], turn])[: found.entries]
        q[i] += np.linalg.pinv(jacobian(robot, q[i])[: found.entries], rcond=1e-6) @ error
    return q


def branches_of(robot: Robot, found: Candidates, here: FloatArray) -> list[Branch]:
    """The candidates that exist, are right and are not the double of another."""
    rows = np.flatnonzero(~np.isnan(found.q).any(axis=1))
    q = _polished(robot, found.q[rows], found)
    copies = limit_copies(robot, q, here)
    residual = _residuals(robot, copies.q, found)
    right = np.flatnonzero(residual <= RESIDUAL)
    # Of doubles, at a straight elbow for instance, one within the limits stands for both.
    right = right[np.lexsort((residual[right], ~copies.within[right]))]
    return [
        _branch(
            robot, found, found.labels[rows[i]], copies.q[i], float(residual[i]), here, within=bool(copies.within[i])
        )
        for i in _singles(robot, q, right.tolist())
    ]


def _branch(
    robot: Robot, found: Candidates, label: str, q: FloatArray, residual: float, here: FloatArray, *, within: bool
) -> Branch:
    sigma = np.linalg.svd(jacobian(robot, q), compute_uv=False)
    return Branch(
        q=q,
        label=label,
        within_limits=within,
        limit_margin=limit_margins(robot, q),
        residual=residual,
        manipulability=float(sigma.prod()),
        distance=float(np.abs(q - here).max()),
        continuum=found.continuum or is_continuum(robot, q, found.entries),
    )


def _singles(robot: Robot, q: FloatArray, preferred: list[int]) -> list[int]:
    """Indices of the branches (b, n) without doubles, of doubles the preferred one, in the order of the labels."""
    kept: list[int] = []
    for i in preferred:
        difference = q[kept] - q[i]
        difference -= np.where(robot.is_revolute, TURN * np.rint(difference / TURN), 0.0)
        if not (np.abs(difference).max(axis=1, initial=0.0) <= _SAME).any():
            kept.append(i)
    return sorted(kept)
