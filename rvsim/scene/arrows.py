"""Arrows for what has a direction: straight ones for velocities and forces, bent ones for turning. Arithmetic only.

An arrow whose key begins with `gizmo.GIZMO_KEY` is drawn on top of the arm, any other one stands in its depth.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rvsim.scene.gizmo import GIZMO_KEY, square_to
from rvsim.scene.palette import ScenePalette, mixed
from rvsim.scene.primitives import Color, Item, Polyline, Segments

FloatArray = NDArray[np.float64]

ON_TOP = f"{GIZMO_KEY}."  # begin a key so, and the arrow is never hidden by the arm

_HEAD_SHARE = 0.24  # of a straight arrow's length
_HEAD_SLIMNESS = 0.36  # the radius of a head, in its lengths
_TURN_HEAD = 0.42  # of the radius of a bent arrow
_SPOKES = 14
_FULL_TURN = math.radians(320.0)  # a bent arrow never closes: its head would lie on its foot
_STEP = math.radians(6.0)
_HALO = 2.6  # pixels of the background's colour on either side of what is drawn on top


def arrow_items(
    key: str,
    start: FloatArray,
    vector: FloatArray,
    color: Color,
    palette: ScenePalette,
    *,
    width: float = 3.0,
    dashed: bool = False,
    longest_head: float = math.inf,
) -> tuple[Item, ...]:
    """A shaft from `start` (3,) and a cone that ends at start + vector (3,) [m]; a zero vector gives ().

    Args:
        key: of the shaft; the other pieces add to it.
        width: of the shaft, in pixels.
        dashed: for what is only wished for.
        longest_head: how long the cone is at most [m]; it is a quarter of a short arrow.
    """
    length = float(np.linalg.norm(vector))
    if not length > 1e-9:
        return ()
    direction, tip = vector / length, start + vector
    foot = tip - min(_HEAD_SHARE * length, longest_head) * direction
    shaft = np.stack([start, foot])
    return (*_stroke(key, shaft, color, palette, width, dashed), *_head(key, foot, tip, color))


def turn_arrow_items(
    key: str,
    center: FloatArray,
    axis: FloatArray,
    angle: float,
    radius: float,
    color: Color,
    palette: ScenePalette,
    *,
    width: float = 3.0,
    dashed: bool = False,
) -> tuple[Item, ...]:
    """An arc about `axis` (3,) through `center` (3,) with a cone at its end; no axis, angle or radius gives ().

    Args:
        key: of the arc; the other pieces add to it.
        axis: any length; the right-hand rule gives the sense of a positive angle.
        angle: how far it goes round [rad], with its sign; it is cut before it would close.
        radius: of the arc [m].
    """
    norm = float(np.linalg.norm(axis))
    if not (norm > 1e-9 and abs(angle) > 1e-9 and radius > 1e-9):
        return ()
    round_ = _Round(center, axis / norm, radius)
    whole = math.copysign(min(abs(angle), _FULL_TURN), angle)
    bent = math.copysign(min(_TURN_HEAD, 0.5 * abs(whole)), whole)  # what the head takes of the arc
    turns = np.linspace(0.0, whole - bent, max(2, round(abs(whole - bent) / _STEP)))
    foot = round_.points(turns[-1:])[0]
    tip = foot + abs(bent) * radius * round_.heading(whole - 0.5 * bent, whole)
    return (*_stroke(key, round_.points(turns), color, palette, width, dashed), *_head(key, foot, tip, color))


class _Round:
    """A circle about a unit axis."""

    def __init__(self, center: FloatArray, axis: FloatArray, radius: float) -> None:
        self._center, self._radius = center, radius
        self._u, self._v = square_to(axis)

    def points(self, turns: FloatArray) -> FloatArray:
        """(k, 3) at angles (k,)."""
        across = np.cos(turns)[:, None] * self._u + np.sin(turns)[:, None] * self._v
        return np.asarray(self._center + self._radius * across)

    def heading(self, turn: float, sense: float) -> FloatArray:
        """(3,) the unit tangent there, the way `sense` goes."""
        return np.asarray(math.copysign(1.0, sense) * (math.cos(turn) * self._v - math.sin(turn) * self._u))


def _stroke(
    key: str, points: FloatArray, color: Color, palette: ScenePalette, width: float, dashed: bool
) -> tuple[Item, ...]:
    """The line; what lies on top of the arm stands off from it by a seam of the background's colour."""
    line = Polyline(key, points, color.faded(0.99), width, dashed)
    if dashed or not key.startswith(ON_TOP):
        return (line,)
    seam = mixed(palette.background, color, 0.1).faded(0.6)
    return (Polyline(f"{key}.seam", points, seam, width + 2.0 * _HALO), line)


def _head(key: str, foot: FloatArray, tip: FloatArray, color: Color) -> tuple[Item, ...]:
    """A cone of spokes from the rim to the tip and to the foot: it reads from every side, from its end as well."""
    along = tip - foot
    length = float(np.linalg.norm(along))
    u, v = square_to(along / length)
    turns = np.linspace(0.0, math.tau, _SPOKES, endpoint=False)[:, None]
    rim = foot + _HEAD_SLIMNESS * length * (np.cos(turns) * u + np.sin(turns) * v)
    spokes = [np.stack([rim, np.broadcast_to(end, rim.shape)], axis=1).reshape(-1, 3) for end in (tip, foot)]
    edge = np.stack([rim, np.roll(rim, -1, axis=0)], axis=1).reshape(-1, 3)
    # Not quite opaque: opaque thick lines are shaded like tubes, piece by piece.
    return (Segments(f"{key}.head", np.concatenate([*spokes, edge]), color.faded(0.99), 2.4),)
