"""The session as a file: new, open, save, whether there is something to lose, and the question before it is lost."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Qt
from PySide6.QtGui import QUndoCommand
from PySide6.QtWidgets import QFileDialog, QMessageBox

from rvsim.errors import RvsimError, SessionFileError
from rvsim.experiment import Experiment
from rvsim.files.session_file import ENDING, load_session, save_session, session_bytes
from rvsim.gui.autosave import Autosave, Copied, Leftover, autosave_seconds
from rvsim.gui.document_state import port_section, show_state, state_of
from rvsim.gui.file_drop import FileDrop
from rvsim.gui.file_problem import tell_problem
from rvsim.gui.recent_files import RecentFiles
from rvsim.gui.theme import set_role
from rvsim.language import sentences, tr, tr_later

if TYPE_CHECKING:
    from rvsim.gui.main_window import MainWindow

_UNTITLED = tr_later("Untitled")
_RUN_NOT_SAVED = tr_later("The run on the arm is not in it: keep it as CSV on the Measured page, or in a lab report.")
Then = Callable[[], object]


@dataclass
class _File:
    """The file of the session; windows in other languages, one after the other, share it."""

    path: Path | None = None
    read_only: bool = False


class _SetAside(QUndoCommand):
    """The session has no file any more; undone, it has the one that it had."""

    def __init__(self, file: _File) -> None:
        super().__init__()
        self._file, self._other = file, _File()

    def redo(self) -> None:
        """Change the one for the other."""
        now = replace(self._file)
        self._file.path, self._file.read_only = self._other.path, self._other.read_only
        self._other = now

    def undo(self) -> None:
        """Change them back."""
        self.redo()


class Document(QObject):
    """One to a window. It asks and makes safety copies only once `begin` was called: not in tests and pictures.

    Attributes:
        asks: whether it asks before something is lost.
    """

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window)
        self._window, self._session = window, window.session
        self._file = _File()
        self.asks = False
        self._clean = True  # as the undo stack has it
        self._unsaved = False  # a recovered copy, which no file holds yet
        self._leaving = False
        self._question: QMessageBox | None = None
        self._port = port_section(window)
        self._saved_port = self._port.settings
        self.recent = RecentFiles(window.preferences)
        self.autosave = Autosave(self._to_copy, self)
        self.autosave.failed.connect(self._on_copy_failed)
        self._drop = FileDrop(window, {ENDING: self.ask_and_open, ".toml": window.commands.open_toml})
        self._session.undo_stack.cleanChanged.connect(self._on_clean)
        self._session.undo_stack.indexChanged.connect(self._on_step)
        self._session.changed.connect(self._on_changed)
        self._port.edited.connect(self.show_title)
        self.show_title()

    def begin(self) -> None:
        """From now on ask before something is lost, and make safety copies."""
        self.asks = True
        self.autosave.start(autosave_seconds())

    def take_over(self, other: Document) -> None:
        """Go on with the file of a window that this one takes the place of."""
        self._file, self._unsaved = other._file, other._unsaved
        self._clean, self._saved_port = other._clean, other._saved_port
        if other.asks:
            self.begin()
            self.autosave.tick()  # before the other's copy goes
        other.asks = False
        self.show_title()

    # --- its file ----------------------------------------------------------------------------------------------------

    @property
    def path(self) -> Path | None:
        """Of the session's file, None before it has one."""
        return self._file.path

    @property
    def read_only(self) -> bool:
        """Whether a newer rvsim wrote the file: it is saved elsewhere."""
        return self._file.read_only

    def set_aside(self) -> None:
        """Something else is shown from now on, in a session without a name: saved, it does not replace this file.

        It belongs to the undo step that is being made, and is undone with it.
        """
        if self.path is not None:
            self._session.undo_stack.push(_SetAside(self._file))

    # --- what is to be lost ------------------------------------------------------------------------------------------

    @property
    def dirty(self) -> bool:
        """Whether there is something that no file holds."""
        return self._unsaved or not self._clean or self._port.settings != self._saved_port

    @property
    def name(self) -> str:
        """What the session is called."""
        return self.path.stem if self.path is not None else tr(_UNTITLED)

    def show_title(self) -> None:
        """The window's title: "name* – RV-M1 – rvsim"."""
        title = f"{self.name}{'*' if self.dirty else ''} \u2013 {tr(self._session.robot.title)} \u2013 rvsim"
        self._window.setWindowTitle(title.replace("[*]", "[*][*]"))

    def _on_clean(self, clean: bool) -> None:
        self._clean = clean
        self.show_title()

    def _on_step(self, _index: int) -> None:
        self.show_title()  # a step may have been that to an example, which has no file

    def _on_changed(self, before: Experiment, after: Experiment) -> None:
        if after.robot is not before.robot:
            self.show_title()

    def may_close(self) -> bool:
        """Whether the window may close now; if not, the question is asked and the window closes after the answer."""
        if self._leaving or not (self.asks and self.dirty):
            self.autosave.close()
            return True
        self.leave(self._close)
        return False

    def _close(self) -> None:
        self._leaving = True
        self._window.close()

    def leave(self, then: Then) -> None:
        """Do what takes the place of the session: at once, or once it is saved or given up."""
        if not (self.asks and self.dirty):
            then()
            return
        if self._question is not None:
            self._question.close()
        box = QMessageBox(
            QMessageBox.Icon.Question, "rvsim", tr("Save the changes to “{name}”?", name=self.name), parent=self._window
        )
        box.setObjectName("unsaved_question")
        box.setInformativeText(tr("What is not saved will be lost."))
        buttons = QMessageBox.StandardButton
        box.setStandardButtons(buttons.Save | buttons.Discard | buttons.Cancel)
        box.setDefaultButton(buttons.Save)
        for each, text in (
            (buttons.Save, tr("Save")),
            (buttons.Discard, tr("Discard")),
            (buttons.Cancel, tr("Cancel")),
        ):
            box.button(each).setText(text)
        set_role(box.button(buttons.Save), primary=True)
        box.setEscapeButton(buttons.Cancel)
        box.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        box.finished.connect(lambda answer: self._answered(answer, then))
        self._question = box
        box.open()

    def _answered(self, answer: int, then: Then) -> None:
        self._question = None
        buttons = QMessageBox.StandardButton
        if answer == buttons.Discard.value or (answer == buttons.Save.value and self.save()):
            then()

    # --- new and open ------------------------------------------------------------------------------------------------

    def new(self) -> None:
        """Begin anew with the arm in use, after asking."""
        self.leave(self._new)

    def _new(self) -> None:
        robot = self._session.at_rest.robot
        self._window.device.disconnect_device()
        self._window.tracker.clear()
        self._window.motion.load(None, "")
        self._session.begin(self._session.fresh(robot))
        self._became(None)
        self._window.scene_view.fit()
        self._session.say(tr("A new session. Drag a slider, or press Track line."))

    def ask_open(self) -> None:
        """Ask for a file, and open it."""
        self.leave(self._ask_open)

    def _ask_open(self) -> None:
        file, _ = QFileDialog.getOpenFileName(self._window, tr("Open session"), str(self._folder()), _filter())
        if file:
            self.open(Path(file))

    def ask_and_open(self, file: Path) -> None:
        """Open this file, after asking."""
        self.leave(partial(self.open, file))

    def open(self, file: Path) -> bool:
        """Open a file, or say why it cannot be opened; whether it was."""
        try:
            opened = load_session(file)
        except SessionFileError as problem:
            self._fail(tr("This session cannot be opened."), str(problem))
            return False
        show_state(self._window, opened.state)
        self._became(file.absolute(), read_only=opened.read_only)
        self.recent.add(file)
        self._session.say(opened.notice or tr("Opened {file}.", file=file), "warning" if opened.read_only else "info")
        return True

    def recover(self, leftover: Leftover) -> bool:
        """Go on with what a crash has left; whether it could be read."""
        try:
            opened = load_session(leftover.file)
        except SessionFileError as problem:
            self._fail(tr("This copy cannot be recovered."), str(problem))
            return False
        show_state(self._window, opened.state)
        self._became(leftover.original, unsaved=True)
        self.autosave.tick()
        if self.autosave.is_made:
            leftover.delete()
        self._session.say(tr("Recovered “{name}”. Save it to keep it.", name=self.name))
        return True

    def _became(self, path: Path | None, *, read_only: bool = False, unsaved: bool = False) -> None:
        """The window shows another session."""
        self._file.path, self._file.read_only, self._unsaved = path, read_only, unsaved
        self._saved_port = self._port.settings
        self._session.undo_stack.setClean()
        if not unsaved:
            self.autosave.forget()
        self.show_title()

    # --- save --------------------------------------------------------------------------------------------------------

    def save(self) -> bool:
        """Save where it was opened, or ask where; whether it is saved."""
        if self.path is None or self.read_only:
            return self.save_as()
        return self.save_to(self.path)

    def save_as(self) -> bool:
        """Ask where, and save there; whether it is saved."""
        dialog = QFileDialog(self._window, tr("Save session as"), str(self._folder()), _filter())
        dialog.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
        dialog.setDefaultSuffix(ENDING.removeprefix("."))
        dialog.selectFile(self._name_to_save())
        if not dialog.exec():
            return False
        return self.save_to(Path(dialog.selectedFiles()[0]))

    def _name_to_save(self) -> str:
        """The name that a file dialog begins with; beside a file that must not be replaced, a new one."""
        if self.path is None or not self.read_only:
            return f"{self.path.stem if self.path else self._session.robot.name}{ENDING}"
        names = (f"{self.path.stem} {number}{ENDING}" for number in count(2))
        return next(name for name in names if not self.path.with_name(name).exists())

    def save_to(self, file: Path) -> bool:
        """Save there, or say why not; whether it is saved. What is open stays as it is either way."""
        if self.read_only and self.path is not None and _is_same(file, self.path):
            self._fail(
                tr("Not saved."), tr("{name} was written by a newer rvsim: choose another name.", name=file.name)
            )
            return False
        state = state_of(self._window)
        try:
            save_session(state, file)
        except RvsimError as problem:
            advice = tr("Try another place, with “Save as”.")
            self._fail(tr("Not saved: your work is still here."), f"{problem} {advice}")
            return False
        self._became(file.absolute())
        self.recent.add(file)
        said = tr("Saved {file}.", file=file)
        self._session.say(sentences(said, tr(_RUN_NOT_SAVED)) if self._has_run() else said)
        return True

    def _has_run(self) -> bool:
        """Whether a motion has run on the arm that is connected: its recording is in no session file."""
        recording = self._window.device.recording
        return recording is not None and not recording.empty

    def _folder(self) -> Path:
        last = self.path or next(iter(self.recent.files), None)
        return last.parent if last is not None else Path.home()

    # --- inside ------------------------------------------------------------------------------------------------------

    def _fail(self, what: str, problem: str) -> None:
        tell_problem(self._window, self._session, what, problem)

    def _on_copy_failed(self, sentence: str) -> None:
        self._session.say(sentence, "warning")

    def _to_copy(self) -> Copied | None:
        if not self.dirty:
            return None
        mark = (self._session.experiment, self.path, *self._session.left, *vars(self._port.settings).values())
        return Copied(mark, self.path, lambda: session_bytes(state_of(self._window)))


def _filter() -> str:
    """Of the dialogs that ask for a file."""
    return tr("Sessions of rvsim (*{ending})", ending=ENDING)


def _is_same(file: Path, other: Path) -> bool:
    try:
        return file.samefile(other)
    except OSError:
        return file.absolute() == other.absolute()
