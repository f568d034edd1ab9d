"""Pieces that the printed formulas share: an arm's own angles and lengths, and small matrices."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rvsim.kinematics import forward_kinematics, link_transforms
from rvsim.lab.sources.erratum import Evaluate
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray


def degrees(*angles: float) -> tuple[float, ...]:
    """A pose of the text in radians."""
    return tuple(float(angle) for angle in np.radians(angles))


def dh_angles(robot: Robot, q: FloatArray) -> FloatArray:
    """(n,) the angles of the DH table: the joint variable plus its offset."""
    return np.asarray(robot.dh[:, 0] + q)


def flange(robot: Robot, q: FloatArray) -> FloatArray:
    """T (4, 4) of the last frame of the table."""
    return np.asarray(link_transforms(robot, q)[-1])


def place(robot: Robot, q: FloatArray) -> FloatArray:
    """(3,) its origin."""
    return flange(robot, q)[:3, 3]


def at_place(robot: Robot, q: FloatArray, position: FloatArray) -> FloatArray:
    """T (4, 4) of the tool moved to another place, turned as it is."""
    T = np.array(forward_kinematics(robot, q))
    T[:3, 3] = position
    return T


def tool_with(joint: int, angle: Evaluate) -> Evaluate:
    """Where the tool is when that joint (from 0) is set to what a printed formula gives."""

    def tool(robot: Robot, q: FloatArray) -> FloatArray:
        changed = np.array(q)
        changed[joint] = angle(robot, q)
        return np.asarray(forward_kinematics(robot, changed)) if np.isfinite(changed).all() else np.full((4, 4), np.nan)

    return tool


def joint(index: int) -> Evaluate:
    """The joint's own value (from 0): what a closed form must give back."""
    return lambda _robot, q: q[index]


class Planar(NamedTuple):
    """The arm in its vertical plane: how far out and how high above the shoulder the wrist is [m], and two lengths."""

    out: float
    up: float
    a2: float
    a3: float


def planar(robot: Robot, q: FloatArray) -> Planar:
    """Of the RV-M1 (rows 2 and 3) or the AL5B (rows 3 and 4): upper arm, forearm, and where the wrist is."""
    a2, a3 = (float(robot.dh[row, 2]) for row in ((1, 2) if robot.convention == "standard" else (2, 3)))
    second, third = float(q[1]), float(q[1] + q[2])
    out = a2 * np.cos(second) + a3 * np.cos(third)
    return Planar(float(out), float(a2 * np.sin(second) + a3 * np.sin(third)), a2, a3)


def rotation_and_place(rows: list[list[float]]) -> FloatArray:
    """(4, 4) of three rows of four numbers."""
    return np.array([*rows, [0.0, 0.0, 0.0, 1.0]])
