"""The soft shadow of the solids on the floor, as if the light stood right above."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import Qt
from PySide6.QtGui import QPainter, QPainterPath

from rvsim.gui.renderers.painter_ink import polygon, qcolor
from rvsim.gui.renderers.painter_lens import BOX_CORNERS, Lens, clipped_polygon
from rvsim.scene import Box, Capsule, Color
from rvsim.scene.palette import DARK, LIGHT, luminance

FloatArray = NDArray[np.float64]

_TURN = np.linspace(0.0, 2 * np.pi, 20, endpoint=False)
_CIRCLE = np.stack([np.cos(_TURN), np.sin(_TURN)], axis=1)
_SOFTNESS = (1.5, 1.15, 0.8)  # the shadow is painted once for each of these widths


def draw_shadow(painter: QPainter, solids: Iterable[Capsule | Box], lens: Lens, background: Color) -> None:
    """One shadow for all solids, softer towards its rim."""
    color = (LIGHT if luminance(background) > 0.5 else DARK).shadow
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(qcolor(color.faded(1.0 / len(_SOFTNESS))))
    for width in _SOFTNESS:
        path = QPainterPath()
        path.setFillRule(Qt.FillRule.WindingFill)
        for item in solids:
            _add(path, _footprint(item, width), lens)
        painter.drawPath(path)


def _add(path: QPainterPath, footprint: FloatArray, lens: Lens) -> None:
    on_floor = np.column_stack([footprint, np.zeros(len(footprint))])
    if np.isfinite(on_floor).all():
        path.addPolygon(polygon(clipped_polygon(lens.eye_points(on_floor), lens)))
        path.closeSubpath()


def _footprint(item: Capsule | Box, width: float) -> FloatArray:
    """(k, 2) the convex outline of a solid seen from above [m], counter-clockwise."""
    if isinstance(item, Capsule):
        discs = [end[:2] + width * item.radius * _CIRCLE for end in (item.start, item.end)]
        return _convex_hull(np.concatenate(discs))
    corners = (0.5 * BOX_CORNERS * item.size) @ item.T_base_box[:3, :3].T + item.T_base_box[:3, 3]
    centre = item.T_base_box[:2, 3]
    return _convex_hull(centre + (0.75 + 0.25 * width) * (corners[:, :2] - centre))


def _convex_hull(points: FloatArray) -> FloatArray:
    """Andrew's monotone chain."""
    ordered = sorted(map(tuple, points.tolist()))
    return np.array(_chain(ordered) + _chain(ordered[::-1]))


def _chain(points: list[tuple[float, ...]]) -> list[tuple[float, ...]]:
    chain: list[tuple[float, ...]] = []
    for x, y in points:
        while len(chain) > 1 and _turn(chain[-2], chain[-1], (x, y)) <= 0.0:
            chain.pop()
        chain.append((x, y))
    return chain[:-1]


def _turn(a: tuple[float, ...], b: tuple[float, ...], c: tuple[float, ...]) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
