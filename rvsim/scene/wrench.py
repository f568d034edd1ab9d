"""The wrench at the tool as arrows: the force straight, the moment bent about its axis. Arithmetic only."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rvsim.scene.arrows import ON_TOP, arrow_items, turn_arrow_items
from rvsim.scene.camera import Camera, Ray
from rvsim.scene.palette import ScenePalette
from rvsim.scene.primitives import Dots, Item, Label, Labels

FloatArray = NDArray[np.float64]

_KEY = f"{ON_TOP}wrench"
_FULL = 0.42  # of the arm's size: the longest arrow
_ARC = 0.11  # of the arm's size: the radius of the bent arrow
_SWEEP = math.radians(250.0)
_HEAD = 0.06  # of the arm's size
_WEIGHT_WIDTH = 3.0
_REACH = 16.0  # [pixels] around the tip that take hold of it
_ROUND = (1.0, 2.0, 5.0)


class WrenchArrows(NamedTuple):
    """A force and a moment (3,) [N, N m] at the tool `origin` (3,), drawn `scale` metres a newton.

    `size` is the arm's [m]; `force_text` and `moment_text` stand at the arrows' ends. What hangs at the tool pulls down
    with `weight` [N]; `mass_text` stands at it.
    """

    origin: FloatArray
    force: FloatArray
    moment: FloatArray
    scale: float
    size: float
    force_text: str = ""
    moment_text: str = ""
    weight: float = 0.0
    mass_text: str = ""

    @property
    def tip(self) -> FloatArray:
        """(3,) where the force's arrow ends, and can be taken hold of."""
        return np.asarray(self.origin + self.scale * self.force)

    def force_at(self, tip: FloatArray) -> FloatArray:
        """The force (3,) whose arrow would end there."""
        return np.asarray((tip - self.origin) / self.scale)


def arrow_scale(size: float, force: float) -> float:
    """Metres a newton for an arm of that size: the longest arrow is the next round force (1, 2, 5, 10 …) above."""
    power = 10.0 ** math.floor(math.log10(max(force, 1e-3)))
    whole = next(power * step for step in (*_ROUND, 10.0) if power * step >= force * (1.0 - 1e-9) or step == 10.0)
    return _FULL * size / whole


def wrench_items(arrows: WrenchArrows, palette: ScenePalette, *, lit: bool = False) -> tuple[Item, ...]:
    """Both arrows, their numbers, and a dot at the force's end that a pointer takes hold of."""
    size, color = arrows.size, palette.limit
    width = 5.0 if lit else 3.6
    head = _HEAD * size
    vector = arrows.scale * arrows.force
    straight = arrow_items(f"{_KEY}.force", arrows.origin, vector, color, palette, width=width, longest_head=head)
    bent = turn_arrow_items(
        f"{_KEY}.moment", arrows.origin, arrows.moment, _SWEEP, _ARC * size, color, palette, width=3.2
    )
    knob = Dots(f"{_KEY}.knob", arrows.tip[None], color, 17.0 if lit else 13.0)
    return (*_payload(arrows, palette), *bent, *straight, knob, *_labels(arrows, palette))


def _payload(arrows: WrenchArrows, palette: ScenePalette) -> tuple[Item, ...]:
    """An arrow downwards, drawn as weights are."""
    if arrows.weight <= 0.0:
        return ()
    down = np.array([0.0, 0.0, -arrows.scale * arrows.weight])
    head = _HEAD * arrows.size
    drawn = arrow_items(
        f"{_KEY}.payload", arrows.origin, down, palette.text, palette, width=_WEIGHT_WIDTH, longest_head=head
    )
    label = Label(arrows.origin + down, arrows.mass_text, palette.text, (10.0, 4.0), 10.0)
    return (*drawn, Labels(f"{_KEY}.payload.labels", (label,)))


def _labels(arrows: WrenchArrows, palette: ScenePalette) -> tuple[Item, ...]:
    labels = []
    if np.any(arrows.force) and arrows.force_text:
        labels.append(Label(arrows.tip, arrows.force_text, palette.limit, (12.0, -8.0), 10.0))
    norm = float(np.linalg.norm(arrows.moment))
    if norm > 0.0 and arrows.moment_text:
        above = arrows.origin + _ARC * arrows.size * arrows.moment / norm
        labels.append(Label(above, arrows.moment_text, palette.limit, (14.0, 18.0), 10.0))
    return (Labels(f"{_KEY}.labels", tuple(labels)),) if labels else ()


def tip_is_under(arrows: WrenchArrows, camera: Camera, at: tuple[float, float], view: tuple[float, float]) -> bool:
    """Whether a pixel `at` (x, y) of a view (width, height) lies on the end of the force's arrow."""
    x, y, depth = camera.project(arrows.tip[None], *view)[0]
    near = math.hypot(x - at[0], y - at[1]) <= _REACH
    return bool(near and (camera.orthographic or depth > 0.0))


def met_in_view_plane(point: FloatArray, camera: Camera, ray: Ray) -> FloatArray | None:
    """Where a line of sight meets the plane through `point` (3,) that faces the camera; None where it does not."""
    normal = camera.axes[2]
    slope = float(ray.direction @ normal)
    if abs(slope) < 1e-9:
        return None
    return np.asarray(ray.origin + float((point - ray.origin) @ normal) / slope * ray.direction)
