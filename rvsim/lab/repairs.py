"""Repairs of a path that the arm cannot draw: each is tried before it is offered, so that what is offered works."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rvsim.errors import NoClosedFormError, RvsimError
from rvsim.experiment import Experiment, Placement
from rvsim.kinematics import inverse_kinematics_batch
from rvsim.lab.named_paths import line_of
from rvsim.lab.sentences import Units, length_number
from rvsim.lab.shape_paths import placed_task, placement_of, task_path
from rvsim.language import left_to_right, tr, tr_later, trn
from rvsim.motion import Path, Tracking, Trajectory, track, trajectory_of
from rvsim.motion.honesty import SEVERITIES, Report, check
from rvsim.motion.placement import Place, largest_in_place, nearest_place
from rvsim.motion.turns import JointRange, existing
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_SCALES_WHEN_MOVED = (0.75, 0.5, 0.25, 0.1, 0.03)
_WORTH = 0.98  # of the time, to be quicker
_LIFT = 0.05  # of the arm's size, along the tool's axis or up


@dataclass(frozen=True, eq=False)
class Offer:
    """A repair that works.

    Args:
        name: stable: "free", "move", "scale", "move and scale", "ignore limits", "branch", "split", "ease", "longer".
        title: for the button.
        tip: what it does and what came of trying it.
        tracking: what came of trying it.
        experiment: the state that leads there, None where only the tracking changes.
        lifts: the points before which the pen is lifted, where that is what changes.
    """

    name: str
    title: str
    tip: str
    tracking: Tracking
    experiment: Experiment | None
    lifts: tuple[int, ...] = ()


def path_of(kind: str, experiment: Experiment) -> Path:
    """The path of an experiment: "line" or "trajectory"."""
    if kind == "line":
        return line_of(experiment.robot, experiment.line, experiment.q)
    return task_path(experiment.robot, experiment.trajectory, experiment.q)


def repairs(kind: str, experiment: Experiment, report: Report, units: Units) -> Iterator[Offer | None]:
    """Offers, one after the other; None in between, where the search may be given up."""
    yield from _slower(experiment, report)
    try:
        if not report.tracking.complete:
            yield _free(kind, experiment, report)
            yield from _placed(kind, experiment, report, units)
            yield _ignoring(kind, experiment, report)
        yield _split(report)
        yield from _other_start(kind, experiment, report)
    except NoClosedFormError:
        return


# --- the orientation ---------------------------------------------------------------------------------------------


def _free(kind: str, experiment: Experiment, report: Report) -> Offer | None:
    tracking = report.tracking
    if tracking.path.rotations is None or all(point.kind == "reach" for point in tracking.unreached):
        return None
    freed = _with_task(kind, experiment, orientation="free")
    tried = _tried(kind, freed)
    if tried is None or tried.reached_count <= tracking.reached_count:
        return None
    title = tr("Free pitch") if experiment.robot.dof == 5 else tr("Free orientation")
    tip = tr("Let the tool tilt as it likes; every place is kept. {outcome}", outcome=_outcome(tried))
    return Offer("free", title, tip, tried, freed)


def _with_task(kind: str, experiment: Experiment, **changes: object) -> Experiment:
    if kind == "line":
        return replace(experiment, line=replace(experiment.line, **changes))  # type: ignore[arg-type]
    return replace(experiment, trajectory=replace(experiment.trajectory, **changes))  # type: ignore[arg-type]


def _tried(kind: str, experiment: Experiment) -> Tracking | None:
    try:
        path = path_of(kind, experiment)
    except (RvsimError, OSError):
        return None
    return track(experiment.robot, path, near=experiment.q, ignore_limits=experiment.ignore_limits)


def _outcome(tracking: Tracking) -> str:
    return f"{_outcome_clause(tracking)}."


def _outcome_clause(tracking: Tracking) -> str:
    clause = (
        trn("Tried: the one point is reached", "Tried: all {n} points are reached", tracking.samples)
        if tracking.complete
        else trn(
            "Tried: {reached} of {n} point is reached",
            "Tried: {reached} of {n} points are reached",
            tracking.samples,
            reached=tracking.reached_count,
        )
    )
    if not tracking.jumps:
        return clause
    return trn("{outcome}, with {n} jump", "{outcome}, with {n} jumps", len(tracking.jumps), outcome=clause)


def _ignoring(kind: str, experiment: Experiment, report: Report) -> Offer | None:
    tracking = report.tracking
    if tracking.ignore_limits or not any(point.kind == "limits" for point in tracking.unreached):
        return None
    beyond = replace(experiment, ignore_limits=True)
    tried = _tried(kind, beyond)
    if tried is None or tried.reached_count <= tracking.reached_count:
        return None
    tip = tr(
        "Go beyond the joint limits, as programs of the sources did; a real arm cannot. {outcome}",
        outcome=_outcome(tried),
    )
    return Offer("ignore limits", tr("Ignore limits"), tip, tried, beyond)


# --- the time ----------------------------------------------------------------------------------------------------


def _slower(experiment: Experiment, report: Report) -> Iterator[Offer | None]:
    """Where a joint cannot follow: slower there alone, or a time that it can keep."""
    behind = next((finding for finding in report.of("pace") if finding.severity != "good"), None)
    if behind is None:
        return
    slower = replace(experiment, ease=True)
    seconds = _path_seconds(report.tracking, slower)
    if seconds < _WORTH * behind.value:
        tip = tr(
            "Only where a joint needs it, not as a whole: the path takes {seconds:.2f} s instead of "
            "{now:.2f} s. Tried: no joint exceeds its speed or acceleration.",
            seconds=seconds,
            now=behind.value,
        )
        yield Offer("ease", tr("Slow down only there: {seconds:.2f} s", seconds=seconds), tip, report.tracking, slower)
    enough = math.ceil(100.0 * behind.value) / 100.0
    tip = tr(
        "Ask for the time that the joints need, instead of {asked:.2f} s. It moves as it does now.", asked=behind.limit
    )
    yield Offer(
        "longer",
        tr("Take {seconds:.2f} s", seconds=enough),
        tip,
        report.tracking,
        replace(experiment, path_seconds=enough),
    )


def _path_seconds(tracking: Tracking, experiment: Experiment) -> float:
    """How long the parts take that a time was asked for."""
    trajectory = motion_of(tracking, experiment)
    return sum(stretch.duration for stretch in trajectory.stretches if stretch.wanted) if trajectory else math.inf


def motion_of(tracking: Tracking, experiment: Experiment) -> Trajectory | None:
    """The motion from where the arm is, by the law and in the time that are asked for."""
    return trajectory_of(
        tracking, experiment.q, path_seconds=experiment.path_seconds, law=experiment.law, ease=experiment.ease
    )


# --- the place ---------------------------------------------------------------------------------------------------


def _placed(kind: str, experiment: Experiment, report: Report, units: Units) -> Iterator[Offer | None]:
    path, limits = report.tracking.path, report.tracking.ignore_limits
    searches = {
        "move": nearest_place(experiment.robot, path, near=experiment.q, ignore_limits=limits),
        "scale": largest_in_place(experiment.robot, path, near=experiment.q, ignore_limits=limits),
    }
    found = False
    for name, search in searches.items():
        for place in search:
            offer = place and _placement_offer(name, kind, experiment, path, place, units)
            found = found or offer is not None
            yield offer
    for scale in () if found else _SCALES_WHEN_MOVED:
        search = nearest_place(experiment.robot, path, near=experiment.q, ignore_limits=limits, scale=scale)
        for place in search:
            offer = place and _placement_offer("move and scale", kind, experiment, path, place, units)
            yield offer
            if offer:
                return


def _placement_offer(
    name: str, kind: str, experiment: Experiment, path: Path, place: Place, units: Units
) -> Offer | None:
    """Tried again as the experiment will have it: another place may have another orientation."""
    moved = _moved(kind, experiment, path, place)
    tried = _tried(kind, moved)
    if tried is None or not tried.complete or tried.jumps:
        return None
    title, what = _PLACEMENTS[name]
    vector = _vector(experiment.robot, place.center - path.middle, units)
    said = tr(title, vector=vector, scale=100.0 * place.scale)
    return Offer(name, said, f"{tr(what)} {_outcome(tried)}", tried, moved)


# The title of the button, and what it does.
_PLACEMENTS = {
    "move": (tr_later("Move by {vector}"), tr_later("The nearest place at which all of it is reached.")),
    "scale": (
        tr_later("Scale to {scale:.0f} %"),
        tr_later("The largest of a few scales at which all of it is reached where it is."),
    ),
    "move and scale": (
        tr_later("Move by {vector}, scale to {scale:.0f} %"),
        tr_later("The nearest place for it at that scale."),
    ),
}


def _moved(kind: str, experiment: Experiment, path: Path, place: Place) -> Experiment:
    middle = path.middle
    if kind == "line":
        line = experiment.line
        start, end = (place.center + place.scale * (point - middle) for point in (line.start, line.end))
        return replace(experiment, line=replace(line, start=start, end=end))
    task, robot = experiment.trajectory, experiment.robot
    before = placement_of(robot, task)
    # The middle of what is drawn need not be the point that the placement holds.
    center = place.center + place.scale * (before.center - middle)
    after = Placement(center, before.rpy, before.scale * place.scale)
    return replace(experiment, trajectory=placed_task(robot, task, after))


def _vector(robot: Robot, shift: FloatArray, units: Units) -> str:
    numbers = [length_number(robot, float(value), units) for value in shift]
    decimals = {"mm": 0, "m": 3}.get(numbers[0][1], 2)
    texts = (f"{round(value, decimals) + 0.0:.{decimals}f}".replace("-", "\u2212") for value, _ in numbers)
    listing = ", ".join(texts)
    return f"{left_to_right(f'({listing})')} {numbers[0][1]}"


# --- jumps -------------------------------------------------------------------------------------------------------


def _split(report: Report) -> Offer | None:
    """The pen is lifted before each jump and set down behind it."""
    tracking = report.tracking
    found = (finding.last for finding in report.of("jump") if finding.severity != "good")
    jumps = tuple(jump for jump in found if jump is not None)
    if not jumps:
        return None
    tried = track_lifted(tracking, jumps)
    up = tried.path.pen_up
    if up is None or tried.reached_count < tracking.reached_count or not all(up[jump] for jump in tried.jumps):
        return None
    title = trn("Lift the pen once", "Lift the pen {n} times", len(jumps))
    tip = tr("At each jump, and set it down behind it. {outcome}", outcome=_outcome(tried))
    return Offer("split", title, tip, tried, None, jumps)


def track_lifted(tracking: Tracking, lifts: Sequence[int]) -> Tracking:
    """The same path tracked with the pen lifted before each of these points, from the first one that is reached."""
    reached = tracking.q[tracking.reached]
    near = reached[0] if len(reached) else None
    return track(tracking.robot, lifted_at(tracking, lifts), near=near, ignore_limits=tracking.ignore_limits)


def lifted_at(tracking: Tracking, jumps: Sequence[int]) -> Path:
    """The path with two points more at each jump, above the point before it and above the one behind it, pen up."""
    path, n = tracking.path, tracking.samples
    up = np.zeros(n, dtype=bool) if path.pen_up is None else path.pen_up
    order = np.insert(np.arange(n), np.repeat(jumps, 2), np.ravel([(jump - 1, jump) for jump in jumps]))
    raised = np.insert(np.zeros(n, dtype=bool), np.repeat(jumps, 2), values=True)
    away = np.array([0.0, 0.0, 1.0]) if path.rotations is None else -path.rotations[order, :, 2]
    lift = _LIFT * tracking.robot.size * away
    points = path.points[order] + np.where(raised[:, None], lift, 0.0)
    behind = np.concatenate([[False], raised[:-1]])
    rotations = None if path.rotations is None else path.rotations[order]
    corners = _corners(path, order, raised)
    return replace(path, points=points, rotations=rotations, pen_up=up[order] | raised | behind, known_corners=corners)


def _corners(path: Path, order: NDArray[np.intp], raised: NDArray[np.bool_]) -> NDArray[np.intp]:
    """The old ones where they are now, and all about the lifts."""
    about = raised | np.append(raised[1:], False) | np.append(False, raised[:-1])
    inner = np.arange(1, len(order) - 1)
    return np.asarray(inner[(np.isin(order, path.corners) | about)[1:-1]])


# --- the branch --------------------------------------------------------------------------------------------------


def _other_start(kind: str, experiment: Experiment, report: Report) -> Iterator[Offer | None]:
    """Of the other branches at the first point the one from which the path looks best, if better than now."""
    tracking = report.tracking
    if not tracking.complete or report.severity == "good":
        return
    best, best_rank = None, _rank(report)
    for start in _starts(tracking):
        yield None
        moved = experiment.at(start)
        tried = _tried(kind, moved)
        if tried is None or not tried.complete or len(tried.jumps) > len(tracking.jumps):
            continue
        rank = _rank(check(tried, motion_of(tried, moved)))
        if rank < best_rank:
            best, best_rank = (
                Offer("branch", tr("Start on another branch"), _branch_tip(tried, rank), tried, moved),
                rank,
            )
    yield best


def _rank(report: Report) -> tuple[int, int]:
    """How many bad findings, and how many warnings."""
    worst, warning, _ = (sum(f.severity == severity for f in report.findings) for severity in SEVERITIES)
    return worst, warning


def _branch_tip(tried: Tracking, rank: tuple[int, int]) -> str:
    what = tr("Put the arm into another branch at the first point, and track from there.")
    outcome = _outcome_clause(tried)
    if rank == (0, 0):
        return f"{what} {tr('{outcome}; nothing is left to warn of.', outcome=outcome)}"
    left = trn("{outcome}; {n} finding left.", "{outcome}; {n} findings left.", sum(rank), outcome=outcome)
    return f"{what} {left}"


def _starts(tracking: Tracking) -> FloatArray:
    """(b, n) the branches at the first point within the limits."""
    robot, path = tracking.robot, tracking.path
    if path.rotations is None and robot.dof > 3:
        return np.empty((0, robot.dof))
    joints = JointRange.of(robot, tracking.ignore_limits)
    q = inverse_kinematics_batch(robot, path.part(slice(0, 1)).poses())[0]
    q = joints.nearest_copy(q[existing(q)], tracking.q[0])
    return np.asarray(q[~np.any(joints.outside(q) > 0.0, axis=1)])
