"""6R arms with three parallel axes, UR5e: shoulder, then wrist, then the planar elbow."""

from __future__ import annotations

import math

from rvsim.kinematics.inverse.ur import UNCERTAIN
from rvsim.kinematics.inverse.words import SHOULDERS, WRIST
from rvsim.lab.worked.figures import Quantity
from rvsim.lab.worked.links import Fold, Links, elbow_names, fold_equations, sum_equations, write_links
from rvsim.lab.worked.notebook import Equations, Notebook
from rvsim.lab.worked.spherical_wrist import write_centre
from rvsim.lab.worked.target import column, write_target
from rvsim.lab.worked.values import Path
from rvsim.lab.worked.waist import OF_AXIS_5, Side, plane_equations, side_equations, write_waist
from rvsim.language import tr, tr_later
from rvsim.spatial.arrays import FloatArray

_CENTRE = tr_later(
    "From the flange back along its axis a by d₆ to axis 5, which stands at d₄ beside the plane of the arm."
)
_PLANE = tr_later("Axis 5 seen from the shoulder, in the plane of the arm: u outwards, w upwards.")
_NORMAL = tr_later(
    "The flange's axes seen along the normal of the arm's plane are (s₅c₆, −s₅s₆, c₅): "
    "they tell cos θ₅, and sin θ₅ up to its sign."
)
_FREE = tr_later(
    "The flange's axis 6 is parallel to axes 2, 3 and 4 (sin θ₅ = 0): any q₆ will do, and the others make up for it. "
    "One value is taken on each branch."
)
_AXIS4 = tr_later(
    "With this sign: the wrist angles, then axis z₄, which gives the sum of the three parallel axes' angles."
)
_END = tr_later("From axis 5 back along z₄ by d₅: the end of the two links.")
_FOLD = tr_later("With this sign; the first link points past the end point by the angle β at the shoulder.")
_LAST = tr_later("The three parallel axes add up to the angle found above.")


def solve_parallel_axes(book: Notebook, T: FloatArray) -> None:
    """Up to eight branches, or why there are none."""
    rows = book.rows
    S = rows.T_0_n(T)
    write_target(book, S)
    x, y, z = write_centre(book, S, text=tr(_CENTRE))
    offset = Quantity(_offset_symbol(book), float(rows.turn[0] * rows.d[1:4].sum()))
    waist = write_waist(book, (x, y), OF_AXIS_5, offset, SHOULDERS)
    for side in waist.sides:
        u, w, in_plane = plane_equations(book, waist, side, z)
        book.step(side.path, tr("Into the arm's plane"), tr(_PLANE), *side_equations(book, waist, side), *in_plane)
        _write_wrists(book, S, side, u, w)


def _offset_symbol(book: Notebook) -> str:
    return "d_4" if not book.rows.d[1:3].any() else "d"


def _write_wrists(book: Notebook, S: FloatArray, side: Side, u: Quantity, w: Quantity) -> None:
    rows, (c, s) = book.rows, side.cs
    up = float(rows.turn[0])
    across, equations = {}, []
    for name in "noa":
        x, y, _ = column(S, name)
        part = Quantity(f"{name}_\\perp", up * (s.value * x.value - c.value * y.value), "number")
        template = "<s,>*<x>-<c>*<y>" if up > 0.0 else "<c,>*<y>-<s>*<x>"
        across[name] = part
        equations.append(book.figures.equation(part, template, c=c, s=s, x=x, y=y))
    sine = math.hypot(across["n"].value, across["o"].value)
    names = WRIST if rows.sine[4] > 0.0 else WRIST[::-1]
    order = sorted((1.0, -1.0), key=lambda sign: names[int(sign < 0.0)] == WRIST[1])
    choices = tuple(names[int(sign < 0.0)] for sign in order)
    free = sine < UNCERTAIN
    book.step(side.path, tr("Wrist: two signs"), tr(_FREE if free else _NORMAL), *equations, choices=choices)
    for sign, name in zip(order, choices, strict=True):
        path = (*side.path, name)
        taken = book.taken(path, 5) if free else None
        _write_arm(book, S, side, path, (u, w), sign, across, taken)


def _write_arm(
    book: Notebook,
    S: FloatArray,
    side: Side,
    path: Path,
    centre: tuple[Quantity, Quantity],
    sign: float,
    across: dict[str, Quantity],
    taken: float | None,
) -> None:
    """Wrist angles, the links' end, both elbows: with one sign of sin θ5."""
    theta5, theta6, wrist = _wrist_angles(book, across, sign, taken)
    z4, total, axis = _axis_4(book, S, side, theta6)
    book.step(path, tr("Wrist angles"), tr(_AXIS4), *wrist, *axis)
    u, w, end = _links_end(book, centre, z4, total)
    book.step(path, tr("The end of the two links"), tr(_END), *end)
    links = Links(1, book.a(1), book.a(2))
    for fold in write_links(book, path, u, w, links, elbow_names(book, side.turned, links)):
        book.step(fold.path, tr("Elbow and shoulder"), tr(_FOLD), *fold_equations(book, fold, u, w, links))
        book.step(fold.path, tr("Wrist 1"), tr(_LAST), *_last(book, fold, total))
        theta4 = total.value - fold.theta - fold.next_theta
        book.solved(fold.path, side.theta1, fold.theta, fold.next_theta, theta4, theta5, theta6)


def _wrist_angles(
    book: Notebook, across: dict[str, Quantity], sign: float, taken: float | None
) -> tuple[float, float, Equations]:
    """θ5 and θ6 from the components along the plane's normal."""
    turn4, turn5 = (float(v) for v in book.rows.turn[[3, 4]])
    kappa, n, o, a = -turn4 * turn5, across["n"], across["o"], across["a"]
    sine = math.hypot(n.value, o.value)
    theta5 = math.atan2(sign * sine, kappa * a.value)
    sn = Quantity("s", sine, "number")
    first = sign * turn4
    theta6 = math.atan2(-first * o.value, first * n.value) if taken is None else taken
    minus_s, minus_a = ("" if sign > 0.0 else "-"), ("" if kappa > 0.0 else "-")
    fifth = f"\\operatorname{{atan2}}({minus_s}<s,>,\\,{minus_a}<a,>)"
    sixth = "\\operatorname{atan2}(-<o>,\\,<n,>)" if first > 0.0 else "\\operatorname{atan2}(<o,>,\\,-<n>)"
    return (
        theta5,
        theta6,
        (
            book.figures.equation(sn, "\\sqrt{<n>^2+<o>^2}", n=n, o=o),
            *book.joint(4, theta5, fifth, s=sn, a=a),
            *book.joint(5, theta6, sixth if taken is None else "\\text{taken}", n=n, o=o),
        ),
    )


def _axis_4(
    book: Notebook, S: FloatArray, side: Side, theta6: float
) -> tuple[tuple[Quantity, Quantity], Quantity, Equations]:
    """z4 = ±(s6 n + c6 o) in the arm's plane, and the sum Σ of the parallel angles that it stands for."""
    rows, (c, s) = book.rows, side.cs
    up, turn4, turn5 = (float(v) for v in rows.turn[[0, 3, 4]])
    c6, s6 = Quantity("c_6", math.cos(theta6), "number"), Quantity("s_6", math.sin(theta6), "number")
    axes = turn5 * (s6.value * S[:3, 0] + c6.value * S[:3, 1])
    along = Quantity("z_u", float(c.value * axes[0] + s.value * axes[1]), "number")
    high = Quantity("z_w", float(up * axes[2]), "number")
    total = Quantity("\\Sigma", math.atan2(turn4 * along.value, -turn4 * high.value), "angle")
    figures = book.figures
    (nx, ny, nz), (ox, oy, oz) = column(S, "n"), column(S, "o")
    n_r = Quantity("n_r", c.value * nx.value + s.value * ny.value, "number")
    o_r = Quantity("o_r", c.value * ox.value + s.value * oy.value, "number")
    out = "<s6,>*<n>+<c6>*<o>" if turn5 > 0.0 else "-<s6>*<n>-<c6>*<o>"
    rise = out if turn5 * up == turn5 else ("-<s6>*<n>-<c6>*<o>" if turn5 > 0.0 else "<s6,>*<n>+<c6>*<o>")
    angle = "\\operatorname{atan2}(<u,>,\\,-<w>)" if turn4 > 0.0 else "\\operatorname{atan2}(-<u>,\\,<w,>)"
    return (
        (along, high),
        total,
        (
            figures.equation(n_r, "<c,>*<x>+<s>*<y>", c=c, s=s, x=nx, y=ny),
            figures.equation(o_r, "<c,>*<x>+<s>*<y>", c=c, s=s, x=ox, y=oy),
            figures.equation(along, out, s6=s6, c6=c6, n=n_r, o=o_r),
            figures.equation(high, rise, s6=s6, c6=c6, n=nz, o=oz),
            figures.equation(total, angle, u=along, w=high),
        ),
    )


def _links_end(
    book: Notebook, centre: tuple[Quantity, Quantity], z4: tuple[Quantity, Quantity], total: Quantity
) -> tuple[Quantity, Quantity, Equations]:
    """Axis 5 less d5 z4, and less a4 x4 where there is such a length."""
    d5, a4 = book.d(4), book.a(3)
    found, equations = [], []
    for name, start, axis, part, word in zip(
        "uw", centre, z4, (math.cos(total.value), math.sin(total.value)), ("cos", "sin"), strict=True
    ):
        end = Quantity(f"{name}_4", start.value - d5.value * axis.value - a4.value * part)
        template = "<start,>-<d5>*<axis>" + (f"-<a4>*\\{word} <total>" if a4.value else "")
        found.append(end)
        equations.append(book.figures.equation(end, template, start=start, d5=d5, axis=axis, a4=a4, total=total))
    return found[0], found[1], tuple(equations)


def _last(book: Notebook, fold: Fold, total: Quantity) -> Equations:
    return sum_equations(book, total, (book.angle(1, fold.theta), book.angle(2, fold.next_theta)), 3, 0.0)
