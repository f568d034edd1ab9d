"""What every read-out panel does: show the present experiment only while it can be seen, and only when it changed."""

from __future__ import annotations

from PySide6.QtCore import QEvent
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QWidget

from rvsim.experiment import Experiment
from rvsim.gui.preferences import Preferences
from rvsim.gui.session import Session

NUMBER_SETTINGS = frozenset({"angle_unit", "length_unit", "extra_decimals"})


class ReadOutPanel(QWidget):
    """Calls `refresh()` when pose, arm or number format is another one; a hidden panel waits until it is shown."""

    settings: frozenset[str] = NUMBER_SETTINGS
    always = False  # whether its numbers are kept true while nobody sees them, for those who read them by name
    costly = False  # then it waits behind another dock too, which Qt calls visible, though it lies outside the window

    def __init__(self, session: Session, preferences: Preferences, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session, self._preferences = session, preferences
        self._stale = True
        session.changed.connect(self._on_changed)
        preferences.changed.connect(self._on_preference)

    def refresh(self) -> None:
        """Show what is now. For the panel to fill in."""

    def concerns(self, before: Experiment, after: Experiment) -> bool:
        """Whether a change of the experiment is to be seen in this panel."""
        return after.q is not before.q or after.robot is not before.robot

    def _on_changed(self, before: Experiment, after: Experiment) -> None:
        if self.concerns(before, after):
            self._refresh_if_seen()

    def _on_preference(self, name: str) -> None:
        if name in self.settings:
            self._refresh_if_seen()

    def _refresh_if_seen(self) -> None:
        hidden = not (self.isVisible() or self.always)
        self._stale = hidden or (self.costly and self.visibleRegion().isEmpty())
        if not self._stale:
            self.refresh()

    def catch_up(self) -> None:
        """Work out what has been put off, for somebody asks for it though it cannot be seen."""
        if self._stale:
            self._stale = False
            self.refresh()

    def event(self, event: QEvent) -> bool:
        """Catch up when the dock comes to the front: Qt tells of it by a paint alone."""
        if event.type() == QEvent.Type.Paint:
            self.catch_up()
        return super().event(event)

    def showEvent(self, event: QShowEvent) -> None:
        """Catch up with what happened while hidden."""
        super().showEvent(event)
        self.catch_up()

    def changeEvent(self, event: QEvent) -> None:
        """Another font: other widths and heights."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._refresh_if_seen()
