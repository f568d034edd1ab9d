"""The table of the wire: it follows the end until somebody scrolls up or picks a line to read."""

from __future__ import annotations

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QFont, QFontDatabase, QGuiApplication, QKeyEvent, QKeySequence, QMouseEvent, QResizeEvent
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableView

from rvsim.device.wire_log import text
from rvsim.gui.panels.device_wire_lines import Line
from rvsim.gui.panels.device_wire_model import BYTES, TIME, WAY, WORDS, WireModel
from rvsim.gui.panels.tables import CELL_MARGIN, plain_table, text_metrics
from rvsim.language import tr

_ROOM_FOR_WORDS = 620  # [pixels] in the usual size
_FEWEST_ROWS = 7


class WireTable(QTableView):
    """Shows a `WireModel`.

    Signals:
        following_changed(on): whether the newest line is kept in sight.
        picked(line or None): the line that is to be read.
    """

    following_changed = Signal(bool)
    picked = Signal(object)

    def __init__(self, model: WireModel) -> None:
        super().__init__()
        self._wire, self._following, self._own = model, True, False
        plain_table("wire_log", tr("What went over the wire"), model, self)
        self.setWordWrap(False)
        self.setTextElideMode(Qt.TextElideMode.ElideRight)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.ExtendedSelection)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setVerticalScrollMode(QAbstractItemView.ScrollMode.ScrollPerItem)
        self.setTabKeyNavigation(False)
        self.setAlternatingRowColors(False)  # the stripes would wander as lines come
        self.verticalScrollBar().valueChanged.connect(self._on_scrolled)
        model.giving_way.connect(self._stay)
        model.rowsInserted.connect(self._follow)
        model.modelReset.connect(self._on_reset)
        self.selectionModel().currentRowChanged.connect(lambda index, _: self._pick(index.row()))
        self.fit()

    # --- following -------------------------------------------------------------------------------------------------

    @property
    def following(self) -> bool:
        """Whether the newest line is kept in sight."""
        return self._following

    def follow_end(self) -> None:
        """To the newest line, and stay with it."""
        self._set_following(True)
        self._follow()

    def show_line(self, number: int) -> None:
        """Pick the line of that number and bring it into sight."""
        index = self._wire.index(self._wire.row_of(number), BYTES)
        self.setCurrentIndex(index)
        self.scrollTo(index, QAbstractItemView.ScrollHint.PositionAtCenter)
        self._set_following(False)

    @property
    def picked_line(self) -> Line | None:
        """The line that is to be read."""
        row = self.currentIndex().row()
        return self._wire.shown[row] if row >= 0 else None

    def _set_following(self, on: bool) -> None:
        if on != self._following:
            self._following = on
            self.following_changed.emit(on)

    def _follow(self) -> None:
        if self._following:
            self.scrollToBottom()

    def _on_scrolled(self, value: int) -> None:
        if not self._own:
            self._set_following(value >= self.verticalScrollBar().maximum())

    def _stay(self, count: int) -> None:
        """Rows at the top go: what is in sight stays in sight."""
        if not self._following:
            bar = self.verticalScrollBar()
            self._own = True
            bar.setValue(max(bar.value() - count, 0))
            self._own = False

    def _on_reset(self) -> None:
        self._pick(-1)
        self.follow_end()

    def _pick(self, row: int) -> None:
        self.picked.emit(self._wire.shown[row] if row >= 0 else None)

    # --- copying ---------------------------------------------------------------------------------------------------

    def chosen_text(self) -> tuple[str, int]:
        """The selected lines as text, or all that are shown where none is; and how many."""
        selection = self.selectionModel().selection()
        parts = [selection.at(number) for number in range(selection.size())]
        rows = sorted({row for part in parts for row in range(part.top(), part.bottom() + 1)})
        shown = self._wire.shown
        lines = [shown[row] for row in rows] if rows else list(shown)
        return text(line.entry for line in lines), len(lines)

    # --- looks -----------------------------------------------------------------------------------------------------

    def fit(self) -> None:
        """Widths and heights of the font; words beside the bytes where there is room for both."""
        metrics = text_metrics()
        header = self.horizontalHeader()
        self.verticalHeader().setDefaultSectionSize(metrics.height() + 6)
        self.setMinimumHeight(header.sizeHint().height() + _FEWEST_ROWS * (metrics.height() + 6))
        for column, widest in ((TIME, "8888.888"), (WAY, "→")):
            header.setSectionResizeMode(column, QHeaderView.ResizeMode.Fixed)
            self.setColumnWidth(column, metrics.horizontalAdvance(widest) + CELL_MARGIN + 4)
        self.setColumnHidden(WORDS, self.viewport().width() < _ROOM_FOR_WORDS * metrics.height() / 16)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Another size: with or without words; the end stays in sight, or the line that is picked."""
        super().resizeEvent(event)
        self.fit()
        self._follow()
        if not self._following and self.currentIndex().isValid():
            self.scrollTo(self.currentIndex())

    def changeEvent(self, event: QEvent) -> None:
        """Another font."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange and self.model() is not None:
            self.fit()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Who picks a line wants to read it: it does not wander off."""
        super().mousePressEvent(event)
        if self.indexAt(event.position().toPoint()).isValid():
            self._set_following(False)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Copy the lines as text."""
        if event.matches(QKeySequence.StandardKey.Copy):
            QGuiApplication.clipboard().setText(self.chosen_text()[0])
        else:
            super().keyPressEvent(event)


def fixed_font() -> QFont:
    """Letters of one width, as large as the window's text."""
    font = QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont)
    font.setFamily(font.family())  # said aloud, or the window's own family would take its place
    font.setPointSizeF(QGuiApplication.font().pointSizeF() * 0.95)
    return font


def fixed_style() -> str:
    """The same family as a style sheet: a widget's own font is lost when the window is dressed anew."""
    return f'font-family: "{fixed_font().family()}";'
