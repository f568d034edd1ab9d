"""Closing the window in the middle of its work: each action of the menus and each button of the pages is a work."""

from __future__ import annotations

import threading
import time
from pathlib import Path

from monkey_deeds import Deeds
from monkey_sight import Deed, front
from monkey_watch import Watch
from monkey_world import World
from PySide6.QtCore import QCoreApplication, QEvent, QEventLoop, QTimer
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QAbstractButton, QApplication, QDialog, QWidget

from rvsim.gui.app import build_window
from rvsim.gui.page_stack import PageStack
from rvsim.gui.preferences import Preferences

LONGEST = 1.0  # [s] of computing, of all threads, that closing may take: on the wall a busy machine takes longer
_ENDING = 5.0  # [s] within which all threads have ended
_WIRED = frozenset(("device", "wire", "calibrate", "measured", "virtual"))  # pages that need an arm
# Dialogs whose work begins with a button of their own.
STARTS = {"action_lab_report": "report_start", "action_save_animation": "animation_start"}


class Closing:
    """One window, one work in it, and the end.

    Args:
        work: the name of an action, or "page/button".
        delay: seconds from the work's begin to the window's end.
        slowness: whether slow closing is a finding; the tests judge no times.
    """

    def __init__(self, work: str, delay: float, world: World, watch: Watch, slowness: bool = True) -> None:
        self.work, self.delay, self.world, self.watch = work, delay, world, watch
        self._slowness = slowness
        self._threads = set(threading.enumerate())
        self.window = build_window(Preferences(), robot="rv-m1")
        self.deeds = Deeds(self)
        self.took = 0.0

    def run(self) -> None:
        """Begin the work, close, and see what is left."""
        self.window.show()
        self.window.document.begin()
        QApplication.processEvents()
        if self.work in STARTS:
            self._move()
        QTimer.singleShot(round(1e3 * self.delay), self._send_away)
        self.begin()
        self._pass(self.delay)
        self.close()

    def begin(self) -> None:
        """Begin the work."""
        page, _, button = self.work.rpartition("/")
        if not page:
            self.deeds.do(Deed("trigger", (button,)))
            self._press(STARTS.get(button, ""))
            return
        if page in _WIRED:
            self.deeds.do(Deed("connect_arm", (0,)))
            self._pass(0.05)
        self.window.docks.show_panel(page)
        self._press(button)

    def _move(self) -> None:
        """A motion, without which there is little to write."""
        window = self.window
        window.tracker.track_line()
        while window.tracker.busy:
            self._pass(0.01)
        window.motion.pause()

    def _press(self, name: str) -> None:
        found = self.window.findChild(QAbstractButton, name) if name else None
        if found is not None and found.isEnabled():
            found.click()

    def _pass(self, seconds: float) -> None:
        loop = QEventLoop()
        QTimer.singleShot(round(1e3 * seconds), loop.quit)
        loop.exec()

    def _send_away(self) -> None:
        for _ in range(10):
            ahead = front()
            if ahead is None:
                return
            ahead.reject() if isinstance(ahead, QDialog) else ahead.close()

    def close(self) -> None:
        """As a person does it who does not want to save; nothing may stay."""
        began = time.process_time()
        self.window.close()
        question = self.window.findChild(QWidget, "unsaved_question")
        if question is not None:
            question.button(question.StandardButton.Discard).click()
        self.took = time.process_time() - began
        if self._slowness and self.took > LONGEST:
            self.watch.find(f"{self.work}: closing took {self.took:.1f} s")
        QApplication.processEvents()
        seen = [w for w in QApplication.topLevelWidgets() if w.isVisible()]
        if seen:
            self.watch.find(f"{self.work}: still seen after the end: {seen}")
        self._look_for_files()
        self._bury()
        self._await_threads(time.perf_counter() + _ENDING)

    def _bury(self) -> None:
        self.window.deleteLater()
        for widget in QApplication.topLevelWidgets():
            widget.close()
            widget.deleteLater()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
        QApplication.processEvents()

    def _look_for_files(self) -> None:
        """Half a file, or a safety copy of what was given up."""
        places = self.world.folder / "out", self.world.folder / "user" / "autosave", Path.cwd()
        found = [f for place in places if place.is_dir() for f in place.iterdir() if f.name.startswith(".")]
        found += places[1].glob("*.rvsim")
        if found:
            self.watch.find(f"{self.work}: left behind: {found}")

    def _await_threads(self, end: float) -> None:
        while left := set(threading.enumerate()) - self._threads:
            if time.perf_counter() > end:
                self.watch.find(f"{self.work}: threads that live on after the window was closed: {left}")
                return
            time.sleep(0.01)


def all_works() -> list[str]:
    """Each action, and each button of each page."""
    window = build_window(Preferences(), robot="al5b")
    window.show()
    actions = {a.objectName() for a in window.findChildren(QAction) if a.objectName().startswith("action_")}
    works = sorted(actions - {"action_quit"})
    for page in [page.name for stack in window.findChildren(PageStack) for page in stack.pages]:
        window.docks.show_panel(page)
        QApplication.processEvents()
        shown = [b for b in window.findChildren(QAbstractButton) if not b.visibleRegion().isEmpty()]
        inside = [b for b in shown if b.window() is window and window.docks.front.isAncestorOf(b)]
        works += sorted({f"{page}/{b.objectName()}" for b in inside if b.objectName()})
    window.close()
    window.deleteLater()
    return works
