"""Edits of the torque ratings: a copy of the arm whose drives may give more, or less."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

from rvsim.errors import RobotDefinitionError
from rvsim.language import tr, tr_later
from rvsim.robot.mass_edits import BY_HAND
from rvsim.robot.robot import Datum, Robot

RatingOrigin = Literal["source", "assumed", "yours"]
LEAST_RATING, LARGEST_RATING = 1e-6, 1e6  # [N m, N] that a robot file takes
GUESSED_TORQUE, GUESSED_FORCE = 10.0, 100.0  # [N m], [N]
_GUESSED = tr_later("a guess to start from: the same for every drive of its kind")


def rating_origin(rating: Datum) -> RatingOrigin:
    """Who says so: a source, nobody, or the user."""
    if rating.source == BY_HAND:
        return "yours"
    return "assumed" if rating.assumed else "source"


def with_max_torque(robot: Robot, joint: int, value: float | None) -> Robot:
    """A copy whose joint `joint` (from 0) has another torque rating [N m; N for a sliding joint], None for none.

    Raises:
        RobotDefinitionError: no drive has such a rating: 0, negative, not finite, or beyond what a robot file takes.
    """
    if value is None:
        return robot.with_joint(joint, max_torque=None)
    if not LEAST_RATING <= value <= LARGEST_RATING:
        rule = tr(
            "a torque rating is a number above 0, up to {most:,.0f}; {value:g} is none.",
            most=LARGEST_RATING,
            value=value,
        )
        raise RobotDefinitionError(robot.name, tr("joint {joint!r}: {rule}", joint=robot.joint_names[joint], rule=rule))
    return robot.with_joint(joint, max_torque=Datum(value, assumed=True, source=BY_HAND))


def with_guessed_ratings(robot: Robot) -> Robot:
    """A copy whose turning drives may give 10 N m each, its sliding ones 100 N: something to start from."""
    guesses = (GUESSED_TORQUE if joint.revolute else GUESSED_FORCE for joint in robot.joints)
    rated = zip(robot.joints, guesses, strict=True)
    return replace(robot, joints=tuple(replace(joint, max_torque=Datum(g, True, _GUESSED)) for joint, g in rated))
