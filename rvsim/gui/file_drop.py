"""Files that are dropped onto the window: sessions, robot files, programs."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

from PySide6.QtCore import QEvent, QObject
from PySide6.QtGui import QDragEnterEvent, QDropEvent
from PySide6.QtWidgets import QWidget


class FileDrop(QObject):
    """Takes one file at a time, of the endings that somebody opens."""

    def __init__(self, window: QWidget, openers: Mapping[str, Callable[[Path], object]]) -> None:
        super().__init__(window)
        self._openers = dict(openers)
        window.setAcceptDrops(True)
        window.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Take what can be opened; leave the rest to the window."""
        if isinstance(event, QDragEnterEvent | QDropEvent):
            file = self._file(event)
            if file is not None:
                event.acceptProposedAction()
                if event.type() == QEvent.Type.Drop:
                    self._openers[file.suffix.lower()](file)
                return True
        return super().eventFilter(watched, event)

    def _file(self, event: QDropEvent) -> Path | None:
        urls = event.mimeData().urls()
        if len(urls) != 1 or not urls[0].isLocalFile():
            return None
        file = Path(urls[0].toLocalFile())
        return file if file.suffix.lower() in self._openers else None
