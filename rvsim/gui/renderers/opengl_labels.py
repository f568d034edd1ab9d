"""All texts of the OpenGL picture: one layer on top, painted by QPainter as the painter renderer paints them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from PySide6.QtGui import QPainter
from PySide6.QtOpenGL import QOpenGLPaintDevice

from rvsim.gui.renderers.opengl_binding import GLGraphicsItem
from rvsim.gui.renderers.opengl_frame import Frame
from rvsim.gui.renderers.painter_lines import draw_text
from rvsim.gui.renderers.text_layout import Ground, Texts, arranged, floor_texts, is_floor
from rvsim.scene import Color, Label, Labels, Triads
from rvsim.scene.palette import axis_colors

FloatArray = NDArray[np.float64]

_LETTER_SIZE, _LETTER_GAP = 10.5, 7.0
_SHORTEST_AXIS = 12.0  # [pixels] an axis that points at the eye has no room for its letter
_MARGIN = 200.0  # [pixels] a text that begins farther outside cannot be seen


class _Letters(NamedTuple):
    """Origins (k, 3) of frames, and the ends (k, 3) and colour of each of the three axes."""

    origins: FloatArray
    tips: list[FloatArray]
    colors: list[Color]


class LabelLayer(GLGraphicsItem):  # type: ignore[misc]
    """Every label of the scene, and the letters of its frames."""

    def __init__(self) -> None:
        super().__init__()
        self._labels: list[tuple[Labels, list[Label], FloatArray]] = []
        self._letters: list[_Letters] = []
        self._background = Color(1.0, 1.0, 1.0)

    def show_items(self, items: Iterable[Labels | Triads], background: Color) -> None:
        """Show exactly the texts of these, with a halo in the background's colour."""
        shown = list(items)
        self._background = background
        self._labels = [_texts(item) for item in shown if isinstance(item, Labels)]
        self._letters = [_letters(item, background) for item in shown if isinstance(item, Triads) and item.letters]

    def paint(self) -> None:
        """Draw the texts that are in front of the eye."""
        if not self._labels and not self._letters:
            return
        frame: Frame = self.view().frame
        # What is bound is painted on, be it the screen or a picture beside it.
        device = QOpenGLPaintDevice(round(frame.width * frame.pixel_ratio), round(frame.height * frame.pixel_ratio))
        device.setDevicePixelRatio(frame.pixel_ratio)
        painter = QPainter(device)
        try:
            self._draw_letters(painter, frame)
            self._draw_labels(painter, frame)
        finally:
            painter.end()  # a painter that outlives its picture would crash

    def _draw_labels(self, painter: QPainter, frame: Frame) -> None:
        ground = Ground(frame.width, frame.height, frame.pixel_ratio, self._background)
        texts = [_seen_texts(item, labels, places, frame) for item, labels, places in self._labels]
        floor = [text for each in texts if is_floor(each.item) for text in floor_texts(each, ground)]
        for placed in arranged([each for each in texts if not is_floor(each.item)], floor, ground):
            painter.drawImage(placed.at, placed.picture)

    def _draw_letters(self, painter: QPainter, frame: Frame) -> None:
        for letters in self._letters:
            starts = frame.camera.project(letters.origins, frame.width, frame.height)
            for tips, text, color in zip(letters.tips, "xyz", letters.colors, strict=True):
                ends = frame.camera.project(tips, frame.width, frame.height)
                shown = _seen(starts, frame) & _seen(ends, frame)
                for place in _beyond(starts[shown, :2], ends[shown, :2]):
                    draw_text(painter, place, text, color, _LETTER_SIZE, self._background)


def _texts(item: Labels) -> tuple[Labels, list[Label], FloatArray]:
    """An item with those of its labels that can be shown, and their places (k, 3)."""
    labels = [label for label in item.labels if label.text and np.isfinite(label.position).all()]
    return item, labels, np.array([label.position for label in labels], dtype=np.float64).reshape(-1, 3)


def _seen_texts(item: Labels, labels: list[Label], places: FloatArray, frame: Frame) -> Texts:
    pixels = frame.camera.project(places, frame.width, frame.height)
    seen = np.flatnonzero(_seen(pixels, frame)).tolist()
    return Texts(item, [labels[i] for i in seen], [(float(pixels[i, 0]), float(pixels[i, 1])) for i in seen])


def _letters(item: Triads, background: Color) -> _Letters:
    frames = np.asarray(item.T_base_frame, dtype=np.float64).reshape(-1, 4, 4)
    frames = frames[np.isfinite(frames).all(axis=(1, 2))]
    origins = frames[:, :3, 3]
    tips = [origins + item.length * frames[:, :3, axis] for axis in range(3)]
    return _Letters(origins, tips, [color.faded(item.alpha) for color in axis_colors(background)])


def _seen(pixels: FloatArray, frame: Frame) -> NDArray[np.bool_]:
    """(k,) which of the projected points (k, 3) are before the eye and near the picture."""
    outside = np.abs(pixels[:, :2] - (frame.width / 2, frame.height / 2)) - (frame.width / 2, frame.height / 2)
    before = np.full(len(pixels), True) if frame.camera.orthographic else pixels[:, 2] > 0
    return np.asarray(before & (outside < _MARGIN).all(axis=1))


def _beyond(starts: FloatArray, tips: FloatArray) -> list[tuple[float, float]]:
    """Where a letter begins that stands just beyond the tip of each axis long enough to have one."""
    steps = tips - starts
    lengths = np.hypot(steps[:, 0], steps[:, 1])
    long = lengths > _SHORTEST_AXIS
    places = tips[long] + _LETTER_GAP * steps[long] / lengths[long, None] + (-3.0, 3.5)
    return [(float(x), float(y)) for x, y in places]
