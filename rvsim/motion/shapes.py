"""Curves in a plane as points (m, 2) [m] about its origin, with exact corners; `drawn_on` puts them into space."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rvsim.errors import ShapeError
from rvsim.language import tr
from rvsim.motion.path import Path
from rvsim.motion.spline import knot_slopes
from rvsim.robot.arrays import FloatArray, frozen_array

_COLLINEAR = 1e-9  # of the size: three points on a line have no circle
HOP_STEP = 3.0  # of the spacing: how far apart points are where the pen is up
_TIP_UP = 0.5 * math.pi  # the first corner of a polygon or star points along y


@dataclass(frozen=True, eq=False)
class Drawing:
    """A curve of points (m, d), the indices of its corners (c,), and where the pen is up on the way to a point (m,).

    Corners None are for whoever follows it to find: a spline can turn as sharply as any corner.
    """

    points: FloatArray
    corners: NDArray[np.intp] | None
    pen_up: NDArray[np.bool_] | None = None


def _smooth(points: FloatArray) -> Drawing:
    return Drawing(points, np.empty(0, dtype=np.intp))


def arc(radius: float, begin: float, sweep: float, samples: int) -> Drawing:
    """About the origin, from the angle `begin` on by `sweep` [rad], anticlockwise where it is positive."""
    return ellipse(radius, radius, samples, begin, sweep)


def circle(radius: float, samples: int) -> Drawing:
    """Once around the origin; the last point is the first."""
    return ellipse(radius, radius, samples)


def ellipse(a: float, b: float, samples: int, begin: float = 0.0, sweep: float = math.tau) -> Drawing:
    """With semi-axes a along x and b along y, from the parameter `begin` on by `sweep` [rad]."""
    t = np.linspace(begin, begin + sweep, max(samples, 2))
    points = np.column_stack([a * np.cos(t), b * np.sin(t)])
    if abs(sweep) == math.tau:
        points[-1] = points[0]
    return _smooth(points)


def regular_polygon(corners: int, radius: float, samples: int) -> Drawing:
    """Through equally spaced corners on a circle and back to the first, which points along y.

    Raises:
        ShapeError: fewer than three corners.
    """
    if corners < 3:
        raise ShapeError(tr("polygon corners"), tr("(at least 3,)"), (corners,))
    return _through_turns(corners, 1, radius, samples)


def five_pointed_star(radius: float, samples: int) -> Drawing:
    """The pentagram in one stroke: each edge skips a corner of the regular pentagon; a tip points along y."""
    return _through_turns(5, 2, radius, samples)


def _through_turns(corners: int, skip: int, radius: float, samples: int) -> Drawing:
    turn = _TIP_UP + math.tau * skip / corners * np.arange(corners + 1)
    knots = radius * np.column_stack([np.cos(turn), np.sin(turn)])
    knots[-1] = knots[0]
    return polyline(knots, samples)


def polyline(knots: ArrayLike, samples: int) -> Drawing:
    """Straight from knot to knot (k, d): every knot exactly, the other points spread over the edges by their lengths.

    Args:
        samples: of the whole; never fewer than there are knots.
    """
    corners = frozen_array("knots", knots, (-1, np.shape(knots)[-1]))
    if len(corners) < 2:
        return Drawing(corners, np.empty(0, dtype=np.intp))
    pieces = _shares(np.linalg.norm(np.diff(corners, axis=0), axis=1), samples - 1)
    return Drawing(*_in_pieces(corners, pieces))


def _in_pieces(corners: FloatArray, pieces: Sequence[int]) -> tuple[FloatArray, NDArray[np.intp]]:
    """Straight from corner to corner (k, d), each edge in so many equal pieces: points, and where the corners are."""
    edges = [
        start + np.arange(count)[:, None] / count * (end - start)
        for start, end, count in zip(corners[:-1], corners[1:], pieces, strict=True)
    ]
    return np.concatenate([*edges, corners[-1:]]), np.cumsum(pieces)[:-1].astype(np.intp)


def _shares(lengths: FloatArray, pieces: int) -> list[int]:
    """How many of `pieces` each edge gets, at least one: by length, the largest remainders first."""
    total = float(lengths.sum())
    if total <= 0.0:
        return [1] * len(lengths)
    wanted = np.maximum(lengths / total * max(pieces, len(lengths)), 1.0)
    counts = np.floor(wanted + 1e-9).astype(int)
    missing = max(pieces - int(counts.sum()), 0)
    counts[np.argsort(counts - wanted, kind="stable")[:missing]] += 1
    return [int(count) for count in counts]


def spline_curve(knots: ArrayLike, samples: int, ends: str = "natural") -> Drawing:
    """The cubic spline through knots (k, d), its parameter the distance between them along straight lines.

    Args:
        ends: "natural", "not-a-knot" (natural below four knots) or "closed": on to the first one, smooth there too.

    Raises:
        ShapeError: fewer than two knots.
    """
    known = frozen_array("spline knots", knots, (-1, np.shape(knots)[-1]))
    known = known[np.concatenate([[True], np.any(np.diff(known, axis=0) != 0.0, axis=1)])]
    if len(known) < 2:
        raise ShapeError(tr("spline knots"), tr("(at least 2 different ones, …)"), known.shape)
    if ends == "closed" and len(known) > 2:
        return Drawing(_closed_spline(known, samples), None)
    x = _chords(known)
    slopes = knot_slopes(x, known, "not-a-knot" if ends == "not-a-knot" and len(known) > 3 else "natural")
    return Drawing(_hermite(x, known, slopes, np.linspace(0.0, x[-1], max(samples, 2))), None)


def _closed_spline(known: FloatArray, samples: int) -> FloatArray:
    """The periodic one: two more turns before and after make its ends as good as smooth; then exactly one is kept."""
    ring = known[:-1] if np.allclose(known[0], known[-1], atol=1e-12) else known
    turns = 5
    knots = np.concatenate([np.tile(ring, (turns, 1)), ring[:1]])
    x = _chords(knots)
    first, last = 2 * len(ring), 3 * len(ring)
    t = np.linspace(x[first], x[last], max(samples, 2))
    points = _hermite(x, knots, knot_slopes(x, knots, "natural"), t)
    points[-1] = points[0]
    return points


def _chords(knots: FloatArray) -> FloatArray:
    return np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(knots, axis=0), axis=1))])


def _hermite(x: FloatArray, y: FloatArray, slopes: FloatArray, t: FloatArray) -> FloatArray:
    """The cubic pieces with these values and slopes at x, evaluated at t."""
    piece = np.clip(np.searchsorted(x, t, side="right") - 1, 0, len(x) - 2)
    h = np.diff(x)[piece, None]
    u = (t[:, None] - x[piece, None]) / h
    start = (1.0 + 2.0 * u) * (1.0 - u) ** 2 * y[piece] + h * u * (1.0 - u) ** 2 * slopes[piece]
    return np.asarray(start + u**2 * (3.0 - 2.0 * u) * y[piece + 1] + h * u**2 * (u - 1.0) * slopes[piece + 1])


def arc_through(start: ArrayLike, via: ArrayLike, end: ArrayLike, samples: int) -> FloatArray:
    """(m, 3) the circular arc from `start` over `via` to `end` (3,); points on a line give the straight line.

    The centre by the perpendicular bisectors in the plane of the three points.
    """
    a, b, c = (np.asarray(point, dtype=np.float64) for point in (start, via, end))
    ab, ac = b - a, c - a
    normal = np.cross(ab, ac)
    area = float(normal @ normal)
    if area <= (_COLLINEAR * max(float(ab @ ab), float(ac @ ac))) ** 2 or area == 0.0:
        return polyline(np.array([a, b, c]), samples).points
    center = a + (float(ab @ ab) * np.cross(ac, normal) + float(ac @ ac) * np.cross(normal, ab)) / (2.0 * area)
    u = a - center
    v = np.cross(normal / math.sqrt(area), u)
    sweep = math.atan2(float((c - center) @ v), float((c - center) @ u)) % math.tau
    t = np.linspace(0.0, sweep, max(samples, 2))[:, None]
    points = center + np.cos(t) * u + np.sin(t) * v
    points[0], points[-1] = a, c
    return np.asarray(points)


def strokes(lines: Sequence[ArrayLike], spacing: float, lift: float) -> Drawing:
    """Pen strokes (k, 2) one after the other: (m, 3) points in the plane, z = `lift` on the way between two strokes.

    Args:
        spacing: the largest distance between neighbouring points of a stroke [m].
        lift: how high the pen goes, along the plane's normal [m].
    """
    points: list[FloatArray] = []
    corners: list[int] = []
    pen_up: list[bool] = []
    for line in lines:
        flat = np.asarray(line, dtype=np.float64)
        edges = np.linalg.norm(np.diff(flat, axis=0), axis=1)
        drawn, bends = _in_pieces(flat, [max(math.ceil(edge / spacing - 1e-9), 1) for edge in edges])
        stroke = np.column_stack([drawn, np.zeros(len(drawn))])
        done = sum(map(len, points))
        if points:
            hop, turns = _hop(points[-1][-1], stroke[0], spacing, lift)
            corners += [done - 1, *(done + turns).tolist()]
            points.append(hop)
            pen_up += [True] * len(hop)
            done += len(hop)
            corners.append(done)
        corners += (done + bends[_sharp(stroke, bends)]).tolist()
        points.append(stroke)
        pen_up += [len(points) > 1, *([False] * (len(stroke) - 1))]
    return Drawing(np.concatenate(points), np.array(corners, dtype=np.intp), np.array(pen_up))


def _hop(start: FloatArray, end: FloatArray, spacing: float, lift: float) -> tuple[FloatArray, NDArray[np.intp]]:
    """Up, across and down again, without the two ends; and the two places where it turns."""
    up = np.array([0.0, 0.0, lift])
    knots = np.array([start, start + up, end + up, end])
    edges = np.linalg.norm(np.diff(knots, axis=0), axis=1)
    points, turns = _in_pieces(knots, [max(math.ceil(edge / (HOP_STEP * spacing)), 1) for edge in edges])
    return points[1:-1], turns - 1


def _sharp(points: FloatArray, corners: NDArray[np.intp]) -> NDArray[np.bool_]:
    """Which of the corners turn by more than a curved letter's own: 40°."""
    before, after = points[corners] - points[corners - 1], points[corners + 1] - points[corners]
    cosine = np.sum(before * after, axis=1) / (np.linalg.norm(before, axis=1) * np.linalg.norm(after, axis=1) + 1e-30)
    return np.asarray(cosine < math.cos(math.radians(40.0)))


def drawn_on(T_base_plane: ArrayLike, drawing: Drawing, *, name: str = "drawing", title: str = "") -> Path:
    """The drawing in the x-y plane of T_base_plane (4, 4), orientation free."""
    T = frozen_array("T_base_plane", T_base_plane, (4, 4))
    flat = drawing.points
    local = np.column_stack([flat, np.zeros(len(flat))]) if flat.shape[1] == 2 else flat
    points = T[:3, 3] + local @ T[:3, :3].T
    return Path(name, points, None, title, pen_up=drawing.pen_up, known_corners=drawing.corners)
