"""The cubic spline through points, as MATLAB's `spline` makes it: the source's letter is drawn with it.

Its linear system is solved here, by numpy alone: a library with a banded solver would be a sixth of a bundle, and half
a second of imports.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rvsim.errors import ShapeError
from rvsim.language import tr
from rvsim.robot.arrays import FloatArray, frozen_array

_DENSE = 100  # knots; of more, every other one is eliminated first


def spline_points(knots: ArrayLike, values: ArrayLike, at: ArrayLike) -> FloatArray:
    """The not-a-knot cubic spline through values (k, d) at increasing knots (k,), evaluated at (m,): (m, d).

    The third derivative is continuous across the second and the last but one knot (de Boor, A Practical Guide to
    Splines, ch. IV). Outside the knots the end pieces go on.

    Raises:
        ShapeError: fewer than four knots, or knots and values do not fit together.
    """
    x = frozen_array("spline knots", knots, (-1,))
    if len(x) < 4:
        raise ShapeError(tr("spline knots"), tr("(at least 4,)"), x.shape)
    y = frozen_array("spline values", values, (len(x), -1))
    slopes = knot_slopes(x, y, "not-a-knot")
    t = frozen_array("spline parameters", at, (-1,))
    piece = np.clip(np.searchsorted(x, t, side="right") - 1, 0, len(x) - 2)
    return _hermite(x, y, slopes, piece, t)


def knot_slopes(
    x: FloatArray, y: FloatArray, ends: str, first: FloatArray | None = None, last: FloatArray | None = None
) -> FloatArray:
    """(k, d) first derivatives at the knots x (k,) of values y (k, d) that make the second derivative continuous.

    Args:
        ends: "natural", "clamped" (with the slopes `first` and `last` (d,)) or "not-a-knot".
    """
    h = np.diff(x)
    rise = np.diff(y, axis=0) / h[:, None]
    below, middle, above, right = np.zeros(len(h)), np.ones(len(x)), np.zeros(len(h)), np.zeros_like(y)
    below[:-1], above[1:], middle[1:-1] = h[1:], h[:-1], 2.0 * (h[:-1] + h[1:])
    right[1:-1] = 3.0 * (h[1:, None] * rise[:-1] + h[:-1, None] * rise[1:])
    if ends == "not-a-knot":
        (middle[0], above[0]), right[0] = _not_a_knot(h[0], h[1], rise[0], rise[1])
        (middle[-1], below[-1]), right[-1] = _not_a_knot(h[-1], h[-2], rise[-1], rise[-2])
    elif ends == "natural":
        middle[0], above[0], right[0] = 2.0, 1.0, 3.0 * rise[0]
        below[-1], middle[-1], right[-1] = 1.0, 2.0, 3.0 * rise[-1]
    else:
        right[0], right[-1] = first, last
    return _tridiagonal(below, middle, above, right)


def _tridiagonal(below: FloatArray, middle: FloatArray, above: FloatArray, right: FloatArray) -> FloatArray:
    """(k, d) the solution of the system with these diagonals, in time and memory linear in k.

    Cyclic reduction (Golub and Van Loan, Matrix Computations, 4th ed., §4.5): every other unknown is expressed by its
    two neighbours, which leaves such a system of half the size. The ends stay, for their rows are not dominated by the
    diagonal; all others are, so that nothing has to be exchanged.
    """
    if len(middle) <= _DENSE:
        return np.asarray(np.linalg.solve(np.diag(below, -1) + np.diag(middle) + np.diag(above, 1), right))
    gone = np.arange(1, len(middle) - 1, 2)
    stays = np.delete(np.arange(len(middle)), gone)
    left, up = below[gone - 1] / middle[gone], above[gone] / middle[gone]  # x[gone] = known - left x[-1] - up x[+1]
    known = right[gone] / middle[gone, None]
    diagonal, rest = middle.copy(), right.copy()
    diagonal[gone - 1] -= above[gone - 1] * left
    diagonal[gone + 1] -= below[gone] * up
    rest[gone - 1] -= above[gone - 1, None] * known
    rest[gone + 1] -= below[gone, None] * known
    lower, upper = below.copy(), above.copy()
    upper[gone - 1], lower[gone] = -above[gone - 1] * up, -below[gone] * left
    solution = np.empty_like(right)
    solution[stays] = _tridiagonal(lower[stays[1:] - 1], diagonal[stays], upper[stays[:-1]], rest[stays])
    solution[gone] = known - left[:, None] * solution[gone - 1] - up[:, None] * solution[gone + 1]
    return solution


def _not_a_knot(h0: float, h1: float, rise0: FloatArray, rise1: FloatArray) -> tuple[list[float], FloatArray]:
    """The row of an end knot: the third derivatives of its first two pieces are equal."""
    span = h0 + h1
    return [h1, span], ((h0 + 2.0 * span) * h1 * rise0 + h0**2 * rise1) / span


def _hermite(x: FloatArray, y: FloatArray, slopes: FloatArray, piece: NDArray[np.intp], t: FloatArray) -> FloatArray:
    h = (x[piece + 1] - x[piece])[:, None]
    u = (t - x[piece])[:, None] / h
    start = (1.0 + 2.0 * u) * (1.0 - u) ** 2 * y[piece] + h * u * (1.0 - u) ** 2 * slopes[piece]
    return np.asarray(start + u**2 * (3.0 - 2.0 * u) * y[piece + 1] + h * u**2 * (u - 1.0) * slopes[piece + 1])
