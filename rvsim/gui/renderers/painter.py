"""Draws a scene with QPainter: everything projected together, sorted by depth, painted from far to near.

It needs no OpenGL, works off-screen and is the faster renderer where OpenGL is only software.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QImage, QPainter, QPaintEvent
from PySide6.QtWidgets import QWidget

from rvsim.gui.renderers.painter_ink import Stroke, polygon, qcolor, text_scale
from rvsim.gui.renderers.painter_lens import BOX_TOP, Lens, Seen, clipped_polygon, look_at
from rvsim.gui.renderers.painter_lines import (
    dot_strokes,
    polyline_strokes,
    seen_texts,
    segments_strokes,
    triad_strokes,
)
from rvsim.gui.renderers.painter_raster import SolidPicture, render_solids
from rvsim.gui.renderers.painter_shadow import draw_shadow
from rvsim.gui.renderers.painter_solids import Solid
from rvsim.gui.renderers.text_layout import Ground, Placed, arranged, floor_texts, is_floor
from rvsim.language import tr_later
from rvsim.scene import Box, Camera, Capsule, Color, Dots, Item, Labels, Polyline, Scene, Segments, Triads
from rvsim.scene.floor import FLOOR_KEY
from rvsim.scene.gizmo import GIZMO_KEY


class _Layers(NamedTuple):
    """The things of a scene by the way they are painted, the lowest first."""

    floor: list[Seen[Item]]
    ghosts: list[Seen[Solid]]  # see-through
    solids: list[Seen[Solid]]
    lines: list[Seen[Item]]
    triads: list[Seen[Triads]]
    gizmo: list[Seen[Item]]
    labels: list[Seen[Labels]]


def paint_scene(painter: QPainter, scene: Scene, camera: Camera, width: int, height: int, smooth: bool = True) -> None:
    """Paints a scene into `width` × `height` device-independent pixels from the painter's origin.

    Points that are nan, or behind the eye, are left out. Without `smooth` the edges of solids
    and ghosts are rough, which is faster.
    """
    lens = Lens(camera, max(width, 1), max(height, 1))
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    layers = _layers(look_at(scene.items, lens))
    _paint_floor(painter, layers, lens, camera, scene.background)
    _paint_ghosts(painter, layers.ghosts, lens, smooth)
    solids = render_solids(layers.solids, lens, painter.device().devicePixelRatioF(), smooth)
    if solids is not None:
        solids.draw(painter)
    _paint(painter, [stroke for seen in layers.lines for stroke in _line_strokes(seen, lens, solids, smooth)])
    _paint(painter, [stroke for seen in layers.triads for stroke in triad_strokes(seen, lens, scene.background)])
    for seen in layers.gizmo:  # nothing hides what is to be taken hold of
        for stroke in _line_strokes(seen, lens, None):
            stroke.draw(painter)
    ground = Ground(lens.width, lens.height, painter.device().devicePixelRatioF(), scene.background)
    for placed in _texts(layers.labels, lens, camera, ground):
        painter.drawImage(placed.at, placed.picture)


def _layers(everything: Iterable[Seen[Item]]) -> _Layers:
    layers = _Layers([], [], [], [], [], [], [])
    for seen in everything:
        item, eye, pixels = seen
        if isinstance(item, Labels):
            layers.labels.append(Seen(item, eye, pixels))
        elif item.key.startswith(FLOOR_KEY):
            layers.floor.append(seen)
        elif item.key.startswith(GIZMO_KEY):
            layers.gizmo.append(seen)
        elif isinstance(item, Capsule | Box):
            (layers.solids if item.color.alpha >= 1.0 else layers.ghosts).append(Seen(item, eye, pixels))
        elif isinstance(item, Triads):
            layers.triads.append(Seen(item, eye, pixels))
        else:
            layers.lines.append(seen)
    return layers


def _paint(painter: QPainter, strokes: Iterable[Stroke]) -> None:
    for stroke in sorted(strokes, key=lambda stroke: -stroke.depth):
        stroke.draw(painter)


def _line_strokes(seen: Seen[Item], lens: Lens, solids: SolidPicture | None, smooth: bool = True) -> list[Stroke]:
    item, eye, pixels = seen
    if isinstance(item, Polyline):
        return polyline_strokes(Seen(item, eye, pixels), lens, solids)
    if isinstance(item, Dots):
        return dot_strokes(Seen(item, eye, pixels), lens, solids)
    return segments_strokes(Seen(item, eye, pixels), lens, smooth) if isinstance(item, Segments) else []


def _paint_floor(painter: QPainter, layers: _Layers, lens: Lens, camera: Camera, background: Color) -> None:
    """The plate, the grid, and the shadow on them."""
    floor = tuple(seen.item for seen in layers.floor)
    ratio = painter.device().devicePixelRatioF()
    painter.drawImage(0, 0, _floor_picture(floor, camera, int(lens.width), int(lens.height), ratio, background))
    if layers.floor and layers.solids:
        draw_shadow(painter, [seen.item for seen in layers.solids], lens, background)


@lru_cache(maxsize=2)
def _floor_picture(
    floor: tuple[Item, ...], camera: Camera, width: int, height: int, ratio: float, background: Color
) -> QImage:
    """The background with the floor on it: while the arm moves and the eye rests, it is the same in every frame."""
    picture = QImage(math.ceil(width * ratio), math.ceil(height * ratio), QImage.Format.Format_RGB32)
    picture.setDevicePixelRatio(ratio)
    picture.fill(qcolor(background))
    lens = Lens(camera, width, height)
    with QPainter(picture) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        for seen in look_at(floor, lens):
            if isinstance(seen.item, Box):
                painter.setPen(Qt.PenStyle.NoPen)
                painter.setBrush(qcolor(seen.item.color))
                painter.drawPolygon(polygon(clipped_polygon(seen.eye[BOX_TOP], lens)))
            for stroke in _line_strokes(seen, lens, None):
                stroke.draw(painter)
    return picture


def _texts(labels: list[Seen[Labels]], lens: Lens, camera: Camera, ground: Ground) -> list[Placed]:
    """Where all texts go; those of the floor are wanted where they were while the eye rests."""
    scale = text_scale()
    floor = [text for seen in labels if is_floor(seen.item) for text in _on_floor(seen.item, camera, ground, scale)]
    return arranged([seen_texts(seen, lens) for seen in labels if not is_floor(seen.item)], floor, ground)


@lru_cache(maxsize=2)
def _on_floor(item: Labels, camera: Camera, ground: Ground, _scale: float) -> list[Placed]:
    lens = Lens(camera, int(ground.width), int(ground.height))
    (seen,) = look_at((item,), lens)
    return floor_texts(seen_texts(Seen(item, seen.eye, seen.pixels), lens), ground)


def _paint_ghosts(painter: QPainter, ghosts: list[Seen[Solid]], lens: Lens, smooth: bool) -> None:
    """See-through solids of one alpha are one pane of glass: what lies inside another of them is not seen."""
    for alpha in sorted({seen.item.color.alpha for seen in ghosts}):
        alike = [seen for seen in ghosts if seen.item.color.alpha == alpha]
        picture = render_solids(alike, lens, painter.device().devicePixelRatioF(), smooth)
        if picture is not None:
            painter.setOpacity(alpha)
            picture.draw(painter)
            painter.setOpacity(1.0)


def _clear_image(width: float, height: float, ratio: float) -> QImage:
    image = QImage(
        max(round(width * ratio), 1), max(round(height * ratio), 1), QImage.Format.Format_ARGB32_Premultiplied
    )
    image.setDevicePixelRatio(ratio)
    image.fill(Qt.GlobalColor.transparent)
    return image


_EMPTY = Scene((), Color(1.0, 1.0, 1.0), np.array([[-1.0, -1.0, 0.0], [1.0, 1.0, 1.0]]))


class PainterRenderer(QWidget):
    """The widget that shows a scene with `paint_scene`; a `Renderer`.

    While frames follow one another quickly the edges of solids and ghosts are rough; they are smoothed when all rests.

    Args:
        rest: how long nothing must have changed for that [s].
    """

    name = "painter"
    description = tr_later("painter (no OpenGL needed)")

    def __init__(self, parent: QWidget | None = None, rest: float = 0.12) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self._scene = _EMPTY
        self._camera = Camera(np.zeros(3), 3.0)
        self._report: Callable[[float], None] | None = None
        self._changed, self._smooth = True, True
        self._ended = -math.inf  # when the last paint ended [s]
        self._rest = rest
        self._timer = QTimer(self, singleShot=True, interval=round(1e3 * rest))
        self._timer.timeout.connect(self._on_rest)

    def widget(self) -> QWidget:
        """Itself."""
        return self

    def set_scene(self, scene: Scene) -> None:
        """Shows another scene at the next paint."""
        if scene is not self._scene:
            self._scene = scene
            self._change()

    def set_camera(self, camera: Camera) -> None:
        """Looks from elsewhere at the next paint."""
        if camera is not self._camera:
            self._camera = camera
            self._change()

    def on_painted(self, report: Callable[[float], None]) -> None:
        """From now on `report(milliseconds)` is called after each paint of something new with the time that it took."""
        self._report = report

    def image(self, width: int | None = None, height: int | None = None) -> QImage:
        """The picture in that many device-independent pixels; by default as large as the widget."""
        wide, high = width or self.width(), height or self.height()
        return scene_image(self._scene, self._camera, wide, high, self.devicePixelRatioF())

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Paints, and reports the time that it took if there was something new."""
        begin = time.perf_counter()
        changed, self._changed = self._changed, False
        if changed:
            self._smooth = begin - self._ended > self._rest
        with QPainter(self) as painter:  # it must end even when something breaks, or Qt aborts
            paint_scene(painter, self._scene, self._camera, self.width(), self.height(), self._smooth)
        self._ended = time.perf_counter()
        if changed and not self._smooth:
            self._timer.start()
        if changed and self._report is not None:
            self._report(1e3 * (self._ended - begin))

    def _change(self) -> None:
        self._changed = True
        self.update()

    def _on_rest(self) -> None:
        self._smooth = True
        self.update()


def scene_image(scene: Scene, camera: Camera, width: int, height: int, ratio: float = 1.0) -> QImage:
    """A picture of width × height device-independent pixels, `ratio` device pixels each."""
    image = _clear_image(width, height, ratio)
    with QPainter(image) as painter:
        paint_scene(painter, scene, camera, width, height)
    return image
