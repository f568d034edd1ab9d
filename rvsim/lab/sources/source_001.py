"""Errata of source 001 (RV-1A)."""

from __future__ import annotations

import numpy as np

from rvsim.kinematics import link_transforms
from rvsim.lab.sources.arms import at_place, degrees, place
from rvsim.lab.sources.erratum import Erratum
from rvsim.language import tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.spatial import inverse_transform

_POSE = degrees(20, 70, 25, 40, 50, -30)


def left_of_3(robot: Robot, q: FloatArray) -> FloatArray:
    """The left side of (3): ⁰T1 ⁰T6."""
    T = link_transforms(robot, q)
    return np.asarray(inverse_transform(T[0]) @ T[1] @ inverse_transform(T[0]) @ T[6])


def _right_of_3(robot: Robot, q: FloatArray) -> FloatArray:
    """Its right side, ¹T2 … ⁵T6."""
    T = link_transforms(robot, q)
    return np.asarray(inverse_transform(T[1]) @ T[6])


def wrist_centre(robot: Robot, q: FloatArray) -> FloatArray:
    """(3,) P4, which by (5) is P6."""
    return np.asarray(link_transforms(robot, q)[4, :3, 3])


ERRATA_001 = (
    Erratum(
        "001-3",
        "001",
        "(3)",
        "rv-1a",
        "inverse",
        tr_later("A transform that should be inverted"),
        (r"{}^{0}T_1\; {}^{0}T_6 = {}^{1}T_2 \cdots {}^{5}T_6",),
        (r"({}^{0}T_1)^{-1}\; {}^{0}T_6 = {}^{1}T_2 \cdots {}^{5}T_6",),
        tr_later("To bring ⁰T1 to the other side of (2) it must be inverted. Shown: the left sides."),
        _POSE,
        "transform",
        left_of_3,
        _right_of_3,
        columns=("n", "o", "a", "p"),
    ),
    Erratum(
        "001-5",
        "001",
        "(5)",
        "rv-1a",
        "inverse",
        tr_later("The flange is not at the wrist's centre"),
        (r"P_6 = P_5 = P_4",),
        (r"P_6 = P_4 + d_6\, a,\quad P_5 = P_4",),
        tr_later("Only frames 4 and 5 share the point where the wrist's axes meet; frame 6 is d₆ = 179 mm further on."),
        _POSE,
        "length",
        wrist_centre,
        place,
        rows=("x", "y", "z"),
        tool=lambda robot, q: at_place(robot, q, wrist_centre(robot, q)),
    ),
)
