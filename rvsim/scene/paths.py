"""Paths and trails: what was desired, what cannot be reached, what the tool really did."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rvsim.scene.palette import ScenePalette
from rvsim.scene.primitives import Dots, Item, Label, Labels, Polyline, Segments

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]


def path_items(
    desired: ArrayLike,
    reached: ArrayLike,
    actual: ArrayLike,
    palette: ScenePalette,
    *,
    key: str = "path",
    marks: bool | None = None,
    pen_up: ArrayLike | None = None,
) -> tuple[Item, ...]:
    """The desired path (m, 3) with its unreached stretches, and the actual one (k, 3) on top [m].

    Args:
        reached: (m,) which of the desired points the arm can reach.
        marks: a dot at each desired point; None shows them up to 60 points.
        pen_up: (m,) whether the way to each point is made with the pen lifted; None where it never is.
    """
    points, mask = np.asarray(desired, dtype=np.float64).reshape(-1, 3), np.asarray(reached, dtype=bool)
    items: list[Item] = []
    up = np.zeros(len(points), dtype=bool) if pen_up is None else np.asarray(pen_up, dtype=bool)
    for number, (is_reached, is_up, stretch) in enumerate(_stretches(points, mask, up)):
        color = palette.desired if is_reached else palette.unreached
        dashed, width = is_up or not is_reached, 1.0 if is_up else 2.0
        items.append(Polyline(f"{key}.desired{number}", stretch, color, width, dashed=dashed))
    if marks if marks is not None else len(points) <= 60:
        items.append(Dots(f"{key}.reached", points[mask], palette.desired, 5.0))
    items += _crosses(points[~mask], palette, key)
    return (*items, *trail_items(actual, palette, key=f"{key}.actual"))


def trail_items(
    points: ArrayLike, palette: ScenePalette, *, key: str = "trail", pen_up: ArrayLike | None = None
) -> tuple[Item, ...]:
    """Where the tool was: points (k, 3) [m]; nothing for fewer than two, and where the pen was up (k,)."""
    line = np.asarray(points, dtype=np.float64).reshape(-1, 3)
    if len(line) < 2:
        return ()
    if pen_up is None:
        return (Polyline(key, line, palette.actual, 2.2),)
    up = np.asarray(pen_up, dtype=bool)
    pieces = [piece for _, lifted, piece in _stretches(line, np.ones_like(up), up) if not lifted]
    return tuple(Polyline(f"{key}{number}", piece, palette.actual, 2.2) for number, piece in enumerate(pieces))


def _stretches(points: FloatArray, reached: BoolArray, up: BoolArray) -> list[tuple[bool, bool, FloatArray]]:
    """The path cut where it begins or ends to be reached, or the pen to be up; a piece that is half reached is not."""
    if len(points) < 2:
        return []
    whole, lifted = reached[:-1] & reached[1:], up[1:]
    cuts = np.flatnonzero((whole[1:] != whole[:-1]) | (lifted[1:] != lifted[:-1])) + 1
    starts, ends = [0, *cuts.tolist()], [*cuts.tolist(), len(whole)]
    return [
        (bool(whole[start]), bool(lifted[start]), points[start : end + 1])
        for start, end in zip(starts, ends, strict=True)
    ]


def _crosses(points: FloatArray, palette: ScenePalette, key: str) -> list[Item]:
    """A cross at unreached points, so that colour is not the only sign; at most 40, evenly chosen."""
    if not len(points):
        return []
    chosen = points[np.unique(np.linspace(0, len(points) - 1, min(len(points), 40)).astype(int))]
    labels = tuple(Label(point, "×", palette.unreached, (-4.5, 5.0), 15.0) for point in chosen)
    return [Labels(f"{key}.unreached", labels)]


def deviation_items(
    place: ArrayLike,
    offset: ArrayLike,
    breaks: ArrayLike,
    gaps: Sequence[ArrayLike],
    palette: ScenePalette,
    *,
    times: float = 1.0,
    key: str = "deviation",
) -> tuple[Item, ...]:
    """Where the tool goes: along the path as a line, off it on purpose dashed, and its offsets magnified.

    Args:
        place, offset: (k, 3) where the tool is, and how far from the path [m].
        breaks: rows at which another stretch begins.
        gaps: (g, 3) each: where it goes at jumps and over missed stretches [m].
        times: how many times the offsets are magnified; 1 leaves that picture out.
    """
    places, offsets = np.asarray(place, dtype=np.float64), np.asarray(offset, dtype=np.float64)
    rows = [run for run in np.split(np.arange(len(places)), np.asarray(breaks, dtype=int)) if len(run) > 1]
    items: list[Item] = [
        Polyline(f"{key}.along{number}", places[run], palette.actual, 2.2) for number, run in enumerate(rows)
    ]
    items += [
        Polyline(f"{key}.off{number}", np.asarray(gap, dtype=np.float64), palette.actual, 1.2, dashed=True)
        for number, gap in enumerate(gaps)
    ]
    if times != 1.0:
        wanted = places - offsets
        far = wanted + times * offsets
        whiskers = np.stack([wanted, far], axis=1).reshape(-1, 3)
        items.append(Segments(f"{key}.whiskers", whiskers, palette.limit.faded(0.45), 1.0))
        items += [Polyline(f"{key}.far{number}", far[run], palette.limit, 1.4) for number, run in enumerate(rows)]
    return tuple(items)
