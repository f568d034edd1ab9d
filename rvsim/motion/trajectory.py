"""Where the joints are at which time: `Trajectory`, a chain of stretches, each a way in joint space and a time law."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import ShapeError
from rvsim.language import tr_later
from rvsim.motion.laws import (
    Moments,
    PiecewisePolynomial,
    cubic,
    quickest_along,
    quintic_between,
    spline_through,
    trapezoid,
)
from rvsim.motion.tracking_result import Tracking
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray, frozen_array

Phase = Literal["approach", "path"]
Law = Literal["quintic", "cubic", "trapezoid", "quickest"]
LAW_TITLES: dict[Law, str] = {
    "quintic": tr_later("Quintic: soft, no jump of acceleration"),
    "cubic": tr_later("Cubic: from rest to rest"),
    "trapezoid": tr_later("Trapezoid: even speed in the middle"),
    "quickest": tr_later("Quickest: always at a limit of some joint"),
}

# From 0 to 1 in a second, at rest at both ends; the trapezoid speeds up for a quarter of the time.
_SHAPES: dict[Law, PiecewisePolynomial] = {
    "quintic": quintic_between(0.0, 1.0, 0.0, 1.0),
    "cubic": cubic(0.0, 1.0, 0.0, 1.0),
    "trapezoid": trapezoid(0.0, 0.0, 1.0, 4.0 / 3.0, 16.0 / 3.0),
}

# Where a robot file gives no joint speed, an animation moves at a pace the eye can follow: a right angle, or half the
# arm's size, in a second. No number for a real arm.
_EASY_TURN = np.pi / 2
_EASY_SIZES = 0.5
_SHORTEST_MOVE = 0.4
_SHORTEST_STRETCH = 1e-3
_IN_A_PIECE = np.array([0.0, 0.25, 0.5, 0.75, 1.0 - 1e-9])
_ENDS = np.geomspace(1e-5, 0.1, 80)
_TELLING = np.unique(np.concatenate([np.linspace(0.0, 1.0, 401), _ENDS, 1.0 - _ENDS]))
_PACE_SAMPLES = 2001
_BETWEEN_SAMPLES = 1.001  # peaks are looked for at samples; between them they are hardly higher
# Where no time is asked for, a move uses this part of the joints' speeds.
_CALM = 0.6


@dataclass(frozen=True, eq=False)
class Stretch:
    """From rest to rest through knots: a cubic spline in joint space, travelled as its time law says.

    Args:
        duration: [s], not 0.
        knots: (k,) increasing fractions 0…1 of the way at which the poses are passed.
        q: (k, n) the poses [rad, m].
        progress: (k,) the path index at each knot.
        phase: "approach" on the way to the path, "path" along it, or waiting on it.
        law: how it speeds up and slows down: from 0 to 1 in a second, one column.
        wanted: how long it was asked to take [s]: less than `duration` where a joint needs more; 0 for no wish.
        eased: whether it was slowed down only where a joint needs it, not as a whole.
    """

    duration: float
    knots: FloatArray
    q: FloatArray
    progress: FloatArray
    phase: Phase = "path"
    law: PiecewisePolynomial = _SHAPES["quintic"]
    wanted: float = 0.0
    eased: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "knots", frozen_array("knots", self.knots, (-1,)))
        object.__setattr__(self, "q", frozen_array("q", self.q, (len(self.knots), -1)))
        object.__setattr__(self, "progress", frozen_array("progress", self.progress, (len(self.knots),)))

    @cached_property
    def way(self) -> PiecewisePolynomial:
        """The joints over the fraction of the way."""
        return spline_through(self.knots, self.q, "not-a-knot" if len(self.knots) > 3 else "natural")

    def at(self, t: FloatArray) -> Moments:
        """Joints (k, n) and their derivatives at times (k,) from its start [s]: the chain rule over way and law."""
        T = self.duration
        s, sd, sdd, sddd = (value[:, 0] / T**k for k, value in enumerate(self.law.at(t / T)))
        q, q1, q2, q3 = self.way.at(s)
        sd, sdd, sddd = sd[:, None], sdd[:, None], sddd[:, None]
        # The two ends are met exactly; a sum of products would miss them by a rounding.
        q = np.where(s[:, None] >= 1.0, self.q[-1], np.where(s[:, None] <= 0.0, self.q[0], q))
        return Moments(q, q1 * sd, q2 * sd**2 + q1 * sdd, q3 * sd**3 + 3.0 * q2 * sd * sdd + q1 * sddd)

    def fraction(self, t: float) -> float:
        """The fraction of the way that is done at a time from its start [s]."""
        return 1.0 if t >= self.duration * (1.0 - 1e-12) else float(self.law.q(t / self.duration)[0])


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

    def at(self, t: ArrayLike) -> Moments:
        """Joints, speeds, accelerations and jerks at t [s], clamped to 0…duration: (k,) -> (k, n) each, () -> (n,)."""
        times = np.clip(np.asarray(t, dtype=np.float64), 0.0, self.duration)
        flat = times.ravel()
        which = np.clip(np.searchsorted(self.starts, flat, side="right") - 1, 0, len(self.stretches) - 1)
        n = self.stretches[0].q.shape[1]
        found = Moments(*(np.empty((len(flat), n)) for _ in range(4)))
        for index in np.unique(which):
            here = which == index
            for values, part in zip(found, self.stretches[index].at(flat[here] - self.starts[index]), strict=True):
                values[here] = part
        return Moments(*(values.reshape(*times.shape, n) for values in found))

    def q(self, t: ArrayLike) -> FloatArray:
        """The pose at t [s], clamped to 0…duration: () -> (n,), (k,) -> (k, n)."""
        return self.at(t).q

    def path_index(self, t: float) -> float:
        """How far along the path, as a (fractional) index of its points."""
        stretch, since = self._stretch_at(t)
        return float(np.interp(stretch.fraction(since), stretch.knots, stretch.progress))

    def phase(self, t: float) -> Phase:
        """ "approach" on the way to the path, "path" on it."""
        return self._stretch_at(t)[0].phase

    def _stretch_at(self, t: float) -> tuple[Stretch, float]:
        """The stretch at time t and the time since it began."""
        time = min(max(t, 0.0), self.duration)
        index = min(int(np.searchsorted(self.starts, time, side="right")) - 1, len(self.stretches) - 1)
        return self.stretches[index], time - float(self.starts[index])


# --- ways to make one --------------------------------------------------------------------------------------------


def joint_move(
    robot: Robot, q0: ArrayLike, q1: ArrayLike, *, seconds: float | None = None, law: Law = "quintic"
) -> Trajectory:
    """The eased move (n,) to (n,), all joints together: for Home, a recalled pose, a branch.

    Args:
        seconds: how long it should take; None for a pace the eye can follow. Never faster than the joints may move.
    """
    return Trajectory((_move(robot, q0, q1, seconds, 0.0, "path", law),))


def trajectory_of(
    tracking: Tracking,
    start_q: ArrayLike,
    *,
    path_seconds: float | None = None,
    approach_seconds: float | None = None,
    law: Law = "quintic",
    ease: bool = False,
) -> Trajectory | None:
    """From `start_q` (n,) to the first reached point and along the path; None when no point was reached.

    Through each reached point exactly, on a spline in joint space between them, from rest to rest at corners. Over an
    unreached stretch the arm waits at the last reached point (at the first one, if the path begins so), then moves on
    to the next in joint space. After a jump it moves in joint space too. No joint exceeds its max_speed and
    max_acceleration where the robot file knows them.

    Args:
        path_seconds: how long the whole path should take, its unreached points included; None for a calm pace, and
            0 for as quick as the joints may with this law.
        approach_seconds: the same for the way to the first reached point.
        law: how each stretch speeds up and slows down.
        ease: where a joint cannot follow the law in that time, slow down only there, not the whole stretch.
    """
    if not tracking.reached_count:
        return None
    wanted = _calm_seconds(tracking) if path_seconds is None else path_seconds
    pace = max(wanted / max(tracking.samples - 1, 1), 1e-6)
    runs = _runs(tracking)
    here = tracking.q[runs[0][0]]
    stretches = [_move(tracking.robot, start_q, here, approach_seconds, 0.0, "approach", law)]
    done = 0
    for first, last in runs:
        stretches += _wait(stretches[-1].q[-1], done, first, pace)
        if not np.array_equal(stretches[-1].q[-1], tracking.q[first]):
            gap = _move(tracking.robot, stretches[-1].q[-1], tracking.q[first], None, float(first), "path", law)
            stretches.append(gap)
        stretches += _along(tracking, first, last, pace, law, ease, wish=bool(path_seconds))
        done = last
    stretches += _wait(stretches[-1].q[-1], done, tracking.samples - 1, pace)
    return Trajectory(tuple(stretches))


def _runs(tracking: Tracking) -> list[tuple[int, int]]:
    """First and last index of each stretch of reached points that is travelled in one go.

    Jumps break them, and corners, where one run ends in the point in which the next one begins.
    """
    indices = np.flatnonzero(tracking.reached)
    breaks = (np.diff(indices) > 1) | np.isin(indices[1:], tracking.jumps)
    unbroken = [(int(run[0]), int(run[-1])) for run in np.split(indices, np.flatnonzero(breaks) + 1)]
    corners = tracking.path.corners
    runs: list[tuple[int, int]] = []
    for first, last in unbroken:
        inner = corners[(corners > first) & (corners < last)].tolist()
        runs += zip([first, *inner], [*inner, last], strict=True)
    return runs


def _move(
    robot: Robot, q0: ArrayLike, q1: ArrayLike, seconds: float | None, progress: float, phase: Phase, law: Law
) -> Stretch:
    ends = np.array([np.asarray(q0, dtype=np.float64), np.asarray(q1, dtype=np.float64)])
    made = _with_law(robot, Stretch(1.0, np.array([0.0, 1.0]), ends, np.full(2, progress), phase), law)
    shortest = shortest_seconds(robot, made)
    calm = max(_SHORTEST_MOVE, shortest / _CALM)
    return replace(made, duration=calm if seconds is None else max(seconds, shortest, _SHORTEST_STRETCH))


def _wait(q: FloatArray, first: int, last: int, pace: float) -> list[Stretch]:
    """Stay in q while the path goes on from one index to another."""
    if last <= first:
        return []
    return [Stretch((last - first) * pace, np.array([0.0, 1.0]), np.array([q, q]), np.array([first, last], float))]


def _along(
    tracking: Tracking, first: int, last: int, pace: float, law: Law, ease: bool, *, wish: bool
) -> list[Stretch]:
    """Through the reached points first…last, as long as the pace says, or longer where a joint needs it."""
    if last == first:
        return []
    q, wanted = tracking.q[first : last + 1], (last - first) * pace
    made = Stretch(wanted, _knots(tracking, first, last), q, np.arange(first, last + 1, dtype=np.float64),
                   wanted=wanted if wish else 0.0)  # fmt: skip
    made = _with_law(tracking.robot, made, law)
    shortest = shortest_seconds(tracking.robot, made)
    if ease and wanted < shortest:
        slower = eased(tracking.robot, made)
        return [slower if slower.duration < shortest else replace(made, duration=shortest, eased=True)]
    return [replace(made, duration=max(wanted, shortest))]


def eased(robot: Robot, stretch: Stretch) -> Stretch:
    """The same way by the same law, slower only where a joint would exceed its speed or acceleration.

    Where the law had to give way, its acceleration jumps from value to value, as in a trapezoid.

    Raises:
        SettingError: there is no limit at all.
    """
    law = quickest_along(stretch.way, speeds(robot), accelerations(robot), _pace_of(stretch))
    made = replace(stretch, law=law.in_one_second(), duration=law.duration, eased=True)
    return replace(made, duration=max(law.duration, shortest_seconds(robot, made)))


def _pace_of(stretch: Stretch) -> Callable[[FloatArray], FloatArray]:
    """How fast the fraction of the way grows at fractions (m,) [1/s]."""
    at = stretch.law.at(np.linspace(0.0, 1.0, _PACE_SAMPLES))
    done, speed = at.q[:, 0], at.qd[:, 0] / stretch.duration
    return lambda s: np.interp(s, done, speed)


def _with_law(robot: Robot, stretch: Stretch, law: Law) -> Stretch:
    """The quickest way is another one for each curve; where nothing limits or moves an arm it is the soft one."""
    if law != "quickest":
        return replace(stretch, law=_SHAPES[law])
    moving = np.ptp(stretch.q, axis=0) > 0.0
    limits = accelerations(robot)
    if not moving.any() or not np.isfinite(limits[moving]).all():
        return stretch
    return replace(stretch, law=quickest_along(stretch.way, speeds(robot), limits).in_one_second())


def _knots(tracking: Tracking, first: int, last: int) -> FloatArray:
    """Fractions 0…1 of the way at which the points first…last lie, by the lengths of the ways between them.

    Where the tool turns on the spot, the way of the joints stands in; a spline over uneven steps would swing.
    """
    places = np.linalg.norm(np.diff(tracking.path.points[first : last + 1], axis=0), axis=1)
    turns = np.abs(np.diff(tracking.q[first : last + 1], axis=0)).max(axis=1)
    steps = sum(part / part.sum() if part.sum() > 0.0 else part for part in (places, 0.05 * turns))
    knots = np.concatenate([[0.0], np.cumsum(np.maximum(steps, 1e-6 / len(turns)))])
    return np.asarray(knots / knots[-1])


def shortest_seconds(robot: Robot, stretch: Stretch) -> float:
    """The least duration [s] of a stretch, however long it takes now, that keeps speeds and accelerations of joints."""
    moments = stretch.at(telling_times(stretch))
    speed = float(np.max(np.abs(moments.qd) / speeds(robot)))
    acceleration = float(np.max(np.abs(moments.qdd) / accelerations(robot)))
    return stretch.duration * _BETWEEN_SAMPLES * max(speed, math.sqrt(acceleration))


def telling_times(stretch: Stretch) -> FloatArray:
    """Times from its start [s] at which its peaks are seen.

    On both sides of each break of the law and a few times between them, at the knots and a few times between them,
    evenly, and densely at both ends: there much time is little of the way, and knots may lie close to them.
    """
    breaks = stretch.law.breaks
    pieces = (breaks[:-1, None] + _IN_A_PIECE * np.diff(breaks)[:, None]).ravel()
    even = np.unique(np.concatenate([_TELLING, pieces]))
    between = np.linspace(0.0, 1.0, 6)[:-1, None]
    ways = np.concatenate([(stretch.knots[:-1] + between * np.diff(stretch.knots)).ravel(), [1.0]])
    times = np.interp(ways, stretch.law.q(even)[:, 0], even)
    return np.asarray(stretch.duration * np.concatenate([even, times]))


def accelerations(robot: Robot) -> FloatArray:
    """(n,) max_acceleration of each joint [rad/s², m/s²], infinite where it is not known."""
    limits = [joint.max_acceleration for joint in robot.joints]
    return np.array([math.inf if limit is None else limit.value for limit in limits])


def speeds(robot: Robot) -> FloatArray:
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
