"""The value box of a joint, which takes a whole pose as well."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtGui import QGuiApplication, QKeyEvent, QKeySequence

from rvsim.gui.panels.pose_text import pose_values
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import display, joint_kind
from rvsim.gui.quantity_box import QuantityBox
from rvsim.robot import Robot


class JointBox(QuantityBox):
    """A value box that a whole pose can be pasted or typed into: `pose_given(values)` [shown units] tells it."""

    pose_given = Signal(tuple)

    def __init__(self, robot: Robot, index: int, preferences: Preferences, title: str) -> None:
        self._robot = robot
        super().__init__(joint_kind(robot, index), preferences, title)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """A pasted pose is taken at once; all else goes into the box as text."""
        if not (event.matches(QKeySequence.StandardKey.Paste) and self._give(QGuiApplication.clipboard().text())):
            super().keyPressEvent(event)

    def fixup(self, text: str) -> str:
        """Asked for when what stands there is not one value: it may be a pose."""
        return self.textFromValue(self.value()) if self._give(text) else super().fixup(text)

    def _give(self, text: str) -> bool:
        kinds = [joint_kind(self._robot, index) for index in range(self._robot.dof)]
        values = pose_values(text, [display(kind, self._preferences).suffix.strip() for kind in kinds])
        if values:
            self._show()  # its own value until the pose has been taken
            self.pose_given.emit(values)
            self.selectAll()
        return bool(values)
