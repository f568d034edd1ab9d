"""A table of points: typed, pasted from a spreadsheet, put into another order, joined by lines or a spline."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path as FilePath
from typing import Any

import numpy as np
from PySide6.QtCore import QAbstractTableModel, QModelIndex, QObject, QSignalBlocker, Qt, Signal
from PySide6.QtGui import QGuiApplication, QKeySequence, QShortcut
from PySide6.QtWidgets import QGridLayout, QHBoxLayout, QVBoxLayout

from rvsim.errors import ExpressionError, PathFileError
from rvsim.experiment import Shape
from rvsim.experiment.shapes import PointsShape
from rvsim.expressions import evaluate_in
from rvsim.gui.calm_boxes import CountBox
from rvsim.gui.panels.path_clicks import ClickRows
from rvsim.gui.panels.path_shape_rows import ShapeEditor
from rvsim.gui.panels.tables import RIGHT, Index, plain_table
from rvsim.gui.point_clicks import PointClicks
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Display, display, format_number, length_kind
from rvsim.gui.widgets import button, combo, select
from rvsim.lab.path_file import points_mm_of
from rvsim.language import tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.units import metres_from_millimetres

_JOINS = {
    "lines": tr_later("Joined by lines"),
    "natural": tr_later("A spline, natural ends"),
    "not-a-knot": tr_later("A spline, not-a-knot"),
    "closed": tr_later("A closed spline"),
    "none": tr_later("The points alone"),
}
_ROOT = QModelIndex()
_SHOWN_ROWS = 6
MOST_POINTS = 20_000


class _PointsModel(QAbstractTableModel):
    """Rows x, y, z as they are typed. `edited(points)` tells of another one, `refused(sentence)` why not."""

    edited = Signal(object)
    refused = Signal(str)

    def __init__(self, robot: Robot, preferences: Preferences, parent: QObject) -> None:
        super().__init__(parent)
        self._kind, self._preferences = length_kind(robot), preferences
        preferences.changed.connect(self._on_preference)  # not a lambda: it would outlive the model
        self.points: FloatArray = np.empty((0, 3))

    def _on_preference(self, _name: str) -> None:
        self.layoutChanged.emit()

    @property
    def shown(self) -> Display:
        return display(self._kind, self._preferences)

    def show_points(self, points: FloatArray) -> None:
        self.beginResetModel()
        self.points = points
        self.endResetModel()

    def rowCount(self, parent: Index = _ROOT) -> int:
        return 0 if parent.isValid() else len(self.points)

    def columnCount(self, parent: Index = _ROOT) -> int:
        return 0 if parent.isValid() else 4

    def flags(self, index: Index) -> Qt.ItemFlag:
        editable = Qt.ItemFlag.ItemIsEditable if index.column() else Qt.ItemFlag.NoItemFlags
        return super().flags(index) | editable

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return RIGHT
        if role not in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.EditRole):
            return None
        if not index.column():
            return str(index.row() + 1)
        value = float(self.points[index.row(), index.column() - 1]) * self.shown.factor
        return f"{value:.10g}" if role == Qt.ItemDataRole.EditRole else format_number(value, self.shown.decimals)

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        if role != Qt.ItemDataRole.DisplayRole or orientation != Qt.Orientation.Horizontal:
            return None
        return f"{'xyz'[section - 1]} {self.shown.suffix.strip()}" if section else tr("no.")

    def setData(self, index: Index, value: Any, role: int = Qt.ItemDataRole.EditRole) -> bool:
        if role != Qt.ItemDataRole.EditRole or not index.column():
            return False
        try:
            number = evaluate_in(self.shown.suffix.strip(), str(value)) / self.shown.factor
        except ExpressionError as problem:
            self.refused.emit(str(problem))
            return False
        points = self.points.copy()
        points[index.row(), index.column() - 1] = number
        self.edited.emit(points)
        return True


class PointRows(ShapeEditor):
    """The table, its buttons, and how the points are joined."""

    def __init__(self, robot: Robot, preferences: Preferences, clicks: PointClicks | None = None) -> None:
        super().__init__()
        self._robot = robot
        self._shape: PointsShape | None = None
        self.is_example = False  # whether the points are ours: the first click puts its own in their place
        self.by_click = None if clicks is None else ClickRows(robot, preferences, clicks)
        self.model = _PointsModel(robot, preferences, self)
        self.model.edited.connect(self._on_points)
        self.model.refused.connect(self.refused)
        self.table = plain_table("path_points_table", tr("Points of the path"), self.model)
        row = self.table.fontMetrics().height() + 8
        self.table.verticalHeader().setDefaultSectionSize(row)
        self.table.setFixedHeight((_SHOWN_ROWS + 1) * row + 8)
        self.table.selectionModel().currentRowChanged.connect(self._show_chosen)
        self.join = combo("points_join", tr("How the points are joined"), _JOINS)
        self.join.activated.connect(lambda _: self._edit(join=self.join.currentData()))
        self.samples = CountBox()
        self.samples.setObjectName("shape_samples")
        self.samples.setAccessibleName(tr("Number of points on the whole path"))
        self.samples.setRange(2, 5001)
        self.samples.setKeyboardTracking(False)
        self.samples.setSuffix(tr(" points"))
        self.samples.valueChanged.connect(lambda value: self._edit("shape samples", samples=value))
        self.samples.editingFinished.connect(self.finished)
        self._lay_out()
        paste = QShortcut(QKeySequence(QKeySequence.StandardKey.Paste), self.table)
        paste.setContext(Qt.ShortcutContext.WidgetShortcut)
        paste.activated.connect(self.paste)

    def _lay_out(self) -> None:
        tips = (
            ("points_add", tr("Add"), tr("A point after the chosen one, a copy of it"), self.add),
            ("points_delete", tr("Delete"), tr("Take the chosen points out"), self.delete),
            ("points_up", tr("Up"), tr("The chosen point earlier"), lambda: self._swap(-1)),
            ("points_down", tr("Down"), tr("The chosen point later"), lambda: self._swap(1)),
            (
                "points_paste",
                tr("Paste"),
                tr("Rows x, y, z from a spreadsheet, after the chosen point (Ctrl+V)"),
                self.paste,
            ),
        )
        buttons = QGridLayout()
        buttons.setSpacing(4)
        for place, (name, text, tip, slot) in enumerate(tips):
            made = button(name, text, tip, slot)
            made.setMinimumWidth(10)
            buttons.addWidget(made, 0, place)
        ends = QHBoxLayout()
        ends.addWidget(self.join, 1)
        ends.addWidget(self.samples)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(4)
        column.addWidget(self.table)
        column.addLayout(buttons)
        if self.by_click is not None:
            column.addWidget(self.by_click)
            self.by_click.picked.connect(self.add_place)
            self.by_click.refused.connect(self.refused)
        column.addLayout(ends)

    def show_shape(self, shape: Shape) -> None:
        """Show its points, silently; the chosen one stays chosen."""
        assert isinstance(shape, PointsShape)
        row = self.table.currentIndex().row()
        if self._shape is None or shape.points is not self._shape.points:
            self.model.show_points(shape.points)
            if 0 <= row < len(shape.points):
                self.table.selectRow(row)
        self._shape = shape
        self._show_chosen()
        select(self.join, shape.join)
        self.samples.setVisible(shape.join != "none")
        with QSignalBlocker(self.samples):
            self.samples.setValue(shape.samples)

    def _show_chosen(self) -> None:
        """A plane for clicks goes through the chosen point."""
        if self.by_click is not None and len(self.model.points):
            self.by_click.show_points(self.model.points, self._row())

    # --- what the buttons do ---------------------------------------------------------------------------------------

    def add(self) -> None:
        """A copy of the chosen point after it."""
        row = self._row()
        self._on_points(np.insert(self.model.points, row + 1, self.model.points[row], axis=0), row + 1)

    def add_place(self, place: FloatArray) -> None:
        """A point (3,) after the chosen one; the first of one's own begins a path of its own."""
        if len(self.model.points) >= MOST_POINTS:
            self.refused.emit(tr("Not added: a path has at most {most} points.", most=MOST_POINTS))
        elif self.is_example:
            self._on_points(place[None], 0)
        else:
            row = self._row() + 1
            self._on_points(np.insert(self.model.points, row, place, axis=0), row)

    def delete(self) -> None:
        """Take the chosen points out; one always stays."""
        rows = sorted({index.row() for index in self.table.selectedIndexes()}) or [self._row()]
        if len(rows) < len(self.model.points):
            self._on_points(np.delete(self.model.points, rows, axis=0), rows[0])

    def paste(self) -> None:
        """Rows from the clipboard after the chosen point."""
        text = QGuiApplication.clipboard().text()
        try:
            numbers = points_mm_of(FilePath(tr("The clipboard")), text)
        except PathFileError as problem:
            self.refused.emit(str(problem))
            return
        pasted = np.array(numbers, dtype=np.float64).reshape(-1, 3)
        if self._robot.length_unit == "millimetre":
            pasted = np.asarray(metres_from_millimetres(pasted))
        if len(pasted) + len(self.model.points) > MOST_POINTS:
            self.refused.emit(tr("Not pasted: a path has at most {most} points.", most=MOST_POINTS))
            return
        row = self._row()
        self._on_points(np.insert(self.model.points, [row + 1] * len(pasted), pasted, axis=0), row + len(pasted))

    def _swap(self, by: int) -> None:
        row = self._row()
        other = row + by
        if 0 <= other < len(self.model.points):
            points = self.model.points.copy()
            points[[row, other]] = points[[other, row]]
            self._on_points(points, other)

    def _row(self) -> int:
        """The chosen row, the last where none is."""
        row = self.table.currentIndex().row()
        return row if row >= 0 else len(self.model.points) - 1

    def _on_points(self, points: FloatArray, row: int | None = None) -> None:
        self._edit(points=points)
        if row is not None:
            self.table.selectRow(min(row, self.model.rowCount() - 1))

    def _edit(self, merge: str = "", **changes: Any) -> None:
        if self._shape is not None:
            self.edited.emit(replace(self._shape, **changes), merge)
