"""What is watched while the monkey plays: exceptions, what Qt says, turns of the event loop, memory."""

from __future__ import annotations

import ctypes
import faulthandler
import gc
import os
import sys
import threading
import time
import traceback
from collections import Counter
from types import TracebackType
from typing import Any, NamedTuple

import numpy as np
from PySide6.QtCore import QCoreApplication, QEvent, QMessageLogContext, QObject, QtMsgType, qInstallMessageHandler
from PySide6.QtWidgets import QApplication, QWidget

# The off-screen platform says the first of any window; the second is about the monkey, who clicks beside a menu.
_MEANT = ("This plugin does not support", "Mouse event at ")
_TELLING = (QtMsgType.QtWarningMsg, QtMsgType.QtCriticalMsg, QtMsgType.QtFatalMsg)
LONGEST = 1.0  # [s] of computing between two turns of the event loop
WINDOW_BUILT = 2.0  # [s] of computing, where another language makes a whole window anew
STUCK = 20.0  # [s] by the clock on the wall, however busy the machine is
_AROUND = 14  # calls that are told of
_SAMPLED = 0.5  # [s] after which it is looked up where the program is


class Turn(NamedTuple):
    """From one deed to the next: seconds on the wall, of the window's thread, of the whole process."""

    wall: float
    thread: float
    process: float

    @staticmethod
    def now() -> Turn:
        """The clocks' present state."""
        return Turn(time.perf_counter(), time.thread_time(), time.process_time())


class Watch:
    """Collects findings; a context that holds the hooks while it is entered.

    Args:
        slowness: whether a slow turn is a finding; the tests judge no times.
    """

    def __init__(self, slowness: bool = True) -> None:
        self._slowness = slowness
        self.findings: list[str] = []
        self.turns: list[Turn] = []
        self.slow: Counter[str] = Counter()
        self._begun: Turn | None = None
        self._pause = 0.0
        self._where = ""
        self._over = threading.Event()

    def __enter__(self) -> Watch:
        self._hooks = sys.excepthook, threading.excepthook
        sys.excepthook = self._on_exception
        threading.excepthook = lambda args: self._on_exception(
            args.exc_type, args.exc_value or args.exc_type(), args.exc_traceback
        )
        self._handler: Any = qInstallMessageHandler(self._on_message)
        self._over.clear()
        self._sampler = threading.Thread(target=self._sample, daemon=True)
        self._sampler.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._over.set()
        self._sampler.join()
        sys.excepthook, threading.excepthook = self._hooks
        qInstallMessageHandler(self._handler)

    def find(self, what: str) -> None:
        """Something that must not be."""
        self.findings.append(what)

    def _on_exception(self, kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
        around = "".join(traceback.format_stack(limit=_AROUND))
        self.find(f"{''.join(traceback.format_exception(kind, error, trace))}while in\n{around}")

    def _on_message(self, kind: QtMsgType, _context: QMessageLogContext, text: str) -> None:
        if kind in _TELLING and not text.startswith(_MEANT):
            self.find(f"Qt says: {text}\n{''.join(traceback.format_stack(limit=_AROUND))}")

    # --- turns -----------------------------------------------------------------------------------------------------

    def turn(self, pause: float, what: str) -> None:
        """The event loop has come round; the next deed comes in `pause` seconds. `what` was done before."""
        now = Turn.now()
        if self._begun is not None:
            spent = Turn(*(late - early for late, early in zip(now, self._begun, strict=True)))
            self._judge(spent._replace(wall=spent.wall - self._pause), what)
        self._begun, self._pause, self._where = now, pause, ""

    def rest(self) -> None:
        """What happens until the next turn does not count: the soak itself is at work."""
        self._begun = None

    def _judge(self, turn: Turn, what: str) -> None:
        self.turns.append(turn)
        longest = WINDOW_BUILT if "action_language_" in what else LONGEST
        if self._slowness and (turn.wall > STUCK or min(turn.wall, turn.thread) > longest):
            self.slow[what] += 1
            self.find(f"{turn} after {what}\n{self._where}")

    def _sample(self) -> None:
        while not self._over.wait(0.1):
            begun = self._begun
            if begun is not None and not self._where and time.perf_counter() - begun.wall - self._pause > _SAMPLED:
                self._where = self._look()

    def _look(self) -> str:
        """Where each thread is. No frame is touched: one that is held here would keep its painter from ending.

        Through a pipe, for the disk may be full.
        """
        reading, writing = os.pipe()
        os.set_blocking(writing, False)
        faulthandler.dump_traceback(writing)
        os.close(writing)
        with open(reading, encoding="utf-8", errors="replace") as told:
            return told.read()

    def percentile(self, share: float) -> Turn:
        """The turn than which that share of them was quicker, clock by clock."""
        return Turn(*np.percentile(np.array(self.turns), 100.0 * share, axis=0)) if self.turns else Turn(0.0, 0.0, 0.0)


class Size(NamedTuple):
    """How much there is: resident megabytes (nan where it cannot be told), objects of the window, windows, threads."""

    megabytes: float
    objects: int
    windows: int
    threads: int

    def __str__(self) -> str:
        words = f"{self.objects} objects, {self.windows} top-level widgets, {self.threads} threads"
        return f"{self.megabytes:.0f} MB, {words}"


def size_of(window: QWidget) -> Size:
    """After a tidying, so that what is merely not collected yet does not count."""
    for _ in range(3):
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
        gc.collect()
    if sys.platform == "linux":
        ctypes.CDLL("libc.so.6").malloc_trim(0)
    return Size(
        _megabytes(), len(window.findChildren(QObject)), len(QApplication.topLevelWidgets()), threading.active_count()
    )


def _megabytes() -> float:
    if sys.platform != "linux":
        return float("nan")
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * 4096 / 1e6
