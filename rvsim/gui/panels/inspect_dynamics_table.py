"""The parts of the joint torques as a table: gravity, Coriolis, inertia, and their sum."""

from __future__ import annotations

from typing import Any

import numpy as np
from PySide6.QtCore import QAbstractTableModel, QModelIndex, Qt
from PySide6.QtWidgets import QHeaderView, QTableView

from rvsim.gui.panels.tables import CELL_MARGIN, LEFT, RIGHT, Index, decimals_that_fit, dot, plain_table, text_metrics
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import display, format_number, torque_kind
from rvsim.language import left_to_right, tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_TOP = QModelIndex()
PARTS = (tr_later("gravity"), tr_later("Coriolis"), tr_later("inertia"), tr_later("sum τ"))
_SHORT = (tr_later("grav."), tr_later("Cor."), tr_later("inert."), tr_later("sum τ"))
_MORE = 1  # decimals: a small arm's parts are small
_TIPS = (
    tr_later("The joint"),
    tr_later("g(q): what holds the arm still"),
    tr_later("Coriolis and centrifugal: what the joints do to each other by moving"),
    tr_later("M(q) times the accelerations: what speeds it up"),
    tr_later("What the drive has to give, without friction"),
)


class PartsModel(QAbstractTableModel):
    """One row a joint; `values` (n, 4) [N m, N]."""

    def __init__(self, robot: Robot, preferences: Preferences) -> None:
        super().__init__()
        self._robot, self._preferences = robot, preferences
        self.values: FloatArray = np.zeros((robot.dof, len(PARTS)))
        self._rooms: dict[int, int] = {}  # column → pixels for its numbers
        self._decimals: tuple[int, ...] = ()

    def give_room(self, column: int, width: int) -> None:
        """A column is so wide [pixels]: decimals that would be cut are left out; the tooltips have them."""
        self._rooms[column] = width - CELL_MARGIN
        self._choose_decimals()

    def _room(self) -> int:
        """For the numbers of each part [pixels]."""
        return min((room for column, room in self._rooms.items() if column > 0), default=10_000)

    def _heads(self) -> tuple[str, ...]:
        """In words where there is room."""
        parts = [tr(part) for part in PARTS]
        widest = max(text_metrics().horizontalAdvance(part) for part in parts)
        return (tr("joint"), *(parts if widest <= self._room() else map(tr, _SHORT)))

    def _choose_decimals(self) -> None:
        wanted = [
            display(torque_kind(self._robot, i), self._preferences).decimals + _MORE for i in range(len(self.values))
        ]
        most = decimals_that_fit(self._texts, max(wanted, default=0), self._room())
        self._decimals = tuple(min(decimals, most) for decimals in wanted)

    def _texts(self, decimals: int) -> list[str]:
        """All cells with so many decimals."""
        joints, parts = range(len(self.values)), range(len(PARTS))
        return [self._text(joint, part, decimals) for joint in joints for part in parts]

    def show_values(self, robot: Robot, values: FloatArray) -> None:
        """Show these (n, 4) of an arm."""
        resets = robot is not self._robot
        if resets:
            self.beginResetModel()
        self._robot, self.values = robot, values
        self._choose_decimals()
        if resets:
            self.endResetModel()
        else:
            self.dataChanged.emit(self.index(0, 1), self.index(robot.dof - 1, len(PARTS)))

    def rowCount(self, parent: Index = _TOP) -> int:
        """One a joint."""
        return 0 if parent.isValid() else len(self.values)

    def columnCount(self, parent: Index = _TOP) -> int:
        """The joint and the parts."""
        return 0 if parent.isValid() else 1 + len(PARTS)

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """What stands in a cell."""
        joint, column = index.row(), index.column()
        match role:
            case Qt.ItemDataRole.DisplayRole:
                return f"J{joint + 1}" if column == 0 else self._text(joint, column - 1, self._decimals[joint])
            case Qt.ItemDataRole.TextAlignmentRole:
                return LEFT if column == 0 else RIGHT
            case Qt.ItemDataRole.DecorationRole:
                return dot(self._robot.joints[joint].color) if column == 0 else None
            case Qt.ItemDataRole.ToolTipRole:
                return self._tip(joint)
        return None

    def _text(self, joint: int, part: int, decimals: int) -> str:
        shown = display(torque_kind(self._robot, joint), self._preferences)
        text = format_number(float(self.values[joint, part]) * shown.factor, decimals)
        return text if len(set(self.units())) == 1 or part < len(PARTS) - 1 else text + shown.suffix

    def _tip(self, joint: int) -> str:
        unit = self.units()[joint]
        parts = zip(PARTS, self.values[joint].tolist(), strict=True)
        numbers = tr(", ").join(f"{tr(part)} {left_to_right(f'{value:.6g} {unit}')}" for part, value in parts)
        return f"{tr(self._robot.joint_names[joint])}: {numbers}"

    def units(self) -> list[str]:
        """The unit of each joint."""
        kinds = (torque_kind(self._robot, joint) for joint in range(self._robot.dof))
        return [display(kind, self._preferences).suffix.strip() for kind in kinds]

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """The parts; the unit stands above the sum where all joints share it."""
        if orientation == Qt.Orientation.Vertical:
            return None
        if role == Qt.ItemDataRole.DisplayRole:
            return self._heads()[section]
        if role == Qt.ItemDataRole.ToolTipRole:
            return tr(_TIPS[section])
        return {Qt.ItemDataRole.TextAlignmentRole: LEFT if section == 0 else RIGHT}.get(Qt.ItemDataRole(role))


def parts_table(model: PartsModel) -> QTableView:
    """The view of a model."""
    table = plain_table("dynamics_table", tr("Joint torques by their cause"), model)
    table.setSelectionMode(QTableView.SelectionMode.NoSelection)
    table.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    table.horizontalHeader().setSectionResizeMode(0, QHeaderView.ResizeMode.ResizeToContents)
    table.horizontalHeader().sectionResized.connect(lambda column, _, width: model.give_room(column, width))
    return table
