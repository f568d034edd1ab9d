"""What came of tracking, as sentences about the arm: how many points, which not, why, and what would help."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

from rvsim.kinematics import Failure
from rvsim.kinematics.inverse.explain import DEGREES, METRES, MILLIMETRES, RADIANS, explain
from rvsim.language import left_to_right, tr, tr_later, trn
from rvsim.motion import Tracking, Unreached
from rvsim.robot import Robot
from rvsim.units import degrees_from_radians, millimetres_from_metres

MINUS = "\u2212"


@dataclass(frozen=True)
class Units:
    """What the sentences say angles and lengths in; an arm without a unit of length keeps its own."""

    angle: Literal["deg", "rad"] = "deg"
    length: Literal["mm", "m"] = "mm"


_DEFAULT = Units()
_FEWEST_JOINTS_TO_TURN = 4
_SCALES = {"deg": DEGREES, "rad": RADIANS, "mm": MILLIMETRES, "m": METRES}


def failure_sentence(failure: Failure, units: Units = _DEFAULT) -> str:
    """Why an inverse problem has no solution; in degrees and millimetres this is its `reason`."""
    return explain(failure, _SCALES[units.angle], _SCALES[units.length])


def angle_text(angle: float, units: Units = _DEFAULT) -> str:
    """An angle [rad] for a sentence."""
    return _SCALES[units.angle].text(angle)


def tracking_sentence(tracking: Tracking, units: Units = _DEFAULT) -> str:
    """All of it: "4 of 11 points reached within the limits; 7 not: points 1–6: the elbow needs −156.7° … −116.9° and
    stops at −110°; point 11: the wrist pitch needs −94.7°, stops at −90°."."""
    missed = tracking.samples - tracking.reached_count
    if not missed:
        return short_sentence(tracking)
    count, groups = _count_clause(tracking), _groups(tracking.unreached)
    if missed == tracking.samples and len(groups) == 1:
        return f"{count}: {stretch_reason(tracking.robot, groups[0], units)}."
    why = tr("; ").join(reasons(tracking, units))
    return tr("{count}; {missed} not: {why}.", count=count, missed=missed, why=why)


def short_sentence(tracking: Tracking) -> str:
    """How many points were reached: "4 of 11 points reached within the limits."."""
    return f"{_count_clause(tracking)}."


def _count_clause(tracking: Tracking) -> str:
    samples, within = tracking.samples, tr(_WITHIN[tracking.ignore_limits])
    if tracking.complete:
        count = trn("The one point reached {within}", "All {n} points reached {within}", samples, within=within)
    elif tracking.reached_count:
        count = trn(
            "{reached} of {n} point reached {within}",
            "{reached} of {n} points reached {within}",
            samples,
            reached=tracking.reached_count,
            within=within,
        )
    else:
        count = trn("None of {n} point reached {within}", "None of {n} points reached {within}", samples, within=within)
    if not tracking.jumps:
        return count
    return trn(
        "{count}, with a change of branch on the way",
        "{count}, with {n} changes of branch on the way",
        len(tracking.jumps),
        count=count,
    )


_WITHIN = {True: tr_later("without regard to the limits"), False: tr_later("within the limits")}


def reasons(tracking: Tracking, units: Units = _DEFAULT) -> tuple[str, ...]:
    """One clause for each stretch of points that failed for the same reason; points are counted from 1."""
    groups = _groups(tracking.unreached)
    return tuple(f"{_which(group)}: {stretch_reason(tracking.robot, group, units)}" for group in groups)


def first_reason(tracking: Tracking, units: Units = _DEFAULT) -> str:
    """Why the first points that failed did so, as a clause."""
    return stretch_reason(tracking.robot, _groups(tracking.unreached)[0], units)


def deviation_sentence(tracking: Tracking, units: Units = _DEFAULT) -> str:
    """RMS and largest deviation over the reached points, and what the solving took."""
    if tracking.rms is None or tracking.max_deviation is None:
        return tr("No point was reached: there is no deviation to tell.")
    over = (
        tr("all points")
        if tracking.complete
        else trn("the {n} point reached", "the {n} points reached", tracking.reached_count)
    )
    rms, largest = (length_error(tracking.robot, error, units) for error in (tracking.rms, tracking.max_deviation))
    milliseconds = 1e3 * tracking.solve_seconds
    return tr(
        "RMS {rms} over {over}, largest {largest}; solved in {milliseconds:.1f} ms.",
        rms=rms,
        over=over,
        largest=largest,
        milliseconds=milliseconds,
    )


def advice_sentence(tracking: Tracking) -> str:
    """What would help, "" where everything was reached."""
    kinds = {point.kind for point in tracking.unreached}
    if not kinds:
        return ""
    turns = tracking.path.rotations is not None and tracking.robot.dof >= _FEWEST_JOINTS_TO_TURN
    free = tr("leave the orientation free") if tracking.robot.dof != 5 else tr("leave the pitch free")
    *others, last = [
        *([free] if turns and kinds & {"orientation", "limits"} else []),
        *([tr("ignore the limits")] if "limits" in kinds else []),
        tr("move the path nearer to where the arm can work") if "reach" in kinds else tr("move the path"),
    ]
    text = tr("{others}, or {last}.", others=tr(", ").join(others), last=last) if others else f"{last}."
    return f"{text[0].upper()}{text[1:]}"


def joint_amount(robot: Robot, joint: str, value: float, units: Units = _DEFAULT) -> str:
    """A joint's value [rad, m] for the eye: "−156.7°", "12.5 mm", "1.5 units"."""
    if not robot.is_revolute[robot.joint_names.index(joint)]:
        return _amount(value, _length_unit(robot, units))
    return f"{_plain(degrees_from_radians(value))}°" if units.angle == "deg" else f"{_plain(value, decimals=3)} rad"


def length_error(robot: Robot, error: float, units: Units = _DEFAULT) -> str:
    """A deviation [m] in scientific notation, never rounded to 0."""
    value, unit = length_number(robot, error, units)
    return f"{value:.1e} {unit}".replace("-", MINUS)


def length_number(robot: Robot, length: float, units: Units = _DEFAULT) -> tuple[float, str]:
    """A length [m] as a number and its unit."""
    unit = _length_unit(robot, units)
    return millimetres_from_metres(length) if unit == "mm" else length, unit


def _length_unit(robot: Robot, units: Units) -> str:
    return tr("units") if robot.length_unit == "unit" else units.length


def _amount(length: float, unit: str) -> str:
    value, decimals = {"mm": (millimetres_from_metres(length), 1), "m": (length, 4)}.get(unit, (length, 3))
    return f"{left_to_right(_plain(value, decimals))} {unit}"


def _plain(value: float, decimals: int = 1) -> str:
    text = f"{round(value, decimals) + 0.0:.{decimals}f}"
    return text.rstrip("0").rstrip(".").replace("-", MINUS)


def _groups(unreached: Iterable[Unreached]) -> list[list[Unreached]]:
    """Neighbours that failed for the same reason, at the same stop."""
    points = list(unreached)
    groups = [[point] for point in points[:1]]
    for before, after in pairwise(points):
        if after.index == before.index + 1 and _cause(after) == _cause(before):
            groups[-1].append(after)
        else:
            groups.append([after])
    return groups


def _cause(point: Unreached) -> tuple[str, str | None, float | None]:
    return point.kind, point.joint, point.limit


def _which(group: list[Unreached]) -> str:
    first, last = group[0].index + 1, group[-1].index + 1
    return (
        tr("point {number}", number=first) if first == last else tr("points {begin}\u2013{end}", begin=first, end=last)
    )


def stretch_reason(robot: Robot, group: list[Unreached], units: Units) -> str:
    """Why neighbouring points were missed that failed for the same reason, as a clause."""
    point = group[0]
    if point.kind == "reach":
        return tr("out of reach in any orientation")
    if point.kind == "orientation" or point.joint is None or point.value is None or point.limit is None:
        return tr("in reach, but not in this orientation")
    limit = point.limit
    needed = sorted((p.value for p in group if p.value is not None), key=lambda value: -abs(value - limit))
    most, least = (joint_amount(robot, point.joint, value, units) for value in (needed[0], needed[-1]))
    stop = joint_amount(robot, point.joint, limit, units)
    if most == least:
        return tr("{joint} needs {most}, stops at {stop}", joint=joint_words(point.joint), most=most, stop=stop)
    return tr(
        "{joint} needs {most} … {least} and stops at {stop}",
        joint=joint_words(point.joint),
        most=most,
        least=least,
        stop=stop,
    )


def joint_words(name: str) -> str:
    """A joint in a sentence: with an article where its name is a word, "the elbow", but "theta2"."""
    return tr("the {joint}", joint=tr(name)) if name.replace(" ", "").isalpha() else tr(name)
