"""Read-only copies: the arrays inside a frozen value must not change behind its back."""

from __future__ import annotations

from typing import TypeGuard

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rvsim.errors import NotFiniteError, ShapeError, TooLargeError

FloatArray = NDArray[np.float64]


def frozen_array(name: str, values: ArrayLike, shape: tuple[int, ...]) -> FloatArray:
    """A read-only float copy of `values`, or they themselves where nobody can write into them; −1 matches any length.

    Raises:
        ShapeError: the values have another shape.
    """
    array = values if _is_frozen(values) else np.array(values, dtype=np.float64)
    matches = array.ndim == len(shape) and all(want in (-1, got) for want, got in zip(shape, array.shape, strict=True))
    if not matches:
        raise ShapeError(name, str(shape).replace("-1", "any"), array.shape)
    array.setflags(write=False)
    return array


def check_finite(name: str, array: FloatArray) -> None:
    """Refuse NaN and infinity.

    Raises:
        NotFiniteError: with the place of the first one.
    """
    finite = np.isfinite(array)
    if not finite.all():
        index = tuple(int(i) for i in np.argwhere(~finite)[0])
        raise NotFiniteError(name, index, float(array[index]))


def check_size(name: str, values: ArrayLike, most: float) -> None:
    """Refuse what is so large that to work with it overflows: magnitudes above `most`.

    Raises:
        TooLargeError: with the largest of them.
    """
    largest = float(np.abs(values).max(initial=0.0))
    if largest > most:
        raise TooLargeError(name, largest, most)


def _is_frozen(values: ArrayLike) -> TypeGuard[FloatArray]:
    """Whether it is such an array already: a value that is edited keeps it, and who compares by `is` sees that."""
    if not isinstance(values, np.ndarray) or values.dtype != np.float64:
        return False
    return values.flags.owndata and not values.flags.writeable
