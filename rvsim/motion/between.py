"""Desired against actual: how far a motion is off its path, at the points and between them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rvsim.kinematics import forward_kinematics
from rvsim.motion.tracking_result import Tracking
from rvsim.motion.trajectory import Stretch, Trajectory
from rvsim.robot.arrays import FloatArray

_SHARES = np.linspace(0.0, 1.0, 6)[:-1]
_GAP_SAMPLES = 41


class Spread(NamedTuple):
    """Of offsets along x, y, z and of their lengths: (4,) each [m]. The mean along an axis keeps its sign."""

    rms: FloatArray
    mean: FloatArray
    largest: FloatArray


@dataclass(frozen=True, eq=False)
class OffPath:
    """Where the tool is and how far that is from the path.

    Args:
        index: (k,) how far along the path, a fractional index of its points, growing.
        place: (k, 3) where the tool is [m].
        offset: (k, 3) from the path to the tool [m], base axes.
    """

    index: FloatArray
    place: FloatArray
    offset: FloatArray

    @property
    def distance(self) -> FloatArray:
        """(k,) [m]."""
        return np.asarray(np.linalg.norm(self.offset, axis=1))

    @property
    def spread(self) -> Spread | None:
        """RMS, mean and largest, None where there is nothing to measure."""
        if not len(self.index):
            return None
        values = np.column_stack([self.offset, self.distance])
        return Spread(np.sqrt(np.mean(values**2, axis=0)), values.mean(axis=0), np.abs(values).max(axis=0))

    @property
    def worst(self) -> float | None:
        """The index at which the tool is the farthest off."""
        return float(self.index[np.argmax(self.distance)]) if len(self.index) else None


def off_at_points(tracking: Tracking) -> OffPath:
    """At the reached points: what the inverse kinematics leaves."""
    return OffPath(np.flatnonzero(tracking.reached).astype(float), tracking.actual[tracking.reached], tracking.offsets)


def off_between(trajectory: Trajectory, tracking: Tracking) -> OffPath:
    """Along the whole motion on the path: at each point and at a few places of each piece of the joints' splines.

    Measured to the nearest place on the pieces about it, so that a tool that is early or late is not off the path. Ways
    that leave the path on purpose, at a jump or over missed points, do not count. Denser points make it smaller.
    """
    pieces = [_on_pieces(stretch) for stretch in trajectory.stretches]
    q, index = (np.concatenate(part) for part in zip(*pieces, strict=True))
    place = forward_kinematics(tracking.robot, q)[:, :3, 3]
    return OffPath(index, place, offsets_from_path(tracking.path.points, place, index))


def way_deviation(trajectory: Trajectory, tracking: Tracking) -> float | None:
    """The largest distance between the tool and the straight way between neighbouring points of the path [m].

    None when there are no such ways; see `off_between`.
    """
    distance = off_between(trajectory, tracking).distance
    return float(distance.max()) if len(distance) else None


def ways_off_path(trajectory: Trajectory, tracking: Tracking) -> tuple[FloatArray, ...]:
    """Where the tool goes (k, 3) [m] when it leaves the path on purpose: at each jump and over each missed stretch."""
    even = np.linspace(0.0, 1.0, _GAP_SAMPLES)
    gaps = [stretch for stretch in trajectory.stretches if _is_gap(stretch)]
    return tuple(forward_kinematics(tracking.robot, stretch.way.q(even))[:, :3, 3] for stretch in gaps)


def offsets_from_path(points: FloatArray, place: FloatArray, index: FloatArray) -> FloatArray:
    """(k, 3) from the nearest place on the path's pieces about a fractional index (k,) to places (k, 3) [m]."""
    if len(points) < 2:
        return np.asarray(place - points[0])
    piece = np.clip(np.nan_to_num(index).astype(int), 0, len(points) - 2)
    neighbours = (np.clip(piece + shift, 0, len(points) - 2) for shift in (-1, 0, 1))
    offsets = np.array([_offsets(place, points[i], points[i + 1]) for i in neighbours])
    nearest = np.argmin(np.sum(offsets**2, axis=2), axis=0)
    return np.asarray(offsets[nearest, np.arange(len(place))])


def _is_gap(stretch: Stretch) -> bool:
    """A move in joint space that is part of the path, but not on it; waiting is no move."""
    return stretch.phase == "path" and not np.ptp(stretch.progress) and bool(np.ptp(stretch.q, axis=0).any())


def _on_pieces(stretch: Stretch) -> tuple[FloatArray, FloatArray]:
    """Poses (k, n) of a stretch, and the fractional index (k,) of the path's points."""
    moving = stretch.phase == "path" and bool(np.ptp(stretch.q, axis=0).any())
    ways = np.flatnonzero(np.diff(stretch.progress) == 1.0) if moving else np.empty(0, dtype=int)
    shares = np.append(np.tile(_SHARES, len(ways)), [1.0] if len(ways) else [])
    pieces = np.append(np.repeat(ways, len(_SHARES)), ways[-1:])
    q = stretch.way.at(stretch.knots[pieces] + shares * np.diff(stretch.knots)[pieces]).q
    return q, stretch.progress[pieces] + shares


def _offsets(places: FloatArray, starts: FloatArray, ends: FloatArray) -> FloatArray:
    """(m, 3) from the nearest places on the pieces from starts to ends (m, 3) to places (m, 3)."""
    steps, offsets = ends - starts, places - starts
    along = np.sum(offsets * steps, axis=1) / np.maximum(np.sum(steps**2, axis=1), 1e-30)
    return np.asarray(offsets - np.clip(along, 0.0, 1.0)[:, None] * steps)
