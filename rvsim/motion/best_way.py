"""The best way to a pose: of all branches and time laws the quickest, or the least motion (source 000's future work).

A joint's nearest copy within its limits is both the quickest and the least motion to that angle, whatever the other
joints do: of the copies q + 2πk of a branch no other needs to be tried.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from rvsim.kinematics import forward_kinematics, inverse_kinematics
from rvsim.kinematics.clearance import clearance
from rvsim.kinematics.inverse import limit_margins
from rvsim.motion.laws import Limits, PiecewisePolynomial, jerk_limited
from rvsim.motion.sequence import motion_weights
from rvsim.motion.trajectory import Stretch, Trajectory, accelerations, joint_move, speeds
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray, frozen_array

MoveLaw = Literal["jerk-limited", "trapezoid", "quintic"]
MOVE_LAWS: tuple[MoveLaw, ...] = ("jerk-limited", "trapezoid", "quintic")
Criterion = Literal["quickest", "least motion"]
CRITERIA: tuple[Criterion, ...] = ("quickest", "least motion")

# No robot file knows a jerk: the acceleration is taken to build up in this time [s], and to be reached in as much more
# where it is not known either.
_BUILD_UP, _SPEED_UP = 0.1, 0.5
_KNOTS = 201
_SEEN = 61  # moments at which the clearance is asked for
_LINEAR = PiecewisePolynomial(np.array([0.0, 1.0]), np.array([[[0.0], [1.0]]]))


@dataclass(frozen=True, eq=False)
class Way:
    """One way to the pose.

    Args:
        label: of the branch.
        q: (n,) where it ends [rad, m].
        moves: the motion by each law, none where the branch is not within the limits.
        motion: the length of the way in joint space [rad; a slide across the whole arm counts as half a turn].
        margin: the least distance to a limit at the end, of joints that have some [rad, m]; negative outside.
        margin_joint: that joint's index, None where no joint has limits.
        table, own: the least clearance on the way from the table and from itself [m].
    """

    label: str
    q: FloatArray
    moves: dict[MoveLaw, Trajectory]
    motion: float
    margin: float
    margin_joint: int | None
    table: float
    own: float

    @property
    def possible(self) -> bool:
        """Whether the branch is within the limits."""
        return bool(self.moves)

    @property
    def clear(self) -> bool:
        """Whether the arm meets neither the table nor itself on the way."""
        return self.table >= 0.0 and self.own >= 0.0

    @property
    def law(self) -> MoveLaw:
        """The quickest law."""
        return min(self.moves, key=lambda law: self.moves[law].duration, default="quintic")

    @property
    def seconds(self) -> float:
        """Of the quickest law; inf where the branch is not possible."""
        return self.moves[self.law].duration if self.moves else math.inf


def best_ways(
    robot: Robot, start: ArrayLike, target: ArrayLike, criterion: Criterion = "quickest", *, ignore_limits: bool = False
) -> tuple[Way, ...]:
    """All ways from the pose `start` (n,) to the tool pose `target` (4, 4), the best first, impossible ones last.

    Ways on which the arm would meet the table or itself come after those that are clear.

    Raises:
        NoClosedFormError: the arm has no closed form.
    """
    begin = frozen_array("start", start, (robot.dof,))
    branches = inverse_kinematics(robot, target, near=begin).branches
    ways = [_way(robot, begin, b.q, b.label, b.within_limits or ignore_limits) for b in branches]
    return ranked(ways, criterion)


def best_ways_to(
    robot: Robot, start: ArrayLike, q: ArrayLike, criterion: Criterion = "quickest", *, ignore_limits: bool = False
) -> tuple[Way, ...]:
    """The same to where the tool is in the pose q (n,)."""
    return best_ways(robot, start, forward_kinematics(robot, q), criterion, ignore_limits=ignore_limits)


def ranked(ways: Sequence[Way], criterion: Criterion) -> tuple[Way, ...]:
    """The best first."""

    def rank(way: Way) -> tuple[bool, bool, float]:
        return not way.possible, not way.clear, way.seconds if criterion == "quickest" else way.motion

    return tuple(sorted(ways, key=rank))


def _way(robot: Robot, start: FloatArray, end: FloatArray, label: str, possible: bool) -> Way:
    margins = limit_margins(robot, end)
    joint = int(np.argmin(margins)) if np.isfinite(margins).any() else None
    moves = _moves(robot, start, end) if possible else {}
    even = np.linspace(0.0, 1.0, _SEEN)
    # Two laws go straight in joint space, the jerk-limited one does not.
    ways = [start + even[:, None] * (end - start), *(move.q(even * move.duration) for move in list(moves.values())[:1])]
    clear = clearance(robot, np.concatenate(ways))
    return Way(
        label,
        frozen_array("q", end, (robot.dof,)),
        moves,
        float(np.linalg.norm(motion_weights(robot) * (end - start))),
        math.inf if joint is None else float(margins[joint]),
        joint,
        float(clear.table.min()),
        float(clear.own.min()),
    )


def _moves(robot: Robot, start: FloatArray, end: FloatArray) -> dict[MoveLaw, Trajectory]:
    """As quick as the joints may, by each law."""
    return {
        "jerk-limited": _jerk_limited(robot, start, end),
        "trapezoid": joint_move(robot, start, end, seconds=0.0, law="trapezoid"),
        "quintic": joint_move(robot, start, end, seconds=0.0),
    }


def _jerk_limited(robot: Robot, start: FloatArray, end: FloatArray) -> Trajectory:
    """Each joint by a profile of its own, all arriving together; as a spline through many of its poses."""
    speed, acceleration = speeds(robot), accelerations(robot)
    acceleration = np.where(np.isfinite(acceleration), acceleration, speed / _SPEED_UP)
    found = jerk_limited(0.0, start, end, Limits(speed, acceleration, acceleration / _BUILD_UP))
    knots = np.linspace(0.0, 1.0, _KNOTS)
    q = found.at(knots * found.duration).q
    q[0], q[-1] = start, end
    return Trajectory((Stretch(found.duration, knots, q, np.zeros(_KNOTS), "path", _LINEAR),))
