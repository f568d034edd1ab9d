"""The Wire page: every line that goes to the arm and comes back, live, in bytes and in words."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QCheckBox, QFileDialog, QHBoxLayout, QVBoxLayout, QWidget

from rvsim.errors import FileWriteError
from rvsim.experiment import Experiment
from rvsim.gui.device_control import DeviceControl
from rvsim.gui.panels.device_wire_feed import WireFeed
from rvsim.gui.panels.device_wire_find import FindRow
from rvsim.gui.panels.device_wire_model import WireModel
from rvsim.gui.panels.device_wire_reading import LineReading, TryLine
from rvsim.gui.panels.device_wire_search import WireSearch
from rvsim.gui.panels.device_wire_table import WireTable, fixed_font
from rvsim.gui.panels.device_wire_words import Words, milliseconds
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.inspect_page import InspectPage
from rvsim.gui.preferences import Preferences
from rvsim.gui.served_arm import ServedArm
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.gui.theme import THEMES, set_role
from rvsim.gui.widgets import button, column_of, scrolled
from rvsim.gui.workers import LatestWorker
from rvsim.language import tr, tr_later, trn

_EMPTY = tr_later(
    "Nothing has gone over the wire yet: connect an arm on the Drive page, or serve one on the Virtual page.\n\n"
    "Then each line that goes to the arm (→) and each answer (←) is listed here with its time. Point at one to read "
    "what it means. The virtual arm speaks as a real one does, byte for byte."
)
_CLEARED = tr_later("Cleared. New lines appear as they come; Save still writes the whole log.")


class WirePage(InspectPage):
    """Shows the log of the connection there is, of an arm that is served, or of the last one."""

    title = tr_later("Wire")
    name = "wire"

    def __init__(
        self,
        session: Session,
        preferences: Preferences,
        stage: Stage,
        device: DeviceControl,
        served: ServedArm | None = None,
    ) -> None:
        super().__init__(session, preferences, stage)
        self._device, self._served = device, served
        self._sent = self._received = 0
        self.model = WireModel(Words("ssc32", session.robot), fixed_font())
        self.feed = WireFeed(self.model, self)
        self.search = WireSearch(self.model, self)
        self.table = WireTable(self.model)
        self.find_row = FindRow(self.search, self.table)
        self.reading, self.trial = LineReading(), TryLine()
        self.worker = worker = LatestWorker(self)
        self.destroyed.connect(lambda: worker.close())
        self._make_controls()
        self._lay_out()
        self._connect()
        self._show_counts()

    def _make_controls(self) -> None:
        self.pause = button("wire_pause", tr("Pause"), tr("Hold the view; the wire goes on"), self.toggle_pause)
        self.clear = button("wire_clear", tr("Clear"), tr("Empty the view; the log keeps everything"), self.feed.clear)
        self.copy = button(
            "wire_copy", tr("Copy"), tr("Copy the selected lines, or all that are shown"), self.copy_lines
        )
        self.save = button("wire_save", tr("Save…"), tr("Write the whole log to a text file"), self.ask_file)
        self.end = button(
            "wire_end",
            tr("Newest ▼"),
            tr("Go to the newest line, and stay with it as lines come"),
            self.table.follow_end,
        )
        self.hide_polling = QCheckBox(tr("Hide polling"))
        self.hide_polling.setObjectName("wire_hide_polling")
        self.hide_polling.setToolTip(
            tr("Leave out what asks again and again where the arm is (Q, QP, VA …; Poll), and its answers")
        )
        self.counters, self.note, self.empty = wrapped_label("muted"), wrapped_label(), wrapped_label("muted")
        self.counters.setObjectName("wire_counters")
        self.note.setObjectName("wire_note")
        self.empty.setObjectName("wire_empty")
        self.empty.setText(tr(_EMPTY))

    def _lay_out(self) -> None:
        inside, self.inside = QWidget(), QWidget()
        column = _column(self.inside, 0, 0)
        column.addWidget(self.counters)
        buttons = QHBoxLayout()
        buttons.setSpacing(6)
        for made in (self.pause, self.clear, self.copy, self.save):
            buttons.addWidget(made, 1)
        column.addLayout(buttons)
        column.addWidget(self.find_row)
        choices = QHBoxLayout()
        choices.addWidget(self.hide_polling, 1)
        choices.addWidget(self.end)
        column.addLayout(choices)
        for widget, share in ((self.note, 0), (self.table, 1), (self.reading, 0)):
            column.addWidget(widget, share)
        page = _column(inside, 12, 8)
        page.addWidget(self.empty)
        page.addWidget(self.inside, 1)
        page.addWidget(self.trial)
        self._rest = QWidget()
        page.addWidget(self._rest, 1)
        column_of(self, scrolled(inside))

    def _connect(self) -> None:
        self._device.polled.connect(self._on_polled)
        self._device.state_changed.connect(lambda _: self._on_polled())
        if self._served is not None:
            self._served.watched.connect(self._on_polled)
        self.feed.fed.connect(self._show_counts)
        self.hide_polling.toggled.connect(self._on_hide)
        self.table.following_changed.connect(self.end.setDisabled)
        self.table.picked.connect(lambda line: self.reading.show_line(line, self.model.words))
        self.find_row.add_shortcuts(self)
        self.worker.done.connect(self._on_saved)
        self.end.setDisabled(True)
        self.reading.show_line(None, None)

    def concerns(self, before: Experiment, after: Experiment) -> bool:
        """The names of the joints alone."""
        return after.robot is not before.robot

    def set_seen(self, seen: bool) -> None:
        """Read the log only while somebody looks."""
        super().set_seen(seen)
        if not seen:
            self.feed.rest()

    def refresh(self) -> None:
        """Catch up with the log; colours and names too."""
        self.model.wear(THEMES[self._preferences["theme"]], fixed_font())
        driver = self._device.driver
        self.trial.use_robot(self._session.robot if driver is None else driver.robot)
        self._on_polled()

    # --- the log ---------------------------------------------------------------------------------------------------

    def _on_polled(self) -> None:
        """The log is remembered even while nobody looks: it is to be read after the connection too."""
        driver, state, served = self._device.driver, self._device.state, self._served
        if driver is not None:
            self.feed.use(driver.log, driver.language, driver.robot)
        elif served is not None and served.arm is not None and served.log is not None:
            self.feed.use(served.log, "ssc32", served.arm.robot)
            self._sent, self._received = served.received_bytes, served.sent_bytes
        if state is not None:
            self._sent, self._received = state.sent_bytes, state.received_bytes
        if self.seen:
            self.feed.pull()

    def toggle_pause(self) -> None:
        """Hold the view, or let it go on."""
        self.feed.paused = not self.feed.paused
        self.feed.pull()

    def _on_hide(self, hide: bool) -> None:
        self.model.hide_polling(hide)
        self._show_counts()

    def _show_counts(self) -> None:
        """Whether there is anything, how much has gone, and what is not shown."""
        nothing = self.feed.log is None or not self.feed.log.count
        self.empty.setVisible(nothing)
        self.inside.setVisible(not nothing)
        self._rest.setVisible(nothing)
        self.trial.setVisible(self.model.words.language == "ssc32")
        _say(self.counters, self._counters())
        _say(self.note, self._note())
        set_role(self.note, level="warning" if self.feed.paused else "")
        self.pause.setText(tr("Resume") if self.feed.paused else tr("Pause"))

    def _counters(self) -> str:
        counted = tr("{sent:,} bytes sent, {received:,} received.", sent=self._sent, received=self._received)
        if not self.feed.slowest:
            return counted
        latest, slowest = milliseconds(self.feed.latest), milliseconds(self.feed.slowest)
        return f"{counted} " + tr(
            "Answers after {latest}, the slowest after {slowest}.", latest=latest, slowest=slowest
        )

    def _note(self) -> str:
        lines, shown = len(self.model.lines), len(self.model.shown)
        if self.feed.paused:
            return trn(
                "Paused. {n:,} line came meanwhile: press Resume.",
                "Paused. {n:,} lines came meanwhile: press Resume.",
                self.feed.meanwhile,
            )
        if not lines:
            return tr(_CLEARED)
        if shown < lines:
            return trn(
                "{n:,} line of polling hidden, {shown:,} shown.",
                "{n:,} lines of polling hidden, {shown:,} shown.",
                lines - shown,
                shown=shown,
            )
        return ""

    # --- taking it away --------------------------------------------------------------------------------------------

    def copy_lines(self) -> None:
        """The selected lines, or all that are shown, as text."""
        text, count = self.table.chosen_text()
        QGuiApplication.clipboard().setText(text)
        self._session.say(trn("Copied {n:,} line of the wire.", "Copied {n:,} lines of the wire.", count))

    def ask_file(self) -> None:
        """Ask where to, and write the whole log there."""
        start = str(Path.home() / f"{self._session.robot.name}-wire.txt")
        chosen, _ = QFileDialog.getSaveFileName(self, tr("Save the wire log"), start, tr("Text") + " (*.txt *.log)")
        if chosen:
            self.save_to(Path(chosen) if Path(chosen).suffix else Path(chosen).with_suffix(".txt"))

    def save_to(self, path: Path) -> None:
        """Write the whole log, hidden and cleared lines too; the window does not wait."""
        if self.feed.log is not None:
            self.worker.ask(partial(_saved, self.feed.log.save, path))

    def _on_saved(self, said: tuple[str, str]) -> None:
        self._session.say(said[0], "error" if said[1] == "error" else "info")


def _column(widget: QWidget, sides: int, ends: int) -> QVBoxLayout:
    column = QVBoxLayout(widget)
    column.setContentsMargins(sides, ends, sides, ends)
    column.setSpacing(8)
    return column


def _say(label: QWidget, text: str) -> None:
    """A text that changes often costs nothing while it stays the same."""
    if label.property("text") != text:
        label.setProperty("text", text)
    label.setVisible(bool(text))


def _saved(save: Callable[[Path], None], path: Path) -> tuple[str, str]:
    """Done by the worker: the sentence about it, and how serious it is."""
    try:
        save(path)
    except FileWriteError as problem:
        return tr("Not saved: {problem}", problem=problem), "error"
    return tr("Saved {path}.", path=path), "info"
