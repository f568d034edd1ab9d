"""The window of the sources' experiments: every number that is printed, what its formula gives, and what is right."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QModelIndex, Qt
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QCheckBox, QDialog, QHBoxLayout, QLineEdit, QProgressBar, QVBoxLayout

from rvsim.gui.panels.copying import CopyButton
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.parts_worker import PartsWorker
from rvsim.gui.sources_show import show_experiment
from rvsim.gui.sources_table import SourcesFilter, SourcesModel, fit_rows, sources_view
from rvsim.gui.widgets import button, combo
from rvsim.lab.sources.experiments import SOURCE_TITLES, experiment_of
from rvsim.lab.sources.reproduce import KeyedReproduction, Reproduction, reproduction_parts, reproduction_text
from rvsim.lab.sources.reproduction_texts import reproduction_csv, reproduction_latex, row_sentence
from rvsim.language import tr, tr_later

if TYPE_CHECKING:
    from rvsim.gui.main_window import MainWindow

_SIZE, _SHARE = (1240, 640), 0.94  # [px], and at most this share of the window behind
_SENTENCE_LINES = 3
_STEPS = 1000


class SourcesDialog(QDialog):
    """Not modal, one a window; it is hidden rather than closed, so that it comes back as it was."""

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window)
        self._window = window
        self.setObjectName("sources_dialog")
        self.setWindowTitle(tr("The sources' experiments"))
        self.model = SourcesModel(window.preferences)
        self.filter = SourcesFilter(self.model)
        self.table = sources_view(self.filter)
        self.worker = PartsWorker(self)
        self.worker.part.connect(self._on_part)
        self._make_choices()
        self._make_foot()
        self._lay_out()
        self.table.doubleClicked.connect(self.show_row)
        self.table.selectionModel().currentRowChanged.connect(lambda *_: self._show_sentence())
        window.preferences.changed.connect(self._on_preference)
        self._show_sentence()

    # --- construction ----------------------------------------------------------------------------------------------

    def _make_choices(self) -> None:
        titles = {key: f"{key}  {tr(title)}" for key, title in SOURCE_TITLES.items()}
        self.sources = combo("sources_source", tr("Source"), {"": tr("All sources"), **titles})
        self.sources.currentIndexChanged.connect(lambda _: self._narrow())
        self.words = QLineEdit()
        self.words.setObjectName("sources_words")
        self.words.setPlaceholderText(tr("Find: a program, a word, a verdict"))
        self.words.setAccessibleName(tr("Find in the table"))
        self.words.setClearButtonEnabled(True)
        self.words.textChanged.connect(lambda _: self._narrow())
        formats = {tr_later("text"): reproduction_text, "CSV": reproduction_csv, "LaTeX": reproduction_latex}
        makers = {name: (lambda make=make: make(self._plain_rows())) for name, make in formats.items()}
        self.copy = CopyButton("sources_copy", tr("the whole table"), makers, self._window.session)

    def _make_foot(self) -> None:
        self.sentence = wrapped_label()
        self.sentence.setObjectName("sources_sentence")
        self.sentence.setAlignment(Qt.AlignmentFlag.AlignTop | Qt.AlignmentFlag.AlignLeft)
        self.sentence.setMinimumHeight(_SENTENCE_LINES * self.sentence.fontMetrics().lineSpacing())
        self.progress = QProgressBar()
        self.progress.setRange(0, _STEPS)
        self.progress.setTextVisible(False)
        self.progress.setFixedHeight(4)
        self.progress.setAccessibleName(tr("The numbers are being worked out"))
        self.keep = QCheckBox(tr("Keep this table open"))
        self.keep.setObjectName("sources_keep")
        tip = tr("Take the arm, the pose and the path of this row, and bring the panel that shows it to the front")
        self.show_button = button("sources_show", tr("Show in the window"), tip, self.show_row, primary=True)
        self.close_button = button("sources_close", tr("Close"), "Esc", self.reject)

    def _lay_out(self) -> None:
        above, below = QHBoxLayout(), QHBoxLayout()
        above.addWidget(self.sources, 1)
        above.addWidget(self.words, 2)
        above.addWidget(self.copy)
        below.addWidget(self.keep, 1)
        below.addWidget(self.close_button)
        below.addWidget(self.show_button)
        column = QVBoxLayout(self)
        column.setContentsMargins(12, 12, 12, 12)
        column.setSpacing(8)
        column.addLayout(above)
        column.addWidget(self.progress)
        column.addWidget(self.table, 1)
        column.addWidget(self.sentence)
        column.addLayout(below)
        self.resize(*(min(size, int(_SHARE * room)) for size, room in zip(_SIZE, self._room(), strict=True)))

    def _room(self) -> tuple[int, int]:
        return self._window.width(), self._window.height()

    # --- working out -----------------------------------------------------------------------------------------------

    def showEvent(self, event: QShowEvent) -> None:
        """Seen for the first time: work the numbers out."""
        super().showEvent(event)
        if not self.model.rowCount():
            self.progress.show()
            if not self.worker.busy:
                self.worker.start(reproduction_parts)
            self._show_sentence()

    def close_worker(self) -> None:
        """End the thread, for the window closes."""
        self.worker.close()

    def _on_part(self, part: float | tuple[KeyedReproduction, ...]) -> None:
        if isinstance(part, float):
            self.progress.setValue(int(part * _STEPS))
            return
        self.progress.hide()
        self.model.show_rows(part)
        self._narrow()

    # --- showing ---------------------------------------------------------------------------------------------------

    def show_source(self, source: str) -> None:
        """Only the rows of a source, "" for all; the window comes to the front."""
        self.words.clear()
        self.sources.setCurrentIndex(self.sources.findData(source))
        self.show()
        self.activateWindow()

    def show_row(self, _index: QModelIndex | None = None) -> None:
        """Set the window up for the chosen row."""
        chosen = self.chosen
        if chosen is None:
            return
        show_experiment(self._window, experiment_of(chosen.key))
        if not self.keep.isChecked():
            self.hide()
            self._window.activateWindow()

    @property
    def chosen(self) -> KeyedReproduction | None:
        """The row that is selected."""
        found = self.table.currentIndex().data(Qt.ItemDataRole.UserRole)
        return found if isinstance(found, KeyedReproduction) else None

    def choose(self, key: str) -> None:
        """Select the first row of an experiment or erratum."""
        for number, keyed in enumerate(self.filter.rows):
            if keyed.key == key:
                self.table.selectRow(number)
                return

    def _narrow(self) -> None:
        self.filter.show_only(self.sources.currentData(), self.words.text().strip())
        if self.chosen is None and self.filter.rowCount():
            self.table.selectRow(0)
        self._show_sentence()

    def _show_sentence(self) -> None:
        chosen = self.chosen
        self.show_button.setEnabled(chosen is not None)
        if chosen is not None:
            self.sentence.setText(row_sentence(chosen.row, experiment_of(chosen.key)))
        elif self.worker.busy:
            self.sentence.setText(tr("Working the numbers out once more …"))
        else:
            self.sentence.setText(tr("Nothing here has these words."))

    def _plain_rows(self) -> tuple[Reproduction, ...]:
        return tuple(keyed.row for keyed in self.filter.rows)

    def _on_preference(self, name: str) -> None:
        if name in ("theme", "presentation"):
            fit_rows(self.table)


def sources_dialog(window: MainWindow) -> SourcesDialog:
    """The one of that window, made when it is first asked for."""
    found = window.findChild(SourcesDialog)
    return found if isinstance(found, SourcesDialog) else SourcesDialog(window)
