"""The list of a program's moves: number, words, and whether each can be done."""

from __future__ import annotations

from typing import Any, NamedTuple

from PySide6.QtCore import QAbstractTableModel, QModelIndex, Qt, Signal
from PySide6.QtGui import QColor, QFont, QKeySequence, QResizeEvent, QShortcut
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableView, QWidget

from rvsim.gui.panels.tables import Index, text_metrics
from rvsim.gui.preferences import Preferences
from rvsim.gui.theme import THEMES
from rvsim.language import tr

_TOP = QModelIndex()
_ROOM = 14  # [pixels] beside a text
_ALIGNMENTS = (  # mirrored where one reads from the right
    Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter,
    Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter,
    Qt.AlignmentFlag.AlignCenter,
)
_TALLEST = 9  # rows: more of them scroll


class Row(NamedTuple):
    """A move in words, its state in a sign, and the sentence behind it."""

    words: str
    sign: str
    sentence: str
    bad: bool = False


class ProgramModel(QAbstractTableModel):
    """Three columns: number, words, sign."""

    def __init__(self, preferences: Preferences, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._preferences = preferences
        self.rows: tuple[Row, ...] = ()
        self.running = -1

    def show_rows(self, rows: tuple[Row, ...]) -> None:
        """Show other moves, or another state of them."""
        if len(rows) != len(self.rows):
            self.beginResetModel()
            self.rows = rows
            self.endResetModel()
        elif rows != self.rows:
            self.rows = rows
            self._changed()

    def show_running(self, row: int) -> None:
        """Mark the move that is being done, −1 for none."""
        if row != self.running:
            self.running = row
            self._changed()

    def _changed(self) -> None:
        if self.rows:
            self.dataChanged.emit(self.index(0, 0), self.index(len(self.rows) - 1, 2))

    def rowCount(self, parent: Index = _TOP) -> int:
        """The number of moves."""
        return 0 if parent.isValid() else len(self.rows)

    def columnCount(self, parent: Index = _TOP) -> int:
        """Number, words, sign."""
        return 0 if parent.isValid() else 3

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """The running move is bold and pointed at; one that cannot be done has the colour of errors and its reason."""
        row, theme = self.rows[index.row()], THEMES[self._preferences["theme"]]
        running = index.row() == self.running
        if role == Qt.ItemDataRole.DisplayRole:
            return ("▶" if running else str(index.row() + 1), row.words, row.sign)[index.column()]
        if role in (Qt.ItemDataRole.ToolTipRole, Qt.ItemDataRole.AccessibleDescriptionRole):
            return f"{index.row() + 1}. {row.words}\n{row.sentence}"
        if role == Qt.ItemDataRole.TextAlignmentRole:
            return _ALIGNMENTS[index.column()]
        if role == Qt.ItemDataRole.ForegroundRole and (row.bad or running):
            return QColor(theme.error if row.bad else theme.accent)
        if role == Qt.ItemDataRole.FontRole and running:
            font = QFont()
            font.setBold(True)
            return font
        return None


class ProgramList(QTableView):
    """One move is chosen at a time; the keys Delete, Alt + Up and Alt + Down ask to edit it.

    Signals:
        chosen(row): another one, −1 for none.
        delete_asked(), shift_asked(by): by the keys.
    """

    chosen = Signal(int)
    delete_asked = Signal()
    shift_asked = Signal(int)

    def __init__(self, model: ProgramModel) -> None:
        super().__init__()
        self.setObjectName("program_list")
        self.setAccessibleName(tr("Moves of the program"))
        self.setModel(model)
        self.setShowGrid(False)
        self.setWordWrap(True)
        self.setTabKeyNavigation(False)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.verticalHeader().hide()
        self.horizontalHeader().hide()
        self.horizontalHeader().setMinimumSectionSize(8)  # by itself as wide as the widest letter of the font
        self.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        self.horizontalHeader().setSectionResizeMode(1, QHeaderView.ResizeMode.Stretch)
        self.selectionModel().currentRowChanged.connect(lambda now, _before: self.chosen.emit(now.row()))
        for key, slot in (
            ("Delete", self.delete_asked.emit),
            ("Alt+Up", lambda: self.shift_asked.emit(-1)),
            ("Alt+Down", lambda: self.shift_asked.emit(1)),
        ):
            shortcut = QShortcut(QKeySequence(key), self)
            shortcut.setContext(Qt.ShortcutContext.WidgetShortcut)
            shortcut.activated.connect(slot)

    def choose(self, row: int) -> None:
        """Choose a move; nothing where there is none."""
        if row != self.currentIndex().row() and 0 <= row < self.model().rowCount():
            self.setCurrentIndex(self.model().index(row, 0))

    def fit(self) -> None:
        """Columns as wide as their texts, rows as high, the whole no higher than some rows."""
        metrics = text_metrics()
        self.setColumnWidth(0, metrics.horizontalAdvance("88") + _ROOM)
        self.setColumnWidth(2, metrics.horizontalAdvance("✗") + _ROOM + 6)
        self.resizeRowsToContents()
        heights = [self.rowHeight(row) for row in range(self.model().rowCount())]
        row = metrics.height() + 10
        self.setFixedHeight(min(max(sum(heights), 3 * row), _TALLEST * row) + 2 * self.frameWidth() + 2)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Narrower texts take more lines."""
        super().resizeEvent(event)
        if event.oldSize().width() != event.size().width():
            self.fit()
