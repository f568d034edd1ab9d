"""The table of a Jacobian: numbers under their joints, tinted by size, one column lit under the pointer."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from PySide6.QtCore import QAbstractTableModel, QEvent, QModelIndex, QObject, Qt, Signal
from PySide6.QtGui import QColor, QFocusEvent, QFont, QFontMetricsF, QPainter, QPaintEvent, QPalette, QPen
from PySide6.QtWidgets import QHeaderView, QStyledItemDelegate, QStyleOptionViewItem, QTableView, QWidget

from rvsim.gui.panels.tables import RIGHT, Index, dot, fit_height, text_metrics
from rvsim.gui.quantities import format_number
from rvsim.gui.theme import number_font
from rvsim.language import tr
from rvsim.robot.arrays import FloatArray

_TINTS = ("#d9730d", "#1f6feb")  # of negative and of positive numbers
_CELL_MARGIN = 10.0
_SMALLEST, _MOST_LEFT_OUT = 0.6, 2  # letters, of the table's; decimals
_STRONGEST = 0.34  # a tint, and the text on it still has its contrast


class Row(NamedTuple):
    """A row: its name, what it is in words, the decimals it is shown with, and the block it is compared within."""

    name: str
    meaning: str
    decimals: int
    block: int


class Column(NamedTuple):
    """A column: the joint's short name, its long one, and its colour "#rrggbb"."""

    name: str
    title: str
    color: str


class JacobianModel(QAbstractTableModel):
    """The numbers as they are shown; `units` (r, c) go with the tooltips. `catch_up` is called before they are read."""

    def __init__(self, parent: QObject | None = None, catch_up: Callable[[], None] = lambda: None) -> None:
        super().__init__(parent)
        self._catch_up = catch_up
        self._rows: tuple[Row, ...] = ()
        self._columns: tuple[Column, ...] = ()
        self.values: FloatArray = np.empty((0, 0))
        self.shares: FloatArray = np.empty((0, 0))
        self._units: list[list[str]] = []
        self.lit = -1
        self.left_out = 0  # decimals, where the columns are narrow

    def show_values(
        self, rows: tuple[Row, ...], columns: tuple[Column, ...], values: FloatArray, units: list[list[str]]
    ) -> bool:
        """Show them; True where rows or columns are other ones than before."""
        other = (rows, columns) != (self._rows, self._columns)
        if other:
            self.beginResetModel()
        self._rows, self._columns, self._units = rows, columns, units
        self.values, self.shares = values, _shares(rows, values)
        if other:
            self.endResetModel()
        elif values.size:
            self.dataChanged.emit(self.index(0, 0), self.index(len(rows) - 1, len(columns) - 1))
        return other

    def text(self, row: int, column: int) -> str:
        """A number as it is shown; a dash where there is none."""
        value = float(self.values[row, column])
        return "–" if np.isnan(value) else format_number(value, max(self._rows[row].decimals - self.left_out, 1))

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008 - Qt's own default
        """How many rows."""
        return 0 if parent.isValid() else len(self._rows)

    def columnCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008 - Qt's own default
        """One column a joint."""
        return 0 if parent.isValid() else len(self._columns)

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """A number as text, and in full in the tooltip."""
        self._catch_up()
        row, column = index.row(), index.column()
        if role == Qt.ItemDataRole.DisplayRole:
            return self.text(row, column)
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return RIGHT
        if role in (Qt.ItemDataRole.ToolTipRole, Qt.ItemDataRole.AccessibleDescriptionRole):
            number = f"{self.values[row, column]:.9g}".replace("-", "\u2212")
            return tr(
                "{row} by {joint}: {number} {unit}",
                row=self._rows[row].name,
                joint=self._columns[column].title,
                number=number,
                unit=self._units[row][column],
            )
        return None

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """The joints above, the rows at the left."""
        if orientation == Qt.Orientation.Vertical:
            row = self._rows[section]
            return {Qt.ItemDataRole.DisplayRole: row.name, Qt.ItemDataRole.ToolTipRole: row.meaning}.get(
                Qt.ItemDataRole(role)
            )
        column = self._columns[section]
        if role == Qt.ItemDataRole.DecorationRole:
            return dot(column.color)
        return {
            Qt.ItemDataRole.DisplayRole: column.name,
            Qt.ItemDataRole.ToolTipRole: column.title,
            Qt.ItemDataRole.TextAlignmentRole: RIGHT,
        }.get(Qt.ItemDataRole(role))


def _shares(rows: tuple[Row, ...], values: FloatArray) -> FloatArray:
    """(r, c) each number as a share of the largest in its block, with its sign."""
    blocks = np.array([row.block for row in rows])
    shares = np.zeros_like(values)
    for block in set(blocks.tolist()):
        part = np.nan_to_num(values[blocks == block])
        shares[blocks == block] = part / max(float(np.abs(part).max(initial=0.0)), 1e-12)
    return shares


class _CellDelegate(QStyledItemDelegate):
    """Paints a number on its tint: the style sheet's way takes ten times as long."""

    shrunk = 1.0  # how much smaller than the table's the letters are, where columns are narrow

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """The tint, the number, and two lines beside the column that is lit."""
        view: Any = option  # its fields are known to no type checker
        model = index.model()
        assert isinstance(model, JacobianModel)
        share = float(model.shares[index.row(), index.column()])
        tint = QColor(_TINTS[share > 0.0])
        tint.setAlphaF(_STRONGEST * abs(share))
        painter.fillRect(view.rect.adjusted(1, 1, 0, 0), tint)
        painter.setLayoutDirection(Qt.LayoutDirection.LeftToRight)  # else it has that of the program
        font = QFont(view.font)
        font.setPointSizeF(self.shrunk * font.pointSizeF())
        painter.setFont(font)
        painter.setPen(view.palette.color(QPalette.ColorRole.Text))
        painter.setLayoutDirection(Qt.LayoutDirection.LeftToRight)  # it takes that of the application by itself
        painter.drawText(view.rect.adjusted(2, 0, -5, 0), RIGHT, model.text(index.row(), index.column()))
        if index.column() == model.lit:
            painter.setPen(QPen(view.palette.color(QPalette.ColorRole.Highlight), 2))
            for x in (view.rect.left() + 1, view.rect.right()):
                painter.drawLine(x, view.rect.top(), x, view.rect.bottom() + 1)


class JacobianTable(QTableView):
    """Shows a `JacobianModel`.

    Signals:
        lit(column): the pointer, or else the keyboard, is on that column; −1: on none.
    """

    lit = Signal(int)

    def __init__(self, model: JacobianModel, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("jacobian_table")
        self.setAccessibleName(tr("Jacobian"))
        self.setModel(model)
        self.setLayoutDirection(Qt.LayoutDirection.LeftToRight)
        self.jacobian = model
        self.setShowGrid(False)
        self.setSelectionMode(QTableView.SelectionMode.NoSelection)
        self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setTabKeyNavigation(False)
        self._cells = _CellDelegate(self)
        self.setItemDelegate(self._cells)
        self.setFont(number_font(self.font()))
        columns, rows = self.horizontalHeader(), self.verticalHeader()
        columns.setMinimumSectionSize(24)
        columns.setHighlightSections(False)
        columns.setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
        columns.setSectionsClickable(True)
        columns.sectionClicked.connect(self.choose)
        rows.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        rows.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        self.setMouseTracking(True)
        self.entered.connect(lambda index: self._light(index.column()))
        self.viewportEntered.connect(lambda: self._light(-1))
        self.selectionModel().currentChanged.connect(lambda index, _: self._light(index.column()))

    def choose(self, column: int) -> None:
        """Light a column, and keep it lit."""
        self.setCurrentIndex(self.model().index(max(self.currentIndex().row(), 0), column))
        self._light(column)

    def fit(self) -> None:
        """As high as its rows."""
        fit_height(self)
        names = [self.model().headerData(row, Qt.Orientation.Vertical) for row in range(self.model().rowCount())]
        widest = max((text_metrics().horizontalAdvance(name) for name in names), default=0)
        self.verticalHeader().setFixedWidth(widest + 14)
        self.setFixedHeight(self.maximumHeight())

    def _light(self, column: int) -> None:
        if column < 0:
            column = self.currentIndex().column()
        if column != self.jacobian.lit:
            self.jacobian.lit = column
            self.viewport().update()
            self.lit.emit(column)

    def paintEvent(self, event: QPaintEvent) -> None:
        """All numbers in letters of one size, in which the longest fits its column.

        Before they become too small to be read, decimals are left out; the tooltips have them.
        """
        room = self.columnWidth(0) - _CELL_MARGIN
        for self.jacobian.left_out in range(_MOST_LEFT_OUT + 1):
            self._cells.shrunk = min(1.0, room / max(self._longest(), 1.0))
            if self._cells.shrunk >= _SMALLEST:
                break
        super().paintEvent(event)

    def _longest(self) -> float:
        """The widest number [pixels] in the letters of the table."""
        model, metrics = self.jacobian, QFontMetricsF(self.font())
        places = [(row, column) for row in range(model.rowCount()) for column in range(model.columnCount())]
        return max((metrics.horizontalAdvance(model.text(*place)) for place in places), default=0.0)

    def leaveEvent(self, event: QEvent) -> None:
        """What the keyboard chose is lit again."""
        super().leaveEvent(event)
        self._light(-1)

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Tab lights the first column, so that the arrow keys have where to start."""
        super().focusInEvent(event)
        if not self.currentIndex().isValid() and event.reason() != Qt.FocusReason.MouseFocusReason:
            self.choose(0)

    def changeEvent(self, event: QEvent) -> None:
        """Another font: other heights."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self.fit()
