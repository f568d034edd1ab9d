"""The Path panel: the line between two points, the trajectories, how fast they go, and what came of tracking them."""

from __future__ import annotations

from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QVBoxLayout, QWidget

from rvsim.experiment import Experiment
from rvsim.gui.panels.path_line import LineSection
from rvsim.gui.panels.path_pace import PaceSection
from rvsim.gui.panels.path_result import ResultSection
from rvsim.gui.panels.path_trajectory import TrajectorySection
from rvsim.gui.path_drag import PathDrag
from rvsim.gui.path_preview import PathPreview
from rvsim.gui.point_clicks import PointClicks
from rvsim.gui.preferences import Preferences
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.gui.tracker import PathTracker
from rvsim.gui.widgets import column_of, scrolled
from rvsim.motion import Tracking


class PathPanel(QWidget):
    """Line, trajectory, pace and result, one below the other.

    Args:
        stage: where paths are shown before they are tracked, and can be dragged; None for a panel without a scene.
    """

    def __init__(
        self,
        session: Session,
        preferences: Preferences,
        tracker: PathTracker,
        stage: Stage | None = None,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self._session = session
        self.preview = PathPreview(session, preferences, stage, self)
        tracker.closed.connect(self.preview.close_worker)
        self.path_drag = None if stage is None else PathDrag(session, preferences, stage, self)
        self.point_clicks = None if stage is None else PointClicks(session, preferences, stage, self)
        if self.path_drag is not None and self.point_clicks is not None:  # one at a time
            self.path_drag.switched.connect(lambda on: self._end_other(on, self.point_clicks))
            self.point_clicks.switched.connect(lambda on: self._end_other(on, self.path_drag))
        self.line = LineSection(session, preferences, tracker)
        self.trajectory = TrajectorySection(
            session, preferences, tracker, self.preview, self.path_drag, self.point_clicks
        )
        self.pace = PaceSection(session, preferences)
        self.result = ResultSection(session, preferences, tracker)
        inside = QWidget()
        inside.setMinimumWidth(0)
        column = QVBoxLayout(inside)
        column.setContentsMargins(12, 6, 12, 8)
        column.setSpacing(4)
        for section in (self.line, self.trajectory, self.pace, self.result):
            column.addWidget(section)
        column.addStretch(1)
        self._scroll = scrolled(inside)
        self._scrolled_to = -1  # to show what came of tracking
        column_of(self, self._scroll)
        session.changed.connect(self._on_changed)
        session.tracking_changed.connect(self._on_tracking)
        self._search = tracker.search
        self._scroll.verticalScrollBar().rangeChanged.connect(self._on_longer)
        self._show(session.experiment)

    def set_seen(self, seen: bool) -> None:
        """Whoever looks at another panel neither drags the path nor puts points."""
        for hand in (self.path_drag, self.point_clicks):
            if not seen and hand is not None:
                hand.switch(False)

    def _end_other(self, on: bool, other: PathDrag | PointClicks | None) -> None:
        """The path is dragged, or points are put: not both."""
        if on and other is not None:
            other.switch(False)

    def _on_changed(self, before: Experiment, after: Experiment) -> None:
        if (
            after.robot is not before.robot
            or after.line is not before.line
            or after.trajectory is not before.trajectory
        ):
            self._show(after)
        self.pace.show_task(after)

    def _on_tracking(self, tracking: Tracking | None) -> None:
        self.result.show_tracking(tracking)
        if tracking is not None:
            # When the layout has made room for the sentence and the buttons, on a low screen too.
            QTimer.singleShot(0, self, self._show_result)

    def _on_longer(self) -> None:
        """Repairs that are offered later come into sight too, unless somebody has scrolled meanwhile."""
        if self._search.needed and self._scroll.verticalScrollBar().value() == self._scrolled_to:
            QTimer.singleShot(0, self, self._show_result)

    def _show_result(self) -> None:
        self._scroll.ensureWidgetVisible(self.result, 0, 0)
        self._scroll.horizontalScrollBar().setValue(0)
        self._scrolled_to = self._scroll.verticalScrollBar().value()

    def _show(self, experiment: Experiment) -> None:
        self.line.show_task(experiment)
        self.trajectory.show_task(experiment)
