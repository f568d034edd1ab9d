"""Text as pen strokes: the single-stroke Roman letters of A. V. Hershey (NBS Special Publication 424, 1976)."""

from __future__ import annotations

import unicodedata
from functools import cache
from typing import NamedTuple

import numpy as np

from rvsim.errors import LetterError
from rvsim.resources import resource
from rvsim.robot.arrays import FloatArray

_CAPITALS = 21.0  # the height of a capital letter in the table's units
_LINE = 40.0  # from one base line to the next
_SMALL = 14.0  # the height of a small letter
_GAP = 3.0  # between a letter and its mark

# What word processors make of plain signs.
_PLAIN = str.maketrans("\u2019\u2018\u201c\u201d\u2013\u2014\u2212\u00a0\u202f\t", "''\"\"---   ")
_STRUCK = {"ø": "o\u0338", "Ø": "O\u0338", "ł": "l\u0335", "Ł": "L\u0335"}  # not decomposed by Unicode
_DOT = "0,0 -1,1 0,2 1,1 0,0"
# Combining marks as strokes like the table's, about the middle of the letter's top or of its foot.
_ABOVE = {
    "\u0300": "-3,4 2,0",
    "\u0301": "3,4 -2,0",
    "\u0302": "-4,0 0,4 4,0",
    "\u0303": "-5,1 -3,3 -1,3 1,1 3,1 5,3",
    "\u0304": "-4,2 4,2",
    "\u0306": "-4,4 -2,1 2,1 4,4",
    "\u0307": _DOT,
    "\u0308": "-4,0 -5,1 -4,2 -3,1 -4,0 | 4,0 3,1 4,2 5,1 4,0",
    "\u030a": "0,0 -2,2 0,4 2,2 0,0",
    "\u030b": "-4,0 -1,4 | 2,0 5,4",
    "\u030c": "-4,4 0,0 4,4",
}
_BELOW = {
    "\u0323": "0,-4 -1,-3 0,-2 1,-3 0,-4",
    "\u0326": "0,-2 -1,-6",
    "\u0327": "0,0 0,-2 2,-4 0,-6 -2,-5",
    "\u0328": "2,0 0,-3 1,-5 3,-5",
}


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
    return Glyph(float(width), _strokes(strokes))


def _strokes(text: str) -> tuple[FloatArray, ...]:
    lines = (line.split() for line in text.split("|") if line.strip())
    return tuple(np.array([pair.split(",") for pair in line], dtype=np.float64) for line in lines)


def _written(character: str) -> Glyph:
    """Its glyph: the font's own, or that of the plain letter with its marks.

    Raises:
        LetterError: there is none.
    """
    known = glyphs()
    if character in known:
        return known[character]
    base, *marks = list(unicodedata.normalize("NFD", _STRUCK.get(character, character)))
    glyph = known.get(base)
    if glyph is None or not marks:
        raise LetterError(character)
    if base in "ij" and marks[0] in _ABOVE:  # the mark stands where the dot was
        glyph = Glyph(glyph.width, tuple(stroke for stroke in glyph.strokes if stroke[:, 1].min() <= _SMALL))
    for mark in marks:
        glyph = _marked(character, glyph, mark)
    return glyph


def _marked(character: str, glyph: Glyph, mark: str) -> Glyph:
    """The glyph with one mark more."""
    low, high = (end(np.concatenate(glyph.strokes), axis=0) for end in (np.min, np.max))
    middle = 0.5 * (low[0] + high[0])
    if mark == "\u0338":
        return _with(glyph, [np.array([low - 2.0, high + 2.0])])
    if mark == "\u0335":
        return _with(glyph, [np.array([low[0], 0.5 * (low[1] + high[1])]) + np.array([[-3.0, -2.0], [3.0, 2.0]])])
    if mark in _BELOW:
        return _with(glyph, [stroke + np.array([middle, 0.0]) for stroke in _strokes(_BELOW[mark])])
    if mark not in _ABOVE:
        raise LetterError(character)
    foot = np.array([middle, high[1] + _GAP])
    return _with(glyph, [stroke + foot for stroke in _strokes(_ABOVE[mark])])


def _with(glyph: Glyph, strokes: list[FloatArray]) -> Glyph:
    return Glyph(glyph.width, (*glyph.strokes, *strokes))


def text_strokes(text: str, height: float) -> list[FloatArray]:
    """The strokes (k, 2) [m] of a text about its middle, its capitals `height` high; a line break begins a new line.

    Raises:
        LetterError: a character that can be written neither as it is nor as a letter with an accent.
    """
    made: list[FloatArray] = []
    plain = unicodedata.normalize("NFC", text).translate(_PLAIN)
    for number, line in enumerate(plain.splitlines()):
        right = 0.0
        for character in line:
            glyph = _written(character)
            made += [stroke + np.array([right, -_LINE * number]) for stroke in glyph.strokes]
            right += glyph.width
    if not made:
        return []
    every = np.concatenate(made)
    middle = 0.5 * (every.min(axis=0) + every.max(axis=0))
    return [(stroke - middle) * (height / _CAPITALS) for stroke in made]
