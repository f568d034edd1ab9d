"""Where texts may lie in a picture: never cut by its edges and, where they are many alike, never on one another."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

_HIGH = 0.15  # of a line's height there is no ink above and below digits
_GAP = 3.0  # [pixels] between texts side by side: "200" and "100" are not to become "200100"
_BESIDE = 9.0  # [pixels] between a text and the point it names


class _Ink(NamedTuple):
    """What a text covers [pixels]."""

    left: float
    top: float
    right: float
    bottom: float

    def meets(self, other: _Ink) -> bool:
        return (
            self.left < other.right and other.left < self.right and self.top < other.bottom and other.top < self.bottom
        )


class TextRoom:
    """A picture of width × height [pixels]. Where texts are to keep `apart` it remembers those that it has let in."""

    def __init__(self, width: float, height: float, *, apart: bool = False) -> None:
        self._width, self._height, self._apart = width, height, apart
        self._taken: list[_Ink] = []

    def place(self, x: float, y: float, width: float, height: float, halo: float) -> tuple[float, float] | None:
        """The upper left corner for a text that is wanted at (x, y), its halo included; None if it must be left out."""
        left, top = moved_inside(x, width, self._width), moved_inside(y, height, self._height)
        if left is None or top is None:
            return None
        if self._apart:
            ink = _ink(left, top, width, height, halo)
            if any(ink.meets(other) for other in self._taken):
                return None
            self._taken.append(ink)
        return left, top

    def place_near(
        self, x: float, y: float, width: float, height: float, halo: float, anchor: tuple[float, float]
    ) -> tuple[float, float] | None:
        """As `place`; where another text lies already, the first free place about the point `anchor` instead."""
        wanted = self.place(x, y, width, height, halo)
        if wanted is not None or moved_inside(x, width, self._width) is None:
            return wanted
        if moved_inside(y, height, self._height) is None:
            return None
        near = (self.place(*corner, width, height, halo) for corner in _about(anchor, width, height, halo))
        return next((corner for corner in near if corner is not None), None)

    def take(self, x: float, y: float, width: float, height: float, halo: float) -> None:
        """A text stands there whatever else does."""
        self._taken.append(_ink(x, y, width, height, halo))


def _ink(left: float, top: float, width: float, height: float, halo: float) -> _Ink:
    high = halo + _HIGH * (height - 2 * halo)
    return _Ink(left + halo, top + high, left + width - halo + _GAP, top + height - high)


def _about(anchor: tuple[float, float], width: float, height: float, halo: float) -> Iterator[tuple[float, float]]:
    """Upper left corners: right of a point, left of it, above and below, and then the same further up and down."""
    x, y = anchor
    right, left, middle = x + _BESIDE - halo, x - _BESIDE - width + halo, x - 0.5 * width
    level, step = y - 0.5 * height, height - 2 * halo
    for lift in (0.0, -step, step):
        yield right, level + lift
        yield left, level + lift
    for lift in (-step, step, -2.0 * step, 2.0 * step):
        yield middle, level + lift
        yield right, level + lift
        yield left, level + lift


def moved_inside(start: float, length: float, room: float) -> float | None:
    """Where a stretch begins that is to lie between 0 and `room`; None if more than half of it lies outside."""
    outside = max(-start, start + length - room)
    if outside > 0.5 * length:
        return None
    return min(max(start, 0.0), max(room - length, 0.0))
