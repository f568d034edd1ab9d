"""A page of the laboratory: it works only while the eye can see it."""

from __future__ import annotations

from PySide6.QtGui import QHideEvent, QShowEvent
from PySide6.QtWidgets import QWidget


class Page(QWidget):
    """Knows whether it is `seen`: shown, and in a dock that is in front (one behind another counts as shown for Qt)."""

    def __init__(self) -> None:
        super().__init__()
        self.seen = False
        self._in_front = True

    def on_seen(self, seen: bool) -> None:
        """The page has come into sight or gone. For the page to fill in."""

    def set_in_front(self, in_front: bool) -> None:
        """The dock around has come to the front, or gone behind another."""
        self._in_front = in_front
        self._judge()

    def _judge(self) -> None:
        seen = self._in_front and self.isVisible()
        if seen != self.seen:
            self.seen = seen
            self.on_seen(seen)

    def showEvent(self, event: QShowEvent) -> None:
        """Shown."""
        super().showEvent(event)
        self._judge()

    def hideEvent(self, event: QHideEvent) -> None:
        """Hidden."""
        super().hideEvent(event)
        self._judge()
