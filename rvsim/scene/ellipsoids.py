"""Ellipsoids as lines: its three principal ellipses, finer ones between them, and its axes. Arithmetic only.

A flat ellipsoid is drawn as a disc with its two diameters, one that is flat twice as a line with its ends marked.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rvsim.scene.palette import ScenePalette, mixed
from rvsim.scene.primitives import Color, Dots, Item, Polyline, Segments

FloatArray = NDArray[np.float64]

_FLAT = 0.004  # of the largest radius: thinner than a line looks
_POINTS = 72
_PRINCIPAL_WIDTH, _FINE_WIDTH, _AXIS_WIDTH = 2.4, 1.0, 1.6
_FADED, _AXES = 0.5, 0.75  # how far fine lines go into the background, how much of their colour axes keep
_RING_AT = math.sqrt(0.5)  # between the middle and an end of the longest axis


def ellipsoid_items(
    key: str, center: FloatArray, axes: FloatArray, radii: FloatArray, color: Color, palette: ScenePalette
) -> tuple[Item, ...]:
    """The ellipsoid about `center` (3,) whose principal axes are the columns of `axes` (3, 3), with half lengths
    `radii` (3,) [m]; () where all are 0. Infinite radii have to be cut before."""
    order = np.argsort(radii)[::-1]
    half = np.asarray(axes)[:, order] * np.asarray(radii)[order]
    sizes = np.asarray(radii)[order]
    solid = int((sizes > _FLAT * max(float(sizes[0]), 1e-12)).sum())
    if sizes[0] <= 1e-9:
        return ()
    own = color.faded(0.99)  # not quite opaque: opaque thick lines are shaded like tubes
    diameters = _diameters(key, center, half[:, :solid], own)
    if solid == 1:
        ends = np.stack([center - half[:, 0], center + half[:, 0]])
        return (Polyline(key, ends, own, _PRINCIPAL_WIDTH + 1.0), Dots(f"{key}.ends", ends, own, 8.0))
    pairs = ((0, 1),) if solid == 2 else ((0, 1), (0, 2), (1, 2))
    rings = tuple(
        Polyline(f"{key}.{number}", _ring(center, half[:, i], half[:, j]), own, _PRINCIPAL_WIDTH)
        for number, (i, j) in enumerate(pairs)
    )
    fine = _disc_lines(center, half) if solid == 2 else _body_lines(center, half)
    return (Segments(f"{key}.fine", fine, mixed(own, palette.background, _FADED), _FINE_WIDTH), *rings, diameters)


def _ring(center: FloatArray, u: FloatArray, v: FloatArray) -> FloatArray:
    """A closed ellipse (k, 3) with the half axes u and v."""
    turns = np.linspace(0.0, math.tau, _POINTS + 1)[:, None]
    return np.asarray(center + np.cos(turns) * u + np.sin(turns) * v)


def _diameters(key: str, center: FloatArray, half: FloatArray, color: Color) -> Segments:
    """The axes (3, k) themselves."""
    ends = np.stack([center - half.T, center + half.T], axis=1).reshape(-1, 3)
    return Segments(f"{key}.axes", ends, color.faded(_AXES), _AXIS_WIDTH)


def _body_lines(center: FloatArray, half: FloatArray) -> FloatArray:
    """Two rings across the longest axis, and two along it between the principal ones."""
    long, u, v = half.T
    rings = [_ring(center + side * _RING_AT * long, _RING_AT * u, _RING_AT * v) for side in (-1.0, 1.0)]
    rings += [_ring(center, long, _RING_AT * (u + side * v)) for side in (-1.0, 1.0)]
    return _pieces(rings)


def _disc_lines(center: FloatArray, half: FloatArray) -> FloatArray:
    """Two smaller rings in the disc, which let it look filled."""
    return _pieces([_ring(center, share * half[:, 0], share * half[:, 1]) for share in (1.0 / 3.0, 2.0 / 3.0)])


def _pieces(rings: list[FloatArray]) -> FloatArray:
    return np.concatenate([np.repeat(ring, 2, axis=0)[1:-1] for ring in rings])
