"""All numbers of the servos in two tables, to be typed over: for those who know them, or want to see them."""

from __future__ import annotations

from collections.abc import Callable
from datetime import date
from typing import Any

from PySide6.QtCore import QAbstractTableModel, QModelIndex, Qt, Signal
from PySide6.QtGui import QFont, QGuiApplication, QResizeEvent
from PySide6.QtWidgets import QHeaderView, QTableView, QVBoxLayout, QWidget

from rvsim.device.words import axis_name
from rvsim.errors import RvsimError
from rvsim.gui.device_control import DeviceControl
from rvsim.gui.panels.device_calibrate_cells import (
    GRIPPER_COLUMNS,
    SERVO_COLUMNS,
    Column,
    Wiring,
    cell_text,
    on_channel,
    origin,
    origins,
    servo_number,
    swapped_channels,
    turned_gripper,
    whole_text,
    with_gripper_number,
    with_servo_number,
)
from rvsim.gui.panels.folding_row import FoldingGrid
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.number_cells import make_editable
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
from rvsim.gui.session import Session
from rvsim.gui.widgets import button
from rvsim.language import left_to_right, tr, tr_later
from rvsim.robot import GripperServo, Robot, Servo

_TOP = QModelIndex()
_Role = Qt.ItemDataRole
_SWAPPED = (4, 5)
_FIRST_WIDE = 3  # columns before it hold a letter or two
_ENDS = (5, 6)
_ABOUT = tr_later(
    "Pulses in µs; every number can be typed over, italics are assumed. What is calibrated here lives in the arm of "
    "this window: save it as a robot file, or it is gone when the window closes."
)


def today() -> str:
    """The date that a calibration bears."""
    return date.today().isoformat()


class ServosModel(QAbstractTableModel):
    """One row a joint, or the gripper's only row; `edited(row, key, text)` tells what has been typed."""

    edited = Signal(int, str, str)

    def __init__(self, columns: tuple[Column, ...]) -> None:
        super().__init__()
        self._columns = columns
        self._of_gripper = columns is GRIPPER_COLUMNS
        self._robot: Robot | None = None
        self._rooms: dict[int, int] = {}

    def give_room(self, column: int, width: int) -> None:
        """A column is so wide [pixels]; decimals that would be cut are left out."""
        if width > 0:  # it is not one that is hidden
            self._rooms[column] = width - CELL_MARGIN

    def show_robot(self, robot: Robot) -> None:
        """Show the servos of an arm; an editor that is open survives if the rows are as many."""
        before, rows = self.rowCount(), self._rows(robot)
        if before != len(rows):
            self.beginResetModel()
        self._robot = robot
        if before != len(rows):
            self.endResetModel()
        elif rows:
            self.dataChanged.emit(self.index(0, 0), self.index(len(rows) - 1, len(self._columns)))

    def _rows(self, robot: Robot | None) -> tuple[Servo | GripperServo, ...]:
        if robot is None:
            return ()
        if not self._of_gripper:
            return robot.servos
        return () if robot.gripper_servo is None else (robot.gripper_servo,)

    def rowCount(self, parent: Index = _TOP) -> int:
        """One a servo."""
        return 0 if parent.isValid() else len(self._rows(self._robot))

    def columnCount(self, parent: Index = _TOP) -> int:
        """The joint and its numbers."""
        return 0 if parent.isValid() else 1 + len(self._columns)

    def flags(self, index: Index) -> Qt.ItemFlag:
        """Numbers can be edited, names cannot."""
        flags = super().flags(index)
        return flags | Qt.ItemFlag.ItemIsEditable if index.isValid() and index.column() > 0 else flags

    def data(self, index: Index, role: int = _Role.DisplayRole) -> Any:
        """What stands in a cell."""
        column = index.column()
        match role:
            case _Role.DisplayRole:
                return self._name(index.row()) if column == 0 else self._text(index.row(), column)
            case _Role.EditRole:
                return whole_text(self._columns[column - 1], self._number(index.row(), column)) if column else None
            case _Role.TextAlignmentRole:
                return LEFT if column == 0 else RIGHT
            case _Role.DecorationRole if column == 0 and not self._of_gripper and self._robot:
                return dot(self._robot.joints[index.row()].color)
            case _Role.FontRole if self._rows(self._robot)[index.row()].assumed and column > 0:
                return _italic()
            case _Role.ToolTipRole:
                return self._tip(index.row(), column)
        return None

    def _name(self, row: int) -> str:
        return tr("gripper") if self._of_gripper else f"J{row + 1}"

    def _number(self, row: int, column: int) -> float:
        assert self._robot is not None
        key = self._columns[column - 1].key
        return (
            float(getattr(self._robot.gripper_servo, key)) if self._of_gripper else servo_number(self._robot, row, key)
        )

    def _text(self, row: int, column: int) -> str:
        shown = self._columns[column - 1]
        if not shown.decimals or column not in self._rooms:
            return cell_text(shown, self._number(row, column))
        numbers = [self._number(each, column) for each in range(self.rowCount())]
        fewer = decimals_that_fit(
            lambda decimals: (cell_text(shown, number, decimals) for number in numbers),
            shown.decimals,
            self._rooms[column],
        )
        return cell_text(shown, self._number(row, column), fewer)

    def _tip(self, row: int, column: int) -> str:
        assert self._robot is not None
        servo = self._rows(self._robot)[row]
        name = tr("The gripper") if self._of_gripper else tr("The {joint}'s servo", joint=axis_name(self._robot, row))
        source = origin(servo.assumed, servo.source)
        if column == 0:
            return tr("{servo}; {origin}.", servo=name, origin=source)
        number = self.data(self.index(row, column), _Role.EditRole)
        head = tr(self._columns[column - 1].head)
        return tr("{servo}: {head} {number}; {origin}.", servo=name, head=head, number=number, origin=source)

    def setData(self, index: Index, value: Any, role: int = _Role.EditRole) -> bool:
        """Take a typed text, if it is another one."""
        if role != _Role.EditRole or index.column() == 0:
            return False
        if str(value).strip() != self.data(index, _Role.EditRole):
            self.edited.emit(index.row(), self._columns[index.column() - 1].key, str(value))
        return True

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = _Role.DisplayRole) -> Any:
        """Short heads; their tooltips say what they mean."""
        if orientation == Qt.Orientation.Vertical:
            return None
        if role == _Role.TextAlignmentRole:
            return LEFT if section == 0 else RIGHT
        if role == _Role.ToolTipRole:
            return tr("What hangs on the servo") if section == 0 else tr(self._columns[section - 1].tip)
        if role != _Role.DisplayRole:
            return None
        return "" if section == 0 else left_to_right(tr(self._columns[section - 1].head))


class ServoTables(QWidget):
    """The tables, what two clicks put right, and where the numbers come from. Edits go through the device."""

    def __init__(self, session: Session, device: DeviceControl) -> None:
        super().__init__()
        self._session, self._device = session, device
        self.servos, self.gripper = ServosModel(SERVO_COLUMNS), ServosModel(GRIPPER_COLUMNS)
        self.table = _table("calibrate_table", tr("Servos of the joints"), self.servos)
        self.ends_table = _table("calibrate_ends_table", tr("Shortest and longest pulses"), self.servos)
        self.gripper_table = _table("calibrate_gripper_table", tr("Servo of the gripper"), self.gripper)
        self.swap = button(
            "calibrate_swap", tr("Swap channels 4 and 5"), tr("Some arms have the gripper on 5 and the wrist's "
                                                              "turn on 4"),
            self._on_swap,
        )  # fmt: skip
        self.turn = button(
            "calibrate_polarity",
            tr("Swap open and closed"),
            tr("For a gripper that opens when it should close"),
            self._on_turn,
        )
        self.origin = wrapped_label("muted")
        self.origin.setObjectName("calibrate_origin")
        about = wrapped_label("muted")
        about.setText(tr(_ABOUT))
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(6)
        one_click = FoldingGrid((self.swap, self.turn), 6)
        for widget in (about, self.table, self.ends_table, self.gripper_table, one_click, self.origin):
            column.addWidget(widget)
        self.servos.edited.connect(self._on_edited)
        self.gripper.edited.connect(self._on_gripper_edited)

    def show_robot(self, robot: Robot) -> None:
        """Show the servos of an arm."""
        self.servos.show_robot(robot)
        self.gripper.show_robot(robot)
        self._fold()
        for table in (self.table, self.ends_table, self.gripper_table):
            fit_height(table)
        self.gripper_table.setVisible(robot.gripper_servo is not None)
        self.turn.setVisible(robot.gripper_servo is not None)
        self.swap.setEnabled(any(on_channel(robot, channel) for channel in _SWAPPED))
        self.origin.setText("\n".join(origins(robot)))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Another width."""
        super().resizeEvent(event)
        self._fold()

    def _fold(self) -> None:
        """Both ends in a table of their own where the numbers would be cut."""
        room = self.width() - sum(self.table.columnWidth(column) for column in range(_FIRST_WIDE))
        number = text_metrics().horizontalAdvance("00000") + CELL_MARGIN
        folded = room < number * (1 + len(SERVO_COLUMNS) - _FIRST_WIDE)
        for column in range(1, 1 + len(SERVO_COLUMNS)):
            self.table.setColumnHidden(column, folded and column in _ENDS)
            self.ends_table.setColumnHidden(column, column not in _ENDS)
        self.ends_table.setVisible(folded)

    def _on_edited(self, joint: int, key: str, text: str) -> None:
        robot = self._session.robot
        self._take(
            lambda: with_servo_number(robot, joint, key, text, today()),
            tr("Servo of the {joint}", joint=axis_name(robot, joint)),
        )

    def _on_gripper_edited(self, _row: int, key: str, text: str) -> None:
        robot = self._session.robot
        self._take(lambda: with_gripper_number(robot, key, text, today()), tr("Servo of the gripper"))

    def _on_swap(self) -> None:
        robot = self._session.robot
        self._take(lambda: swapped_channels(robot, *_SWAPPED), tr("Swap channels 4 and 5"))

    def _on_turn(self) -> None:
        robot = self._session.robot
        self._take(lambda: turned_gripper(robot, today()), tr("Swap open and closed"))

    def _take(self, make: Callable[[], Wiring], text: str) -> None:
        try:
            servos, gripper = make()
        except RvsimError as problem:
            self._session.say(str(problem), "error")
            return
        self._device.use_servos(servos, gripper, text)


def _table(name: str, title: str, model: ServosModel) -> QTableView:
    table = plain_table(name, title, model)
    narrow = range(_FIRST_WIDE if model.columnCount() > len(GRIPPER_COLUMNS) + 1 else 1)
    for column in narrow:
        table.horizontalHeader().setSectionResizeMode(column, QHeaderView.ResizeMode.ResizeToContents)
    make_editable(table, f"{name}_editor")
    table.horizontalHeader().sectionResized.connect(lambda column, _, width: model.give_room(column, width))
    return table


def _italic() -> QFont:
    font = QFont(QGuiApplication.font())
    font.setItalic(True)
    return font
