"""Errata of source 000 (RV-M1): frames, forward kinematics and the programs about them."""

from __future__ import annotations

import math

import numpy as np

from rvsim.kinematics import dh_transform, forward_by_exponentials, forward_kinematics, link_transforms
from rvsim.lab.sources.arms import at_place, degrees, dh_angles, flange, place, rotation_and_place
from rvsim.lab.sources.erratum import Erratum
from rvsim.language import tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.spatial import inverse_transform, rot_x, rot_z, transform, translation

TEXT_POSE = degrees(30, 40, -50, 20, 60)
TOOL_DOWN_POSE = degrees(30, 40, -80, -50, 0)
_TWIST = 0.7  # of the link that shows (2) and (4) [rad]: with a right angle half of its entries are 0
_ARM = ("000", "rv-m1")
_T_COLUMNS = ("n", "o", "a", "p")


def craig_table(robot: Robot, q: FloatArray) -> FloatArray:
    """⁰T5 by (3), a modified link, with the rows of Figure 5, which are those of a standard table."""
    links = dh_transform(dh_angles(robot, q), robot.dh[:, 1], robot.dh[:, 2], robot.dh[:, 3], "modified")
    return np.asarray(np.linalg.multi_dot(list(links)))


def _about(matrix: FloatArray) -> FloatArray:
    return transform(matrix, np.zeros(3))


def _general_row(robot: Robot, q: FloatArray) -> tuple[float, float, float, float]:
    """A row without zeros: θ1 and d1 of the table, a2, and a twist that is no right angle."""
    return float(dh_angles(robot, q)[0]), float(robot.dh[0, 1]), float(robot.dh[1, 2]), _TWIST


def printed_inverse_product(robot: Robot, q: FloatArray) -> FloatArray:
    """(2) of a link without zeros: Tz(−d) Rz(θ) Tx(a) Rx(−α)."""
    theta, d, a, alpha = _general_row(robot, q)
    along_z, along_x = translation([0.0, 0.0, -d]), translation([a, 0.0, 0.0])
    return np.asarray(along_z @ _about(rot_z(theta)) @ along_x @ _about(rot_x(-alpha)))


def _inverse_link(robot: Robot, q: FloatArray) -> FloatArray:
    theta, d, a, alpha = _general_row(robot, q)
    return np.asarray(inverse_transform(dh_transform(theta, d, a, alpha, "modified")))


def printed_inverse_block(_robot: Robot, q: FloatArray) -> FloatArray:
    """The rotation (3, 3) of (4) with θ1 and a twist of 0.7 rad, its entry [2, 3] −sα cθ."""
    (c, s), (ca, sa) = (math.cos(q[0]), math.sin(q[0])), (math.cos(_TWIST), math.sin(_TWIST))
    return np.array([[c, ca * s, sa * s], [-s, ca * c, -sa * c], [0.0, -sa, ca]])


def _inverse_block(_robot: Robot, q: FloatArray) -> FloatArray:
    return np.asarray(rot_z(q[0]).T @ rot_x(_TWIST).T)


def gripper_twice(robot: Robot, q: FloatArray) -> FloatArray:
    """(8): ⁰T5 with d5 = 72 mm times ⁵T6(d_G) with the same 72 mm once more."""
    return np.asarray(flange(robot, q) @ translation([0.0, 0.0, float(robot.dh[4, 1])]))


def clockwise(robot: Robot, q: FloatArray) -> FloatArray:
    """(9), every element as printed, θ4 and θ5 being the angles of the table."""
    t1, t2, t3, t4, t5 = dh_angles(robot, q)
    d1, a2, a3, d_g = robot.dh[0, 1], robot.dh[1, 2], robot.dh[2, 2], robot.dh[4, 1]
    (c1, s1), (c5, s5) = (np.cos(t1), np.sin(t1)), (np.cos(t5), np.sin(t5))
    c234, s234 = np.cos(t2 + t3 + t4), np.sin(t2 + t3 + t4)
    out = a2 * np.cos(t2) + a3 * np.cos(t2 + t3) + d_g * s234
    up = d1 - d_g * c234 + a2 * np.sin(t2) + a3 * np.sin(t2 + t3)
    return rotation_and_place(
        [
            [c1 * c5 * c234 - s1 * s5, -c1 * s5 * c234 - s1 * c5, c1 * s234, c1 * out],
            [-s1 * c5 * c234 - c1 * s5, s1 * s5 * c234 - c1 * c5, -s1 * s234, -s1 * out],
            [c5 * s234, -s5 * s234, -c234, up],
        ]
    )


def program_6(robot: Robot, q: FloatArray) -> float:
    """How far apart the two ways of Program 6 are: one adds the offsets of the table, the toolbox ignores them."""
    return float(np.linalg.norm(place(robot, q - robot.dh[:, 0]) - place(robot, q)))


def _two_ways(robot: Robot, q: FloatArray) -> float:
    return float(np.linalg.norm(forward_kinematics(robot, q)[:3, 3] - forward_by_exponentials(robot, q)[:3, 3]))


def program_8(robot: Robot, q: FloatArray) -> FloatArray:
    """(3,) where Programs 8 and 9 draw the tip: the offsets once more, then 72 mm off x and z."""
    return np.asarray(place(robot, q + robot.dh[:, 0]) - np.array([0.072, 0.0, 0.072]))


ERRATA_000_FRAMES = (
    Erratum(
        "000-3",
        _ARM[0],
        tr_later("(1), (3) and Figure 5"),
        _ARM[1],
        "frames",
        tr_later("A modified link matrix with a standard table"),
        (r"{}^{i-1}T_i = T_x(a_{i-1})\,R_x(\alpha_{i-1})\,T_z(d_i)\,R_z(\theta_i)",),
        (r"{}^{i-1}T_i = R_z(\theta_i)\,T_z(d_i)\,T_x(a_i)\,R_x(\alpha_i)",),
        tr_later(
            "Figure 5 and Program 2 are standard DH, (1) and (3) are Craig's modified form: with the table in (3) "
            "the tool comes out elsewhere."
        ),
        TEXT_POSE,
        "transform",
        craig_table,
        flange,
        columns=_T_COLUMNS,
        tool=craig_table,
    ),
    Erratum(
        "000-2",
        _ARM[0],
        "(2)",
        _ARM[1],
        "frames",
        tr_later("The inverse of a link is no inverse"),
        (r"({}^{i-1}T_i)^{-1} = T_z(-d_i)\,R_z(\theta_i)\,T_x(a_{i-1})\,R_x(-\alpha_{i-1})",),
        (r"({}^{i-1}T_i)^{-1} = R_z(-\theta_i)\,T_z(-d_i)\,R_x(-\alpha_{i-1})\,T_x(-a_{i-1})",),
        tr_later(
            "An inverse takes the factors of (1) in the opposite order, each inverted. Shown with θ₁, d₁, a₂ and a "
            "twist of 0.7 rad."
        ),
        TEXT_POSE,
        "transform",
        printed_inverse_product,
        _inverse_link,
        columns=_T_COLUMNS,
    ),
    Erratum(
        "000-4",
        _ARM[0],
        "(4)",
        _ARM[1],
        "frames",
        tr_later("A wrong sign in the inverse matrix"),
        (r"(4)_{23} = -\sin\alpha_{i-1}\cos\theta_i",),
        (r"(4)_{23} = +\sin\alpha_{i-1}\cos\theta_i",),
        tr_later(
            "With the printed sign the block is no rotation: its determinant is not 1. Shown with θ₁ and α = 0.7 rad."
        ),
        (0.5, *TEXT_POSE[1:]),
        "number",
        printed_inverse_block,
        _inverse_block,
    ),
    Erratum(
        "000-8",
        _ARM[0],
        tr_later("(7) and (8)"),
        _ARM[1],
        "frames",
        tr_later("The hand's 72 mm counted twice"),
        (r"{}^{0}T_6 = {}^{0}T_5(d_5)\,{}^{5}T_6(d_G)", r"d_5 = d_G = 72"),
        (r"{}^{0}T_6 = {}^{0}T_5(d_5)",),
        tr_later(
            "Figure 5 has d₅ = 72 mm already, so that frame 5 is at the finger tips; one of the two lengths, never "
            "both."
        ),
        TEXT_POSE,
        "transform",
        gripper_twice,
        flange,
        columns=_T_COLUMNS,
        tool=gripper_twice,
    ),
    Erratum(
        "000-9",
        _ARM[0],
        "(9)",
        _ARM[1],
        "frames",
        tr_later("The waist counted clockwise"),
        (r"x_G = c_1(a_2 c_2 + a_3 c_{23} + d_G s_{234})", r"y_G = -s_1(a_2 c_2 + a_3 c_{23} + d_G s_{234})"),
        (r"x_G = c_1(a_2 c_2 + a_3 c_{23} + d_G s_{234})", r"y_G = s_1(a_2 c_2 + a_3 c_{23} + d_G s_{234})"),
        tr_later(
            "(9) is the DH table with θ₁ replaced by −θ₁: clockwise is positive there, while the table and the "
            "programs turn the right-handed way."
        ),
        TEXT_POSE,
        "transform",
        clockwise,
        flange,
        columns=_T_COLUMNS,
        tool=clockwise,
    ),
    Erratum(
        "000-P6",
        _ARM[0],
        tr_later("Program 6"),
        _ARM[1],
        "frames",
        tr_later("“Error 0” between two ways that differ"),
        (r"e = |p(\theta + \mathrm{offsets}) - p(\theta)|",),
        (r"e = |p(\theta) - p(\theta)| = 0",),
        tr_later(
            "The offsets +90° and −90° of the table are added in one of the two ways only; the text reports 0, its "
            "own program gives 1.018 dm."
        ),
        TEXT_POSE,
        "length",
        program_6,
        _two_ways,
    ),
    Erratum(
        "000-P8",
        _ARM[0],
        tr_later("Programs 8 and 9"),
        _ARM[1],
        "frames",
        tr_later("Offsets twice, then a shift of 72 mm"),
        (r"p = p(\theta + \mathrm{offsets}) - (0.72,\,0,\,0.72)\,\mathrm{dm}",),
        (r"p = p(\theta)",),
        tr_later(
            "The solver's angles have the offsets in them already; the shift repairs that only for a tool that "
            "points down at azimuth 0."
        ),
        TOOL_DOWN_POSE,
        "length",
        program_8,
        place,
        rows=("x", "y", "z"),
        tool=lambda robot, q: at_place(robot, q, program_8(robot, q)),
    ),
    Erratum(
        "000-P5",
        _ARM[0],
        tr_later("Programs 5 and 6"),
        _ARM[1],
        "frames",
        tr_later("An elbow outside the source's own limits"),
        (r"\theta_3 = 90^\circ,\quad \theta_3 = 60^\circ",),
        (r"-110^\circ \le \theta_3 \le 0^\circ",),
        tr_later("Section 3 of the source gives the elbow −110° to 0°; the poses of its own examples cannot be taken."),
        TEXT_POSE,
    ),
    Erratum(
        "000-P15",
        _ARM[0],
        tr_later("Program 15"),
        _ARM[1],
        "path",
        tr_later("Two boxes exchanged, and boxes that do nothing"),
        (r"\theta_5 = \mathrm{edit10},\quad \theta_4 = \mathrm{edit11}",),
        (),
        tr_later("Box 10 is read into θ₅ and box 11 into θ₄; “Track Trajectory” ignores the boxes of the line."),
        TEXT_POSE,
    ),
    Erratum(
        "000-plots",
        _ARM[0],
        tr_later("Programs 1, 10 and 11"),
        _ARM[1],
        "frames",
        tr_later("Metres on axes that are decimetres"),
        (r"X\,(\mathrm{m}),\quad Y\,(\mathrm{m}),\quad Z\,(\mathrm{m})",),
        (),
        tr_later(
            "All lengths are divided by 100 mm, so the axes are decimetres; X and Y are reversed on the display only."
        ),
        TEXT_POSE,
    ),
)


def wrist(robot: Robot, q: FloatArray) -> FloatArray:
    """(3,) where frame 4 is: the wrist of (11)."""
    return np.asarray(link_transforms(robot, q)[4, :3, 3])
