"""The Check page: what the tracked path would ask of the arm, what would help, and the best way to a pose."""

from __future__ import annotations

from PySide6.QtWidgets import QGroupBox, QVBoxLayout, QWidget

from rvsim.experiment import Experiment
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.path_best_way import BestWaySection
from rvsim.gui.panels.path_check_rows import FindingList
from rvsim.gui.panels.path_page import PathPage
from rvsim.gui.panels.path_repairs import RepairList
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import shown_units
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.gui.theme import THEMES, set_role
from rvsim.gui.tracker import PathTracker
from rvsim.gui.widgets import column_of, scrolled
from rvsim.lab.findings import SYMBOLS, summary_sentence
from rvsim.language import tr, tr_later
from rvsim.motion.honesty import Report

_EMPTY = tr_later(
    "Track a line or a trajectory on the Path page: here is told what it asks of the arm before it moves."
)


class CheckPage(PathPage):
    """Checks the tracking when it is another one; looks for repairs beside the window."""

    title = tr_later("Check")
    name = "path_check"

    def __init__(
        self,
        session: Session,
        preferences: Preferences,
        stage: Stage,
        tracker: PathTracker,
        motion: MotionControl,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(session, preferences, stage, tracker, motion, parent)
        self._search = tracker.search
        self._make_widgets()
        self._lay_out()
        session.tracking_changed.connect(lambda _: self._refresh_if_seen())
        motion.loaded.connect(self._refresh_if_seen)
        self._search.changed.connect(self._show_if_seen)

    @property
    def report(self) -> Report | None:
        """What is shown."""
        return self._search.report

    def _make_widgets(self) -> None:
        self.summary = wrapped_label()
        self.summary.setObjectName("check_summary")
        set_role(self.summary, role="title")
        self.findings = FindingList()
        self.findings.chosen.connect(self._go_to)
        self.repairs = RepairList(self._tracker, "check_", told=True)
        self.best_way = BestWaySection(self._session, self._preferences, self._motion)

    def _lay_out(self) -> None:
        self.repair_box = QGroupBox(tr("Repairs that were tried"))
        self.repair_box.hide()
        column_of(self.repair_box, self.repairs)
        inside = QWidget()
        column = QVBoxLayout(inside)
        column.setContentsMargins(10, 8, 10, 8)
        column.setSpacing(8)
        for widget in (self.summary, self.findings, self.repair_box, self.best_way):
            column.addWidget(widget)
        column.addStretch(1)
        column_of(self, scrolled(inside))

    # --- checking ----------------------------------------------------------------------------------------------------

    def concerns(self, before: Experiment, after: Experiment) -> bool:
        """The list of poses too."""
        return super().concerns(before, after) or after.poses is not before.poses

    def refresh(self) -> None:
        """Check again if another path has been tracked, or it is travelled another way."""
        self._search.look()
        self._show()
        self.best_way.refresh()

    def _show_if_seen(self) -> None:
        if self.seen:
            self._show()

    def _show(self) -> None:
        report = self.report
        theme, units = THEMES[self._preferences["theme"]], shown_units(self._preferences)
        told = "" if report is None else f"{SYMBOLS[report.severity]} {summary_sentence(report)}"
        self.summary.setText(told or tr(_EMPTY))
        set_role(self.summary, role="title" if told else "muted")
        self.findings.show_report(report, units, theme)
        self.repair_box.setVisible(self._search.needed)

    def _go_to(self, number: int) -> None:
        report = self.report
        time = report.findings[number].time if report else None
        if time is None:
            return
        if self._motion.player.trajectory is not self._search.trajectory:
            self._motion.load(self._search.trajectory, tr("Show a finding"))
        self._motion.pause()
        self._motion.seek(time)
