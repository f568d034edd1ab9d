"""The table of branches: one row each, with its name, its joints, and the limit that it breaks.

The model knows the whole verdict; the view shows what has room beside the scene. The rest is in the tip and in the
line below the table, and the header's menu sorts by it.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from PySide6.QtCore import QAbstractTableModel, QEvent, QModelIndex, QRect, QSortFilterProxyModel, Qt, Signal
from PySide6.QtGui import (
    QAction,
    QFontMetrics,
    QGuiApplication,
    QKeyEvent,
    QPainter,
    QPaintEvent,
    QPalette,
    QResizeEvent,
)
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableView, QWidget

from rvsim.gui.branch_words import broken_joints, circled, limit_words, margin_words, short_limit_words
from rvsim.gui.panels.inverse_rows import PAD, GroundDelegate, RowInk, RowText, row_color
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
from rvsim.gui.target_solution import label_title
from rvsim.kinematics import Branch
from rvsim.language import left_to_right, tr, tr_later
from rvsim.robot import Robot

SORT_ROLE = Qt.ItemDataRole.UserRole
NAME_ROLE = Qt.ItemDataRole.UserRole + 1
_TOP = QModelIndex()
_HERE = 1e-6  # [rad, m] a branch so close is where the arm is
_HEAD_PADDING = 13  # of the style sheet, both sides together
_SORT = tr_later("Click to sort; the menu of the right button sorts by more")
_CONTINUUM = tr_later("∞: one of infinitely many, for a joint, or the tool's orientation, may take any value here.")


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


class Column(NamedTuple):
    """A column: its head, its tip, the text of a row and the number by which rows are sorted.

    `widest` is a text as long as any that comes, so that columns stand still; none in a column that is not shown.
    """

    head: str
    tip: str
    text: Callable[[Row], str]
    value: Callable[[Row], float | str]
    widest: str = ""
    left: bool = False


def columns_of(robot: Robot, preferences: Preferences) -> tuple[Column, ...]:
    """The columns for an arm: the branch, its joints, and its verdict."""

    def branch(row: Row) -> str:
        stop = "" if row.branch.within_limits else f"\n{short_limit_words(robot, row.branch, preferences)}"
        return _title(row) + stop

    first = Column(
        "#", f"{tr('The number of the branch, as in the scene.')} {tr(_SORT)}", branch, lambda row: row.name, "⑧"
    )
    joints = (_joint_column(robot, joint, preferences) for joint in range(robot.dof))
    return (first, *joints, *_verdict_columns(robot, preferences))


def _title(row: Row) -> str:
    endless = " ∞" if row.branch.continuum else ""
    return f"{circled(row.name)} {label_title(row.branch.label)}{endless}"


def _joint_column(robot: Robot, joint: int, preferences: Preferences) -> Column:
    shown = display(joint_kind(robot, joint), preferences)
    return Column(
        left_to_right(f"J{joint + 1} {shown.suffix.strip()}"),
        f"{tr(robot.joint_names[joint])} [{shown.suffix.strip()}]. {tr(_SORT)}",
        lambda row: format_number(float(row.branch.q[joint]) * shown.factor, shown.decimals),
        lambda row: float(row.branch.q[joint]),
        format_number(-888.8 if shown.factor > 1.0 else -8.8888, shown.decimals),
    )


def _verdict_columns(robot: Robot, preferences: Preferences) -> tuple[Column, ...]:
    def of_joint(values: np.ndarray, joint: int) -> str:
        return format_quantity(float(values[joint]), joint_kind(robot, joint), preferences).replace("inf", "∞")

    def verdict(row: Row) -> str:
        return tr("within") if row.branch.within_limits else limit_words(robot, row.branch, preferences, "\n")

    return (
        Column(
            tr("limits"), tr("Whether every joint is within its limits, or which is not"), verdict, _outside, left=True
        ),
        Column(
            tr("margin"),
            tr("How far the joint nearest to a limit is from it; negative outside"),
            lambda row: of_joint(row.branch.limit_margin, int(np.argmin(row.branch.limit_margin))),
            lambda row: float(row.branch.limit_margin.min()),
        ),
        Column(
            tr("moves"),
            tr("The largest joint motion from where the arm is"),
            lambda row: _distance_text(robot, row.branch, preferences),
            lambda row: row.branch.distance,
        ),
        Column(
            "w",
            tr("Manipulability √det(JJᵀ): 0 at a singular pose"),
            lambda row: f"{row.branch.manipulability:.4f}",
            lambda row: row.branch.manipulability,
        ),
        Column(
            tr("residual"),
            tr("The largest entry of |FK(q) − T| that was asked for"),
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
    broken = tuple(broken_joints(row.branch).tolist())
    return row.name, row.branch.label, row.branch.continuum, broken, row.usable, row.here


class BranchModel(QAbstractTableModel):
    """Rows of branches, best first. `columns_changed()`: another arm, or other units."""

    columns_changed = Signal()

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
        self.columns_changed.emit()

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

    @property
    def joints(self) -> int:
        """How many columns of joints there are."""
        return self._robot.dof

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
        if role == SORT_ROLE:
            return column.value(row)
        if role == NAME_ROLE:
            return row.name
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return LEFT if column.left else RIGHT
        if role == Qt.ItemDataRole.ForegroundRole and not row.usable:
            return QGuiApplication.palette().brush(QPalette.ColorRole.PlaceholderText)
        if role == Qt.ItemDataRole.FontRole and row.here:
            return RowInk().bold
        if role in (Qt.ItemDataRole.ToolTipRole, Qt.ItemDataRole.AccessibleTextRole):
            return self._words(row)
        return None

    def _words(self, row: Row) -> str:
        """The whole verdict of a branch, for tip and screen reader."""
        branch = row.branch
        limits = limit_words(self._robot, branch, self._preferences) or (
            tr("within limits, {margin}", margin=margin_words(self._robot, branch, self._preferences))
        )
        distance = _distance_text(self._robot, branch, self._preferences)
        parts = (
            f"{_title(row)}: {limits}",
            tr("the arm is here") if row.here else tr("moves {distance}", distance=distance),
            left_to_right(f"w = {branch.manipulability:.4f}"),
            tr("residual {number}", number=format_scientific(branch.residual)),
        )
        sentences = (f"{tr(', ').join(parts)}.", tr(_CONTINUUM) if branch.continuum else "", row.note)
        return " ".join(sentence for sentence in sentences if sentence)

    def text_of(self, row: Row) -> RowText:
        """What is written in a row that is seen."""
        endless = " ∞" if row.branch.continuum else ""
        stop = "" if row.branch.within_limits else short_limit_words(self._robot, row.branch, self._preferences)
        numbers = tuple(column.text(row) for column in self.columns[1 : 1 + self._robot.dof])
        return RowText(circled(row.name), label_title(row.branch.label) + endless, stop, numbers, row.usable, row.here)

    def words_of(self, name: str | None) -> str:
        """The whole verdict of the branch of that name, else of the one where the arm is, or of the only row."""
        lit = [row for row in self.rows if row.name == name]
        shown = lit or [row for row in self.rows if row.here or row.note]
        return self._words(shown[0]) if shown else ""

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
        self.setLayoutDirection(Qt.LayoutDirection.LeftToRight)  # numbers, in any language
        self.setAccessibleName(tr("Branches"))
        self.branches = model
        self._sorted = QSortFilterProxyModel(self)
        self._sorted.setSourceModel(model)
        self._sorted.setSortRole(SORT_ROLE)
        self.setModel(self._sorted)
        self._dress()
        self.setItemDelegate(GroundDelegate(self))
        self._ink = RowInk()
        self.setSortingEnabled(True)
        self.horizontalHeader().setSortIndicatorClearable(True)
        self.sortByColumn(-1, Qt.SortOrder.AscendingOrder)
        self.setMouseTracking(True)
        self.entered.connect(lambda index: self.lit.emit(index.data(NAME_ROLE)))
        self.clicked.connect(self._choose)
        self.selectionModel().currentChanged.connect(lambda index, _: self.lit.emit(index.data(NAME_ROLE)))
        model.modelReset.connect(self.fit_columns)
        model.columns_changed.connect(self._offer_orders)
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
        self.horizontalHeader().setMinimumSectionSize(8)
        self.horizontalHeader().setContextMenuPolicy(Qt.ContextMenuPolicy.ActionsContextMenu)

    def fit_columns(self) -> None:
        """Joints in equal columns over the whole width: narrow, they are written smaller before they scroll."""
        columns = self.branches.columns
        shown = [index for index, column in enumerate(columns) if column.widest]
        for index in range(len(columns)):
            self.setColumnHidden(index, index not in shown)
        joints, widest = shown[1:], max((columns[index].widest for index in shown[1:]), key=len)
        name = text_metrics().horizontalAdvance("#") + _HEAD_PADDING
        width = self.viewport().width()
        room = (width - name) // len(joints)
        self._ink = RowInk(widest, room - PAD - 1)
        least = QFontMetrics(self._ink.small).horizontalAdvance(widest) + PAD + 1
        bar = Qt.ScrollBarPolicy.ScrollBarAsNeeded if least > room else Qt.ScrollBarPolicy.ScrollBarAlwaysOff
        self.setHorizontalScrollBarPolicy(bar)
        for index in shown:
            self.setColumnWidth(index, max(room, least) if index in joints else name)
        self._fit_rows()
        if self.viewport().width() != width:  # higher rows brought a scroll bar
            self.fit_columns()

    def _fit_rows(self) -> None:
        """High enough for the title and the joints, and for a limit that has no room beside the title."""
        room = self.viewport().width() - self.columnWidth(0) - PAD
        texts = map(self.branches.text_of, self.branches.rows)
        lines = 2 if all(self._ink.fits_beside(text, room) for text in texts) else 3
        height = lines * self._ink.line + 6
        if height != self.verticalHeader().defaultSectionSize():
            self.verticalHeader().setDefaultSectionSize(height)

    def _offer_orders(self) -> None:
        """The header's menu sorts by what is shown and by what is not."""
        header = self.horizontalHeader()
        for action in header.actions():
            action.deleteLater()
        heads = {-1: tr("Best first")} | {
            i: tr("Sort by {head}", head=column.head) for i, column in enumerate(self.branches.columns)
        }
        for index, text in heads.items():
            action = QAction(text, header)
            action.triggered.connect(partial(self._sort, index))
            header.addAction(action)

    def _sort(self, column: int, _checked: bool = False) -> None:
        self.sortByColumn(column, Qt.SortOrder.AscendingOrder)

    def paintEvent(self, event: QPaintEvent) -> None:
        """The grounds, and the texts of the rows that are seen upon them."""
        super().paintEvent(event)
        if not self.branches.rows:
            return
        painter, seen = QPainter(self.viewport()), event.rect()
        width = self.viewport().width()
        ends = [self.columnViewportPosition(i) + self.columnWidth(i) for i in range(1 + self.branches.joints)]
        chosen = {index.row() for index in self.selectionModel().selectedRows()}
        for row in range(len(self.branches.rows)):
            rect = QRect(0, self.rowViewportPosition(row), width, self.rowHeight(row))
            if rect.intersects(seen):
                source = self._sorted.mapToSource(self._sorted.index(row, 0)).row()
                text = self.branches.text_of(self.branches.rows[source])
                painter.setPen(row_color(self.palette(), usable=text.usable, chosen=row in chosen))
                self._ink.paint(painter, rect, ends, text)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Another width: other columns."""
        super().resizeEvent(event)
        self.fit_columns()

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
