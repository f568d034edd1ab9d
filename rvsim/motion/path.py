"""Where the tool goes: the value `Path`, points and orientations without time, and the ways to make one."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rvsim.errors import ShapeError
from rvsim.language import tr, tr_later
from rvsim.robot.arrays import FloatArray, check_finite, check_size, frozen_array

# The tool's z axis points straight down, its x axis along the base's x axis (source 000 tracks with this rotation).
TOOL_DOWN = frozen_array("tool down", np.diag([1.0, -1.0, -1.0]), (3, 3))

_IDENTITY = frozen_array("identity", np.eye(3), (3, 3))
_CORNER, _UNUSUAL = np.radians(25.0), 4.0  # how far a path must turn to have a corner, and how many times the usual
_FARTHEST = 1e12  # [m]: the fourth power of it, and what is found on the way, is still a number


@dataclass(frozen=True, eq=False)
class Path:
    """A sequence of places for the tool.

    Args:
        name: the stable id, for instance "line".
        points: (m, 3) base axes [m], at least one.
        rotations: (m, 3, 3) base → tool, or None where the orientation is free.
        title: what people call it.
        notes: where it comes from and what is worth knowing.
        pen_up: (m,) whether the way from the point before to this one is made with the pen lifted; None where it
            draws all the way.
        known_corners: (c,) indices of the points where it turns sharply, from whoever made it; None to find them.

    Raises:
        ShapeError: points and rotations do not fit together.
        NotFiniteError: a number among them is NaN or infinite.
        TooLargeError: a point is further away than any arm could be.
    """

    name: str
    points: FloatArray
    rotations: FloatArray | None = None
    title: str = ""
    notes: str = ""
    pen_up: NDArray[np.bool_] | None = None
    known_corners: NDArray[np.intp] | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", frozen_array("path points", self.points, (-1, 3)))
        if not self.samples:
            raise ShapeError(tr("path points"), tr("(at least 1, 3)"), self.points.shape)
        check_finite("path points", self.points)
        check_size("path points", self.points, _FARTHEST)
        if self.rotations is not None:
            rotations = frozen_array("path rotations", self.rotations, (self.samples, 3, 3))
            object.__setattr__(self, "rotations", rotations)
            check_finite("path rotations", rotations)
        if self.pen_up is not None and np.shape(self.pen_up) != (self.samples,):
            raise ShapeError("path pen_up", f"({self.samples},)", np.shape(self.pen_up))

    @property
    def samples(self) -> int:
        """The number of points, m."""
        return len(self.points)

    @cached_property
    def length(self) -> float:
        """The length of the polyline through the points [m]."""
        return float(np.linalg.norm(np.diff(self.points, axis=0), axis=1).sum())

    @cached_property
    def corners(self) -> NDArray[np.intp]:
        """Indices of the points where the path turns sharply: by more than 25°, and much more than it usually does.

        A tool that does not rest there would have to jump in speed, or leave the path. Those that are known from the
        making are all there are.
        """
        if self.known_corners is not None:
            return np.asarray(self.known_corners, dtype=np.intp)
        steps = np.diff(self.points, axis=0)
        lengths = np.linalg.norm(steps, axis=1)
        known = np.flatnonzero(lengths > 1e-9 * max(self.length, 1e-9))
        directions = steps[known] / lengths[known, None]
        turns = np.arccos(np.clip(np.sum(directions[:-1] * directions[1:], axis=1), -1.0, 1.0))
        usual = float(np.median(turns)) if len(turns) else 0.0
        return np.asarray(known[1:][turns > max(_CORNER, _UNUSUAL * usual)])

    def poses(self) -> FloatArray:
        """(m, 4, 4) base → tool; the identity orientation where it is free."""
        T = np.zeros((self.samples, 4, 4))
        T[:, :3, 3] = self.points
        T[:, :3, :3] = _IDENTITY if self.rotations is None else self.rotations
        T[:, 3, 3] = 1.0
        return T

    def part(self, which: slice | NDArray[np.intp]) -> Path:
        """Some of its points, with the same name."""
        rotations = None if self.rotations is None else self.rotations[which]
        pen_up = None if self.pen_up is None else self.pen_up[which]
        return replace(self, points=self.points[which], rotations=rotations, pen_up=pen_up, known_corners=None)

    def with_rotation(self, rotation: ArrayLike | None) -> Path:
        """The same places with one orientation (3, 3) for all, one each (m, 3, 3), or None for a free one."""
        return replace(self, rotations=_each(rotation, self.samples))

    def moved(self, shift: ArrayLike) -> Path:
        """Shifted by (3,) [m]."""
        return replace(self, points=self.points + np.asarray(shift, dtype=np.float64))

    @property
    def middle(self) -> FloatArray:
        """(3,) the middle of the box that holds it [m]."""
        return np.asarray(0.5 * (self.points.min(axis=0) + self.points.max(axis=0)))

    def placed(self, center: ArrayLike, turn: ArrayLike | None = None, scale: float = 1.0) -> Path:
        """Scaled and turned about its middle by a rotation (3, 3), and moved so that this lies at `center` (3,) [m].

        The tool is turned along with it.
        """
        R = np.eye(3) if turn is None else np.asarray(turn, dtype=np.float64)
        points = np.asarray(center, dtype=np.float64) + scale * (self.points - self.middle) @ R.T
        return replace(self, points=points, rotations=None if self.rotations is None else R @ self.rotations)


def through_points(points: ArrayLike, rotation: ArrayLike | None = None, *, name: str = "points") -> Path:
    """The path through points (m, 3) with one orientation (3, 3), one each (m, 3, 3), or a free one (None)."""
    places = frozen_array("path points", points, (-1, 3))
    return Path(name, places, _each(rotation, len(places)), title=tr_later("Points"))


def line_path(start: ArrayLike, end: ArrayLike, samples: int, rotation: ArrayLike | None = TOOL_DOWN) -> Path:
    """The straight line from `start` (3,) to `end` (3,), both ends included.

    Args:
        samples: the number of points, at least 2.
        rotation: (3, 3) for all points, (m, 3, 3), or None where the orientation is free.
    """
    first, last = frozen_array("line start", start, (3,)), frozen_array("line end", end, (3,))
    t = np.linspace(0.0, 1.0, max(samples, 2))[:, None]
    return Path("line", (1.0 - t) * first + t * last, _each(rotation, len(t)), title=tr_later("Line"))


def radial_rotations(points: ArrayLike) -> FloatArray:
    """(m, 3, 3): at each point the tool's z axis points level and straight away from the base axis, its y axis up."""
    places = frozen_array("path points", points, (-1, 3))
    azimuth = np.arctan2(places[:, 1], places[:, 0])
    rotations = np.zeros((len(places), 3, 3))
    rotations[:, 0, 2] = rotations[:, 1, 0] = np.cos(azimuth)
    rotations[:, 1, 2], rotations[:, 0, 0] = np.sin(azimuth), -np.sin(azimuth)
    rotations[:, 2, 1] = 1.0
    return rotations


def _each(rotation: ArrayLike | None, samples: int) -> FloatArray | None:
    if rotation is None:
        return None
    return np.broadcast_to(np.asarray(rotation, dtype=np.float64), (samples, 3, 3))
