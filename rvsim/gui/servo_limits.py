"""The limits of an arm while those of its servos count too, and the arm's own, which it gets back afterwards."""

from __future__ import annotations

import numpy as np

from rvsim.errors import RobotDefinitionError
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

    def narrow(self, robot: Robot) -> Robot:
        """The arm with the limits that it and its servos have in common; itself where it has them.

        Raises:
            RobotDefinitionError: some joint has no value that both allow.
        """
        alone = self.alone(robot)
        narrowed = within_servos(alone)
        self._own = _ends(alone)
        return robot if np.array_equal(_ends(narrowed), _ends(robot)) else narrowed


def _ends(robot: Robot) -> FloatArray:
    """(n, 3) lower, upper, home."""
    return np.column_stack([robot.limits, robot.home])


def _with_ends(robot: Robot, ends: FloatArray) -> Robot:
    for index, (lower, upper, home) in enumerate(ends.tolist()):
        robot = robot.with_joint(index, lower=lower, upper=upper, home=min(max(home, lower), upper))
    return robot
