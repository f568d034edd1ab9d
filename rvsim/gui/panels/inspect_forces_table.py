"""The joint torques as a table, each with a bar that shows how much of its rating it takes."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QBrush, QColor, QPainter, QPalette, QPen, QResizeEvent
from PySide6.QtWidgets import QHeaderView, QStyledItemDelegate, QStyleOptionViewItem, QTableView

from rvsim.gui.panels.inspect_forces_words import TorqueRow, rating_text, share_text
from rvsim.gui.panels.tables import (
    CELL_MARGIN,
    LEFT,
    RIGHT,
    Index,
    decimals_that_fit,
    dot,
    fit_height,
    plain_table,
    text_metrics,
)
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import display, format_number, torque_kind
from rvsim.language import tr, tr_later
from rvsim.robot import Robot

_TOP = QModelIndex()
_JOINT, _PUSHED, _HELD, _TOTAL, _BAR = range(5)
_HEADS = (tr_later("joint"), tr_later("from F"), tr_later("weight"), "τ", tr_later("of its rating"))
_SHORT = (tr_later("joint"), "JᵀF", "g(q)", "τ", tr_later("rating"))
_TIPS = (
    tr_later("The joint"),
    tr_later("JᵀF: what the wrench takes"),
    tr_later("g(q): what the arm's own weight takes"),
    tr_later("What the drive has to give"),
    tr_later("How much of the drive's torque rating that is"),
)
_BAR_HEIGHT = 11.0
_WIDEST, _LEAST_BAR, _DOT_ROOM = "≈ 000 %", 24, 30  # [pixels]


class TorqueModel(QAbstractTableModel):
    """One row a joint. `catch_up` is called before the numbers are read."""

    def __init__(self, robot: Robot, preferences: Preferences, catch_up: Callable[[], None] = lambda: None) -> None:
        super().__init__()
        self._catch_up = catch_up
        self._robot, self._preferences = robot, preferences
        self._rows: tuple[TorqueRow, ...] = ()
        self._width, self._parts, self._decimals = 10_000, False, 0

    def give_room(self, width: int, parts: bool) -> None:
        """The table is so wide [pixels], and shows parts beside their sum: what would be cut is left out or shorter."""
        if (width, parts) != (self._width, self._parts):
            self._width, self._parts = width, parts
            self._choose_decimals()
            self.headerDataChanged.emit(Qt.Orientation.Horizontal, 0, _BAR)

    def _room(self) -> float:
        """Of a column of numbers [pixels]: the joint and the bar have theirs."""
        metrics = text_metrics()
        taken = metrics.horizontalAdvance("J0") + _DOT_ROOM
        if self._parts:  # what the bar takes is what they leave, but for its number
            shares = max((share_text(row) for row in self._rows), key=len, default="")
            return (self._width - taken - metrics.horizontalAdvance(shares) - 12) / 3 - CELL_MARGIN
        return self._width - taken - metrics.horizontalAdvance(_WIDEST) - 8 - _LEAST_BAR - CELL_MARGIN

    def _heads(self) -> tuple[str, ...]:
        """In words where there is room."""
        fits = text_metrics().horizontalAdvance(tr(_HEADS[_HELD])) <= self._room()
        return tuple(map(tr, _HEADS if fits else _SHORT))

    def _choose_decimals(self) -> None:
        """As many as fit beside each other."""
        shown = (display(torque_kind(self._robot, joint), self._preferences) for joint in range(len(self._rows)))
        wanted = max((each.decimals for each in shown), default=0)
        self._decimals = decimals_that_fit(self._numbers, wanted, self._room())

    def _numbers(self, decimals: int) -> list[str]:
        columns = (_PUSHED, _HELD, _TOTAL) if self._parts else (_TOTAL,)
        rows = enumerate(self._rows)
        return [self._number(joint, row, column, decimals) for joint, row in rows for column in columns]

    @property
    def rows(self) -> tuple[TorqueRow, ...]:
        """What is shown."""
        return self._rows

    def show_rows(self, robot: Robot, rows: tuple[TorqueRow, ...]) -> None:
        """Show these rows of an arm."""
        resets = len(rows) != len(self._rows) or robot is not self._robot
        if resets:
            self.beginResetModel()
        self._robot, self._rows = robot, rows
        self._choose_decimals()
        if resets:
            self.endResetModel()
        else:
            self.dataChanged.emit(self.index(0, 0), self.index(len(rows) - 1, _BAR))

    def rowCount(self, parent: Index = _TOP) -> int:
        """One a joint."""
        return 0 if parent.isValid() else len(self._rows)

    def columnCount(self, parent: Index = _TOP) -> int:
        """Joint, parts, sum, bar."""
        return 0 if parent.isValid() else len(_HEADS)

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """What stands in a cell; the bar's cell gives its text, and its row for the delegate."""
        self._catch_up()
        row, column = self._rows[index.row()], index.column()
        match role:
            case Qt.ItemDataRole.DisplayRole:
                return self._text(index.row(), row, column)
            case Qt.ItemDataRole.TextAlignmentRole:
                return LEFT if column == _JOINT else RIGHT
            case Qt.ItemDataRole.DecorationRole:
                return dot(row.color) if column == _JOINT else None
            case Qt.ItemDataRole.ToolTipRole:
                return rating_text(row, self._robot, index.row(), self._preferences)
            case Qt.ItemDataRole.UserRole:
                return row
        return None

    def _text(self, joint: int, row: TorqueRow, column: int) -> str:
        if column == _JOINT:
            return f"J{joint + 1}"
        if column == _BAR:
            return share_text(row)
        return self._number(joint, row, column, self._decimals)

    def _number(self, joint: int, row: TorqueRow, column: int, decimals: int) -> str:
        value = {_PUSHED: row.from_wrench, _HELD: row.from_weight, _TOTAL: row.total}[column]
        shown = display(torque_kind(self._robot, joint), self._preferences)
        text = format_number(value * shown.factor, min(decimals, shown.decimals))
        return text if self._common_unit() else text + shown.suffix

    @property
    def title(self) -> str:
        """What the table is, with the unit that all joints share; else it stands at the numbers."""
        unit = self._common_unit()
        return tr("Joint torques, {unit}", unit=unit) if unit else tr("Joint torques")

    def _common_unit(self) -> str:
        """The unit that all joints share, or nothing."""
        units = {display(torque_kind(self._robot, i), self._preferences).suffix for i in range(len(self._rows))}
        return units.pop().strip() if len(units) == 1 else ""

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """What a column is."""
        if orientation == Qt.Orientation.Vertical:
            return None
        if role == Qt.ItemDataRole.DisplayRole:
            return self._heads()[section]
        if role == Qt.ItemDataRole.ToolTipRole:
            return tr(_TIPS[section])
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return LEFT if section == _JOINT else RIGHT
        return None


def torque_table(model: TorqueModel) -> QTableView:
    """The view of a model."""
    table = plain_table("torque_table", tr("Joint torques"), model, TorqueTable())
    table.setItemDelegateForColumn(_BAR, BarDelegate(table))
    table.setSelectionMode(QTableView.SelectionMode.NoSelection)
    table.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    header = table.horizontalHeader()
    header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
    header.setSectionResizeMode(_BAR, QHeaderView.ResizeMode.Stretch)
    show_weight(table, False)
    return table


def show_weight(table: QTableView, on: bool) -> None:
    """With the arm's own weight there are two parts and their sum."""
    table.setColumnHidden(_PUSHED, not on)
    table.setColumnHidden(_HELD, not on)
    _give_room(table)


def _give_room(table: QTableView) -> None:
    model = table.model()
    if isinstance(model, TorqueModel):
        model.give_room(table.viewport().width(), not table.isColumnHidden(_HELD))


class TorqueTable(QTableView):
    """Tells its model how much room there is."""

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Another width."""
        _give_room(self)
        super().resizeEvent(event)


def fit_table(table: QTableView) -> None:
    """As high as its rows."""
    fit_height(table)
    table.setMinimumHeight(table.maximumHeight())


class BarDelegate(QStyledItemDelegate):
    """Draws the share of the rating from the middle to the left or right, its number beside it."""

    def sizeHint(self, option: QStyleOptionViewItem, index: Index) -> QSize:
        """The column has a width of its own."""
        return QSize(60, super().sizeHint(option, index).height())

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Frame, bar, number."""
        row: TorqueRow = index.data(Qt.ItemDataRole.UserRole)
        painter.save()
        painter.setLayoutDirection(option.direction)
        cell, palette = QRectF(option.rect), option.palette
        if index.row() % 2:
            painter.fillRect(cell, palette.alternateBase())
        room = option.fontMetrics.horizontalAdvance(_WIDEST) + 8
        frame = QRectF(cell.left() + 4, cell.center().y() - _BAR_HEIGHT / 2, cell.width() - room - 6, _BAR_HEIGHT)
        if not math.isnan(row.share) and frame.width() > _LEAST_BAR / 2:
            _paint_bar(painter, frame, row, palette)
        over = not math.isnan(row.share) and abs(row.share) > 1.0
        text = palette.color(QPalette.ColorRole.BrightText if over else QPalette.ColorRole.Text)
        painter.setPen(text)
        painter.drawText(cell.adjusted(0, 0, -6, 0), RIGHT, share_text(row))
        painter.restore()


def _paint_bar(painter: QPainter, frame: QRectF, row: TorqueRow, palette: QPalette) -> None:
    half = frame.width() / 2
    length = half * max(-1.0, min(1.0, row.share))
    bar = QRectF(frame.center().x(), frame.top(), length, frame.height()).normalized()
    painter.fillRect(bar, QColor(row.color))
    if abs(row.share) > 1.0:
        error = palette.color(QPalette.ColorRole.BrightText)
        painter.fillRect(bar, QBrush(error, Qt.BrushStyle.BDiagPattern))
    muted = palette.color(QPalette.ColorRole.PlaceholderText)
    style = Qt.PenStyle.DashLine if row.rating_assumed else Qt.PenStyle.SolidLine
    painter.setPen(QPen(muted, 1.0, style))
    painter.drawRect(frame)
    painter.setPen(QPen(muted, 1.0))
    middle = QPointF(frame.center().x(), 0.0)
    painter.drawLine(middle + QPointF(0.0, frame.top() - 1.0), middle + QPointF(0.0, frame.bottom() + 1.0))
