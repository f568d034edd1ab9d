"""The line between two points: its ends, its step, the tool's orientation along it."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from PySide6.QtCore import QSignalBlocker, Qt
from PySide6.QtWidgets import QGridLayout, QGroupBox, QHBoxLayout, QLabel

from rvsim.experiment import Experiment, LineTask, PathOrientation
from rvsim.gui.calm_boxes import CountBox
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import length_kind
from rvsim.gui.quantity_box import QuantityBox
from rvsim.gui.session import Session
from rvsim.gui.theme import set_role
from rvsim.gui.tracker import PathTracker
from rvsim.gui.widgets import button, combo, form, select
from rvsim.lab.lines import LinePreset, line_presets
from rvsim.language import tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.edits import original_name

LINE_ORIENTATIONS = {
    "down": tr_later("Tool straight down"),
    "free": tr_later("Free pitch: it tilts as it likes"),
    "keep": tr_later("Tool as it is now"),
}
_AXES = ("x", "y", "z")
_ENDS = {  # its label, the names of its boxes, and what an edit of it is called
    "start": (tr_later("Start"), tr_later("Line start {axis}"), tr_later("Edit line start")),
    "end": (tr_later("End"), tr_later("Line end {axis}"), tr_later("Edit line end")),
}
_EDIT_STEP = tr_later("Edit line step")


class LineSection(QGroupBox):
    """Start, end, step, the tool's orientation, and Track line."""

    def __init__(self, session: Session, preferences: Preferences, tracker: PathTracker) -> None:
        super().__init__(tr("Line"))
        self._session = session
        self._known_presets: dict[str, tuple[LinePreset, ...]] = {}
        self.presets = combo("line_preset", tr("Line presets"))
        self.presets.activated.connect(self._on_preset)
        self.boxes = {end: [self._box(end, axis, preferences) for axis in _AXES] for end in _ENDS}
        self.resolution = QuantityBox("number", preferences, tr("Step as a fraction of the line"))
        self.resolution.setObjectName("line_resolution")
        self.resolution.set_range(0.001, 1.0, tr("1 gives the two ends alone, 0.001 a thousand pieces."))
        self.resolution.quantity_changed.connect(
            lambda value: self._edit(tr(_EDIT_STEP), "line step", resolution=value)
        )
        self.resolution.refused.connect(session.warn)
        self.resolution.editingFinished.connect(session.end_stroke)
        self.samples = CountBox()
        self.samples.setObjectName("line_points")
        self.samples.setAccessibleName(tr("Number of points on the line"))
        self.samples.setRange(2, 1001)
        self.samples.setKeyboardTracking(False)
        self.samples.setSuffix(tr(" points"))
        self.samples.valueChanged.connect(lambda count: self._edit(tr(_EDIT_STEP), resolution=1.0 / (count - 1)))
        self.orientation = combo("line_orientation", tr("Tool orientation along the line"), LINE_ORIENTATIONS)
        self.orientation.activated.connect(lambda _: self._on_orientation(self.orientation.currentData()))
        tip = tr("Solve the line and move the tool along it (Ctrl+L)")
        self.button = button("track_line_button", tr("Track line"), tip, tracker.track_line, primary=True)
        self._lay_out()

    def _box(self, end: str, axis: str, preferences: Preferences) -> QuantityBox:
        box = QuantityBox("length", preferences, tr(_ENDS[end][1], axis=axis))
        box.setObjectName(f"line_{end}_{axis}")
        box.setMinimumWidth(84)
        box.quantity_changed.connect(lambda _: self._on_point(end))
        box.refused.connect(self._session.warn)
        box.editingFinished.connect(self._session.end_stroke)
        return box

    def _lay_out(self) -> None:
        grid = QGridLayout()
        grid.setSpacing(6)
        columns = (3, 2, 1) if self.isRightToLeft() else (1, 2, 3)  # x, y, z from left to right in any language
        for column, axis in zip(columns, _AXES, strict=True):
            label = QLabel(axis)
            set_role(label, role="muted")
            grid.addWidget(label, 0, column, Qt.AlignmentFlag.AlignHCenter)
        for row, (end, (title, *_)) in enumerate(_ENDS.items(), 1):
            grid.addWidget(QLabel(tr(title)), row, 0)
            for column, box in zip(columns, self.boxes[end], strict=True):
                grid.addWidget(box, row, column)
        step = QHBoxLayout()
        step.setSpacing(6)
        step.addWidget(self.resolution, 1)
        step.addWidget(self.samples, 1)
        rows = form()
        rows.addRow(tr("Preset"), self.presets)
        rows.addRow(grid)
        rows.addRow(tr("Step"), step)
        rows.addRow(tr("Tool"), self.orientation)
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
            self.presets.addItem(tr("Your own"), None)
            for preset in presets:
                self.presets.addItem(tr(preset.title), preset)
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
            self._session.edit(tr("Line: {title}", title=tr(preset.title)), line)

    def _on_point(self, end: str) -> None:
        self._edit(tr(_ENDS[end][2]), f"line {end}", **{end: [box.quantity for box in self.boxes[end]]})

    def _on_orientation(self, orientation: PathOrientation) -> None:
        if orientation != self._session.experiment.line.orientation:
            self._edit(tr("Edit line orientation"), orientation=orientation)

    def _edit(self, text: str, merge: str = "", **changes: Any) -> None:
        experiment = self._session.experiment
        line = replace(experiment.line, **changes)
        self._session.edit(text, replace(experiment, line=line), merge=merge)


def _same_line(preset: LinePreset, line: LineTask) -> bool:
    return np.allclose(preset.start, line.start, atol=1e-12) and np.allclose(preset.end, line.end, atol=1e-12)
