"""The limits of an arm while those of its servos count too, and the arm's own, which it gets back afterwards."""

from __future__ import annotations

import numpy as np

from rvsim.errors import RobotDefinitionError
from rvsim.experiment import LimitViolation
from rvsim.language import tr
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.robot.servos import within_servos


class ServoLimits:
    """Remembers what an arm's limits and home were before the servos narrowed them.

    Args:
        robot: the arm with its own limits.
    """

    def __init__(self, robot: Robot) -> None:
        self._own = _ends(robot)

    def alone(self, robot: Robot) -> Robot:
        """The arm with its own limits and home; what somebody has set since it was narrowed stays as it was set."""
        if robot.dof != len(self._own):  # another arm
            return robot
        own = _with_ends(robot, self._own)
        try:
            narrowed = _ends(within_servos(own))
        except RobotDefinitionError:  # nothing was narrowed to that
            return own
        ends = _ends(robot)
        return _with_ends(robot, np.where(ends == narrowed, self._own, ends))

    def holds(self, robot: Robot, violation: LimitViolation) -> bool:
        """Whether it is the servo that does not reach there: the limit is not the arm's own."""
        return violation.limit not in self.alone(robot).limits[violation.joint]

    def narrow(self, robot: Robot) -> Robot:
        """The arm with the limits that it and its servos have in common; itself where it has them.

        Raises:
            RobotDefinitionError: some joint has no value that both allow.
        """
        alone = self.alone(robot)
        narrowed = within_servos(alone)
        self._own = _ends(alone)
        return robot if np.array_equal(_ends(narrowed), _ends(robot)) else narrowed


def narrowing_sentence(wide: Robot, narrow: Robot) -> str:
    """What joints may do while the arm is connected, and what they may do without it; "" where it is the same."""
    changed = np.flatnonzero((wide.limits != narrow.limits).any(axis=1)).tolist()
    if not changed:
        return ""
    parts = (
        tr(
            "{joint} {narrow} instead of {wide}",
            joint=tr(wide.joint_names[j]),
            narrow=_span(narrow, j),
            wide=_span(wide, j),
        )
        for j in changed
    )
    return tr("While it is connected its servos set the limits: {parts}.", parts=tr(", ").join(parts))


def _span(robot: Robot, joint: int) -> str:
    from rvsim.device.driver.plan import shown  # only who connects an arm needs the driver

    lower, upper = robot.limits[joint]
    return tr("{lower} to {upper}", lower=shown(robot, joint, lower), upper=shown(robot, joint, upper))


def _ends(robot: Robot) -> FloatArray:
    """(n, 3) lower, upper, home."""
    return np.column_stack([robot.limits, robot.home])


def _with_ends(robot: Robot, ends: FloatArray) -> Robot:
    for index, (lower, upper, home) in enumerate(ends.tolist()):
        robot = robot.with_joint(index, lower=lower, upper=upper, home=min(max(home, lower), upper))
    return robot
