"""What the laboratory's solvers are asked: which target, and from which start."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QGridLayout, QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from rvsim.experiment import random_pose
from rvsim.gui.panels.laboratory_fields import Disclosure, StartJoint
from rvsim.gui.panels.number_row import NumberRow
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import length_kind
from rvsim.gui.session import Session
from rvsim.gui.widgets import button, combo, select, silence
from rvsim.kinematics.numeric import AS_IN_SOURCE_002
from rvsim.lab.laboratory import target_of
from rvsim.language import tr, tr_later
from rvsim.robot.arrays import FloatArray
from rvsim.spatial import rotation_from_rpy, rpy_from_rotation

_AXES = ("x", "y", "z")
_ANGLES = (tr_later("roll"), tr_later("pitch"), tr_later("yaw"))
_TARGETS = {
    "random": tr_later("Random, reachable"),
    "tool": tr_later("The tool's pose"),
    "typed": tr_later("Typed pose"),
}
_STARTS = {
    "home": tr_later("Home"),
    "present": tr_later("Present pose"),
    "random": tr_later("Random pose"),
    "own": tr_later("Own, by the sliders"),
}
_SOURCE_002 = "source_002"
_ANOTHER = tr_later("Another")
_AGAIN = {"random": _ANOTHER, "tool": tr_later("Take again"), "present": tr_later("Take again")}
_FIRST_TARGET, _FIRST_START = 6, 1  # numbers of random poses; that target is within reach of most starts
_LABEL_WIDTH = 48


class Words(NamedTuple):
    """What a chooser says: before the choice, to screen readers, and of the button that shows the numbers; English."""

    label: str
    title: str
    show: str
    hide: str


_TARGET = Words(
    tr_later("Target"),
    tr_later("Target of the laboratory"),
    tr_later("Show the target's numbers"),
    tr_later("Hide the target's numbers"),
)
_START = Words(
    tr_later("Start"),
    tr_later("Start of the laboratory"),
    tr_later("Show the start's numbers"),
    tr_later("Hide the start's numbers"),
)


def labelled_row(title: str, *widgets: QWidget) -> QWidget:
    """A label and widgets beside it, the first one filling the row."""
    row = QWidget()
    layout = QHBoxLayout(row)
    layout.setContentsMargins(0, 0, 0, 0)
    layout.setSpacing(6)
    label = QLabel(title)
    label.setBuddy(widgets[0])
    label.setMinimumWidth(_LABEL_WIDTH)
    layout.addWidget(label)
    for index, widget in enumerate(widgets):
        layout.addWidget(widget, 1 if index == 0 else 0)
    return row


class Chooser(QWidget):
    """A choice in a combo, a button that makes it anew, and details that can be shown; `changed()` tells of another."""

    changed = Signal()

    def __init__(self, name: str, words: Words, choices: dict[str, str], session: Session) -> None:
        super().__init__()
        self._session = session
        self.number = 0  # of the random pose
        self.choice = combo(f"lab_{name}_selector", words.title, choices)
        self.choice.activated.connect(lambda _: self.take(self.choice.currentData()))
        self.again: QPushButton = button(f"lab_{name}_again_button", _ANOTHER, "", self._on_again)
        self.details = QWidget()
        self.disclosure = Disclosure(f"lab_{name}_details_button", tr(words.show), tr(words.hide), self.details)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(6)
        column.addWidget(labelled_row(tr(words.label), self.choice, self.again, self.disclosure))
        column.addWidget(self.details)

    def take(self, choice: str) -> None:
        """Make a choice, and tell."""
        self.choose(choice)
        self.changed.emit()

    def choose(self, choice: str) -> None:
        """Make a choice, silently."""
        select(self.choice, choice)
        self.again.setVisible(choice in _AGAIN)
        self.again.setText(tr(_AGAIN.get(choice, _ANOTHER)))
        self.again.setToolTip(tr("Draw another random pose") if choice == "random" else tr("Take it as it is now"))

    def _on_again(self) -> None:
        self.number += 1
        self.take(self.choice.currentData())


class TargetChooser(Chooser):
    """The target: a random pose that can be reached, the tool's own, or a typed one; `T` (4, 4)."""

    def __init__(self, session: Session, preferences: Preferences) -> None:
        super().__init__("target", _TARGET, _TARGETS, session)
        self.T: FloatArray = np.eye(4)
        self.position = NumberRow("lab_target", _AXES, ("length",) * 3, preferences)
        self.angles = NumberRow("lab_target", _ANGLES, ("angle",) * 3, preferences)
        column = QVBoxLayout(self.details)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(4)
        for row, names in ((self.position, _AXES), (self.angles, _ANGLES)):
            column.addWidget(row)
            for box, name in zip(row.boxes, names, strict=True):
                box.setAccessibleName(tr("Target {coordinate} of the laboratory", coordinate=tr(name)))
                box.quantity_changed.connect(lambda _, turned=name in _ANGLES: self._on_typed(turned))
                box.refused.connect(session.warn)
        self.show_robot()

    def show_robot(self) -> None:
        """Another arm: a target that it can reach."""
        self.number = _FIRST_TARGET
        for box in self.position.boxes:
            box.set_kind(length_kind(self._session.robot))
        self.choose("random")

    def choose(self, choice: str) -> None:
        """Make a choice, silently."""
        super().choose(choice)
        robot = self._session.robot
        if choice == "random":
            self.T = target_of(robot, random_pose(robot, self.number))
        elif choice == "tool":
            self.T = target_of(robot, self._session.q)
        else:
            self.disclosure.show_content(True)
        self._show()

    def _show(self) -> None:
        self.position.show_values(self.T[:3, 3])
        self.angles.show_values(rpy_from_rotation(self.T[:3, :3]))

    def _on_typed(self, turned: bool) -> None:
        T = self.T.copy()
        T[:3, 3] = [box.quantity for box in self.position.boxes]
        if turned:
            T[:3, :3] = rotation_from_rpy([box.quantity for box in self.angles.boxes])
        self.T = T
        super().choose("typed")
        self.changed.emit()


class StartChooser(Chooser):
    """The start: home, the present pose, a random one, or own values by sliders; `q0` (n,) [rad, m]."""

    def __init__(self, session: Session, preferences: Preferences) -> None:
        super().__init__("start", _START, _STARTS, session)
        self._preferences = preferences
        self.q0: FloatArray = session.robot.home
        self.joints: list[StartJoint] = []
        self._grid = QGridLayout(self.details)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setSpacing(4)
        self.show_robot()

    def show_robot(self) -> None:
        """Another arm: other sliders, and its home to start from."""
        self.number = _FIRST_START
        for joint in self.joints:
            silence(joint)
            self._grid.removeWidget(joint)
            joint.deleteLater()
        robot = self._session.robot
        self.joints = [StartJoint(robot, index, self._preferences) for index in range(robot.dof)]
        for index, joint in enumerate(self.joints):
            joint.moved.connect(self._on_moved)
            joint.box.refused.connect(self._session.warn)
            self._grid.addWidget(joint, index, 0)
        self._offer_source_002()
        self.choose("home")

    def _offer_source_002(self) -> None:
        """The guess of source 002 is one for six joints."""
        with QSignalBlocker(self.choice):
            known = self.choice.findData(_SOURCE_002)
            fits = AS_IN_SOURCE_002.guess is not None and len(AS_IN_SOURCE_002.guess) == self._session.robot.dof
            if fits and known < 0:
                self.choice.addItem(tr("Guess of source 002"), _SOURCE_002)
            elif known >= 0 and not fits:
                self.choice.removeItem(known)

    def choose(self, choice: str) -> None:
        """Make a choice, silently."""
        super().choose(choice)
        robot = self._session.robot
        if choice == "home":
            self.q0 = robot.home
        elif choice == "present":
            self.q0 = self._session.q
        elif choice == "random":
            self.q0 = random_pose(robot, self.number)
        elif choice == _SOURCE_002 and AS_IN_SOURCE_002.guess is not None:
            self.q0 = np.array(AS_IN_SOURCE_002.guess)
        else:
            self.disclosure.show_content(True)
        self._show()

    def use_guess(self, guess: tuple[float, ...] | None) -> None:
        """Start from a source's guess, silently, if this arm has as many joints."""
        if guess is not None and len(guess) == self._session.robot.dof:
            self.choose(_SOURCE_002)

    def _show(self) -> None:
        for joint, value in zip(self.joints, self.q0, strict=True):
            joint.show_value(float(value))

    def _on_moved(self, index: int, value: float) -> None:
        q0 = self.q0.copy()
        q0[index] = value
        self.q0 = q0
        self.joints[index].show_value(value)
        super().choose("own")
        self.changed.emit()
