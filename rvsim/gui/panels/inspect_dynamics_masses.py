"""The mass data as two tables, to be typed into: masses with their centres, and moments of inertia."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

from PySide6.QtCore import QAbstractTableModel, QModelIndex, Qt, Signal
from PySide6.QtGui import QFont, QGuiApplication
from PySide6.QtWidgets import QHeaderView, QTableView

from rvsim.errors import ExpressionError
from rvsim.expressions import evaluate_in
from rvsim.gui.panels.number_cells import make_editable
from rvsim.gui.panels.tables import CELL_MARGIN, LEFT, RIGHT, Index, decimals_that_fit, dot, plain_table, text_metrics
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Display, Kind, display, format_number, length_kind, without_unit
from rvsim.language import left_to_right, tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.mass_edits import MassKey, mass_value
from rvsim.robot.robot import LinkMass

_TOP = QModelIndex()


class MassColumn(NamedTuple):
    """A column: its key, header, and what its tooltip says."""

    key: MassKey
    head: str
    tip: str


COLUMNS = (
    MassColumn("mass", "m", tr_later("Mass of the link")),
    MassColumn("x", "x", tr_later("x of the centre of mass, in the link's DH frame")),
    MassColumn("y", "y", tr_later("y of the centre of mass, in the link's DH frame")),
    MassColumn("z", "z", tr_later("z of the centre of mass, in the link's DH frame")),
    MassColumn("xx", "Ixx", tr_later("Moment of inertia about the centre of mass and the link's x axis")),
    MassColumn("yy", "Iyy", tr_later("Moment of inertia about the centre of mass and the link's y axis")),
    MassColumn("zz", "Izz", tr_later("Moment of inertia about the centre of mass and the link's z axis")),
)
CENTER_COLUMNS, INERTIA_COLUMNS = range(1, 5), range(5, 8)


def mass_kind(robot: Robot, key: MassKey) -> Kind:
    """What a number of a link is shown as."""
    if key == "mass":
        return "mass"
    return length_kind(robot) if len(key) == 1 else "inertia"


def is_unsaid(link: LinkMass, key: MassKey) -> bool:
    """Whether a moment of inertia is 0 only because the source of the link's mass does not give it."""
    return len(key) == 2 and bool(link.source) and not link.assumed and mass_value(link, key) == 0.0


class MassModel(QAbstractTableModel):
    """One row a link; `edited(link, key, value)` tells an SI value that has been typed, `refused` why not."""

    edited = Signal(int, str, float)
    refused = Signal(str)

    def __init__(self, robot: Robot, preferences: Preferences) -> None:
        super().__init__()
        self._robot, self._preferences = robot, preferences
        self._rooms: dict[int, int] = {}  # column → pixels for its numbers

    def give_room(self, column: int, width: int) -> None:
        """A column is so wide [pixels]: decimals that would be cut are left out; tooltips and editors have them."""
        if width > 0:  # it is not one that is hidden
            self._rooms[column] = width - CELL_MARGIN

    def show_robot(self, robot: Robot) -> None:
        """Show the masses of an arm; open editors survive if the links are as many."""
        resets = robot.dof != self._robot.dof
        if resets:
            self.beginResetModel()
        self._robot = robot
        if resets:
            self.endResetModel()
        else:
            self.dataChanged.emit(self.index(0, 0), self.index(robot.dof - 1, len(COLUMNS)))
        self.headerDataChanged.emit(Qt.Orientation.Horizontal, 0, len(COLUMNS))

    def rowCount(self, parent: Index = _TOP) -> int:
        """One a link."""
        return 0 if parent.isValid() else self._robot.dof

    def columnCount(self, parent: Index = _TOP) -> int:
        """The link and its numbers."""
        return 0 if parent.isValid() else 1 + len(COLUMNS)

    def flags(self, index: Index) -> Qt.ItemFlag:
        """Numbers can be edited, names cannot."""
        flags = super().flags(index)
        return flags | Qt.ItemFlag.ItemIsEditable if index.isValid() and index.column() > 0 else flags

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """What stands in a cell."""
        joint, column = self._robot.joints[index.row()], index.column()
        match role:
            case Qt.ItemDataRole.DisplayRole | Qt.ItemDataRole.EditRole:
                return f"J{index.row() + 1}" if column == 0 else self._text(index, role == Qt.ItemDataRole.EditRole)
            case Qt.ItemDataRole.TextAlignmentRole:
                return LEFT if column == 0 else RIGHT
            case Qt.ItemDataRole.DecorationRole:
                return dot(joint.color) if column == 0 else None
            case Qt.ItemDataRole.FontRole:
                return self._font(index) if column > 0 else None
            case Qt.ItemDataRole.ToolTipRole:
                return self._tip(index)
        return None

    def _text(self, index: Index, whole: bool) -> str:
        if not self._robot.masses:
            return "0" if whole else "\u2013"
        link, column = index.row(), index.column()
        if whole:
            return f"{mass_value(self._robot.masses[link], COLUMNS[column - 1].key) * self._shown(column).factor:.12g}"
        return self._number(link, column, self._decimals(column))

    def _decimals(self, column: int) -> int:
        """With how many the numbers of a column fit."""
        decimals, links = self._shown(column).decimals, range(self._robot.dof)
        if column not in self._rooms:
            return decimals
        return decimals_that_fit(
            lambda fewer: (self._number(link, column, fewer) for link in links), decimals, self._rooms[column]
        )

    def _number(self, link: int, column: int, decimals: int) -> str:
        """As it is shown with so many decimals."""
        mass, key = self._robot.masses[link] if self._robot.masses else None, COLUMNS[column - 1].key
        if mass is None or is_unsaid(mass, key):
            return "\u2013"
        return format_number(mass_value(mass, key) * self._shown(column).factor, decimals)

    def _shown(self, column: int) -> Display:
        return display(mass_kind(self._robot, COLUMNS[column - 1].key), self._preferences)

    def _font(self, index: Index) -> QFont | None:
        masses = self._robot.masses
        if not masses or not masses[index.row()].assumed:
            return None
        font = QFont(QGuiApplication.font())
        font.setItalic(True)
        return font

    def _tip(self, index: Index) -> str:
        name = tr("The link behind “{joint}”", joint=tr(self._robot.joint_names[index.row()]))
        if not self._robot.masses:
            return tr("{link}: nothing is known. Double-click or type to enter a number.", link=name)
        link = self._robot.masses[index.row()]
        if is_unsaid(link, COLUMNS[index.column() - 1].key):
            return tr("{link}: not in the source ({source}), taken as 0.", link=name, source=tr(link.source))
        if index.column() > 0:
            number = self._text(index, whole=True).replace("-", "\u2212")
            name = f"{name}: {left_to_right(number + self._shown(index.column()).suffix)}"
        source = tr(link.source) or tr("its robot file")
        origin = tr("Assumed: {source}.", source=source) if link.assumed else tr("From: {source}.", source=source)
        return f"{name}. {origin}"

    def setData(self, index: Index, value: Any, role: int = Qt.ItemDataRole.EditRole) -> bool:
        """Take a typed text: a number or an expression in the shown unit."""
        if role != Qt.ItemDataRole.EditRole or index.column() == 0:
            return False
        text, shown = str(value), self._shown(index.column())
        if text == self._text(index, whole=True):
            return True
        try:
            unit = shown.suffix.strip() if len(COLUMNS[index.column() - 1].key) == 1 else ""
            number = evaluate_in(unit, without_unit(text, shown.suffix)) / shown.factor
        except ExpressionError as problem:
            self.refused.emit(str(problem))
            return False
        self.edited.emit(index.row(), COLUMNS[index.column() - 1].key, number)
        return True

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Letters with their units."""
        if orientation == Qt.Orientation.Vertical:
            return None
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return LEFT if section == 0 else RIGHT
        if role == Qt.ItemDataRole.ToolTipRole:
            return tr("The link behind that joint") if section == 0 else tr(COLUMNS[section - 1].tip)
        if role != Qt.ItemDataRole.DisplayRole:
            return None
        if section == 0:
            return tr("link")
        column = COLUMNS[section - 1]
        unit = self._shown(section).suffix.strip()
        one_line = f"{column.head} {unit}"
        fits = text_metrics().horizontalAdvance(one_line) <= self._rooms.get(section, 10_000)
        return one_line if fits else f"{column.head}\n{unit}"


def mass_table(name: str, title: str, model: MassModel, columns: Iterable[int]) -> QTableView:
    """A view of some columns of the model."""
    table = plain_table(name, title, model)
    shown = {0, *columns}
    for column in range(1 + len(COLUMNS)):
        table.setColumnHidden(column, column not in shown)
    table.horizontalHeader().setSectionResizeMode(0, QHeaderView.ResizeMode.ResizeToContents)
    make_editable(table, "mass_cell_editor")
    table.horizontalHeader().sectionResized.connect(lambda column, _, width: model.give_room(column, width))
    return table
