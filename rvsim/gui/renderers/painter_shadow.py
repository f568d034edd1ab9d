"""The soft shadow of the solids on the floor, as if the light stood right above: painted small, blurred, enlarged."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QImage, QPainter

from rvsim.gui.renderers.painter_ink import polygon
from rvsim.gui.renderers.painter_lens import BOX_CORNERS, Lens, clipped_polygon
from rvsim.scene import Box, Capsule, Color
from rvsim.scene.palette import DARK, LIGHT, luminance

FloatArray = NDArray[np.float64]

_COARSE = 5.0  # pixels of the picture in one of the shadow
_BLUR = 2  # [pixels of the shadow]
_HALF_TURN = np.linspace(-np.pi / 2, np.pi / 2, 9)
# (3, 2, 4) the corners of the faces across each axis: on its negative side, on its positive side.
_FACES = np.array([[[0, 1, 3, 2], [4, 5, 7, 6]], [[0, 1, 5, 4], [2, 3, 7, 6]], [[0, 2, 6, 4], [1, 3, 7, 5]]])


def draw_shadow(painter: QPainter, solids: Iterable[Capsule | Box], lens: Lens, background: Color) -> None:
    """One shadow for all solids."""
    outlines = _footprints(list(solids))
    pixels = _on_screen(outlines, lens)
    region = _region(pixels, lens)
    if region is None:
        return
    left, top, width, height = region
    mask = np.zeros((height, -(-width // 4) * 4), dtype=np.uint8)  # Qt wants rows of whole words
    _fill(mask, width, height, [(outline - (left, top)) / _COARSE for outline in pixels])
    color = (LIGHT if luminance(background) > 0.5 else DARK).shadow
    shadow = _tinted(_blurred(mask[:, :width]), color)
    image = QImage(shadow.data, width, height, 4 * width, QImage.Format.Format_ARGB32_Premultiplied)
    painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
    painter.drawImage(QRectF(left, top, _COARSE * width, _COARSE * height), image)


def _on_screen(outlines: list[FloatArray], lens: Lens) -> list[FloatArray]:
    """Their pixels on the floor, all projected together unless some lie behind the eye."""
    if not outlines:
        return []
    points = np.concatenate(outlines)
    eye = lens.eye_points(np.column_stack([points, np.zeros(len(points))]))
    ends = np.cumsum([len(outline) for outline in outlines])[:-1]
    if lens.before(eye).all():
        return np.split(lens.pixels(eye), ends)
    return [pixels for piece in np.split(eye, ends) if len(pixels := clipped_polygon(piece, lens)) > 2]


def _region(outlines: list[FloatArray], lens: Lens) -> tuple[float, float, int, int] | None:
    """Left, top [pixels], width and height [shadow pixels] of what is to be painted, with room for the blur."""
    if not outlines:
        return None
    points = np.concatenate(outlines)
    room = _COARSE * (2 * _BLUR + 1)
    left, top = np.maximum(np.floor(points.min(axis=0) - room), -room).tolist()
    right, bottom = np.minimum(points.max(axis=0) + room, (lens.width + room, lens.height + room)).tolist()
    if right <= left or bottom <= top:
        return None
    return left, top, int((right - left) / _COARSE) + 1, int((bottom - top) / _COARSE) + 1


def _fill(mask: NDArray[np.uint8], width: int, height: int, outlines: list[FloatArray]) -> None:
    image = QImage(mask.data, width, height, mask.shape[1], QImage.Format.Format_Alpha8)
    with QPainter(image) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(Qt.GlobalColor.black)
        for outline in outlines:
            painter.drawPolygon(polygon(outline))


def _blurred(mask: NDArray[np.uint8]) -> FloatArray:
    """A box blur, twice, along both directions; 0 … 1."""
    values = mask / 255.0
    for axis in (0, 1, 0, 1):
        values = _box_blurred(values, axis)
    return values


def _box_blurred(values: FloatArray, axis: int) -> FloatArray:
    room = [(0, 0), (0, 0)]
    room[axis] = (_BLUR + 1, _BLUR)
    sums = np.moveaxis(np.cumsum(np.pad(values, room), axis=axis), axis, 0)
    window = 2 * _BLUR + 1
    return np.asarray(np.moveaxis(sums[window:] - sums[:-window], 0, axis) / window)


def _tinted(values: FloatArray, color: Color) -> NDArray[np.uint8]:
    """(h, w, 4) blue, green, red, alpha; premultiplied."""
    alpha = color.alpha * values[..., None]
    red, green, blue = color[:3]
    return np.asarray(np.rint(255.0 * alpha * np.array([blue, green, red, 1.0])), dtype=np.uint8)


def _footprints(solids: list[Capsule | Box]) -> list[FloatArray]:
    """Outlines (k, 2) that together cover what is under solids [m]; solids at no place have none."""
    boxes = [solid for solid in solids if isinstance(solid, Box)]
    capsules = [solid for solid in solids if isinstance(solid, Capsule)]
    groups = ([_box_footprints(boxes)] if boxes else []) + ([_capsule_footprints(capsules)] if capsules else [])
    return [outline for group in groups for outline in group[np.isfinite(group).all(axis=(1, 2))]]


def _box_footprints(boxes: list[Box]) -> FloatArray:
    """(3m, 4, 2) three faces of each box, the upper one of each two."""
    T = np.array([box.T_base_box for box in boxes])
    half = 0.5 * BOX_CORNERS * np.array([box.size for box in boxes])[:, None]
    corners = half @ np.swapaxes(T[:, :3, :3], 1, 2) + T[:, None, :3, 3]
    upper = _FACES[np.arange(3), (T[:, 2, :3] >= 0.0).astype(int)]
    return np.asarray(corners[np.arange(len(boxes))[:, None, None], upper, :2].reshape(-1, 4, 2))


def _capsule_footprints(capsules: list[Capsule]) -> FloatArray:
    """(m, 18, 2) two half circles each."""
    start, end = (np.array([getattr(each, side)[:2] for each in capsules])[:, None] for side in ("start", "end"))
    span = end - start
    angles = np.arctan2(span[..., 1], span[..., 0]) + _HALF_TURN
    radius = np.array([each.radius for each in capsules])[:, None, None]
    cap = radius * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    return np.concatenate([end + cap, start - cap], axis=1)
