"""The textbook arms: planar, articulated, spherical, SCARA, cylindrical, Cartesian."""

from __future__ import annotations

import math

import numpy as np

from rvsim.kinematics.inverse.closed_form import is_zero
from rvsim.kinematics.inverse.elbow import COSINE_TOLERANCE
from rvsim.kinematics.inverse.extension import AT_SHOULDER
from rvsim.kinematics.inverse.words import ELBOW, ELBOW_SIDES, EXTENSION, FACING, ONLY
from rvsim.lab.worked.figures import Quantity
from rvsim.lab.worked.links import Fold, Links, elbow_names, fold_equations, sum_equations, write_links
from rvsim.lab.worked.notebook import Equations, Notebook
from rvsim.lab.worked.target import place, write_target
from rvsim.lab.worked.values import Path
from rvsim.lab.worked.waist import OF_TOOL, Side, Waist, plane_equations, side_equations, write_waist
from rvsim.language import tr, tr_later
from rvsim.spatial.arrays import FloatArray

_PLANE = tr_later("The tool seen from the shoulder, in the plane of the arm: u along x₁, w along y₁.")
_FOLD = tr_later("With this sign; the first link points past the tool by the angle β.")


def _last_link(book: Notebook, i: int) -> tuple[Quantity, Quantity | None, Equations]:
    """The last link, from axis i + 1 to the tool's tip: its length, and λ, how far it leans from its x axis."""
    x, y = (float(v) for v in book.rows.T_n_tool[:2, 3])
    plain = np.allclose(book.rows.robot.T_flange_tool, np.eye(4), atol=1e-12)
    length = Quantity(book.rows.a_symbol(i) if plain else "L", math.hypot(x, y))
    lift = math.atan2(y, x)
    if abs(lift) <= 1e-12:
        return length, None, ()
    leaning = Quantity("\\lambda", lift, "angle")
    tip = Quantity("t_x", x), Quantity("t_y", y)
    angle = book.figures.equation(leaning, "\\operatorname{atan2}(<y,>,\\,<x,>)", x=tip[0], y=tip[1])
    return length, leaning, (book.figures.equation(length, "\\sqrt{<x>^2+<y>^2}", x=tip[0], y=tip[1]), angle)


# --- planar ----------------------------------------------------------------------------------------------------------


def solve_planar(book: Notebook, T: FloatArray) -> None:
    """Two links, two elbows."""
    S = book.rows.T_0_tool(T)
    write_target(book, S, flange=False)
    x, y, _ = place(S)
    length, lift, equations = _last_link(book, 1)
    links = Links(0, book.a(0), length, lift)
    if equations:
        book.step((), tr("The second link"), tr("From axis 2 to the tool's tip."), *equations)
    up = -math.copysign(1.0, links.first.value)
    for fold in write_links(book, (), x, y, links, {up: ELBOW[0], -up: ELBOW[1]}):
        book.step(fold.path, tr("Both angles"), tr(_FOLD), *fold_equations(book, fold, x, y, links))
        book.solved(fold.path, fold.theta, fold.next_theta)


# --- articulated -----------------------------------------------------------------------------------------------------


def solve_articulated(book: Notebook, T: FloatArray) -> None:
    """Two sides, two elbows."""
    rows = book.rows
    S = rows.T_0_tool(T)
    write_target(book, S, flange=False)
    x, y, z = place(S)
    length, lift, equations = _last_link(book, 2)
    if equations:
        book.step((), tr("The forearm"), tr("From axis 3 to the tool's tip."), *equations)
    offset = float(rows.turn[0]) * float(rows.d[1] + rows.d[2] + rows.T_n_tool[2, 3])
    links = Links(1, book.a(1), length, lift)
    waist = write_waist(book, (x, y), OF_TOOL, Quantity("d", 0.0 if abs(offset) <= 1e-9 else offset))
    for side in waist.sides:
        u, w = _into_plane(book, waist, side, z)
        for fold in write_links(book, side.path, u, w, links, elbow_names(book, side.turned, links)):
            book.step(fold.path, tr("Elbow and shoulder"), tr(_FOLD), *fold_equations(book, fold, u, w, links))
            book.solved(fold.path, side.theta1, fold.theta, fold.next_theta)


def _into_plane(book: Notebook, waist: Waist, side: Side, z: Quantity) -> tuple[Quantity, Quantity]:
    u, w, equations = plane_equations(book, waist, side, z)
    book.step(side.path, tr("Into the arm's plane"), tr(_PLANE), *side_equations(book, waist, side), *equations)
    return u, w


# --- spherical -------------------------------------------------------------------------------------------------------

_PYTHAGORAS = tr_later(
    "The squared distance from the shoulder, less the part across the sliding axis, is the square of L."
)
_ANY_SHOULDER = tr_later("The tool is at the shoulder: any q₂ will do. Here {angle} is taken.")
_SLIDE = tr_later("With this sign of L; what lies beyond the tool's own length is the joint's.")


def solve_spherical(book: Notebook, T: FloatArray) -> None:
    """Two sides, and the extension ahead of the shoulder or behind it."""
    rows = book.rows
    S = rows.T_0_tool(T)
    write_target(book, S, flange=False)
    x, y, z = place(S)
    c, s = math.cos(rows.theta[2]), math.sin(rows.theta[2])
    tip = rows.T_n_tool[:3, 3]
    across = Quantity("b", float(rows.a[1] + c * tip[0] - s * tip[1]))
    aside = float(rows.turn[0]) * float(rows.d[1] + rows.turn[1] * (s * tip[0] + c * tip[1]))
    symbol = "d_2" if aside == rows.d[1] else ("-d_2" if aside == -rows.d[1] else "d")
    waist = write_waist(book, (x, y), OF_TOOL, Quantity(symbol, aside))
    for side in waist.sides:
        u, w = _into_plane(book, waist, side, z)
        _write_slides(book, side, (u, w), across, float(tip[2]))


def _write_slides(book: Notebook, side: Side, point: tuple[Quantity, Quantity], across: Quantity, tip: float) -> None:
    u, w = point
    square = u.value**2 + w.value**2 - across.value**2
    size = Quantity("|L|", math.sqrt(max(square, 0.0)))
    template = "\\sqrt{<u>^2+<w>^2" + ("-<b>^2}" if across.value else "}")
    equation = book.figures.equation(size, template, u=u, w=w, b=across)
    if square < -2.0 * COSINE_TOLERANCE * across.value**2:
        away = book.figures.text(abs(across.value) - math.hypot(u.value, w.value), "length")
        failure = tr("No solution: the root is not real, the tool is {away} too near to the shoulder.", away=away)
        left = equation._replace(result="", value=0.0)
        book.step(side.path, tr("Extension"), tr(_PYTHAGORAS), left, failure=failure)
        return
    book.step(side.path, tr("Extension: two signs"), tr(_PYTHAGORAS), equation, choices=EXTENSION)
    for sign, name in zip((1.0, -1.0), EXTENSION, strict=True):
        _write_slide(book, side, (*side.path, name), (u, w), across, sign * size.value, tip)


def _write_slide(
    book: Notebook,
    side: Side,
    path: Path,
    point: tuple[Quantity, Quantity],
    across: Quantity,
    length: float,
    tip: float,
) -> None:
    if is_zero(across.value) and abs(length) <= AT_SHOULDER * book.rows.robot.size:
        _write_free_shoulder(book, side, path, length - tip)
        return
    (u, w), turn = point, float(book.rows.turn[1])
    alpha = Quantity("\\alpha", math.atan2(w.value, u.value), "angle")
    beta = Quantity("\\beta", math.atan2(turn * length, across.value), "angle")
    L, t = Quantity("L", length), Quantity("t_z", tip)
    lean = "\\operatorname{atan2}(<L,>,\\,<b,>)" if turn > 0.0 else "\\operatorname{atan2}(-<L>,\\,<b,>)"
    theta2 = alpha.value + beta.value
    book.step(
        path,
        tr("Shoulder and slide"),
        tr(_SLIDE),
        book.figures.equation(alpha, "\\operatorname{atan2}(<w,>,\\,<u,>)", u=u, w=w),
        book.figures.equation(beta, lean, L=L, b=across),
        *book.joint(1, theta2, "<alpha,>+<beta>", alpha, beta),
        *book.joint(2, length - tip, "<L,>-<t>" if tip else "<L,>", L=L, t=t),
    )
    book.solved(path, side.theta1, theta2, length - tip)


def _write_free_shoulder(book: Notebook, side: Side, path: Path, stroke: float) -> None:
    theta2 = book.taken(path, 1)
    text = tr(_ANY_SHOULDER, angle=book.figures.text(theta2, "angle"))
    book.step(path, tr("Shoulder and slide"), text)
    book.solved(path, side.theta1, theta2, stroke)


# --- SCARA -----------------------------------------------------------------------------------------------------------

_YAW = tr_later(
    "The tool of this arm stays upright. ψ is the yaw from its zero pose that comes nearest to the wanted rotation."
)
_STROKE = tr_later("The height is the stroke's alone.")
_SUM = tr_later("The turning axes add up to the yaw.")


def solve_scara(book: Notebook, T: FloatArray) -> None:
    """The yaw, the stroke, then two links in the horizontal plane."""
    S = book.rows.T_0_tool(T)
    write_target(book, S, flange=False)
    yaw = _write_yaw(book, S)
    x, y = _write_axis(book, S, yaw)
    stroke = _write_stroke(book, S)
    rows = book.rows
    c, s = math.cos(rows.theta[2]), math.sin(rows.theta[2])
    link = complex(rows.a[1] + rows.a[2] * c, rows.a[2] * s)
    lift = math.atan2(link.imag, link.real)
    second = book.a(1)._replace(value=abs(link))
    links = Links(0, book.a(0), second, Quantity("\\lambda", lift, "angle") if abs(lift) > 1e-12 else None)
    left = -math.copysign(1.0, links.first.value)
    for fold in write_links(book, (), x, y, links, {left: ELBOW_SIDES[0], -left: ELBOW_SIDES[1]}):
        book.step(fold.path, tr("Both links"), tr(_FOLD), *fold_equations(book, fold, x, y, links))
        _write_scara_end(book, fold, yaw, stroke)


def _write_scara_end(book: Notebook, fold: Fold, yaw: Quantity, stroke: float) -> None:
    fixed = -float(book.rows.theta[2])
    parts = book.angle(0, fold.theta), book.angle(1, fold.next_theta)
    book.step(fold.path, tr("Tool yaw"), tr(_SUM), *sum_equations(book, yaw, parts, 3, fixed))
    theta4 = yaw.value + fixed - fold.theta - fold.next_theta
    book.solved(fold.path, fold.theta, fold.next_theta, stroke, theta4)


def _write_yaw(book: Notebook, S: FloatArray) -> Quantity:
    M = S[:2, :3] @ book.rows.T_n_tool[:2, :3].T
    yaw = Quantity("\\psi", math.atan2(M[1, 0] - M[0, 1], M[0, 0] + M[1, 1]), "angle")
    m = {f"m{i}{j}": Quantity(f"m_{{{i}{j}}}", float(M[i - 1, j - 1]), "number") for i in (1, 2) for j in (1, 2)}
    matrix = book.figures.matrix("M", "{}^0R_t\\,({}^4R_t)^T", M, ("number", "number"))
    angle = book.figures.equation(yaw, "\\operatorname{atan2}(<m21,>-<m12>,\\,<m11,>+<m22>)", **m)
    book.step((), tr("Yaw"), tr(_YAW), matrix, angle)
    return yaw


def _write_axis(book: Notebook, S: FloatArray, yaw: Quantity) -> tuple[Quantity, Quantity]:
    """Where axis 4 stands: the tool's place, less the tool."""
    tip_x, tip_y = (float(v) for v in book.rows.T_n_tool[:2, 3])
    (x, y, _), c, s = place(S), math.cos(yaw.value), math.sin(yaw.value)
    if not (tip_x or tip_y):
        return x, y
    u = Quantity("x_4", x.value - (c * tip_x - s * tip_y))
    w = Quantity("y_4", y.value - (s * tip_x + c * tip_y))
    named = {"x": x, "y": y, "psi": yaw, "tx": Quantity("t_x", tip_x), "ty": Quantity("t_y", tip_y)}
    first = book.figures.equation(u, "<x,>-<tx>*\\cos <psi>+<ty>*\\sin <psi>", **named)
    second = book.figures.equation(w, "<y,>-<tx>*\\sin <psi>-<ty>*\\cos <psi>", **named)
    book.step((), tr("Axis 4"), tr("From the tool's tip back to axis 4."), first, second)
    return u, w


def _write_stroke(book: Notebook, S: FloatArray) -> float:
    z, rows = place(S)[2], book.rows
    raised = Quantity("d_1", float(rows.d.sum() + rows.T_n_tool[2, 3]))
    if abs(raised.value - rows.d[0]) > 1e-12:
        raised = raised._replace(symbol="h")
    value = z.value - raised.value
    book.step((), tr("Stroke"), tr(_STROKE), *book.joint(2, value, "<z,>-<h>", z=z, h=raised))
    return value


# --- cylindrical -----------------------------------------------------------------------------------------------------

_CYLINDRICAL = (f"{FACING[0]}, {EXTENSION[0]}", f"{FACING[1]}, {EXTENSION[1]}")


def solve_cylindrical(book: Notebook, T: FloatArray) -> None:
    """Facing the tool, or turned away with a negative extension."""
    rows = book.rows
    S = rows.T_0_tool(T)
    write_target(book, S, flange=False)
    x, y, z = place(S)
    origin, outward = rows.place((0.0, 0.0, 0.0)), rows.place((0.0, 0.0, 1.0)) - rows.place((0.0, 0.0, 0.0))
    offset = float(origin[0] * outward[1] - origin[1] * outward[0])
    names = _CYLINDRICAL if rows.sine[0] > 0.0 else _CYLINDRICAL[::-1]
    lead = Quantity("\\delta", math.atan2(outward[1], outward[0]), "angle")
    across = Quantity("d", 0.0 if abs(offset) <= 1e-9 else offset)
    waist = write_waist(book, (x, y), OF_TOOL, across, names, lead.value)
    start = Quantity("h", float(origin[2]))
    inner = Quantity("l", float(origin[0] * outward[0] + origin[1] * outward[1]))
    for side in waist.sides:
        turned = ("+<gamma>", "-<gamma>")[side.turned] if waist.gamma.value else ""
        base = ("<psi,>", "<psi,>+180^\\circ")[side.turned]
        theta1 = side.theta1 - lead.value
        r = Quantity("r", side.out)
        first = f"{'' if side.turned == 0 else '-'}\\sqrt{{<x>^2+<y>^2{'-<d>^2' if offset else ''}}}"
        book.step(
            side.path,
            tr("The three joints"),
            tr(
                "Height and distance are the two strokes' own. At q₁ = 0 the arm points {angle} from x.",
                angle=book.figures.text(lead.value, "angle"),
            ),
            *book.joint(0, theta1, base + turned + "-<delta>", waist.psi, waist.gamma, lead),
            *book.joint(1, z.value - start.value, "<z,>-<h>", z=z, h=start),
            book.figures.equation(r, first, x=x, y=y, d=Quantity("d", offset)),
            *book.joint(2, side.out - inner.value, "<r,>-<l>" if inner.value else "<r,>", r=r, l=inner),
        )
        book.solved(side.path, theta1, z.value - start.value, side.out - inner.value)


# --- Cartesian -------------------------------------------------------------------------------------------------------

_STROKES = tr_later(
    "The strokes' directions, the columns of D, and the tool's place p₀ at zero strokes make a linear system."
)


def solve_cartesian(book: Notebook, T: FloatArray) -> None:
    """One linear system."""
    rows = book.rows
    write_target(book, T, flange=False, base=True)
    R, shift = rows.T_base_0[:3, :3], rows.T_base_0[:3, 3]
    start = R @ rows.place((0.0, 0.0, 0.0)) + shift
    D = np.stack([R @ (rows.place(row) - rows.place((0.0, 0.0, 0.0))) for row in np.eye(3).tolist()], axis=1)
    values = np.linalg.solve(D, T[:3, 3] - start)
    matrix = book.figures.matrix("D", "\\begin{bmatrix} z_0 & z_1 & z_2 \\end{bmatrix}", D, ("number",) * 3)
    difference = book.figures.matrix("p-p_0", "", (T[:3, 3] - start)[:, None], ("length",))
    book.step((), tr("Strokes"), tr(_STROKES), matrix, difference)
    solved = book.figures.matrix(
        "q", "D^{-1}\\,(p-p_0)", [[rows.joint(i, v)] for i, v in enumerate(values)], ("length",)
    )
    path = (ONLY,)
    book.step(path, tr("Solve it"), tr("Each stroke moves the tool along its own direction."), solved)
    book.solved(path, *values.tolist())
