"""What lies under the pointer."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rvsim.scene.camera import Camera, Ray
from rvsim.scene.floor import FLOOR_KEY
from rvsim.scene.primitives import Box, Capsule, Dots, Item, Labels, Polyline, Scene, Segments

FloatArray = NDArray[np.float64]

_EDGE_ON = 0.02  # sine of the angle between a line of sight and a plane that cannot be clicked on


def point_under(
    scene: Scene, camera: Camera, x: float, y: float, width: float, height: float, within: float = 30.0
) -> FloatArray | None:
    """The point (3,) of the scene [m] nearest to pixel (x, y), else the floor there; None where there is neither.

    Args:
        within: how many pixels a point may be away.
    """
    near = nearest_point(scene, camera, x, y, width, height, within)
    return near if near is not None else floor_point(camera.ray(x, y, width, height), scene.bounds)


def nearest_point(
    scene: Scene, camera: Camera, x: float, y: float, width: float, height: float, within: float
) -> FloatArray | None:
    """The point (3,) of arm or path that is projected nearest to a pixel, not farther than `within` pixels."""
    arrays = [_points(item) for item in scene.items if not item.key.startswith(FLOOR_KEY)]
    points = np.concatenate([np.empty((0, 3)), *arrays])
    projected = camera.project(points, width, height)
    gaps = np.hypot(projected[:, 0] - x, projected[:, 1] - y)
    hidden = ~np.isfinite(gaps) if camera.orthographic else ~(np.isfinite(gaps) & (projected[:, 2] > 0.0))
    gaps[hidden] = np.inf
    if not len(gaps) or gaps.min() > within:
        return None
    found: FloatArray = points[int(np.argmin(gaps))]
    return found


def floor_point(ray: Ray, bounds: FloatArray) -> FloatArray | None:
    """Where a ray meets the floor z = 0 within twice the bounds (2, 3), or None."""
    if abs(ray.direction[2]) < 1e-9:
        return None
    way = -ray.origin[2] / ray.direction[2]
    point: FloatArray = ray.origin + way * ray.direction
    inside = np.abs(point - bounds.mean(axis=0))[:2] <= np.ptp(bounds, axis=0)[:2]
    return point if way > 0.0 and bool(inside.all()) else None


def plane_point(ray: Ray, point: FloatArray, normal: FloatArray) -> FloatArray | None:
    """Where a line of sight meets the plane through a point (3,) square to a unit normal (3,).

    None where that is behind the eye, or where the plane is seen edge-on, within about a degree.
    """
    sine = float(ray.direction @ normal)
    if abs(sine) < _EDGE_ON:
        return None
    way = float((point - ray.origin) @ normal) / sine
    return np.asarray(ray.origin + way * ray.direction) if way > 0.0 else None


def _points(item: Item) -> FloatArray:
    if isinstance(item, Polyline | Segments | Dots):
        return item.points
    if isinstance(item, Capsule):
        return item.start + np.linspace(0.0, 1.0, 9)[:, None] * (item.end - item.start)
    if isinstance(item, Box):
        return item.T_base_box[None, :3, 3]
    return np.empty((0, 3)) if isinstance(item, Labels) else item.T_base_frame[:, :3, 3]


def polyline_distance(pixels: FloatArray, x: float, y: float) -> float:
    """How far a pixel (x, y) is from a line through pixels (k, 2), or from the only point."""
    at = np.array([x, y])
    if len(pixels) == 1:
        return float(np.linalg.norm(pixels[0] - at))
    starts, steps = pixels[:-1], np.diff(pixels, axis=0)
    squared = np.maximum(np.sum(steps**2, axis=1), 1e-12)
    shares = np.clip(np.sum((at - starts) * steps, axis=1) / squared, 0.0, 1.0)
    return float(np.linalg.norm(starts + shares[:, None] * steps - at, axis=1).min())


def inside_polygon(pixels: FloatArray, x: float, y: float) -> bool:
    """Whether a pixel (x, y) lies within a convex polygon of pixels (k, 2)."""
    edges, to = np.roll(pixels, -1, axis=0) - pixels, np.array([x, y]) - pixels
    sides = edges[:, 0] * to[:, 1] - edges[:, 1] * to[:, 0]
    return bool((sides >= 0.0).all() or (sides <= 0.0).all())
