"""The left panel: which arm, what each joint is, Plot, Home, Zero, Random, and poses worth remembering."""

from __future__ import annotations

import secrets
from dataclasses import replace
from itertools import pairwise

import numpy as np
from PySide6.QtCore import QSignalBlocker, QSize, Signal
from PySide6.QtWidgets import (
    QCheckBox,
    QGridLayout,
    QHBoxLayout,
    QInputDialog,
    QVBoxLayout,
    QWidget,
)

from rvsim.experiment import Experiment, random_pose
from rvsim.gui.panels.joint_row import IGNORE_HINT, JointRow
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import display, format_number, joint_kind
from rvsim.gui.session import Session
from rvsim.gui.widgets import button, combo, scrolled, silence
from rvsim.language import tr, tr_later, trn
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_SERVO_HINTS = {  # by whether the servo narrows the lower limit, and the upper one
    (False, False): IGNORE_HINT,
    (True, False): tr_later("Below that the servo of the connected arm does not reach."),
    (False, True): tr_later("Above that the servo of the connected arm does not reach."),
    (True, True): tr_later("The servo of the connected arm does not reach it."),
}
_WIDEST_LINE = 310  # [pixels] of what stands in one line below the joints
_SHORTEST_NAME = 4  # letters of a pose's name that can be read at least


def _joint_words(robot: Robot, index: int) -> str:
    """ "joint 3 (elbow)", or "joint 3" where its name says no more."""
    name = robot.joint_names[index]
    return (
        tr("joint {number}", number=index + 1)
        if name.lower() in (f"joint {index + 1}", f"j{index + 1}")
        else tr("joint {number} ({name})", number=index + 1, name=tr(name))
    )


class JointsPanel(QWidget):
    """What the arm is now. `robot_wanted(name)` tells that another arm has been chosen."""

    robot_wanted = Signal(str)

    def __init__(self, session: Session, preferences: Preferences, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session, self._preferences = session, preferences
        self._rows: list[JointRow] = []
        self.robots = combo("robot_selector", tr("Arm"))
        self.robots.activated.connect(lambda _: self.robot_wanted.emit(self.robots.currentData()))
        self._joints = QWidget()
        self._joints_column = QVBoxLayout(self._joints)
        self._joints_column.setContentsMargins(12, 4, 12, 4)
        self._joints_column.setSpacing(8)
        self._make_controls()
        self._lay_out()
        session.changed.connect(self._on_changed)
        preferences.changed.connect(self._on_preference)
        self._make_rows()

    def sizeHint(self) -> QSize:
        """Narrow: the room belongs to the scene."""
        return QSize(280, 600)

    @property
    def _typed(self) -> FloatArray:
        """(n,) what the boxes show; the arm follows at once when live, else at Plot."""
        typed = self._session.experiment.typed
        return self._session.q if typed is None else typed

    # --- construction ----------------------------------------------------------------------------------------------

    def _make_controls(self) -> None:
        self.plot = button(
            "plot_button", tr("Plot"), tr("Draw the arm at the typed values"), self.plot_typed, primary=True
        )
        self.home = button("home_button", tr("Home"), tr("The arm's home pose (Ctrl+H)"), self.go_home)
        self.zero = button("zero_button", tr("Zero"), tr("All joint variables 0"), self.go_zero)
        self.random = button("random_button", tr("Random"), tr("Any pose within the limits"), self.go_random)
        self.live = QCheckBox(tr("Live"))
        self.live.setObjectName("live_switch")
        self.live.setToolTip(tr("The arm follows each value at once; off: press Plot"))
        self.live.setChecked(self._preferences["live"])
        self.live.toggled.connect(lambda on: self._preferences.set("live", on))
        self.ignore = QCheckBox(tr("Ignore limits"))
        self.ignore.setObjectName("ignore_limits_switch")
        self.ignore.setToolTip(tr("Let joints go beyond their limits; such joints are marked"))
        self.ignore.toggled.connect(self._on_ignore)
        self.poses = combo("pose_selector", tr("Saved poses"))
        self.poses.setMinimumContentsLength(_SHORTEST_NAME)
        self.poses.activated.connect(self._recall)
        tip = tr("Save this pose under a name (Ctrl+D)")
        self.save_pose = button("save_pose_button", tr("Save…"), tip, self.ask_pose_name)
        tip = tr("Forget the pose chosen in the list")
        self.forget_pose = button("forget_pose_button", tr("Forget"), tip, self._forget)

    def _lay_out(self) -> None:
        scroll = scrolled(self._joints)
        self._lines = {
            QGridLayout(): (self.plot, self.home, self.zero, self.random),
            QGridLayout(): (self.poses, self.save_pose, self.forget_pose),
        }
        buttons, poses = self._lines
        self.arrange()
        switches = QHBoxLayout()
        switches.addWidget(self.live)
        switches.addWidget(self.ignore)
        switches.addStretch(1)
        below = QVBoxLayout()
        below.setContentsMargins(12, 4, 12, 8)
        below.setSpacing(8)
        below.addLayout(buttons)
        below.addLayout(switches)
        below.addLayout(poses)
        above = QVBoxLayout()
        above.setContentsMargins(12, 4, 12, 4)
        above.addWidget(self.robots)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.setSpacing(0)
        whole.addLayout(above)
        whole.addWidget(scroll, 1)
        whole.addLayout(below)

    def arrange(self) -> None:
        """Put what stands below in two lines where its words, in large letters, would hold the panel wide."""
        for grid, parts in self._lines.items():
            grid.setSpacing(6)
            count, needed = len(parts), sum(part.minimumSizeHint().width() for part in parts)
            one_line = needed <= _WIDEST_LINE
            grid.setColumnStretch(0, int(one_line and parts[0] is self.poses))
            for index, part in enumerate(parts):
                row, column = (0, index) if one_line else divmod(index + count % 2, 2)
                first = not one_line and index < count % 2  # of an odd number, alone in its line
                grid.addWidget(part, row, 0 if first else column, 1, 2 if first else 1)

    def show_robots(self, titles: dict[str, str], current: str) -> None:
        """Offer these arms: name → title."""
        with QSignalBlocker(self.robots):
            self.robots.clear()
            for name, title in titles.items():
                self.robots.addItem(tr(title), name)
            self.robots.setCurrentIndex(self.robots.findData(current))

    def _make_rows(self) -> None:
        for row in self._rows:
            silence(row)
            self._joints_column.removeWidget(row)
            row.setParent(None)  # so that nobody who looks for a joint's box by name finds one of the last arm
            row.deleteLater()
        while self._joints_column.count():
            self._joints_column.takeAt(0)
        robot = self._session.robot
        self._rows = [JointRow(robot, index, self._preferences) for index in range(robot.dof)]
        for row in self._rows:
            self._joints_column.addWidget(row)
            row.moved.connect(self._on_moved)
            row.released.connect(self._session.end_stroke)
            row.refused.connect(self._session.warn)
            row.box.pose_given.connect(self._on_pose)
        self._joints_column.addStretch(1)
        self._chain_tabs()
        self._show_limits()
        self._show_pose()
        self._show_poses()

    def _chain_tabs(self) -> None:
        boxes, sliders = [row.box for row in self._rows], [row.slider for row in self._rows]
        chain = [self.robots, *boxes, *sliders, self.plot, self.home]  # values are typed one after the other
        for first, second in pairwise(chain):
            QWidget.setTabOrder(first, second)

    # --- the session says ------------------------------------------------------------------------------------------

    def _on_changed(self, before: Experiment, after: Experiment) -> None:
        if after.robot is not before.robot:
            with QSignalBlocker(self.robots):
                self.robots.setCurrentIndex(self.robots.findData(after.robot.name))
            self._make_rows()
            return
        if after.ignore_limits != before.ignore_limits:
            self._show_limits()
        if after.q is not before.q or after.typed is not before.typed:
            self._show_pose()
        if after.poses is not before.poses:
            self._show_poses()

    def _on_preference(self, name: str) -> None:
        if name in ("angle_unit", "length_unit", "extra_decimals"):
            self._show_limits()
        if name == "live":
            self.live.setChecked(self._preferences["live"])
            if self._preferences["live"] and not np.array_equal(self._typed, self._session.q):
                self.plot_typed()  # the arm follows what stands in the boxes

    def _show_limits(self) -> None:
        ignored = self._session.experiment.ignore_limits
        with QSignalBlocker(self.ignore):
            self.ignore.setChecked(ignored)
        servos = self._session.servo_limits
        own = servos.alone(self._session.robot).limits if servos else self._session.robot.limits
        for row, narrowed in zip(self._rows, self._session.robot.limits != own, strict=True):
            row.show_limits(ignored, _SERVO_HINTS[bool(narrowed[0]), bool(narrowed[1])])

    def _show_pose(self) -> None:
        for row, value in zip(self._rows, self._typed, strict=True):
            row.show_value(float(value))

    def _show_poses(self) -> None:
        poses = self._session.experiment.poses
        with QSignalBlocker(self.poses):
            self.poses.clear()
            self.poses.addItem(tr("Poses…") if poses else tr("No poses"))
            for pose in poses:
                self.poses.addItem(pose.name)
        self.poses.setEnabled(bool(poses))
        self.forget_pose.setEnabled(bool(poses))

    # --- the user says ---------------------------------------------------------------------------------------------

    def _on_moved(self, index: int, value: float) -> None:
        typed = np.array(self._typed)
        typed[index] = value
        name = _joint_words(self._session.robot, index)
        if self._preferences["live"]:
            self._session.edit(
                tr("Move {joint}", joint=name), self._session.experiment.at(typed), merge=f"joint {index}"
            )
        else:
            self._type(tr("Type {joint}", joint=name), typed, merge=f"type {index}")

    def _type(self, text: str, typed: FloatArray, merge: str = "") -> None:
        self._session.edit(text, self._session.experiment.with_typed(typed), merge=merge)
        self._session.say(tr("Typed, not drawn yet: press Plot."))

    def _on_pose(self, values: tuple[float, ...]) -> None:
        """All joints at once, in the shown units."""
        robot = self._session.robot
        if len(values) != robot.dof:
            text = trn(
                "A pose of the {robot} has {n} value, not {given}.",
                "A pose of the {robot} has {n} values, not {given}.",
                robot.dof,
                robot=tr(robot.title),
                given=len(values),
            )
            self._session.warn(text)
            return
        factors = [display(joint_kind(robot, index), self._preferences).factor for index in range(robot.dof)]
        q = np.divide(values, factors)
        if self._preferences["live"]:
            self._session.move_to(q, tr("Paste pose"))
        else:
            self._type(tr("Type a pose"), q)

    def _on_ignore(self, on: bool) -> None:
        text = tr("Ignore limits") if on else tr("Respect limits")
        self._session.edit(text, replace(self._session.experiment, ignore_limits=on))

    def plot_typed(self) -> None:
        """Draw the arm at the typed values."""
        typed = self._session.experiment.typed
        if typed is not None and not self._session.move_to(typed, tr("Plot the typed values")):
            return
        values = ", ".join(
            f"{format_number(value * display(joint_kind(self._session.robot, i), self._preferences).factor, 1)}"
            for i, value in enumerate(self._typed)
        )
        self._session.say(tr("Plotted the {robot} at ({values}).", robot=tr(self._session.robot.title), values=values))

    def go_home(self) -> None:
        """Go to the arm's home pose."""
        if self._session.move_to(self._session.robot.home, tr("Go home")):
            self._session.say(tr("The {robot} is at home.", robot=tr(self._session.robot.title)))

    def go_zero(self) -> None:
        """Go to q = 0, if the limits allow it."""
        self._session.move_to(np.zeros(self._session.robot.dof), tr("Go to zero"))

    def go_random(self) -> None:
        """Go to any pose within the limits."""
        self._session.move_to(random_pose(self._session.robot, secrets.randbits(64)), tr("Go to a random pose"))

    def ask_pose_name(self) -> None:
        """Save the present pose under a name that the user types."""
        count = len(self._session.experiment.poses) + 1
        name, given = QInputDialog.getText(
            self, tr("Save pose"), tr("Name of this pose:"), text=tr("pose {number}", number=count)
        )
        if given and name.strip():
            self.save_pose_as(name.strip())

    def save_pose_as(self, name: str) -> None:
        """Save the present pose under that name."""
        self._session.edit(tr("Save pose {name}", name=name), self._session.experiment.with_pose(name))
        self._session.say(tr("Saved as “{name}”.", name=name))

    def _recall(self, row: int) -> None:
        if row == 0:
            return
        pose = self._session.experiment.poses[row - 1]
        self._session.move_to(pose.q, tr("Go to pose {name}", name=pose.name))

    def _forget(self) -> None:
        name = self.poses.currentText()
        if self.poses.currentIndex() > 0:
            self._session.edit(tr("Forget pose {name}", name=name), self._session.experiment.without_pose(name))
        else:
            self._session.say(tr("Choose the pose to forget in the list first."))
