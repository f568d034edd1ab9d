"""The numbers of the sources worked out beside the window: it tells how far it is, and can be given up."""

from __future__ import annotations

import threading
from functools import partial

from PySide6.QtCore import QObject, Qt, Signal

from rvsim.gui.workers import LatestWorker
from rvsim.lab.sources.reproduce import KeyedReproduction, reproduce_by_key


class SourcesWorker(QObject):
    """Works all rows out once.

    Signals:
        progressed(share): 0…1 of it is done.
        done(rows): a tuple of `KeyedReproduction`; not after `cancel`.
    """

    progressed = Signal(float)
    done = Signal(object)
    _told = Signal(float)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._stop = threading.Event()
        self._worker = LatestWorker(self)
        self._worker.done.connect(self.done)
        self._told.connect(self._on_told, Qt.ConnectionType.QueuedConnection)

    @property
    def busy(self) -> bool:
        """Whether the rows are being worked out."""
        return self._worker.busy

    def start(self) -> None:
        """Begin, unless it has begun."""
        if not self.busy:
            self._stop = threading.Event()
            self._worker.ask(partial(self._rows, self._stop))

    def cancel(self) -> None:
        """Give up."""
        self._stop.set()
        self._worker.cancel()

    def close(self) -> None:
        """Give up, and wait for the thread to end."""
        self._stop.set()
        self._worker.close()

    def _rows(self, stop: threading.Event) -> tuple[KeyedReproduction, ...]:
        """In the worker's thread."""

        def tell(share: float) -> bool:
            if not stop.is_set():
                self._told.emit(share)
            return not stop.is_set()

        return reproduce_by_key(tell)

    def _on_told(self, share: float) -> None:
        if not self._stop.is_set():
            self.progressed.emit(share)
