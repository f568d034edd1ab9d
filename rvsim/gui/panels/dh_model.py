"""The DH table as a Qt model: one row a joint; two views show its DH columns and its limits."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from PySide6.QtCore import QAbstractTableModel, QModelIndex, Qt, Signal
from PySide6.QtGui import QFont, QGuiApplication
from PySide6.QtWidgets import QWidget

from rvsim.gui.panels.dh_cells import cell_kind, cell_text, cell_title, cell_value, edit_text, stepped, typed
from rvsim.gui.panels.tables import LEFT, RIGHT, Index, dot
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import display, format_quantity, length_kind
from rvsim.language import left_to_right, tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.edits import DH_KEYS, DHKey

_TOP = QModelIndex()


class Column(NamedTuple):
    """A column: its key, its header in either convention, and what the header's tooltip says; in English."""

    key: str
    standard: str
    modified: str
    tip: str


COLUMNS = (
    Column("number", "i", "i", tr_later("The joint's number")),
    Column(
        "type",
        tr_later("type"),
        tr_later("type"),
        tr_later("R: revolute, it turns about z; P: prismatic, it slides along z"),
    ),
    Column("theta", "θ", "θ", tr_later("Angle about z, from the x axis before to the x axis behind the joint")),
    Column("d", "d", "d", tr_later("Distance along z, between the two x axes")),
    Column("a", "a", "aᵢ₋₁", tr_later("Distance along x, between the two z axes")),
    Column("alpha", "α", "αᵢ₋₁", tr_later("Angle about x, between the two z axes")),
    Column("name", tr_later("joint"), tr_later("joint"), tr_later("The joint's name")),
    Column("lower", tr_later("lower"), tr_later("lower"), tr_later("The smallest q")),
    Column("upper", tr_later("upper"), tr_later("upper"), tr_later("The largest q")),
    Column("home", tr_later("home"), tr_later("home"), tr_later("q at home")),
)
DH_COLUMNS = ("number", "type", "theta", "d", "a", "alpha")
LIMIT_COLUMNS = ("name", "lower", "upper", "home")
_TYPES = {tr_later("revolute"): "R", tr_later("prismatic"): "P"}


def column_of_key(key: str) -> int:
    """The column of a key."""
    return next(index for index, column in enumerate(COLUMNS) if column.key == key)


class DHModel(QAbstractTableModel):
    """Shows an arm's rows; `edited(joint, key, value)` tells an SI value that has been typed, `refused` why not."""

    edited = Signal(int, str, float)
    refused = Signal(str)

    def __init__(self, robot: Robot, preferences: Preferences, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._robot, self._original, self._preferences = robot, robot, preferences

    def show_robot(self, robot: Robot, original: Robot) -> None:
        """Show an arm; what differs from the original is marked. Open editors survive if the joints are as many."""
        resets = robot.dof != self._robot.dof
        if resets:
            self.beginResetModel()
        self._robot, self._original = robot, original
        if resets:
            self.endResetModel()
        else:
            self.dataChanged.emit(self.index(0, 0), self.index(robot.dof - 1, len(COLUMNS) - 1))
        self.headerDataChanged.emit(Qt.Orientation.Horizontal, 0, len(COLUMNS) - 1)

    @property
    def robot(self) -> Robot:
        """The arm that is shown."""
        return self._robot

    @staticmethod
    def key(index: Index) -> DHKey | None:
        """The DH value in a cell, or None in a column that only names."""
        key = COLUMNS[index.column()].key
        return key if key in DH_KEYS else None

    def is_edited(self, joint: int, key: DHKey) -> bool:
        """Whether a cell differs from the arm that the edits began with."""
        return cell_value(self._robot, joint, key) != cell_value(self._original, joint, key)

    def problem(self, index: Index, text: str) -> str:
        """Why a text cannot be taken in a cell, or nothing."""
        key = self.key(index)
        return typed(self._robot, index.row(), key, text, self._preferences).problem if key else ""

    def step(self, index: Index, steps: float) -> bool:
        """Change a cell by some steps of the arrow keys."""
        key = self.key(index)
        value = stepped(self._robot, index.row(), key, steps, self._preferences) if key else None
        if key is None or value is None:
            return False
        shown = display(cell_kind(self._robot, index.row(), key), self._preferences)
        return self._take(index, key, f"{value * shown.factor:.12g}")

    # --- Qt's side -------------------------------------------------------------------------------------------------

    def rowCount(self, parent: Index = _TOP) -> int:
        """One row a joint."""
        return 0 if parent.isValid() else self._robot.dof

    def columnCount(self, parent: Index = _TOP) -> int:
        """All columns; each view hides some."""
        return 0 if parent.isValid() else len(COLUMNS)

    def flags(self, index: Index) -> Qt.ItemFlag:
        """DH values can be edited, names cannot."""
        flags = super().flags(index)
        return flags | Qt.ItemFlag.ItemIsEditable if index.isValid() and self.key(index) else flags

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """What stands in a cell."""
        key = self.key(index)
        if key is None:
            return self._name_data(index, role)
        joint = index.row()
        match role:
            case Qt.ItemDataRole.DisplayRole:
                return cell_text(self._robot, joint, key, self._preferences)
            case Qt.ItemDataRole.EditRole:
                return edit_text(self._robot, joint, key, self._preferences)
            case Qt.ItemDataRole.TextAlignmentRole:
                return RIGHT
            case Qt.ItemDataRole.FontRole:
                return self._font(joint, key)
            case Qt.ItemDataRole.ToolTipRole:
                return self._tip(joint, key)
        return None

    def setData(self, index: Index, value: Any, role: int = Qt.ItemDataRole.EditRole) -> bool:
        """Take a typed text: an expression in the shown unit, or "none" for a limit."""
        key = self.key(index)
        return role == Qt.ItemDataRole.EditRole and key is not None and self._take(index, key, str(value))

    def _take(self, index: Index, key: DHKey, text: str) -> bool:
        meant = typed(self._robot, index.row(), key, text, self._preferences)
        if meant.problem:
            self.refused.emit(meant.problem)
            return False
        if meant.value != cell_value(self._robot, index.row(), key):
            self.edited.emit(index.row(), key, meant.value)
        return True

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """The letters of the convention, lengths with their unit."""
        if orientation == Qt.Orientation.Vertical:
            return None
        column = COLUMNS[section]
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return RIGHT if column.key in DH_KEYS else LEFT
        if role == Qt.ItemDataRole.ToolTipRole:
            return tr(column.tip)
        if role == Qt.ItemDataRole.DisplayRole:
            text = tr(column.standard if self._robot.convention == "standard" else column.modified)
            unit = display(length_kind(self._robot), self._preferences).suffix.strip()
            return f"{text} {unit}" if column.key in ("d", "a") else text
        return None

    def _name_data(self, index: Index, role: int) -> Any:
        joint, key = self._robot.joints[index.row()], COLUMNS[index.column()].key
        if role == Qt.ItemDataRole.DecorationRole and key != "type":
            return dot(joint.color)
        if role == Qt.ItemDataRole.ToolTipRole:
            return f"{tr(joint.name)}{tr(', ')}{tr(joint.type)}"
        if role == Qt.ItemDataRole.DisplayRole:
            return {"number": str(index.row() + 1), "type": _TYPES[joint.type], "name": tr(joint.name)}[key]
        return LEFT if role == Qt.ItemDataRole.TextAlignmentRole else None

    def is_assumed(self, joint: int, key: DHKey) -> bool:
        """Whether no source gives the value."""
        row = self._robot.joints[joint]
        return row.limits_assumed if key in ("lower", "upper", "home") else row.dh_assumed

    def _font(self, joint: int, key: DHKey) -> QFont | None:
        edited, assumed = self.is_edited(joint, key), self.is_assumed(joint, key)
        if not edited and not assumed:
            return None
        font = QFont(QGuiApplication.font())
        font.setBold(edited)
        font.setItalic(assumed and not edited)
        return font

    def _tip(self, joint: int, key: DHKey) -> str:
        title = cell_title(self._robot, joint, key)
        full = edit_text(self._robot, joint, key, self._preferences)
        if math.isfinite(cell_value(self._robot, joint, key)):
            full = left_to_right(full + display(cell_kind(self._robot, joint, key), self._preferences).suffix)
        parts = [f"{title}: {full}."]
        if self.is_edited(joint, key):
            parts.append(tr("It was {original}.", original=self._original_text(joint, key)))
        elif self.is_assumed(joint, key):
            parts.append(tr("Assumed: no source gives it."))
        return " ".join([*parts, tr("Double-click or type to change it; arrow keys step while editing.")])

    def _original_text(self, joint: int, key: DHKey) -> str:
        value = cell_value(self._original, joint, key)
        if math.isinf(value):
            return tr("none")
        return format_quantity(value, cell_kind(self._original, joint, key), self._preferences)
