"""A tool's velocity in the scene: how it moves as an arrow, how it turns as a bent one, wished beside achieved."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rvsim.scene.arrows import ON_TOP, arrow_items, turn_arrow_items
from rvsim.scene.palette import ScenePalette
from rvsim.scene.primitives import Color, Item, Label, Labels

FloatArray = NDArray[np.float64]

_KEY = f"{ON_TOP}velocity"
_LONGEST, _HEAD, _RADIUS = 0.3, 0.05, 0.11  # in sizes of the arm
_LEAST_TURN, _MOST_TURN = math.radians(130.0), math.radians(300.0)
_STILL = 1e-4  # [sizes of the arm a second, rad/s]: slower is rest
_SAME = 0.01  # of the wish: nearer than that, one arrow stands for both
_SLIGHT = 0.01  # of the wish, in radians and sizes of the arm: less turning than that is not drawn


def velocity_items(
    p: FloatArray,
    wished: FloatArray,
    achieved: FloatArray,
    size: float,
    texts: tuple[str, str],
    palette: ScenePalette,
) -> tuple[Item, ...]:
    """Arrows at the tool p (3,) for twists (6,), base axes; the wished ones dashed, where they are other ones.

    Args:
        size: of the arm [m].
        texts: beside the achieved linear and angular arrow.
    """
    items: list[Item] = []
    span = _span(wished[:3], achieved[:3], size)
    for name, twist, color, dashed in (
        ("wished", wished, palette.desired, True),
        ("achieved", achieved, palette.actual, False),
    ):
        other = [not dashed or _differ(wished[part], achieved[part]) for part in (slice(0, 3), slice(3, 6))]
        if other[0]:
            items += arrow_items(
                f"{_KEY}.{name}.v",
                p,
                span * twist[:3],
                color,
                palette,
                width=4.0,
                dashed=dashed,
                longest_head=_HEAD * size,
            )
        if other[1] and _turns(twist, wished, size):
            items += _turn(f"{_KEY}.{name}.w", p, twist[3:], size, color, palette, dashed=dashed)
    if not _turns(achieved, wished, size):
        texts = texts[0], ""
    return (*items, *_labels(p, span, achieved, texts, palette))


def _turns(twist: FloatArray, wished: FloatArray, size: float) -> bool:
    """Whether a twist turns as much as to be told beside the rest of the wish."""
    whole = float(np.hypot(np.linalg.norm(wished[:3]) / size, np.linalg.norm(wished[3:])))
    return float(np.linalg.norm(twist[3:])) > max(_STILL, _SLIGHT * whole)


def _turn(
    key: str, p: FloatArray, w: FloatArray, size: float, color: Color, palette: ScenePalette, *, dashed: bool
) -> tuple[Item, ...]:
    rate = float(np.linalg.norm(w))
    if rate < _STILL:
        return ()
    angle = min(max(2.0 * rate, _LEAST_TURN), _MOST_TURN)
    radius = (1.35 if dashed else 1.0) * _RADIUS * size
    return turn_arrow_items(key, p, w, angle, radius, color, palette, width=3.6, dashed=dashed)


def _labels(
    p: FloatArray, span: float, twist: FloatArray, texts: tuple[str, str], palette: ScenePalette
) -> tuple[Item, ...]:
    labels = []
    if span:
        labels.append(Label(p + span * twist[:3], texts[0], palette.actual, (9.0, -10.0), 12.5))
    if texts[1]:
        labels.append(Label(p, texts[1], palette.actual, (24.0, 34.0), 12.5))
    return (Labels(f"{_KEY}.labels", tuple(labels)),) if labels else ()


def _span(wished: FloatArray, achieved: FloatArray, size: float) -> float:
    """The seconds of way that an arrow shows: as many as fit, of 1, 2, 5, 10 …"""
    fastest = max(float(np.linalg.norm(wished)), float(np.linalg.norm(achieved)))
    if fastest < _STILL * size:
        return 0.0
    most = _LONGEST * size / fastest
    power = 10.0 ** math.floor(math.log10(most))
    return max(step * power for step in (1.0, 2.0, 5.0) if step * power <= most * (1.0 + 1e-12))


def _differ(one: FloatArray, other: FloatArray) -> bool:
    return float(np.linalg.norm(one - other)) > _SAME * max(float(np.linalg.norm(one)), 1e-9)
