"""Errata of source 000 (RV-M1): inverse kinematics, Jacobian and singularities."""

from __future__ import annotations

import math

import numpy as np

from rvsim.kinematics import jacobian, link_transforms
from rvsim.lab.sources import printed
from rvsim.lab.sources.arms import degrees, dh_angles, joint, place, planar, tool_with
from rvsim.lab.sources.erratum import Erratum
from rvsim.lab.sources.source_000_frames import TEXT_POSE
from rvsim.language import tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_SINGULAR = 1e-6  # a singular value below this is 0 [m/rad, 1]
_WORST_CONDITION = 1e14  # of a matrix that float64 can still invert
_VELOCITY = np.array([0.1, 0.0, 0.0, 0.0, 0.0, 0.0])  # of the tool, for (24): 100 mm/s along x
_AXES = ("x", "y", "z", "\u03c9x", "\u03c9y", "\u03c9z")
_JOINTS = ("θ₁", "θ₂", "θ₃", "θ₄", "θ₅")


def _tip_above_base() -> tuple[float, ...]:
    """A pose within the limits whose tip is on the base axis, though neither sin θ3 nor cos θ4 is 0."""
    second, third = math.radians(100.0), math.radians(70.0)
    pitch = math.acos(-(0.25 * math.cos(second) + 0.16 * math.cos(third)) / 0.072)
    return (math.radians(30.0), second, third - second, pitch - third, 0.0)


def _triangle(robot: Robot, q: FloatArray) -> printed.Triangle:
    out, up, a2, a3 = planar(robot, q)
    return printed.Triangle(up, out, a2, a3)


def waist(robot: Robot, q: FloatArray) -> float:
    """(10) at the tool's place."""
    x, y, _ = place(robot, q)
    return printed.waist_000(float(x), float(y))


def gamma_shown(robot: Robot, q: FloatArray) -> float:
    """γ of (14)."""
    return printed.gamma_000(_triangle(robot, q))


def _gamma(robot: Robot, q: FloatArray) -> float:
    """What γ stands for: α sin θ2 + β cos θ2 of (13)."""
    alpha, beta, *_ = _triangle(robot, q)
    return alpha * math.sin(q[1]) + beta * math.cos(q[1])


def shoulder(robot: Robot, q: FloatArray) -> float:
    """θ2 of (14) with the right γ: what is left is the exchanged atan2."""
    triangle = _triangle(robot, q)
    return printed.shoulder_000(triangle, float(q[1]), printed.gamma(triangle))


def elbow(robot: Robot, q: FloatArray) -> float:
    """θ3 of (15)."""
    return printed.elbow_000(_triangle(robot, q), float(q[1]))


def wrist_pitch(_robot: Robot, q: FloatArray) -> float:
    """θ4 of (17), φ being the pitch of the hand."""
    pitch = float(q[1] + q[2] + q[3])
    return pitch - float(q[1]) - float(q[2])


def one_lever(robot: Robot, q: FloatArray) -> FloatArray:
    """(21): every column k × ⁰d5, as if all axes went through the base's origin."""
    T = link_transforms(robot, q)
    axes = T[:-1, :3, 2]
    return np.vstack([np.cross(axes, T[-1, :3, 3]).T, axes.T])


def columns_22(robot: Robot, q: FloatArray) -> FloatArray:
    """(22), the five columns as printed, θ4 being the angle of the table."""
    t1, t2, t3, t4, _ = dh_angles(robot, q)
    a2, a3, d_g = robot.dh[1, 2], robot.dh[2, 2], robot.dh[4, 1]
    c1, s1, s234 = np.cos(t1), np.sin(t1), np.sin(t2 + t3 + t4)
    out = a2 * np.cos(t2) + a3 * np.cos(t2 + t3) + d_g * s234
    turn = [-s1, -c1, 0.0]
    columns = [
        [s1 * out, c1 * out, 0.0, 0.0, 0.0, 1.0],
        [0.0, -out, 0.0, 0.0, 0.0, -1.0],
        [0.0, 0.0, a2 * c1 + a3 * np.cos(t1 + t3) + d_g * s234, *turn],
        [0.0, 0.0, a3 * c1 + d_g * s234, *turn],
        [0.0, 0.0, d_g * s1, *turn],
    ]
    return np.array(columns).T


def pseudo_inverse_24(robot: Robot, q: FloatArray) -> FloatArray:
    """(24) and (25): (JᵀJ)⁻¹ Jᵀ ẋ, NaN where JᵀJ has no inverse."""
    J = jacobian(robot, q)
    square = J.T @ J
    if np.linalg.cond(square) > _WORST_CONDITION:
        return np.full(robot.dof, np.nan)
    return np.asarray(np.linalg.inv(square) @ J.T @ _VELOCITY)


def _by_svd(robot: Robot, q: FloatArray) -> FloatArray:
    J = jacobian(robot, q)
    return np.asarray(np.linalg.pinv(J, rcond=_SINGULAR / float(np.linalg.norm(J, 2))) @ _VELOCITY)


def position_part(robot: Robot, q: FloatArray) -> FloatArray:
    """Ĵ (3, 4) of (26): how the tip moves with joints 1 to 4."""
    return np.asarray(jacobian(robot, q)[:3, :4])


def _straight(robot: Robot, q: FloatArray) -> bool:
    """(29): sin θ3 = 0 and cos θ4 = 0."""
    return abs(math.sin(q[2])) < _SINGULAR and abs(math.cos(dh_angles(robot, q)[3])) < _SINGULAR


def _barrier(robot: Robot, q: FloatArray) -> bool:
    """(31): θ2 = −π/6 and θ4 = π/2."""
    return bool(abs(q[1] + math.pi / 6.0) < _SINGULAR and abs(dh_angles(robot, q)[3] - math.pi / 2.0) < _SINGULAR)


def rank_29(robot: Robot, q: FloatArray) -> float:
    """The rank of Ĵ if (29) names all of its singularities."""
    return 2.0 if _straight(robot, q) else 3.0


def rank_31(robot: Robot, q: FloatArray) -> float:
    """The rank of Ĵ if (31) is singular as well."""
    return 2.0 if _straight(robot, q) or _barrier(robot, q) else 3.0


def _rank(robot: Robot, q: FloatArray) -> float:
    return float(np.linalg.matrix_rank(position_part(robot, q), tol=_SINGULAR))


_INVERSE = (
    Erratum(
        "000-10",
        "000",
        "(10)",
        "rv-m1",
        "inverse",
        tr_later("The waist from x and y exchanged"),
        (r"\theta_1 = \operatorname{atan2}(x_G,\, -y_G)",),
        (r"\theta_1 = \operatorname{atan2}(y_G,\, x_G)",),
        tr_later("atan2 takes y first; and −y_G undoes the clockwise sense of (9), so that the value is 90° − θ₁."),
        TEXT_POSE,
        "angle",
        waist,
        joint(0),
        rows=("θ₁",),
        tool=tool_with(0, waist),
    ),
    Erratum(
        "000-14g",
        "000",
        "(14), γ",
        "rv-m1",
        "inverse",
        tr_later("A sign in the law of cosines"),
        (r"\gamma = \frac{a_2^2 - a_3^2 - \alpha^2 - \beta^2}{2 a_2}",),
        (r"\gamma = \frac{a_2^2 - a_3^2 + \alpha^2 + \beta^2}{2 a_2}",),
        tr_later("Squaring (12) and its neighbour brings α² + β² to the other side with a plus."),
        TEXT_POSE,
        "length",
        gamma_shown,
        _gamma,
        rows=("γ",),
    ),
    Erratum(
        "000-14",
        "000",
        "(14)",
        "rv-m1",
        "inverse",
        tr_later("The shoulder with α and β exchanged"),
        (r"\theta_2 = \operatorname{atan2}(\gamma, \pm\sqrt{r^2 - \gamma^2}) - \operatorname{atan2}(\alpha, \beta)",),
        (r"\theta_2 = \operatorname{atan2}(\gamma, \pm\sqrt{r^2 - \gamma^2}) - \operatorname{atan2}(\beta, \alpha)",),
        tr_later(
            "α sin θ₂ + β cos θ₂ = r sin(θ₂ + atan2(β, α)), so it is this angle that is taken off; shown with the "
            "right γ."
        ),
        TEXT_POSE,
        "angle",
        shoulder,
        joint(1),
        rows=("θ₂",),
        tool=tool_with(1, shoulder),
        undefined=tr_later("The printed formula has no value here: its root is not real."),
    ),
    Erratum(
        "000-15",
        "000",
        "(15)",
        "rv-m1",
        "inverse",
        tr_later("The elbow with atan2's arguments exchanged"),
        (r"\theta_3 = \operatorname{atan2}(\beta - a_2 c_2,\, \alpha - a_2 s_2) - \theta_2",),
        (r"\theta_3 = \operatorname{atan2}(\alpha - a_2 s_2,\, \beta - a_2 c_2) - \theta_2",),
        tr_later("The height is the sine's part and goes first."),
        TEXT_POSE,
        "angle",
        elbow,
        joint(2),
        rows=("θ₃",),
        tool=tool_with(2, elbow),
    ),
    Erratum(
        "000-17",
        "000",
        tr_later("(16) and (17)"),
        "rv-m1",
        "inverse",
        tr_later("The pitch is not the sum of the table's angles"),
        (r"\varphi = \theta_2 + \theta_3 + \theta_4", r"\theta_4 = \varphi - \theta_2 - \theta_3"),
        (
            r"\varphi + 90^\circ = \theta_2 + \theta_3 + \theta_4",
            r"\theta_4 = \varphi + 90^\circ - \theta_2 - \theta_3",
        ),
        tr_later(
            "θ₄ of the table is the joint's angle plus 90°; with the pitch of the hand as φ the wrist is 90° off."
        ),
        TEXT_POSE,
        "angle",
        wrist_pitch,
        lambda robot, q: dh_angles(robot, q)[3],
        rows=("θ₄",),
        tool=tool_with(3, lambda robot, q: wrist_pitch(robot, q) - robot.dh[3, 0]),
    ),
)

_JACOBIAN = (
    Erratum(
        "000-21",
        "000",
        tr_later("(19) and (21)"),
        "rv-m1",
        "jacobian",
        tr_later("One lever arm for all columns"),
        (r"c_i = \begin{bmatrix} k_{i-1} \times {}^{0}d_5 \\ k_{i-1} \end{bmatrix}",),
        (r"c_i = \begin{bmatrix} z_{i-1} \times (p - o_{i-1}) \\ z_{i-1} \end{bmatrix}",),
        tr_later("The arm of the tool is counted from the joint's own axis, not from the base."),
        TEXT_POSE,
        "jacobian",
        one_lever,
        jacobian,
        rows=_AXES,
        columns=_JOINTS,
    ),
    Erratum(
        "000-22",
        "000",
        "(22)",
        "rv-m1",
        "jacobian",
        tr_later("Columns that are no columns of this arm"),
        (
            r"c_1 = [\, s_1 \rho,\; c_1 \rho,\; 0,\; 0,\; 0,\; 1 \,]^T",
            r"c_2 = [\, 0,\; {-}\rho,\; 0,\; 0,\; 0,\; {-}1 \,]^T",
            r"c_3 = [\, 0,\; 0,\; a_2 c_1 + a_3 c_{13} + d_G s_{234},\; {-}s_1,\; {-}c_1,\; 0 \,]^T",
            r"c_4 = [\, 0,\; 0,\; a_3 c_1 + d_G s_{234},\; {-}s_1,\; {-}c_1,\; 0 \,]^T",
            r"c_5 = [\, 0,\; 0,\; d_G s_1,\; {-}s_1,\; {-}c_1,\; 0 \,]^T",
            r"\rho = a_2 c_2 + a_3 c_{23} + d_G s_{234}",
        ),
        (
            r"J = \begin{bmatrix} z_0 \times (p - o_0) & \cdots & z_4 \times (p - o_4) \\ z_0 & \cdots & z_4 "
            r"\end{bmatrix}",
        ),
        tr_later(
            "The sign of c₁ is wrong, c₂ turns about the waist's axis once more, and the roll is missing: rank 4 "
            "instead of 5."
        ),
        TEXT_POSE,
        "jacobian",
        columns_22,
        jacobian,
        rows=_AXES,
        columns=_JOINTS,
    ),
    Erratum(
        "000-24",
        "000",
        tr_later("(24) and (25)"),
        "rv-m1",
        "singularity",
        tr_later("A pseudo-inverse that needs full rank"),
        (r"\dot\theta = (J^T J)^{-1} J^T \dot x",),
        (r"\dot\theta = V\, \Sigma^{+} U^T \dot x",),
        tr_later(
            "At a singularity JᵀJ has no inverse; the singular value decomposition (or damping) gives what can be "
            "done. Shown: the joint speeds for 100 mm/s along x."
        ),
        degrees(30, 40, 0, 20, 60),
        "rate",
        pseudo_inverse_24,
        _by_svd,
        rows=_JOINTS,
        undefined=tr_later("Here JᵀJ is singular: the printed pseudo-inverse does not exist."),
    ),
)

_SINGULARITIES = (
    Erratum(
        "000-29",
        "000",
        tr_later("(29) and (30)"),
        "rv-m1",
        "singularity",
        tr_later("A family of singularities is missing"),
        (r"\sin\theta_3 = 0 \;\wedge\; \cos\theta_4 = 0",),
        (r"\sin\theta_3 = \cos\theta_4 = 0 \;\vee\; a_2 c_2 + a_3 c_{23} + d_G s_{234} = 0",),
        tr_later(
            "With the tip on the base axis the waist does not move it; that is reachable within the limits. Shown: "
            "the rank of the position part Ĵ."
        ),
        _tip_above_base(),
        "number",
        rank_29,
        _rank,
        rows=(tr_later("rank"),),
    ),
    Erratum(
        "000-31",
        "000",
        "(31)",
        "rv-m1",
        "singularity",
        tr_later("A stop of joint 2 taken for a singularity"),
        (r"\theta_2 = -\frac{\pi}{6} \;\wedge\; \theta_4 = \frac{\pi}{2}",),
        (r"\sigma_{min}(J_v) > 0",),
        tr_later(
            "Joint 2 is at its stop there: a barrier of the reach, but no column of Ĵ depends on the others. Shown: "
            "the rank of the position part Ĵ."
        ),
        degrees(0, -30, -60, 0, 0),
        "number",
        rank_31,
        _rank,
        rows=(tr_later("rank"),),
    ),
)

ERRATA_000_MOTION = (*_INVERSE, *_JACOBIAN, *_SINGULARITIES)
