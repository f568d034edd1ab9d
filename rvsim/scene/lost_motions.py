"""A lost motion as a dashed double arrow: straight for a way, bent for a turn. Arithmetic only."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rvsim.kinematics import LostMotion
from rvsim.scene.arrows import ON_TOP, arrow_items, turn_arrow_items
from rvsim.scene.palette import ScenePalette
from rvsim.scene.primitives import Item, Polyline

FloatArray = NDArray[np.float64]

_WIDTH, _AXIS_WIDTH = 4.0, 1.6
_ARC = math.radians(115.0)
_ASIDE = 0.03  # of the arrow's length: a line so far beside the tip gets a lead to it


def lost_motion_items(
    key: str, tip: FloatArray, motion: LostMotion, length: float, palette: ScenePalette
) -> tuple[Item, ...]:
    """The motion as a double arrow of `length` [m] to either side, where its line passes the tip (3,).

    A turn is two bent arrows about its dashed axis.
    """
    color, place = palette.limit, tip + motion.offset
    base = f"{ON_TOP}{key}"
    items: list[Item] = []
    if motion.kind == "move":
        for side, way in (("ahead", length), ("back", -length)):
            items += arrow_items(
                f"{base}.{side}", place, way * motion.direction, color, palette, width=_WIDTH, dashed=True
            )
    else:
        ends = np.stack([place - 0.7 * length * motion.direction, place + 0.7 * length * motion.direction])
        items.append(Polyline(f"{base}.axis", ends, color.faded(0.8), _AXIS_WIDTH, dashed=True))
        for side, turn in (("left", _ARC), ("right", -_ARC)):
            items += turn_arrow_items(
                f"{base}.{side}",
                place,
                motion.direction,
                turn,
                0.32 * length,
                color,
                palette,
                width=_WIDTH,
                dashed=True,
            )
    if float(np.linalg.norm(motion.offset)) > _ASIDE * length:
        lead = np.stack([tip, place])
        items.append(Polyline(f"{base}.lead", lead, palette.muted_text.faded(0.8), _AXIS_WIDTH, dashed=True))
    return tuple(items)
