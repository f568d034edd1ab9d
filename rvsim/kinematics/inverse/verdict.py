"""Candidates become branches: checked by forward kinematics, doubles merged, each with its verdict."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rvsim.kinematics.inverse.chain import TURN
from rvsim.kinematics.inverse.continuum import are_continua
from rvsim.kinematics.inverse.copies import LimitCopies, limit_copies, limit_margins
from rvsim.kinematics.inverse.polish import RESIDUAL, on_stops, polished, residuals
from rvsim.kinematics.inverse.result import Branch
from rvsim.kinematics.inverse.task import Candidates
from rvsim.kinematics.jacobian import jacobian
from rvsim.robot import Robot
from rvsim.spatial.arrays import FloatArray

_SAME = 1e-5  # [rad, m] branches closer than this are one


def branches_of(robot: Robot, found: Candidates, here: FloatArray) -> list[Branch]:
    """The candidates that exist, are right and are not the double of another."""
    rows = np.flatnonzero(~np.isnan(found.q).any(axis=1))
    q = polished(robot, found.q[rows], found, here)
    copies = on_stops(robot, limit_copies(robot, q, here), found)
    residual = residuals(robot, copies.q, found)
    right = np.flatnonzero(residual <= RESIDUAL)
    # Of doubles, at a straight elbow for instance, one within the limits stands for both.
    right = right[np.lexsort((residual[right], ~copies.within[right]))]
    return _branches(robot, found, copies, residual, _singles(robot, q, right.tolist()), rows, here)


def _branches(
    robot: Robot,
    found: Candidates,
    copies: LimitCopies,
    residual: FloatArray,
    kept: list[int],
    rows: NDArray[np.intp],
    here: FloatArray,
) -> list[Branch]:
    """The verdicts of those that are kept, worked out together."""
    if not kept:
        return []
    q = copies.q[kept]
    J = jacobian(robot, q)
    sigma = np.linalg.svd(J, compute_uv=False).prod(axis=1)
    margins, distances = limit_margins(robot, q), np.abs(q - here).max(axis=1)
    endless = are_continua(robot, q, J, found.entries) | found.continuum
    return [
        Branch(
            q=q[k],
            label=found.labels[rows[i]],
            within_limits=bool(copies.within[i]),
            limit_margin=margins[k],
            residual=float(residual[i]),
            manipulability=float(sigma[k]),
            distance=float(distances[k]),
            continuum=bool(endless[k]),
        )
        for k, i in enumerate(kept)
    ]


def _singles(robot: Robot, q: FloatArray, preferred: list[int]) -> list[int]:
    """Indices of the branches (b, n) without doubles, of doubles the preferred one, in the order of the labels."""
    difference = q[:, None] - q
    difference -= np.where(robot.is_revolute, TURN * np.rint(difference / TURN), 0.0)
    same = (np.abs(difference).max(axis=2, initial=0.0) <= _SAME).tolist()
    kept: list[int] = []
    for i in preferred:
        if not any(same[i][k] for k in kept):
            kept.append(i)
    return sorted(kept)
