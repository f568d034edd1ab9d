"""The value box of a joint, which takes a whole pose as well."""

from __future__ import annotations

from rvsim.gui.panels.list_box import ListBox
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import display, joint_kind
from rvsim.robot import Robot


class JointBox(ListBox):
    """A value box that a whole pose can be pasted or typed into: `pose_given(values)` [shown units] tells it."""

    def __init__(self, robot: Robot, index: int, preferences: Preferences, title: str) -> None:
        kinds = [joint_kind(robot, joint) for joint in range(robot.dof)]
        super().__init__(
            kinds[index], preferences, title, lambda: [display(kind, preferences).suffix.strip() for kind in kinds]
        )
