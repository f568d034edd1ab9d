"""The gizmo: arrows, squares and rings at the tool's target that a pointer takes hold of. Arithmetic only.

Every handle is a line or a plane through the target; a drag is where the line of sight meets it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rvsim.scene.camera import Camera, Ray
from rvsim.scene.palette import ScenePalette, axis_colors, mixed
from rvsim.scene.picking import inside_polygon, polyline_distance
from rvsim.scene.primitives import Color, Dots, Item, Label, Labels, Polyline, Segments
from rvsim.spatial import rotation_from_axis_angle

FloatArray = NDArray[np.float64]
HandleKind = Literal["axis", "plane", "ring", "free"]

GIZMO_KEY = "gizmo"  # items whose keys begin so are drawn on top of everything but texts, in the order of the scene
PIXELS = 96.0  # from the middle to an arrow's end
_SHAFT, _HEAD, _TIP = 0.24, 0.80, 1.0  # along an arrow, in sizes
_HEAD_WIDTHS = (10.0, 8.0, 6.0, 4.0, 2.5)
_SQUARE = (0.30, 0.52)
_RING = 0.78
_FACETS = 48
_END_ON, _EDGE_ON = 0.975, 0.14  # |cosine| to the line of sight: an arrow seen from its end, a plane from its edge
_LIT = Color.from_hex("#FFB000")


class Handle(NamedTuple):
    """Something to take hold of. `direction` (3,): along an arrow, square to a plane, the axis of a ring; base axes."""

    kind: HandleKind
    name: str
    direction: FloatArray
    color: int = 3  # 0 x, 1 y, 2 z, 3 neither

    @property
    def key(self) -> str:
        """What stays the same while the gizmo moves."""
        return f"{self.kind} {self.name}"


@dataclass(frozen=True, eq=False)
class Gizmo:
    """The handles at a target T (4, 4) as one camera sees them; `size` is the length of an arrow [m]."""

    T: FloatArray
    handles: tuple[Handle, ...]
    size: float
    to_eye: FloatArray

    @property
    def origin(self) -> FloatArray:
        """(3,) the middle."""
        return np.asarray(self.T[:3, 3])

    def seen(self) -> list[Handle]:
        """The handles that this camera can use: no arrow from its end, no plane from its edge."""
        return [handle for handle in self.handles if self._usable(handle)]

    def _usable(self, handle: Handle) -> bool:
        cosine = abs(float(handle.direction @ self.to_eye))
        return {"axis": cosine < _END_ON, "plane": cosine > _EDGE_ON}.get(handle.kind, True)


def gizmo_at(T: FloatArray, handles: tuple[Handle, ...], camera: Camera, height: float) -> Gizmo:
    """The gizmo at T (4, 4), as large on the screen whatever the distance."""
    away = camera.eye - T[:3, 3]
    distance = float(np.linalg.norm(away))
    to_eye = camera.axes[2] if camera.orthographic or distance < 1e-9 else away / distance
    depth = camera.distance if camera.orthographic else max(float(away @ camera.axes[2]), 1e-3 * camera.distance)
    pixel = 2.0 * math.tan(camera.field_of_view / 2) * depth / max(height, 1.0)
    return Gizmo(T, handles, PIXELS * pixel, to_eye)


# --- what it looks like ----------------------------------------------------------------------------------------------


def gizmo_items(gizmo: Gizmo, palette: ScenePalette, lit: str = "", held: str = "", note: str = "") -> tuple[Item, ...]:
    """The handles, the farthest first.

    Args:
        lit: the key of the handle under the pointer.
        held: the key of the one that is being dragged: the others are gone meanwhile.
        note: how far it has been dragged, written beside it.
    """
    items: list[Item] = []
    shown = [handle for handle in gizmo.seen() if not held or handle.key == held]
    for handle in sorted(shown, key=lambda handle: _nearness(gizmo, handle)):
        items += _DRAWN[handle.kind](gizmo, handle, _ink(handle, palette, lit=handle.key in (lit, held)))
    items += [_guide(gizmo, handle, palette) for handle in shown if held and handle.kind == "axis"]
    if note:
        label = Label(gizmo.origin, note, palette.text, (18.0, 30.0), 13.5)
        items.append(Labels(f"{GIZMO_KEY}.note", (label,)))
    return tuple(items)


def _nearness(gizmo: Gizmo, handle: Handle) -> float:
    order = {"ring": 0.0, "plane": 10.0, "axis": 20.0, "free": 30.0}[handle.kind]
    return order + float(handle.direction @ gizmo.to_eye) * (1.0 if handle.kind == "axis" else -1.0)


class _Ink(NamedTuple):
    """What a handle is drawn with: its colour, the same near the background's, and whether it stands out."""

    color: Color
    faint: Color
    lit: bool


def _ink(handle: Handle, palette: ScenePalette, *, lit: bool) -> _Ink:
    own = (*axis_colors(palette.background), palette.text)[handle.color]
    color = mixed(_LIT, own, 0.15) if lit else own
    return _Ink(color, mixed(color, palette.background, 0.68), lit)


def _guide(gizmo: Gizmo, handle: Handle, palette: ScenePalette) -> Item:
    """The line along which a held arrow moves."""
    ends = _along(gizmo, handle, (-4.0, 4.0))
    return Segments(f"{GIZMO_KEY}.guide", ends, axis_colors(palette.background)[handle.color].faded(0.5), 1.2)


def _arrow(gizmo: Gizmo, handle: Handle, ink: _Ink) -> list[Item]:
    key, wider = f"{GIZMO_KEY}.{handle.key}", 1.6 if ink.lit else 0.0
    ends = np.linspace(_HEAD, _TIP, len(_HEAD_WIDTHS) + 1)
    items: list[Item] = [Polyline(key, _along(gizmo, handle, (_SHAFT, _HEAD)), ink.color, 3.0 + 0.5 * wider)]
    for number, width in enumerate(_HEAD_WIDTHS):
        piece = _along(gizmo, handle, (ends[number], ends[number + 1]))
        # Not quite opaque: opaque thick lines are shaded like tubes, piece by piece.
        items.append(Polyline(f"{key}.head{number}", piece, ink.color.faded(0.99), width + wider))
    if not ink.lit:
        letter = Label(_along(gizmo, handle, (1.13, 1.13))[0], handle.name, ink.color, (-3.5, 4.5), 12.0)
        items.append(Labels(f"{key}.letter", (letter,)))
    return items


def _square(gizmo: Gizmo, handle: Handle, ink: _Ink) -> list[Item]:
    corners = _corners(gizmo, handle)
    key = f"{GIZMO_KEY}.{handle.key}"
    shares = np.linspace(0.0, 1.0, 9)[1:-1, None]
    left, right = corners[0] + shares * (corners[3] - corners[0]), corners[1] + shares * (corners[2] - corners[1])
    hatch = np.stack([left, right], axis=1).reshape(-1, 3)
    return [
        Segments(f"{key}.fill", hatch, ink.color.faded(0.75 if ink.lit else 0.40), 2.6),
        Polyline(key, corners[[0, 1, 2, 3, 0]], ink.color.faded(1.0 if ink.lit else 0.85), 2.2 if ink.lit else 1.6),
    ]


def _ring(gizmo: Gizmo, handle: Handle, ink: _Ink) -> list[Item]:
    """The near half strong, the far half faint."""
    key = f"{GIZMO_KEY}.{handle.key}"
    points = _circle(gizmo, handle)
    return [
        Polyline(f"{key}.far", points, ink.faint, 1.4),
        Polyline(key, _front(gizmo, points), ink.color, 3.9 if ink.lit else 2.6),
    ]


def _knob(gizmo: Gizmo, handle: Handle, ink: _Ink) -> list[Item]:
    return [Dots(f"{GIZMO_KEY}.{handle.key}", gizmo.origin[None], ink.color, 15.0 if ink.lit else 12.0)]


_DRAWN = {"axis": _arrow, "plane": _square, "ring": _ring, "free": _knob}


def _along(gizmo: Gizmo, handle: Handle, shares: tuple[float, float]) -> FloatArray:
    return np.asarray(gizmo.origin + gizmo.size * np.array(shares)[:, None] * handle.direction)


def _corners(gizmo: Gizmo, handle: Handle) -> FloatArray:
    """(4, 3) the corners of a plane's square, between the two arrows that lie in it."""
    u, v = _plane_axes(gizmo, handle)
    (low, high), places = _SQUARE, ((0, 0), (1, 0), (1, 1), (0, 1))
    shares = np.array([[(low, high)[i], (low, high)[j]] for i, j in places])
    return np.asarray(gizmo.origin + gizmo.size * shares @ np.stack([u, v]))


def _plane_axes(gizmo: Gizmo, handle: Handle) -> tuple[FloatArray, FloatArray]:
    """The arrows that lie in the plane; where there are none, any two directions."""
    axes = [axis.direction for axis in gizmo.handles if axis.kind == "axis" and axis.name in handle.name]
    return (axes[0], axes[1]) if len(axes) == 2 else square_to(handle.direction)


def _circle(gizmo: Gizmo, handle: Handle) -> FloatArray:
    u, v = square_to(handle.direction)
    angles = np.linspace(0.0, math.tau, _FACETS + 1)[:, None]
    return np.asarray(gizmo.origin + _RING * gizmo.size * (np.cos(angles) * u + np.sin(angles) * v))


def _front(gizmo: Gizmo, circle: FloatArray) -> FloatArray:
    """The half of a circle that is turned to the eye, as one line; a circle seen from above is all front."""
    nearer = (circle[:-1] - gizmo.origin) @ gizmo.to_eye >= -0.02 * gizmo.size
    if nearer.all():
        return circle
    begin = int(np.flatnonzero(nearer & ~np.roll(nearer, 1))[0])
    points = np.roll(circle[:-1], -begin, axis=0)
    return np.asarray(points[: int(nearer.sum())])


def square_to(direction: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Two unit vectors (3,) that make a right-handed frame with a unit vector (3,) as the third."""
    least = np.eye(3)[int(np.argmin(np.abs(direction)))]
    u = np.cross(least, direction)
    u /= np.linalg.norm(u)
    return u, np.cross(direction, u)


# --- what is under the pointer ---------------------------------------------------------------------------------------


def handle_under(
    gizmo: Gizmo, camera: Camera, x: float, y: float, width: float, height: float, within: float = 9.0
) -> Handle | None:
    """The handle drawn nearest to pixel (x, y), not farther than `within` pixels."""
    best, least = None, within
    for handle in gizmo.seen():
        gap = _gap(gizmo, handle, camera, (x, y), (width, height))
        if gap < least:
            best, least = handle, gap
    return best


def _gap(gizmo: Gizmo, handle: Handle, camera: Camera, at: tuple[float, float], view: tuple[float, float]) -> float:
    """Pixels from a pointer to a handle."""
    pixels = camera.project(_outline(gizmo, handle), *view)[:, :2]
    if handle.kind == "plane":
        return 3.0 if inside_polygon(pixels, *at) else math.inf
    gap = polyline_distance(pixels, *at)
    # The knob is round; an arrow's head is wide.
    return max(gap - 5.0, 0.0) if handle.kind == "free" else gap


def _outline(gizmo: Gizmo, handle: Handle) -> FloatArray:
    if handle.kind == "axis":
        return _along(gizmo, handle, (_SHAFT, 1.08))
    if handle.kind == "plane":
        return _corners(gizmo, handle)
    return _front(gizmo, _circle(gizmo, handle)) if handle.kind == "ring" else gizmo.origin[None]


# --- dragging --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class Grip:
    """A handle held since the pointer's line of sight was `start`."""

    handle: Handle
    T: FloatArray
    start: FloatArray  # (3,) the point taken hold of, from the gizmo's origin [m]
    tangent: FloatArray | None  # (3,) of a ring seen from its edge, else None


class Dragged(NamedTuple):
    """The target's pose T (4, 4) and how far it has come: [m], or [rad] about a ring's axis."""

    T: FloatArray
    amount: float


def take_hold(gizmo: Gizmo, handle: Handle, ray: Ray) -> Grip | None:
    """Take hold of a handle along a line of sight; None where the two do not meet."""
    held = handle._replace(direction=gizmo.to_eye) if handle.kind == "free" else handle
    edge_on = handle.kind == "ring" and abs(float(handle.direction @ ray.direction)) < _EDGE_ON
    grip = Grip(held, gizmo.T, np.zeros(3), None)
    if edge_on:
        start = _RING * gizmo.size * gizmo.to_eye
        return Grip(held, gizmo.T, start, np.cross(handle.direction, gizmo.to_eye))
    met = _met(grip, ray)
    return None if met is None else Grip(held, gizmo.T, met, None)


def dragged(grip: Grip, ray: Ray, before: float = 0.0, snap: float = 0.0) -> Dragged | None:
    """Where the target goes when the pointer's line of sight is `ray`; None where it tells nothing.

    Args:
        before: the last amount, so that a ring may be turned more than half a turn.
        snap: the step [m] or [rad] to which the amount along an arrow or about a ring is rounded; 0 for none.
    """
    if grip.handle.kind == "ring":
        angle = _angle(grip, ray, before)
        return None if angle is None else turned(grip.T, grip.handle.direction, _snapped(angle, snap))
    met = _met(grip, ray)
    if met is None:
        return None
    step = met - grip.start
    if grip.handle.kind == "axis":
        amount = _snapped(float(step @ grip.handle.direction), snap)
        return Dragged(moved(grip.T, amount * grip.handle.direction), amount)
    return Dragged(moved(grip.T, step), float(np.linalg.norm(step)))


def moved(T: FloatArray, step: FloatArray) -> FloatArray:
    """T (4, 4) shifted by a step (3,) [m], base axes."""
    shifted = np.array(T)
    shifted[:3, 3] += step
    return shifted


def turned(T: FloatArray, axis: FloatArray, angle: float) -> Dragged:
    """T (4, 4) turned in place about an axis (3,), base axes, by an angle [rad]."""
    turn = np.array(T)
    turn[:3, :3] = rotation_from_axis_angle(axis, angle) @ T[:3, :3]
    return Dragged(turn, angle)


def _met(grip: Grip, ray: Ray) -> FloatArray | None:
    """(3,) from the origin to where a line of sight meets the arrow's line, or the handle's plane; None if nowhere."""
    origin, direction = grip.T[:3, 3], grip.handle.direction
    towards = origin - ray.origin
    cosine = float(direction @ ray.direction)
    if grip.handle.kind == "axis":
        if 1.0 - cosine**2 < 1e-4:
            return None
        # The closest approach of two lines.
        along = (cosine * float(ray.direction @ towards) - float(direction @ towards)) / (1.0 - cosine**2)
        return along * direction
    way = float(direction @ towards) / cosine if abs(cosine) > 0.02 else -1.0
    return ray.origin + way * ray.direction - origin if way > 0.0 else None


def _angle(grip: Grip, ray: Ray, before: float) -> float | None:
    if grip.tangent is not None:
        line = Grip(Handle("axis", "", grip.tangent), moved(grip.T, grip.start), np.zeros(3), None)
        met = _met(line, ray)
        return None if met is None else float(met @ grip.tangent) / float(np.linalg.norm(grip.start))
    met = _met(grip, ray)
    if met is None:
        return None
    across = np.cross(grip.handle.direction, grip.start)
    angle = math.atan2(float(met @ across), float(met @ grip.start))
    return angle + math.tau * round((before - angle) / math.tau)


def _snapped(amount: float, step: float) -> float:
    return step * round(amount / step) if step else amount
