"""Work that must not hold up the window: one thread, one job at a time, and only the latest request counts."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from queue import SimpleQueue
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal

Job = Callable[[], Any]


class LatestWorker(QObject):
    """Does the latest job it was asked for; a job that was superseded or cancelled reports nothing.

    The thread begins with the first job and ends with `close`, or when this object goes.

    Signals:
        done(result): in the thread of this object.
    """

    done = Signal(object)
    _finished = Signal(int, object)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._queue: SimpleQueue[tuple[int, Job] | None] = SimpleQueue()
        self.destroyed.connect(partial(self._queue.put, None))
        self._thread: threading.Thread | None = None
        self._asked = 0
        self._wanted = 0  # the number of the job whose result counts, 0 for none
        self._running = False
        self._next: Job | None = None
        self._finished.connect(self._on_finished, Qt.ConnectionType.QueuedConnection)

    @property
    def busy(self) -> bool:
        """Whether a job that still counts is waiting or being done."""
        return self._next is not None or self._wanted > 0

    def ask(self, job: Job) -> None:
        """Do this as soon as the thread is free; what was asked for before counts no more."""
        self._wanted, self._next = 0, job
        if not self._running:
            self._start_next()

    def cancel(self) -> None:
        """Nothing that was asked for counts any more."""
        self._wanted, self._next = 0, None

    def close(self) -> None:
        """Cancel, and wait for the thread to end."""
        self.cancel()
        if self._thread is not None:
            self._queue.put(None)
            self._thread.join()
            self._thread = None

    def _start_next(self) -> None:
        job, self._next = self._next, None
        if job is None:
            return
        if self._thread is None:
            self._thread = threading.Thread(target=self._work, name="rvsim-worker", daemon=True)
            self._thread.start()
        self._asked += 1
        self._running, self._wanted = True, self._asked
        self._queue.put((self._asked, job))

    def _work(self) -> None:
        """The thread's loop; a job that fails is reported like any other error of a thread."""
        while (entry := self._queue.get()) is not None:
            number, job = entry
            result = None
            try:
                result = job()
            except Exception:
                number = 0
                threading.excepthook(threading.ExceptHookArgs((*sys.exc_info(), threading.current_thread())))
            with suppress(RuntimeError):  # this object has gone meanwhile
                self._finished.emit(number, result)

    def _on_finished(self, number: int, result: Any) -> None:
        self._running = False
        counts = 0 < number == self._wanted
        self._wanted = 0
        if self._next is not None:
            self._start_next()
        elif counts:
            self.done.emit(result)
