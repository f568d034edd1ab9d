"""Lines, dots, frames and texts: what has a width in pixels."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QLineF, QPointF
from PySide6.QtGui import QPainter, QPolygonF

from rvsim.gui.renderers.painter_ink import Stroke, pen, polygon, qcolor, shaded, text_anchor, text_picture
from rvsim.gui.renderers.painter_lens import Lens, Seen, clipped_pieces
from rvsim.scene import Color, Dots, Labels, Polyline, Segments, Triads
from rvsim.scene.palette import axis_colors

FloatArray = NDArray[np.float64]

_TUBE_WIDTH = 4.0  # from this width on a line is shaded like a tube
_CHUNKS = 48
_AXIS_WIDTH = 2.2


def polyline_strokes(seen: Seen[Polyline], lens: Lens, among_solids: bool) -> list[Stroke]:
    """A polyline, in chunks where solids may hide parts of it."""
    strokes = []
    for eye, pixels in _runs(seen, lens):
        for start, stop in _chunks(len(eye), among_solids):
            depth = float(eye[start:stop, 2].mean())
            strokes.append(_line_stroke(depth, _thinned(pixels[start:stop]), seen.item))
    return strokes + _cut_strokes(seen, lens)


def _runs(seen: Seen[Polyline], lens: Lens) -> Iterator[tuple[FloatArray, FloatArray]]:
    """The stretches of a polyline that are wholly before the eye and numbers."""
    visible = lens.before(seen.eye)
    if visible.all():
        if len(visible) > 1:
            yield seen.eye, seen.pixels
        return
    edges = np.flatnonzero(np.diff(np.concatenate([[False], visible, [False]]).astype(np.int8)))
    for start, stop in edges.reshape(-1, 2):
        if stop - start > 1:
            yield seen.eye[start:stop], seen.pixels[start:stop]


def _chunks(count: int, among_solids: bool) -> Iterator[tuple[int, int]]:
    size = max(count // _CHUNKS, 8) if among_solids else count
    for start in range(0, count - 1, size):
        yield start, min(start + size + 1, count)


def _thinned(pixels: FloatArray) -> FloatArray:
    """Without the points that no eye can tell apart: at most one for each half pixel of the line's length."""
    if len(pixels) < 200:
        return pixels
    steps = np.cumsum(np.abs(np.diff(pixels, axis=0)).sum(axis=1))
    keep = np.concatenate([[True], np.diff(np.floor(2.0 * steps), prepend=0.0) > 0])
    keep[-1] = True
    thinned: FloatArray = pixels[keep]
    return thinned


def _cut_strokes(seen: Seen[Polyline], lens: Lens) -> list[Stroke]:
    """The pieces of a polyline that pass through the plane just before the eye."""
    inside = lens.before(seen.eye)
    crossing = np.flatnonzero(inside[1:] != inside[:-1])
    if not len(crossing):
        return []
    pieces = np.stack([seen.eye[crossing], seen.eye[crossing + 1]], axis=1)
    return [_line_stroke(lens.near, piece, seen.item) for piece in clipped_pieces(pieces, lens)]


def _line_stroke(depth: float, pixels: FloatArray, item: Polyline) -> Stroke:
    line, color, width, dashed = polygon(pixels), item.color, item.width, item.dashed
    if width >= _TUBE_WIDTH and not dashed and color.alpha >= 1.0:
        return Stroke(depth, lambda painter: _draw_tube(painter, line, color, width))
    return Stroke(depth, lambda painter: _draw_line(painter, line, color, width, dashed))


def _draw_line(painter: QPainter, line: QPolygonF, color: Color, width: float, dashed: bool) -> None:
    painter.setPen(pen(color, width, dashed))
    painter.drawPolyline(line)


def _draw_tube(painter: QPainter, line: QPolygonF, color: Color, width: float) -> None:
    """A dark rim, the colour, and a light stripe towards the light: it also makes yellow readable on white."""
    _draw_line(painter, line, shaded(color, 0.6), width, False)
    _draw_line(painter, line, color, width - 2.0, False)
    painter.setPen(pen(shaded(color, 1.4), 0.28 * width))
    painter.drawPolyline(line.translated(-0.12 * width, -0.14 * width))


def segments_strokes(seen: Seen[Segments], lens: Lens) -> list[Stroke]:
    """All pieces at once, as far away as the farthest of them."""
    pieces = clipped_pieces(seen.eye.reshape(-1, 2, 3), lens)
    if not len(pieces):
        return []
    lines = [QLineF(*piece) for piece in pieces.reshape(-1, 4).tolist()]
    color, width = seen.item.color, seen.item.width

    def draw(painter: QPainter) -> None:
        painter.setPen(pen(color, width))
        painter.drawLines(lines)

    return [Stroke(float(np.nanmax(seen.eye[:, 2])), draw)]


def dot_strokes(seen: Seen[Dots], lens: Lens) -> list[Stroke]:
    """Dots with a rim, a little nearer than the lines that end in them."""
    visible = lens.before(seen.eye)
    nearer = 0.01 * lens.distance
    return [
        _dot_stroke(float(depth) - nearer, float(x), float(y), seen.item)
        for (x, y), depth in zip(seen.pixels[visible], seen.eye[visible, 2], strict=True)
    ]


def _dot_stroke(depth: float, x: float, y: float, item: Dots) -> Stroke:
    centre, radius, color = QPointF(x, y), item.size / 2, item.color

    def draw(painter: QPainter) -> None:
        painter.setPen(pen(shaded(color, 0.55), 1.2))
        painter.setBrush(qcolor(color))
        painter.drawEllipse(centre, radius - 0.6, radius - 0.6)
        if radius > 4.0:
            painter.setPen(pen(shaded(color, 1.55), 0.3 * radius))
            painter.drawPoint(centre - QPointF(0.22 * radius, 0.25 * radius))

    return Stroke(depth, draw)


def triad_strokes(seen: Seen[Triads], lens: Lens, background: Color) -> list[Stroke]:
    """Three coloured axes a frame, with letters beyond their ends if asked for."""
    eye, strokes = seen.eye.reshape(-1, 4, 3), []
    for axis, color in enumerate(axis_colors(background), start=1):
        pieces = eye[:, [0, axis]]
        shown = lens.before(pieces).all(axis=1)
        lines = lens.pixels(pieces[shown])
        depths = pieces[shown].mean(axis=1)[:, 2]
        letter = "xyz"[axis - 1] if seen.item.letters else ""
        for line, depth in zip(lines, depths, strict=True):
            strokes.append(_axis_stroke(float(depth), line, color.faded(seen.item.alpha), letter, background))
    return strokes


def _axis_stroke(depth: float, line: FloatArray, color: Color, letter: str, background: Color) -> Stroke:
    (x0, y0), (x1, y1) = line.tolist()
    length = float(np.hypot(x1 - x0, y1 - y0))

    def draw(painter: QPainter) -> None:
        painter.setPen(pen(color, _AXIS_WIDTH))
        painter.drawLine(QPointF(x0, y0), QPointF(x1, y1))
        if letter and length > 12.0:  # an axis that points at the eye has no room for its letter
            beyond = 1.0 + 7.0 / length
            place = (x0 + beyond * (x1 - x0) - 3.0, y0 + beyond * (y1 - y0) + 3.5)
            draw_text(painter, place, letter, color, 10.5, background)

    return Stroke(depth, draw)


def draw_labels(painter: QPainter, seen: Seen[Labels], lens: Lens, background: Color) -> None:
    """All texts of an item."""
    visible = lens.before(seen.eye)
    for label, (x, y), shown in zip(seen.item.labels, seen.pixels.tolist(), visible.tolist(), strict=True):
        if shown and -200.0 < x < lens.width + 200.0 and -50.0 < y < lens.height + 50.0:
            place = (x + label.shift[0], y + label.shift[1])
            draw_text(painter, place, label.text, label.color, label.size, background)


def draw_text(painter: QPainter, place: tuple[float, float], text: str, color: Color, size: float, halo: Color) -> None:
    """A text with a halo, its base line starting at `place` [pixels], on whole pixels of the device."""
    ratio = painter.device().devicePixelRatioF()
    left, up = text_anchor(size)
    x, y = (round((at - by) * ratio) / ratio for at, by in zip(place, (left, up), strict=True))
    painter.drawImage(QPointF(x, y), text_picture(text, color, size, halo, ratio))
