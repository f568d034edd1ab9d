"""What came of tracking a path: how many points, how exact, how fast, and what could be done about missed ones."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import Qt, QTimer
from PySide6.QtWidgets import QGroupBox, QHBoxLayout, QLabel, QProgressBar, QSizePolicy

from rvsim.gui.panels.path_points import PathPointsDialog
from rvsim.gui.panels.path_repairs import RepairList
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import shown_units
from rvsim.gui.session import Session
from rvsim.gui.theme import set_role
from rvsim.gui.tracker import PathTracker
from rvsim.gui.widgets import ElidedLabel, button, form
from rvsim.lab.sentences import length_error, tracking_sentence
from rvsim.language import tr, trn
from rvsim.motion import Tracking
from rvsim.motion.between import way_deviation


class ResultSection(QGroupBox):
    """What came of it: how many points, how exact, how fast; and what could be done about missed ones."""

    def __init__(self, session: Session, preferences: Preferences, tracker: PathTracker) -> None:
        super().__init__(tr("Result"))
        self._session, self._preferences, self._tracker = session, preferences, tracker
        self._table: PathPointsDialog | None = None
        self._make_labels()
        self._make_buttons()
        self._lay_out()
        tracker.search.changed.connect(lambda: QTimer.singleShot(0, self, self._settle))
        self.show_tracking(None)
        self.show_busy(False)
        tracker.busy_changed.connect(self.show_busy)
        self._wear_units("angle_unit")
        preferences.changed.connect(self._wear_units)

    def _make_labels(self) -> None:
        self.reached, self.between = QLabel(), QLabel()
        self.rms, self.largest, self.time = ElidedLabel(), ElidedLabel(), ElidedLabel()
        for label in (self.rms, self.largest, self.time):  # a form gives one whose size is ignored no room
            label.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        self.between.setObjectName("between_label")
        self.between.setToolTip(
            tr(
                "How far the tool leaves the straight way between neighbouring points: the joints pass the points "
                "exactly and follow a spline between them. More points make it less"
            )
        )
        self.rms.setObjectName("rms_label")
        self.reached.setObjectName("reached_label")
        self.sentence = QLabel(wordWrap=True)
        self.sentence.setObjectName("tracking_sentence")
        self.sentence.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)

    def _make_buttons(self) -> None:
        self.busy = QProgressBar()
        self.busy.setObjectName("tracking_progress")
        self.busy.setRange(0, 0)
        self.busy.setTextVisible(False)
        self.busy.setFixedHeight(8)
        tip = tr("Give up working this path out")
        self.cancel = button("cancel_tracking_button", tr("Cancel"), tip, self._tracker.cancel)
        tip = tr("Every point of the path with what came of it; a click moves the arm there")
        self.points = button("path_points_button", tr("Points…"), tip, self._show_points)
        self.repairs = RepairList(self._tracker, "", told=False)

    def _lay_out(self) -> None:
        rows = form()
        reached = QHBoxLayout()
        reached.addWidget(self.reached, 1)
        reached.addWidget(self.points)
        rows.addRow(tr("Reached"), reached)
        rows.addRow("RMS", self.rms)
        rows.addRow(tr("Largest"), self.largest)
        rows.addRow(tr("Between"), self.between)
        rows.addRow(tr("Solved in"), self.time)
        waiting = QHBoxLayout()
        waiting.addWidget(self.busy, 1)
        waiting.addWidget(self.cancel)
        rows.addRow(waiting)
        rows.addRow(self.sentence)
        rows.addRow(self.repairs)
        self.setLayout(rows)

    def _settle(self) -> None:
        """A form keeps the heights that its rows had before they changed and were dressed, until it is told."""
        self.repairs.updateGeometry()
        layout = self.layout()
        assert layout is not None
        layout.invalidate()
        self.updateGeometry()

    def _wear_units(self, name: str) -> None:
        """Say the result in the preferred units, now and when the next path is tracked."""
        if name in ("angle_unit", "length_unit"):
            self._tracker.units = shown_units(self._preferences)
            if self._tracker.search.report is not None:
                self._tracker.search.look()
            self.show_tracking(self._session.tracking)

    def _show_points(self) -> None:
        """Open the table of points; it stays true while it is open."""
        if self._table is None:
            self._table = PathPointsDialog(self._session, self._preferences, self)
        self._table.show()
        self._table.activateWindow()

    def show_busy(self, busy: bool) -> None:
        """Show that a long path is being worked out; the old result stays in sight."""
        self.busy.setVisible(busy)
        self.cancel.setVisible(busy)

    def show_tracking(self, tracking: Tracking | None) -> None:
        """Show the result, or what to do to get one."""
        if tracking is None:
            for label in (self.reached, self.rms, self.largest, self.between, self.time):
                label.setText("\u2013")
            for label in (self.rms, self.largest):
                label.setToolTip("")
            self.points.setEnabled(False)
            self.sentence.setText(tr("Nothing tracked yet. Track line moves the tool from start to end."))
            set_role(self.sentence, level="")
            return
        self._show_numbers(tracking)
        self.points.setEnabled(True)
        self.sentence.setText(tracking_sentence(tracking, self._tracker.units))
        set_role(self.sentence, level="good" if tracking.complete else "warning")
        QTimer.singleShot(0, self, self._settle)

    def _deviation(self, value: float | None, tracking: Tracking) -> str:
        return "\u2013" if value is None else length_error(tracking.robot, value, self._tracker.units)

    def _at_points(self, value: float | None, tracking: Tracking) -> str:
        """A deviation, and of which points it is."""
        text = self._deviation(value, tracking)
        if not tracking.reached_count:
            return text
        if tracking.complete:
            return tr("{deviation} (at the points)", deviation=text)
        return tr("{deviation} (reached points)", deviation=text)

    def _show_numbers(self, tracking: Tracking) -> None:
        self.reached.setText(
            trn("{reached} of {n} point", "{reached} of {n} points", tracking.samples, reached=tracking.reached_count)
        )
        self.rms.setText(self._at_points(tracking.rms, tracking))
        self.largest.setText(self._at_points(tracking.max_deviation, tracking))
        trajectory = self._tracker.trajectory
        between = None if trajectory is None else way_deviation(trajectory, tracking)
        self.between.setText(self._deviation(between, tracking))
        for label in (self.rms, self.largest):
            label.setToolTip(self._each_axis(tracking))
        milliseconds = tracking.solve_seconds * 1e3
        self.time.setText(
            tr(
                "{total:.2f} ms ({each:.0f} µs a point)",
                total=milliseconds,
                each=tracking.seconds_per_point * 1e6,
            )
        )

    def _each_axis(self, tracking: Tracking) -> str:
        """RMS, mean and largest deviation along each axis, as a table for a tooltip."""
        offsets = tracking.offsets
        if not len(offsets):
            return ""
        rows: list[tuple[str, ...]] = [("", "RMS", tr("mean"), tr("largest"))]
        for name, values in (*zip("xyz", offsets.T, strict=True), (tr("all"), tracking.deviation[tracking.reached])):
            numbers = (np.sqrt(np.mean(values**2)), np.mean(values), np.max(np.abs(values)))
            rows.append((name, *(self._deviation(float(number), tracking) for number in numbers)))
        cells = ("".join(f"<td align='right'>&nbsp;{cell}</td>" for cell in row) for row in rows)
        title = tr("Where the tool is less where it should be, at the reached points")
        return f"{title}<table><tr>{'</tr><tr>'.join(cells)}</tr></table>"
