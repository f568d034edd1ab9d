"""The row that searches the wire: a box, next and previous, and which match of how many."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QHBoxLayout, QLabel, QLineEdit, QWidget

from rvsim.gui.panels.device_wire_search import WireSearch
from rvsim.gui.panels.device_wire_table import WireTable
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import button
from rvsim.language import tr

_BUTTON = 32  # [pixels]


class FindRow(QWidget):
    """Steps through the matches of a search from the line that is picked; Return goes on, Shift+Return back."""

    stepped = Signal()

    def __init__(self, search: WireSearch, table: WireTable) -> None:
        super().__init__()
        self._search, self._table = search, table
        self._goes = False  # Return was pressed before all lines had been looked at
        self.box = QLineEdit()
        self.box.setObjectName("wire_search")
        self.box.setAccessibleName(tr("Find in bytes and words"))
        self.box.setPlaceholderText(tr("Find bytes or words"))
        self.box.setToolTip(tr("For instance P1500, STOP, or shoulder. Return goes to the next one"))
        self.box.setClearButtonEnabled(True)
        self.previous = button("wire_previous", "▲", tr("The match before (Shift+F3)"), lambda: self.step(-1))
        self.next = button("wire_next", "▼", tr("The next match (F3)"), lambda: self.step(1))
        self.count = QLabel()
        self.count.setObjectName("wire_matches")
        set_role(self.count, role="muted")
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(6)
        row.addWidget(self.box, 1)
        row.addWidget(self.count)
        for made in (self.previous, self.next):
            made.setFixedWidth(_BUTTON)
            row.addWidget(made)
        self._connect()
        self._show_count()

    def _connect(self) -> None:
        self.box.textChanged.connect(self._on_text)
        self.box.returnPressed.connect(self._on_return)
        self._search.changed.connect(self._on_changed)
        self._table.picked.connect(lambda _: self._show_count())

    def add_shortcuts(self, page: QWidget) -> None:
        """Ctrl+F, F3 and Shift+F3 while the keys go to that page."""
        within = Qt.ShortcutContext.WidgetWithChildrenShortcut
        QShortcut(QKeySequence(QKeySequence.StandardKey.Find), page, self.focus_box, context=within)
        QShortcut(QKeySequence("F3"), page, lambda: self.step(1), context=within)
        QShortcut(QKeySequence("Shift+F3"), page, lambda: self.step(-1), context=within)

    def focus_box(self) -> None:
        """Type what to search for."""
        self.box.setFocus(Qt.FocusReason.ShortcutFocusReason)
        self.box.selectAll()

    def _on_text(self, text: str) -> None:
        self._goes = False
        self._search.search(text)

    def _on_return(self) -> None:
        """Who types fast is there before the search: the step waits for it."""
        self._goes = self._search.searching
        if not self._goes:
            self.step(1)

    def _on_changed(self) -> None:
        if self._goes and not self._search.searching:
            self._goes = False
            self.step(1)
        self._show_count()

    def step(self, by: int) -> None:
        """Pick the next match, or the one before; round and round."""
        line = self._table.picked_line
        search = self._search
        if by > 0:
            found = search.after(-1 if line is None else line.number)
        else:
            found = search.before(search.end if line is None else line.number)
        if found is not None:
            self._table.show_line(found)
            self._show_count()

    def _show_count(self) -> None:
        search = self._search
        self.count.setVisible(bool(search.wanted))
        for made in (self.previous, self.next):
            made.setEnabled(bool(search.matches))
        line = self._table.picked_line
        self.count.setText(count_words(search, search.place(line.number) if line else 0))


def count_words(search: WireSearch, place: int) -> str:
    """ "3 of 17"; with … while lines are left to be looked at."""
    count = len(search.matches)
    found = tr("{place:,} of {count:,}", place=place, count=count) if place else f"{count:,}" if count else tr("none")
    return f"{found} …" if search.searching else found
