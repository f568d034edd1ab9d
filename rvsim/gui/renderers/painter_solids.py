"""Capsules and boxes as rays meet them: which one each pixel shows, and how deep. Plain arithmetic, no Qt.

Each solid answers for many rays at once, in coordinates about its own centre, so that single precision is enough. A ray
passes a pixel at the depth of that centre in `x`, `y` [m] and moves by `dx`, `dy` for each metre of depth (0 where the
projection is parallel). Rays of a grid are rows times columns: x (1, w), y (h, 1); scattered ones are x (n,), y (n,).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rvsim.gui.renderers.painter_lens import Lens, Seen
from rvsim.gui.renderers.painter_light import HALFWAY, LIGHT, UPWARD, PixelArray, SingleArray, lit
from rvsim.scene import Box, Capsule, Color

Solid = Capsule | Box
FloatArray = NDArray[np.float64]
ByteArray = NDArray[np.uint8]

_FLAT_SHINE = np.float32(0.6)  # a flat face that mirrors the light would be white all over
_HARDLY = np.float32(1e-9)  # what keeps a ray just along a face from dividing by zero
FACES = 3  # a solid has this many surface numbers; a box shows at most three faces, a capsule uses the first


class Rays(NamedTuple):
    """Rays about a depth: where they are there (x, y) [m], and how they spread (dx, dy)."""

    x: SingleArray
    y: SingleArray
    dx: SingleArray
    dy: SingleArray


class Hits(NamedTuple):
    """For each ray the depth beyond the solid's centre [m], inf where it misses, and the face 0 … 2 that it meets."""

    depth: SingleArray
    face: ByteArray | int


@dataclass(frozen=True, eq=False)
class RoundBody:
    """A capsule: `axis` (3,) from end to end."""

    centre: FloatArray
    color: Color
    axis: SingleArray
    radius: float

    def hits(self, rays: Rays) -> Hits:
        """The cylinder first, then the ball at the end that the ray passes."""
        x, y, dx, dy = rays
        ax, ay, az = self.axis.tolist()
        length2, radius2 = ax * ax + ay * ay + az * az, self.radius**2
        along_ray = (ax * dx + az) + ay * dy
        along = (ax * x + 0.5 * length2) + ay * y  # from the first end, times the length
        spread2 = (dx * dx + 1.0) + dy * dy
        from_end = 0.5 * along_ray + (x * dx + y * dy)
        gap2 = (x * x + ax * x + 0.25 * length2) + (y * y + ay * y)
        a = np.maximum(length2 * spread2 - along_ray * along_ray, 1e-6 * length2)
        b = length2 * from_end - along * along_ray
        c = length2 * (gap2 - radius2) - along * along
        inside = b * b - a * c
        depth = (-b - np.sqrt(np.maximum(inside, 0.0))) / a
        place = along + depth * along_ray
        beyond = place >= length2
        b = from_end - along_ray * beyond
        c = gap2 - radius2 + (length2 - 2.0 * along) * beyond
        ball = b * b - spread2 * c
        on_ball = (-b - np.sqrt(np.maximum(ball, 0.0))) / spread2
        on_side = (place > 0.0) & ~beyond
        met = (inside > 0.0) & (on_side | (ball > 0.0))
        return Hits(np.where(met, np.where(on_side, depth, on_ball), np.float32(np.inf)), 0)

    def pixels(self, rays: Rays, depth: SingleArray) -> PixelArray:
        """(n,) the pixels of the places that rays (n,) meet at a depth (n,) beyond the centre.

        The normal points away from the nearest point of the axis; only its products with the lights are needed.
        """
        point = (rays.x + depth * rays.dx, rays.y + depth * rays.dy, depth)
        share = np.clip(_dot(self.axis, point) / float(self.axis @ self.axis), -0.5, 0.5)
        products = (
            (_dot(light, point) - float(light @ self.axis) * share) / self.radius for light in (LIGHT, HALFWAY, UPWARD)
        )
        return lit(self.color, *products)


@dataclass(frozen=True, eq=False)
class FlatBody:
    """A box: rows of `axes` (3, 3) are its edges' directions, `half` (3,) half its edges."""

    centre: FloatArray
    color: Color
    axes: SingleArray
    half: SingleArray
    outward: SingleArray  # (3,) +1 or −1: on which side of the box the eye is, for each of its axes

    def hits(self, rays: Rays) -> Hits:
        """Between the three pairs of planes: in through the last, out through the first."""
        x, y, dx, dy = (values[None] for values in rays)
        along_x, along_y, along_z = self.axes.T.reshape(3, 3, *(1,) * (x.ndim - 1))
        half = self.half.reshape(along_x.shape)
        with np.errstate(divide="ignore", invalid="ignore"):  # a ray along a plane meets nothing
            slowness = 1.0 / ((along_x * dx + (along_z + _HARDLY)) + along_y * dy)
            middle = (along_x * x + along_y * y) * slowness
            reach = half * np.abs(slowness)
            enters = (-middle) - reach
            enter, leave = enters.max(axis=0), (reach - middle).min(axis=0)
        face = (enters[1] == enter).astype(np.uint8)
        face[enters[2] == enter] = 2
        return Hits(np.where(enter < leave, enter, np.float32(np.inf)), face)

    def normals(self) -> SingleArray:
        """(3, 3) of the three faces that can be seen."""
        outward: SingleArray = self.outward[:, None] * self.axes
        return outward


Body = RoundBody | FlatBody


def face_pixels(bodies: list[FlatBody]) -> PixelArray:
    """(k, 3) the pixels of the faces of boxes: a flat face has one colour."""
    if not bodies:
        return np.empty((0, FACES), dtype=np.uint32)
    normals = np.concatenate([body.normals() for body in bodies])
    colors = np.repeat(np.array([body.color[:3] for body in bodies], dtype=np.float32), FACES, axis=0)
    return lit(colors, normals @ LIGHT, _FLAT_SHINE * (normals @ HALFWAY), normals @ UPWARD).reshape(-1, FACES)


def _dot(vector: SingleArray, point: tuple[SingleArray, SingleArray, SingleArray]) -> SingleArray:
    x, y, z = vector.tolist()
    return np.asarray(x * point[0] + y * point[1] + z * point[2])


def body_of(seen: Seen[Solid], lens: Lens) -> Body:
    """The solid in eye coordinates."""
    item, centre = seen.item, seen.eye.mean(axis=0)
    if isinstance(item, Capsule):
        return _round_body(item, seen.eye, centre)
    axes = lens.rotated(item.T_base_box[:3, :3].T)
    towards_eye = -centre if not lens.orthographic else np.array([0.0, 0.0, -1.0])
    outward = np.where(axes @ towards_eye >= 0.0, 1.0, -1.0)
    single = (np.asarray(values, dtype=np.float32) for values in (axes, item.size / 2, outward))
    return FlatBody(centre, item.color, *single)


def _round_body(item: Capsule, eye: FloatArray, centre: FloatArray) -> RoundBody:
    axis = eye[1] - eye[0]
    if np.linalg.norm(axis) < 1e-3 * item.radius:  # a ball: any short axis does
        axis = np.array([1e-3 * item.radius, 0.0, 0.0])
    return RoundBody(centre, item.color, axis.astype(np.float32), item.radius)


def pixel_box(seen: Seen[Solid], lens: Lens) -> tuple[float, float, float, float] | None:
    """(left, top, right, bottom) that holds the solid's picture; None if it lies behind the eye."""
    radius = seen.item.radius if isinstance(seen.item, Capsule) else 0.0
    depth = seen.eye[:, 2] - 1.2 * radius
    if not (depth > lens.near).any():
        return None
    if not (depth > lens.near).all():
        return 0.0, 0.0, lens.width, lens.height
    margin = (1.05 * radius * lens.scale(depth))[:, None]
    left, top = (seen.pixels - margin).min(axis=0).tolist()
    right, bottom = (seen.pixels + margin).max(axis=0).tolist()
    return left, top, right, bottom
