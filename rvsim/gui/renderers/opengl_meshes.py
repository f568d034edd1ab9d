"""The numbers that OpenGL draws from: unit bodies that are stretched in the shader, and lines as flat quads.

A line becomes two triangles a piece, widened to so many pixels in the shader, because core profiles draw no wide lines.
A dot is a piece of no length. All arrays are float32 and finite: what is not a number is left out.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rvsim.scene import Color, Dots, Polyline, Segments, Triads
from rvsim.scene.palette import axis_colors

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

TRIAD_WIDTH = 2.2
# End (0 start, 1 end) and side (−1, 1) of the six corners of a piece.
_CORNERS = np.array([[0, -1], [1, -1], [1, 1], [0, -1], [1, 1], [0, 1]], dtype=np.float32)
STROKE_FLOATS = 15  # before, start, end, after (3 each), corner (2), length so far (1)
BODY_FLOATS = 7  # position, normal (3 each), end (1)


class Stroke(NamedTuple):
    """Pieces of line of one colour: vertices (6k, 15) float32, width in pixels."""

    vertices: Float32Array
    color: Color
    width: float
    dashed: bool = False
    is_dot: bool = False


# --- lines and dots ------------------------------------------------------------------------------------------------


def strokes_of(item: Polyline | Segments | Dots | Triads, background: Color) -> tuple[Stroke, ...]:
    """What an item of lines or dots is drawn from; the axes of frames are readable on the background."""
    if isinstance(item, Polyline):
        return (Stroke(_chain(_rows(item.points)), item.color, item.width, dashed=item.dashed),)
    if isinstance(item, Segments):
        pieces = _rows(item.points)[: len(item.points) // 2 * 2].reshape(-1, 2, 3)
        return (Stroke(_pieces(pieces), item.color, item.width),)
    if isinstance(item, Dots):
        points = _rows(item.points)
        return (Stroke(_pieces(np.stack([points, points], axis=1)), item.color, item.size, is_dot=True),)
    return _triad_strokes(item, background)


def _triad_strokes(item: Triads, background: Color) -> tuple[Stroke, ...]:
    frames = np.asarray(item.T_base_frame, dtype=np.float64).reshape(-1, 4, 4)
    origins = frames[:, :3, 3]
    return tuple(
        Stroke(
            _pieces(np.stack([origins, origins + item.length * frames[:, :3, axis]], axis=1)),
            color.faded(item.alpha),
            TRIAD_WIDTH,
        )
        for axis, color in enumerate(axis_colors(background))
    )


def _rows(points: FloatArray) -> FloatArray:
    return np.asarray(points, dtype=np.float64).reshape(-1, 3)


def _pieces(pieces: FloatArray) -> Float32Array:
    """Of separate pieces (k, 2, 3): each has two ends of its own."""
    start, end = pieces[:, 0], pieces[:, 1]
    return _vertices(start, start, end, end, np.zeros(len(pieces)))


def _chain(points: FloatArray) -> Float32Array:
    """Of a line through points (k, 3): each piece knows its neighbours, so that they meet without overlap."""
    if len(points) < 2:
        return np.empty((0, STROKE_FLOATS), dtype=np.float32)
    padded = np.concatenate([points[:1], points, points[-1:]])
    with np.errstate(invalid="ignore"):  # from infinity to infinity
        lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
    lengths = np.where(np.isfinite(lengths), lengths, 0.0)
    so_far = np.concatenate([[0.0], np.cumsum(lengths)[:-1]])
    return _vertices(padded[:-3], padded[1:-2], padded[2:-1], padded[3:], so_far)


def _vertices(
    before: FloatArray, start: FloatArray, end: FloatArray, after: FloatArray, so_far: FloatArray
) -> Float32Array:
    drawn = np.isfinite(start).all(axis=1) & np.isfinite(end).all(axis=1)
    # Beside a gap a piece ends as if it were the last.
    before, after = _where_finite(before, start), _where_finite(after, end)
    quads = np.empty((int(drawn.sum()), 6, STROKE_FLOATS), dtype=np.float32)
    for column, values in enumerate((before, start, end, after)):
        quads[:, :, 3 * column : 3 * column + 3] = values[drawn, None]
    quads[:, :, 12:14] = _CORNERS
    quads[:, :, 14] = so_far[drawn, None]
    return quads.reshape(-1, STROKE_FLOATS)


def _where_finite(points: FloatArray, otherwise: FloatArray) -> FloatArray:
    return np.where(np.isfinite(points).all(axis=1, keepdims=True), points, otherwise)


# --- bodies --------------------------------------------------------------------------------------------------------


def capsule_body(around: int = 28, up: int = 7) -> Float32Array:
    """Triangles (k, 7) of a capsule of radius 1 and length 0: `end` 1 marks the half that the shader moves along z."""
    turn = np.linspace(0.0, math.tau, around + 1)
    rise = np.linspace(0.0, math.pi / 2, up + 1)
    # The equator is there twice, once at each end: between them lies the cylinder.
    heights = np.concatenate([-rise[::-1], rise])
    ends = np.repeat([0.0, 1.0], up + 1)
    sphere = np.stack(
        [
            np.cos(heights)[:, None] * np.cos(turn),
            np.cos(heights)[:, None] * np.sin(turn),
            np.broadcast_to(np.sin(heights)[:, None], (len(heights), len(turn))),
        ],
        axis=-1,
    )
    grid = np.concatenate([sphere, sphere, np.broadcast_to(ends[:, None, None], (*sphere.shape[:2], 1))], axis=-1)
    return _triangles(grid)


def _triangles(grid: FloatArray) -> Float32Array:
    low_left, low_right = grid[:-1, :-1], grid[:-1, 1:]
    high_left, high_right = grid[1:, :-1], grid[1:, 1:]
    corners = np.stack([low_left, low_right, high_right, low_left, high_right, high_left], axis=2)
    return np.ascontiguousarray(corners.reshape(-1, BODY_FLOATS), dtype=np.float32)


def box_body() -> Float32Array:
    """Triangles (36, 7) of a box with edges 1 about its centre."""
    square = np.array([[-1, -1], [1, -1], [1, 1], [-1, -1], [1, 1], [-1, 1]]) / 2
    faces = []
    for axis in range(3):
        for side in (-1.0, 1.0):
            # Turned so that each face is anticlockwise when seen from outside.
            face = np.roll(np.column_stack([square[:: int(side)], np.full(6, side / 2)]), axis + 1, axis=1)
            normal = np.broadcast_to(side * np.eye(3)[axis], (6, 3))
            faces.append(np.column_stack([face, normal, np.zeros(6)]))
    return np.concatenate(faces).astype(np.float32)


def capsule_transform(start: FloatArray, end: FloatArray) -> tuple[FloatArray, float]:
    """The frame (4, 4) at `start` whose z axis points to `end`, and the distance between them [m]."""
    along = np.asarray(end, dtype=np.float64) - start
    length = float(np.linalg.norm(along))
    z = along / length if length > 0 else np.array([0.0, 0.0, 1.0])
    aside = np.eye(3)[int(np.argmin(np.abs(z)))]
    x = np.cross(aside, z)
    x /= np.linalg.norm(x) or 1.0
    frame = np.eye(4)
    frame[:3, 0], frame[:3, 1], frame[:3, 2], frame[:3, 3] = x, np.cross(z, x), z, start
    return frame, length
