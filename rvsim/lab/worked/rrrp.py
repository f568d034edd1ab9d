"""RRRP arm of source 003: the plane, the side that fits, then tool axis, roll and extension."""

from __future__ import annotations

import math

from rvsim.kinematics.inverse.five_axis import FEASIBLE
from rvsim.kinematics.inverse.words import FACING
from rvsim.lab.worked.figures import Quantity
from rvsim.lab.worked.five_axis import roll_equations, write_plane
from rvsim.lab.worked.notebook import Equations, Notebook
from rvsim.lab.worked.target import column, place, write_target
from rvsim.lab.worked.waist import Side
from rvsim.language import tr, tr_later
from rvsim.spatial.arrays import FloatArray

_NAMES = (tr_later("facing the tool"), FACING[1])
_SHOULDER = tr_later(
    "The tool axis a is z₂, so it gives q₂. It must pass the shoulder at the distance of the second link: "
    "e, how far it is from that, must be 0."
)
_ROLL = tr_later("The rest of the rotation: n and o, seen along the normal of the plane.")
_EXTENSION = tr_later("The way along the tool axis, from the foot of the link to the tip.")


def solve_rrrp(book: Notebook, T: FloatArray) -> None:
    """The one solution of a pose, and why the other side is none."""
    S = book.rows.T_0_n(T)
    write_target(book, S)
    sides = [side._replace(path=(name,)) for side, name in zip(write_plane(book, S, _NAMES), _NAMES, strict=False)]
    misses = [abs(_shoulder(book, S, side)[1].value) for side in sides]
    for side, miss in zip(sides, misses, strict=True):
        _write_side(book, S, side, fits=miss == min(misses) and miss <= FEASIBLE * book.rows.robot.size)


def _write_side(book: Notebook, S: FloatArray, side: Side, *, fits: bool) -> None:
    theta2, miss, u, w, equations = _shoulder(book, S, side)
    if not fits:
        away = book.figures.text(abs(miss.value), "length")
        failure = tr("No solution on this side: the tool axis passes {away} from where the arm can hold it.", away=away)
        book.step(side.path, tr("Shoulder"), tr(_SHOULDER), *equations, failure=failure)
        return
    book.step(side.path, tr("Shoulder"), tr(_SHOULDER), *equations)
    turn = float(book.rows.turn[0] * book.rows.turn[1])
    theta3, roll = roll_equations(book, S, side, 2, turn, float(book.rows.theta[3]))
    n, o = column(S, "n"), column(S, "o")
    numbers = {"q1": side.theta1, "q3": book.rows.joint(2, theta3)}
    numbers |= {"nx": n[0].value, "ny": n[1].value, "ox": o[0].value, "oy": o[1].value}
    book.step(side.path, tr("Roll"), tr(_ROLL), *roll, erratum=("roll", numbers))
    length, extension = _extension(book, S, side, u, w)
    numbers = {"q2": theta2, "w": w.value, "a2": float(book.rows.a[1]), "d3": float(book.rows.d[2])}
    book.step(side.path, tr("Extension"), tr(_EXTENSION), *extension, erratum=("extension", numbers))
    book.solved(side.path, side.theta1, theta2, theta3, length)


def _shoulder(book: Notebook, S: FloatArray, side: Side) -> tuple[float, Quantity, Quantity, Quantity, Equations]:
    """θ2, the miss e, the tip (u, w) seen from the shoulder, and how they follow."""
    figures, (c, s), (x, y, z), (ax, ay, az) = book.figures, side.cs, place(S), column(S, "a")
    turn, up = float(book.rows.turn[1]), float(book.rows.turn[0])
    a1, a2, d1 = book.a(0), book.a(1), book.d(0)
    out = Quantity("a_r", ax.value * c.value + ay.value * s.value, "number")
    theta2 = math.atan2(turn * out.value, -turn * up * az.value)
    u, w = Quantity("u", side.out - a1.value), Quantity("w", up * (z.value - d1.value))
    c2, s2 = Quantity("c_2", math.cos(theta2), "number"), Quantity("s_2", math.sin(theta2), "number")
    e = Quantity("e", u.value * c2.value + w.value * s2.value - a2.value)
    psi = Quantity("\\psi", side.theta1 - side.turned * math.pi, "angle")
    first, second = ("" if turn > 0.0 else "-"), ("-" if turn * up > 0.0 else "")
    angle = f"\\operatorname{{atan2}}({first}<out,>,\\,{second}<az,>)"
    return (
        theta2,
        e,
        u,
        w,
        (
            *book.joint(0, side.theta1, ("<psi,>", "<psi,>+180^\\circ")[side.turned], psi),
            figures.equation(out, "<ax,>*<c>+<ay>*<s>", ax=ax, ay=ay, c=c, s=s),
            *book.joint(1, theta2, angle, out=out, az=az),
            figures.equation(u, "<x,>*<c>+<y>*<s>" + ("-<a1>" if a1.value else ""), x=x, y=y, c=c, s=s, a1=a1),
            figures.equation(w, "<z,>-<d1>" if up > 0.0 else "<d1>-<z>", z=z, d1=d1),
            figures.equation(e, "<u,>*<c2>+<w>*<s2>-<a2>", u=u, w=w, c2=c2, s2=s2, a2=a2),
        ),
    )


def _extension(book: Notebook, S: FloatArray, side: Side, u: Quantity, w: Quantity) -> tuple[float, Equations]:
    c, s = side.cs
    ax, ay, az = column(S, "a")
    up, d3 = float(book.rows.turn[0]), book.d(2)
    out = Quantity("a_r", ax.value * c.value + ay.value * s.value, "number")
    length = u.value * out.value + w.value * up * az.value - d3.value
    template = f"<u,>*<out>{'+' if up > 0.0 else '-'}<w>*<az>-<d3>"
    return length, book.joint(3, length, template, u=u, w=w, out=out, az=az, d3=d3)
