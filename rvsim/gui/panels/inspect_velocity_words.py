"""What the Velocity page says: which velocities an arm cannot do, and how near a singularity it is damped."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Kind, display, format_number
from rvsim.kinematics import jacobian
from rvsim.kinematics.rates import JointAccelerations, JointRates, row_scale
from rvsim.language import left_to_right, listed, tr, tr_later, trn
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

# The parts of a wish, of which all, a share or next to nothing is lost.
_MOVING = (
    tr_later("moving along {axis}"),
    tr_later("{percent} % of moving along {axis}"),
    tr_later("a little of moving along {axis}"),
)
_TURNING = (
    tr_later("turning about {axis}"),
    tr_later("{percent} % of turning about {axis}"),
    tr_later("a little of turning about {axis}"),
)


class _Sentences(NamedTuple):
    """What is said of a velocity, or of an acceleration: it can be, it would be too fast, it cannot be."""

    can: str
    race: str
    cannot: str


_OF_VELOCITY = _Sentences(
    tr_later("This arm can do that velocity: nothing is lost."),
    tr_later("This arm could do that velocity here, but its joints would have to race: below each box, what is left."),
    tr_later("This arm cannot do that velocity here."),
)
_OF_ACCELERATION = _Sentences(
    tr_later("This arm can do that acceleration: nothing is lost."),
    tr_later(
        "This arm could do that acceleration here, but its joints would have to race: below each box, what is left."
    ),
    tr_later("This arm cannot do that acceleration here."),
)
_SHARE = 0.2  # of what is lost: a part of the wish that has less to do with it is not named
_ALL = 0.95
_RANK_ABOVE = 1e-6


def speed_kinds(robot: Robot) -> tuple[Kind, Kind]:
    """Of a tool's linear and angular velocity."""
    return ("length_speed" if robot.length_unit == "millimetre" else "unit_speed"), "angle_speed"


def acceleration_kinds(robot: Robot) -> tuple[Kind, Kind]:
    """Of a tool's linear and angular acceleration."""
    return ("length_acceleration" if robot.length_unit == "millimetre" else "unit_acceleration"), "angle_acceleration"


def verdict(
    robot: Robot, wished: FloatArray, solution: JointRates | JointAccelerations, lost: FloatArray, *, in_range: bool
) -> str:
    """Whether the arm can do it, and which parts of the wish are lost; twists (6,) in the axes that are shown.

    This is source 004's test of the range, eq. (4.20), in words. `in_range`: whether the arm could, without damping.
    """
    sentences = _OF_VELOCITY if isinstance(solution, JointRates) else _OF_ACCELERATION
    if solution.feasible:
        return tr(sentences.can)
    if in_range:
        return tr(sentences.race)
    parts = culprits(robot, wished, lost)
    if not parts:
        return tr(sentences.cannot)
    if sentences is _OF_VELOCITY:
        return trn(
            "This arm cannot do that velocity here: {parts} is lost. Below each box: the nearest it can.",
            "This arm cannot do that velocity here: {parts} are lost. Below each box: the nearest it can.",
            len(parts),
            parts=listed(parts),
        )
    return trn(
        "This arm cannot do that acceleration here: {parts} is lost. Below each box: the nearest it can.",
        "This arm cannot do that acceleration here: {parts} are lost. Below each box: the nearest it can.",
        len(parts),
        parts=listed(parts),
    )


def culprits(robot: Robot, wished: FloatArray, lost: FloatArray) -> list[str]:
    """The parts of a wish (6,) that it is lost by: what is lost is square to what can be done, and is theirs alone."""
    rows = row_scale(robot.size) ** 2
    weights = wished * lost * rows
    total = float((lost * lost * rows).sum())
    found = np.flatnonzero(weights > _SHARE * max(total, 1e-300))
    return [_part(int(index), float(lost[index] / wished[index])) for index in found]


def _part(index: int, share: float) -> str:
    """A share of a part of a wish, which are counted from 0 to 5, in words."""
    whole, some, little = _MOVING if index < 3 else _TURNING
    axis = "xyz"[index % 3]
    if share > _ALL:
        return tr(whole, axis=axis)
    return tr(some, percent=f"{100.0 * share:.0f}", axis=axis) if share > 0.005 else tr(little, axis=axis)


class RankTest(NamedTuple):
    """The ranks of J and of [J | ζ]; lengths in sizes of the arm."""

    alone: int
    with_wish: int

    @property
    def in_range(self) -> bool:
        """Whether the arm can do the wish, however fast its joints would have to be."""
        return self.alone == self.with_wish

    @property
    def text(self) -> str:
        """As the source prints it."""
        sign = "=" if self.in_range else "<"
        ranks = left_to_right(f"rank J = {self.alone} {sign} rank [J | ζ] = {self.with_wish}")
        if self.in_range:
            return tr("{ranks}: ζ is in the range of J (source 004, eq. 4.20).", ranks=ranks)
        return tr("{ranks}: ζ is not in the range of J (source 004, eq. 4.20).", ranks=ranks)


def rank_test(robot: Robot, q: FloatArray, wished: FloatArray) -> RankTest:
    """Source 004's test of a wish (6,), base axes, eq. (4.20)."""
    rows = row_scale(robot.size)
    J = jacobian(robot, q) * rows[:, None]
    scale = max(float(np.linalg.norm(wished * rows)), 1e-12)
    augmented = np.concatenate([J, (wished * rows)[:, None] / scale], axis=1)
    return RankTest(*(int((np.linalg.svd(A, compute_uv=False) > _RANK_ABOVE).sum()) for A in (J, augmented)))


def damping_line(damping: float) -> str:
    """Said only where it is in use."""
    if not damping:
        return ""
    return tr("Damped, so near a singularity: λ = {damping:.2g}.", damping=damping)


def too_fast(robot: Robot, qd: FloatArray) -> str:
    """Which joints would have to be faster than they can."""
    names = [
        tr(joint.name)
        for joint, rate in zip(robot.joints, np.abs(qd).tolist(), strict=True)
        if joint.max_speed and rate > joint.max_speed.value * (1.0 + 1e-9)
    ]
    return tr("Faster than its top speed: {joints}.", joints=listed(names)) if names else ""


def arrow_texts(twist: FloatArray, kinds: tuple[Kind, Kind], preferences: Preferences) -> tuple[str, str]:
    """What stands beside the arrows."""
    v, w = (float(np.linalg.norm(part)) for part in (twist[:3], twist[3:]))
    return f"v {_amount(v, kinds[0], preferences)}", f"ω {_amount(w, kinds[1], preferences)}"


def _amount(value: float, kind: Kind, preferences: Preferences) -> str:
    shown = display(kind, preferences)
    return f"{format_number(float(value) * shown.factor, shown.decimals)}{shown.suffix}"
