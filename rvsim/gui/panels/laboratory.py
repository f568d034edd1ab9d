"""The IK laboratory: the numeric solvers side by side, and what the misprints of source 002 cost."""

from __future__ import annotations

from PySide6.QtGui import QCloseEvent
from PySide6.QtWidgets import QTabWidget, QWidget

from rvsim.gui.panels.laboratory_contest import ContestPage
from rvsim.gui.panels.laboratory_source_002 import Source002Page
from rvsim.gui.preferences import Preferences
from rvsim.gui.session import Session
from rvsim.gui.widgets import column_of
from rvsim.language import tr


class LaboratoryPanel(QWidget):
    """Two pages; `contest.iterates_changed` and `source_002.comparison_changed` tell what the scene is to show."""

    def __init__(self, session: Session, preferences: Preferences, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("laboratory_panel")
        self.contest = ContestPage(session, preferences)
        self.source_002 = Source002Page(preferences)
        self.pages = QTabWidget()
        self.pages.setObjectName("lab_pages")
        self.pages.setDocumentMode(True)
        self.pages.addTab(self.contest, tr("Four solvers"))
        self.pages.addTab(self.source_002, tr("Source 002 as printed"))
        column_of(self, self.pages)

    def set_seen(self, seen: bool) -> None:
        """Whether the dock around is in front: behind another one nothing is worked out."""
        self.contest.set_in_front(seen)
        self.source_002.set_in_front(seen)

    def stop(self) -> None:
        """End the threads."""
        self.contest.close_worker()
        self.source_002.close_worker()

    def closeEvent(self, event: QCloseEvent) -> None:
        """End the threads with the panel."""
        self.stop()
        super().closeEvent(event)
