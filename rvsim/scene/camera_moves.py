"""Moves of the camera that need more than the camera: framing what is to be seen, and going there smoothly."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rvsim.scene.camera import Camera

FloatArray = NDArray[np.float64]

# The reach of an arm is round: eight directions at three heights hold it, while the corners of its box stay empty.
_TURN = np.linspace(0.0, math.tau, 8, endpoint=False) + math.pi / 8
_OCTAGON = np.stack([np.cos(_TURN), np.sin(_TURN)], axis=1) / math.cos(math.pi / 8)
_RINGS = ((-1.0, 1.33), (0.2, 1.0), (1.0, 0.35))  # (height, width), each relative to half the box


def framed(
    camera: Camera, bounds: ArrayLike, width: float, height: float, margin: float = 0.02, also: ArrayLike = ()
) -> Camera:
    """From the same direction, with what an arm reaches inside `bounds` (2, 3) [m] in the middle and as large as fits.

    Each side of the picture is a plane through the eye; the planes are moved until they touch the outermost points.

    Args:
        margin: the share of the picture that stays free at each side.
        also: (k, 3) points that are to be in the picture as well.
    """
    points = np.concatenate([dome(bounds), np.reshape(np.asarray(also, dtype=np.float64), (-1, 3))])
    centre = np.asarray(bounds, dtype=np.float64).mean(axis=0)
    right_up, nearer = np.split((points - centre) @ camera.axes.T, [2], axis=1)
    tangent = math.tan(camera.field_of_view / 2)
    slopes = (1.0 - 2.0 * margin) * tangent * np.array([max(width, 1.0) / max(height, 1.0), 1.0])
    lean = 0.0 if camera.orthographic else slopes * nearer
    high, low = (lean + right_up).max(axis=0), (lean - right_up).max(axis=0)
    distance = float(np.max((high + low) / (2.0 * slopes)))
    shift = (high - low) / 2.0
    return replace(camera, target=centre + shift @ camera.axes[:2], distance=distance)


def dome(bounds: ArrayLike) -> FloatArray:
    """(24, 3) points around a round body that fills the box `bounds` (2, 3)."""
    lower, upper = np.asarray(bounds, dtype=np.float64)
    rings = [np.column_stack([width * _OCTAGON, np.full(len(_OCTAGON), level)]) for level, width in _RINGS]
    return np.asarray((lower + upper) / 2 + np.concatenate(rings) * (upper - lower) / 2)


def blended(start: Camera, end: Camera, share: float) -> Camera:
    """The camera at `share` 0…1 of the way from one to the other: the short way round, even in its zoom."""
    turn = math.remainder(end.azimuth - start.azimuth, math.tau)
    return replace(
        end,
        target=start.target + share * (end.target - start.target),
        distance=start.distance * (end.distance / start.distance) ** share,
        azimuth=start.azimuth + share * turn,
        elevation=start.elevation + share * (end.elevation - start.elevation),
    )


def same_view(one: Camera, other: Camera) -> bool:
    """Whether both see exactly the same."""
    numbers = ("distance", "azimuth", "elevation", "field_of_view", "orthographic")
    return np.array_equal(one.target, other.target) and all(getattr(one, n) == getattr(other, n) for n in numbers)
