"""How bright a surface is: one light that stays at the viewer's upper left, matt with a soft highlight."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PySide6.QtGui import QColor

from rvsim.gui.renderers.painter_ink import qcolor
from rvsim.scene import Color

FloatArray = NDArray[np.float64]

# Eye axes: x right, y up, depth away from the viewer.
_VIEWER = np.array([0.0, 0.0, -1.0])
LIGHT = np.array([-0.42, 0.68, -0.60]) / np.linalg.norm([-0.42, 0.68, -0.60])
_HALFWAY = (LIGHT + _VIEWER) / np.linalg.norm(LIGHT + _VIEWER)
_AMBIENT, _DIFFUSE, _SKY = 0.46, 0.50, 0.10
_SHINE, _SHARPNESS = 0.30, 22.0


def brightness(normals: FloatArray) -> tuple[FloatArray, FloatArray]:
    """(matt, shine), each (…), of surfaces with unit normals (…, 3): Lambert, Blinn, and a sky above."""
    facing = np.maximum(normals @ LIGHT, 0.0)
    matt = _AMBIENT + _DIFFUSE * facing + _SKY * normals[..., 1]
    shine = _SHINE * np.maximum(normals @ _HALFWAY, 0.0) ** _SHARPNESS
    return matt, shine


def lit(color: Color, matt: float, shine: float) -> QColor:
    """The colour under that light."""
    red, green, blue = (channel * matt + shine * (1.0 - 0.5 * channel) for channel in color[:3])
    return qcolor(Color(red, green, blue, color.alpha))


def lit_stops(color: Color, places: FloatArray, normals: FloatArray) -> list[tuple[float, QColor]]:
    """Gradient stops at places (k,) 0…1 for normals (k, 3)."""
    matt, shine = brightness(normals)
    return [
        (place, lit(color, bright, glossy))
        for place, bright, glossy in zip(places.tolist(), matt.tolist(), shine.tolist(), strict=True)
    ]
