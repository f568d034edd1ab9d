"""Degrees and millimetres at the edges, radians and metres inside.

Only files, the command line, the wire and the screen import this module: everything below them computes in SI.
The functions take and return scalars or arrays alike.
"""

from __future__ import annotations

from typing import overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

_DEGREE = np.pi / 180.0
_MILLIMETRE = 1e-3


@overload
def radians_from_degrees(angle_deg: float) -> float: ...
@overload
def radians_from_degrees(angle_deg: ArrayLike) -> NDArray[np.float64]: ...
def radians_from_degrees(angle_deg: ArrayLike) -> float | NDArray[np.float64]:
    """Radians of degrees."""
    return _scaled(angle_deg, _DEGREE)


@overload
def degrees_from_radians(angle: float) -> float: ...
@overload
def degrees_from_radians(angle: ArrayLike) -> NDArray[np.float64]: ...
def degrees_from_radians(angle: ArrayLike) -> float | NDArray[np.float64]:
    """Degrees of radians."""
    return _scaled(angle, 1.0 / _DEGREE)


@overload
def metres_from_millimetres(length_mm: float) -> float: ...
@overload
def metres_from_millimetres(length_mm: ArrayLike) -> NDArray[np.float64]: ...
def metres_from_millimetres(length_mm: ArrayLike) -> float | NDArray[np.float64]:
    """Metres of millimetres."""
    return _scaled(length_mm, _MILLIMETRE)


@overload
def millimetres_from_metres(length: float) -> float: ...
@overload
def millimetres_from_metres(length: ArrayLike) -> NDArray[np.float64]: ...
def millimetres_from_metres(length: ArrayLike) -> float | NDArray[np.float64]:
    """Millimetres of metres."""
    return _scaled(length, 1.0 / _MILLIMETRE)


def _scaled(value: ArrayLike, factor: float) -> float | NDArray[np.float64]:
    scaled: NDArray[np.float64] = np.asarray(value, dtype=np.float64) * factor
    return float(scaled) if scaled.ndim == 0 else scaled
