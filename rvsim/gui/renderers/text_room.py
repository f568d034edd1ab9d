"""Where texts may lie in a picture: never cut by its edges and, where they are many alike, never on one another."""

from __future__ import annotations

from typing import NamedTuple

_HIGH = 0.15  # of a line's height there is no ink above and below digits


class _Ink(NamedTuple):
    """What a text covers [pixels]."""

    left: float
    top: float
    right: float
    bottom: float

    def meets(self, other: _Ink) -> bool:
        across = self.left < other.right and other.left < self.right
        return across and self.top < other.bottom and other.top < self.bottom


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
            high = halo + _HIGH * (height - 2 * halo)
            ink = _Ink(left + halo, top + high, left + width - halo, top + height - high)
            if any(ink.meets(other) for other in self._taken):
                return None
            self._taken.append(ink)
        return left, top


def moved_inside(start: float, length: float, room: float) -> float | None:
    """Where a stretch begins that is to lie between 0 and `room`; None if more than half of it lies outside."""
    outside = max(-start, start + length - room)
    if outside > 0.5 * length:
        return None
    return min(max(start, 0.0), max(room - length, 0.0))
