"""Where a source puts the tool, drawn beside the arm: a pale frame, and a dashed line to it from the tool."""

from __future__ import annotations

import numpy as np

from rvsim.robot.arrays import FloatArray
from rvsim.scene.palette import ScenePalette
from rvsim.scene.primitives import Dots, Item, Label, Labels, Polyline, Segments, Triads

_KEY = "source"
_ARM = 0.075  # of the cross, in the arm's size
_TRIAD = 0.11
_PALE = 0.75
_DASHES = 5


def printed_tool_items(
    T_printed: FloatArray, T_tool: FloatArray, title: str, size: float, palette: ScenePalette
) -> tuple[Item, ...]:
    """A frame at T_printed (4, 4) with its title, and a dashed line from the tool T_tool (4, 4) [m].

    Args:
        size: of the arm [m].
    """
    place, color = T_printed[:3, 3], palette.unreached
    items: list[Item] = [
        Segments(f"{_KEY}.cross", _cross(T_printed, _ARM * size), color, 2.6),
        Dots(f"{_KEY}.place", place[None], color, 9.0),
        Triads(f"{_KEY}.frame", T_printed[None], _TRIAD * size, letters=True, alpha=_PALE),
        Labels(f"{_KEY}.label", (Label(place, title, color, (10.0, 16.0), 12.0),)),
    ]
    if float(np.linalg.norm(place - T_tool[:3, 3])) > 1e-6:
        items.append(Polyline(f"{_KEY}.gap", np.stack([T_tool[:3, 3], place]), color, 2.2, dashed=True))
    return tuple(items)


def _cross(T: FloatArray, arm: float) -> FloatArray:
    """(2k, 3) dashes along the three axes, both ways."""
    cuts = np.linspace(-arm, arm, 2 * _DASHES)
    return np.concatenate([T[:3, 3] + np.outer(cuts, T[:3, axis]) for axis in range(3)])
