"""Long work that comes in parts, done beside the window: each part is shown when it is there."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from functools import partial
from typing import Any

from PySide6.QtCore import QObject, Qt, Signal

from rvsim.gui.workers import LatestWorker


class PartsWorker(QObject):
    """Works through one iterable at a time.

    Signals:
        part(value): the next part; not after `cancel`, and none of what was begun before.
        done(): all of it; not after `cancel`.
    """

    part = Signal(object)
    done = Signal()
    _told = Signal(object, object)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._stop = threading.Event()
        self._worker = LatestWorker(self)
        self._worker.done.connect(self._on_done)
        self._told.connect(self._on_told, Qt.ConnectionType.QueuedConnection)

    @property
    def busy(self) -> bool:
        """Whether something is being worked out."""
        return self._worker.busy

    def start(self, make: Callable[[], Iterable[Any]]) -> None:
        """Work through what `make()` gives; what was begun is given up. A part that is None is not told."""
        self._stop.set()
        self._stop = threading.Event()
        self._worker.ask(partial(_worked, make, self._stop, partial(self._told.emit, self._stop)))

    def cancel(self) -> None:
        """Give up."""
        self._stop.set()
        self._worker.cancel()

    def close(self) -> None:
        """Give up, and wait for the thread to end."""
        self._stop.set()
        self._worker.close()

    def _on_told(self, stop: threading.Event, value: object) -> None:
        if stop is self._stop and not stop.is_set():
            self.part.emit(value)

    def _on_done(self, stop: threading.Event) -> None:
        if stop is self._stop and not stop.is_set():
            self.done.emit()


def _worked(make: Callable[[], Iterable[Any]], stop: threading.Event, tell: Callable[[Any], object]) -> threading.Event:
    """In the worker's thread."""
    for value in make():
        if stop.is_set():
            break
        if value is not None:
            tell(value)
    return stop
