"""The solvers' settings by the names of source 000, its presets, and the damping as a slider."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QCheckBox, QGridLayout, QLabel, QSizePolicy, QVBoxLayout, QWidget

from rvsim.errors import SettingError
from rvsim.gui.calm_boxes import Slider
from rvsim.gui.panels.laboratory_fields import Disclosure, NumberEdit
from rvsim.gui.panels.laboratory_setup import labelled_row
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Kind, display, length_kind
from rvsim.gui.session import Session
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import combo, select
from rvsim.kinematics.numeric import Preset, SolverOptions, Task
from rvsim.lab.laboratory import EXACT, PRESETS
from rvsim.language import tr, tr_later

_TASKS = {"pose": tr_later("Full pose"), "position": tr_later("Position only")}
_OWN = "own"


class Field(NamedTuple):
    """One number of `SolverOptions`: its name there and on the screen, what it does, its kind of quantity; English."""

    name: str
    title: str
    tip: str
    kind: Kind = "number"


_FIELDS = (
    Field("max_iterations", "MaxIterations", tr_later("The most iterations, of all tries together")),
    Field("max_time", "MaxTime, s", tr_later("The most seconds, of all tries together")),
    Field(
        "solution_tolerance",
        "SolutionTolerance",
        tr_later("On the norm of weight · error; a solution must be below it"),
    ),
    Field(
        "gradient_tolerance",
        "GradientTolerance",
        tr_later("A try ends where the cost's gradient is smaller than this"),
    ),
    Field(
        "step_tolerance",
        "StepTolerance",
        tr_later("A try ends when no joint moves farther than this in a step [rad, m]"),
    ),
    Field(
        "error_change_tolerance",
        "ErrorChangeTol. (LM)",
        tr_later("LM ends a try when no entry of the error changes more"),
    ),
    Field("damping_bias", "DampingBias (LM)", tr_later("The damping of LM that stays when the error is gone")),
    Field(
        "patience",
        tr_later("Patience"),
        tr_later("A try ends when its cost has not halved in so many iterations (not in source 000)"),
    ),
    Field(
        "position_tolerance",
        tr_later("Position within"),
        tr_later("A solution must be as near as this (not in source 000)"),
        "length",
    ),
    Field(
        "rotation_tolerance",
        tr_later("Rotation within"),
        tr_later("A solution must be turned as near as this"),
        "angle",
    ),
)
_WHOLE = ("max_iterations", "patience")
_SWITCHES = (
    ("enforce_joint_limits", "EnforceJointLimits", tr_later("No iterate leaves the joint limits")),
    (
        "allow_random_restarts",
        "AllowRandomRestarts",
        tr_later("After a try that failed, another from a random start"),
    ),
    (
        "use_error_damping",
        "UseErrorDamping (LM)",
        tr_later("LM damps by the cost plus the bias; off: not at all"),
    ),
)
_WEIGHTS = {"rotation": tr_later("Weight: rotation {axis}"), "position": tr_later("Weight: position {axis}")}
_WEIGHTS_TIP = tr_later(
    "Weights of the error: first the three of the orientation (rotation about x, y, z), then the three of the position "
    "along x, y, z, in base axes. This order, orientation first, is that of source 000."
)
_DAMPING_DECADES = (-4.0, 1.0)
_DAMPING_STEPS = 500


class RulesChooser(QWidget):
    """The settings in force: `options` and `task`.

    Signals:
        changed(): they are others.
        preset_taken(preset): they are those of a preset, which may come with a start.
    """

    changed = Signal()
    preset_taken = Signal(object)

    def __init__(self, session: Session, preferences: Preferences) -> None:
        super().__init__()
        self._session, self._preferences = session, preferences
        self.options: SolverOptions = EXACT.options
        self.task: Task = "pose"
        names = {preset.title: preset.title for preset in PRESETS} | {_OWN: tr("Own settings")}
        self.presets = combo("lab_rules_selector", tr("Settings of the solvers"), names)
        self.presets.activated.connect(self._on_preset)
        self.tasks = combo("lab_task_selector", tr("What of the target counts"), _TASKS)
        self.tasks.activated.connect(self._on_task)
        self.details = QWidget()
        self.disclosure = Disclosure(
            "lab_rules_details_button", tr("Show all settings"), tr("Hide all settings"), self.details
        )
        self._make_fields()
        self._make_damping()
        self._lay_out()
        self._show()
        preferences.changed.connect(self._on_preference)

    # --- construction ----------------------------------------------------------------------------------------------

    def _make_fields(self) -> None:
        self.numbers = {field.name: self._number(field.name, tr(field.title), tr(field.tip)) for field in _FIELDS}
        self.captions = {field.name: _caption(tr(field.title), self.numbers[field.name]) for field in _FIELDS}
        for field in _FIELDS:
            self.numbers[field.name].number_changed.connect(lambda value, f=field: self._on_number(f, value))
        self.weights = [
            self._number(f"weight_{what}_{axis}", tr(title, axis=axis), tr(_WEIGHTS_TIP))
            for what, title in _WEIGHTS.items()
            for axis in "xyz"
        ]
        for weight in self.weights:
            weight.number_changed.connect(lambda _: self._edit(weights=tuple(edit.number for edit in self.weights)))
        self.switches = {name: self._switch(name, title, tr(tip)) for name, title, tip in _SWITCHES}

    def _number(self, name: str, title: str, tip: str) -> NumberEdit:
        edit = NumberEdit(f"lab_{name}", title, tip)
        edit.refused.connect(self._session.warn)
        return edit

    def _switch(self, name: str, title: str, tip: str) -> QCheckBox:
        switch = QCheckBox(title)
        switch.setObjectName(f"lab_{name}")
        switch.setToolTip(tip)
        switch.toggled.connect(lambda on: self._edit(**{name: on}))
        return switch

    def _make_damping(self) -> None:
        tip = tr("λ of damped least squares (DLS): small is quick and wild, large is slow and calm near singular poses")
        self.damping = Slider()
        self.damping.setObjectName("lab_damping_slider")
        self.damping.setAccessibleName(tr("Damping of DLS, slider"))
        self.damping.setToolTip(tip)
        self.damping.setRange(0, _DAMPING_STEPS)
        self.damping.setPageStep(_DAMPING_STEPS // 10)
        self.damping.valueChanged.connect(lambda step: self._edit(damping=_damping_at(step)))
        self.damping_value = self._number("damping", tr("Damping λ"), tip)
        self.damping_value.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self.damping_value.setFixedWidth(72)
        self.damping_value.number_changed.connect(lambda value: self._edit(damping=value))

    def _lay_out(self) -> None:
        grid = QGridLayout(self.details)
        grid.setContentsMargins(0, 0, 0, 2)
        grid.setHorizontalSpacing(10)
        grid.setVerticalSpacing(4)
        grid.addWidget(labelled_row(tr("Counts"), self.tasks), 0, 0, 1, 6)
        for index, field in enumerate(_FIELDS):
            row, column = 1 + 2 * (index // 2), 3 * (index % 2)
            grid.addWidget(self.captions[field.name], row, column, 1, 3)
            grid.addWidget(self.numbers[field.name], row + 1, column, 1, 3)
        row = grid.rowCount()
        for index, switch in enumerate(self.switches.values()):
            grid.addWidget(switch, row + index, 0, 1, 6)
        row = grid.rowCount()
        for half, what in enumerate((tr("Weights, rotation x y z"), tr("then position x y z"))):
            caption = _caption(what, self.weights[3 * half])
            caption.setToolTip(tr(_WEIGHTS_TIP))
            grid.addWidget(caption, row, 3 * half, 1, 3)
        for column, weight in enumerate(self.weights):
            grid.addWidget(weight, row + 1, column)
            grid.setColumnStretch(column, 1)
        column_layout = QVBoxLayout(self)
        column_layout.setContentsMargins(0, 0, 0, 0)
        column_layout.setSpacing(6)
        column_layout.addWidget(labelled_row(tr("Rules"), self.presets, self.disclosure))
        column_layout.addWidget(self.details)
        column_layout.addWidget(labelled_row("DLS λ", self.damping, self.damping_value))

    # --- showing ---------------------------------------------------------------------------------------------------

    def _show(self) -> None:
        preset = self._preset()
        select(self.presets, preset.title if preset else _OWN)
        self.presets.setToolTip(tr(preset.citation) if preset else tr("Settings of your own"))
        select(self.tasks, self.task)
        for field in _FIELDS:
            factor, suffix = self._unit(field)
            self.numbers[field.name].set_number(getattr(self.options, field.name) * factor)
            self.captions[field.name].setText(tr(", ").join(filter(None, (tr(field.title), suffix))))
        for edit, weight in zip(self.weights, self.options.weights, strict=True):
            edit.set_number(weight)
        for name, switch in self.switches.items():
            with QSignalBlocker(switch):
                switch.setChecked(getattr(self.options, name))
        self.damping_value.set_number(self.options.damping)
        with QSignalBlocker(self.damping):
            self.damping.setValue(_step_of(self.options.damping))

    def _preset(self) -> Preset | None:
        """The preset that is in force; the damping slider is beside it."""
        for preset in PRESETS:
            same = replace(preset.options, damping=self.options.damping) == self.options
            if same and preset.task == self.task:
                return preset
        return None

    def _unit(self, field: Field) -> tuple[float, str]:
        if field.kind == "number":
            return 1.0, ""
        kind = length_kind(self._session.robot) if field.kind == "length" else field.kind
        shown = display(kind, self._preferences)
        return shown.factor, shown.suffix.strip()

    def show_robot(self) -> None:
        """Another arm may have another unit of length."""
        self._show()

    def _on_preference(self, name: str) -> None:
        if name in ("angle_unit", "length_unit"):
            self._show()

    # --- edits -----------------------------------------------------------------------------------------------------

    def _on_number(self, field: Field, value: float) -> None:
        number: float = round(value) if field.name in _WHOLE else value / self._unit(field)[0]
        self._edit(**{field.name: number})

    def _edit(self, **changes: Any) -> None:
        self._take(lambda: replace(self.options, **changes))

    def _take(self, make: Callable[[], SolverOptions]) -> None:
        try:
            self.options = make()
        except SettingError as problem:
            self._session.warn(str(problem))
            self._show()
            return
        self._show()
        self.changed.emit()

    def _on_task(self, _index: int) -> None:
        self.task = self.tasks.currentData()
        self._show()
        self.changed.emit()

    def _on_preset(self, index: int) -> None:
        if index >= len(PRESETS):
            self.disclosure.show_content(True)
            self._show()
            return
        preset = PRESETS[index]
        self.options, self.task = replace(preset.options, damping=self.options.damping), preset.task
        self._show()
        self.preset_taken.emit(preset)
        self.changed.emit()


def _caption(text: str, buddy: QWidget) -> QLabel:
    label = QLabel(text)
    label.setBuddy(buddy)
    label.setToolTip(buddy.toolTip())
    set_role(label, role="muted")
    return label


def _damping_at(step: int) -> float:
    low, high = _DAMPING_DECADES
    return float(f"{10.0 ** (low + (high - low) * step / _DAMPING_STEPS):.3g}")


def _step_of(damping: float) -> int:
    low, high = _DAMPING_DECADES
    if damping <= 0.0:
        return 0
    share = (math.log10(damping) - low) / (high - low)
    return round(_DAMPING_STEPS * min(max(share, 0.0), 1.0))
