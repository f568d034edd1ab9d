"""Errata of source 004 (AL5B): Jacobian, singularities, statics and the time law."""

from __future__ import annotations

import math

import numpy as np

from rvsim.dynamics import joint_torques, wrench_in_base
from rvsim.kinematics import forward_kinematics, jacobian, link_transforms
from rvsim.lab.sources.arms import degrees
from rvsim.lab.sources.erratum import Erratum
from rvsim.lab.sources.source_004_kinematics import TEXT_POSE
from rvsim.language import tr_later
from rvsim.motion.laws import quintic_between
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_AXES = ("x", "y", "z", "\u03c9x", "\u03c9y", "\u03c9z")
_JOINTS = ("θ₁", "θ₂", "θ₃", "θ₄", "θ₅")
_FORCE = np.array([0.0, 0.0, 10.0, 0.0, 0.0, 0.0])  # of (4.25), in tool axes: 10 N along the tool [N, N m]
_START, _END = 1.0, 3.0  # of the motion that shows (5.22) [s]


def columns_4_7(robot: Robot, q: FloatArray) -> FloatArray:
    """(4.7): z_{i−1} × (o5 − o_{i−1}) with Craig's frames, whose axis i is z_i."""
    T = link_transforms(robot, q)
    axes, arms = T[:-1, :3, 2], T[-1, :3, 3] - T[:-1, :3, 3]
    return np.vstack([np.cross(axes, arms).T, axes.T])


def _sums(robot: Robot, q: FloatArray) -> tuple[float, float, float]:
    """q1, how far out the tool is [m] and its pitch, from the joints' own angles."""
    a3, a4, d5 = robot.dh[2, 2], robot.dh[3, 2], robot.dh[4, 1]
    pitch = q[1] + q[2] + q[3]
    return float(q[0]), float(a3 * np.cos(q[1]) + a4 * np.cos(q[1] + q[2]) + d5 * np.cos(pitch)), float(pitch)


def origin_4_8(robot: Robot, q: FloatArray) -> FloatArray:
    """(3,) o3 of (4.8), its y with c1 s1."""
    a3, d1 = robot.dh[2, 2], robot.dh[0, 1]
    c1, s1, c2, s2 = math.cos(q[0]), math.sin(q[0]), math.cos(q[1]), math.sin(q[1])
    return np.array([c1 * c2 * a3, c1 * s1 * a3, s2 * a3 + d1])


def axis_4_9(robot: Robot, q: FloatArray) -> FloatArray:
    """(3,) z5 of (4.9), its last entry −s234."""
    waist, _, pitch = _sums(robot, q)
    return np.array([math.cos(waist) * math.cos(pitch), math.sin(waist) * math.cos(pitch), -math.sin(pitch)])


def column_4_11(robot: Robot, q: FloatArray) -> FloatArray:
    """(6,) J1 of (4.11), which has five entries: y is missing."""
    waist, out, _ = _sums(robot, q)
    return np.array([-math.sin(waist) * out, math.nan, 0.0, 0.0, 0.0, 1.0])


def column_4_15(robot: Robot, q: FloatArray) -> FloatArray:
    """(6,) J5 of (4.15)."""
    d5, (waist, _, pitch) = robot.dh[4, 1], _sums(robot, q)
    c1, s1, level = math.cos(waist), math.sin(waist), math.cos(pitch)
    fall = math.sin(pitch) * d5
    return np.array([-c1 * fall, -s1 * fall, s1 * s1 * level * d5 + c1 * c1 * level * d5, s1, -c1, 0.0])


def _no_determinant(_robot: Robot, _q: FloatArray) -> float:
    return math.nan


def _manipulability(robot: Robot, q: FloatArray) -> float:
    """√det(JᵀJ) by the singular values, which keeps it from being the root of a rounding error."""
    return float(np.prod(np.linalg.svd(jacobian(robot, q), compute_uv=False)))


def torques_4_24(robot: Robot, q: FloatArray) -> FloatArray:
    """(5,) JᵀF with F in tool axes [N m]."""
    return np.asarray(jacobian(robot, q).T @ _FORCE)


def _torques(robot: Robot, q: FloatArray) -> FloatArray:
    return joint_torques(robot, q, wrench_in_base(robot, q, _FORCE))


def quintic_rows(t0: float, tf: float, *, as_printed: bool) -> FloatArray:
    """(6, 6) the matrix of (5.22) for a0 … a5: as printed, 3t0³ in row 2 and a 0 in row 6, or from (5.16) to (5.21)."""

    def rows(t: float) -> list[list[float]]:
        return [
            [1.0, t, t**2, t**3, t**4, t**5],
            [0.0, 1.0, 2.0 * t, 3.0 * t**2, 4.0 * t**3, 5.0 * t**4],
            [0.0, 0.0, 2.0, 6.0 * t, 12.0 * t**2, 20.0 * t**3],
        ]

    M = np.array([*rows(t0), *rows(tf)])
    if as_printed:
        M[1, 3], M[5, 2] = 3.0 * t0**3, 0.0
    return M


def quintic_coefficients(start: float, end: float, t0: float, tf: float, *, as_printed: bool) -> FloatArray:
    """(6,) a0 … a5 from rest at `start` to rest at `end`."""
    wanted = np.array([start, 0.0, 0.0, end, 0.0, 0.0])
    return np.asarray(np.linalg.solve(quintic_rows(t0, tf, as_printed=as_printed), wanted))


def end_acceleration_5_22(_robot: Robot, q: FloatArray) -> float:
    """The acceleration at the end of a motion of joint 1 from 0 to q1, t = 1 s to 3 s, by (5.22) [rad/s²]."""
    coefficients = quintic_coefficients(0.0, float(q[0]), _START, _END, as_printed=True)
    return float(np.polynomial.Polynomial(coefficients).deriv(2)(_END))


def _end_acceleration(_robot: Robot, q: FloatArray) -> float:
    return float(quintic_between(_START, _END, 0.0, q[0]).at(_END).qdd[0])


_JACOBIAN = (
    Erratum(
        "004-4.6",
        "004",
        "(4.6)",
        "al5b",
        "jacobian",
        tr_later("Two names exchanged"),
        (r"J_{vi}:\; \mathrm{angular},\quad J_{wi}:\; \mathrm{linear}",),
        (r"J_{vi}:\; \mathrm{linear},\quad J_{wi}:\; \mathrm{angular}",),
        tr_later(
            "The sentence below the formulas calls J_v the angular and J_w the linear velocity; the formulas mean "
            "the opposite."
        ),
        TEXT_POSE,
    ),
    Erratum(
        "004-4.7",
        "004",
        "(4.7)",
        "al5b",
        "jacobian",
        tr_later("Every column one joint too early"),
        (
            r"J = \begin{bmatrix} z_0 \times (o_5 - o_0) & \cdots & z_4 \times (o_5 - o_4) \\ z_0 & \cdots & z_4 "
            r"\end{bmatrix}",
        ),
        (
            r"J = \begin{bmatrix} z_1 \times (o_5 - o_1) & \cdots & z_5 \times (o_5 - o_5) \\ z_1 & \cdots & z_5 "
            r"\end{bmatrix}",
        ),
        tr_later(
            "In the modified convention joint i turns about z_i; as printed joint 1 appears twice and the roll is "
            "missing."
        ),
        TEXT_POSE,
        "jacobian",
        columns_4_7,
        jacobian,
        rows=_AXES,
        columns=_JOINTS,
    ),
    Erratum(
        "004-4.8",
        "004",
        "(4.8), o₃",
        "al5b",
        "jacobian",
        tr_later("A sine of the waist twice"),
        (r"o_{3y} = c_1 s_1 a_3",),
        (r"o_{3y} = s_1 c_2 a_3",),
        tr_later("How far out the elbow is depends on the shoulder: a₃c₂, turned by the waist."),
        TEXT_POSE,
        "length",
        origin_4_8,
        lambda robot, q: link_transforms(robot, q)[3, :3, 3],
        rows=("x", "y", "z"),
    ),
    Erratum(
        "004-4.9",
        "004",
        "(4.9), z₅",
        "al5b",
        "jacobian",
        tr_later("The tool's axis turned upside down"),
        (r"z_5 = (c_1 c_{234},\, s_1 c_{234},\, {-}s_{234})",),
        (r"z_5 = (c_1 c_{234},\, s_1 c_{234},\, s_{234})",),
        tr_later("The height of (4.8) grows with s₂₃₄, and z₅ points from the wrist to the tool."),
        TEXT_POSE,
        "number",
        axis_4_9,
        lambda robot, q: forward_kinematics(robot, q)[:3, 2],
        rows=("x", "y", "z"),
    ),
    Erratum(
        "004-4.11",
        "004",
        tr_later("(4.11) and (4.12)"),
        "al5b",
        "jacobian",
        tr_later("A column of five entries"),
        (r"J_1 = (-s_1 \rho,\; 0,\; 0,\; 0,\; 1)^T",),
        (r"J_1 = (-s_1 \rho,\; c_1 \rho,\; 0,\; 0,\; 0,\; 1)^T", r"\rho = a_3 c_2 + a_4 c_{23} + d_5 c_{234}"),
        tr_later("The y entry is missing; the waist moves the tool along y as well."),
        TEXT_POSE,
        "jacobian",
        column_4_11,
        lambda robot, q: jacobian(robot, q)[:, 0],
        rows=_AXES,
        undefined=tr_later("An entry is missing in the printed column."),
    ),
    Erratum(
        "004-4.15",
        "004",
        "(4.15)",
        "al5b",
        "jacobian",
        tr_later("The roll's column is that of joint 4"),
        (
            r"J_5 = z_4 \times (o_5 - o_4)",
            r"J_5 = (-c_1 s_{234} d_5,\; {-}s_1 s_{234} d_5,\; c_{234} d_5,\; s_1,\; {-}c_1,\; 0)^T",
        ),
        (r"J_5 = (0,\; 0,\; 0,\; z_5)^T",),
        tr_later("The roll turns about the tool's own axis and does not move its origin."),
        TEXT_POSE,
        "jacobian",
        column_4_15,
        lambda robot, q: jacobian(robot, q)[:, 4],
        rows=_AXES,
    ),
)

_OTHERS = (
    Erratum(
        "004-4.16",
        "004",
        tr_later("(4.16) and (4.17)"),
        "al5b",
        "singularity",
        tr_later("The determinant of a matrix that is not square"),
        (r"\det J = 0",),
        (r"\sqrt{\det(J^T J)} = \sigma_1 \sigma_2 \cdots \sigma_5 = 0",),
        tr_later(
            "A 6×5 matrix has no determinant and no four square blocks; its singular values tell what is lost. "
            "Shown: manipulability, with metres."
        ),
        TEXT_POSE,
        "number",
        _no_determinant,
        _manipulability,
        rows=("w",),
        undefined=tr_later("A 6×5 matrix has no determinant."),
    ),
    Erratum(
        "004-4.24",
        "004",
        tr_later("(4.24) and (4.25)"),
        "al5b",
        "dynamics",
        tr_later("A force in tool axes, a Jacobian in base axes"),
        (r"\tau = J^T F_{tool}",),
        (r"\tau = J^T \begin{bmatrix} R & 0 \\ 0 & R \end{bmatrix} F_{tool}",),
        tr_later(
            "Force and Jacobian must be written in the same axes; R is the tool's rotation. Shown: the joint "
            "torques for 10 N along the tool."
        ),
        TEXT_POSE,
        "torque",
        torques_4_24,
        _torques,
        rows=_JOINTS,
    ),
    Erratum(
        "004-5.22",
        "004",
        "(5.22)",
        "al5b",
        "time law",
        tr_later("Two entries of the quintic's matrix"),
        (r"(5.22)_{24} = 3 t_0^3,\quad (5.22)_{63} = 0",),
        (r"(5.22)_{24} = 3 t_0^2,\quad (5.22)_{63} = 2",),
        tr_later(
            "Invisible for t₀ = 0. Shown: joint 1 from 0 to where it is, from t = 1 s to 3 s: its acceleration at "
            "the end, which should be 0."
        ),
        degrees(40, 60, -70, -35, 40),
        "acceleration",
        end_acceleration_5_22,
        _end_acceleration,
        rows=("θ̈(3 s)",),
    ),
)

ERRATA_004_MOTION = (*_JACOBIAN, *_OTHERS)
