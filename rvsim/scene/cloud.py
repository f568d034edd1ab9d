"""A workspace in the scene: a cloud of places in a few colour classes, and the outlines of its sections.

Colours are those of viridis (S. van der Walt and N. Smith, 2015): equal steps look equally large, and it can be read
without colours, for it grows lighter all the way. An end that would be lost on the ground is left out.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rvsim.kinematics.workspace import SectionMap
from rvsim.scene.palette import ScenePalette, luminance, mixed
from rvsim.scene.primitives import Color, Dots, Item, Segments

FloatArray = NDArray[np.float64]

CLASSES = 6  # colours of a cloud
MOST_DOTS = 6000  # more hide each other; the painter draws these in two milliseconds
_DOT = 2.0  # [pixels]
_VIRIDIS = (
    "#440154", "#482878", "#3e4989", "#31688e", "#26828e", "#1f9e89", "#35b779", "#6ece58", "#b5de2b", "#fde725",
)  # fmt: skip
_ON_LIGHT, _ON_DARK = (0.0, 0.92), (0.14, 1.0)  # the part of it that stands out from the ground


def scale_color(share: float, *, dark: bool) -> Color:
    """The colour of a value 0…1 on a dark or a light ground."""
    low, high = _ON_DARK if dark else _ON_LIGHT
    place = (low + float(np.clip(share, 0.0, 1.0)) * (high - low)) * (len(_VIRIDIS) - 1)
    index = min(int(place), len(_VIRIDIS) - 2)
    return mixed(Color.from_hex(_VIRIDIS[index]), Color.from_hex(_VIRIDIS[index + 1]), place - index)


def cloud_items(
    points: ArrayLike, shares: ArrayLike, palette: ScenePalette, *, key: str = "workspace.cloud", most: int = MOST_DOTS
) -> tuple[Item, ...]:
    """Dots at points (m, 3) [m], coloured by their shares (m,) 0…1 in `CLASSES` steps; at most `most` of them."""
    places, values = np.asarray(points, dtype=np.float64), np.clip(np.asarray(shares, dtype=np.float64), 0.0, 1.0)
    chosen = np.unique(np.linspace(0, max(len(places) - 1, 0), min(len(places), most)).astype(int))
    classes = np.minimum((values[chosen] * CLASSES).astype(int), CLASSES - 1)
    dark = luminance(palette.background) < 0.5
    return tuple(
        Dots(f"{key}.{number}", places[chosen[classes == number]], scale_color(number / (CLASSES - 1), dark=dark), _DOT)
        for number in range(CLASSES)
        if (classes == number).any()
    )


def section_items(section: SectionMap, palette: ScenePalette, *, key: str) -> tuple[Item, ...]:
    """The outline of a section where it lies in space; nothing for one without an edge."""
    if not len(section.outline):
        return ()
    pieces = merged_pieces(section.outline)
    return (Segments(key, section.place(pieces.reshape(-1, 2)), palette.limit, 1.0),)


def merged_pieces(pieces: FloatArray, most: int = 6) -> FloatArray:
    """Line pieces (k, 2, 2) of which up to `most` that follow each other have become one."""
    follows = np.append(False, (pieces[1:, 0] == pieces[:-1, 1]).all(axis=-1))
    starts = np.flatnonzero(~follows)
    run = np.cumsum(~follows) - 1
    first = (np.arange(len(pieces)) - starts[run]) % most == 0
    begins = np.flatnonzero(first)
    ends = np.append(begins[1:], len(pieces)) - 1
    return np.stack([pieces[begins, 0], pieces[ends, 1]], axis=1)
