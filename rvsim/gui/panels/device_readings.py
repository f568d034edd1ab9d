"""The table of the Drive page: what is shown, what was sent and what came back, joint by joint."""

from __future__ import annotations

import math

from PySide6.QtCore import QAbstractTableModel, QModelIndex, Qt

from rvsim.device.driver.state import DriverState
from rvsim.gui.panels.tables import LEFT, RIGHT, Index, dot
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import format_quantity, joint_kind
from rvsim.language import tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

_COLUMNS = (tr_later("Joint"), tr_later("Shown"), tr_later("Sent"), tr_later("Measured"))
_TIPS = (
    tr_later("The joint; a moon where it sleeps"),
    tr_later("The pose in the window"),
    tr_later("Where the pulses that were sent should have brought it by now"),
    tr_later("What came back: see below what that is"),
)
_NONE = "–"
_BACK = 3  # the column of what came back
_Role = Qt.ItemDataRole


class ReadingsModel(QAbstractTableModel):
    """One row a joint; values are formatted when they are painted."""

    def __init__(self, preferences: Preferences) -> None:
        super().__init__()
        self._preferences = preferences
        self._robot: Robot | None = None
        self._rows: tuple[tuple[float, float, float], ...] = ()
        self._awake: tuple[bool, ...] = ()
        self._reported = True  # what came back is no measurement

    def show_readings(self, robot: Robot, q: FloatArray, state: DriverState | None) -> None:
        """Show what is now; without a device only the pose in the window."""
        nothing = [math.nan] * robot.dof
        sent = state.commanded_q.tolist() if state else nothing
        measured = state.measured_q.tolist() if state else nothing
        self._awake = state.awake if state else (False,) * robot.dof
        reported = state is None or state.measured_kind in ("nothing", "commanded pulse")
        if reported != self._reported:
            self._reported = reported
            self.headerDataChanged.emit(Qt.Orientation.Horizontal, _BACK, _BACK)
        rows = tuple(zip(q.tolist(), sent, measured, strict=True))
        if robot is not self._robot:
            self.beginResetModel()
            self._robot, self._rows = robot, rows
            self.endResetModel()
        else:
            self._rows = rows
            self.dataChanged.emit(self.index(0, 0), self.index(len(rows) - 1, len(_COLUMNS) - 1))

    def rowCount(self, _parent: Index = QModelIndex()) -> int:  # noqa: B008 (Qt's own signature)
        """A row a joint."""
        return len(self._rows)

    def columnCount(self, _parent: Index = QModelIndex()) -> int:  # noqa: B008
        """Joint, shown, sent, measured."""
        return len(_COLUMNS)

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = _Role.DisplayRole) -> object:
        """What stands below; the unit is beside each value."""
        if orientation != Qt.Orientation.Horizontal:
            return None
        if role == _Role.ToolTipRole:
            return tr(_TIPS[section])
        if role == _Role.TextAlignmentRole:
            return LEFT if section == 0 else RIGHT
        if role != _Role.DisplayRole:
            return None
        return tr("Reported") if section == _BACK and self._reported else tr(_COLUMNS[section])

    def data(self, index: Index, role: int = _Role.DisplayRole) -> object:
        """One cell."""
        if self._robot is None:
            return None
        row, column = index.row(), index.column()
        if role == _Role.TextAlignmentRole:
            return LEFT if column == 0 else RIGHT
        if column == 0:
            return self._name(row, role)
        value = self._rows[row][column - 1]
        if role == _Role.DisplayRole:
            return self._text(row, value)
        return None

    def _name(self, row: int, role: int) -> object:
        assert self._robot is not None
        joint, awake = self._robot.joints[row], self._awake[row]
        if role == _Role.DisplayRole:
            return f"J{row + 1} {tr(joint.name)}" + ("" if awake else " ☾")
        if role == _Role.DecorationRole:
            return dot(joint.color)
        if role == _Role.ToolTipRole:
            if awake:
                return tr("{joint}: awake", joint=tr(joint.name))
            return tr("{joint}: asleep: its servo has not been moved by rvsim yet", joint=tr(joint.name))
        return None

    def _text(self, row: int, value: float) -> str:
        assert self._robot is not None
        return (
            format_quantity(value, joint_kind(self._robot, row), self._preferences) if math.isfinite(value) else _NONE
        )
