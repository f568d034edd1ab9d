"""Text as pen strokes: the single-stroke Roman letters of A. V. Hershey (NBS Special Publication 424, 1976)."""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np

from rvsim.errors import UnknownNameError
from rvsim.resources import resource
from rvsim.robot.arrays import FloatArray

_CAPITALS = 21.0  # the height of a capital letter in the table's units
_LINE = 40.0  # from one base line to the next


class Glyph(NamedTuple):
    """One character: its width and its strokes (k, 2), base line at y = 0, in units of the table."""

    width: float
    strokes: tuple[FloatArray, ...]


@cache
def glyphs() -> dict[str, Glyph]:
    """All characters that can be written."""
    text = resource("fonts", "hershey_simplex.txt").read_text(encoding="utf-8")
    rows = (line.split(" ", 2) for line in text.splitlines() if not line.startswith("##"))
    return {" " if name == "space" else name: _glyph(*rest) for name, *rest in rows}


def _glyph(width: str, strokes: str = "") -> Glyph:
    lines = (line.split() for line in strokes.split("|") if line.strip())
    return Glyph(float(width), tuple(np.array([pair.split(",") for pair in line], dtype=np.float64) for line in lines))


def text_strokes(text: str, height: float) -> list[FloatArray]:
    """The strokes (k, 2) [m] of a text about its middle, its capitals `height` high; a line break begins a new line.

    Raises:
        UnknownNameError: a character that the font has not.
    """
    known, made = glyphs(), []
    for number, line in enumerate(text.splitlines()):
        right = 0.0
        for character in line:
            if character not in known:
                raise UnknownNameError("letter", character, tuple(known))
            glyph = known[character]
            made += [stroke + np.array([right, -_LINE * number]) for stroke in glyph.strokes]
            right += glyph.width
    if not made:
        return []
    every = np.concatenate(made)
    middle = 0.5 * (every.min(axis=0) + every.max(axis=0))
    return [(stroke - middle) * (height / _CAPITALS) for stroke in made]
