"""The numbers of one move of a program, to be changed where they stand."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, replace
from functools import partial
from typing import Any

import numpy as np
from PySide6.QtCore import Signal
from PySide6.QtWidgets import QComboBox, QLabel, QVBoxLayout, QWidget

from rvsim.experiment import Experiment
from rvsim.experiment.program import ArcMove, Gripper, JointMove, LineMove, Move, Wait
from rvsim.gui.panels.number_row import NumberRow
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Kind, joint_kind, length_kind
from rvsim.gui.quantity_box import QuantityBox
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import button, combo, form, select, silence
from rvsim.kinematics import forward_kinematics
from rvsim.language import tr, tr_later
from rvsim.spatial import rpy_from_rotation

_TOOLS = {
    "keep": tr_later("Tool as it is when the move begins"),
    "turn": tr_later("Tool turned to …"),
    "free": tr_later("Only the place matters"),
}
_IN_A_ROW = 3
_TITLES = {
    JointMove: tr_later("Joint move"),
    LineMove: tr_later("Line"),
    ArcMove: tr_later("Arc"),
    Wait: tr_later("Wait"),
    Gripper: tr_later("Gripper"),
}
_PLACES = {  # before the axes, and on the button that takes the tool's place
    "to": (tr_later("To"), tr_later("To where the tool is now")),
    "via": (tr_later("Over"), tr_later("Over where the tool is now")),
}
_BOXES: dict[str, tuple[str, str, Kind, float, float]] = {  # title, what messages call it, kind, least, most
    "speed": (tr_later("Speed"), tr_later("Speed of the move"), "percent", 0.01, 1.0),
    "seconds": (tr_later("Time"), tr_later("Time of the move"), "time", 0.0, 86_400.0),
    "opening": (tr_later("Open"), tr_later("Open of the move"), "percent", 0.0, 1.0),
}


class MoveEditor(QWidget):
    """Shows one move; another kind of move, or another arm, makes other boxes.

    Signals:
        edited(move, field): the move with another value.
        refused(sentence): why something typed was not taken.
        finished(): Enter has been pressed in a box, or it has been left.
    """

    edited = Signal(object, str)
    refused = Signal(str)
    finished = Signal()

    def __init__(self, preferences: Preferences) -> None:
        super().__init__()
        self.setObjectName("program_editor")
        self._preferences = preferences
        self._move: Move | None = None
        self._experiment: Experiment | None = None
        self._made_for: tuple[Any, ...] = ()
        self._inside = QWidget()
        self._showers: list[Callable[[Any], None]] = []
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        self._column.addWidget(self._inside)

    def show_move(self, move: Move | None, experiment: Experiment) -> None:
        """Show a move of an experiment, or nothing."""
        self._move, self._experiment = move, experiment
        robot = experiment.robot
        made_for = (type(move), robot.name, robot.joint_names, robot.joint_types, getattr(move, "tool", ""))
        if made_for != self._made_for:
            self._made_for = made_for
            self._rebuild()
        if move is not None:
            for show in self._showers:
                show(move)

    def _rebuild(self) -> None:
        self._column.removeWidget(self._inside)
        silence(self._inside)
        self._inside.hide()
        self._inside.deleteLater()
        self._inside, self._showers = QWidget(), []
        if self._move is not None:
            rows = form()
            title = QLabel(tr(_TITLES[type(self._move)]))
            set_role(title, role="title")
            rows.addRow(title)
            for field in fields(self._move):
                self._add(rows, field.name)
            self._inside.setLayout(rows)
        self._column.addWidget(self._inside)

    def _add(self, rows: Any, name: str) -> None:
        if name in _BOXES:
            rows.addRow(tr(_BOXES[name][0]), self._box(name))
        elif name in _PLACES:
            rows.addRow(self._place(name))
            rows.addRow(self._here_button(name, tr(_PLACES[name][1])))
        elif name == "tool":
            rows.addRow(tr("Tool"), self._tool())
        elif name == "rpy" and getattr(self._move, "tool", "") == "turn":
            rows.addRow(self._angles())
            rows.addRow(self._here_button("rpy", tr("As the tool is turned now")))
        elif name == "q":
            self._joints(rows)
        elif name == "pose":
            rows.addRow(tr("Pose"), self._pose())

    # --- boxes -----------------------------------------------------------------------------------------------------

    def _box(self, name: str) -> QuantityBox:
        _, title, kind, least, most = _BOXES[name]
        box = QuantityBox(kind, self._preferences, tr(title))
        box.setObjectName(f"program_{name}")
        box.set_range(least, most)
        box.quantity_changed.connect(lambda value: self._edit(name, value))
        box.refused.connect(self.refused)
        box.editingFinished.connect(self.finished)
        self._showers.append(lambda move: box.set_quantity(getattr(move, name)))
        return box

    def _row(
        self, names: tuple[str, ...], kinds: tuple[Kind, ...], title: str, field: str, part: slice, prefix: str
    ) -> NumberRow:
        """Boxes for a part of a field that is a tuple of numbers."""
        row = NumberRow(prefix, names, kinds, self._preferences, title)

        def take(_index: int) -> None:
            values = list(getattr(self._move, field))
            values[part] = row.values.tolist()
            self._edit(field, tuple(values))

        row.edited.connect(take)
        row.refused.connect(self.refused)
        row.finished.connect(self.finished)
        self._showers.append(lambda move: row.show_values(np.array(getattr(move, field)[part])))
        return row

    def _place(self, name: str) -> NumberRow:
        assert self._experiment is not None
        kind = length_kind(self._experiment.robot)
        title, axes = tr(_PLACES[name][0]), ("x", "y", "z")
        names = tuple(f"{title} {axis}" for axis in axes)
        row = self._row(names, (kind,) * 3, tr("Move"), name, slice(None), "program")
        for axis, box in zip(axes, row.boxes, strict=True):
            box.setObjectName(f"program_{name}_{axis}")
        return row

    def _angles(self) -> NumberRow:
        names: tuple[str, ...] = (tr_later("roll"), tr_later("pitch"), tr_later("yaw"))
        return self._row(names, ("angle",) * 3, tr("Tool"), "rpy", slice(None), "program")

    def _joints(self, rows: Any) -> None:
        assert self._experiment is not None
        robot = self._experiment.robot
        if not isinstance(self._move, JointMove) or len(self._move.q) != robot.dof:
            return
        for first in range(0, robot.dof, _IN_A_ROW):
            part = slice(first, min(first + _IN_A_ROW, robot.dof))
            names = robot.joint_names[part]
            kinds = tuple(joint_kind(robot, joint) for joint in range(robot.dof))[part]
            rows.addRow(self._row(names, kinds, tr("Joint"), "q", part, "program_joint"))
        rows.addRow(self._here_button("q", tr("The joints as they are now")))

    def _tool(self) -> QComboBox:
        box = combo("program_tool", tr("Tool orientation along the move"), _TOOLS)
        box.activated.connect(lambda _: self._choose_tool(box.currentData()))
        self._showers.append(lambda move: select(box, move.tool))
        return box

    def _choose_tool(self, rule: str) -> None:
        """A tool that is to be turned is at first turned as it is now."""
        if rule == "turn" and isinstance(self._move, LineMove | ArcMove) and not any(self._move.rpy):
            roll, pitch, yaw = self._now("rpy")
            self._move = replace(self._move, rpy=(roll, pitch, yaw))
        self._edit("tool", rule)

    def _pose(self) -> QComboBox:
        box = combo("program_pose", tr("Which pose the joints go to"))
        box.activated.connect(lambda _: self._edit("pose", box.currentData()))

        def show(move: JointMove) -> None:
            assert self._experiment is not None
            known = [pose.name for pose in self._experiment.poses]
            names = [*known, *([move.pose] if move.pose and move.pose not in known else [])]
            if [box.itemData(i) for i in range(1, box.count())] != names:
                box.clear()
                box.addItem(tr("These joints"), "")
                for name in names:
                    box.addItem(name, name)
            select(box, move.pose)

        self._showers.append(show)
        return box

    def _here_button(self, field: str, text: str) -> QWidget:
        tip = tr("Take it from the arm as it stands")
        return button(f"program_{field}_here", text, tip, partial(self._take_here, field))

    # --- values ----------------------------------------------------------------------------------------------------

    def _take_here(self, field: str) -> None:
        self._edit(field, self._now(field))
        self.finished.emit()

    def _now(self, field: str) -> tuple[float, ...]:
        """What the arm has at present: q, the tool's angles, or its place."""
        assert self._experiment is not None
        if field == "q":
            return tuple(self._experiment.q.tolist())
        T = forward_kinematics(self._experiment.robot, self._experiment.q)
        return tuple((rpy_from_rotation(T[:3, :3]) if field == "rpy" else T[:3, 3]).tolist())

    def _edit(self, field: str, value: Any) -> None:
        if self._move is not None:
            self.edited.emit(replace(self._move, **{field: value}), field)
