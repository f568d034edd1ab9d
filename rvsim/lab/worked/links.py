"""Two links in a plane that must reach a point, and the angle that is left of a sum."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from rvsim.kinematics.inverse.elbow import elbow_up, solve_elbow
from rvsim.kinematics.inverse.words import ELBOW
from rvsim.lab.worked.figures import Quantity, wrapped
from rvsim.lab.worked.notebook import Equations, Notebook
from rvsim.lab.worked.values import Path
from rvsim.language import sentences, tr, tr_later

_STRAIGHT = 1e-7  # [rad]
_LAW = "\\frac{<u>^2+<w>^2-<a2>^2-<a3>^2}{2*<a2>*<a3>}"
_LEAN = "\\operatorname{atan2}(<a3,>*<S>,\\,<a2,>+<a3>*<C>)"


class Links(NamedTuple):
    """Rows i and i + 1 (from 0) turn two links; the second may lean by `lift` from its row's x axis."""

    i: int
    first: Quantity
    second: Quantity
    lift: Quantity | None = None


class Fold(NamedTuple):
    """One way to fold them: its path, θ of row i, θ of row i + 1 and the bend between the links."""

    path: Path
    theta: float
    next_theta: float
    bend: float


Names = Mapping[float, str]


def write_links(book: Notebook, path: Path, u: Quantity, w: Quantity, links: Links, names: Names) -> tuple[Fold, ...]:
    """The law of cosines with both signs; `names` tells what a positive (1.0) and a negative (−1.0) sine are called."""
    _, a2, a3, lift = links
    elbow = solve_elbow(np.array([u.value]), np.array([w.value]), a2.value, a3.value)
    square = u.value**2 + w.value**2
    cosine = (square - a2.value**2 - a3.value**2) / (2.0 * a2.value * a3.value)
    law = Quantity(f"C = \\cos {_bent(book, links)}", cosine, "number")
    equation = book.figures.equation(law, _LAW, u=u, w=w, a2=a2, a3=a3)
    if elbow.missing[0]:
        book.step(
            path, tr("Elbow"), tr(_TRIANGLE), equation, failure=_out_of_ring(book, math.sqrt(square), a2, a3, cosine)
        )
        return ()
    bend = float(elbow.bend[0])
    straight = min(bend, math.pi - bend) < _STRAIGHT
    order = sorted(names, key=lambda sign: (names[sign] == ELBOW[1], -sign))
    text = sentences(tr(_TRIANGLE), tr(_ONE_POSE if straight else _EITHER))
    book.step(path, tr("Elbow: two signs"), text, equation, choices=tuple(names[sign] for sign in order))
    leaning = lift.value if lift else 0.0
    direction, lean = float(elbow.direction[0]), float(elbow.lean[0])
    return tuple(
        Fold((*path, names[sign]), wrapped(direction - sign * lean), wrapped(sign * bend - leaning), sign * bend)
        for sign in order
    )


def elbow_names(book: Notebook, side: int, links: Links) -> dict[float, str]:
    """Which sign of the bend lifts the elbow, on a side (0: the point ahead of x1)."""
    ahead = (1.0 - 2.0 * side) * (-1.0 if book.rows.turn[0] < 0.0 else 1.0)
    up = elbow_up(links.first.value, links.second.value) * ahead
    return {up: ELBOW[0], -up: ELBOW[1]}


def fold_equations(book: Notebook, fold: Fold, u: Quantity, w: Quantity, links: Links) -> Equations:
    """The angle between the links, then the first link's as the difference of two angles."""
    i, a2, a3, lift = links
    C, S = Quantity("C", math.cos(fold.bend), "number"), Quantity("S", math.sin(fold.bend), "number")
    direction = math.atan2(w.value, u.value)
    alpha = Quantity("\\alpha", direction, "angle")
    beta = Quantity("\\beta", wrapped(direction - fold.theta), "angle")
    sign = "-" if fold.bend < 0.0 else ""
    bent = "\\operatorname{atan2}(<S,>,\\,<C,>)" + ("-<lift>" if lift else "")
    return (
        book.figures.equation(S, f"{sign}\\sqrt{{1-<C>^2}}", C),
        *book.joint(i + 1, fold.bend - (lift.value if lift else 0.0), bent, S, C, **({"lift": lift} if lift else {})),
        book.figures.equation(alpha, "\\operatorname{atan2}(<w,>,\\,<u,>)", u=u, w=w),
        book.figures.equation(beta, _LEAN, S, C, a2=a2, a3=a3),
        *book.joint(i, direction - beta.value, "<alpha,>-<beta>", alpha, beta),
    )


def sum_equations(
    book: Notebook, total: Quantity, parts: tuple[Quantity, ...], last: int, constant: float
) -> Equations:
    """The last angle of a sum: θ = total + constant − the others; written for q where that is simpler."""
    rows = book.rows
    theta = total.value + constant - sum(part.value for part in parts)
    others = "".join(f"-<part{k}>" for k in range(len(parts)))
    named = {f"part{k}": part for k, part in enumerate(parts)} | {"total": total}
    rest = math.remainder(constant - float(rows.offset[last]), 2.0 * math.pi)
    if rows.sign[last] > 0.0 and abs(rest) < 1e-9:
        q = Quantity(f"q_{last + 1}", total.value - sum(part.value for part in parts), "angle")
        return (book.figures.equation(q, "<total,>" + others, **named),)
    extra = f"{'+' if constant > 0.0 else '-'}{abs(math.degrees(constant)):g}^\\circ" if constant else ""
    return book.joint(last, theta, "<total,>" + extra + others, **named)


_TRIANGLE = tr_later("The law of cosines in the triangle of the two links.")
_EITHER = tr_later("The angle itself may have either sign: the elbow bends to one side or to the other.")
_ONE_POSE = tr_later("The elbow is straight here (or folded back): both signs give the same pose.")


def _bent(book: Notebook, links: Links) -> str:
    symbol = book.rows.symbol(links.i + 1)
    return f"({symbol}+{links.lift.symbol})" if links.lift else symbol


def _out_of_ring(book: Notebook, away: float, a2: Quantity, a3: Quantity, cosine: float) -> str:
    text = book.figures.text
    farthest, nearest = abs(a2.value) + abs(a3.value), abs(abs(a2.value) - abs(a3.value))
    cannot = (
        tr("No solution: a cosine cannot be above 1.")
        if cosine > 0.0
        else tr("No solution: a cosine cannot be below \u22121.")
    )
    if away > farthest:
        where = tr(
            "The point lies {distance} outside the ring that the links reach, which ends at {radius}.",
            distance=text(away - farthest, "length"),
            radius=text(farthest, "length"),
        )
    else:
        where = tr(
            "The point lies {distance} inside the hole that the links leave, which has a radius of {radius}.",
            distance=text(nearest - away, "length"),
            radius=text(nearest, "length"),
        )
    return sentences(cannot, where)
