"""Errata of source 003 (RRRP)."""

from __future__ import annotations

import math

import numpy as np

from rvsim.kinematics import forward_kinematics
from rvsim.lab.sources import printed
from rvsim.lab.sources.arms import at_place, degrees, joint, place, tool_with
from rvsim.lab.sources.erratum import Erratum
from rvsim.language import tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_SAMPLE_0 = (*degrees(-90, 0, -90), 1.0)  # of the source's own path


def waist(robot: Robot, q: FloatArray) -> float:
    """θ1 of the text at the tool's place."""
    x, y, _ = place(robot, q)
    return printed.waist_003(float(x), float(y))


def roll(robot: Robot, q: FloatArray) -> float:
    """θ3 of the program for the tool's rotation; its θ1 comes from atan2, within ±π."""
    n, o = forward_kinematics(robot, q)[:3, :2].T
    hand = printed.Hand(float(n[0]), float(n[1]), float(o[0]), float(o[1]))
    return printed.roll_003(math.remainder(float(q[0]), math.tau), hand)


def extension(robot: Robot, q: FloatArray) -> float:
    """l6 from the height, as printed."""
    height = float(place(robot, q)[2] - robot.T_base_0[2, 3] - robot.dh[0, 1])
    return printed.extension_003(height, float(q[1]), float(robot.dh[1, 2]), float(robot.dh[2, 1]) + _fixed(robot))


def _fixed(robot: Robot) -> float:
    """l7, where the table has it in the last row."""
    return float(robot.dh[3, 1])


def program_place(robot: Robot, q: FloatArray, l5: float) -> FloatArray:
    """(3,) xactual, yactual, zactual of the program with this l5."""
    l7 = float(robot.dh[2, 1]) + _fixed(robot)
    base = robot.T_base_0[:3, 3] + np.array([0.0, 0.0, robot.dh[0, 1]])
    c2, s2, out = math.cos(q[1]), math.sin(q[1]), float(q[3]) + l7
    level = l5 * c2 - s2 * out
    return np.asarray(base + np.array([level * math.cos(q[0]), level * math.sin(q[0]), c2 * out + l5 * s2]))


def fifteen(robot: Robot, q: FloatArray) -> FloatArray:
    """(3,) the same with 15 in place of l5, as printed."""
    return program_place(robot, q, 15.0)


ERRATA_003 = (
    Erratum(
        "003-t1",
        "003",
        tr_later("θ₁ in the text"),
        "rrrp",
        "inverse",
        tr_later("The waist seen from the wrong origin"),
        (r"\theta_1 = \tan^{-1}\left(\frac{P_y}{P_x}\right)",),
        (r"\theta_1 = \operatorname{atan2}(P_y - l_2,\, P_x - l_1)",),
        tr_later(
            "The arm stands at (l₁, l₂), and tan⁻¹ of a ratio knows half of all directions only; the program has it "
            "right."
        ),
        _SAMPLE_0,
        "angle",
        waist,
        joint(0),
        rows=("θ₁",),
        tool=tool_with(0, waist),
        undefined=tr_later("The printed formula has no value here: Px is 0."),
    ),
    Erratum(
        "003-t3",
        "003",
        tr_later("θ₃ in the program"),
        "rrrp",
        "inverse",
        tr_later("Radians given to cosd and sind"),
        (
            r"C_1 = \mathrm{cosd}(\theta_1),\quad S_1 = \mathrm{sind}(\theta_1)",
            r"\theta_3 = \operatorname{atan2d}(S_1 n_x - C_1 n_y,\, S_1 o_x - C_1 o_y)",
        ),
        (
            r"C_1 = \cos\theta_1,\quad S_1 = \sin\theta_1",
            r"\theta_3 = \operatorname{atan2}(S_1 n_x - C_1 n_y,\, S_1 o_x - C_1 o_y)",
        ),
        tr_later(
            "θ₁ is in radians, cosd and sind want degrees. While θ₂ = 0 the place stays right, so that no plot "
            "shows it."
        ),
        _SAMPLE_0,
        "angle",
        roll,
        joint(2),
        rows=("θ₃",),
        tool=tool_with(2, roll),
    ),
    Erratum(
        "003-l6",
        "003",
        tr_later("l₆ in the program"),
        "rrrp",
        "inverse",
        tr_later("An extension divided by cos θ₂"),
        (r"l_6 = \frac{P_z - l_3 - l_4 - l_5 S_2}{C_2} - l_7",),
        (r"l_6 = (p - l_5 u) \cdot a - l_7",),
        tr_later(
            "At θ₂ = ±90° the tool is level and its height says nothing of the extension; measured along the tool's "
            "axis a (u points along l₅) nothing is divided."
        ),
        (*degrees(-90, 90, -90), 1.0),
        "length",
        extension,
        joint(3),
        rows=("l₆",),
        tool=tool_with(3, extension),
        undefined=tr_later("The printed formula has no value here: C₂ is 0."),
    ),
    Erratum(
        "003-15",
        "003",
        tr_later("xactual to zactual"),
        "rrrp",
        "frames",
        tr_later("15 printed for l₅"),
        (r"x = 15 \cos\theta_1 \cos\theta_2 - \cos\theta_1 \sin\theta_2 (l_6 + l_7) + l_1",),
        (r"x = l_5 \cos\theta_1 \cos\theta_2 - \cos\theta_1 \sin\theta_2 (l_6 + l_7) + l_1",),
        tr_later("The letter l looks like the digit 1; copied as printed, the arm is 15 units long."),
        _SAMPLE_0,
        "length",
        fifteen,
        place,
        rows=("x", "y", "z"),
        tool=lambda robot, q: at_place(robot, q, fifteen(robot, q)),
    ),
)
