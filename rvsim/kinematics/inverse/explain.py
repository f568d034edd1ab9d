"""Failures in sentences a student can act on, in the units of whoever asks."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from rvsim.kinematics.inverse.copies import LIMIT_TOLERANCE
from rvsim.kinematics.inverse.words import branch_title
from rvsim.language import tr, trn
from rvsim.robot import Joint

if TYPE_CHECKING:
    from rvsim.kinematics.inverse.result import Failure

_FINEST = 9  # decimals; numbers that agree so far are the same


class Scale(NamedTuple):
    """How a sentence writes one kind of number: factor · SI value, with fixed decimals and a suffix."""

    factor: float
    decimals: int
    suffix: str

    def text(self, value: float) -> str:
        """An SI value for a sentence."""
        return self._text(value, self.decimals)

    def apart(self, value: float, other: float) -> tuple[str, str]:
        """Two SI values, with as many decimals as it takes to tell them apart: not "needs 90.0°, stops at 90.0°"."""
        finer = ((self._text(value, d), self._text(other, d)) for d in range(self.decimals, _FINEST + 1))
        return next((pair for pair in finer if pair[0] != pair[1]), (self.text(value), self.text(other)))

    def _text(self, value: float, decimals: int) -> str:
        number = round(self.factor * value, decimals) + 0.0  # −0.0 becomes 0.0
        text = f"{number:.{decimals}f}".replace("-", "−")
        return tr("{number} units", number=text) if self.suffix == " units" else text + self.suffix


DEGREES, RADIANS = Scale(180.0 / math.pi, 1, "°"), Scale(1.0, 3, " rad")
MILLIMETRES, METRES, OWN_UNITS = Scale(1e3, 1, " mm"), Scale(1.0, 4, " m"), Scale(1.0, 3, " units")


def explain(failure: Failure, angle: Scale = DEGREES, length: Scale = MILLIMETRES) -> str:
    """Why not, in one sentence. An arm without a unit of length keeps its own."""
    own = length if failure.robot.length_unit == "millimetre" else OWN_UNITS
    if failure.kind == "limits":
        return _explain_limits(failure, angle, own)
    if failure.kind == "orientation":
        turn, _ = angle.apart(failure.nearest.rotation_error, 0.0)
        return tr(
            "The place can be reached, but not in this orientation: the nearest there is turned by {turn}.", turn=turn
        )
    away, _ = own.apart(failure.nearest.position_error, 0.0)
    return tr("The place is out of reach: the nearest the tool gets is {away} away.", away=away)


def _explain_limits(failure: Failure, angle: Scale, length: Scale) -> str:
    branch, count = failure.branch, failure.count
    assert branch is not None, "limits are broken by a branch"
    broken = [
        _explain_joint(joint, value, angle if joint.revolute else length)
        for joint, value, margin in zip(
            failure.robot.joints, branch.q.tolist(), branch.limit_margin.tolist(), strict=True
        )
        if margin < -LIMIT_TOLERANCE
    ]
    return trn(
        "The only branch is outside the limits; nearest is “{branch}”: {broken}.",
        "All {n} branches are outside the limits; nearest is “{branch}”: {broken}.",
        count,
        branch=branch_title(branch.label),
        broken=tr("; ").join(broken),
    )


def _explain_joint(joint: Joint, value: float, scale: Scale) -> str:
    needed, stop = scale.apart(value, broken_limit(joint, value))
    return tr("{joint} needs {needed}, stops at {stop}", joint=tr(joint.name), needed=needed, stop=stop)


def broken_limit(joint: Joint, value: float) -> float:
    """The limit a value breaks."""
    return joint.lower if value < joint.lower else joint.upper
