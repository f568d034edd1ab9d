"""What the Velocity page says: which velocities an arm cannot do, and how near a singularity it is damped."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Kind, display, format_number
from rvsim.kinematics import jacobian
from rvsim.kinematics.rates import JointAccelerations, JointRates, row_scale
from rvsim.language import tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

PARTS = tuple(f"{what} {axis}" for what in (tr_later("moving along"), tr_later("turning about")) for axis in "xyz")
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
    what = "velocity" if isinstance(solution, JointRates) else "acceleration"
    if solution.feasible:
        return tr("This arm can do that {what}: nothing is lost.", what=what)
    if in_range:
        return tr(
            "This arm could do that {what} here, but its joints would have to race: below each box, what is left.",
            what=what,
        )
    parts = culprits(robot, wished, lost)
    if not parts:
        return tr("This arm cannot do that {what} here.", what=what)
    verb = "is" if len(parts) == 1 else "are"
    return tr(
        "This arm cannot do that {what} here: {listed} {verb} lost. Below each box: the nearest it can.",
        what=what,
        listed=_listed(parts),
        verb=verb,
    )


def culprits(robot: Robot, wished: FloatArray, lost: FloatArray) -> list[str]:
    """The parts of a wish (6,) that it is lost by: what is lost is square to what can be done, and is theirs alone."""
    rows = row_scale(robot.size) ** 2
    weights = wished * lost * rows
    total = float((lost * lost * rows).sum())
    found = []
    for index in np.argsort(-weights, kind="stable").tolist():
        if weights[index] > _SHARE * max(total, 1e-300):
            share = lost[index] / wished[index]
            part = f"{100.0 * share:.0f} % of " if share > 0.005 else tr("a little of ")
            found.append((index, PARTS[index] if share > _ALL else part + PARTS[index]))
    return [text for _, text in sorted(found)]


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
        sign, verdict = ("=", "in") if self.in_range else ("<", tr("not in"))
        ranks = tr(
            "rank J = {alone} {sign} rank [J | ζ] = {with_wish}", alone=self.alone, sign=sign, with_wish=self.with_wish
        )
        return tr("{ranks}: ζ is {verdict} the range of J (source 004, eq. 4.20).", ranks=ranks, verdict=verdict)


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
        joint.name
        for joint, rate in zip(robot.joints, np.abs(qd).tolist(), strict=True)
        if joint.max_speed and rate > joint.max_speed.value * (1.0 + 1e-9)
    ]
    return tr("Faster than its top speed: {listed}.", listed=_listed(names)) if names else ""


def arrow_texts(twist: FloatArray, kinds: tuple[Kind, Kind], preferences: Preferences) -> tuple[str, str]:
    """What stands beside the arrows."""
    v, w = (float(np.linalg.norm(part)) for part in (twist[:3], twist[3:]))
    return f"v {_amount(v, kinds[0], preferences)}", f"ω {_amount(w, kinds[1], preferences)}"


def _amount(value: float, kind: Kind, preferences: Preferences) -> str:
    shown = display(kind, preferences)
    return f"{format_number(float(value) * shown.factor, shown.decimals)}{shown.suffix}"


def _listed(parts: list[str]) -> str:
    return parts[0] if len(parts) == 1 else tr("{parts} and {parts2}", parts=", ".join(parts[:-1]), parts2=parts[-1])
