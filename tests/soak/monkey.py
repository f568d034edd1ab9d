"""A monkey in the window: one life of it is a window that is built, played with, and closed in the middle of it all."""

from __future__ import annotations

import json
import random
import threading
import time
import traceback
from collections import Counter, deque
from collections.abc import Iterable, Sequence
from typing import TextIO

from monkey_choices import Choices
from monkey_deeds import Deeds
from monkey_sight import Deed, file_dialog, front
from monkey_watch import Size, Watch, size_of
from monkey_world import World
from PySide6.QtCore import QCoreApplication, QEvent, QEventLoop, QTimer
from PySide6.QtWidgets import QApplication, QMessageBox, QWidget

from rvsim.gui.app import build_window
from rvsim.gui.collector import RubbishCollector
from rvsim.gui.language_switch import WindowKeeper
from rvsim.gui.languages import wear_language
from rvsim.gui.main_window import MainWindow
from rvsim.gui.preferences import Preferences
from rvsim.language import language

REMEMBERED = 30
_AWAY = 0.95  # the answer that sends away whatever is in front
_PATIENCE = 60  # deeds, after which what stays in front is sent away
_ENDING = 5.0  # [s] within which all threads have ended after a window was closed


class Journal:
    """What was done, the last of it kept for the report; all of it in a file, one deed a line, if there is one."""

    def __init__(self, file: TextIO | None = None) -> None:
        self.last: deque[str] = deque(maxlen=REMEMBERED)
        self.counts: Counter[str] = Counter()
        self._file = file

    def note(self, number: int, deed: Deed) -> None:
        """Write down what is going to be done."""
        line = json.dumps([number, *deed])
        self.last.append(line)
        self.counts[deed.name] += 1
        if self._file is not None:
            self._file.write(line + "\n")
            self._file.flush()


def read_journal(lines: Iterable[str]) -> list[Deed]:
    """The deeds of a journal, one a line."""
    deeds = []
    for line in lines:
        _, name, values, words = json.loads(line)
        deeds.append(Deed(name, tuple(values), words))
    return deeds


class Life:
    """A window and what is done to it, in an event loop like the program's own: nested loops go on being played with.

    Args:
        seed: of all dice.
        events: how many deeds.
        world: what is around it.
        watch: gets the findings.
        replay: deeds to do instead of those that the dice choose.
        measure_every: deeds between two measurings of the size; 0 for none.
    """

    def __init__(
        self,
        seed: int,
        events: int,
        world: World,
        watch: Watch,
        journal: Journal,
        replay: Sequence[Deed] = (),
        measure_every: int = 0,
        preferences: Preferences | None = None,
    ) -> None:
        self.seed, self.events, self.world, self.watch, self.journal = seed, events, world, watch, journal
        self._threads, self._language = set(threading.enumerate()), language().code
        # Another language makes another window.
        self._keeper = WindowKeeper(
            build_window(preferences or Preferences(), robot=random.Random(seed).choice(ROBOTS))
        )
        self.sizes: list[tuple[int, Size]] = []
        self.done = 0
        self._replay, self._measure_every = replay, measure_every
        self._dice = random.Random(seed)
        self.deeds, self.choices = Deeds(self), Choices(self, self._dice)
        self._depth = self._ahead_for = self._held = 0
        self._ahead: QWidget | None = None
        self._loop = QEventLoop()
        self._last = "the start"

    @property
    def window(self) -> MainWindow:
        """The one that is seen now."""
        return self._keeper.window

    def live(self) -> None:
        """Play until all deeds are done, one of them was to quit, or something was found; then close.

        Nothing may stay behind.
        """
        self.window.show()
        self.window.document.begin()
        self.watch.rest()
        self._next(0.0)
        self._loop.exec()
        if self._measure_every:
            self._measure()
        self.die()

    # --- deeds -----------------------------------------------------------------------------------------------------

    def _next(self, pause: float) -> None:
        QTimer.singleShot(round(1000.0 * pause) or 1, self._tick)

    def _tick(self) -> None:
        try:
            self._turn()
        except Exception:
            self.watch.find(f"in the monkey's own head:\n{traceback.format_exc()}")
            self._next(0.01)

    def _turn(self) -> None:
        """One deed. The next one is called for before: a deed that waits in a loop of its own gets its answer so."""
        if self.done >= self.events or self.watch.findings or not self.window.isVisible():
            self._leave()
            return
        if self._depth and front() is None:
            self._hold_on()
            return
        if self._measure_every and self.done and self.done % self._measure_every == 0:
            self._measure()
        deed = self._replay[self.done] if self._replay else self._chosen()
        pause = float(deed.values[0]) if deed.name == "wait" else 0.0
        self.watch.turn(pause, self._last)
        self.world.dice = random.Random(f"{self.seed} {self.done}")
        with self.world.room_on_disk():
            self.journal.note(self.done, deed)
        self._last = f"{deed.name} {str(deed.values)[:80]} {deed.words}"
        self.done += 1
        self._next(pause)
        self.do(deed)

    def _hold_on(self) -> None:
        """Another deed is still being done; if that takes long it is a loop that nobody sees: a drag, say."""
        self._held += 1
        self._next(0.005)
        if self._held > _PATIENCE:
            self._held = 0
            self.deeds.do(Deed("key", ("Escape",)))

    def do(self, deed: Deed) -> None:
        self._depth += 1
        self._held = 0
        try:
            self.deeds.do(deed)
        except Exception as error:
            if not _slipped(error):
                self.watch.find(f"in the monkey's own hands:\n{traceback.format_exc()}")
        finally:
            self._depth -= 1

    def _chosen(self) -> Deed:
        """What the dice say; but what has been in front for long goes."""
        ahead = front()
        self._ahead_for = self._ahead_for + 1 if ahead is not None and ahead is self._ahead else 0
        self._ahead = ahead
        if self._ahead_for > _PATIENCE and file_dialog() is None:
            return Deed("answer", (_AWAY,), "at last")
        return self.choices.choose()

    def _leave(self) -> None:
        """Out of all inner loops, then out of the outer one."""
        self.watch.rest()
        ahead = front()
        if ahead is None and self._depth:
            self._hold_on()
            return
        if ahead is not None:
            self._next(0.01)
            self.do(Deed("file_dialog" if file_dialog() is not None else "answer", () if file_dialog() else (_AWAY,)))
            return
        self._loop.quit()

    # --- sizes -----------------------------------------------------------------------------------------------------

    def _measure(self) -> None:
        """As large as it is with nothing open and nothing to undo."""
        if front() is not None or self._depth:
            return
        self.watch.rest()
        self.world.fill_disk(False)
        for widget in QApplication.topLevelWidgets():
            if widget is not self.window and widget.isVisible() and not self.window.isAncestorOf(widget):
                widget.close()
        self.window.session.undo_stack.clear()
        self.sizes.append((self.done, size_of(self.window)))

    # --- the end ---------------------------------------------------------------------------------------------------

    def die(self) -> None:
        began = time.perf_counter()
        collector = RubbishCollector()  # or the thread of the watch collects parts of the window while it goes
        self.world.fill_disk(False)
        self._start_something()
        self._close()
        if self.window.isVisible():
            self.watch.find("the window does not close")
        QCoreApplication.processEvents()
        self.window.deleteLater()
        for widget in QApplication.topLevelWidgets():
            widget.close()
            widget.deleteLater()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
        QCoreApplication.processEvents()
        app = QApplication.instance()
        assert isinstance(app, QApplication)
        wear_language(app, self._language)
        self._await_threads(began)
        collector.end()

    def _close(self) -> None:
        """As somebody does it who does not want to save."""
        self.window.close()
        question = self.window.findChild(QMessageBox, "unsaved_question")
        if question is not None and question.isVisible():
            question.button(QMessageBox.StandardButton.Discard).click()

    def _start_something(self) -> None:
        """Closing in the middle of any work."""
        work = self._dice.sample(("trigger", "page", "connect_arm", "trigger", "key"), 3)
        for deed in [self.choices.named(name) for name in work]:
            self.journal.note(self.done, deed)
            QTimer.singleShot(50, self._send_away)
            self.do(deed)

    def _send_away(self) -> None:
        while front() is not None:
            self.do(Deed("answer", (_AWAY,)))

    def _await_threads(self, began: float) -> None:
        while threads := set(threading.enumerate()) - self._threads:
            if time.perf_counter() - began > _ENDING:
                self.watch.find(f"threads that live on after the window was closed: {threads}")
                return
            time.sleep(0.01)


def _slipped(error: Exception) -> bool:
    """Whether a menu went while the monkey was about to click it."""
    innermost = traceback.extract_tb(error.__traceback__)[-1].filename
    return isinstance(error, RuntimeError) and "already deleted" in str(error) and "monkey" in innermost


ROBOTS = ("rv-m1", "rv-1a", "ur5e", "rrrp", "al5b", "planar", "scara", "cartesian")
