"""Errata of source 004 (AL5B): frames, forward and inverse kinematics."""

from __future__ import annotations

import math

import numpy as np

from rvsim.kinematics import dh_transform, joint_transforms, link_transforms
from rvsim.lab.sources import printed
from rvsim.lab.sources.arms import at_place, degrees, dh_angles, flange, joint, place, planar, tool_with
from rvsim.lab.sources.erratum import Erratum
from rvsim.language import tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

TEXT_POSE = degrees(25, 60, -70, -35, 40)
_T_COLUMNS = ("n", "o", "a", "p")
_TURN = 0.7  # the twist that shows (2.2) [rad]


def _forearm(robot: Robot, q: FloatArray) -> tuple[float, float, float]:
    return float(q[2]), float(robot.dh[2, 2]), _TURN


def link_2_2(robot: Robot, q: FloatArray) -> FloatArray:
    """(2.2) with θ3, a3 and a twist: a·sin α in the second row."""
    theta, a, alpha = _forearm(robot, q)
    A = np.array(dh_transform(theta, 0.0, a, alpha, "standard"))
    A[1, 3] = a * math.sin(alpha)
    return A


def _link(robot: Robot, q: FloatArray) -> FloatArray:
    theta, a, alpha = _forearm(robot, q)
    return dh_transform(theta, 0.0, a, alpha, "standard")


def base_3_8(robot: Robot, q: FloatArray) -> FloatArray:
    """⁰T1 of (3.8), third row 0 1 0 d1."""
    A = np.array(joint_transforms(robot, q)[0])
    A[2] = [0.0, 1.0, 0.0, robot.dh[0, 1]]
    return A


def roll_3_12(robot: Robot, q: FloatArray) -> FloatArray:
    """⁴T5 of (3.12), third row s5 c5 0 0."""
    A = np.array(joint_transforms(robot, q)[4])
    A[2] = [math.sin(q[4]), math.cos(q[4]), 0.0, 0.0]
    return A


def gripper_3_13(_robot: Robot, q: FloatArray) -> FloatArray:
    """The gripper's transform of (3.13), which turns by θ5 again."""
    return dh_transform(q[4], 0.0, 0.0, 0.0, "modified")


def orientation_3_15(robot: Robot, q: FloatArray) -> FloatArray:
    """⁰T5 of (3.15) to (3.18), θ4 being the angle of the table; the halves of o_z, which stand exchanged, in order."""
    theta = dh_angles(robot, q)
    (c1, s1), (c5, s5) = ((np.cos(theta[i]), np.sin(theta[i])) for i in (0, 4))
    pitch = theta[1] + theta[2] + theta[3]
    c234, s234 = np.cos(pitch), np.sin(pitch)
    T = np.array(flange(robot, q))
    T[:3, 0] = [c1 * c234 * c5 + s1 * s5, s1 * c234 * c5 - c1 * s5, s234 * c5]
    T[:3, 1] = [-c1 * c234 * s5 + s1 * c5, -s1 * c234 * s5 - c1 * c5, -s234 * s5]
    return T


def _reach(robot: Robot, q: FloatArray) -> tuple[float, float, float]:
    """How far out and how high the tool is [m], and its pitch ψ."""
    x, y, z = place(robot, q)
    pitch = float(q[1] + q[2] + q[3])
    out = float(x * math.cos(q[0]) + y * math.sin(q[0]))
    return out, float(z), pitch


def wrist_3_21(robot: Robot, q: FloatArray) -> FloatArray:
    """(2,) r4 and z4 of (3.21), a5 being what the table has in its last row: 0."""
    out, height, pitch = _reach(robot, q)
    a5 = float(robot.dh[4, 2])
    return np.array([out - a5 * math.cos(pitch), height - a5 * math.sin(pitch)])


def _wrist(robot: Robot, q: FloatArray) -> FloatArray:
    x, y, z = link_transforms(robot, q)[4, :3, 3]
    return np.array([x * math.cos(q[0]) + y * math.sin(q[0]), z])


def _square(robot: Robot, q: FloatArray) -> tuple[float, float, float]:
    out, up, a3, a4 = planar(robot, q)
    return out * out + up * up, a3, a4


def beta_3_22(robot: Robot, q: FloatArray) -> float:
    """β of (3.22)."""
    return printed.beta_004(*_square(robot, q))


def _beta(robot: Robot, q: FloatArray) -> float:
    """The angle between the upper arm and the line from shoulder to wrist."""
    out, up, *_ = planar(robot, q)
    return abs(math.remainder(math.atan2(up, out) - float(q[1]), math.tau))


def shoulder_3_23(robot: Robot, q: FloatArray) -> float:
    """θ2 of (3.23) with β of (3.22), with the sign that is right for the true β."""
    out, up, *_ = planar(robot, q)
    alpha = math.atan2(up, out)
    return alpha + math.copysign(beta_3_22(robot, q), math.remainder(float(q[1]) - alpha, math.tau))


def elbow_3_23(robot: Robot, q: FloatArray) -> float:
    """θ3 of (3.23)."""
    return printed.elbow_004(*_square(robot, q))


def height_3_26(robot: Robot, q: FloatArray) -> float:
    """z of (3.26), with d5 c234."""
    _, up, *_ = planar(robot, q)
    _, _, pitch = _reach(robot, q)
    return float(robot.dh[4, 1] * math.cos(pitch) + up + robot.dh[0, 1])


def _with_height(robot: Robot, q: FloatArray) -> FloatArray:
    return at_place(robot, q, np.array([*place(robot, q)[:2], height_3_26(robot, q)]))


def cosine_3_29(robot: Robot, q: FloatArray) -> float:
    """c3 of (3.29), the root drawn over −d5 c234 too; NaN where it is not real."""
    x, y, z = place(robot, q)
    d1, d5, (*_, pitch), (_, _, a3, a4) = robot.dh[0, 1], robot.dh[4, 1], _reach(robot, q), planar(robot, q)
    side = printed.root(float(x * x + y * y - d5 * math.cos(pitch)))
    height = z - d5 * math.sin(pitch) - d1
    return float((height * height + side * side - a3 * a3 - a4 * a4) / (2.0 * a3 * a4))


_FRAMES = (
    Erratum(
        "004-2.2",
        "004",
        "(2.2)",
        "al5b",
        "frames",
        tr_later("A sine of the wrong angle"),
        (r"(2.2)_{24} = a_i \sin\alpha_i",),
        (r"(2.2)_{24} = a_i \sin\theta_i",),
        tr_later("The link a is carried round by θ. Shown with θ₃, a₃ and a twist of 0.7 rad."),
        TEXT_POSE,
        "transform",
        link_2_2,
        _link,
        columns=_T_COLUMNS,
    ),
    Erratum(
        "004-3.8",
        "004",
        "(3.8)",
        "al5b",
        "frames",
        tr_later("A third row that is the second axis"),
        (
            r"{}^{0}T_1 = \begin{bmatrix} c_1 & -s_1 & 0 & 0 \\ s_1 & c_1 & 0 & 0 \\ 0 & 1 & 0 & d_1 \\ 0 & 0 & 0 & "
            r"1 \end{bmatrix}",
        ),
        (
            r"{}^{0}T_1 = \begin{bmatrix} c_1 & -s_1 & 0 & 0 \\ s_1 & c_1 & 0 & 0 \\ 0 & 0 & 1 & d_1 \\ 0 & 0 & 0 & "
            r"1 \end{bmatrix}",
        ),
        tr_later("The waist turns about z; as printed z is lost altogether, the determinant is 0."),
        TEXT_POSE,
        "transform",
        base_3_8,
        lambda robot, q: joint_transforms(robot, q)[0],
        columns=_T_COLUMNS,
    ),
    Erratum(
        "004-3.12",
        "004",
        "(3.12)",
        "al5b",
        "frames",
        tr_later("A mirror in place of a rotation"),
        (
            r"{}^{4}T_5 = \begin{bmatrix} c_5 & -s_5 & 0 & 0 \\ 0 & 0 & 1 & d_5 \\ s_5 & c_5 & 0 & 0 \\ 0 & 0 & 0 & "
            r"1 \end{bmatrix}",
        ),
        (
            r"{}^{4}T_5 = \begin{bmatrix} c_5 & -s_5 & 0 & 0 \\ 0 & 0 & 1 & d_5 \\ -s_5 & -c_5 & 0 & 0 \\ 0 & 0 & 0 & "
            r"1 \end{bmatrix}",
        ),
        tr_later(
            "With α₄ = −90° the third row has minus signs; as printed the determinant is −1, a left-handed frame."
        ),
        TEXT_POSE,
        "transform",
        roll_3_12,
        lambda robot, q: joint_transforms(robot, q)[4],
        columns=_T_COLUMNS,
    ),
    Erratum(
        "004-3.13",
        "004",
        "(3.13)",
        "al5b",
        "frames",
        tr_later("The roll counted twice"),
        (r"T_{gripper} = R_z(\theta_5)",),
        (r"T_{gripper} = I",),
        tr_later(
            "The table's last row is all zeros: opening the gripper does not turn it, and θ₅ is in (3.12) already."
        ),
        TEXT_POSE,
        "transform",
        gripper_3_13,
        lambda _robot, _q: np.eye(4),
        columns=_T_COLUMNS,
    ),
    Erratum(
        "004-3.15",
        "004",
        tr_later("(3.15) and (3.16)"),
        "al5b",
        "frames",
        tr_later("Four signs of the rotation"),
        (
            r"n_x = c_1 c_{234} c_5 + s_1 s_5",
            r"n_y = s_1 c_{234} c_5 - c_1 s_5",
            r"o_x = -c_1 c_{234} s_5 + s_1 c_5",
            r"o_y = -s_1 c_{234} s_5 - c_1 c_5",
        ),
        (
            r"n_x = c_1 c_{234} c_5 - s_1 s_5",
            r"n_y = s_1 c_{234} c_5 + c_1 s_5",
            r"o_x = -c_1 c_{234} s_5 - s_1 c_5",
            r"o_y = -s_1 c_{234} s_5 + c_1 c_5",
        ),
        tr_later(
            "They follow from the printed (3.12): its mirror inverts every term with s₁ or c₁ alone. Moreover n_z "
            "is labelled n_y once, and o_z is garbled."
        ),
        TEXT_POSE,
        "transform",
        orientation_3_15,
        flange,
        columns=_T_COLUMNS,
        tool=orientation_3_15,
    ),
)

_INVERSE = (
    Erratum(
        "004-3.21",
        "004",
        "(3.21)",
        "al5b",
        "inverse",
        tr_later("A length that the table does not have"),
        (r"r_4 = r_d - a_5 \cos\psi,\quad z_4 = z_d - a_5 \sin\psi",),
        (r"r_4 = r_d - d_5 \cos\psi,\quad z_4 = z_d - d_5 \sin\psi",),
        tr_later("The table's a of row 5 is 0; the hand's length is d₅."),
        TEXT_POSE,
        "length",
        wrist_3_21,
        _wrist,
        rows=("r₄", "z₄"),
    ),
    Erratum(
        "004-3.22",
        "004",
        "(3.22)",
        "al5b",
        "inverse",
        tr_later("atan2 of a cosine's numerator and denominator"),
        (r"\beta = \operatorname{atan2}(s^2 + a_3^2 - a_4^2,\, 2 a_3 s)",),
        (r"\beta = \arccos\frac{s^2 + a_3^2 - a_4^2}{2 a_3 s}",),
        tr_later("The law of cosines gives the ratio as cos β; atan2 makes tan β of it."),
        TEXT_POSE,
        "angle",
        beta_3_22,
        _beta,
        rows=("β",),
        tool=tool_with(1, shoulder_3_23),
    ),
    Erratum(
        "004-3.23",
        "004",
        "(3.23)",
        "al5b",
        "inverse",
        tr_later("The elbow by atan2 of a ratio too"),
        (r"\theta_3 = \operatorname{atan2}(s^2 - a_3^2 - a_4^2,\, 2 a_3 a_4)",),
        (
            r"\theta_3 = \mp\arccos\frac{s^2 - a_3^2 - a_4^2}{2 a_3 a_4}",
            r"\theta_2 = \alpha \pm \beta",
        ),
        tr_later("The ratio is cos θ₃, and its sign belongs to the sign chosen for θ₂."),
        TEXT_POSE,
        "angle",
        elbow_3_23,
        joint(2),
        rows=("θ₃",),
        tool=tool_with(2, elbow_3_23),
    ),
    Erratum(
        "004-3.26",
        "004",
        "(3.26)",
        "al5b",
        "inverse",
        tr_later("A cosine in the height"),
        (r"z = d_5 c_{234} + a_4 s_{23} + a_3 s_2 + d_1",),
        (r"z = d_5 s_{234} + a_4 s_{23} + a_3 s_2 + d_1",),
        tr_later("Heights are sines; (3.28) has it right."),
        TEXT_POSE,
        "length",
        height_3_26,
        lambda robot, q: place(robot, q)[2],
        rows=("z",),
        tool=_with_height,
    ),
    Erratum(
        "004-3.29",
        "004",
        "(3.29)",
        "al5b",
        "inverse",
        tr_later("A root that is drawn too long"),
        (r"c_3 = \frac{(z - d_5 s_\psi - d_1)^2 + (\pm\sqrt{x^2 + y^2 - d_5 c_\psi})^2 - a_3^2 - a_4^2}{2 a_3 a_4}",),
        (r"c_3 = \frac{(z - d_5 s_\psi - d_1)^2 + (\pm\sqrt{x^2 + y^2} - d_5 c_\psi)^2 - a_3^2 - a_4^2}{2 a_3 a_4}",),
        tr_later("The root is x² + y² alone, as in (3.27); a length cannot be taken from an area."),
        TEXT_POSE,
        "number",
        cosine_3_29,
        lambda _robot, q: math.cos(q[2]),
        rows=("cos θ₃",),
        undefined=tr_later("The printed formula has no value here: its root is not real."),
    ),
)

ERRATA_004_KINEMATICS = (*_FRAMES, *_INVERSE)
