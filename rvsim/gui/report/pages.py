"""Strips on pages: what belongs together is not parted, and a table that goes on has its head again."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from rvsim.gui.report.strips import Strip


class Placed(NamedTuple):
    """A strip and how far below the upper margin it is [pt]."""

    y: float
    strip: Strip


Page = tuple[Placed, ...]

_FOOT = 0.2  # of a page: a section does not begin so near to its end
_WORTH = 0.3  # of a page: for so much a section begins before the figures of the last one


def paginated(strips: Iterable[Strip], height: float, first: float = 0.0) -> tuple[Page, ...]:
    """Pages of that height; the first one begins `first` below its margin."""
    book = _Book(height, first)
    for chain in _chains(strips):
        book.add(chain)
    book.flush()
    return tuple(tuple(page) for page in book.pages if page)


class _Book:
    """Pages that are being filled, and the figures and tables that wait for the next one."""

    def __init__(self, height: float, first: float) -> None:
        self.pages: list[list[Placed]] = [[]]
        self._height, self._y = height, first
        self._waiting: list[list[Strip]] = []

    def add(self, chain: list[Strip]) -> None:
        """Put a chain on this page, or the next; figures stay in their order, and so do tables."""
        if chain[0].begins:
            self._begin()
        if self._has_room(chain) and not self._behind(chain[0]):
            self._put(chain)
        elif chain[0].floats:
            self._waiting.append(chain)
        else:
            self._turn()
            if not chain[0].again:
                self._put_waiting()
            if not self._has_room(chain) and self.pages[-1]:
                self._turn()
            self._put(chain)

    def flush(self) -> None:
        """What waits: as much as there is room for on this page, the rest on pages of its own."""
        self._put_waiting()
        while self._waiting:
            if self.pages[-1]:
                self._turn()
            self._put(self._waiting.pop(0))
            self._put_waiting()

    def _has_room(self, chain: list[Strip]) -> bool:
        needed = sum(strip.height + strip.above for strip in chain) - (0.0 if self.pages[-1] else chain[0].above)
        return self._y + needed <= self._height or needed > self._height  # what fits on no page is cut anywhere

    def _behind(self, strip: Strip) -> bool:
        """Whether something of its kind waits already."""
        return bool(strip.floats) and any(chain[0].floats == strip.floats for chain in self._waiting)

    def _begin(self) -> None:
        """Make the page ready for a section: at most one figure of the last one comes later, and for enough only."""
        if len(self._waiting) > 1 or (self._waiting and self._left < _WORTH):
            self.flush()
        if self.pages[-1] and self._left < _FOOT:
            self._turn()
            self._put_waiting()

    @property
    def _left(self) -> float:
        """Of the page."""
        return 1.0 - self._y / self._height

    def _put_waiting(self) -> None:
        """As much as there is room for; of each kind in its order."""
        waiting, self._waiting = self._waiting, []
        for chain in waiting:
            if self._has_room(chain) and not self._behind(chain[0]):
                self._put(chain)
            else:
                self._waiting.append(chain)

    def _turn(self) -> None:
        self.pages.append([])
        self._y = 0.0

    def _put(self, chain: list[Strip]) -> None:
        for strip in chain:
            if self.pages[-1] and self._y + strip.above + strip.height > self._height:
                self._turn()
            self._put_strip(strip)

    def _put_strip(self, strip: Strip) -> None:
        """Below what is there; at the top without the space above it, but with its head."""
        page = self.pages[-1]
        if page:
            self._y += strip.above
        for head in strip.again if not page else ():
            page.append(Placed(self._y, head))
            self._y += head.height
        page.append(Placed(self._y, strip))
        self._y += strip.height


def _chains(strips: Iterable[Strip]) -> Iterator[list[Strip]]:
    """Strips that are kept together."""
    chain: list[Strip] = []
    for strip in strips:
        chain.append(strip)
        if not strip.keep:
            yield chain
            chain = []
    if chain:
        yield chain
