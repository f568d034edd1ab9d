"""Where the joints are at which time: `Trajectory`, a chain of stretches, each a way in joint space and a time law."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import ShapeError
from rvsim.motion.time_law import QUINTIC_PEAK_SPEED, quintic
from rvsim.motion.tracking_result import Tracking
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray, frozen_array

Phase = Literal["approach", "path"]

# Where a robot file gives no joint speed, an animation moves at a pace the eye can follow: a right angle, or half the
# arm's size, in a second. No number for a real arm.
_EASY_TURN = np.pi / 2
_EASY_SIZES = 0.5
_SHORTEST_MOVE = 0.4
# Where no time is asked for, a move uses this part of the joints' speeds.
_CALM = 0.6


@dataclass(frozen=True, eq=False)
class Stretch:
    """From rest to rest through knots: joint-linear between them, eased as a whole by the quintic.

    Args:
        duration: [s], not 0.
        knots: (k,) increasing fractions 0…1 of the way at which the poses are passed.
        q: (k, n) the poses [rad, m].
        progress: (k,) the path index at each knot.
        phase: "approach" on the way to the path, "path" along it, or waiting on it.
    """

    duration: float
    knots: FloatArray
    q: FloatArray
    progress: FloatArray
    phase: Phase = "path"

    def __post_init__(self) -> None:
        object.__setattr__(self, "knots", frozen_array("knots", self.knots, (-1,)))
        object.__setattr__(self, "q", frozen_array("q", self.q, (len(self.knots), -1)))
        object.__setattr__(self, "progress", frozen_array("progress", self.progress, (len(self.knots),)))


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Poses over time: stretches one after the other, each from rest to rest, so that the arm never jumps.

    Raises:
        ShapeError: no stretch, or one does not begin where the one before ends.
    """

    stretches: tuple[Stretch, ...]

    def __post_init__(self) -> None:
        if not self.stretches:
            raise ShapeError("stretches", "(at least 1,)", (0,))
        for before, after in zip(self.stretches, self.stretches[1:], strict=False):
            if not np.array_equal(before.q[-1], after.q[0]):
                raise ValueError("A stretch of a trajectory must begin in the pose in which the one before ends.")

    @cached_property
    def starts(self) -> FloatArray:
        """(stretches + 1,) when each stretch starts, and the end [s]."""
        times = np.concatenate([[0.0], np.cumsum([stretch.duration for stretch in self.stretches])])
        return frozen_array("starts", times, (-1,))

    @property
    def duration(self) -> float:
        """[s]."""
        return float(self.starts[-1])

    @cached_property
    def path_start(self) -> float:
        """When the approach is over and the path begins [s]."""
        approaches = [stretch.phase == "approach" for stretch in self.stretches]
        return float(self.starts[approaches.index(False)]) if False in approaches else self.duration

    def q(self, t: ArrayLike) -> FloatArray:
        """The pose at t [s], clamped to 0…duration: () -> (n,), (k,) -> (k, n)."""
        times = np.asarray(t, dtype=np.float64)
        poses = np.array([self._pose(float(time)) for time in times.ravel()])
        return poses.reshape(*times.shape, poses.shape[-1])

    def path_index(self, t: float) -> float:
        """How far along the path, as a (fractional) index of its points."""
        stretch, way = self._at(t)
        return float(np.interp(way, stretch.knots, stretch.progress))

    def phase(self, t: float) -> Phase:
        """ "approach" on the way to the path, "path" on it."""
        return self._at(t)[0].phase

    def _pose(self, t: float) -> FloatArray:
        stretch, way = self._at(t)
        last = len(stretch.knots) - 2
        knot = min(max(int(np.searchsorted(stretch.knots, way, side="right")) - 1, 0), last)
        before, after = stretch.knots[knot], stretch.knots[knot + 1]
        part = (way - before) / (after - before)
        # The two ends are met exactly; a sum of products would miss them by a rounding.
        return np.asarray(stretch.q[knot + 1] if part >= 1.0 else stretch.q[knot] + part * _step(stretch, knot))

    def _at(self, t: float) -> tuple[Stretch, float]:
        """The stretch at time t and the fraction of its way that is done."""
        time = min(max(t, 0.0), self.duration)
        index = min(int(np.searchsorted(self.starts, time, side="right")) - 1, len(self.stretches) - 1)
        stretch = self.stretches[index]
        return stretch, float(quintic((time - self.starts[index]) / stretch.duration))


def _step(stretch: Stretch, knot: int) -> FloatArray:
    return np.asarray(stretch.q[knot + 1] - stretch.q[knot])


# --- ways to make one --------------------------------------------------------------------------------------------


def joint_move(robot: Robot, q0: ArrayLike, q1: ArrayLike, *, seconds: float | None = None) -> Trajectory:
    """The eased move (n,) to (n,), all joints together: for Home, a recalled pose, a branch.

    Args:
        seconds: how long it should take; None for a pace the eye can follow. Never faster than the joints' max_speed.
    """
    return Trajectory((_move(robot, q0, q1, seconds, 0.0, "path"),))


def trajectory_of(
    tracking: Tracking, start_q: ArrayLike, *, path_seconds: float | None = None, approach_seconds: float | None = None
) -> Trajectory | None:
    """From `start_q` (n,) to the first reached point and along the path; None when no point was reached.

    Through each reached point exactly, joint-linear between them. Over an unreached stretch the arm waits at the last
    reached point (at the first one, if the path begins so), then moves on to the next in joint space. After a jump it
    moves in joint space too. No joint exceeds its max_speed where the robot file knows one.

    Args:
        path_seconds: how long the whole path should take, its unreached points included; None for a calm pace.
        approach_seconds: the same for the way to the first reached point.
    """
    if not tracking.reached_count:
        return None
    pace = (path_seconds or _calm_seconds(tracking)) / max(tracking.samples - 1, 1)
    runs = _runs(tracking)
    here = tracking.q[runs[0][0]]
    stretches = [_move(tracking.robot, start_q, here, approach_seconds, 0.0, "approach")]
    done = 0
    for first, last in runs:
        stretches += _wait(stretches[-1].q[-1], done, first, pace)
        if not np.array_equal(stretches[-1].q[-1], tracking.q[first]):
            stretches.append(_move(tracking.robot, stretches[-1].q[-1], tracking.q[first], None, float(first), "path"))
        stretches += _along(tracking, first, last, pace)
        done = last
    stretches += _wait(stretches[-1].q[-1], done, tracking.samples - 1, pace)
    return Trajectory(tuple(stretches))


def _runs(tracking: Tracking) -> list[tuple[int, int]]:
    """First and last index of each unbroken run of reached points, broken at the jumps as well."""
    indices = np.flatnonzero(tracking.reached)
    breaks = (np.diff(indices) > 1) | np.isin(indices[1:], tracking.jumps)
    return [(int(run[0]), int(run[-1])) for run in np.split(indices, np.flatnonzero(breaks) + 1)]


def _move(robot: Robot, q0: ArrayLike, q1: ArrayLike, seconds: float | None, progress: float, phase: Phase) -> Stretch:
    ends = np.array([np.asarray(q0, dtype=np.float64), np.asarray(q1, dtype=np.float64)])
    shortest = QUINTIC_PEAK_SPEED * float(np.max(np.abs(ends[1] - ends[0]) / _speeds(robot)))
    duration = max(seconds or _SHORTEST_MOVE, shortest if seconds else shortest / _CALM)
    return Stretch(duration, np.array([0.0, 1.0]), ends, np.full(2, progress), phase)


def _wait(q: FloatArray, first: int, last: int, pace: float) -> list[Stretch]:
    """Stay in q while the path goes on from one index to another."""
    if last <= first:
        return []
    return [Stretch((last - first) * pace, np.array([0.0, 1.0]), np.array([q, q]), np.array([first, last], float))]


def _along(tracking: Tracking, first: int, last: int, pace: float) -> list[Stretch]:
    """Through the reached points first…last, each step as long as the pace says, or longer where a joint needs it."""
    if last == first:
        return []
    q = tracking.q[first : last + 1]
    needed = QUINTIC_PEAK_SPEED * np.max(np.abs(np.diff(q, axis=0)) / _speeds(tracking.robot), axis=1)
    times = np.concatenate([[0.0], np.cumsum(np.maximum(pace, needed))])
    return [Stretch(float(times[-1]), times / times[-1], q, np.arange(first, last + 1, dtype=np.float64))]


def _speeds(robot: Robot) -> FloatArray:
    """(n,) max_speed of each joint where it is known, else an easy pace for the eye [rad/s, m/s]."""
    easy = np.where(robot.is_revolute, _EASY_TURN, _EASY_SIZES * robot.size)
    return np.array(
        [
            pace if joint.max_speed is None else joint.max_speed.value
            for joint, pace in zip(robot.joints, easy, strict=True)
        ]
    )


def _calm_seconds(tracking: Tracking) -> float:
    """An eighth of the arm's size in a second, between 3 and 30 s for the whole path."""
    return float(np.clip(8.0 * tracking.path.length / tracking.robot.size, 3.0, 30.0))
