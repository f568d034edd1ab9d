"""The workspace worked out beside the window: it tells how far it is, and can be given up."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

from PySide6.QtCore import QObject, Qt, Signal

from rvsim.gui.workers import LatestWorker
from rvsim.kinematics.workspace import Workspace, WorkspaceTask, workspace_parts

_TELL_EVERY = 0.03  # [s]


class Survey(NamedTuple):
    """A workspace, and how long it took [s]."""

    workspace: Workspace
    seconds: float


class Surveyor(QObject):
    """Works out one workspace at a time.

    Signals:
        progressed(share): 0…1 of it is done.
        done(survey): a `Survey`; not after `cancel`.
    """

    progressed = Signal(float)
    done = Signal(object)
    _told = Signal(object, float)

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._stop = threading.Event()
        self._worker = LatestWorker(self)
        self._worker.done.connect(self._on_done)
        self._told.connect(self._on_told, Qt.ConnectionType.QueuedConnection)

    @property
    def busy(self) -> bool:
        """Whether a workspace is being worked out."""
        return self._worker.busy

    def start(self, task: WorkspaceTask) -> None:
        """Work out this one; one that was begun is given up."""
        self._stop.set()
        self._stop = threading.Event()
        self._worker.ask(partial(_surveyed, task, self._stop, partial(self._told.emit, self._stop)))

    def cancel(self) -> None:
        """Give up."""
        self._stop.set()
        self._worker.cancel()

    def close(self) -> None:
        """Give up, and wait for the thread to end."""
        self._stop.set()
        self._worker.close()

    def _on_told(self, stop: threading.Event, share: float) -> None:
        if stop is self._stop and not stop.is_set():
            self.progressed.emit(share)

    def _on_done(self, survey: Survey | None) -> None:
        if survey is not None:
            self.done.emit(survey)


def _surveyed(task: WorkspaceTask, stop: threading.Event, tell: Callable[[float], object]) -> Survey | None:
    """In the worker's thread."""
    begun = told = time.monotonic()
    for part in workspace_parts(task):
        if stop.is_set():
            return None
        if isinstance(part, Workspace):
            return Survey(part, time.monotonic() - begun)
        if time.monotonic() - told >= _TELL_EVERY:
            told = time.monotonic()
            tell(part)
    return None
