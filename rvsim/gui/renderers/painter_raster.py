"""The solids' picture: each pixel shows the nearest solid along its ray, edges are looked at more closely.

A painter that sorts shapes cannot draw solids that reach into one another, as the joints of an arm do; rays can.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QRectF
from PySide6.QtGui import QImage, QPainter

from rvsim.gui.renderers.painter_lens import Lens, Seen
from rvsim.gui.renderers.painter_light import PixelArray, SingleArray
from rvsim.gui.renderers.painter_solids import (
    FACES,
    Body,
    FlatBody,
    Hits,
    Rays,
    RoundBody,
    Solid,
    body_of,
    face_pixels,
    pixel_box,
)

FloatArray = NDArray[np.float64]
IdArray = NDArray[np.int16]
BitArray = NDArray[np.uint64]

_NOTHING = -1
_MOST_RAYS = 320_000  # more than these make a coarser picture, smoothly enlarged
_CHUNK = 10_000  # rays at a time: what is worked out about them stays in the processor's cache
_SUBPIXELS = np.array([(0.125, 0.375), (0.625, 0.125), (0.875, 0.625), (0.375, 0.875)], dtype=np.float32)


class _Part(NamedTuple):
    """A body, and the rows and columns of the raster that its picture may touch."""

    body: Body
    rows: slice
    columns: slice


class _Raster(NamedTuple):
    """The pixels of a region: its left upper corner, and how many of the raster's pixels make one of the picture's."""

    lens: Lens
    left: float
    top: float
    scale: float
    width: int
    height: int

    def rays(self, columns: SingleArray, rows: SingleArray, centre: FloatArray) -> Rays:
        """The rays through raster places, in coordinates about a centre (3,) [m]."""
        middle_x, middle_y, depth = (float(value) for value in centre)
        focal = float(self.lens.scale(np.array(1.0)))  # pixels a metre at depth 1
        pixel = 1.0 / (self.scale * focal)
        left, top = (self.left - self.lens.width / 2) / focal, (self.lens.height / 2 - self.top) / focal
        if self.lens.orthographic:
            still = np.zeros(1, dtype=np.float32)
            return Rays(pixel * columns + (left - middle_x), (top - middle_y) - pixel * rows, still, still)
        x, y = pixel * columns + left, top - pixel * rows
        return Rays(depth * x - middle_x, depth * y - middle_y, x, y)


class SolidPicture(NamedTuple):
    """What the solids look like and how deep they are: `depth` (h, w) [m], inf where there is none."""

    pixels: PixelArray  # (h, w) 0xAARRGGBB, premultiplied
    depth: SingleArray
    raster: _Raster

    def draw(self, painter: QPainter) -> None:
        """Lays the picture at its place."""
        height, width = self.depth.shape
        image = QImage(self.pixels.data, width, height, 4 * width, QImage.Format.Format_ARGB32_Premultiplied)
        scale = self.raster.scale
        place = QRectF(self.raster.left, self.raster.top, width / scale, height / scale)
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, scale != 1.0)
        painter.drawImage(place, image)

    def hides(self, pixels: FloatArray, depth: FloatArray) -> NDArray[np.bool_]:
        """(n,) which points at pixels (n, 2) and a depth (n,) lie behind a solid."""
        height, width = self.depth.shape
        places = np.floor((pixels - (self.raster.left, self.raster.top)) * self.raster.scale)
        columns, rows = np.clip(np.nan_to_num(places, nan=-1.0), -1.0, 1e6).astype(int).T
        inside = (columns >= 0) & (columns < width) & (rows >= 0) & (rows < height)
        solid = np.full(len(depth), np.inf)
        solid[inside] = self.depth[rows[inside], columns[inside]]
        return np.asarray(depth > solid + 0.001 * self.raster.lens.distance)


def render_solids(solids: list[Seen[Solid]], lens: Lens, ratio: float, smooth: bool = True) -> SolidPicture | None:
    """The picture of opaque solids on a device of that pixel ratio, with smooth edges or not; None if none is seen."""
    boxes = [(seen, box) for seen in solids if (box := _box_in_view(seen, lens)) is not None]
    if not boxes:
        return None
    raster = _raster([box for _, box in boxes], lens, ratio)
    parts = [_Part(body_of(seen, lens), *_slices(box, raster)) for seen, box in boxes]
    depth = np.full((raster.height, raster.width), np.inf, dtype=np.float32)
    ids = np.full((raster.height, raster.width), _NOTHING, dtype=np.int16)
    for number, part in enumerate(parts):
        _trace(part, number, raster, depth, ids)
    table = _face_table(parts)
    pixels = _shade(parts, raster, table, depth, ids)
    if smooth:
        _smooth_edges(parts, raster, table, ids, pixels)
    return SolidPicture(pixels, depth, raster)


def _box_in_view(seen: Seen[Solid], lens: Lens) -> tuple[float, float, float, float] | None:
    box = pixel_box(seen, lens) if np.isfinite(seen.eye).all() else None
    if box is None:
        return None
    left, top = max(math.floor(box[0]) - 1, 0), max(math.floor(box[1]) - 1, 0)
    right, bottom = min(math.ceil(box[2]) + 1, lens.width), min(math.ceil(box[3]) + 1, lens.height)
    return (left, top, right, bottom) if left < right and top < bottom else None


def _raster(boxes: list[tuple[float, float, float, float]], lens: Lens, ratio: float) -> _Raster:
    corners = np.array(boxes)
    left, top = corners[:, :2].min(axis=0).tolist()
    right, bottom = corners[:, 2:].max(axis=0).tolist()
    rays = float(np.prod(corners[:, 2:] - corners[:, :2], axis=1).sum())
    scale = min(ratio, max(math.sqrt(_MOST_RAYS / rays), 0.2))
    size = math.ceil((right - left) * scale), math.ceil((bottom - top) * scale)
    return _Raster(lens, left, top, scale, max(size[0], 1), max(size[1], 1))


def _slices(box: tuple[float, float, float, float], raster: _Raster) -> tuple[slice, slice]:
    left, top, right, bottom = box
    columns = slice(int((left - raster.left) * raster.scale), math.ceil((right - raster.left) * raster.scale))
    rows = slice(int((top - raster.top) * raster.scale), math.ceil((bottom - raster.top) * raster.scale))
    return rows, columns


def _trace(part: _Part, number: int, raster: _Raster, depth: SingleArray, ids: IdArray) -> None:
    """Puts a body into the depth picture wherever it is the nearest so far, some rows at a time."""
    rows, columns = part.rows, part.columns
    step = max(_CHUNK // max(columns.stop - columns.start, 1), 1)
    for start in range(rows.start, rows.stop, step):
        strip = part._replace(rows=slice(start, min(start + step, rows.stop)))
        _trace_strip(strip, number, raster, depth, ids)


def _trace_strip(part: _Part, number: int, raster: _Raster, depth: SingleArray, ids: IdArray) -> None:
    near, shown = depth[part.rows, part.columns], ids[part.rows, part.columns]
    columns, rows = _centres(part.columns.start, near.shape[1]), _centres(part.rows.start, near.shape[0])
    found, face = _met(part, raster, columns[None, :], rows[:, None])
    nearer = found < near
    np.copyto(near, found, where=nearer)
    np.copyto(shown, np.asarray(FACES * number + face, dtype=np.int16), where=nearer)


def _centres(start: int, count: int) -> SingleArray:
    return np.arange(start, start + count, dtype=np.float32) + np.float32(0.5)


def _met(part: _Part, raster: _Raster, columns: SingleArray, rows: SingleArray) -> Hits:
    """The depth before the eye, and the face, for rays through raster places."""
    with np.errstate(over="ignore", invalid="ignore"):  # from thousands of kilometres away nothing is met
        found, face = part.body.hits(raster.rays(columns, rows, part.body.centre))
    found = found + np.float32(part.body.centre[2])
    if not raster.lens.orthographic:
        found[found < raster.lens.near] = np.inf
    return Hits(found, face)


def _face_table(parts: list[_Part]) -> PixelArray:
    """The pixel of each surface number, where a surface has but one; clear for the last one, −1, and what is round."""
    table = np.zeros((len(parts) + 1, FACES), dtype=np.uint32)
    flat = {number: part.body for number, part in enumerate(parts) if isinstance(part.body, FlatBody)}
    table[list(flat)] = face_pixels(list(flat.values()))
    return table.reshape(-1)


def _shade(parts: list[_Part], raster: _Raster, table: PixelArray, depth: SingleArray, ids: IdArray) -> PixelArray:
    """(h, w) the colours of what each pixel of the raster shows."""
    pixels: PixelArray = table[ids]
    for number, part in enumerate(parts):
        if isinstance(part.body, RoundBody):
            rows, columns = np.nonzero(ids[part.rows, part.columns] == FACES * number)
            rows, columns = rows + part.rows.start, columns + part.columns.start
            x, y = columns.astype(np.float32) + np.float32(0.5), rows.astype(np.float32) + np.float32(0.5)
            rays = raster.rays(x, y, part.body.centre)
            pixels[rows, columns] = part.body.pixels(rays, depth[rows, columns] - np.float32(part.body.centre[2]))
    return pixels


def _smooth_edges(parts: list[_Part], raster: _Raster, table: PixelArray, ids: IdArray, pixels: PixelArray) -> None:
    """Where neighbours show different surfaces, several rays a pixel are averaged."""
    rows, columns, around = _edges(ids)
    if not len(rows):
        return
    x = (columns[:, None].astype(np.float32) + _SUBPIXELS[:, 0]).reshape(-1)
    y = (rows[:, None].astype(np.float32) + _SUBPIXELS[:, 1]).reshape(-1)
    depth = np.full(len(x), np.inf, dtype=np.float32)
    found = np.full(len(x), _NOTHING, dtype=np.int16)
    concerned = [_concerned(around, number) for number in range(len(parts))]
    for number, (part, mine) in enumerate(zip(parts, concerned, strict=True)):
        if len(mine):
            _trace_scattered(number, mine, _met(part, raster, x[mine], y[mine]), depth, found)
    colors = table[found]
    for number, (part, mine) in enumerate(zip(parts, concerned, strict=True)):
        shown = mine[found[mine] == FACES * number]
        if len(shown) and isinstance(part.body, RoundBody):
            rays = raster.rays(x[shown], y[shown], part.body.centre)
            colors[shown] = part.body.pixels(rays, depth[shown] - np.float32(part.body.centre[2]))
    pixels[rows, columns] = _mean(colors.reshape(-1, len(_SUBPIXELS)))


def _trace_scattered(number: int, mine: NDArray[np.intp], hits: Hits, depth: SingleArray, ids: IdArray) -> None:
    nearer = hits.depth < depth[mine]
    depth[mine[nearer]] = hits.depth[nearer]
    faces = hits.face[nearer] if isinstance(hits.face, np.ndarray) else hits.face
    ids[mine[nearer]] = FACES * number + faces


def _mean(colors: PixelArray) -> PixelArray:
    """(n,) the premultiplied means of pixels (n, k)."""
    channels = colors.view(np.uint8).reshape(*colors.shape, 4)
    mean = (channels.sum(axis=1, dtype=np.uint16) + colors.shape[1] // 2) // colors.shape[1]
    pixels: PixelArray = mean.astype(np.uint8).view(np.uint32)[:, 0]
    return pixels


def _edges(ids: IdArray) -> tuple[NDArray[np.intp], NDArray[np.intp], BitArray]:
    """Rows and columns (n,) of the pixels on an edge, and the solids on them and beside them (n,), a bit each."""
    padded = np.pad(ids, 1, mode="constant", constant_values=_NOTHING)
    across, down = padded[:, 1:] != padded[:, :-1], padded[1:] != padded[:-1]
    edge = across[1:-1, 1:] | across[1:-1, :-1] | down[1:, 1:-1] | down[:-1, 1:-1]
    rows, columns = np.nonzero(edge)
    width = padded.shape[1]
    middle = (rows + 1) * width + columns + 1
    flat = padded.reshape(-1)
    bits = np.zeros(len(middle), dtype=np.uint64)
    for step in (0, -1, 1, -width, width):
        beside = flat[middle + step]
        bits |= np.where(beside >= 0, _bit(beside // FACES), np.uint64(0))
    return rows, columns, bits


def _bit(number: NDArray[np.int16] | int) -> BitArray:
    # More than 64 solids share bits: then a solid is asked about some rays in vain.
    return np.uint64(1) << np.asarray(number % 64, dtype=np.uint64)


def _concerned(around: BitArray, number: int) -> NDArray[np.intp]:
    """The scattered rays of the pixels that show a solid or lie beside it."""
    pixels = np.flatnonzero(around & _bit(number))
    rays: NDArray[np.intp] = (pixels[:, None] * len(_SUBPIXELS) + np.arange(len(_SUBPIXELS))).reshape(-1)
    return rays
