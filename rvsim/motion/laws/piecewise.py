"""Joints over time as polynomials, piece after piece: what every time law here gives."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import ShapeError
from rvsim.robot.arrays import FloatArray, frozen_array


class Moments(NamedTuple):
    """Joints at some times, and how they change: each (..., n), in rad (or m) and s."""

    q: FloatArray
    qd: FloatArray
    qdd: FloatArray
    jerk: FloatArray


@dataclass(frozen=True, eq=False)
class PiecewisePolynomial:
    """q(t) of n joints: piece i is Σ coefficients[i, k] (t − breaks[i])^k from breaks[i] to breaks[i + 1].

    Args:
        breaks: (m + 1,) increasing times [s]; the first need not be 0.
        coefficients: (m, degree + 1, n), from the constant term upwards.

    Raises:
        ShapeError: breaks and coefficients do not fit together, or the breaks do not increase.
    """

    breaks: FloatArray
    coefficients: FloatArray

    def __post_init__(self) -> None:
        breaks, coefficients = np.array(self.breaks, np.float64), np.array(self.coefficients, np.float64)
        if coefficients.ndim != 3 or breaks.shape != (len(coefficients) + 1,) or not (np.diff(breaks) > 0.0).all():
            raise ShapeError("breaks", f"({len(coefficients) + 1},), increasing", breaks.shape)
        object.__setattr__(self, "breaks", frozen_array("breaks", breaks, breaks.shape))
        object.__setattr__(self, "coefficients", frozen_array("coefficients", coefficients, coefficients.shape))

    @property
    def start(self) -> float:
        """When it begins [s]."""
        return float(self.breaks[0])

    @property
    def end(self) -> float:
        """When it is over [s]."""
        return float(self.breaks[-1])

    @property
    def duration(self) -> float:
        """How long it takes [s]."""
        return self.end - self.start

    @cached_property
    def _derivatives(self) -> tuple[FloatArray, ...]:
        """The coefficients of q, qd, qdd and jerk."""
        found = [self.coefficients]
        for _ in range(3):
            found.append(_derived(found[-1]))
        return tuple(found)

    def at(self, t: ArrayLike) -> Moments:
        """Joints and their first three derivatives at t (...) [s]; before the start and after the end those there.

        At a break it is the piece that begins; at the end the one that ends.
        """
        time = np.clip(np.asarray(t, np.float64), self.start, self.end)
        piece = np.clip(np.searchsorted(self.breaks, time, side="right") - 1, 0, len(self.coefficients) - 1)
        local = (time - self.breaks[piece])[..., None]
        return Moments(*(_horner(c[piece], local) for c in self._derivatives))

    def q(self, t: ArrayLike) -> FloatArray:
        """The joints (..., n) at t (...) [s]."""
        return self.at(t).q

    def peaks(self) -> Moments:
        """(n,) each: the largest q, |qd|, |qdd| and |jerk| of each joint, exact: where the next derivative is 0."""
        return Moments(*(np.abs(self._extremes(order)).max(axis=0) for order in range(4)))

    def range(self) -> FloatArray:
        """(n, 2) the least and the largest value of each joint on its way."""
        values = self._extremes(0)
        return np.stack([values.min(axis=0), values.max(axis=0)], axis=-1)

    def shifted(self, seconds: float) -> PiecewisePolynomial:
        """The same, later."""
        return PiecewisePolynomial(self.breaks + seconds, self.coefficients)

    def in_one_second(self) -> PiecewisePolynomial:
        """The same from 0 to 1 s, as much quicker or slower."""
        powers = self.duration ** np.arange(self.coefficients.shape[1])
        breaks = (self.breaks - self.start) / self.duration
        return PiecewisePolynomial(breaks, self.coefficients * powers[:, None])

    def _extremes(self, order: int) -> FloatArray:
        """(k, n) values among which are the extremes of a derivative: at both ends of each piece and inside it."""
        own = self._derivatives[order]
        lengths = np.diff(self.breaks)
        inside = _inner_extremes(own, lengths)
        ends = (_horner(own, np.zeros((len(own), 1))), _horner(own, lengths[:, None]))
        return np.concatenate([*ends, inside])


def joined(first: PiecewisePolynomial, *others: PiecewisePolynomial) -> PiecewisePolynomial:
    """One after the other without a pause, each beginning when the one before is over."""
    parts = [first]
    for part in others:
        parts.append(part.shifted(parts[-1].end - part.start))
    degree = max(part.coefficients.shape[1] for part in parts)
    padded = [np.pad(p.coefficients, ((0, 0), (0, degree - p.coefficients.shape[1]), (0, 0))) for p in parts]
    breaks = np.concatenate([first.breaks, *(part.breaks[1:] for part in parts[1:])])
    return PiecewisePolynomial(breaks, np.concatenate(padded))


def _derived(coefficients: FloatArray) -> FloatArray:
    if coefficients.shape[1] == 1:
        return np.zeros_like(coefficients)
    return np.asarray(coefficients[:, 1:] * np.arange(1.0, coefficients.shape[1])[:, None])


def _horner(coefficients: FloatArray, local: FloatArray) -> FloatArray:
    """Σ c[..., k, :] local^k for c (..., degree + 1, n) and local (..., 1)."""
    value = coefficients[..., -1, :]
    for order in range(coefficients.shape[-2] - 2, -1, -1):
        value = value * local + coefficients[..., order, :]
    return np.asarray(value)


def _inner_extremes(own: FloatArray, lengths: FloatArray) -> FloatArray:
    """(k, n) the values where the derivative of own (m, degree + 1, n) is 0 inside a piece; other joints: the start."""
    slopes = _derived(own)
    found = [_horner(own, np.zeros((len(own), 1)))]
    for piece, joint in zip(*np.nonzero(np.abs(slopes[:, 1:]).max(axis=1, initial=0.0) > 0.0), strict=True):
        roots = np.roots(slopes[piece, ::-1, joint])
        real = roots[np.abs(roots.imag) <= 1e-9 * (1.0 + np.abs(roots.real))].real
        inside = real[(real > 0.0) & (real < lengths[piece])]
        if len(inside):
            values = np.repeat(own[piece, :1], len(inside), axis=0)
            values[:, joint] = _horner(own[piece, :, joint : joint + 1], inside[:, None])[:, 0]
            found.append(values)
    return np.concatenate(found)
