"""How the tool is turned along a trajectory: the ways there are, and the numbers that some of them need."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QCheckBox, QHBoxLayout, QLabel, QVBoxLayout, QWidget

from rvsim.experiment import Experiment, PathOrientation, TrajectoryTask
from rvsim.gui.panels.number_row import NumberRow
from rvsim.gui.panels.path_line import LINE_ORIENTATIONS
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantity_box import QuantityBox
from rvsim.gui.session import Session
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import combo, select
from rvsim.kinematics import forward_kinematics
from rvsim.lab.orientations import Angles
from rvsim.language import tr, tr_later
from rvsim.spatial import rpy_from_rotation

_ORIENTATIONS = {
    "source": tr_later("As the path has it"),
    **LINE_ORIENTATIONS,
    "normal": tr_later("Normal to the plane, or the nearest"),
    "pitch": tr_later("Pitch ψ held"),
    "turn": tr_later("Turning evenly to another"),
}
_NAMES = ("roll", "pitch", "yaw")


class OrientationRows(QWidget):
    """The choice, and below it what it needs.

    Signals:
        edited(task, merge): the trajectory is wanted so.
    """

    edited = Signal(object, str)

    def __init__(self, session: Session, preferences: Preferences) -> None:
        super().__init__()
        self._session = session
        self._task: TrajectoryTask = session.experiment.trajectory
        self.choice = combo("trajectory_orientation", tr("Tool orientation along the trajectory"), _ORIENTATIONS)
        self.choice.activated.connect(lambda _: self._on_choice(self.choice.currentData()))
        self.pitch = QuantityBox("angle", preferences, tr("ψ of the tool above the horizontal; −90° is straight down"))
        self.pitch.setObjectName("trajectory_pitch")
        self.pitch.quantity_changed.connect(lambda value: self._edit("trajectory pitch", pitch=value))
        self.from_now = QCheckBox(tr("from how the tool is now"))
        self.from_now.setObjectName("trajectory_from_now")
        self.from_now.toggled.connect(self._on_from_now)
        self.ends = {
            "turn_from": NumberRow("trajectory_from", _NAMES, ("angle",) * 3, preferences, tr("Tool at the beginning")),
            "turn_to": NumberRow("trajectory_to", _NAMES, ("angle",) * 3, preferences, tr("Tool at the end")),
        }
        for name, row in self.ends.items():
            row.edited.connect(lambda _, name=name: self._on_end(name))
            row.refused.connect(session.warn)
            row.finished.connect(session.end_stroke)
        self.pitch.refused.connect(session.warn)
        self.pitch.editingFinished.connect(session.end_stroke)
        self._lay_out()

    def _lay_out(self) -> None:
        self._pitch_row, self._turn_rows = QWidget(), QWidget()
        pitch = QHBoxLayout(self._pitch_row)
        pitch.setContentsMargins(0, 0, 0, 0)
        label = QLabel(tr("ψ above level"))
        set_role(label, role="muted")
        pitch.addWidget(label)
        pitch.addWidget(self.pitch, 1)
        turns = QVBoxLayout(self._turn_rows)
        turns.setContentsMargins(0, 0, 0, 0)
        turns.setSpacing(2)
        turns.addWidget(self.from_now)
        turns.addWidget(self.ends["turn_from"])
        turns.addWidget(QLabel(tr("to")))
        turns.addWidget(self.ends["turn_to"])
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(4)
        for widget in (self.choice, self._pitch_row, self._turn_rows):
            column.addWidget(widget)

    def show_task(self, experiment: Experiment) -> None:
        """Show how the tool is turned along the experiment's trajectory."""
        self._task = task = experiment.trajectory
        select(self.choice, task.orientation)
        self._pitch_row.setVisible(task.orientation == "pitch")
        self._turn_rows.setVisible(task.orientation == "turn")
        self.pitch.set_quantity(task.pitch)
        with QSignalBlocker(self.from_now):
            self.from_now.setChecked(task.turn_from is None)
        self.ends["turn_from"].setVisible(task.turn_from is not None)
        for name, row in self.ends.items():
            angles = getattr(task, name)
            row.show_values(np.array(self._now() if angles is None else angles))

    def _now(self) -> Angles:
        roll, pitch, yaw = rpy_from_rotation(forward_kinematics(self._session.robot, self._session.q)[:3, :3]).tolist()
        return roll, pitch, yaw

    def _on_choice(self, orientation: PathOrientation) -> None:
        if orientation == self._task.orientation:
            return
        changes: dict[str, Any] = {"orientation": orientation}
        if orientation == "turn" and self._task.turn_to is None:
            roll, pitch, yaw = self._now()
            changes["turn_to"] = roll, pitch, yaw + np.pi / 6
        self._edit("", **changes)

    def _on_from_now(self, on: bool) -> None:
        self._edit("", turn_from=None if on else self._now())

    def _on_end(self, name: str) -> None:
        roll, pitch, yaw = self.ends[name].values.tolist()
        self._edit(f"trajectory {name}", **{name: (roll, pitch, yaw)})

    def _edit(self, merge: str, **changes: Any) -> None:
        self.edited.emit(replace(self._task, **changes), merge)
