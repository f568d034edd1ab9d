"""What a tracked path would ask of the arm, told before it moves: reach, jumps, speeds, singularities, clearance."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rvsim.kinematics.clearance import Clearance, clearance
from rvsim.kinematics.jacobian import jacobian
from rvsim.kinematics.singular_families import singular_families
from rvsim.kinematics.singularity import task_rows
from rvsim.motion.tracking_result import Tracking, Unreached, UnreachedKind
from rvsim.motion.trajectory import Stretch, Trajectory, accelerations, speeds, telling_times
from rvsim.robot import Datum, Robot
from rvsim.robot.arrays import FloatArray, frozen_array

Severity = Literal["good", "warning", "bad"]
FindingKind = Literal["reach", "missed", "jump", "speed", "acceleration", "pace", "singular", "table", "own"]
SEVERITIES: tuple[Severity, ...] = ("bad", "warning", "good")

_MOMENTS = 401
# σ_min / σ_max of the task's Jacobian: near a singularity, and as good as in it.
_NEAR, _IN = 0.02, 1e-3
_FAMILY_NEAR = 0.1  # its term, to be named as what comes near
_CLOSE = 0.01  # a clearance, in sizes of the arm
_FULL = 1.0 + 1e-6  # of a limit
_ROUNDING = 1e-9
_IN_TIME = 1.01  # of the time asked for


class Peak(NamedTuple):
    """The most a joint does: |value| at a time [s], its limit (None: not known) and whether that is assumed."""

    joint: int
    value: float
    time: float
    limit: Datum | None

    @property
    def share(self) -> float:
        """Of the limit; nan where that is not known."""
        return self.value / self.limit.value if self.limit else math.nan


@dataclass(frozen=True)
class Finding:
    """One thing to know. What is in `value` and `limit` depends on the kind; inside units.

    Args:
        kind: "reach" (value: the share of points), "missed" (a stretch of points), "jump", "speed" and "acceleration"
            (the joint that is nearest to its limit), "pace" (the path takes `value` [s] where `limit` was asked for,
            for the sake of a joint), "singular" (value: σ_min, limit: σ_min / σ_max), "table" and
            "own" (value: the clearance).
        index, last: the first and the last path index, None where it is on the way to the path.
        time: when it happens [s], None where nothing moves.
        points: the missed points of a stretch.
        joint: its index, None where no joint is concerned.
        links: those that are concerned, 0 the base.
        family: the singular family that is near, "" for none.
        assumed: whether the limit is no source's.
    """

    kind: FindingKind
    severity: Severity
    index: int | None = None
    last: int | None = None
    time: float | None = None
    value: float = math.nan
    limit: float = math.nan
    points: tuple[Unreached, ...] = ()
    joint: int | None = None
    links: tuple[int, ...] = ()
    family: str = ""
    assumed: bool = False

    @property
    def cause(self) -> UnreachedKind | None:
        """Why a stretch was missed."""
        return self.points[0].kind if self.points else None


@dataclass(frozen=True, eq=False)
class Report:
    """All findings, the worst first.

    Args:
        speeds, accelerations: one peak a joint.
        times: (k,) the moments that were looked at [s]; q (k, n) and the clearance there.
        sigma: (k,) the smallest singular value of the task's Jacobian.
    """

    tracking: Tracking
    trajectory: Trajectory | None
    findings: tuple[Finding, ...]
    speeds: tuple[Peak, ...]
    accelerations: tuple[Peak, ...]
    times: FloatArray
    q: FloatArray
    sigma: FloatArray
    clearance: Clearance | None

    @property
    def severity(self) -> Severity:
        """The worst of all."""
        return self.findings[0].severity

    @property
    def robot(self) -> Robot:
        """The arm."""
        return self.tracking.robot

    def of(self, kind: FindingKind) -> tuple[Finding, ...]:
        """The findings of a kind."""
        return tuple(finding for finding in self.findings if finding.kind == kind)


def check(tracking: Tracking, trajectory: Trajectory | None, *, table: float | None = 0.0) -> Report:
    """Look at a tracked path and the motion along it (None: only the path).

    Args:
        table: its height [m], None where there is none.
    """
    look = _Look(tracking, trajectory)
    speeds, accelerations = look.peaks
    clear = clearance(tracking.robot, look.q, table=0.0 if table is None else table) if len(look.q) else None
    found = [
        _reach(tracking),
        *_missed(look),
        *_jumps(look),
        *_most("speed", speeds, look),
        *_most("acceleration", accelerations, look),
        *_pace(look),
        *_singular(look),
        *_clear(look, clear, table),
    ]
    found.sort(key=lambda finding: SEVERITIES.index(finding.severity))
    return Report(
        tracking, trajectory, tuple(found), speeds, accelerations, look.times, look.q, look.sigma[:, -1], clear
    )


class _Look:
    """A motion seen at moments, or where there is none a path at its reached points."""

    def __init__(self, tracking: Tracking, trajectory: Trajectory | None) -> None:
        self.tracking, self.trajectory = tracking, trajectory
        if trajectory is None:
            self.times = frozen_array("times", np.empty(0), (-1,))
            self.q = tracking.q[tracking.reached]
        else:
            self.times = _moments(trajectory)
            self.moments = trajectory.at(self.times)
            self.q = self.moments.q

    @cached_property
    def sigma(self) -> FloatArray:
        """(k, r) the singular values of the task's rows, the largest first."""
        robot = self.tracking.robot
        if not len(self.q):
            return np.empty((0, 1))
        J = jacobian(robot, self.q)[:, list(task_rows(robot))]
        return np.asarray(np.linalg.svd(J, compute_uv=False))

    @cached_property
    def peaks(self) -> tuple[tuple[Peak, ...], tuple[Peak, ...]]:
        """Of speed and acceleration, one a joint."""
        if self.trajectory is None:
            return (), ()
        joints = self.tracking.robot.joints
        limits = [joint.max_speed for joint in joints], [joint.max_acceleration for joint in joints]
        times, *curves = self._steepest
        speeds, accelerations = (
            tuple(_peak(joint, times, curve[:, joint], limit[joint]) for joint in range(len(joints)))
            for curve, limit in zip(curves, limits, strict=True)
        )
        return speeds, accelerations

    @cached_property
    def _steepest(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Times (m,) [s] at which peaks cannot be missed, and |q̇| and |q̈| (m, n) there."""
        assert self.trajectory is not None
        times, speeds, accelerations = [], [], []
        for begin, stretch in zip(self.trajectory.starts, self.trajectory.stretches, strict=False):
            since = telling_times(stretch)
            moments = stretch.at(since)
            times.append(begin + since)
            speeds.append(np.abs(moments.qd))
            accelerations.append(np.abs(moments.qdd))
        return np.concatenate(times), np.concatenate(speeds), np.concatenate(accelerations)

    @cached_property
    def on_path(self) -> NDArray[np.bool_]:
        """(k,) which moments are on the path."""
        if self.trajectory is None:
            return np.ones(len(self.q), dtype=bool)
        return np.array([self.trajectory.phase(time) == "path" for time in self.times.tolist()])

    def index_at(self, row: int) -> int | None:
        """The path index of a moment; None on the way to the path."""
        if self.trajectory is None:
            return int(np.flatnonzero(self.tracking.reached)[row])
        return self.index_of(float(self.times[row]))

    def index_of(self, time: float) -> int | None:
        """The path index at a time [s] of the motion; None on the way to the path."""
        assert self.trajectory is not None
        return round(self.trajectory.path_index(time)) if self.trajectory.phase(time) == "path" else None

    def time_at(self, row: int) -> float | None:
        """The time of a moment [s]."""
        return None if self.trajectory is None else float(self.times[row])

    def time_of(self, index: int) -> float | None:
        """When the motion is at a path index, or waits before it [s]."""
        return None if self.trajectory is None else time_of_index(self.trajectory, index)


def _peak(joint: int, times: FloatArray, curve: FloatArray, limit: Datum | None) -> Peak:
    at = int(np.argmax(curve))
    return Peak(joint, float(curve[at]), float(times[at]), limit)


def _moments(trajectory: Trajectory) -> FloatArray:
    """Even moments, and those at which the stretches begin and are in their middles."""
    even = np.linspace(0.0, trajectory.duration, _MOMENTS)
    return frozen_array("times", np.unique(np.concatenate([even, trajectory.starts])), (-1,))


def time_of_index(trajectory: Trajectory, index: float) -> float:
    """When a motion along a path comes to a (fractional) index of its points [s]."""
    for begin, stretch in zip(trajectory.starts, trajectory.stretches, strict=False):
        if stretch.phase == "path" and stretch.progress[0] <= index <= stretch.progress[-1]:
            part = float(np.interp(index, stretch.progress, stretch.knots)) if np.ptp(stretch.progress) else 0.0
            even = np.linspace(0.0, 1.0, _MOMENTS)
            share = float(np.interp(part, stretch.law.q(even)[:, 0], even))
            return float(begin) + share * stretch.duration
    return trajectory.duration


# --- the findings ------------------------------------------------------------------------------------------------


def _reach(tracking: Tracking) -> Finding:
    share = tracking.reached_count / tracking.samples
    return Finding("reach", "good" if tracking.complete else "bad", 0, tracking.samples - 1, 0.0, value=share)


def _missed(look: _Look) -> Iterator[Finding]:
    for group in stretches(look.tracking.unreached):
        first, last = group[0].index, group[-1].index
        names = look.tracking.robot.joint_names
        joint = names.index(group[0].joint) if group[0].joint else None
        yield Finding("missed", "bad", first, last, look.time_of(first), points=tuple(group), joint=joint)


def stretches(unreached: Iterable[Unreached]) -> list[list[Unreached]]:
    """Neighbours that failed for the same reason, at the same stop."""
    points = list(unreached)
    groups = [[point] for point in points[:1]]
    for before, after in pairwise(points):
        same = (before.kind, before.joint, before.limit) == (after.kind, after.joint, after.limit)
        if same and after.index == before.index + 1:
            groups[-1].append(after)
        else:
            groups.append([after])
    return groups


def _jumps(look: _Look) -> Iterator[Finding]:
    lifted = look.tracking.path.pen_up
    for index in look.tracking.jumps:
        up = lifted is not None and bool(lifted[index])
        yield Finding("jump", "good" if up else "warning", index - 1, index, look.time_of(index - 1))


def _most(kind: Literal["speed", "acceleration"], peaks: tuple[Peak, ...], look: _Look) -> Iterator[Finding]:
    """The joint that comes nearest to its limit."""
    known = [peak for peak in peaks if peak.limit is not None]
    if not known:
        return
    peak = max(known, key=lambda peak: peak.share)
    assert peak.limit is not None
    severity: Severity = "good" if peak.share <= _FULL else "bad"
    index = look.index_of(peak.time)
    yield Finding(
        kind, severity, index, index, peak.time, peak.value, peak.limit.value, joint=peak.joint,
        assumed=peak.limit.assumed,
    )  # fmt: skip


def _pace(look: _Look) -> Iterator[Finding]:
    """Whether the path takes longer than was asked for; no fault where it was eased, for then somebody has seen to it.

    The joint is the one that is nearest to a limit in the stretch that is the most behind.
    """
    if look.trajectory is None:
        return
    stretches = look.trajectory.stretches
    wished = sum(stretch.wanted for stretch in stretches)
    needed = sum(stretch.duration for stretch in stretches if stretch.wanted)
    if needed <= _IN_TIME * wished:
        return
    asked = [number for number, stretch in enumerate(stretches) if stretch.wanted]
    number = max(asked, key=lambda i: stretches[i].duration - stretches[i].wanted)
    time, joint = _tightest(look.tracking.robot, stretches[number])
    time += float(look.trajectory.starts[number])
    severity: Severity = "good" if any(stretch.eased for stretch in stretches) else "warning"
    index = look.index_of(time)
    yield Finding("pace", severity, index, index, time, needed, wished, joint=joint)


def _tightest(robot: Robot, stretch: Stretch) -> tuple[float, int]:
    """When [s] and which joint comes nearest to a limit of its own."""
    times = telling_times(stretch)
    moments = stretch.at(times)
    shares = np.maximum(np.abs(moments.qd) / speeds(robot), np.abs(moments.qdd) / accelerations(robot))
    moment, joint = np.unravel_index(np.argmax(shares), shares.shape)
    return float(times[moment]), int(joint)


def _singular(look: _Look) -> Iterator[Finding]:
    """On the path only: a motion of the joints, as that to the path, passes through singular poses unhindered."""
    rows = np.flatnonzero(look.on_path)
    if not len(rows):
        return
    share = look.sigma[:, -1] / np.maximum(look.sigma[:, 0], 1e-300)
    row = int(rows[np.argmin(share[rows])])
    severity: Severity = "good" if share[row] > _NEAR else "warning" if share[row] > _IN else "bad"
    index = look.index_at(row)
    yield Finding(
        "singular", severity, index, index, look.time_at(row), float(look.sigma[row, -1]), float(share[row]),
        family=_nearest_family(look.tracking.robot, look.q[row]) if severity != "good" else "",
    )  # fmt: skip


def _nearest_family(robot: Robot, q: FloatArray) -> str:
    """Of the task's families the one that is near, "" for none."""
    own = [family for family in singular_families(robot) if family.part == "pose"]
    nearest = min(own, key=lambda family: float(family.measure(q)), default=None)
    return nearest.name if nearest is not None and float(nearest.measure(q)) < _FAMILY_NEAR else ""


def _clear(look: _Look, clear: Clearance | None, table: float | None) -> Iterator[Finding]:
    if clear is None:
        return
    size = look.tracking.robot.size
    row = int(np.argmin(clear.table))
    if table is not None and np.isfinite(clear.table[row]):
        yield _distance("table", look, row, float(clear.table[row]), (int(clear.lowest[row]),), size)
    row = int(np.argmin(clear.own))
    if np.isfinite(clear.own[row]):
        yield _distance("own", look, row, float(clear.own[row]), tuple(clear.pair[row].tolist()), size)


def _distance(
    kind: Literal["table", "own"], look: _Look, row: int, value: float, links: tuple[int, ...], size: float
) -> Finding:
    severity: Severity = "bad" if value < -_ROUNDING * size else "warning" if value < _CLOSE * size else "good"
    index = look.index_at(row)
    return Finding(kind, severity, index, index, look.time_at(row), value, links=links)
