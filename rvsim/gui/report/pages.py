"""Strips on pages: what belongs together is not parted, and a table that goes on has its head again."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from rvsim.gui.report.strips import Strip


class Placed(NamedTuple):
    """A strip and how far below the upper margin it is [pt]."""

    y: float
    strip: Strip


Page = tuple[Placed, ...]
Chain = Sequence[Strip]  # strips that are kept together

_FOOT = 0.15  # of a page: a section does not begin so near to its end
_WORTH = 0.3  # of a page: for so much a section begins before the figures of the last one
_SPACES = (1.0, 0.94, 0.88, 0.82, 0.76, 0.7)  # shares of the spaces that pages are tried with
_BARE, _LEAST_END = 0.06, 0.25  # of a page: what may be empty without being seen; so much is worth a last page
_COST_OF_SPACES, _COST_OF_END = 0.05, 1.0  # beside the squares of what is empty


def paginated(strips: Iterable[Strip], height: float, first: float = 0.0) -> tuple[Page, ...]:
    """Pages of that height; the first one begins `first` below its margin.

    They are laid out with spaces that are a little narrower each time, and the best of these layouts is kept.
    """
    chains = list(_chains(strips))
    return min((_laid_out(chains, height, first, share) for share in _SPACES), key=_Layout.cost).pages


def fill(page: Page, height: float) -> float:
    """How much of a page is taken, 0…1."""
    return (page[-1].y + page[-1].strip.height) / height


class _Layout(NamedTuple):
    pages: tuple[Page, ...]
    height: float
    spaces: float

    def cost(self) -> float:
        """Of pages that are empty below, of a last one with next to nothing on it, and of narrow spaces."""
        fills = [fill(page, self.height) for page in self.pages]
        bare = sum(max(0.0, 1.0 - _BARE - each) ** 2 for each in fills[:-1])
        end = max(0.0, _LEAST_END - fills[-1]) if len(fills) > 1 else 0.0
        return bare + _COST_OF_END * end + _COST_OF_SPACES * (1.0 - self.spaces)


def _laid_out(chains: Iterable[Chain], height: float, first: float, spaces: float) -> _Layout:
    book = _Book(height, first, spaces)
    for chain in chains:
        book.add(chain)
    book.flush()
    return _Layout(tuple(tuple(page) for page in book.pages if page), height, spaces)


class _Book:
    """Pages that are being filled, and the figures and tables that wait for the next one."""

    def __init__(self, height: float, first: float, spaces: float) -> None:
        self.pages: list[list[Placed]] = [[]]
        self._height, self._y, self._spaces = height, first, spaces
        self._waiting: list[Chain] = []

    def add(self, chain: Chain) -> None:
        """Put a chain on this page, or the next; figures stay in their order, and so do tables."""
        if chain[0].begins:
            self._begin()
        whole = not chain[0].goes_on
        if whole:
            self._put_waiting()
        if self._try(chain):
            return
        if chain[0].floats:
            self._waiting.append(chain)
            return
        self._turn()
        if whole:
            self._put_waiting()
        if not self._try(chain):
            self._turn()
            self._put(chain)

    def flush(self) -> None:
        """What waits: as much as there is room for on this page, the rest on pages of its own."""
        self._put_waiting()
        while self._waiting:
            self._turn()
            self._put(self._waiting.pop(0))
            self._put_waiting()

    def _try(self, chain: Chain) -> bool:
        """Put a chain here, or else what may stand for it; False where there is no room, or it has to wait."""
        if chain[0].floats and any(other[0].floats == chain[0].floats for other in self._waiting):
            return False
        fitting = next(filter(self._has_room, (chain, *chain[0].smaller)), None)
        if fitting is not None:
            self._put(fitting)
        return fitting is not None

    def _has_room(self, chain: Chain) -> bool:
        needed = sum(strip.height + self._spaces * (strip.above + strip.below) for strip in chain)
        needed -= self._spaces * (chain[-1].below + (0.0 if self.pages[-1] else chain[0].above))
        return self._y + needed <= self._height or needed > self._height  # what fits on no page is cut anywhere

    def _begin(self) -> None:
        """Make the page ready for a section: at most one figure of the last one comes later, and for enough only."""
        self._put_waiting()
        if len(self._waiting) > 1 or (self._waiting and self._left < _WORTH):
            self.flush()
        if self._left < _FOOT:
            self._turn()

    @property
    def _left(self) -> float:
        """Of the page."""
        return 1.0 - self._y / self._height

    def _put_waiting(self) -> None:
        """As much as there is room for; of each kind in its order."""
        waiting, self._waiting = self._waiting, []
        for chain in waiting:
            if not self._try(chain):
                self._waiting.append(chain)

    def _turn(self) -> None:
        if self.pages[-1]:
            self.pages.append([])
            self._y = 0.0

    def _put(self, chain: Chain) -> None:
        for strip in chain:
            if self._y + self._spaces * strip.above + strip.height > self._height:
                self._turn()
            self._put_strip(strip)

    def _put_strip(self, strip: Strip) -> None:
        """Below what is there; at the top without the space above it, but with its head."""
        page = self.pages[-1]
        if page:
            self._y += self._spaces * strip.above
        for head in strip.again if not page else ():
            page.append(Placed(self._y, head))
            self._y += head.height
        page.append(Placed(self._y, strip))
        self._y += strip.height + self._spaces * strip.below


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
