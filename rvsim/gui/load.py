"""What hangs at the tool: one payload for every page that asks for it."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal


class Load(QObject):
    """The payload at the tool's origin.

    Signals:
        changed(): there is another payload.
    """

    changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._payload = 0.0

    @property
    def payload(self) -> float:
        """Its mass [kg], 0 or more."""
        return self._payload

    def set_payload(self, mass: float) -> None:
        """Hang this mass [kg] at the tool."""
        if mass != self._payload:
            self._payload = mass
            self.changed.emit()
