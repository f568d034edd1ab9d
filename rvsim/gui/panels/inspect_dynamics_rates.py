"""A row for every joint with its velocity and its acceleration, typed or taken from the motion that is shown."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QGridLayout, QHBoxLayout, QLabel, QSizePolicy, QWidget

from rvsim.gui.panels.tables import dot
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Kind, acceleration_kind, speed_kind
from rvsim.gui.quantity_box import QuantityBox
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import ElidedLabel, silence
from rvsim.language import tr
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_DOT = 10


class RateRows(QWidget):
    """Shows q̇ and q̈ (n,) each.

    Signals:
        edited(): one has been typed.
        refused(sentence): why something typed was not taken.
    """

    edited = Signal()
    refused = Signal(str)

    def __init__(self, preferences: Preferences) -> None:
        super().__init__()
        self._preferences = preferences
        self.speeds: list[QuantityBox] = []
        self.accelerations: list[QuantityBox] = []
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setHorizontalSpacing(8)
        self._grid.setVerticalSpacing(3)
        for column, share in enumerate((0, 4, 4, 4)):
            self._grid.setColumnStretch(column, share)

    def show_robot(self, robot: Robot) -> None:
        """A row for each joint of this arm, at rest."""
        while (item := self._grid.takeAt(0)) is not None:
            if (old := item.widget()) is not None:
                silence(old)
                old.hide()
                old.deleteLater()
        for column, text in ((2, tr("velocity")), (3, tr("acceleration"))):
            head = QLabel(text)
            set_role(head, role="muted")
            self._grid.addWidget(head, 0, column, Qt.AlignmentFlag.AlignRight)
        self.speeds, self.accelerations = [], []
        for joint in range(robot.dof):
            self._add_row(robot, joint)

    def _add_row(self, robot: Robot, joint: int) -> None:
        name, mark = ElidedLabel(), QLabel()
        title = tr(robot.joint_names[joint])
        name.setText(title)
        mark.setPixmap(dot(robot.joints[joint].color).pixmap(_DOT, _DOT))
        speed = self._box(
            f"qd_{joint + 1}",
            tr("Velocity of {joint}", joint=title),
            speed_kind(robot, joint),
        )
        driven = self._box(
            f"qdd_{joint + 1}",
            tr("Acceleration of {joint}", joint=title),
            acceleration_kind(robot, joint),
        )
        for column, widget in enumerate((mark, name, speed, driven)):
            self._grid.addWidget(widget, joint + 1, column)
        self.speeds.append(speed)
        self.accelerations.append(driven)

    def _box(self, name: str, title: str, kind: Kind) -> QuantityBox:
        box = QuantityBox(kind, self._preferences, title)
        box.setObjectName(name)
        box.setMinimumWidth(60)
        box.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        box.quantity_changed.connect(lambda _: self.edited.emit())
        box.refused.connect(self.refused)
        return box

    @property
    def values(self) -> tuple[FloatArray, FloatArray]:
        """What stands in the boxes [SI]."""
        qd, qdd = (np.array([box.quantity for box in boxes]) for boxes in (self.speeds, self.accelerations))
        return qd, qdd

    def show_rates(self, qd: FloatArray, qdd: FloatArray, *, typed: bool) -> None:
        """Show these, silently; those of a motion cannot be typed over."""
        for boxes, values in ((self.speeds, qd), (self.accelerations, qdd)):
            for box, value in zip(boxes, values.tolist(), strict=True):
                box.set_quantity(value)
                if box.isReadOnly() == typed:
                    box.setReadOnly(not typed)


def beside(*widgets: QWidget) -> QHBoxLayout:
    """Widgets in a line, the first at the left, the others at the right end."""
    line = QHBoxLayout()
    line.setSpacing(8)
    line.addWidget(widgets[0])
    line.addStretch(1)
    for widget in widgets[1:]:
        line.addWidget(widget)
    return line
