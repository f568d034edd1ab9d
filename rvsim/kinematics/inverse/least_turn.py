"""The least rotation that makes something possible: a search over the directions of its axis and over its angle.

Along each axis the first angle that will do is found among samples; the best axis is sampled again more finely around,
and its angle faster still, because near the optimum the angle changes by the square of the axis.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rvsim.spatial import rotation_from_vector
from rvsim.spatial.arrays import FloatArray

# (m, 3, 3) turns -> (groups, m): 0 and more where the group's wish is met, else how far it is from that, negative.
Slack = Callable[[FloatArray], FloatArray]

_NONE = 10.0  # [rad] more than any turn: what a ray counts where no angle will do


class _Zoom(NamedTuple):
    """How the search closes in: first axes and angles, then around the best, up to `wide` [rad] away, `deep` in angle.

    The angle of the best axis is flat: where `wide` shrinks by a factor, `deep` may shrink by its square.
    """

    axes: int
    angles: int
    wide: float
    deep: float
    factor: float
    levels: int


_IN_A_PLANE = _Zoom(36, 37, math.radians(10.0), math.radians(1.5), 0.37, 9)
_IN_SPACE = _Zoom(80, 25, math.radians(24.0), math.radians(3.0), 0.5, 9)
_SPREAD = np.linspace(-1.0, 1.0, 9)
_COARSE_SPREAD = np.linspace(-1.0, 1.0, 5)
_CLOSER = (11, 11, 11)  # samples of the angle before the axes are compared: a tie would pick any of them


def least_turns(slack: Slack, across: FloatArray | None, groups: NDArray[np.intp]) -> FloatArray:
    """The shortest rotation vectors (g, 3) [rad] that meet the wishes of the groups (g,), NaN where none was found.

    Args:
        across: (3,) an axis about which turning changes nothing, so that the shortest turn is square to it; or None.
    """
    zoom = _IN_SPACE if across is None else _IN_A_PLANE
    axis, turn, miss = _all_around(slack, across, groups, zoom)
    # For a small turn the angles of neighbouring axes lie as much closer together.
    wide, deep = zoom.wide, np.minimum(zoom.deep, 0.3 * turn)[:, None]
    for _ in range(zoom.levels):
        axes = _axes_around(axis, across, wide)
        angle, score = _along(slack, groups, axes, _window(turn[:, None], deep, axes.shape[1]))
        axis, turn, miss = _best(axes, angle, score)
        wide, deep = wide * zoom.factor, deep * zoom.factor**2
    return np.where(miss[:, None] < _NONE, axis * turn[:, None], np.nan)


def _all_around(
    slack: Slack, across: FloatArray | None, groups: NDArray[np.intp], zoom: _Zoom
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Axis (g, 3), angle and score (g,) of the best ray among the first ones."""
    axes, angles = _axes(across, zoom.axes), np.linspace(0.0, math.pi, zoom.angles)
    found = slack(_turns(axes[:, None] * angles[:, None])).reshape(-1, len(axes), angles.size)[groups]
    angle, _ = _first(found, np.broadcast_to(angles, found.shape))
    rays, step = np.broadcast_to(axes, (len(groups), *axes.shape)), float(angles[1])
    for samples in _CLOSER:
        angle, score = _along(slack, groups, rays, angle[..., None] + step * np.linspace(-1.0, 0.0, samples))
        step /= samples - 1
    return _best(rays, angle, score)


def _along(
    slack: Slack, groups: NDArray[np.intp], axes: FloatArray, angles: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Angle and score (g, k) of each ray, for axes (g, k, 3) and the angles (g, k, t) to try, growing."""
    angles = np.maximum(angles, 0.0)
    found = slack(_turns(axes[:, :, None] * angles[..., None])).reshape(-1, *angles.shape)
    return _first(found[groups, np.arange(len(groups))], angles)


def _best(axes: FloatArray, angle: FloatArray, score: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    rows, best = np.arange(len(axes)), np.argmin(score, axis=1)
    return axes[rows, best], angle[rows, best], score[rows, best]


def _window(turn: FloatArray, deep: FloatArray, rays: int) -> FloatArray:
    """(g, rays, t) angles around the turns (g, 1)."""
    around = turn + deep * np.linspace(-1.0, 1.0, 21)
    return np.broadcast_to(around[:, None], (len(around), rays, around.shape[1]))


def _turns(vectors: FloatArray) -> FloatArray:
    return rotation_from_vector(vectors.reshape(-1, 3))


def _first(slack: FloatArray, angles: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Of each ray (..., t) the first angle that will do, else the one nearest to that; and what the ray counts.

    It counts where the slack crosses 0 between the samples, so that rays can be told apart that share one.
    """
    will_do = slack >= 0.0
    any_will = will_do.any(axis=-1)
    at = np.where(any_will, np.argmax(will_do, axis=-1), np.argmax(slack, axis=-1))[..., None]
    angle, left = (np.take_along_axis(values, at, axis=-1)[..., 0] for values in (angles, slack))
    before, lacking = (np.take_along_axis(values, np.maximum(at - 1, 0), axis=-1)[..., 0] for values in (angles, slack))
    beyond = (angle - before) * left / np.where(any_will & (lacking < 0.0), left - lacking, np.inf)
    return angle, np.where(any_will, angle - beyond, _NONE - left)


def _axes(across: FloatArray | None, count: int) -> FloatArray:
    """(k, 3) unit vectors all around `across`, or all over the sphere (on a spiral)."""
    if across is not None:
        along, aside = _square_to(across[None])
        phi = np.linspace(0.0, 2.0 * math.pi, count, endpoint=False)[:, None]
        return np.asarray(np.cos(phi) * along + np.sin(phi) * aside)
    k = np.arange(count)
    height, turned = 1.0 - (2.0 * k + 1.0) / count, k * math.pi * (3.0 - math.sqrt(5.0))
    out = np.sqrt(1.0 - height**2)
    return np.stack([out * np.cos(turned), out * np.sin(turned), height], axis=1)


def _axes_around(axis: FloatArray, across: FloatArray | None, wide: float) -> FloatArray:
    """(g, k, 3) unit vectors around each axis (g, 3), up to about `wide` [rad] away, square to `across`."""
    if across is not None:
        steps = wide * _SPREAD[:, None]
        sideways = np.asarray(steps * np.cross(across, axis)[:, None])
    else:
        one, other = _square_to(axis)
        steps = wide * np.array(list(product(_COARSE_SPREAD, repeat=2)))
        sideways = np.asarray(steps[:, :1] * one[:, None] + steps[:, 1:] * other[:, None])
    spread = axis[:, None] + sideways
    return np.asarray(spread / np.linalg.norm(spread, axis=-1, keepdims=True))


def _square_to(axis: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Two unit vectors (g, 3) each, square to the axes (g, 3) and to each other."""
    helper = np.where(np.abs(axis[:, 2:]) < 0.9, [0.0, 0.0, 1.0], [1.0, 0.0, 0.0])
    along = np.cross(helper, axis)
    along = along / np.linalg.norm(along, axis=-1, keepdims=True)
    return np.asarray(along), np.asarray(np.cross(axis, along))
