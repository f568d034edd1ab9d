"""Joint 1: the arm's plane turns until it holds a point, facing it or turned away from it."""

from __future__ import annotations

import math
from typing import NamedTuple

from rvsim.kinematics.inverse.elbow import COSINE_TOLERANCE
from rvsim.kinematics.inverse.words import SIDES
from rvsim.lab.worked.figures import Quantity
from rvsim.lab.worked.notebook import Equations, Notebook
from rvsim.lab.worked.values import Path
from rvsim.language import tr, tr_later

_SMALLEST = 1e-300  # [m] in the place of a distance of 0, which nothing can be divided by
_ON_AXIS = 1e-10  # of the arm's size, as in kinematics.inverse.waist


class Side(NamedTuple):
    """One side: its path, whether it is turned away (0 or 1), θ1, and how far out the point lies along x1."""

    path: Path
    turned: int
    theta1: float
    out: float

    @property
    def cs(self) -> tuple[Quantity, Quantity]:
        """cos θ1 and sin θ1 for formulas."""
        return Quantity("c_1", math.cos(self.theta1), "number"), Quantity("s_1", math.sin(self.theta1), "number")


class Point(NamedTuple):
    """What is said of the point that the plane must hold: where the plane stands, and where there is no way."""

    beside: str
    through: str
    on_axis: str
    too_near: str


OF_TOOL = Point(
    tr_later("The arm's plane stands beside the base axis by a fixed distance; it can hold the tool in two ways."),
    tr_later("The arm's plane must hold the tool: the arm faces it, or is turned away from it."),
    tr_later("The tool lies on the base axis, so the waist may stand anywhere: any q₁ will do. Here {angle} is taken."),
    tr_later(
        "No solution: the tool is {away} from the base axis and must be at least {least} away. It lies {missing} "
        "too near."
    ),
)
OF_CENTRE = Point(
    tr_later(
        "The arm's plane stands beside the base axis by a fixed distance; it can hold the wrist centre in two ways."
    ),
    tr_later("The arm's plane must hold the wrist centre: the arm faces it, or is turned away from it."),
    tr_later(
        "The wrist centre lies on the base axis, so the waist may stand anywhere: any q₁ will do. Here {angle} is "
        "taken."
    ),
    tr_later(
        "No solution: the wrist centre is {away} from the base axis and must be at least {least} away. It lies "
        "{missing} too near."
    ),
)
OF_AXIS_5 = Point(
    tr_later(
        "The arm's plane stands beside the base axis by a fixed distance; it can hold the wrist (axis 5) in two ways."
    ),
    tr_later("The arm's plane must hold the wrist (axis 5): the arm faces it, or is turned away from it."),
    tr_later(
        "The wrist (axis 5) lies on the base axis, so the waist may stand anywhere: any q₁ will do. Here {angle} is "
        "taken."
    ),
    tr_later(
        "No solution: the wrist (axis 5) is {away} from the base axis and must be at least {least} away. It lies "
        "{missing} too near."
    ),
)


class Waist(NamedTuple):
    """A point (x, y), its azimuth ψ, and γ, how far the plane's offset turns the waist."""

    x: Quantity
    y: Quantity
    psi: Quantity
    gamma: Quantity
    sides: tuple[Side, ...]


def write_waist(
    book: Notebook,
    point: tuple[Quantity, Quantity],
    of: Point,
    offset: Quantity,
    names: tuple[str, str] = SIDES,
    lead: float = 0.0,
) -> Waist:
    """θ1 for a point of the arm's plane, which stands at `offset` along (sin θ1, −cos θ1): two sides, or none.

    At θ1 = 0 the arm faces the direction `lead`.
    """
    x, y, D = *point, offset.value
    rho = math.hypot(x.value, y.value)
    choices = names if book.rows.sine[0] > 0.0 else names[::-1]
    free = not D and rho <= _ON_AXIS * book.rows.robot.size
    psi = book.taken((choices[0],), 0) + lead if free else math.atan2(y.value, x.value)
    gamma = math.asin(max(-1.0, min(1.0, D / max(rho, _SMALLEST)))) if D else 0.0
    waist = Waist(x, y, Quantity("\\psi", psi, "angle"), Quantity("\\gamma", gamma, "angle"), ())
    equations = () if free else _equations(book, waist, Quantity("\\rho", rho), offset)
    if rho * rho - D * D < -2.0 * COSINE_TOLERANCE * D * D:
        book.step((), tr("Waist"), tr(of.beside), *equations, failure=_too_near(book, rho, abs(D), of))
        return waist
    text = _free(book, of, psi - lead) if free else tr(of.beside if D else of.through)
    book.step((), tr("Waist: two ways"), text, *equations, choices=choices)
    out = math.sqrt(max(rho * rho - D * D, 0.0))
    turn = math.atan2(D, out)
    return waist._replace(
        sides=(Side(choices[:1], 0, psi + turn, out), Side(choices[1:], 1, psi + math.pi - turn, -out))
    )


def side_equations(book: Notebook, waist: Waist, side: Side) -> Equations:
    """θ1 on one side."""
    turned = ("+<gamma>", "-<gamma>")[side.turned] if waist.gamma.value else ""
    start = ("<psi,>", "<psi,>+180^\\circ")[side.turned]
    return book.joint(0, side.theta1, start + turned, waist.psi, waist.gamma)


def plane_equations(book: Notebook, waist: Waist, side: Side, z: Quantity) -> tuple[Quantity, Quantity, Equations]:
    """How far out the point lies in the arm's plane and how high, both from joint 2."""
    (c, s), (x, y) = side.cs, waist[:2]
    d1, a1 = book.d(0), book.a(0)
    down = book.rows.turn[0] < 0.0
    u = Quantity("u", side.out - a1.value)
    w = Quantity("w", d1.value - z.value if down else z.value - d1.value)
    template = "<x,>*<c>+<y>*<s>" + ("-<a1>" if a1.value else "")
    height = ("<d1>-<z>" if down else "<z,>-<d1>") if d1.value else ("-<z>" if down else "<z,>")
    return (
        u,
        w,
        (
            book.figures.equation(u, template, x=x, y=y, c=c, s=s, a1=a1),
            book.figures.equation(w, height, z=z, d1=d1),
        ),
    )


def _equations(book: Notebook, waist: Waist, rho: Quantity, offset: Quantity) -> Equations:
    figures, x, y = book.figures, waist.x, waist.y
    psi = figures.equation(waist.psi, "\\operatorname{atan2}(<y,>,\\,<x,>)", x=x, y=y)
    if not offset.value:
        return (psi,)
    distance = figures.equation(rho, "\\sqrt{<x>^2+<y>^2}", x=x, y=y)
    if rho.value < abs(offset.value):
        return psi, distance
    return psi, distance, figures.equation(waist.gamma, "\\arcsin\\frac{<D,>}{<rho,>}", D=offset, rho=rho)


def _free(book: Notebook, of: Point, theta1: float) -> str:
    return tr(of.on_axis, angle=book.figures.text(theta1, "angle"))


def _too_near(book: Notebook, rho: float, D: float, of: Point) -> str:
    text = book.figures.text
    return tr(of.too_near, away=text(rho, "length"), least=text(D, "length"), missing=text(D - rho, "length"))
