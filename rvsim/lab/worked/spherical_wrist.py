"""6R arms with a spherical wrist, as source 001 decouples the RV-1A: wrist centre, arm, then wrist."""

from __future__ import annotations

import math

import numpy as np

from rvsim.kinematics.inverse.words import WRIST
from rvsim.lab.worked.figures import Quantity
from rvsim.lab.worked.links import Fold, Links, elbow_names, fold_equations, write_links
from rvsim.lab.worked.notebook import Equations, Notebook
from rvsim.lab.worked.target import column, place, write_target
from rvsim.lab.worked.values import Equation
from rvsim.lab.worked.waist import OF_CENTRE, Side, plane_equations, side_equations, write_waist
from rvsim.language import tr, tr_later
from rvsim.spatial.arrays import FloatArray

_SINGULAR = 5e-10  # sin θ5: below it axes 4 and 6 are one


def solve_spherical_wrist(book: Notebook, T: FloatArray) -> None:
    """All eight branches, or why there are fewer."""
    rows = book.rows
    S = rows.T_0_n(T)
    write_target(book, S)
    d4, a3 = book.d(3), book.a(2)
    forearm, lift, equations = _forearm(book, a3, d4)
    x, y, z = write_centre(book, S, *equations)
    offset = Quantity("d", float(rows.turn[0] * (rows.d[1] + rows.d[2])))
    links = Links(1, book.a(1), forearm, lift)
    waist = write_waist(book, (x, y), OF_CENTRE, offset)
    for side in waist.sides:
        u, w, in_plane = plane_equations(book, waist, side, z)
        book.step(side.path, tr("Into the arm's plane"), tr(_PLANE), *side_equations(book, waist, side), *in_plane)
        for fold in write_links(book, side.path, u, w, links, elbow_names(book, side.turned, links)):
            book.step(fold.path, tr("Elbow and shoulder"), tr(_FOLD), *fold_equations(book, fold, u, w, links))
            _write_wrist(book, S, side, fold)


_CENTRE = tr_later(
    "Axes 4, 5 and 6 meet in the wrist centre, which the last three joints do not move. From the tool back along "
    "its axis a to that point."
)
_PLANE = tr_later("The wrist centre seen from the shoulder, in the plane of the arm: u along x₁, w along y₁.")
_FOLD = tr_later("With this sign; the first link points past the wrist centre by the angle β at the shoulder.")


def write_centre(
    book: Notebook, S: FloatArray, *equations: Equation, text: str = ""
) -> tuple[Quantity, Quantity, Quantity]:
    """The wrist's centre p − d6 a."""
    d6 = book.d(5)
    found, written = [], []
    for p, a, c in zip(place(S), column(S, "a"), place(S, "c"), strict=True):
        centre = c._replace(value=p.value - d6.value * a.value)
        found.append(centre)
        written.append(book.figures.equation(centre, "<p,>-<d6>*<a>", p=p, a=a, d6=d6))
    book.step((), tr("Wrist centre"), text or tr(_CENTRE), *written, *equations, erratum=("centre", {"d6": d6.value}))
    return found[0], found[1], found[2]


def _forearm(book: Notebook, a3: Quantity, d4: Quantity) -> tuple[Quantity, Quantity, Equations]:
    """From the elbow to the wrist centre: its length f, and λ, the angle it leans from x3."""
    turn = float(book.rows.turn[2])
    forearm = Quantity("f", math.hypot(a3.value, d4.value))
    lift = Quantity("\\lambda", math.atan2(-turn * d4.value, a3.value), "angle")
    template = "\\operatorname{atan2}(-<d4>,\\,<a3,>)" if turn > 0.0 else "\\operatorname{atan2}(<d4,>,\\,<a3,>)"
    figures = book.figures
    return (
        forearm,
        lift,
        (
            figures.equation(forearm, "\\sqrt{<a3>^2+<d4>^2}", a3=a3, d4=d4),
            figures.equation(lift, template, a3=a3, d4=d4),
        ),
    )


# --- the wrist -------------------------------------------------------------------------------------------------------


def _write_wrist(book: Notebook, S: FloatArray, side: Side, fold: Fold) -> None:
    """R36 = R03ᵀ R is a ZYZ rotation: two signs of sin θ5."""
    rows = book.rows
    R = _R_0_3(book, side.theta1, fold.theta + fold.next_theta).T @ S[:3, :3]
    matrix = book.figures.matrix("{}^3R_6", "({}^0R_3)^T\\,{}^0R_6", R, ("number",) * 3)
    sine = math.hypot(R[0, 2], R[1, 2])
    r13, r23 = (Quantity(f"r_{{{i}3}}", float(R[i - 1, 2]), "number") for i in (1, 2))
    length = book.figures.equation(Quantity("s", sine, "number"), "\\sqrt{<r13>^2+<r23>^2}", r13=r13, r23=r23)
    names = WRIST if rows.sine[4] > 0.0 else WRIST[::-1]
    free = sine < _SINGULAR
    order = sorted((1.0, -1.0), key=lambda sign: names[int(sign < 0.0)] == WRIST[1])
    choices = tuple(names[int(sign < 0.0)] for sign in order)
    text = tr(_FREE if free else _WRIST)
    book.step(fold.path, tr("Wrist: two signs"), text, matrix, length, choices=choices)
    for sign, name in zip(order, choices, strict=True):
        path = (*fold.path, name)
        angles, equations = _wrist_equations(book, R, sign, book.taken(path, 3) if free else None)
        book.step(path, tr("Wrist angles"), tr(_ANGLES_FREE if free else _ANGLES), *equations)
        book.solved(path, side.theta1, fold.theta, fold.next_theta, *angles)


_WRIST = tr_later(
    "What is left of the rotation is the wrist's alone, a rotation about three axes as with Euler's ZYZ angles. "
    "Its last column tells sin θ₅ up to the sign."
)
_FREE = tr_later(
    "Axes 4 and 6 are one line here (sin θ₅ = 0): only the sum or difference of their angles counts, "
    "and any q₄ will do."
)
_ANGLES = tr_later("With this sign of sin θ₅; θ₆ follows without a division, so it holds near the singularity too.")
_ANGLES_FREE = tr_later("One of infinitely many: q₄ is taken, q₆ follows from it.")


def _R_0_3(book: Notebook, theta1: float, bend: float) -> FloatArray:
    """The rotation (3, 3) of frame 3 in frame 0."""
    turn1, turn3 = (float(v) for v in book.rows.turn[[0, 2]])
    x1 = np.array([math.cos(theta1), math.sin(theta1), 0.0])
    y1, normal = np.array([0.0, 0.0, turn1]), turn1 * np.array([math.sin(theta1), -math.cos(theta1), 0.0])
    x3 = math.cos(bend) * x1 + math.sin(bend) * y1
    z3 = turn3 * (math.sin(bend) * x1 - math.cos(bend) * y1)
    return np.stack([x3, turn3 * normal, z3], axis=1)


def _wrist_equations(
    book: Notebook, R: FloatArray, sign: float, taken: float | None
) -> tuple[tuple[float, float, float], Equations]:
    """θ4, θ5, θ6 of a rotation (3, 3) = Rz(θ4) Rx(α4) Rz(θ5) Rx(α5) Rz(θ6)."""
    turn4, turn5 = (float(v) for v in book.rows.turn[[3, 4]])
    kappa, first = -turn4 * turn5, sign * turn5
    sine = math.hypot(R[0, 2], R[1, 2])
    theta4 = math.atan2(first * R[1, 2], first * R[0, 2]) if taken is None else taken
    theta5 = math.atan2(sign * sine, kappa * R[2, 2])
    c4, s4 = math.cos(theta4), math.sin(theta4)
    theta6 = math.atan2(kappa * (c4 * R[1, 0] - s4 * R[0, 0]), kappa * (c4 * R[1, 1] - s4 * R[0, 1]))
    r = {f"r{i}{j}": Quantity(f"r_{{{i}{j}}}", float(R[i - 1, j - 1]), "number") for i in (1, 2, 3) for j in (1, 2, 3)}
    s = Quantity("s", sine, "number")
    c, sn = Quantity("c_4", c4, "number"), Quantity("s_4", s4, "number")
    n = Quantity("m_1", c4 * R[1, 0] - s4 * R[0, 0], "number")
    o = Quantity("m_2", c4 * R[1, 1] - s4 * R[0, 1], "number")
    figures = book.figures
    fourth = book.joint(3, theta4, _atan2("r23", "r13", first, first), **r) if taken is None else _taken(book, theta4)
    return (theta4, theta5, theta6), (
        *fourth,
        *book.joint(4, theta5, _atan2("s", "r33", sign, kappa), s=s, **r),
        figures.equation(n, "<c,>*<r21>-<sn>*<r11>", c=c, sn=sn, **r),
        figures.equation(o, "<c,>*<r22>-<sn>*<r12>", c=c, sn=sn, **r),
        *book.joint(5, theta6, _atan2("n", "o", kappa, kappa), n=n, o=o),
    )


def _taken(book: Notebook, theta4: float) -> Equations:
    return book.joint(3, theta4, "\\text{taken}")


def _atan2(y: str, x: str, sign_y: float, sign_x: float) -> str:
    """The template atan2(±y, ±x)."""
    first, second = (f"<{name},>" if sign > 0.0 else f"-<{name}>" for name, sign in ((y, sign_y), (x, sign_x)))
    return f"\\operatorname{{atan2}}({first},\\,{second})"
