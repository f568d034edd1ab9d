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


def paginated(strips: Iterable[Strip], height: float, first: float = 0.0) -> tuple[Page, ...]:
    """Pages of that height; the first one begins `first` below its margin."""
    pages: list[list[Placed]] = [[]]
    y = first
    for chain in _chains(strips):
        needed = sum(strip.height + strip.above for strip in chain)
        if pages[-1] and y + needed > height and _fits(chain, height):
            pages.append([])
        for strip in chain:
            y = _end(pages[-1], first if len(pages) == 1 else 0.0)
            if pages[-1] and y + strip.above + strip.height > height:
                pages.append([])
                y = 0.0
            y = _put(pages[-1], strip, y)
    return tuple(tuple(page) for page in pages if page)


def _end(page: list[Placed], first: float) -> float:
    return page[-1].y + page[-1].strip.height if page else first


def _put(page: list[Placed], strip: Strip, y: float) -> float:
    """Below what is there; at the top without the space above it, but with its head."""
    if not page:
        for head in strip.again:
            page.append(Placed(y, head))
            y += head.height
    else:
        y += strip.above
    page.append(Placed(y, strip))
    return y + strip.height


def _fits(chain: list[Strip], height: float) -> bool:
    return sum(strip.height + strip.above for strip in chain) - chain[0].above <= height


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
