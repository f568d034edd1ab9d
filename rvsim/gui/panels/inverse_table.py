"""The table of branches: one row each, with its joints, its verdict, and how good and how far it is."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from PySide6.QtCore import QAbstractTableModel, QEvent, QModelIndex, QSortFilterProxyModel, Qt, Signal
from PySide6.QtGui import QFont, QFontMetrics, QGuiApplication, QKeyEvent, QPainter, QPalette
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTableView,
    QWidget,
)

from rvsim.gui.branch_words import circled, limit_words, margin_words, worst_limit_words
from rvsim.gui.panels.tables import LEFT, RIGHT, Index, text_metrics
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import (
    Kind,
    display,
    format_number,
    format_quantity,
    format_scientific,
    joint_kind,
)
from rvsim.kinematics import Branch
from rvsim.robot import Robot

SORT_ROLE = Qt.ItemDataRole.UserRole
NAME_ROLE = Qt.ItemDataRole.UserRole + 1
CELL_ROLE = Qt.ItemDataRole.UserRole + 2  # all that a number is painted with, in one question
_TOP = QModelIndex()
_HERE = 1e-6  # [rad, m] a branch so close is where the arm is
# Texts as long as any that comes, so that columns stand still; a title may take two lines.
_WIDEST = {
    "branch": "shoulder stops at 100.0°",
    "limits": "shoulder −156.7° stops at",
    "residual": "8.8e−88",
    "margin": "−888.8°",
    "moves": "−888.8°",
}
_WIDEST_TITLE = "wrist no-flip, elbow up"
_CONTINUUM = "One of infinitely many: a joint may take any value here."


class Row(NamedTuple):
    """A branch under its name; `usable` says whether the arm may go there."""

    name: str
    branch: Branch
    usable: bool
    note: str = ""

    @property
    def here(self) -> bool:
        """Whether the arm stands there."""
        return self.branch.distance < _HERE


class _Cell(NamedTuple):
    """A number as it is painted."""

    text: str
    usable: bool
    here: bool


class Column(NamedTuple):
    """A column: its head, its tip, the text of a row and the number by which rows are sorted."""

    head: str
    tip: str
    text: Callable[[Row], str]
    value: Callable[[Row], float | str]
    left: bool = False


def columns_of(robot: Robot, preferences: Preferences) -> tuple[Column, ...]:
    """The columns for an arm: the branch, its joints, and its verdict."""

    def branch(row: Row) -> str:
        stop = "" if row.branch.within_limits else f"\n{worst_limit_words(robot, row.branch, preferences)}"
        return _title(row) + stop

    first = Column("branch", "The branch, in the field's words", branch, lambda row: row.name, left=True)
    joints = (_joint_column(robot, joint, preferences) for joint in range(robot.dof))
    return (first, *joints, *_verdict_columns(robot, preferences))


def _title(row: Row) -> str:
    endless = " ∞" if row.branch.continuum else ""
    return f"{circled(row.name)} {row.branch.label}{endless}"


def _joint_column(robot: Robot, joint: int, preferences: Preferences) -> Column:
    shown = display(joint_kind(robot, joint), preferences)
    return Column(
        f"J{joint + 1} {shown.suffix.strip()}",
        f"{robot.joint_names[joint]} [{shown.suffix.strip()}]",
        lambda row: format_number(float(row.branch.q[joint]) * shown.factor, shown.decimals),
        lambda row: float(row.branch.q[joint]),
    )


def _verdict_columns(robot: Robot, preferences: Preferences) -> tuple[Column, ...]:
    def of_joint(values: np.ndarray, joint: int) -> str:
        return format_quantity(float(values[joint]), joint_kind(robot, joint), preferences).replace("inf", "∞")

    def verdict(row: Row) -> str:
        return "within" if row.branch.within_limits else limit_words(robot, row.branch, preferences, "\n")

    return (
        Column("limits", "Whether every joint is within its limits, or which is not", verdict, _outside, left=True),
        Column(
            "margin",
            "How far the joint nearest to a limit is from it; negative outside",
            lambda row: of_joint(row.branch.limit_margin, int(np.argmin(row.branch.limit_margin))),
            lambda row: float(row.branch.limit_margin.min()),
        ),
        Column(
            "moves",
            "The largest joint motion from where the arm is",
            lambda row: _distance_text(robot, row.branch, preferences),
            lambda row: row.branch.distance,
        ),
        Column(
            "w",
            "Manipulability √det(JJᵀ): 0 at a singular pose",
            lambda row: f"{row.branch.manipulability:.4f}",
            lambda row: row.branch.manipulability,
        ),
        Column(
            "residual",
            "The largest entry of |FK(q) − T| that was asked for",
            lambda row: format_scientific(row.branch.residual),
            lambda row: row.branch.residual,
        ),
    )


def _outside(row: Row) -> float:
    return -min(float(row.branch.limit_margin.min()), 0.0)


def _distance_text(robot: Robot, branch: Branch, preferences: Preferences) -> str:
    # Of an arm with both kinds of joints only the number is known, not which joint it is: radians count as metres.
    kinds: set[Kind] = {joint_kind(robot, joint) for joint in range(robot.dof)}
    if len(kinds) == 1:
        return format_quantity(branch.distance, kinds.pop(), preferences)
    return format_number(branch.distance, 3)


def _looks(row: Row) -> tuple[object, ...]:
    """What a title's cell shows, and how."""
    broken = int(np.argmin(row.branch.limit_margin)) if not row.branch.within_limits else -1
    return row.name, row.branch.label, row.branch.continuum, broken, row.usable, row.here


class BranchModel(QAbstractTableModel):
    """Rows of branches, best first."""

    def __init__(self, robot: Robot, preferences: Preferences, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._preferences = preferences
        self._robot = robot
        self.rows: tuple[Row, ...] = ()
        self.columns = columns_of(robot, preferences)

    def show_robot(self, robot: Robot) -> None:
        """Another arm, or other units: other columns."""
        self.beginResetModel()
        self._robot, self.rows = robot, ()
        self.columns = columns_of(robot, self._preferences)
        self.endResetModel()

    def show_rows(self, rows: tuple[Row, ...]) -> None:
        """Show other branches of the same arm."""
        if len(rows) != len(self.rows):
            self.beginResetModel()
            self.rows = rows
            self.endResetModel()
            return
        before, self.rows = self.rows, rows
        if rows:
            # The titles take longest to lay out, and change least.
            first = int(all(_looks(old) == _looks(new) for old, new in zip(before, rows, strict=True)))
            self.dataChanged.emit(self.index(0, first), self.index(len(rows) - 1, len(self.columns) - 1))

    def rowCount(self, parent: Index = _TOP) -> int:
        """The number of branches."""
        return 0 if parent.isValid() else len(self.rows)

    def columnCount(self, parent: Index = _TOP) -> int:
        """The branch, its joints, its verdict."""
        return 0 if parent.isValid() else len(self.columns)

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Texts, the numbers to sort by, and the looks: muted outside the limits, bold where the arm is."""
        row, column = self.rows[index.row()], self.columns[index.column()]
        if role == Qt.ItemDataRole.DisplayRole:
            return column.text(row)
        if role == CELL_ROLE:
            return _Cell(column.text(row), row.usable, row.here)
        if role == SORT_ROLE:
            return column.value(row)
        if role == NAME_ROLE:
            return row.name
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return LEFT if column.left else RIGHT
        if role == Qt.ItemDataRole.ForegroundRole and not row.usable:
            return QGuiApplication.palette().brush(QPalette.ColorRole.PlaceholderText)
        if role == Qt.ItemDataRole.FontRole and row.here:
            return _bold()
        if role in (Qt.ItemDataRole.ToolTipRole, Qt.ItemDataRole.AccessibleTextRole):
            return self._words(row)
        return None

    def _words(self, row: Row) -> str:
        """The whole verdict of a branch, for tip and screen reader."""
        branch = row.branch
        limits = limit_words(self._robot, branch, self._preferences) or (
            f"within limits, {margin_words(self._robot, branch, self._preferences)}"
        )
        here = "the arm is here" if row.here else f"moves {_distance_text(self._robot, branch, self._preferences)}"
        parts = (f"{_title(row)}: {limits}", here, f"w = {branch.manipulability:.4f}")
        endless = f" {_CONTINUUM}" if branch.continuum else ""
        return f"{', '.join(parts)}, residual {format_scientific(branch.residual)}.{endless} {row.note}".rstrip()

    def words_of(self, name: str | None) -> str:
        """The whole verdict of the branch of that name, or of the only row; nothing if there is no such branch."""
        lit = [row for row in self.rows if row.name == name or row.note]
        return self._words(lit[0]) if lit else ""

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Heads with units."""
        if orientation == Qt.Orientation.Vertical:
            return None
        column = self.columns[section]
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return LEFT if column.left else RIGHT
        return {Qt.ItemDataRole.DisplayRole: column.head, Qt.ItemDataRole.ToolTipRole: column.tip}.get(
            Qt.ItemDataRole(role)
        )


def _bold() -> QFont:
    font = QFont(QGuiApplication.font())
    font.setWeight(QFont.Weight.DemiBold)
    return font


class _NumberDelegate(QStyledItemDelegate):
    """Paints a number as text alone: the style sheet's way takes ten times as long."""

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """The text at the right, on the ground of the selection where it is."""
        view: Any = option  # its fields are known to no type checker
        chosen = bool(view.state & QStyle.StateFlag.State_Selected)
        if chosen:
            painter.fillRect(view.rect, view.palette.highlight())
        cell: _Cell = index.data(CELL_ROLE)
        roles = QPalette.ColorRole
        usual = roles.Text if cell.usable else roles.PlaceholderText
        painter.setPen(view.palette.color(roles.HighlightedText if chosen else usual))
        painter.setFont(_bold() if cell.here else view.font)
        painter.drawText(view.rect.adjusted(4, 0, -5, 0), RIGHT, cell.text)


class BranchTable(QTableView):
    """Shows a `BranchModel`, sortable.

    Signals:
        lit(name or None): the pointer or the keyboard is on that branch.
        chosen(row): a branch was clicked, or Enter pressed on it.
    """

    lit = Signal(object)
    chosen = Signal(object)

    def __init__(self, model: BranchModel, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("branch_table")
        self.setAccessibleName("Branches")
        self.branches = model
        self._sorted = QSortFilterProxyModel(self)
        self._sorted.setSourceModel(model)
        self._sorted.setSortRole(SORT_ROLE)
        self.setModel(self._sorted)
        self._dress()
        self._texts, self._numbers = QStyledItemDelegate(self), _NumberDelegate(self)
        self.setSortingEnabled(True)
        self.horizontalHeader().setSortIndicatorClearable(True)
        self.sortByColumn(-1, Qt.SortOrder.AscendingOrder)
        self.setMouseTracking(True)
        self.entered.connect(lambda index: self.lit.emit(index.data(NAME_ROLE)))
        self.clicked.connect(self._choose)
        self.selectionModel().currentChanged.connect(lambda index, _: self.lit.emit(index.data(NAME_ROLE)))
        model.modelReset.connect(self.fit_columns)
        model.dataChanged.connect(lambda start, *_: self._fit_rows() if start.column() == 0 else None)

    def _dress(self) -> None:
        self.setShowGrid(False)
        self.setAlternatingRowColors(True)
        self.setWordWrap(True)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setHorizontalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.setVerticalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.setTabKeyNavigation(False)
        self.verticalHeader().hide()
        self.verticalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        self.horizontalHeader().setHighlightSections(False)
        self.horizontalHeader().setMinimumSectionSize(24)

    def fit_columns(self) -> None:
        """Widths for the longest text that can come, so that nothing jumps while the arm moves."""
        metrics = text_metrics()
        for index, column in enumerate(self.branches.columns):
            widest = _WIDEST.get(column.head, "−888.8")
            width = max(metrics.horizontalAdvance(text) for text in (widest, f"{column.head} ▾"))
            # The row where the arm stands is bold.
            bold = _WIDEST_TITLE if index == 0 else widest
            width = max(width, QFontMetrics(_bold()).horizontalAdvance(bold) + 2)
            self.setColumnWidth(index, width + 8)
            self.setItemDelegateForColumn(index, self._texts if column.left else self._numbers)
        self._fit_rows()

    def _fit_rows(self) -> None:
        """High enough for a branch on two lines, where it needs them, and for the limit that it breaks."""
        metrics, room = QFontMetrics(_bold()), self.columnWidth(0) - 12
        titles = [metrics.horizontalAdvance(_title(row)) for row in self.branches.rows]
        lines = 1 + any(width > room for width in titles)
        lines += any(not row.branch.within_limits for row in self.branches.rows)
        height = max(lines, 2) * metrics.height() + 6
        if height != self.verticalHeader().defaultSectionSize():
            self.verticalHeader().setDefaultSectionSize(height)

    def _choose(self, index: QModelIndex) -> None:
        if index.isValid():
            self.chosen.emit(self.branches.rows[self._sorted.mapToSource(index).row()])

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter goes to the branch."""
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self._choose(self.currentIndex())
        else:
            super().keyPressEvent(event)

    def leaveEvent(self, event: QEvent) -> None:
        """No branch is lit any more."""
        super().leaveEvent(event)
        self.lit.emit(None)

    def changeEvent(self, event: QEvent) -> None:
        """Another font needs other widths."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self.fit_columns()
