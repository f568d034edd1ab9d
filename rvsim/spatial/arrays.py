"""The door of the spatial functions: anything array-like becomes float64 of the right last axes, or a `ShapeError`."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rvsim.errors import ShapeError

FloatArray = NDArray[np.float64]


def floats(name: str, values: ArrayLike, *last: int) -> FloatArray:
    """`values` as float64, not copied if it is so already; its last axes must have the lengths `last`.

    Raises:
        ShapeError: the last axes have other lengths.
    """
    array: FloatArray = np.asarray(values, dtype=np.float64)
    if array.ndim < len(last) or array.shape[array.ndim - len(last) :] != last:
        raise ShapeError(name, f"(..., {', '.join(map(str, last))})", array.shape)
    return array
