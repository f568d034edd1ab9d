"""The table of the sources' numbers: a row each, with a sign and a word for its verdict, never a colour alone."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from PySide6.QtCore import QAbstractTableModel, QModelIndex, QPersistentModelIndex, QSortFilterProxyModel, Qt
from PySide6.QtGui import QColor, QGuiApplication
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableView

from rvsim.gui.panels.tables import RIGHT, plain_table, text_metrics
from rvsim.gui.preferences import Preferences
from rvsim.gui.theme import THEMES
from rvsim.lab.sources.experiments import SOURCE_TITLES, experiment_of
from rvsim.lab.sources.reproduce import KeyedReproduction
from rvsim.lab.sources.reproduction_texts import COLUMNS, row_sentence, shown_cells
from rvsim.language import left_to_right, tr, tr_later, without_isolates

Index = QModelIndex | QPersistentModelIndex
_TOP = QModelIndex()
_LEADING = Qt.AlignmentFlag.AlignLeading | Qt.AlignmentFlag.AlignVCenter  # where reading begins
_ITEM, _VERDICT = COLUMNS.index("Item"), COLUMNS.index("Verdict")
_NUMBERS = range(_ITEM + 1, _VERDICT)
# A sign and the theme's colour for each verdict.
SIGNS = {
    tr_later("confirmed"): ("✓", "good"),
    tr_later("computed"): ("=", "muted"),
    tr_later("misprint"): ("✗", "error"),
    tr_later("contradiction"): ("≠", "error"),
    tr_later("undefined"): ("?", "error"),
    tr_later("ignored"): ("○", "warning"),
    tr_later("outside limits"): ("▲", "warning"),
    tr_later("partly reached"): ("◐", "warning"),
    tr_later("cannot be reached"): ("⊘", "error"),
}
_ORDER = tuple(SIGNS)
_LONGEST, _DIGITS = 25, 4  # letters and digits of a cell; all of it stands in the tooltip and in the sentence below


class SourcesModel(QAbstractTableModel):
    """The rows as texts; `UserRole` gives the row itself, the second one what a column is sorted by."""

    SORT = Qt.ItemDataRole.UserRole + 1

    def __init__(self, preferences: Preferences) -> None:
        super().__init__()
        self._preferences = preferences
        self._rows: tuple[KeyedReproduction, ...] = ()

    def show_rows(self, rows: Sequence[KeyedReproduction]) -> None:
        """Show other rows."""
        self.beginResetModel()
        self._rows = tuple(rows)
        self.endResetModel()

    def rowCount(self, parent: Index = _TOP) -> int:
        """One a number."""
        return 0 if parent.isValid() else len(self._rows)

    def columnCount(self, parent: Index = _TOP) -> int:
        """Those of `COLUMNS`."""
        return 0 if parent.isValid() else len(COLUMNS)

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Text, alignment, colour, tooltip, and the row."""
        keyed, column = self._rows[index.row()], index.column()
        if role == Qt.ItemDataRole.DisplayRole:
            return _text(keyed, column)
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return RIGHT if column in _NUMBERS else _LEADING
        if role == Qt.ItemDataRole.ForegroundRole and column == _VERDICT:
            theme = THEMES[self._preferences["theme"]]
            return QColor(getattr(theme, SIGNS[keyed.row.verdict][1]))
        if role == Qt.ItemDataRole.ToolTipRole:
            return _tip(keyed, column)
        if role == Qt.ItemDataRole.UserRole:
            return keyed
        return self._sorted_by(index.row(), column) if role == self.SORT else None

    def _sorted_by(self, row: int, column: int) -> Any:
        keyed = self._rows[row]
        if column in _NUMBERS:
            value = (keyed.row.printed, keyed.row.formula, keyed.row.ours)[column - _NUMBERS.start]
            number = value[0] if isinstance(value, tuple) else value
            return float("-inf") if number is None or number != number else number
        if column == _VERDICT:
            return _ORDER.index(keyed.row.verdict)
        return row  # sources and items in the order of their texts

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """The names of the columns, above their texts."""
        if orientation != Qt.Orientation.Horizontal:
            return None
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return RIGHT if section in _NUMBERS else _LEADING
        return tr(COLUMNS[section]) if role == Qt.ItemDataRole.DisplayRole else None


def _text(keyed: KeyedReproduction, column: int) -> str:
    text = shown_cells(keyed.row, _DIGITS)[column]
    if column == _VERDICT:
        return f"{SIGNS[keyed.row.verdict][0]} {tr(keyed.row.verdict)}"
    if column in _NUMBERS and len(text) > _LONGEST:
        return left_to_right(text[: text.rindex(", ", 0, _LONGEST - 3)] + ", …)")
    return left_to_right(text) if column in _NUMBERS else tr(text)


def _tip(keyed: KeyedReproduction, column: int) -> str:
    if column == 0:
        return tr(SOURCE_TITLES[keyed.row.source])
    text = shown_cells(keyed.row)[column]
    if column == _ITEM:
        return f"{tr(text)}\n{tr(experiment_of(keyed.key).title)}"
    return tr(text) if column == _VERDICT else text


class SourcesFilter(QSortFilterProxyModel):
    """The rows of one source, or all, that hold a text."""

    def __init__(self, model: SourcesModel) -> None:
        super().__init__()
        self._source = self._words = ""
        self.setSourceModel(model)
        self.setSortRole(SourcesModel.SORT)

    def show_only(self, source: str, words: str) -> None:
        """ "" for every source, and for any text."""
        self.beginFilterChange()
        self._source, self._words = source, words.casefold()
        self.endFilterChange()

    def filterAcceptsRow(self, row: int, parent: Index) -> bool:
        """Whether a row is shown."""
        keyed = self.sourceModel().index(row, 0, parent).data(Qt.ItemDataRole.UserRole)
        if self._source not in ("", keyed.row.source):
            return False
        sentence, verdict = row_sentence(keyed.row, experiment_of(keyed.key)), tr(keyed.row.verdict)
        return self._words in without_isolates(f"{sentence}{verdict}").casefold()

    @property
    def rows(self) -> tuple[KeyedReproduction, ...]:
        """Those that are shown, in the order in which they are."""
        return tuple(self.index(row, 0).data(Qt.ItemDataRole.UserRole) for row in range(self.rowCount()))


def sources_view(model: SourcesFilter) -> QTableView:
    """The table, sorted as the sources have it until a header is clicked."""
    table = plain_table("sources_table", tr("The numbers of the sources"), model)
    table.setLayoutDirection(QGuiApplication.layoutDirection())  # most of it are words
    table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
    table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
    table.setWordWrap(False)
    table.setSortingEnabled(True)
    table.sortByColumn(0, Qt.SortOrder.AscendingOrder)
    table.setTabKeyNavigation(False)
    table.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    for column in range(len(COLUMNS)):
        stretched = column == _ITEM
        mode = QHeaderView.ResizeMode.Stretch if stretched else QHeaderView.ResizeMode.ResizeToContents
        table.horizontalHeader().setSectionResizeMode(column, mode)
    fit_rows(table)
    return table


def fit_rows(table: QTableView) -> None:
    """As high as the letters need, and in the colours of now."""
    table.verticalHeader().setDefaultSectionSize(text_metrics().height() + 8)
    table.viewport().update()
