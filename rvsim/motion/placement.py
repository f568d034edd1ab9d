"""The nearest place where an arm can draw all of a path: shifts on a grid, coarse to fine, the nearest first.

A few of the path's points are tried at many places at once by the closed form; where all of them can be reached, the
whole path is tracked. Only what was tracked completely and without a jump is an answer.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rvsim.motion.candidates import branches_on
from rvsim.motion.path import Path
from rvsim.motion.tracking import track
from rvsim.motion.tracking_result import Tracking
from rvsim.motion.turns import JointRange, existing
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray, frozen_array

SCALES = (0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1)
_STEPS = 10  # of the coarse grid, from the base to the end of the reach
_FINER = 4  # times half the step
_TRIED, _TRIED_FREE = 24, 6  # points of the path, with a held and with a free orientation
_AT_ONCE = 6000  # points in a batch; of a free orientation as many branches
_MOST_TRACKED = 6  # places at which the tried points are reached but some other is not, or the arm jumps
_SAME = 1e-9


class Place(NamedTuple):
    """An answer: the path's new middle (3,) [m], its scale, and the tracking there."""

    center: FloatArray
    scale: float
    tracking: Tracking


def nearest_place(
    robot: Robot, path: Path, *, near: ArrayLike | None = None, ignore_limits: bool = False, scale: float = 1.0
) -> Iterator[Place | None]:
    """None after every batch of trials, at which it may be given up; in the end the nearest place, if there is one.

    Nowhere does the path go below the table (z = 0) if it did not before.

    Args:
        near: (n,) the present pose, None for home.
        scale: what the path is scaled by about its middle.
    """
    search = _Search(robot, path.placed(path.middle, None, scale), near, ignore_limits)
    found: Place | None = None
    step = robot.size / _STEPS
    centers = _ball(np.asarray(robot.T_base_0[:3, 3]), robot.size, step)
    centers = np.concatenate([centers, _ball(path.middle, 3.0 * step, step)])
    for _ in range(_FINER + 1):
        better: Place | None = None
        for answer in search.first_of(_nearer(centers, path.middle, found)):
            yield None
            better = answer or better
        found = better or found
        if found is None:
            return
        step *= 0.5
        straight = path.middle + np.linspace(0.0, 1.0, 9)[1:-1, None] * (found.center - path.middle)
        centers = np.concatenate([straight, _ball(found.center, 2.0 * step, step)])
    assert found is not None
    yield found._replace(scale=scale)


def largest_in_place(
    robot: Robot, path: Path, *, near: ArrayLike | None = None, ignore_limits: bool = False
) -> Iterator[Place | None]:
    """The same without moving it: the largest of a few scales at which all of it is reached."""
    for scale in SCALES:
        yield None
        search = _Search(robot, path.placed(path.middle, None, scale), near, ignore_limits)
        tracking = search.tracked(path.middle)
        if tracking is not None:
            yield Place(frozen_array("center", path.middle, (3,)), scale, tracking)
            return


def _ball(middle: FloatArray, radius: float, step: float) -> FloatArray:
    """(k, 3) a grid within a radius."""
    count = round(radius / step)
    grid = step * np.array(list(product(range(-count, count + 1), repeat=3)), dtype=np.float64)
    return np.asarray(middle + grid[np.linalg.norm(grid, axis=1) <= radius + _SAME])


def _nearer(centers: FloatArray, middle: FloatArray, found: Place | None) -> FloatArray:
    """Those that are nearer than what was found, the nearest first."""
    away = np.linalg.norm(centers - middle, axis=1)
    most = np.inf if found is None else float(np.linalg.norm(found.center - middle)) - _SAME
    order = np.argsort(away, kind="stable")
    return np.asarray(centers[order[away[order] < most]])


class _Search:
    """One path at many places."""

    def __init__(self, robot: Robot, path: Path, near: ArrayLike | None, ignore_limits: bool) -> None:
        self._robot, self._path, self._ignore = robot, path, ignore_limits
        self._near = robot.home if near is None else frozen_array("near", near, (robot.dof,))
        self._joints = JointRange.of(robot, ignore_limits)
        free = path.rotations is None and robot.dof > 3
        count = min(_TRIED_FREE if free else _TRIED, path.samples)
        self._tried = path.part(np.unique(np.linspace(0, path.samples - 1, count).astype(np.intp)))
        self._batch = max(_AT_ONCE // (count * (100 if free else 1)), 1)
        self._floor = min(float(path.points[:, 2].min()), 0.0) - _SAME

    def first_of(self, centers: FloatArray) -> Iterator[Place | None]:
        """None for each batch, then the first center at which all of the path is reached, if there is one."""
        tracked = 0
        for first in range(0, len(centers), self._batch):
            yield None
            some = centers[first : first + self._batch]
            for center in some[self._reached(some)]:
                tracking = self.tracked(center)
                tracked += 1
                if tracking is not None:
                    yield Place(frozen_array("center", center, (3,)), 1.0, tracking)
                    return
                if tracked >= _MOST_TRACKED:
                    return

    def tracked(self, center: FloatArray) -> Tracking | None:
        """The tracking there, if it is complete and without jumps."""
        path = self._path.moved(center - self._path.middle)
        if not self._reached(np.asarray(center)[None]).all():
            return None
        tracking = track(self._robot, path, near=self._near, ignore_limits=self._ignore)
        return tracking if tracking.complete and not tracking.jumps else None

    def _reached(self, centers: FloatArray) -> NDArray[np.bool_]:
        """(k,) whether all tried points are reached, and none lies below the table."""
        points = self._tried.points + (centers - self._path.middle)[:, None]
        above = (points[..., 2] >= self._floor).all(axis=1)
        result = np.zeros(len(centers), dtype=bool)
        if above.any():
            result[above] = self._usable(points[above])
        return result

    def _usable(self, points: FloatArray) -> NDArray[np.bool_]:
        """(k,) whether the arm can be at all of points (k, t, 3)."""
        rotations = self._tried.rotations
        many = None if rotations is None else np.tile(rotations, (len(points), 1, 1))
        path = replace(
            self._tried, points=points.reshape(-1, 3), rotations=many, pen_up=None, known_corners=np.empty(0, np.intp)
        )
        q = branches_on(self._robot, path, self._near)
        q = self._joints.nearest_copy(q, self._near)
        within = existing(q) & ~np.any(self._joints.outside(np.nan_to_num(q)) > 0.0, axis=-1)
        return np.asarray(within.any(axis=1).reshape(len(points), -1).all(axis=1))
