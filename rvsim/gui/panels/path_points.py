"""Every point of the tracked path as a table: where it is, whether it was reached or why not, and the joints there."""

from __future__ import annotations

from typing import Any

import numpy as np
from PySide6.QtCore import QAbstractTableModel, QModelIndex, QObject, Qt
from PySide6.QtGui import QBrush, QColor
from PySide6.QtWidgets import QAbstractItemView, QDialog, QHBoxLayout, QHeaderView, QLabel, QVBoxLayout, QWidget

from rvsim.gui.panels.copying import CopyButton
from rvsim.gui.panels.tables import LEFT, RIGHT, Index, plain_table
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Display, display, format_number, joint_kind, length_kind
from rvsim.gui.session import Session
from rvsim.gui.theme import set_role
from rvsim.lab.tables import tracking_csv
from rvsim.language import tr, tr_later, trn
from rvsim.motion import Tracking, Unreached

_ROOT = QModelIndex()
_WHY = {"reach": tr_later("out of reach"), "orientation": tr_later("not with this orientation")}
_OUTSIDE = tr_later("outside the limits")
_MISSED = QColor("#D9534F")


class PathPointsModel(QAbstractTableModel):
    """One row a point: number, x, y, z, what came of it, then the joints."""

    def __init__(self, preferences: Preferences, parent: QObject) -> None:
        super().__init__(parent)
        self._preferences = preferences
        self.tracking: Tracking | None = None
        self._missed: dict[int, Unreached] = {}

    def show_tracking(self, tracking: Tracking | None) -> None:
        """Show another result, or none."""
        self.beginResetModel()
        self.tracking = tracking
        self._missed = {} if tracking is None else {point.index: point for point in tracking.unreached}
        self.endResetModel()

    def rowCount(self, parent: Index = _ROOT) -> int:
        """One a point."""
        return 0 if parent.isValid() or self.tracking is None else self.tracking.samples

    def columnCount(self, parent: Index = _ROOT) -> int:
        """Number, x, y, z, what came of it, joints."""
        return 0 if parent.isValid() or self.tracking is None else 5 + self.tracking.robot.dof

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """The texts; missed points stand out by a colour as well."""
        if self.tracking is None:
            return None
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return LEFT if index.column() == 4 else RIGHT
        if role == Qt.ItemDataRole.ForegroundRole and index.column() == 4 and index.row() in self._missed:
            return QBrush(_MISSED)
        if role == Qt.ItemDataRole.DisplayRole:
            return self._text(self.tracking, index.row(), index.column())
        return None

    def _text(self, tracking: Tracking, row: int, column: int) -> str:
        if column == 0:
            return str(row + 1)
        if column == 4:
            return self._came_of(tracking, row)
        if column < 4:
            value, shown = float(tracking.path.points[row, column - 1]), self._length(tracking)
        else:
            value, shown = float(tracking.q[row, column - 5]), self._joint(tracking, column - 5)
        return "\u2013" if np.isnan(value) else format_number(value * shown.factor, shown.decimals)

    def _came_of(self, tracking: Tracking, row: int) -> str:
        missed = self._missed.get(row)
        if missed is None:
            return tr("after a jump") if row in tracking.jumps else tr("reached")
        if missed.kind != "limits" or missed.joint is None or missed.value is None or missed.limit is None:
            return tr(_WHY.get(missed.kind, _OUTSIDE))
        shown = self._joint(tracking, tracking.robot.joint_names.index(missed.joint))
        numbers = (missed.value, missed.limit)
        needed, limit = (format_number(x * shown.factor, shown.decimals) + shown.suffix for x in numbers)
        return tr("{joint}: {needed} needed, limit {limit}", joint=tr(missed.joint), needed=needed, limit=limit)

    def _length(self, tracking: Tracking) -> Display:
        return display(length_kind(tracking.robot), self._preferences)

    def _joint(self, tracking: Tracking, joint: int) -> Display:
        return display(joint_kind(tracking.robot, joint), self._preferences)

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """The names with their units."""
        tracking = self.tracking
        if tracking is None or role != Qt.ItemDataRole.DisplayRole or orientation != Qt.Orientation.Horizontal:
            return None
        if section in (0, 4):
            return tr("no.") if section == 0 else tr("what came of it")
        if section < 4:
            return f"{'xyz'[section - 1]} {self._length(tracking).suffix.strip()}"
        return f"{tr(tracking.robot.joint_names[section - 5])} {self._joint(tracking, section - 5).suffix.strip()}"


class PathPointsDialog(QDialog):
    """The table beside the window; a click on a row moves the arm to that point."""

    def __init__(self, session: Session, preferences: Preferences, parent: QWidget) -> None:
        super().__init__(parent)
        self.setObjectName("path_points_dialog")
        self.setWindowTitle(tr("Points of the path"))
        self.resize(820, 460)
        self._session = session
        self.model = PathPointsModel(preferences, self)
        self.table = plain_table("tracked_points_table", tr("Points of the path and what came of them"), self.model)
        self.table.setWordWrap(False)
        self.table.verticalHeader().setDefaultSectionSize(self.table.fontMetrics().height() + 8)
        self.table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.table.selectionModel().currentRowChanged.connect(lambda now, _before: self._go(now.row()))
        self.table.clicked.connect(lambda index: self._go(index.row()))
        self.note = QLabel(wordWrap=True)
        set_role(self.note, role="muted")
        self.copy = CopyButton("tracked_points_copy", tr("the points"), {"CSV": self._as_csv}, session)
        head = QHBoxLayout()
        head.addWidget(self.note, 1)
        head.addWidget(self.copy)
        column = QVBoxLayout(self)
        column.addLayout(head)
        column.addWidget(self.table, 1)
        session.tracking_changed.connect(self._show)
        preferences.changed.connect(lambda _: self.model.layoutChanged.emit())
        self._show(session.tracking)

    def _show(self, tracking: Tracking | None) -> None:
        self.model.show_tracking(tracking)
        columns = self.table.horizontalHeader()
        for section in range(self.model.columnCount()):
            columns.setSectionResizeMode(section, QHeaderView.ResizeMode.ResizeToContents)
        columns.setStretchLastSection(False)
        self.copy.setEnabled(tracking is not None)
        self.note.setText(
            tr("Nothing is tracked at present.")
            if tracking is None
            else trn(
                "{n} point, {reached} reached. A click moves the arm there.",
                "{n} points, {reached} reached. A click moves the arm there.",
                tracking.samples,
                reached=tracking.reached_count,
            )
        )

    def _go(self, row: int) -> None:
        tracking = self.model.tracking
        if tracking is None or not 0 <= row < tracking.samples or tracking is not self._session.tracking:
            return
        if not tracking.reached[row]:
            self._session.warn(
                tr(
                    "Point {number} was not reached: {why}.",
                    number=row + 1,
                    why=self.model.data(self.model.index(row, 4)),
                )
            )
        elif not np.array_equal(tracking.q[row], self._session.q):
            self._session.move_to(tracking.q[row], tr("Go to point {number}", number=row + 1), merge="go to a point")

    def _as_csv(self) -> str:
        return "" if self.model.tracking is None else tracking_csv(self.model.tracking)
