"""File › Lab report: the cover, which parts, where to; made in slices beside the window, given up at any time."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from PySide6.QtCore import QDate, QLocale, Qt, QTimer, QUrl
from PySide6.QtGui import QCloseEvent, QDesktopServices
from PySide6.QtWidgets import (
    QCheckBox,
    QDialog,
    QFileDialog,
    QGridLayout,
    QGroupBox,
    QHBoxLayout,
    QLineEdit,
    QProgressBar,
    QVBoxLayout,
    QWidget,
)

from rvsim.errors import RvsimError
from rvsim.experiment import Notes, SessionState
from rvsim.files.session_file import session_bytes
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.preferences import Preferences
from rvsim.gui.report.bundle import Order, Progress, free_folder, write_bundle, zip_of
from rvsim.gui.session import Session
from rvsim.gui.text_box import TextBox
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import button, form
from rvsim.lab.report import PARTS, Cover, Study, parts_of, title_of
from rvsim.language import language, tr, tr_later, without_isolates

_LONGEST_LINE = 1000  # characters of a line of the cover, or of a folder
_MISSING = {
    "steps": tr_later("This arm has no closed form."),
    "path": tr_later("Track a line or a trajectory first."),
    "motion": tr_later("Track a line or a trajectory, or run a program first."),
    "measured": tr_later("Let a motion run on an arm first, a virtual one will do."),
    "sources": tr_later("No formula of the sources about this arm is known to be wrong."),
}


class ReportDialog(QDialog):
    """Does not stop the work in the window: the experiment as it was when this opened is the one reported on."""

    def __init__(
        self, parent: QWidget, session: Session, preferences: Preferences, study: Study, state: SessionState
    ) -> None:
        super().__init__(parent)
        self.setObjectName("report_dialog")
        self.setWindowTitle(tr("Lab report"))
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._session, self._preferences, self._study, self._state = session, preferences, study, state
        self._work: Iterator[Progress] | None = None
        self._done: Path | None = None
        self._slice = QTimer(self, interval=0)
        self._slice.timeout.connect(self._go_on)
        self._make_cover()
        self._make_parts()
        self._lay_out()

    # --- assembly --------------------------------------------------------------------------------------------------

    def _make_cover(self) -> None:
        notes = self._study.experiment.notes
        self.title_box = _line("report_title", tr("Title"), title_of(self._study))
        self.name_box = _line("report_name", tr("Your name"), notes.student or str(self._preferences["student"]))
        self.name_box.setPlaceholderText(tr("Your name"))
        self.date_box = _line("report_date", tr("Date"), _written(QDate.currentDate()))
        self.notes_box = TextBox(notes.text)
        self.notes_box.setObjectName("report_notes")
        self.notes_box.setAccessibleName(tr("Notes"))
        self.notes_box.setPlaceholderText(tr("What you did and what you found; it stands below the title."))
        self.notes_box.setFixedHeight(72)
        folder = free_folder(Path.home(), f"report-{self._study.robot.name}")
        self.folder_box = _line("report_folder", tr("Folder to be made"), str(folder))

    def _make_parts(self) -> None:
        there = parts_of(self._study)
        self.parts: dict[str, QCheckBox] = {}
        for part in PARTS:
            box = QCheckBox(tr(part.title))
            box.setObjectName(f"report_part_{part.name}")
            box.setChecked(part.name in there)
            box.setEnabled(part.name in there)
            box.setToolTip("" if part.name in there else tr(_MISSING.get(part.name, "")))
            self.parts[part.name] = box
        self.animation = QCheckBox(tr("Animation of the motion (GIF)"))
        self.animation.setObjectName("report_animation")
        self.animation.setEnabled(self._study.motion is not None)
        self.zipped = QCheckBox(tr("A .zip of it all as well"))
        self.zipped.setObjectName("report_zip")

    def _lay_out(self) -> None:
        rows = form()
        rows.addRow(tr("Title"), self.title_box)
        rows.addRow(tr("Name"), self.name_box)
        rows.addRow(tr("Date"), self.date_box)
        rows.addRow(tr("Notes"), self.notes_box)
        rows.addRow(tr("Folder"), self._folder_row())
        self.status = wrapped_label("muted")
        self.status.setObjectName("report_status")
        self.status.setText(
            tr("HTML and PDF, the tables as CSV, a NumPy script that works it out anew, and the session.")
        )
        column = QVBoxLayout(self)
        column.setSpacing(8)
        column.addLayout(rows)
        column.addWidget(self._parts_group())
        column.addWidget(self.status)
        column.addLayout(self._buttons())
        self.setMinimumWidth(620)

    def _parts_group(self) -> QGroupBox:
        group = QGroupBox(tr("What is in it"))
        grid = QGridLayout(group)
        boxes = [*self.parts.values(), self.animation, self.zipped]
        half = (len(boxes) + 1) // 2
        for number, box in enumerate(boxes):
            grid.addWidget(box, number % half, number // half)
        return group

    def _buttons(self) -> QHBoxLayout:
        self.progress = QProgressBar()
        self.progress.setObjectName("report_progress")
        self.progress.setRange(0, 1000)
        self.progress.setVisible(False)
        self.start_button = button(
            "report_start", tr("Make the report"), tr("Write all of it"), self.start, primary=True
        )
        self.open_button = button("report_open", tr("Open the folder"), tr("In the file manager"), self._open)
        self.open_button.setVisible(False)
        self.cancel_button = button("report_cancel", tr("Close"), tr("Give up, or close"), self.give_up)
        row = QHBoxLayout()
        row.addWidget(self.progress, 1)
        row.addStretch(0)
        for each in (self.open_button, self.start_button, self.cancel_button):
            row.addWidget(each)
        return row

    def _folder_row(self) -> QHBoxLayout:
        row = QHBoxLayout()
        row.addWidget(self.folder_box, 1)
        row.addWidget(button("report_browse", "…", tr("Choose the folder that it is put into"), self._browse))
        return row

    def _browse(self) -> None:
        now = Path(self.folder_box.text())
        chosen = QFileDialog.getExistingDirectory(self, tr("Put the report into"), str(now.parent))
        if chosen:
            self.folder_box.setText(str(free_folder(Path(chosen), now.name)))

    # --- what is chosen --------------------------------------------------------------------------------------------

    @property
    def cover(self) -> Cover:
        """What the boxes say."""
        title = self.title_box.text().strip() or title_of(self._study)
        notes = self.notes_box.toPlainText().strip()
        return Cover(title, self.name_box.text().strip(), self.date_box.text().strip(), notes)

    @property
    def order(self) -> Order:
        """All that is wanted."""
        cover = self.cover
        kept = replace(self._state, experiment=replace(self._state.experiment, notes=Notes(cover.author, cover.notes)))
        return Order(
            Path(self.folder_box.text().strip()).expanduser(),
            cover,
            frozenset(name for name, box in self.parts.items() if box.isChecked()),
            self.animation.isChecked(),
            self.zipped.isChecked(),
            session_bytes(kept),
        )

    # --- work ------------------------------------------------------------------------------------------------------

    def start(self) -> None:
        """Begin to make the bundle."""
        self._preferences.set("student", self.name_box.text().strip())
        try:
            order = self.order
        except RvsimError as problem:
            self._tell(str(problem), "error")
            return
        self._done = order.folder
        self._work = write_bundle(self._study, order)
        self._show_working(True)
        self._slice.start()

    def give_up(self) -> None:
        """Stop the work, nothing of it stays; without work, close."""
        if self._work is None:
            self.close()
            return
        self._stop()
        self._tell(tr("Given up; nothing was written."), "muted")

    def _stop(self) -> None:
        self._slice.stop()
        work, self._work = self._work, None
        if work is not None:
            work.close()  # type: ignore[attr-defined]  # it is a generator, which cleans up after itself
        self._show_working(False)

    def _go_on(self) -> None:
        """Work for a moment; a piece of work is a formula, a picture, a page."""
        assert self._work is not None, "the timer runs only while there is work"
        try:
            progress = next(self._work, None)
        except RvsimError as problem:
            self._stop()
            self._tell(f"{tr('Not made.')} {problem}", "error")
            return
        if progress is None:
            self._stop()
            self._tell_done()
            return
        self.progress.setValue(round(1000 * progress.share))
        self.progress.setFormat(f"{progress.next} … %p %")

    def _tell_done(self) -> None:
        assert self._done is not None, "something was begun"
        folder = self._done
        archive = tr("Made: {folder} and {archive}.", folder=folder, archive=zip_of(folder).name)
        self._tell(archive if self.zipped.isChecked() else tr("Made: {folder}.", folder=folder), "muted")
        self._session.say(tr("Saved the report in {folder}.", folder=folder))
        self.open_button.setVisible(True)
        self.folder_box.setText(str(free_folder(self._done.parent, self._done.name)))  # for the next one

    def _show_working(self, working: bool) -> None:
        self.progress.setVisible(working)
        self.progress.setValue(0)
        self.start_button.setEnabled(not working)
        self.open_button.setVisible(False)
        self.cancel_button.setText(tr("Cancel") if working else tr("Close"))
        if working:
            self.status.setText("")

    def _tell(self, text: str, role: str) -> None:
        set_role(self.status, role=role)
        self.status.setText(text)

    def _open(self) -> None:
        if self._done is not None:
            QDesktopServices.openUrl(QUrl.fromLocalFile(str(self._done)))

    def closeEvent(self, event: QCloseEvent) -> None:
        """Nothing half made stays behind."""
        if self._work is not None:
            self._stop()
        super().closeEvent(event)


def _written(day: QDate) -> str:
    """A date in words, for instance "3 May 2026"."""
    month = QLocale(language().code).monthName(day.month())
    return without_isolates(tr("{day} {month} {year}", day=day.day(), month=month, year=day.year()))


def _line(name: str, title: str, text: str) -> QLineEdit:
    box = QLineEdit(text)
    box.setMaxLength(_LONGEST_LINE)
    box.setObjectName(name)
    box.setAccessibleName(title)
    return box
