"""Lines, dots, frames and texts: what has a width in pixels."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QLineF, QPointF, Qt
from PySide6.QtGui import QPainter, QPolygonF

from rvsim.gui.renderers.painter_ink import (
    DASH,
    GAP,
    Stroke,
    pen,
    polygon,
    qcolor,
    shaded,
)
from rvsim.gui.renderers.painter_lens import Lens, Seen, clipped_pieces
from rvsim.gui.renderers.painter_raster import SolidPicture
from rvsim.gui.renderers.text_layout import Ground, Texts, written
from rvsim.scene import Color, Dots, Labels, Polyline, Segments, Triads
from rvsim.scene.palette import axis_colors

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

_TUBE_WIDTH = 4.0  # from this width on a line is shaded like a tube
_FINE = 5.0  # [pixels]
_SHORT, _MANY = 25, 200  # points
_AXIS_WIDTH = 2.2
_FAR = 20_000.0  # [pixels] a line that is longer runs far out of the picture
_FEW_DOTS = 200  # with more in one item they are a cloud
_AT_ONCE = 8  # lines: a picture may be painted in a thread, and Python has others run between two calls only


def polyline_strokes(seen: Seen[Polyline], lens: Lens, solids: SolidPicture | None) -> list[Stroke]:
    """A polyline, less what the solids hide of it."""
    before = lens.before(seen.eye)
    if solids is None and len(before) < _MANY and before.all():
        return [_line_stroke(float(seen.eye[:, 2].mean()), seen.pixels, seen.item, lens)] if len(before) > 1 else []
    strokes = []
    for eye in _runs(seen.eye, before):
        thin = _thinned(eye, lens)
        fine = thin if solids is None else _subdivided(thin, lens)
        pixels = lens.pixels(fine)
        shown = np.ones(len(fine), dtype=bool) if solids is None else ~solids.hides(pixels, fine[:, 2])
        strokes += [
            _line_stroke(float(fine[start:stop, 2].mean()), pixels[start:stop], seen.item, lens)
            for start, stop in _spans(shown)
        ]
    return strokes if before.all() else strokes + _cut_strokes(seen, lens)


def _runs(eye: FloatArray, visible: BoolArray) -> Iterator[FloatArray]:
    """The stretches of a line that are wholly before the eye, and numbers."""
    for start, stop in _spans(visible):
        yield eye[start:stop]


def _spans(mask: BoolArray) -> list[tuple[int, int]]:
    """(start, stop) of each stretch of at least two that are True."""
    if mask.all():
        return [(0, len(mask))] if len(mask) > 1 else []
    edges = np.flatnonzero(np.diff(np.concatenate([[False], mask, [False]]).astype(np.int8))).reshape(-1, 2)
    return [(int(start), int(stop)) for start, stop in edges if stop - start > 1]


def _subdivided(eye: FloatArray, lens: Lens) -> FloatArray:
    """With more points, so that no piece is much longer than a few pixels: what is hidden is told point by point."""
    steps = np.hypot(*np.diff(lens.pixels(eye), axis=0).T)
    counts = np.clip(np.ceil(steps / _FINE), 1, 400).astype(int)
    if counts.max() == 1:
        return eye
    firsts = np.repeat(np.arange(len(counts)), counts)
    begins = np.cumsum(counts) - counts
    shares = ((np.arange(len(firsts)) - begins[firsts]) / counts[firsts])[:, None]
    inner = eye[firsts] + shares * (eye[firsts + 1] - eye[firsts])
    return np.concatenate([inner, eye[-1:]])


def _thinned(eye: FloatArray, lens: Lens) -> FloatArray:
    """Without the points that no eye can tell apart: about one a pixel of the line's length is enough."""
    if len(eye) < _MANY:
        return eye
    steps = np.cumsum(np.abs(np.diff(lens.pixels(eye), axis=0)).sum(axis=1))
    keep = np.concatenate([[True], np.diff(np.floor(0.7 * steps), prepend=0.0) > 0])
    keep[-1] = True
    thinned: FloatArray = eye[keep]
    return thinned


def _cut_strokes(seen: Seen[Polyline], lens: Lens) -> list[Stroke]:
    """The pieces of a polyline that pass through the plane just before the eye."""
    inside = lens.before(seen.eye)
    crossing = np.flatnonzero(inside[1:] != inside[:-1])
    if not len(crossing):
        return []
    pieces = np.stack([seen.eye[crossing], seen.eye[crossing + 1]], axis=1)
    return [_line_stroke(lens.near, piece, seen.item, lens) for piece in clipped_pieces(pieces, lens)]


def _line_stroke(depth: float, pixels: FloatArray, item: Polyline, lens: Lens) -> Stroke:
    color, width, dashed = item.color, item.width, item.dashed
    if width < _TUBE_WIDTH:
        depth = math.inf  # paths lie under the figure, in the order of the scene: the actual one on the desired one
    if dashed:
        return Stroke(depth, partial(_draw_dashes, _dashes(pixels, lens), color, width))
    # Qt strokes short lines faster. But joints of see-through lines would show.
    long = len(pixels) > 2 * _SHORT and color.alpha >= 1.0
    lines = [polygon(piece) for piece in (_short_pieces(pixels) if long else [pixels])]
    if width >= _TUBE_WIDTH and color.alpha >= 1.0:
        return Stroke(depth, lambda painter: _draw_tube(painter, lines, color, width))
    return Stroke(depth, lambda painter: _draw_lines(painter, lines, color, width))


def _dashes(pixels: FloatArray, lens: Lens) -> list[QLineF]:
    """The dashes of a line, as straight pieces: Qt takes five times as long to cut and stroke them itself."""
    lengths = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(pixels, axis=0).T))])
    starts = _dash_starts(pixels, lengths, lens)
    cuts = np.stack([starts, np.minimum(starts + DASH, lengths[-1])], axis=1)
    x, y = (np.interp(cuts, lengths, pixels[:, axis]) for axis in (0, 1))
    return [QLineF(*piece) for piece in np.stack([x[:, 0], y[:, 0], x[:, 1], y[:, 1]], axis=1).tolist()]


def _dash_starts(pixels: FloatArray, lengths: FloatArray, lens: Lens) -> FloatArray:
    """Where along a line (k, 2) its dashes begin; of a line that runs far out of the picture, only those in it."""
    period = DASH + GAP
    if lengths[-1] <= _FAR:
        return np.arange(0.0, lengths[-1], period)
    enters, leaves = _shares_in_picture(pixels, lens)
    spans = np.diff(lengths)
    begins, ends = lengths[:-1] + enters * spans, lengths[:-1] + leaves * spans
    seen = np.flatnonzero(ends > begins)  # a comparison with nan is False
    stretches = [np.arange(math.floor(begins[i] / period) * period, ends[i], period) for i in seen]
    return np.unique(np.concatenate([np.empty(0), *stretches]))


def _shares_in_picture(pixels: FloatArray, lens: Lens) -> tuple[FloatArray, FloatArray]:
    """Of each piece of a line (k, 2) the shares (k - 1,) where it enters the picture and leaves it, by slabs."""
    begin, way = pixels[:-1], np.diff(pixels, axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        sides = np.stack([(edge - begin) / way for edge in (np.zeros(2), np.array([lens.width, lens.height]))])
    inside = (begin >= 0.0) & (begin <= [lens.width, lens.height])
    level = np.where(inside, np.inf, np.nan)  # along an axis in which it does not move it is inside, or never
    first = np.where(way == 0.0, -level, sides.min(axis=0))
    last = np.where(way == 0.0, level, sides.max(axis=0))
    return np.maximum(first.max(axis=1), 0.0), np.minimum(last.min(axis=1), 1.0)


def _draw_dashes(dashes: list[QLineF], color: Color, width: float, painter: QPainter) -> None:
    painter.setPen(pen(color, width, flat=True))
    painter.drawLines(dashes)


def _short_pieces(pixels: FloatArray) -> list[FloatArray]:
    return [pixels[start : start + _SHORT + 1] for start in range(0, len(pixels) - 1, _SHORT)]


def _draw_lines(painter: QPainter, lines: list[QPolygonF], color: Color, width: float) -> None:
    painter.setPen(pen(color, width))
    for line in lines:
        painter.drawPolyline(line)


def _draw_tube(painter: QPainter, lines: list[QPolygonF], color: Color, width: float) -> None:
    """A dark rim, the colour, and a light stripe towards the light: it also makes yellow readable on white."""
    _draw_lines(painter, lines, shaded(color, 0.6), width)
    _draw_lines(painter, lines, color, width - 2.0)
    lit = [line.translated(-0.12 * width, -0.14 * width) for line in lines]
    _draw_lines(painter, lit, shaded(color, 1.4), 0.28 * width)


def segments_strokes(seen: Seen[Segments], lens: Lens, smooth: bool = True) -> list[Stroke]:
    """All pieces at once, as far away as the farthest of them; thick see-through ones roughly if not `smooth`."""
    pieces = clipped_pieces(seen.eye.reshape(-1, 2, 3), lens)
    if not len(pieces):
        return []
    lines = [QLineF(*piece) for piece in pieces.reshape(-1, 4).tolist()]
    color, width = seen.item.color, seen.item.width
    rough = not smooth and color.alpha < 1.0 and width >= _TUBE_WIDTH  # what takes Qt six times as long

    def draw(painter: QPainter) -> None:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, not rough)
        painter.setPen(pen(color, width))
        for start in range(0, len(lines), _AT_ONCE):
            painter.drawLines(lines[start : start + _AT_ONCE])
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)

    return [Stroke(float(np.nanmax(seen.eye[:, 2])), draw)]


def dot_strokes(seen: Seen[Dots], lens: Lens, solids: SolidPicture | None) -> list[Stroke]:
    """Dots with a rim, a little nearer than the lines that end in them."""
    visible = lens.before(seen.eye)
    if len(visible) > _FEW_DOTS:
        return [_cloud_stroke(polygon(seen.pixels[visible]), seen.item)]
    if solids is not None:
        visible &= ~solids.hides(seen.pixels, seen.eye[:, 2])
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


def _cloud_stroke(points: QPolygonF, item: Dots) -> Stroke:
    """Very many dots at once, under the figure: each by itself would take a hundred times as long."""
    flat = pen(item.color, item.size)
    flat.setCapStyle(Qt.PenCapStyle.SquareCap)

    def draw(painter: QPainter) -> None:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
        painter.setPen(flat)
        painter.drawPoints(points)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)

    return Stroke(math.inf, draw)


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


def seen_texts(seen: Seen[Labels], lens: Lens) -> Texts:
    """The texts of an item that are before the eye and near the picture."""
    shown = [
        (label, (x, y))
        for label, (x, y), before in zip(
            seen.item.labels, seen.pixels.tolist(), lens.before(seen.eye).tolist(), strict=True
        )
        if before and -200.0 < x < lens.width + 200.0 and -50.0 < y < lens.height + 50.0
    ]
    return Texts(seen.item, [label for label, _ in shown], [at for _, at in shown])


def draw_text(painter: QPainter, place: tuple[float, float], text: str, color: Color, size: float, halo: Color) -> None:
    """A text with a halo, its base line starting at `place` [pixels]."""
    device = painter.device()
    placed = written(
        place, text, color, size, Ground(device.width(), device.height(), device.devicePixelRatioF(), halo)
    )
    painter.drawImage(placed.at, placed.picture)
