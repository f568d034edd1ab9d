"""The lines of the wire as a table's model: it grows at its end and gives way at its beginning, and is never reset
while it does."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Sequence
from html import escape

from PySide6.QtCore import QAbstractTableModel, QModelIndex, Qt, Signal
from PySide6.QtGui import QColor, QFont

from rvsim.device.wire_log import MOST_ENTRIES
from rvsim.gui.panels.device_wire_lines import Line, shown_bytes
from rvsim.gui.panels.device_wire_words import Words
from rvsim.gui.panels.tables import LEFT, RIGHT, Index
from rvsim.gui.theme import THEMES, Theme
from rvsim.language import language, tr, tr_later

TIME, WAY, BYTES, WORDS = range(4)
_TOP = QModelIndex()
_HEADS = (tr_later("Time [s]"), "", tr_later("Bytes"), tr_later("In words"))
_TIPS = (
    tr_later("Seconds: 0 is when the connection was asked for, just before its port was opened, or when serving began"),
    tr_later("→ to the arm, ← from the arm"),
    tr_later("What went over the wire; bytes that are no letters as \\r or \\x1b"),
    tr_later("What it means"),
)
_RIGHT_TO_LEFT, _END = "\u2067", "\u2069"  # Unicode's isolates (UAX #9)
_TINT = 60  # of 255, behind what was searched for
_Role = Qt.ItemDataRole


class WireModel(QAbstractTableModel):
    """At most `most` lines; those that ask where the arm is, and their answers, can be left out.

    Signals:
        giving_way(count): so many rows at the top are about to go.
    """

    giving_way = Signal(int)

    def __init__(self, words: Words, fixed: QFont, most: int = MOST_ENTRIES) -> None:
        super().__init__()
        self.words = words
        self._found: set[int] = set()
        self._fixed, self._most = fixed, most
        self._theme: Theme = THEMES["light"]
        self._lines: list[Line] = []
        self._shown: list[Line] = []
        self._hides = False

    # --- what is in it ---------------------------------------------------------------------------------------------

    @property
    def lines(self) -> Sequence[Line]:
        """All lines."""
        return self._lines

    @property
    def shown(self) -> Sequence[Line]:
        """Those that have a row."""
        return self._shown

    def text(self, line: Line) -> str:
        """Its bytes."""
        return shown_bytes(line, self.words.language)

    def row_of(self, number: int) -> int:
        """The row of the line of that number, or of the first one behind it."""
        return bisect_left(self._shown, number, key=_number)

    # --- changes ---------------------------------------------------------------------------------------------------

    def add(self, lines: Sequence[Line]) -> None:
        """New lines at the end."""
        self._lines.extend(lines)
        self._append([line for line in lines if self._shows(line)])
        self._give_way(len(self._lines) - self._most)

    def start(self, words: Words, lines: Iterable[Line] = ()) -> None:
        """Other lines, or none."""
        self.beginResetModel()
        self.words, self._found = words, set()
        self._lines = list(lines)
        self._shown = list(filter(self._shows, self._lines))
        self.endResetModel()

    def hide_polling(self, hide: bool) -> None:
        """Leave out what is asked again and again."""
        self._hides = hide
        self.start(self.words, self._lines)

    def say(self, words: Words) -> None:
        """The same lines in other words."""
        self.words = words
        self._tell_all(WORDS)

    def wear(self, theme: Theme, fixed: QFont) -> None:
        """Other colours and another font."""
        self._theme, self._fixed = theme, fixed
        self._tell_all(TIME)

    def tint(self, numbers: Iterable[int] | None) -> None:
        """The lines of these numbers too are what was searched for; None: no line is."""
        if numbers is None:
            self._found.clear()
        else:
            self._found.update(numbers)
        self._tell_all(TIME)

    def _shows(self, line: Line) -> bool:
        return not (self._hides and line.polling)

    def _append(self, lines: Sequence[Line]) -> None:
        if lines:
            first = len(self._shown)
            self.beginInsertRows(_TOP, first, first + len(lines) - 1)
            self._shown.extend(lines)
            self.endInsertRows()

    def _give_way(self, count: int) -> None:
        if count <= 0:
            return
        rows = self.row_of(self._lines[count].number) if count < len(self._lines) else len(self._shown)
        del self._lines[:count]
        if rows:
            self.giving_way.emit(rows)
            self.beginRemoveRows(_TOP, 0, rows - 1)
            del self._shown[:rows]
            self.endRemoveRows()

    def _tell_all(self, first_column: int) -> None:
        if self._shown:
            self.dataChanged.emit(self.index(0, first_column), self.index(len(self._shown) - 1, WORDS))

    # --- what the table asks ---------------------------------------------------------------------------------------

    def rowCount(self, parent: Index = _TOP) -> int:
        """A row a line."""
        return 0 if parent.isValid() else len(self._shown)

    def columnCount(self, parent: Index = _TOP) -> int:
        """Time, direction, bytes, words."""
        return 0 if parent.isValid() else len(_HEADS)

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = _Role.DisplayRole) -> object:
        """Heads of the columns alone."""
        if orientation != Qt.Orientation.Horizontal:
            return None
        if role == _Role.TextAlignmentRole:
            return RIGHT if section == TIME else LEFT
        text = {_Role.DisplayRole: _HEADS[section], _Role.ToolTipRole: _TIPS[section]}.get(_Role(role))
        return tr(text) if text else text

    def data(self, index: Index, role: int = _Role.DisplayRole) -> object:
        """One cell; words are made when somebody looks at them."""
        line, column = self._shown[index.row()], index.column()
        if role == _Role.DisplayRole:
            return self._cell(line, column)
        if role == _Role.ToolTipRole:
            return f"<p>{escape(self.words.told(line))}</p>"  # only rich text is wrapped
        if role == _Role.AccessibleDescriptionRole:
            return self.words.told(line)
        if role == _Role.FontRole:
            return self._fixed if column == BYTES else None
        if role == _Role.TextAlignmentRole:
            return RIGHT if column == TIME else LEFT
        if role == _Role.ForegroundRole:
            return self._ink(line, column)
        if role == _Role.BackgroundRole and line.number in self._found:
            return _tinted(self._theme.warning)
        return None

    def _cell(self, line: Line, column: int) -> str:
        if column == TIME:
            return f"{line.entry.time:.3f}"
        if column == WAY:
            return line.entry.direction
        return self.text(line) if column == BYTES else _in_its_direction(self.words.of(line))

    def _ink(self, line: Line, column: int) -> QColor | None:
        """Stops stand out; what comes from the arm has another colour beside its other arrow."""
        if column in (WAY, BYTES):
            if line.stops or not line.whole:
                return QColor(self._theme.error)
            return None if line.sent else QColor(self._theme.accent)
        return QColor(self._theme.muted) if column == TIME else None


def _in_its_direction(words: str) -> str:
    """The table's bytes stand from left to right, and words may not."""
    return f"{_RIGHT_TO_LEFT}{words}{_END}" if language().right_to_left else words


def _number(line: Line) -> int:
    return line.number


def _tinted(color: str) -> QColor:
    tint = QColor(color)
    tint.setAlpha(_TINT)
    return tint
