"""Capsules and boxes as shaded shapes on the flat picture, cut into pieces so that they can be sorted by depth."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import Qt
from PySide6.QtGui import QBrush, QLinearGradient, QPainter, QPen, QPolygonF, QRadialGradient, QTransform

from rvsim.gui.renderers.painter_ink import Stroke, polygon
from rvsim.gui.renderers.painter_lens import Lens, Seen, clipped_polygon
from rvsim.gui.renderers.painter_light import LIGHT, brightness, lit, lit_stops
from rvsim.scene import Box, Capsule, Color

FloatArray = NDArray[np.float64]

Solid = Capsule | Box

_MOST_PIECES = 8
_ARC = np.linspace(0.0, 1.0, 13)
_ACROSS = np.sin(np.linspace(-np.pi / 2, np.pi / 2, 11))  # offsets over the width, −1 … 1, closer at the rims
_OVERLAP = 0.6  # [pixels] neighbouring pieces share this much, so that no seam shows
# (6, 4) corners of each face, going around it, and (6, 3) its outward normal in the box's axes.
_FACES = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
_FACE_NORMALS = np.array([[-1, 0, 0], [1, 0, 0], [0, -1, 0], [0, 1, 0], [0, 0, -1], [0, 0, 1]], dtype=np.float64)


class _Tube(NamedTuple):
    """A capsule before the eye: ends (2, 3), its axis, the screen's sideways direction and the normal to the viewer."""

    ends: FloatArray
    radius: float
    color: Color
    axis: FloatArray  # (3,) unit, eye axes
    side: FloatArray  # (3,) unit, in the picture plane, at right angles to the axis
    front: FloatArray  # (3,) unit, at right angles to both, towards the viewer


def solid_strokes(seen: Seen[Solid], lens: Lens) -> list[Stroke]:
    """A solid as the shapes that it shows."""
    item = seen.item
    return capsule_strokes(item, seen.eye, lens) if isinstance(item, Capsule) else box_strokes(item, seen.eye, lens)


def capsule_strokes(item: Capsule, eye: FloatArray, lens: Lens) -> list[Stroke]:
    """A capsule with ends eye (2, 3) as shaded pieces."""
    ends = _before_the_eye(eye, item.radius, lens)
    if ends is None:
        return []
    tube = _tube(ends, item.radius, item.color)
    count = int(np.clip(np.ceil(np.linalg.norm(ends[1] - ends[0]) / (1.6 * item.radius)), 1, _MOST_PIECES))
    joints = ends[0] + np.linspace(0.0, 1.0, count + 1)[:, None] * (ends[1] - ends[0])
    pixels, radii = lens.pixels(joints), item.radius * lens.scale(joints[:, 2])
    along = _direction(pixels)
    caps = [_cap_painting(tube, pixels[i], float(radii[i]), along, sign) for i, sign in ((0, -1.0), (-1, 1.0))]
    body = QBrush(_across_gradient(tube))
    strokes = []
    for i in range(count):
        outline = _piece_outline(pixels[i : i + 2], radii[i : i + 2], along, i == 0, i == count - 1)
        middle, width = pixels[i : i + 2].mean(axis=0), float(radii[i : i + 2].mean())
        brush = _placed(body, middle, width, along)
        paintings = [(outline, brush)] + [caps[0]] * (i == 0) + [caps[1]] * (i == count - 1)
        strokes.append(Stroke(float(joints[i : i + 2, 2].mean()), _filler(paintings)))
    return strokes


def _filler(paintings: list[tuple[QPolygonF, QBrush]]) -> Callable[[QPainter], None]:
    def draw(painter: QPainter) -> None:
        painter.setPen(Qt.PenStyle.NoPen)
        for outline, brush in paintings:
            painter.setBrush(brush)
            painter.drawPolygon(outline)

    return draw


def _before_the_eye(eye: FloatArray, radius: float, lens: Lens) -> FloatArray | None:
    """The part of the axis whose sphere is wholly before the eye."""
    if not np.isfinite(eye).all():
        return None
    nearest = lens.near + radius
    depth = eye[:, 2]
    if (depth < nearest).all():
        return None
    ends = eye.copy()
    for i in (0, 1):
        if depth[i] < nearest:
            ends[i] += (nearest - depth[i]) / (depth[1 - i] - depth[i]) * (eye[1 - i] - eye[i])
    return ends


def _tube(ends: FloatArray, radius: float, color: Color) -> _Tube:
    span = ends[1] - ends[0]
    length = float(np.linalg.norm(span))
    axis = span / length if length > 1e-9 else np.array([1.0, 0.0, 0.0])
    flat = float(np.hypot(axis[0], axis[1]))
    side = np.array([-axis[1], axis[0], 0.0]) / flat if flat > 1e-9 else np.array([0.0, 1.0, 0.0])
    front = np.cross(side, axis)
    return _Tube(ends, radius, color, axis, side, front if front[2] < 0.0 else -front)


def _direction(pixels: FloatArray) -> FloatArray:
    """(2,) the unit vector along the projected axis."""
    span = pixels[-1] - pixels[0]
    length = float(np.hypot(*span))
    return span / length if length > 1e-6 else np.array([1.0, 0.0])


def _piece_outline(pixels: FloatArray, radii: FloatArray, along: FloatArray, first: bool, last: bool) -> QPolygonF:
    """The hull of two discs; an end in the middle of the capsule is cut flat."""
    length = float((pixels[1] - pixels[0]) @ along)
    tangent = float(np.clip((radii[0] - radii[1]) / max(length, 1e-6), -1.0, 1.0))
    beta = np.arccos(tangent)
    far_arc, near_arc = beta + _ARC * (2 * np.pi - 2 * beta), -beta + _ARC * (2 * beta)
    start = _arc(pixels[0], radii[0], far_arc, along, None if first else tangent, -_OVERLAP)
    end = _arc(pixels[1], radii[1], near_arc, along, None if last else tangent, _OVERLAP)
    return polygon(np.concatenate([start, end]))


def _arc(
    centre: FloatArray, radius: float, angles: FloatArray, along: FloatArray, flat: float | None, overlap: float
) -> FloatArray:
    forward = np.cos(angles) if flat is None else np.full_like(angles, flat + overlap / max(radius, 1e-6))
    sideways = np.array([-along[1], along[0]])
    return np.asarray(centre + radius * (forward[:, None] * along + np.sin(angles)[:, None] * sideways))


def _across_gradient(tube: _Tube) -> QLinearGradient:
    """The shading over the width, from −1 to 1 on the x axis of its own coordinates."""
    normals = _ACROSS[:, None] * tube.side + np.sqrt(1.0 - _ACROSS**2)[:, None] * tube.front
    gradient = QLinearGradient(-1.0, 0.0, 1.0, 0.0)
    gradient.setStops(lit_stops(tube.color, (_ACROSS + 1.0) / 2.0, normals))
    return gradient


def _placed(brush: QBrush, middle: FloatArray, radius: float, along: FloatArray) -> QBrush:
    """The brush with its x axis laid over the width of a piece: +1 lies on the tube's side."""
    # The side in eye axes is (−axis_y, axis_x); pixels count downwards, so on the screen it is (along_y, −along_x).
    x, y = radius * float(along[1]), -radius * float(along[0])
    placed = QBrush(brush)
    placed.setTransform(QTransform(x, y, -y, x, float(middle[0]), float(middle[1])))
    return placed


def _cap_painting(
    tube: _Tube, centre: FloatArray, radius: float, along: FloatArray, sign: float
) -> tuple[QPolygonF, QBrush]:
    """The visible part of a round end: a half disc, and the ellipse of its rim added (facing us) or taken away."""
    angles = np.pi * (_ARC - 0.5)
    sideways = np.array([-along[1], along[0]])
    outer = sign * np.cos(angles)[:, None] * along + np.sin(angles)[:, None] * sideways
    # The rim of the far half of an end is hidden: the crescent between the circle and the ellipse remains.
    bulge = tube.axis[2] * np.cos(angles)[::-1]
    inner = bulge[:, None] * along + np.sin(angles)[::-1, None] * sideways
    return polygon(centre + radius * np.concatenate([outer, inner])), _ball_brush(tube.color, centre, radius)


def _ball_brush(color: Color, centre: FloatArray, radius: float) -> QBrush:
    """The shading of a ball: rings about the spot that faces the light."""
    towards = LIGHT[:2] / np.hypot(*LIGHT[:2])
    spot = float(np.hypot(*LIGHT[:2]))
    places = np.linspace(0.0, 1.0, 9)
    offsets = spot - places * (spot + 1.0)
    depth = -np.sqrt(np.maximum(1.0 - offsets**2, 0.0))
    normals = np.column_stack([offsets[:, None] * towards, depth])
    x = float(centre[0]) + radius * spot * float(towards[0])
    y = float(centre[1]) - radius * spot * float(towards[1])
    gradient = QRadialGradient(x, y, radius * (1.0 + spot))
    gradient.setStops(lit_stops(color, places, normals))
    return QBrush(gradient)


def box_strokes(item: Box, eye: FloatArray, lens: Lens) -> list[Stroke]:
    """The faces of a box with corners eye (8, 3) that look at the viewer."""
    if not np.isfinite(eye).all():
        return []
    normals = lens.rotated(_FACE_NORMALS @ item.T_base_box[:3, :3].T)
    faces = eye[_FACES]
    centres = faces.mean(axis=1)
    views = np.broadcast_to([0.0, 0.0, 1.0], (6, 3)) if lens.orthographic else centres
    shown = np.flatnonzero((normals * views).sum(axis=1) < 0.0)
    matt, shine = brightness(normals)
    return [
        _face_stroke(float(centres[i, 2]), clipped_polygon(faces[i], lens), item.color, float(matt[i]), float(shine[i]))
        for i in shown
    ]


def _face_stroke(depth: float, pixels: FloatArray, color: Color, matt: float, shine: float) -> Stroke:
    outline, fill = polygon(pixels), lit(color, matt, 0.3 * shine)
    edge = QPen(lit(color, 0.86 * matt, 0.0), 1.0)
    edge.setJoinStyle(Qt.PenJoinStyle.RoundJoin)

    def draw(painter: QPainter) -> None:
        painter.setPen(edge)
        painter.setBrush(fill)
        painter.drawPolygon(outline)

    return Stroke(depth, draw)


def box_plate(eye: FloatArray, lens: Lens) -> QPolygonF:
    """The upper face alone: a floor."""
    return polygon(clipped_polygon(eye[_FACES[5]], lens))
