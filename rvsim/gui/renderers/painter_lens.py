"""From metres to pixels, all points of a scene in one go, and what lies behind the eye cut off."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from typing import Any, Generic, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from rvsim.scene import Box, Camera, Capsule, Dots, Item, Labels, Polyline, Segments, Triads

FloatArray = NDArray[np.float64]

# The corners of a box of edge 2.
BOX_CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=np.float64)
BOX_TOP = [1, 3, 7, 5]  # the corners of its upper face, going around
_TRIAD_ENDS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=np.float64)


class Lens:
    """A camera and a picture of `width` × `height` pixels.

    Eye coordinates here are x right, y up, and the depth before the eye [m].
    """

    def __init__(self, camera: Camera, width: float, height: float) -> None:
        self.orthographic = camera.orthographic
        self.width, self.height = float(width), float(height)
        self._axes = camera.axes * np.array([[1.0], [1.0], [-1.0]])
        self._eye = camera.eye
        self.near = -math.inf if camera.orthographic else 0.01 * camera.distance
        half = math.tan(camera.field_of_view / 2)
        self._focal = self.height / 2 / half / (camera.distance if camera.orthographic else 1.0)
        self.distance = camera.distance

    def eye_points(self, points: FloatArray) -> FloatArray:
        """Eye coordinates (k, 3) of points (k, 3) in base axes."""
        seen: FloatArray = (points - self._eye) @ self._axes.T
        return seen

    def rotated(self, directions: FloatArray) -> FloatArray:
        """Directions (k, 3) of base axes in eye axes."""
        turned: FloatArray = directions @ self._axes.T
        return turned

    def scale(self, depth: FloatArray) -> FloatArray:
        """Pixels a metre at a depth."""
        if self.orthographic:
            return np.full_like(depth, self._focal)
        return np.asarray(self._focal / np.maximum(depth, self.near))

    def pixels(self, eye_points: FloatArray) -> FloatArray:
        """Pixels (…, 2), x right and y down, of eye coordinates (…, 3)."""
        scale = self.scale(eye_points[..., 2])
        x = self.width / 2 + eye_points[..., 0] * scale
        return np.stack([x, self.height / 2 - eye_points[..., 1] * scale], axis=-1)

    def before(self, eye_points: FloatArray) -> NDArray[np.bool_]:
        """(…) which points are before the eye, and numbers at all."""
        depth = eye_points[..., 2]
        # A comparison with nan is False, which leaves such points out.
        return np.asarray((depth >= self.near) & np.isfinite(eye_points).all(axis=-1))


ItemT = TypeVar("ItemT", bound=Item, covariant=True)


class Seen(NamedTuple, Generic[ItemT]):
    """An item and its points as the eye has them: eye (k, 3) and pixels (k, 2)."""

    item: ItemT
    eye: FloatArray
    pixels: FloatArray


def look_at(items: tuple[Item, ...], lens: Lens) -> list[Seen[Item]]:
    """All items projected together."""
    arrays = [_POINTS[type(item)](item) for item in items]
    if not arrays:
        return []
    eye = lens.eye_points(np.concatenate(arrays))
    pixels = lens.pixels(eye)
    ends = np.cumsum([len(array) for array in arrays]).tolist()
    spans = pairwise([0, *ends])
    return [Seen(item, eye[a:b], pixels[a:b]) for item, (a, b) in zip(items, spans, strict=True)]


def clipped_pieces(eye: FloatArray, lens: Lens) -> FloatArray:
    """Pixels (m, 2, 2) of line pieces eye (k, 2, 3) cut at the plane just before the eye; those behind are left out."""
    pieces = eye[np.isfinite(eye).all(axis=(1, 2))]
    depth = pieces[..., 2]
    pieces, depth = pieces[(depth >= lens.near).any(axis=1)], depth[(depth >= lens.near).any(axis=1)]
    behind = depth < lens.near
    if behind.any():
        step = np.where(behind.any(axis=1), depth[:, 1] - depth[:, 0], 1.0)
        cut = pieces[:, 0] + ((lens.near - depth[:, 0]) / step)[:, None] * (pieces[:, 1] - pieces[:, 0])
        pieces = np.where(behind[..., None], cut[:, None], pieces)
    return lens.pixels(pieces)


def clipped_polygon(eye: FloatArray, lens: Lens) -> FloatArray:
    """Pixels (m, 2) of a convex polygon eye (k, 3) cut at the plane just before the eye; (0, 2) when it is behind."""
    inside = lens.before(eye)
    if inside.all():
        return lens.pixels(eye)
    corners: list[FloatArray] = []
    for i in range(len(eye)):
        j = (i + 1) % len(eye)
        if inside[i]:
            corners.append(eye[i])
        if inside[i] != inside[j]:
            share = (lens.near - eye[i, 2]) / (eye[j, 2] - eye[i, 2])
            corners.append(eye[i] + share * (eye[j] - eye[i]))
    return lens.pixels(np.array(corners).reshape(-1, 3))


def _capsule_points(item: Capsule) -> FloatArray:
    return np.stack([item.start, item.end])


def _box_points(item: Box) -> FloatArray:
    half: FloatArray = BOX_CORNERS * item.size / 2
    return np.asarray(half @ item.T_base_box[:3, :3].T + item.T_base_box[:3, 3])


def _triad_points(item: Triads) -> FloatArray:
    """(4 k, 3) origin and the three ends of each frame."""
    T = item.T_base_frame
    ends = item.length * _TRIAD_ENDS @ np.swapaxes(T[:, :3, :3], 1, 2) + T[:, None, :3, 3]
    return np.asarray(ends.reshape(-1, 3))


def _label_points(item: Labels) -> FloatArray:
    return np.array([label.position for label in item.labels], dtype=np.float64).reshape(-1, 3)


_POINTS: dict[type, Callable[[Any], FloatArray]] = {
    Polyline: lambda item: item.points,
    Segments: lambda item: item.points,
    Dots: lambda item: item.points,
    Capsule: _capsule_points,
    Box: _box_points,
    Triads: _triad_points,
    Labels: _label_points,
}
