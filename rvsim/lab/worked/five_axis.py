"""5R arms, RV-M1 and AL5B: the plane, the wrist in it, the elbow, then pitch and roll. Source 000, (10) to (17)."""

from __future__ import annotations

import math

import numpy as np

from rvsim.kinematics.inverse.five_axis import FEASIBLE, tool_plane
from rvsim.kinematics.inverse.words import SIDES
from rvsim.lab.worked.figures import Quantity
from rvsim.lab.worked.links import Fold, Links, elbow_names, fold_equations, sum_equations, write_links
from rvsim.lab.worked.notebook import Equations, Notebook
from rvsim.lab.worked.target import column, place, write_target
from rvsim.lab.worked.waist import Side
from rvsim.language import tr, tr_later
from rvsim.spatial.arrays import FloatArray


def solve_five_axis(book: Notebook, T: FloatArray) -> None:
    """All four branches, or why there are none."""
    S = book.rows.T_0_n(T)
    write_target(book, S)
    for side in write_plane(book, S):
        _write_side(book, S, side)


def write_plane(book: Notebook, S: FloatArray, names: tuple[str, str] = SIDES) -> tuple[Side, ...]:
    """The vertical plane through the base axis that holds the tip and the tool axis: two sides, or none."""
    x, y, _ = place(S)
    ax, ay, _ = column(S, "a")
    size = book.rows.robot.size
    names = names if book.rows.sine[0] > 0.0 else names[::-1]
    free = book.taken(names[:1], 0)
    tip_x, tip_y, axis_x, axis_y = (np.array([v.value]) for v in (x, y, ax, ay))
    plane = tool_plane(tip_x, tip_y, axis_x, axis_y, size, free)
    dx, dy = float(plane.x[0]), float(plane.y[0])
    across = ax.value * dy - ay.value * dx
    by_tip = math.hypot(x.value, y.value) > 1e-6 * size
    psi = Quantity("\\psi", math.atan2(dy, dx), "angle")
    equations, text = _azimuth(book, psi, (x, y), (ax, ay), by_tip=by_tip)
    if plane.infeasible[0]:
        lean = math.asin(min(1.0, abs(across)))
        failure = tr(_LEANS, lean=book.figures.text(lean, "angle"))
        if abs(across) <= FEASIBLE:
            failure = tr("No solution: the tip lies beside the vertical plane of the tool axis.")
        book.step((), tr("Waist"), text, *equations, failure=failure)
        return ()
    px, py = (float(v) for v in (book.rows.T_base_0 @ S)[:2, 3])
    erratum = {"x": x.value, "y": y.value, "psi": psi.value, "px": px, "py": py}
    book.step((), tr("Waist: two ways"), text, *equations, choices=names, erratum=("waist", erratum))
    r = x.value * dx + y.value * dy
    return Side(names[:1], 0, psi.value, r), Side(names[1:], 1, psi.value + math.pi, -r)


_LEANS = tr_later(
    "No solution: the tool axis leans {lean} out of the vertical plane through the base axis and the tip. "
    "This arm cannot turn it sideways."
)
_WAIST = tr_later(
    "The tool axis a must lie in the vertical plane through the base axis and the tip: a⊥, its part across it, "
    "must be 0. The arm faces the tip, or is turned away from it."
)
_BY_TOOL = tr_later(
    "The tip is on the base axis (x = y = 0), so the tool axis tells the plane; the arm may face either way."
)
_ANY = tr_later(
    "The tip is on the base axis and the tool axis is vertical: any q₁ will do, and q₅ turns against it. "
    "Here {angle} is taken."
)


def _azimuth(
    book: Notebook, psi: Quantity, tip: tuple[Quantity, Quantity], axis: tuple[Quantity, Quantity], *, by_tip: bool
) -> tuple[Equations, str]:
    """ψ, and the words for what it follows from."""
    (x, y), (ax, ay) = tip, axis
    if by_tip:
        side = Quantity("a_\\perp", (ax.value * y.value - ay.value * x.value) / math.hypot(x.value, y.value), "number")
        azimuth = book.figures.equation(psi, "\\operatorname{atan2}(<y,>,\\,<x,>)", x=x, y=y)
        s, c = (
            Quantity("\\sin\\psi", math.sin(psi.value), "number"),
            Quantity("\\cos\\psi", math.cos(psi.value), "number"),
        )
        leaning = book.figures.equation(side, "<ax,>*<s>-<ay>*<c>", ax=ax, ay=ay, s=s, c=c)
        return (azimuth, leaning), tr(_WAIST)
    if math.hypot(ax.value, ay.value) <= 1e-10:
        return (), tr(_ANY, angle=book.figures.text(psi.value, "angle"))
    same = math.cos(psi.value) * ax.value + math.sin(psi.value) * ay.value > 0.0
    template = "\\operatorname{atan2}(<ay,>,\\,<ax,>)" if same else "\\operatorname{atan2}(-<ay>,\\,-<ax>)"
    return (book.figures.equation(psi, template, ax=ax, ay=ay),), tr(_BY_TOOL)


# --- one side --------------------------------------------------------------------------------------------------------


def _write_side(book: Notebook, S: FloatArray, side: Side) -> None:
    r, phi, equations = plane_coordinates(book, S, side)
    text = (
        tr("Turned away: how far out the tip is, and the pitch of the tool axis.")
        if side.turned
        else tr("Facing it: how far out the tip is, and the pitch of the tool axis.")
    )
    book.step(side.path, tr("Into the arm's plane"), text, *equations)
    u, w = _write_wrist(book, S, side, r, phi)
    links = Links(1, book.a(1), book.a(2))
    for fold in write_links(book, side.path, u, w, links, elbow_names(book, side.turned, links)):
        _write_fold(book, S, side, fold, (u, w, phi), links)


def plane_coordinates(book: Notebook, S: FloatArray, side: Side) -> tuple[Quantity, Quantity, Equations]:
    """θ1, the tip's distance r along x1 and the tool axis's pitch φ, counted from x1 towards y1."""
    figures, (c, s) = book.figures, side.cs
    (x, y, _), (ax, ay, az) = place(S), column(S, "a")
    psi = Quantity("\\psi", side.theta1 - side.turned * math.pi, "angle")
    down = book.rows.turn[0] < 0.0
    out = Quantity("a_r", ax.value * c.value + ay.value * s.value, "number")
    r = Quantity("r", side.out)
    phi = Quantity("\\varphi", math.atan2(-az.value if down else az.value, out.value), "angle")
    pitch = "\\operatorname{atan2}(-<az>,\\,<out,>)" if down else "\\operatorname{atan2}(<az,>,\\,<out,>)"
    return (
        r,
        phi,
        (
            *book.joint(0, side.theta1, ("<psi,>", "<psi,>+180^\\circ")[side.turned], psi),
            figures.equation(r, "<x,>*<c>+<y>*<s>", x=x, y=y, c=c, s=s),
            figures.equation(out, "<ax,>*<c>+<ay>*<s>", ax=ax, ay=ay, c=c, s=s),
            figures.equation(phi, pitch, az=az, out=out),
        ),
    )


def _write_wrist(book: Notebook, S: FloatArray, side: Side, r: Quantity, phi: Quantity) -> tuple[Quantity, Quantity]:
    """The wrist's place in the plane, seen from the shoulder."""
    rows, z = book.rows, place(S)[2]
    a1, d1, a4, d5 = book.a(0), book.d(0), book.a(3), book.d(4)
    up, tilt = float(rows.turn[0]), float(rows.turn[3])
    c, s = math.cos(phi.value), math.sin(phi.value)
    u = Quantity("u", r.value - a1.value - d5.value * c + tilt * a4.value * s)
    w = Quantity("w", up * (z.value - d1.value) - d5.value * s - tilt * a4.value * c)
    plus, minus = ("+", "-") if tilt > 0.0 else ("-", "+")
    out = "<r,>" + ("-<a1>" if a1.value else "") + "-<d5>*\\cos <phi>"
    high = ("<z,>-<d1>" if up > 0.0 else "<d1>-<z>") + "-<d5>*\\sin <phi>"
    if a4.value:
        out, high = out + f"{plus}<a4>*\\sin <phi>", high + f"{minus}<a4>*\\cos <phi>"
    named = {"r": r, "z": z, "a1": a1, "d1": d1, "a4": a4, "d5": d5, "phi": phi}
    erratum = {
        "z": z.value,
        "d1": d1.value,
        "d5": d5.value,
        "phi": phi.value,
        "w": w.value,
        "u": u.value,
        "rho": abs(r.value),
    }
    book.step(
        side.path,
        tr("Back to the wrist"),
        tr("From the tip along the tool axis to the wrist, seen from the shoulder: u outwards, w upwards."),
        book.figures.equation(u, out, **named),
        book.figures.equation(w, high, **named),
        erratum=("wrist", erratum),
    )
    return u, w


def _write_fold(
    book: Notebook,
    S: FloatArray,
    side: Side,
    fold: Fold,
    known: tuple[Quantity, Quantity, Quantity],
    links: Links,
) -> None:
    u, w, phi = known
    theta2, theta3 = book.angle(1, fold.theta), book.angle(2, fold.next_theta)
    a2, a3 = links.first.value, links.second.value
    numbers = {"u": u.value, "w": w.value, "a2": a2, "a3": a3, "q2": fold.theta, "q3": fold.next_theta}
    elbow = fold_equations(book, fold, u, w, links)
    book.step(fold.path, tr("Elbow and shoulder"), tr(_FOLD), *elbow, erratum=("links", numbers))
    constant = 0.5 * math.pi * float(book.rows.turn[3])
    pitch = sum_equations(book, phi, (theta2, theta3), 3, constant)
    numbers |= {"phi": phi.value}
    book.step(fold.path, tr("Wrist pitch"), tr(_PITCH), *pitch, erratum=("pitch", numbers))
    theta5, roll = roll_equations(book, S, side, 4, float(book.rows.turn[3] * book.rows.turn[0]))
    book.step(fold.path, tr("Roll"), tr(_ROLL), *roll)
    theta4 = phi.value + constant - fold.theta - fold.next_theta
    book.solved(fold.path, side.theta1, fold.theta, fold.next_theta, theta4, theta5)


_FOLD = tr_later("With this sign; the first link points past the wrist by the angle β at the shoulder.")
_PITCH = tr_later("The three parallel axes add up to the pitch.")
_ROLL = tr_later("The rest of the rotation: n and o, seen along the normal of the plane.")


def roll_equations(
    book: Notebook, S: FloatArray, side: Side, i: int, sign: float, fixed: float = 0.0
) -> tuple[float, Equations]:
    """The angle of row i (from 0) that turns about the tool axis: from the parts of n and o across the plane.

    `sign` is that of z₁ × the axis; a `fixed` angle turns about it as well.
    """
    figures, (c, s) = book.figures, side.cs
    across = {}
    for name in "no":
        x, y, _ = column(S, name)
        part = Quantity(f"{name}_\\perp", s.value * x.value - c.value * y.value, "number")
        across[name] = part, figures.equation(part, "<s,>*<x>-<c>*<y>", c=c, s=s, x=x, y=y)
    (n, n_equation), (o, o_equation) = across["n"], across["o"]
    theta = math.atan2(sign * n.value, sign * o.value) - fixed
    template = "\\operatorname{atan2}(<n,>,\\,<o,>)" if sign > 0.0 else "\\operatorname{atan2}(-<n>,\\,-<o>)"
    if fixed:
        template += f"-{math.degrees(fixed):g}^\\circ"
    return theta, (n_equation, o_equation, *book.joint(i, theta, template, n=n, o=o))
