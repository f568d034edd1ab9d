"""The Points panel: the table of source 000's Program 3, every origin and the gripper's points, to read and to copy."""

from __future__ import annotations

from typing import Any

import numpy as np
from PySide6.QtCore import QAbstractTableModel, QModelIndex, Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QHBoxLayout, QHeaderView, QLabel, QVBoxLayout, QWidget

from rvsim.gui.panels.copying import CopyButton
from rvsim.gui.panels.matrices import plain_digits, subscript
from rvsim.gui.panels.shown import ReadOutPanel
from rvsim.gui.panels.tables import LEFT, RIGHT, Index, dot, fit_height, plain_table, text_metrics
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Display, display, format_number, length_kind
from rvsim.gui.session import Session
from rvsim.gui.theme import set_role
from rvsim.lab.texts import matrix_latex, matrix_numpy, table_tsv
from rvsim.language import tr, tr_later, trn
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.scene.points import source_points

_AXES = ("x", "y", "z")
_TOP = QModelIndex()
_WIDEST = -8.888  # [m]
_BASE_COLOR = "#8b96a3"


def point_names(robot: Robot) -> list[str]:
    """What each row of `source_points` is: the origins O₀ … Oₙ of the frames, then the gripper's points; English."""
    origins = [f"O{subscript(i)}  {name}" for i, name in enumerate(("base", *robot.joint_names))]
    return [*origins, *(f"grip {i}" for i in range(1, _gripper_size(robot) + 1))]


def point_titles(robot: Robot) -> list[str]:
    """The same in the language that is spoken."""
    origins = [f"O{subscript(i)}  {tr(name)}" for i, name in enumerate((tr_later("base"), *robot.joint_names))]
    return [*origins, *(tr("grip {number}", number=i) for i in range(1, _gripper_size(robot) + 1))]


def point_colors(robot: Robot) -> list[str]:
    """The colour of each row: that of the joint before the frame, or of the gripper."""
    gripper = robot.gripper.color if robot.gripper is not None else ""
    return [_BASE_COLOR, *(joint.color for joint in robot.joints), *[gripper] * _gripper_size(robot)]


def _gripper_size(robot: Robot) -> int:
    return len(robot.gripper.points) if robot.gripper is not None else 0


class PointsModel(QAbstractTableModel):
    """Rows of a name and a point (3,) [m] in the user's unit."""

    def __init__(self, robot: Robot, preferences: Preferences, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._preferences = preferences
        self._take(robot, np.empty((0, 3)))

    def _take(self, robot: Robot, points: FloatArray) -> None:
        self._robot, self._points = robot, points
        self.names, self._titles, self._colors = point_names(robot), point_titles(robot), point_colors(robot)

    def show_points(self, robot: Robot, points: FloatArray) -> None:
        """Show the points (k, 3) of an arm."""
        if robot is not self._robot or len(points) != len(self._points):
            self.beginResetModel()
            self._take(robot, points)
            self.endResetModel()
            return
        self._points = points
        self.dataChanged.emit(self.index(0, 1), self.index(len(points) - 1, 3), [Qt.ItemDataRole.DisplayRole])
        self.headerDataChanged.emit(Qt.Orientation.Horizontal, 1, 3)

    @property
    def shown(self) -> Display:
        """How the lengths are shown."""
        return display(length_kind(self._robot), self._preferences)

    def shown_points(self) -> FloatArray:
        """(k, 3) in the unit that is shown, in full precision."""
        return self._points * self.shown.factor

    def rowCount(self, parent: Index = _TOP) -> int:
        """The number of points."""
        return 0 if parent.isValid() else len(self._points)

    def columnCount(self, parent: Index = _TOP) -> int:
        """The name, x, y, z."""
        return 0 if parent.isValid() else 4

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Names with the dot of their joint; numbers as text, right-aligned, and in full precision as tooltip."""
        row, column = index.row(), index.column()
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return LEFT if column == 0 else RIGHT
        if column == 0:
            return self._name_data(row, role)
        value = float(self._points[row, column - 1]) * self.shown.factor
        if role == Qt.ItemDataRole.DisplayRole:
            return format_number(value, self.shown.decimals)
        if role == Qt.ItemDataRole.ToolTipRole:
            number = f"{value:.12g}{self.shown.suffix}"
            return tr("{axis} of {point}: {number}", axis=_AXES[column - 1], point=self._titles[row], number=number)
        return None

    def _name_data(self, row: int, role: int) -> Any:
        if role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.ToolTipRole):
            return self._titles[row]
        if role == Qt.ItemDataRole.DecorationRole:
            return dot(self._colors[row])
        return None

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """The axes with their unit."""
        if orientation == Qt.Orientation.Vertical:
            return None
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return LEFT if section == 0 else RIGHT
        if role == Qt.ItemDataRole.DisplayRole:
            return f"{_AXES[section - 1]} {self.shown.suffix.strip()}" if section else tr("point")
        return None


class PointsPanel(ReadOutPanel):
    """The point table of the present pose."""

    def __init__(self, session: Session, preferences: Preferences, parent: QWidget | None = None) -> None:
        super().__init__(session, preferences, parent)
        self.setObjectName("points_panel")
        self.model = PointsModel(session.robot, preferences, self)
        self.table = plain_table("points_table", tr("Points of the arm"), self.model)
        self.table.setWordWrap(False)
        self.table.setTextElideMode(Qt.TextElideMode.ElideMiddle)  # joints of a wrist begin alike
        self.note = QLabel()
        formats = {tr_later("text"): self._as_text, "NumPy": self._as_numpy, "LaTeX": self._as_latex}
        self.copy = CopyButton("points_copy", tr("the point table"), formats, session)
        self._lay_out()
        shortcut = QShortcut(QKeySequence(QKeySequence.StandardKey.Copy), self.table)
        shortcut.setContext(Qt.ShortcutContext.WidgetShortcut)
        shortcut.activated.connect(lambda: self.copy.copy_as("text"))

    def _lay_out(self) -> None:
        for axis in (1, 2, 3):
            self.table.horizontalHeader().setSectionResizeMode(axis, QHeaderView.ResizeMode.Fixed)
        title = QLabel(tr("Points of the arm"))
        set_role(title, role="title")
        set_role(self.note, role="muted")
        self.note.setWordWrap(True)
        head = QHBoxLayout()
        head.addWidget(title, 1)
        head.addWidget(self.copy)
        column = QVBoxLayout(self)
        column.setContentsMargins(12, 8, 12, 12)
        column.setSpacing(6)
        column.addLayout(head)
        column.addWidget(self.table, 100)
        column.addWidget(self.note)
        column.addStretch(1)

    def refresh(self) -> None:
        """Show the points of the present pose."""
        robot = self._session.robot
        self.model.show_points(robot, source_points(robot, self._session.q))
        fit_height(self.table)
        self._fit_columns()
        text = _note(robot, self.model.rowCount())
        if self.note.text() != text:
            self.note.setText(text)

    def _fit_columns(self) -> None:
        """Wide enough for the longest number of such an arm, so that nothing jumps while it moves."""
        widest = format_number(_WIDEST * self.model.shown.factor, self.model.shown.decimals)
        width = text_metrics().horizontalAdvance(widest) + 9
        if width != self.table.columnWidth(1):
            for axis in (1, 2, 3):
                self.table.setColumnWidth(axis, width)

    def _as_text(self) -> str:
        unit = self.model.shown.suffix.strip()
        header = ["point", *(f"{axis} [{unit}]" for axis in _AXES)]
        rows = zip(self.model.names, self.model.shown_points(), strict=True)
        return table_tsv(header, ([_ascii(name), *map(float, point)] for name, point in rows))

    def _as_numpy(self) -> str:
        names = "\n".join(f"# row {i}: {_ascii(name)}" for i, name in enumerate(self.model.names))
        return f"# x, y, z [{self.model.shown.suffix.strip()}]\n{names}\n{matrix_numpy(self.model.shown_points())}"

    def _as_latex(self) -> str:
        return f"% x, y, z [{self.model.shown.suffix.strip()}]\n{matrix_latex(self.model.shown_points())}"


def _note(robot: Robot, points: int) -> str:
    if robot.name == "rv-m1":
        return trn(
            "{n} point × 3 coordinates: the table of source 000's Program 3; there in dm.",
            "{n} points × 3 coordinates: the table of source 000's Program 3; there in dm.",
            points,
        )
    return trn("{n} point × 3 coordinates: base coordinates.", "{n} points × 3 coordinates: base coordinates.", points)


def _ascii(name: str) -> str:
    return " ".join(plain_digits(name).split())
