"""What the Forces page says: the formula with its numbers, the largest force, what a rating is."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from rvsim.dynamics import LargestForce
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import format_quantity, moment_kind, torque_kind
from rvsim.lab.worked import Equation
from rvsim.language import listed, tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.robot.rating_edits import RatingOrigin, rating_origin

DIRECTIONS: Mapping[str, str] = {
    "wrench": tr_later("the wrench above"),
    "+x": "+x", "-x": "\u2212x", "+y": "+y", "-y": "\u2212y", "+z": "+z", "-z": "\u2212z",
}  # fmt: skip
AXES: Mapping[str, str] = {"base": tr_later("in base axes"), "tool": tr_later("in tool axes")}
HANGING = tr_later(
    "The payload pulls down at the tool; to hold it the tool pushes up with m g, which is added to F in τ = Jᵀ F below."
)
# What is said of a limit, by the origin of the rating: that it is reached already, with and without what is held
# besides, and the force that reaches it.
_AT_LIMIT: Mapping[RatingOrigin, str] = {
    "source": tr_later("None: {joint} is at its {limit} already."),
    "assumed": tr_later("None: {joint} is at its {limit} already, an assumed rating."),
    "yours": tr_later("None: {joint} is at its {limit} already, your rating."),
}
_AT_LIMIT_WITH: Mapping[RatingOrigin, str] = {
    "source": tr_later("None: {joint} is at its {limit} already with {besides}."),
    "assumed": tr_later("None: {joint} is at its {limit} already with {besides}, an assumed rating."),
    "yours": tr_later("None: {joint} is at its {limit} already with {besides}, your rating."),
}
_REACHES: Mapping[RatingOrigin, str] = {
    "source": tr_later("{force}: then {joint} reaches its {limit}."),
    "assumed": tr_later("{force}: then {joint} reaches its {limit}, an assumed rating."),
    "yours": tr_later("{force}: then {joint} reaches its {limit}, your rating."),
}
_SHARES: Mapping[RatingOrigin, str] = {
    "source": tr_later("{joint}: {torque}, {share} of {rating} ({source})."),
    "assumed": tr_later("{joint}: {torque}, {share} of {rating} (assumed: {source})."),
    "yours": tr_later("{joint}: {torque}, {share} of {rating} (yours, {source})."),
}
_DECIMALS = 2
_UNIT_VECTORS = dict(zip("xyz", np.eye(3), strict=True))


class TorqueRow(NamedTuple):
    """One joint of the table [N m, N]; rating nan and no origin where none is known."""

    name: str
    color: str
    from_wrench: float
    from_weight: float
    rating: float
    origin: RatingOrigin | None
    rating_source: str

    @property
    def total(self) -> float:
        """What the drive has to give."""
        return self.from_wrench + self.from_weight

    @property
    def rating_assumed(self) -> bool:
        """Whether nobody answers for the rating."""
        return self.origin == "assumed"

    @property
    def share(self) -> float:
        """Of the rating, with the torque's sign; nan where none is known."""
        return self.total / self.rating


def torque_rows(robot: Robot, from_wrench: FloatArray, from_weight: FloatArray) -> tuple[TorqueRow, ...]:
    """One row a joint."""
    rows = []
    for joint, pushed, held in zip(robot.joints, from_wrench.tolist(), from_weight.tolist(), strict=True):
        known = joint.max_torque
        rating = (known.value, rating_origin(known), known.source) if known else (math.nan, None, "")
        rows.append(TorqueRow(joint.name, joint.color, pushed, held, *rating))
    return tuple(rows)


def ratings(robot: Robot) -> FloatArray:
    """(n,) the torque each drive may give [N m, N]; inf where nobody says."""
    return np.array([joint.max_torque.value if joint.max_torque else math.inf for joint in robot.joints])


def direction_vector(name: str, wrench: FloatArray) -> FloatArray | None:
    """(6,) the direction of that name in the axes of the wrench (6,); None where the wrench is none."""
    if name == "wrench":
        return wrench if np.any(wrench) else None
    sign = 1.0 if name[0] == "+" else -1.0
    return np.concatenate([sign * _UNIT_VECTORS[name[1]], np.zeros(3)])


def besides_text(payload: float, own_weight: bool, preferences: Preferences) -> str:
    """What the drives hold while the tool pushes, "" for nothing else."""
    mass = format_quantity(payload, "mass", preferences)
    held = [tr("the payload of {mass}", mass=mass)] * (payload > 0.0)
    return listed([*held, *[tr("the arm's own weight")] * own_weight])


def counted_text(payload: float, own_weight: bool, preferences: Preferences) -> str:
    """That the same is counted in, as a sentence."""
    mass = format_quantity(payload, "mass", preferences)
    if payload > 0.0 and own_weight:
        return tr("The payload of {mass} and the arm's own weight counted in.", mass=mass)
    if payload > 0.0:
        return tr("The payload of {mass} counted in.", mass=mass)
    return tr("The arm's own weight counted in.") if own_weight else ""


def largest_text(
    robot: Robot,
    found: LargestForce | None,
    pure_moment: bool,
    preferences: Preferences,
    besides: str = "",
    counted: str = "",
) -> str:
    """The answer to "how strongly can it push that way?", while it holds `besides`, or as a sentence `counted`."""
    if found is None:
        return tr("There is no wrench above: enter one, or choose a direction.")
    if found.joint is None:
        known = [joint.max_torque for joint in robot.joints if joint.max_torque]
        if not known:
            return tr("No joint of this arm has a torque rating: enter some below.")
        return tr("No bound: at this pose no rated joint has a lever in that direction, the bearings hold it all.")
    joint = robot.joints[found.joint]
    rating = joint.max_torque
    assert rating is not None, "only a rated joint limits"
    limit = format_quantity(rating.value, torque_kind(robot, found.joint), preferences)
    name, origin = f"J{found.joint + 1} {tr(joint.name)}", rating_origin(rating)
    if found.force == 0.0:
        if besides:
            return tr(_AT_LIMIT_WITH[origin], joint=name, limit=limit, besides=besides)
        return tr(_AT_LIMIT[origin], joint=name, limit=limit)
    force = format_quantity(found.force, moment_kind(robot) if pure_moment else "force", preferences)
    return f"{tr(_REACHES[origin], force=force, joint=name, limit=limit)} {counted}".rstrip()


def rating_text(row: TorqueRow, robot: Robot, joint: int, preferences: Preferences) -> str:
    """A row in a sentence."""
    kind = torque_kind(robot, joint)
    name, torque = f"J{joint + 1} {tr(row.name)}", format_quantity(row.total, kind, preferences)
    if math.isnan(row.rating) or row.origin is None:
        return tr("{joint}: {torque}. No rating is known.", joint=name, torque=torque)
    return tr(
        _SHARES[row.origin],
        joint=name,
        torque=torque,
        share=share_text(row),
        rating=format_quantity(row.rating, kind, preferences),
        source=tr(row.rating_source) or tr("robot file"),
    )


def share_text(row: TorqueRow) -> str:
    """37 %, or ≈ 37 % of an assumed rating, or a dash."""
    if math.isnan(row.share):
        return "\u2013"
    text = f"{100.0 * abs(row.share):.0f} %"
    return f"≈ {text}" if row.rating_assumed else text


def legend(rows: tuple[TorqueRow, ...]) -> str:
    """What the bars mean."""
    parts = []
    if any(not math.isnan(row.rating) for row in rows):
        parts.append(tr("Bar: share of the rating, left negative, right positive."))
    if any(row.rating_assumed for row in rows):
        parts.append(tr("≈ and a dashed frame: the rating is assumed."))
    if any(math.isnan(row.rating) for row in rows):
        parts.append(tr("\u2013: no rating is known."))
    return " ".join(parts)


def torque_equations(J: FloatArray, wrench: FloatArray, torques: FloatArray) -> tuple[Equation, ...]:
    """τ = JᵀF with the numbers of the pose: J (6, n), wrench (6,), torques (n,), SI."""
    numbers = f"{_matrix(J.T, 1)} {_matrix(wrench[:, None], 3)}"
    return (Equation("\\tau", "J^T F", numbers, _matrix(torques[:, None], 3)),)


def _matrix(values: FloatArray, whole: int) -> str:
    rows = [" & ".join(_entry(value, whole) for value in row) for row in values.tolist()]
    return "\\begin{bmatrix} " + " \\\\ ".join(rows) + " \\end{bmatrix}"


def _entry(value: float, whole: int) -> str:
    """A number with places for its sign and for so many digits, so that other numbers have the same shape."""
    text = f"{abs(value):.{_DECIMALS}f}"
    sign = "{-}" if value < 0.0 and float(text) != 0.0 else "\\phantom{-}"
    return sign + "\\phantom{0}" * (whole - text.index(".")) + text
