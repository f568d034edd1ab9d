"""A table of texts, one tuple a row, for results that are shown and copied but not edited."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from PySide6.QtCore import QAbstractTableModel, QModelIndex, Qt
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableView

from rvsim.gui.panels.tables import LEFT, RIGHT, Index, fit_height, plain_table
from rvsim.language import tr

_TOP = QModelIndex()


class TextRow(NamedTuple):
    """The texts of a row, and what its tooltip says."""

    texts: tuple[str, ...]
    tip: str = ""
    enabled: bool = True


class RowsModel(QAbstractTableModel):
    """Heads with tips, said in the language; and rows: the first column is a name, the others are numbers."""

    def __init__(self, heads: Sequence[tuple[str, str]]) -> None:
        super().__init__()
        self._heads = tuple(heads)
        self.rows: tuple[TextRow, ...] = ()

    def show_rows(self, rows: Sequence[TextRow], heads: Sequence[tuple[str, str]] | None = None) -> None:
        """Show other rows, under other heads where the units changed."""
        self.beginResetModel()
        self.rows = tuple(rows)
        self._heads = self._heads if heads is None else tuple(heads)
        self.endResetModel()

    def rowCount(self, parent: Index = _TOP) -> int:
        """The number of rows."""
        return 0 if parent.isValid() else len(self.rows)

    def columnCount(self, parent: Index = _TOP) -> int:
        """As many as there are heads."""
        return 0 if parent.isValid() else len(self._heads)

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """The text, on its side, with the row's tip."""
        row = self.rows[index.row()]
        if role == Qt.ItemDataRole.DisplayRole:
            return row.texts[index.column()]
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return LEFT if index.column() == 0 else RIGHT
        if role == Qt.ItemDataRole.ToolTipRole:
            return row.tip
        return None

    def flags(self, index: Index) -> Qt.ItemFlag:
        """A row that cannot be chosen is grey."""
        return super().flags(index) if self.rows[index.row()].enabled else Qt.ItemFlag.NoItemFlags

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """The heads and their tips."""
        if orientation == Qt.Orientation.Vertical:
            return None
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return LEFT if section == 0 else RIGHT
        part = {Qt.ItemDataRole.DisplayRole: 0, Qt.ItemDataRole.ToolTipRole: 1}.get(Qt.ItemDataRole(role))
        return None if part is None else tr(self._heads[section][part])


def rows_table(name: str, title: str, model: RowsModel) -> QTableView:
    """Chosen by rows; the numbers are as wide as they need, the name has the rest; as high as its rows."""
    table = plain_table(name, title, model)
    table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
    table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
    table.setTabKeyNavigation(False)
    table.setWordWrap(False)
    header = table.horizontalHeader()
    header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
    header.setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)

    def fit() -> None:
        fit_height(table)
        table.setMinimumHeight(table.maximumHeight())

    model.modelReset.connect(fit)
    fit()
    return table


def as_csv(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Comma-separated, a head line first."""
    return "\n".join(",".join(row) for row in (heads, *rows)) + "\n"


def as_text(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Aligned columns."""
    table = [tuple(heads), *map(tuple, rows)]
    widths = [max(len(row[column]) for row in table) for column in range(len(heads))]
    lines = ("  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in table)
    return "\n".join(lines) + "\n"
