"""A plane to click on: where a line of sight meets it, and what is drawn of it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rvsim.scene.camera import Ray
from rvsim.scene.palette import ScenePalette
from rvsim.scene.picking import plane_point
from rvsim.scene.primitives import Dots, Item, Label, Labels, Polyline, Segments

FloatArray = NDArray[np.float64]

PLANE_KEY = "work plane"
_CELLS = 10
_NUMBERED = 40
_LEAST_DROP = 1e-6  # [m]


class WorkPlane(NamedTuple):
    """All places whose coordinate `axis` (0 x, 1 y, 2 z) is `offset` [m], base axes."""

    axis: int
    offset: float

    def meets(self, ray: Ray, step: float = 0.0) -> FloatArray | None:
        """Where a line of sight meets it (3,) [m], in whole steps [m] where there is one; None where it does not.

        Seen edge-on, where a pixel is a long way, it counts as not met.
        """
        point = plane_point(ray, self.offset * np.eye(3)[self.axis], np.eye(3)[self.axis])
        if point is None:
            return None
        rounded = np.round(point / step) * step if step > 0.0 else point
        rounded[self.axis] = self.offset
        return np.asarray(rounded + 0.0)  # no −0


def work_plane_items(plane: WorkPlane, middle: FloatArray, half: float, palette: ScenePalette) -> tuple[Item, ...]:
    """A square of it with a grid, `half` [m] to each side of a place (3,) that is brought onto the plane.

    An upright one stands on the floor, or above it.
    """
    across = [axis for axis in range(3) if axis != plane.axis]
    shares = np.linspace(-half, half, _CELLS + 1)
    center = middle.copy()
    center[plane.axis] = plane.offset
    if plane.axis != 2:
        center[2] = max(center[2], half)
    lines = np.tile(center, (2, len(shares), 2, 1))  # (direction, line, end, coordinate)
    for along, (first, second) in enumerate((across, across[::-1])):
        lines[along, :, :, first] += shares[:, None]
        lines[along, :, :, second] += (-half, half)
    corners = np.concatenate([lines[0, 0], lines[0, -1][::-1], lines[0, :1, 0]])
    color = palette.desired
    return (
        Segments(f"{PLANE_KEY}.grid", lines.reshape(-1, 3), color.faded(0.22), 1.0),
        Polyline(f"{PLANE_KEY}.edge", corners, color.faded(0.55), 1.4),
    )


def point_items(points: FloatArray, palette: ScenePalette) -> tuple[Item, ...]:
    """The points (k, 3) that are there, with their numbers as long as these are few."""
    numbered = points if len(points) <= _NUMBERED else points[:0]
    labels = tuple(
        Label(point, str(number), palette.muted_text, (7.0, 14.0), 11.5) for number, point in enumerate(numbered, 1)
    )
    return Dots(f"{PLANE_KEY}.points", points, palette.desired, 7.0), Labels(f"{PLANE_KEY}.names", labels)


def pointer_items(point: FloatArray, text: str, palette: ScenePalette) -> tuple[Item, ...]:
    """Where a click would put a point (3,): a dot, its numbers, and a line down to the floor."""
    items: list[Item] = [Dots(f"{PLANE_KEY}.pointer", point[None], palette.desired, 9.0)]
    if abs(point[2]) > _LEAST_DROP:
        foot = point * (1.0, 1.0, 0.0)
        items.append(
            Polyline(f"{PLANE_KEY}.drop", np.stack([foot, point]), palette.muted_text.faded(0.8), 1.2, dashed=True)
        )
    label = Label(point, text, palette.text, (12.0, -12.0), 12.5)
    return (*items, Labels(f"{PLANE_KEY}.numbers", (label,)))
