"""Errata of source 002 (UR5e): its formulas, and what the printed program makes of its ellipse."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from rvsim.kinematics import forward_kinematics, jacobian
from rvsim.lab.drawings import ELLIPSE_PRINTED_ROTATION, ellipse
from rvsim.lab.source_002 import (
    Comparison,
    compare_source_002,
    printed_jacobian,
    printed_position,
    printed_recipe,
)
from rvsim.lab.sources.arms import at_place, degrees, place
from rvsim.lab.sources.erratum import Erratum, Evaluate
from rvsim.language import tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.units import metres_from_millimetres

_POSE = degrees(20, -70, 100, -50, 60, 35)
_XYZ = ("x", "y", "z")
_JOINTS = ("θ₁", "θ₂", "θ₃", "θ₄", "θ₅", "θ₆")
_INTERVAL = 1.2e-3  # of code 1 [m]


def code_position(_robot: Robot, q: FloatArray) -> FloatArray:
    """(3,) posx, posy, posz of code 2 [m]."""
    return metres_from_millimetres(printed_position(q))


def positive_lengths(robot: Robot, q: FloatArray) -> FloatArray:
    """(3,) the tool with a2 and a3 positive, everything else right."""
    return np.asarray(forward_kinematics(_flipped(robot), q)[:3, 3])


@lru_cache(maxsize=4)
def _flipped(robot: Robot) -> Robot:
    return robot.with_joint(1, a=-robot.joints[1].a).with_joint(2, a=-robot.joints[2].a)


def text_x(robot: Robot, q: FloatArray) -> float:
    """posx of the text, with θ1 + θ2 + θ3 and with a3 c1 c2 c3 twice; the lengths with the signs of the table."""
    a2, a3, d4, d5, d6 = robot.dh[1, 2], robot.dh[2, 2], robot.dh[3, 1], robot.dh[4, 1], robot.dh[5, 1]
    c1, s1, c2, c3 = np.cos(q[0]), np.sin(q[0]), np.cos(q[1]), np.cos(q[2])
    x = d5 * c1 * np.sin(q[0] + q[1] + q[2]) + d4 * s1 - d6 * c1 * np.cos(q[1] + q[2] + q[3]) + a2 * c1 * c2
    return float(x + d6 * np.cos(q[4]) * s1 + 2.0 * a3 * c1 * c2 * c3)


def _x(robot: Robot, q: FloatArray) -> float:
    return float(place(robot, q)[0])


def _with_x(robot: Robot, q: FloatArray) -> FloatArray:
    return at_place(robot, q, np.array([text_x(robot, q), *place(robot, q)[1:]]))


def code_rotation(_robot: Robot, q: FloatArray) -> FloatArray:
    """(3, 3) e11 … e33 of code 2: c6 for s6 in e12, and e22 cut short."""
    c1, s1, c5, s5, c6, s6 = (f(q[i]) for i in (0, 4, 5) for f in (np.cos, np.sin))
    c234, s234 = np.cos(q[1] + q[2] + q[3]), np.sin(q[1] + q[2] + q[3])
    return np.array(
        [
            [
                c1 * c234 * c5 * c6 + c6 * s1 * s5 - c1 * s234 * s6,
                -c1 * c234 * c5 * c6 - s1 * s5 * s6 - c1 * c6 * s234,
                -c1 * c234 * s5 + c5 * s1,
            ],
            [
                c234 * c5 * c6 * s1 - c1 * c6 * s5 - s1 * s234 * s6,
                -c234 + c1 * s5 * s6 - c6 * s1 * s234,
                -c234 * s1 * s5 - c1 * c5,
            ],
            [c5 * c6 * s234 + c234 * s6, -c5 * s234 * s6 + c234 * c6, -s234 * s5],
        ]
    )


def _rotation(robot: Robot, q: FloatArray) -> FloatArray:
    return np.asarray(forward_kinematics(robot, q)[:3, :3])


def code_jacobian(_robot: Robot, q: FloatArray) -> FloatArray:
    """(3, 6) dposx_1 … dposz_6 of code 2 [m]."""
    return metres_from_millimetres(printed_jacobian(q))


def _position_jacobian(robot: Robot, q: FloatArray) -> FloatArray:
    return np.asarray(jacobian(robot, q)[:3])


def text_z_2(robot: Robot, q: FloatArray) -> float:
    """∂p_z/∂θ2 of the text, with cos(θ1 + θ2); the lengths with the signs of the table."""
    a2, a3, d5, d6 = robot.dh[1, 2], robot.dh[2, 2], robot.dh[4, 1], robot.dh[5, 1]
    pitch = q[1] + q[2] + q[3]
    level = a3 * np.cos(q[0] + q[1]) + a2 * np.cos(q[1])
    return float(-d6 * np.sin(q[4]) * np.cos(pitch) + level + d5 * np.sin(pitch))


def rescaled(robot: Robot, q: FloatArray) -> FloatArray:
    """(3,) where the arm stands with the angles that code 3 plots: degrees times .01745, made by dividing by .0175."""
    return place(robot, q * printed_recipe().sent_factor)


def printed_target_error(_robot: Robot, _q: FloatArray) -> float:
    """The largest entry of |RᵀR − I| of the printed target."""
    return float(np.abs(ELLIPSE_PRINTED_ROTATION.T @ ELLIPSE_PRINTED_ROTATION - np.eye(3)).max())


def spacing(_robot: Robot, _q: FloatArray) -> FloatArray:
    """(2,) the smallest and the largest distance of neighbours on the ellipse [m]."""
    gaps = np.linalg.norm(np.diff(ellipse(), axis=0), axis=1)
    return np.array([gaps.min(), gaps.max()])


@lru_cache(maxsize=4)
def followed(robot: Robot) -> Comparison:
    """The printed and the corrected algorithm along the ellipse."""
    return compare_source_002(robot)


def _rms(run: int) -> Evaluate:
    return lambda robot, _q: metres_from_millimetres(followed(robot)[run].rms)


def tilts(robot: Robot) -> FloatArray:
    """(184,) angles between the tool's axis and the desired one after the corrected, position-only run [rad]."""
    axis = forward_kinematics(robot, followed(robot).corrected.q)[:, :3, 2]
    return np.asarray(np.arccos(np.clip(axis @ ELLIPSE_PRINTED_ROTATION[:, 2], -1.0, 1.0)))


def tilt_range(robot: Robot, _q: FloatArray) -> FloatArray:
    """(2,) the least and the largest of them [rad]."""
    found = tilts(robot)
    return np.array([found.min(), found.max()])


_FORMULAS = (
    Erratum(
        "002-pos",
        "002",
        tr_later("Code 2, posx to posz"),
        "ur5e",
        "frames",
        tr_later("Forward kinematics with terms missing"),
        (
            r"x = d_5 c_1 s_{234} + d_4 s_1 - d_6 c_1 c_{234} + a_2 c_1 c_2 + d_6 c_5 s_1 + a_3 c_1 c_{23}",
            r"y = d_5 s_1 s_{234} - d_4 c_1 - d_6 c_1 c_5 + a_2 c_2 s_1 + a_3 s_1 c_{23}",
            r"a_2 = 425,\; a_3 = 392.2",
        ),
        (
            r"x = d_5 c_1 s_{234} + d_4 s_1 - d_6 c_1 c_{234} s_5 + a_2 c_1 c_2 + d_6 c_5 s_1 + a_3 c_1 c_{23}",
            r"y = d_5 s_1 s_{234} - d_4 c_1 - d_6 c_1 c_5 - d_6 s_1 c_{234} s_5 + a_2 c_2 s_1 + a_3 s_1 c_{23}",
            r"a_2 = -425,\; a_3 = -392.2",
        ),
        tr_later(
            "x lacks sin θ₅ on its d₆ term, y lacks that term, and the lengths a₂, a₃ have lost the minus of the table."
        ),
        _POSE,
        "length",
        code_position,
        place,
        rows=_XYZ,
        tool=lambda robot, q: at_place(robot, q, code_position(robot, q)),
    ),
    Erratum(
        "002-a",
        "002",
        tr_later("Codes 2 and 3"),
        "ur5e",
        "frames",
        tr_later("Two lengths without their minus"),
        (r"a_2 = 425,\quad a_3 = 392.2",),
        (r"a_2 = -425,\quad a_3 = -392.2",),
        tr_later("The table of the same source has the minus. Shown: where the tool would be if only this were wrong."),
        _POSE,
        "length",
        positive_lengths,
        place,
        rows=_XYZ,
        tool=lambda robot, q: at_place(robot, q, positive_lengths(robot, q)),
    ),
    Erratum(
        "002-x",
        "002",
        tr_later("posx in the text"),
        "ur5e",
        "frames",
        tr_later("Angles of other joints in a sum"),
        (r"x = d_5 c_1 \sin(\theta_1 + \theta_2 + \theta_3) + \cdots + a_3 c_1 c_2 c_3 + a_3 c_1 c_2 c_3",),
        (r"x = d_5 c_1 \sin(\theta_2 + \theta_3 + \theta_4) + \cdots + a_3 c_1 c_2 c_3 - a_3 c_1 s_2 s_3",),
        tr_later("The hand's angle in its plane is θ₂ + θ₃ + θ₄, and cos(θ₂ + θ₃) is c₂c₃ − s₂s₃."),
        _POSE,
        "length",
        text_x,
        _x,
        rows=("x",),
        tool=_with_x,
    ),
    Erratum(
        "002-R",
        "002",
        tr_later("Code 2, e12 and e22"),
        "ur5e",
        "frames",
        tr_later("Two entries of the rotation"),
        (r"e_{12} = -c_1 c_{234} c_5 c_6 - s_1 s_5 s_6 - c_1 c_6 s_{234}", r"e_{22} = -c_{234} + c_1 s_5 s_6 - \cdots"),
        (
            r"e_{12} = -c_1 c_{234} c_5 s_6 - s_1 s_5 s_6 - c_1 c_6 s_{234}",
            r"e_{22} = -s_1 c_{234} c_5 s_6 + c_1 s_5 s_6 - \cdots",
        ),
        tr_later(
            "c₆ stands where s₆ belongs, and a product has been cut short; the columns are not even unit vectors."
        ),
        _POSE,
        "number",
        code_rotation,
        _rotation,
        columns=("n", "o", "a"),
    ),
    Erratum(
        "002-J",
        "002",
        tr_later("Code 2, dposx_1 to dposz_6"),
        "ur5e",
        "jacobian",
        tr_later("A Jacobian without the factor sin θ₅"),
        (
            r"\frac{\partial x}{\partial \theta_2} = d_5 c_1 c_{234} + d_6 c_1 s_{234} - \cdots",
            r"\frac{\partial x}{\partial \theta_5} = -d_6 s_1 s_5",
        ),
        (
            r"\frac{\partial x}{\partial \theta_2} = d_5 c_1 c_{234} + d_6 c_1 s_{234} s_5 - \cdots",
            r"\frac{\partial x}{\partial \theta_5} = -d_6 s_1 s_5 - d_6 c_1 c_{234} c_5",
        ),
        tr_later(
            "Most d₆ terms lack sin θ₅, two derivatives with respect to θ₅ lack a term, and a₂, a₃ lack their minus."
        ),
        _POSE,
        "position jacobian",
        code_jacobian,
        _position_jacobian,
        rows=_XYZ,
        columns=_JOINTS,
    ),
    Erratum(
        "002-z2",
        "002",
        tr_later("∂p_z/∂θ₂ in the text"),
        "ur5e",
        "jacobian",
        tr_later("A wrong sum of angles in a derivative"),
        (r"\frac{\partial p_z}{\partial \theta_2} = \cdots + a_3 \cos(\theta_1 + \theta_2) + \cdots",),
        (r"\frac{\partial p_z}{\partial \theta_2} = \cdots + a_3 \cos(\theta_2 + \theta_3) + \cdots",),
        tr_later("The forearm's angle is θ₂ + θ₃; the waist does not lift the tool."),
        _POSE,
        "lever",
        text_z_2,
        lambda robot, q: jacobian(robot, q)[2, 1],
        rows=("∂z/∂θ₂",),
    ),
)

_PROGRAM = (
    Erratum(
        "002-scale",
        "002",
        tr_later("Codes 2 and 3"),
        "ur5e",
        "path",
        tr_later("Angles that shrink on their way to the plot"),
        (r"\theta_{plot} = 0.01745\, \frac{\theta}{0.0175} = 0.99714\, \theta",),
        (r"\theta_{plot} = \theta",),
        tr_later("Degrees are made with one number and unmade with another: every angle is drawn 0.3 % too small."),
        _POSE,
        "length",
        rescaled,
        place,
        rows=_XYZ,
        tool=lambda robot, q: forward_kinematics(robot, q * printed_recipe().sent_factor),
    ),
    Erratum(
        "002-target",
        "002",
        tr_later("Desired_tr of code 2"),
        "ur5e",
        "path",
        tr_later("A desired rotation that is none"),
        (r"R = \begin{bmatrix} -0.5 & -0.866 & 0 \\ 0.866 & -0.5 & 0 \\ 0 & 0 & 1 \end{bmatrix}",),
        (r"R = R_z(120.00073^\circ)",),
        tr_later(
            "√3/2 is rounded, so the columns are not quite unit vectors; the nearest rotation turns by 120.00073°. "
            "Shown: the largest entry of |RᵀR − I|."
        ),
        _POSE,
        "number",
        printed_target_error,
        lambda _robot, _q: 0.0,
        rows=(tr_later("error"),),
    ),
    Erratum(
        "002-spacing",
        "002",
        tr_later("Code 1"),
        "ur5e",
        "path",
        tr_later("Samples that are not 1.2 mm apart"),
        (r"n = \lceil 2\pi a / 1.2 \rceil,\quad \theta_k = \frac{2\pi k}{n - 1}",),
        (r"\Delta s = \sqrt{a^2 \sin^2\theta + b^2 \cos^2\theta}\; \Delta\theta",),
        tr_later("The angle is divided evenly, which divides a circle evenly, not an ellipse."),
        _POSE,
        "length",
        lambda _robot, _q: np.full(2, _INTERVAL),
        spacing,
        rows=(tr_later("least"), tr_later("most")),
    ),
    Erratum(
        "002-ik",
        "002",
        tr_later("Code 2, Newton_Raphson"),
        "ur5e",
        "path",
        tr_later("A desired orientation that is never used"),
        (r"e = p_{desired} - p,\quad \Delta\theta = J^{+} e",),
        (r"\Delta\theta = J^{+} \begin{bmatrix} p_{desired} - p \\ \omega(R_{desired} R^T) \end{bmatrix}",),
        tr_later(
            "Only the position is solved for; even with the right formulas the tool's axis ends far from the "
            "desired one. Shown: the least and the largest angle between them along the ellipse."
        ),
        _POSE,
        "angle",
        lambda _robot, _q: np.zeros(2),
        tilt_range,
        rows=(tr_later("least"), tr_later("most")),
    ),
    Erratum(
        "002-rms",
        "002",
        tr_later("The whole program"),
        "ur5e",
        "path",
        tr_later("An arm that draws its ellipse elsewhere"),
        (r"|p_{printed}(\theta) - p_{desired}| < 1\,\mathrm{mm}",),
        (r"p(\theta) = p_{desired}",),
        tr_later(
            "Run as printed the program believes to be within 1 mm; a real arm is sent somewhere else. Shown: how "
            "far it is from the ellipse (RMS), as printed and corrected."
        ),
        _POSE,
        "length",
        _rms(0),
        _rms(1),
        rows=("RMS",),
    ),
)

ERRATA_002 = (*_FORMULAS, *_PROGRAM)
