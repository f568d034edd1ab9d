"""All texts of a picture, so that none lies on another: what matters more is placed first, the floor's numbers last."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from PySide6.QtCore import QPointF
from PySide6.QtGui import QImage

from rvsim.gui.renderers.painter_ink import HALO, text_anchor, text_picture, text_scale
from rvsim.gui.renderers.text_room import TextRoom
from rvsim.scene import Color, Label, Labels
from rvsim.scene.floor import FLOOR_KEY
from rvsim.scene.gizmo import GIZMO_KEY

_MARKS = frozenset("×")  # these mark a point, and stay on it
_FIXED, _FIRST, _OTHER, _ARM = range(4)
_HANDLE, _ARM_KEY = ".letter", "arm."


class Texts(NamedTuple):
    """An item's labels that are before the eye, and the pixels (x, y) of the points they name."""

    item: Labels
    labels: Sequence[Label]
    pixels: Sequence[tuple[float, float]]


class Placed(NamedTuple):
    """A text's picture and where its upper left corner goes [pixels]."""

    at: QPointF
    picture: QImage


class Ground(NamedTuple):
    """What is written on: width × height [pixels] of a device of that pixel ratio, and the background's colour."""

    width: float
    height: float
    ratio: float
    background: Color


def arranged(texts: Iterable[Texts], floor: Sequence[Placed], ground: Ground) -> list[Placed]:
    """Where the texts go, and those of the `floor`, which have been placed already, that are still free."""
    room = TextRoom(ground.width, ground.height, apart=True)
    placed: list[Placed | None] = []
    for each in sorted(texts, key=lambda each: _rank(each.item.key)):
        rank = _rank(each.item.key)
        for label, at in zip(each.labels, each.pixels, strict=True):
            wanted = _wanted(label, at, ground)
            marks = label.text in _MARKS
            placed.append(wanted if marks else _kept(wanted, at, ground, room, rank))
    free = [text for text in floor if room.place(*_stretch(text, ground.ratio), HALO) is not None]
    return [*free, *(text for text in placed if text is not None)]


def floor_texts(texts: Texts, ground: Ground) -> list[Placed]:
    """The floor's numbers, each where it is wanted or left out: they belong to their lines."""
    room = TextRoom(ground.width, ground.height, apart=True)
    placed = []
    for label, at in zip(texts.labels, texts.pixels, strict=True):
        wanted = _wanted(label, at, ground)
        corner = room.place(*_stretch(wanted, ground.ratio), HALO)
        placed += [] if corner is None else [_at(corner, wanted.picture, ground.ratio)]
    return placed


def is_floor(item: Labels) -> bool:
    """Whether these are the floor's numbers."""
    return item.key.startswith(FLOOR_KEY)


def written(place: tuple[float, float], text: str, color: Color, size: float, ground: Ground) -> Placed:
    """A text whose base line starts at `place` [pixels], on whole pixels of the device."""
    size *= text_scale()
    left, up = text_anchor(size)
    picture = text_picture(text, color, size, ground.background, ground.ratio)
    return _at((place[0] - left, place[1] - up), picture, ground.ratio)


def _rank(key: str) -> int:
    if key.startswith(GIZMO_KEY):
        return _FIXED if key.endswith(_HANDLE) else _FIRST
    return _ARM if key.startswith(_ARM_KEY) else _OTHER


def _wanted(label: Label, at: tuple[float, float], ground: Ground) -> Placed:
    scale = text_scale()
    place = at[0] + scale * label.shift[0], at[1] + scale * label.shift[1]
    return written(place, label.text, label.color, label.size, ground)


def _kept(wanted: Placed, at: tuple[float, float], ground: Ground, room: TextRoom, rank: int) -> Placed | None:
    """A text where it is free, near the point `at`; where nothing is, as it is wanted, but for the arm's own names."""
    stretch = _stretch(wanted, ground.ratio)
    corner = None if rank == _FIXED else room.place_near(*stretch, HALO, at)
    if corner is None and rank != _ARM:
        corner = TextRoom(ground.width, ground.height).place(*stretch, HALO)
        if corner is not None:
            room.take(*corner, *stretch[2:], HALO)
    return None if corner is None else _at(corner, wanted.picture, ground.ratio)


def _stretch(text: Placed, ratio: float) -> tuple[float, float, float, float]:
    """x, y, width and height [pixels]."""
    return text.at.x(), text.at.y(), text.picture.width() / ratio, text.picture.height() / ratio


def _at(corner: tuple[float, float], picture: QImage, ratio: float) -> Placed:
    return Placed(QPointF(round(corner[0] * ratio) / ratio, round(corner[1] * ratio) / ratio), picture)
