"""The Path panel: the line between two points, the named trajectories, and what came of tracking them."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from PySide6.QtCore import QSignalBlocker, Qt, QTimer
from PySide6.QtWidgets import (
    QGridLayout,
    QGroupBox,
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QPushButton,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from rvsim.experiment import Experiment, LineTask, PathOrientation, TrajectoryTask
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import length_kind, shown_units
from rvsim.gui.quantity_box import QuantityBox
from rvsim.gui.session import Session
from rvsim.gui.theme import set_role
from rvsim.gui.tracker import PathTracker, Repair
from rvsim.gui.widgets import button, column_of, combo, form, scrolled, select
from rvsim.lab.lines import LinePreset, line_presets
from rvsim.lab.named_paths import path_entry, path_names
from rvsim.lab.sentences import length_error, tracking_sentence
from rvsim.motion import Tracking
from rvsim.robot import Robot
from rvsim.robot.edits import original_name

_LINE_ORIENTATIONS = {
    "down": "Tool straight down",
    "free": "Free pitch: it tilts as it likes",
    "keep": "Tool as it is now",
}
_PATH_ORIENTATIONS = {"source": "As the path has it", **_LINE_ORIENTATIONS}
_AXES = ("x", "y", "z")
_NEEDS_HEIGHT = "letter-scaled"  # its source gives no height


class LineSection(QGroupBox):
    """Start, end, step, the tool's orientation, and Track line."""

    def __init__(self, session: Session, preferences: Preferences, tracker: PathTracker) -> None:
        super().__init__("Line")
        self._session = session
        self._known_presets: dict[str, tuple[LinePreset, ...]] = {}
        self.presets = combo("line_preset", "Line presets")
        self.presets.activated.connect(self._on_preset)
        self.boxes = {end: [self._box(end, axis, preferences) for axis in _AXES] for end in ("start", "end")}
        self.resolution = QuantityBox("number", preferences, "Step as a fraction of the line")
        self.resolution.setObjectName("line_resolution")
        self.resolution.set_range(0.001, 1.0, "1 gives the two ends alone, 0.001 a thousand pieces.")
        self.resolution.quantity_changed.connect(lambda value: self._edit("line step", "line step", resolution=value))
        self.resolution.refused.connect(session.warn)
        self.resolution.editingFinished.connect(session.end_stroke)
        self.samples = QSpinBox()
        self.samples.setObjectName("line_points")
        self.samples.setAccessibleName("Number of points on the line")
        self.samples.setRange(2, 1001)
        self.samples.setKeyboardTracking(False)
        self.samples.setSuffix(" points")
        self.samples.valueChanged.connect(lambda count: self._edit("line step", resolution=1.0 / (count - 1)))
        self.orientation = combo("line_orientation", "Tool orientation along the line", _LINE_ORIENTATIONS)
        self.orientation.activated.connect(lambda _: self._on_orientation(self.orientation.currentData()))
        tip = "Solve the line and move the tool along it (Ctrl+L)"
        self.button = button("track_line_button", "Track line", tip, tracker.track_line, primary=True)
        self._lay_out()

    def _box(self, end: str, axis: str, preferences: Preferences) -> QuantityBox:
        box = QuantityBox("length", preferences, f"Line {end} {axis}")
        box.setObjectName(f"line_{end}_{axis}")
        box.setMinimumWidth(84)
        box.quantity_changed.connect(lambda _: self._on_point(end))
        box.refused.connect(self._session.warn)
        box.editingFinished.connect(self._session.end_stroke)
        return box

    def _lay_out(self) -> None:
        grid = QGridLayout()
        grid.setSpacing(6)
        for column, axis in enumerate(_AXES):
            label = QLabel(axis)
            set_role(label, role="muted")
            grid.addWidget(label, 0, column + 1, Qt.AlignmentFlag.AlignHCenter)
        for row, end in enumerate(("start", "end"), 1):
            grid.addWidget(QLabel(end.capitalize()), row, 0)
            for column, box in enumerate(self.boxes[end]):
                grid.addWidget(box, row, column + 1)
        step = QHBoxLayout()
        step.setSpacing(6)
        step.addWidget(self.resolution, 1)
        step.addWidget(self.samples, 1)
        rows = form()
        rows.addRow("Preset", self.presets)
        rows.addRow(grid)
        rows.addRow("Step", step)
        rows.addRow("Tool", self.orientation)
        rows.addRow(self.button)
        self.setLayout(rows)

    def show_task(self, experiment: Experiment) -> None:
        """Show the line of the experiment."""
        line, kind = experiment.line, length_kind(experiment.robot)
        for end, point in (("start", line.start), ("end", line.end)):
            for box, value in zip(self.boxes[end], point, strict=True):
                box.set_kind(kind)
                box.set_quantity(float(value))
        self.resolution.set_quantity(line.resolution)
        with QSignalBlocker(self.samples):
            self.samples.setValue(line.samples)
        select(self.orientation, line.orientation)
        self._show_presets(experiment)

    def _show_presets(self, experiment: Experiment) -> None:
        presets = self._presets_of(experiment.robot)
        with QSignalBlocker(self.presets):
            self.presets.clear()
            self.presets.addItem("Your own", None)
            for preset in presets:
                self.presets.addItem(preset.title, preset)
            same = [i for i, preset in enumerate(presets, 1) if _same_line(preset, experiment.line)]
            self.presets.setCurrentIndex(same[0] if same else 0)

    def _presets_of(self, robot: Robot) -> tuple[LinePreset, ...]:
        """Looked for once an arm: an arm that is being edited keeps those that it began with."""
        name = original_name(robot)
        if name not in self._known_presets:
            self._known_presets[name] = line_presets(robot)
        return self._known_presets[name]

    def _on_preset(self, index: int) -> None:
        preset = self.presets.itemData(index)
        if preset is not None:
            line = replace(self._session.experiment, line=preset.task())
            self._session.edit(f"Line: {preset.title}", line)

    def _on_point(self, end: str) -> None:
        self._edit(f"line {end}", f"line {end}", **{end: [box.quantity for box in self.boxes[end]]})

    def _on_orientation(self, orientation: PathOrientation) -> None:
        if orientation != self._session.experiment.line.orientation:
            self._edit("line orientation", orientation=orientation)

    def _edit(self, what: str, merge: str = "", **changes: Any) -> None:
        experiment = self._session.experiment
        line = replace(experiment.line, **changes)
        self._session.edit(f"Edit {what}", replace(experiment, line=line), merge=merge)


class TrajectorySection(QGroupBox):
    """A named path, what is known about it, and Track trajectory."""

    def __init__(self, session: Session, preferences: Preferences, tracker: PathTracker) -> None:
        super().__init__("Trajectory")
        self._session = session
        self.selector = combo("trajectory_selector", "Trajectory")
        self.selector.activated.connect(self._on_chosen)
        self.orientation = combo("trajectory_orientation", "Tool orientation along the trajectory", _PATH_ORIENTATIONS)
        self.orientation.activated.connect(lambda _: self._on_orientation(self.orientation.currentData()))
        self.plane = QuantityBox("length", preferences, "Height of the drawing plane")
        self.plane.setObjectName("trajectory_height")
        self.plane.quantity_changed.connect(lambda value: self._edit("trajectory height", height=value))
        self.plane.refused.connect(session.warn)
        self.plane.editingFinished.connect(session.end_stroke)
        self.plane_label = QLabel("Height")
        self.notes = QLabel(wordWrap=True)
        set_role(self.notes, role="muted")
        tip = "Solve the trajectory and move the tool along it (Ctrl+T)"
        self.button = button("track_trajectory_button", "Track trajectory", tip, tracker.track_trajectory, primary=True)
        rows = form()
        rows.addRow(self.selector)
        rows.addRow(self.notes)
        rows.addRow("Tool", self.orientation)
        rows.addRow(self.plane_label, self.plane)
        rows.addRow(self.button)
        self.setLayout(rows)

    def show_task(self, experiment: Experiment) -> None:
        """Show the trajectory of the experiment."""
        task = experiment.trajectory
        names = [name for name in path_names(experiment.robot) if name != "line"]
        with QSignalBlocker(self.selector):
            self.selector.clear()
            for name in names:
                self.selector.addItem(path_entry(name).title, name)
            self.selector.setCurrentIndex(self.selector.findData(task.name))
        self.notes.setText(path_entry(task.name).citation)
        select(self.orientation, task.orientation)
        self.plane.set_kind(length_kind(experiment.robot))
        self.plane.set_quantity(task.height)
        for widget in (self.plane, self.plane_label):
            widget.setVisible(task.name == _NEEDS_HEIGHT)

    def _on_chosen(self, index: int) -> None:
        task = TrajectoryTask(self.selector.itemData(index))
        experiment = self._session.experiment
        if task.name != experiment.trajectory.name:
            self._session.edit(f"Trajectory: {self.selector.itemText(index)}", replace(experiment, trajectory=task))

    def _on_orientation(self, orientation: PathOrientation) -> None:
        if orientation != self._session.experiment.trajectory.orientation:
            self._edit(orientation=orientation)

    def _edit(self, merge: str = "", **changes: Any) -> None:
        experiment = self._session.experiment
        task = replace(experiment.trajectory, **changes)
        self._session.edit("Edit trajectory", replace(experiment, trajectory=task), merge=merge)


class ResultSection(QGroupBox):
    """What came of it: how many points, how exact, how fast; and what could be done about missed ones."""

    def __init__(self, session: Session, preferences: Preferences, tracker: PathTracker) -> None:
        super().__init__("Result")
        self._session, self._preferences, self._tracker = session, preferences, tracker
        self.reached, self.rms, self.largest, self.between, self.time = (QLabel() for _ in range(5))
        self.between.setObjectName("between_label")
        self.between.setToolTip("How far the tool leaves the way between neighbouring points; more points make it less")
        self.rms.setObjectName("rms_label")
        self.reached.setObjectName("reached_label")
        self.sentence = QLabel(wordWrap=True)
        self.sentence.setObjectName("tracking_sentence")
        self.sentence.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.busy = QProgressBar()
        self.busy.setObjectName("tracking_progress")
        self.busy.setRange(0, 0)
        self.busy.setTextVisible(False)
        self.busy.setFixedHeight(8)
        self.cancel = button("cancel_tracking_button", "Cancel", "Give up working this path out", tracker.cancel)
        self._repairs = QHBoxLayout()
        self._repairs.setSpacing(6)
        rows = form()
        rows.addRow("Reached", self.reached)
        rows.addRow("RMS", self.rms)
        rows.addRow("Largest", self.largest)
        rows.addRow("Between", self.between)
        rows.addRow("Solved in", self.time)
        waiting = QHBoxLayout()
        waiting.addWidget(self.busy, 1)
        waiting.addWidget(self.cancel)
        rows.addRow(waiting)
        rows.addRow(self.sentence)
        rows.addRow(self._repairs)
        self.setLayout(rows)
        self.show_tracking(None)
        self.show_busy(False)
        tracker.busy_changed.connect(self.show_busy)
        self._wear_units("angle_unit")
        preferences.changed.connect(self._wear_units)

    def _wear_units(self, name: str) -> None:
        """Say the result in the preferred units, now and when the next path is tracked."""
        if name in ("angle_unit", "length_unit"):
            self._tracker.units = shown_units(self._preferences)
            self.show_tracking(self._session.tracking)

    def show_busy(self, busy: bool) -> None:
        """Show that a long path is being worked out; the old result stays in sight."""
        self.busy.setVisible(busy)
        self.cancel.setVisible(busy)

    def show_tracking(self, tracking: Tracking | None) -> None:
        """Show the result, or what to do to get one."""
        while self._repairs.count():
            item = self._repairs.takeAt(0)
            if item is not None and (old := item.widget()) is not None:
                old.deleteLater()
        if tracking is None:
            for label in (self.reached, self.rms, self.largest, self.between, self.time):
                label.setText("\u2013")
            self.sentence.setText("Nothing tracked yet. Track line moves the tool from start to end.")
            set_role(self.sentence, level="")
            return
        self._show_numbers(tracking)
        self.sentence.setText(tracking_sentence(tracking, self._tracker.units))
        set_role(self.sentence, level="good" if tracking.complete else "warning")
        for repair in self._tracker.repairs():
            self._repairs.addWidget(self._repair_button(repair))

    def _deviation(self, value: float | None, tracking: Tracking) -> str:
        return "\u2013" if value is None else length_error(tracking.robot, value, self._tracker.units)

    def _show_numbers(self, tracking: Tracking) -> None:
        self.reached.setText(f"{tracking.reached_count} of {tracking.samples} points")
        of_reached = " (reached points)" if 0 < tracking.reached_count < tracking.samples else " (at the points)"
        of_reached = of_reached if tracking.reached_count else ""
        self.rms.setText(self._deviation(tracking.rms, tracking) + of_reached)
        self.largest.setText(self._deviation(tracking.max_deviation, tracking) + of_reached)
        self.between.setText(self._deviation(tracking.way_deviation, tracking))
        milliseconds = tracking.solve_seconds * 1e3
        self.time.setText(f"{milliseconds:.2f} ms ({tracking.seconds_per_point * 1e6:.0f} µs a point)")

    def _repair_button(self, repair: Repair) -> QPushButton:
        name = "repair_" + repair.title.lower().replace(" ", "_")
        return button(name, repair.title, repair.tip, lambda: self._tracker.apply(repair))


class PathPanel(QWidget):
    """Line, trajectory and result, one below the other."""

    def __init__(
        self, session: Session, preferences: Preferences, tracker: PathTracker, parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._session = session
        self.line = LineSection(session, preferences, tracker)
        self.trajectory = TrajectorySection(session, preferences, tracker)
        self.result = ResultSection(session, preferences, tracker)
        inside = QWidget()
        inside.setMinimumWidth(0)
        column = QVBoxLayout(inside)
        column.setContentsMargins(12, 6, 12, 8)
        column.setSpacing(4)
        for section in (self.line, self.trajectory, self.result):
            column.addWidget(section)
        column.addStretch(1)
        self._scroll = scrolled(inside)
        column_of(self, self._scroll)
        session.changed.connect(self._on_changed)
        session.tracking_changed.connect(self._on_tracking)
        self._show(session.experiment)

    def _on_changed(self, before: Experiment, after: Experiment) -> None:
        if (
            after.robot is not before.robot
            or after.line is not before.line
            or after.trajectory is not before.trajectory
        ):
            self._show(after)

    def _on_tracking(self, tracking: Tracking | None) -> None:
        self.result.show_tracking(tracking)
        if tracking is not None:
            # When the layout has made room for the sentence and the buttons, on a low screen too.
            QTimer.singleShot(0, self, self._show_result)

    def _show_result(self) -> None:
        self._scroll.ensureWidgetVisible(self.result, 0, 0)
        self._scroll.horizontalScrollBar().setValue(0)

    def _show(self, experiment: Experiment) -> None:
        self.line.show_task(experiment)
        self.trajectory.show_task(experiment)


def _same_line(preset: LinePreset, line: LineTask) -> bool:
    return np.allclose(preset.start, line.start, atol=1e-12) and np.allclose(preset.end, line.end, atol=1e-12)
