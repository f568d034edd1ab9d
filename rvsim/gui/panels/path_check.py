"""The Check page: what the tracked path would ask of the arm, what would help, and the best way to a pose."""

from __future__ import annotations

from functools import partial
from typing import NamedTuple

import numpy as np
from PySide6.QtWidgets import QGroupBox, QHBoxLayout, QProgressBar, QVBoxLayout, QWidget

from rvsim.experiment import Experiment
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.path_best_way import BestWaySection
from rvsim.gui.panels.path_check_rows import FindingList
from rvsim.gui.panels.path_page import PathPage
from rvsim.gui.parts_worker import PartsWorker
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import shown_units
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.gui.theme import THEMES, set_role
from rvsim.gui.tracker import PathTracker, Repair
from rvsim.gui.widgets import button, column_of, scrolled
from rvsim.lab.findings import SYMBOLS, summary_sentence
from rvsim.lab.repairs import Offer, repairs
from rvsim.motion import Tracking, Trajectory, trajectory_of
from rvsim.motion.honesty import Report, check

_EMPTY = "Track a line or a trajectory on the Path page: here is told what it asks of the arm before it moves."
_HOW_SLOW = (
    "The motion is as slow as the joints need: a wish for less time than their limits allow is lengthened, so there "
    "is nothing to slow down."
)


class _Checked(NamedTuple):
    tracking: Tracking
    trajectory: Trajectory | None
    report: Report


class CheckPage(PathPage):
    """Checks the tracking when it is another one; looks for repairs beside the window."""

    title = "Check"
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
        self._checked: _Checked | None = None
        self.offers: list[Offer] = []
        self.worker = PartsWorker(self)
        self.worker.part.connect(self._on_offer)
        self.worker.done.connect(self._on_searched)
        self._make_widgets()
        self._lay_out()
        session.tracking_changed.connect(lambda _: self._refresh_if_seen())
        motion.loaded.connect(self._refresh_if_seen)

    def close_worker(self) -> None:
        """End the thread, for the window closes."""
        self.worker.close()

    @property
    def report(self) -> Report | None:
        """What is shown."""
        return self._checked.report if self._checked else None

    def _make_widgets(self) -> None:
        self.summary = wrapped_label()
        self.summary.setObjectName("check_summary")
        set_role(self.summary, role="title")
        self.findings = FindingList()
        self.findings.chosen.connect(self._go_to)
        self.slow = wrapped_label("muted")
        self.slow.setText(_HOW_SLOW)
        self.searching = QProgressBar()
        self.searching.setObjectName("repairs_progress")
        self.searching.setRange(0, 0)
        self.searching.setTextVisible(False)
        self.searching.setFixedHeight(8)
        self.cancel_button = button("repairs_cancel", "Cancel", "Give up the search for repairs", self.cancel)
        self.none = wrapped_label("muted")
        self.best_way = BestWaySection(self._session, self._preferences, self._motion)

    def _lay_out(self) -> None:
        self.repair_box = QGroupBox("Repairs that were tried")
        self.repair_box.hide()
        self._repair_column = QVBoxLayout(self.repair_box)
        self._offered = QVBoxLayout()
        self._offered.setSpacing(6)
        waiting = QHBoxLayout()
        waiting.addWidget(self.searching, 1)
        waiting.addWidget(self.cancel_button)
        self._repair_column.addLayout(self._offered)
        self._repair_column.addLayout(waiting)
        self._repair_column.addWidget(self.none)
        inside = QWidget()
        column = QVBoxLayout(inside)
        column.setContentsMargins(10, 8, 10, 8)
        column.setSpacing(8)
        for widget in (self.summary, self.findings, self.slow, self.repair_box, self.best_way):
            column.addWidget(widget)
        column.addStretch(1)
        column_of(self, scrolled(inside))

    # --- checking ----------------------------------------------------------------------------------------------------

    def concerns(self, before: Experiment, after: Experiment) -> bool:
        """The list of poses too."""
        return super().concerns(before, after) or after.poses is not before.poses

    def refresh(self) -> None:
        """Check again if another path has been tracked, or it is travelled another way."""
        tracking = self._session.tracking
        trajectory = None if tracking is None else self._trajectory_of(tracking)
        checked = self._checked
        if tracking is None:
            self._checked = None
        elif checked is None or checked.tracking is not tracking or self._is_other(checked, trajectory):
            self._checked = _Checked(tracking, trajectory, check(tracking, trajectory))
        if self._checked is not checked:
            self._search()
        self._show()
        self.best_way.refresh()

    @staticmethod
    def _is_other(checked: _Checked, trajectory: Trajectory | None) -> bool:
        """Another motion along the same path; while something else is played the old one still counts."""
        return trajectory is not None and checked.trajectory is not trajectory

    def _trajectory_of(self, tracking: Tracking) -> Trajectory | None:
        """The motion in the player, if it is one along this path."""
        loaded = self._motion.player.trajectory
        if not isinstance(loaded, Trajectory) or not tracking.reached_count:
            return None
        first = tracking.q[tracking.reached][0]
        along = np.array_equal(loaded.q(loaded.path_start), first) and loaded.path_start < loaded.duration
        return loaded if along else None

    def _show(self) -> None:
        report = self.report
        theme, units = THEMES[self._preferences["theme"]], shown_units(self._preferences)
        told = "" if report is None else f"{SYMBOLS[report.severity]} {summary_sentence(report)}"
        self.summary.setText(told or _EMPTY)
        set_role(self.summary, role="title" if told else "muted")
        self.findings.show_report(report, units, theme)
        self.slow.setVisible(bool(report and report.speeds and report.severity != "bad"))

    def _go_to(self, number: int) -> None:
        report = self.report
        time = report.findings[number].time if report else None
        if self._checked is None or time is None:
            return
        if self._motion.player.trajectory is not self._checked.trajectory:
            self._motion.load(self._checked.trajectory, "Show a finding")
        self._motion.pause()
        self._motion.seek(time)

    # --- repairs -----------------------------------------------------------------------------------------------------

    def _search(self) -> None:
        self.cancel()
        self.offers = []
        self._show_offers()
        report = self.report
        needed = report is not None and report.severity != "good"
        self.repair_box.setVisible(needed)
        if report is not None and needed:
            units = shown_units(self._preferences)
            self.worker.start(partial(repairs, self._tracker.kind, self._session.experiment, report, units))
            self._show_searching(True)

    def cancel(self) -> None:
        """Give up the search; what was found stays."""
        self.worker.cancel()
        self._show_searching(False)

    def _on_offer(self, offer: Offer) -> None:
        self.offers.append(offer)
        self._show_offers()

    def _on_searched(self) -> None:
        self._show_searching(False)

    def _show_searching(self, on: bool) -> None:
        self.searching.setVisible(on)
        self.cancel_button.setVisible(on)
        self.none.setText("" if on or self.offers else "None of those that were tried helps.")
        self.none.setVisible(not on and not self.offers)

    def _show_offers(self) -> None:
        while (item := self._offered.takeAt(0)) is not None:
            if (widget := item.widget()) is not None:
                widget.hide()
                widget.deleteLater()
        for offer in self.offers:
            made = button(
                f"check_repair_{offer.name.replace(' ', '_')}", offer.title, offer.tip, partial(self._apply, offer)
            )
            text = wrapped_label("muted")
            text.setText(offer.tip)
            self._offered.addWidget(made)
            self._offered.addWidget(text)

    def _apply(self, offer: Offer) -> None:
        """Do what the button says: in the experiment where it stands there, else with the path alone."""
        if offer.experiment is not None:
            now = self._session.experiment
            wanted = offer.experiment if offer.name == "branch" else offer.experiment.at(now.q)
            self._tracker.apply(Repair(offer.title, offer.tip, wanted))
            return
        self._motion.load(trajectory_of(offer.tracking, self._session.q), offer.title)
        self._session.set_tracking(offer.tracking)
        self._motion.play()
