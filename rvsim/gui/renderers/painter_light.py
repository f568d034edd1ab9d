"""How bright a surface is: one light that stays at the viewer's upper left, matt with a soft highlight."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rvsim.scene import Color

SingleArray = NDArray[np.float32]
PixelArray = NDArray[np.uint32]


def _unit(*vector: float) -> SingleArray:
    return np.asarray(np.array(vector) / np.linalg.norm(vector), dtype=np.float32)


# Eye axes: x right, y up, depth away from the viewer.
LIGHT = _unit(-0.42, 0.68, -0.60)
HALFWAY = _unit(*(LIGHT + np.array([0.0, 0.0, -1.0])))  # between the light and the viewer
UPWARD = _unit(0.0, 1.0, 0.0)
_AMBIENT, _DIFFUSE, _SKY, _SHINE = 0.54, 0.44, 0.09, 0.26


def lit(color: Color | SingleArray, facing: SingleArray, halfway: SingleArray, upward: SingleArray) -> PixelArray:
    """(n,) opaque pixels 0xAARRGGBB of a colour on surfaces with unit normals N.

    Lambert's matt part, Blinn's highlight with exponent 16, and a sky that is brighter above.

    Args:
        color: one for all, or (n, 3) red, green, blue 0…1.
        facing, halfway, upward: (n,) N · LIGHT, N · HALFWAY, and N's y.
    """
    matt = _AMBIENT + _DIFFUSE * np.maximum(facing, 0.0) + _SKY * upward
    shine = np.maximum(halfway, 0.0)
    for _ in range(4):
        shine = shine * shine
    pixels = np.full(matt.shape, 0xFF000000, dtype=np.uint32)
    channels = color.T if isinstance(color, np.ndarray) else color[:3]
    for channel, place in zip(channels, (16, 8, 0), strict=True):
        bright = (255.0 * channel) * matt + (255.0 * _SHINE * (1.0 - 0.5 * channel)) * shine
        pixels |= np.clip(bright, 0.0, 255.0).astype(np.uint32) << np.uint32(place)
    return pixels
