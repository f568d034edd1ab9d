"""Another language while rvsim runs: a window built anew takes the place of the old one, with all that it held."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QByteArray, QObject, QTimer
from PySide6.QtWidgets import QApplication

from rvsim.gui.document_state import port_section, show_view, view_of
from rvsim.gui.languages import system_language, wear_language
from rvsim.gui.main_window import MainWindow
from rvsim.gui.theme import prepare_theme, wear_theme
from rvsim.language import LANGUAGES, language, tr, tr_later

_NO_LONGER = tr_later("The arm no longer follows: switch “Follow the window” on again under Device › Drive.")


class WindowKeeper(QObject):
    """Keeps the one window of the application. When the preferences ask for another language, it makes another.

    Attributes:
        window: the one that is shown now.
    """

    def __init__(self, window: MainWindow) -> None:
        super().__init__()
        self.window = window
        self._listen()

    def _listen(self) -> None:
        self.window.preferences.changed.connect(self._on_preference)

    def _on_preference(self, name: str) -> None:
        if name == "language":
            QTimer.singleShot(0, self, self._switch)  # the menu of the old window must close first

    def _switch(self) -> None:
        code = self.window.preferences["language"] or system_language()
        if code != language().code:
            followed = self.window.device.live
            self.window.device.set_live(False)
            old, self.window = self.window, _successor(self.window, code)
            emptied = partial(_empty, [old, *old.findChildren(QObject)])
            old.destroyed.connect(lambda: QTimer.singleShot(0, emptied))  # some have a last thing to do
            old.deleteLater()
            self._listen()
            self.window.session.say(tr("rvsim speaks {language} now.", language=LANGUAGES[code].name))
            if followed:  # an arm moves by itself only as long as somebody has just said so
                self.window.session.warn(tr(_NO_LONGER))


def _empty(parts: list[QObject]) -> None:
    """Let go of what the Python side of a destroyed window holds: Qt for Python 6.11 keeps these objects for good."""
    for part in parts:
        getattr(part, "__dict__", {}).clear()
    parts.clear()


def _successor(old: MainWindow, code: str) -> MainWindow:
    """A window in another language in the place of `old`: its session and undo, file, motion, arm, view and layout."""
    app = QApplication.instance()
    assert isinstance(app, QApplication)
    old.setUpdatesEnabled(False)
    old.motion.pause()
    view, port, tracking = view_of(old), port_section(old).settings, old.session.tracking
    (geometry, layout), widths = old.window_layout(), old.dragged_widths
    mirrored = LANGUAGES[code].right_to_left != language().right_to_left
    wear_language(app, code)
    preferences = old.preferences.successor()
    prepare_theme(preferences)
    new = MainWindow(old.session.successor(), preferences, old.library, old.choice)
    wear_theme(preferences)
    new.dress_narrowest()
    new.lay_out(geometry, QByteArray() if mirrored else layout, widths)
    port_section(new).show_settings(port)
    new.document.take_over(old.document)
    new.tracker.take_over(old.tracker, tracking)
    new.motion.take_over(old.motion)
    new.device.take_over(old.device)
    new.served.take_over(old.served)
    new.docks.take_over(old.docks)
    show_view(new, view)
    new.setVisible(old.isVisible())
    _go_on_with_tour(old, new)
    _open_beside(old, new)
    old.document.autosave.close()
    old.rest()
    return new


def _go_on_with_tour(old: MainWindow, new: MainWindow) -> None:
    """Who changes the language on the tour is shown the rest of it."""
    if old.findChild(QObject, "tour") is not None:
        from rvsim.gui.tour import Tour, begin_tour  # most windows never show it

        begin_tour(new).go(next(tour.step for tour in old.findChildren(Tour)))


def _open_beside(old: MainWindow, new: MainWindow) -> None:
    """What is written and read beside the window goes on: notes and help."""
    from rvsim.gui.help.window import HelpWindow  # neither is needed at the start
    from rvsim.gui.notes_dialog import NotesDialog

    notes, pages = old.findChild(NotesDialog), old.findChild(HelpWindow)
    if notes is not None and notes.isVisible():
        NotesDialog(new.session, new).take_over(notes)
    if pages is not None and pages.isVisible():
        HelpWindow(new).take_over(pages)
