"""What a scene is made of: plain values in metres, base axes, each with a key that stays the same from frame to frame.

A renderer may keep what it made for a key and only move it: an item that is the *same object* as in the last frame has
not changed at all. Colours are (red, green, blue, alpha), each 0…1; widths and sizes are device-independent pixels.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


class Color(NamedTuple):
    """Red, green, blue, alpha, each 0…1."""

    red: float
    green: float
    blue: float
    alpha: float = 1.0

    @classmethod
    def from_hex(cls, text: str, alpha: float = 1.0) -> Color:
        """Of "#rrggbb"."""
        red, green, blue = (int(text[i : i + 2], 16) / 255.0 for i in (1, 3, 5))
        return cls(red, green, blue, alpha)

    def faded(self, factor: float) -> Color:
        """The same colour, its alpha multiplied."""
        return self._replace(alpha=self.alpha * factor)


@dataclass(frozen=True, eq=False)
class Polyline:
    """An open line through points (k, 3)."""

    key: str
    points: FloatArray
    color: Color
    width: float = 1.5
    dashed: bool = False


@dataclass(frozen=True, eq=False)
class Segments:
    """Separate line pieces: points (2k, 3), a piece from each even row to the next."""

    key: str
    points: FloatArray
    color: Color
    width: float = 1.0


@dataclass(frozen=True, eq=False)
class Dots:
    """Round dots at points (k, 3)."""

    key: str
    points: FloatArray
    color: Color
    size: float = 9.0


@dataclass(frozen=True, eq=False)
class Capsule:
    """A solid cylinder with round ends from `start` (3,) to `end` (3,)."""

    key: str
    start: FloatArray
    end: FloatArray
    radius: float
    color: Color


@dataclass(frozen=True, eq=False)
class Box:
    """A solid box: T_base_box (4, 4) at its centre, full edge lengths `size` (3,)."""

    key: str
    T_base_box: FloatArray
    size: FloatArray
    color: Color


@dataclass(frozen=True, eq=False)
class Triads:
    """Coordinate frames T_base_frame (k, 4, 4): red x, green y, blue z, with letters at the ends if asked for."""

    key: str
    T_base_frame: FloatArray
    length: float
    letters: bool = False
    alpha: float = 1.0


class Label(NamedTuple):
    """A text at a place (3,), shifted on the screen by (right, down) pixels."""

    position: FloatArray
    text: str
    color: Color
    shift: tuple[float, float] = (6.0, -6.0)
    size: float = 9.0


@dataclass(frozen=True, eq=False)
class Labels:
    """All texts of the scene, drawn by one painter item on top of everything."""

    key: str
    labels: tuple[Label, ...]


Item = Polyline | Segments | Dots | Capsule | Box | Triads | Labels


@dataclass(frozen=True, eq=False)
class Scene:
    """Items in drawing order for equal depth, the background, and the box (2, 3) [m] that should be in view."""

    items: tuple[Item, ...]
    background: Color
    bounds: FloatArray
