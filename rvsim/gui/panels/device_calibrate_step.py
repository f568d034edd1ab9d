"""One step of the calibration: which joint, what to do, buttons to nudge it with, and Mark."""

from __future__ import annotations

import math

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QCheckBox, QHBoxLayout, QProgressBar, QVBoxLayout, QWidget

from rvsim.device.calibrate import CalibrationWizard, Step
from rvsim.gui.panels.device_calibrate_flow import current_part, found_parts, part_title, where_words
from rvsim.gui.panels.device_calibrate_jog import Part
from rvsim.gui.panels.device_calibrate_nudge import NudgeRow
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.tables import dot
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import button, combo
from rvsim.language import tr, tr_later

_GRIPPER = -1  # in the box of joints
_HINT = tr_later(
    "Come from one side and stop at the first pulse that looks right: a servo that hums stands at its end. Hold a "
    "button to go on; arrow keys nudge by 1 µs, with Shift by 10. All moves are slow, and Esc stops."
)
_VIRTUAL = tr_later("Nudge until the translucent hand (where the arm really stands) covers the dashed one.")
_MARK_TIP, _WAIT_TIP = (
    tr_later("The arm stands as it should: take this pulse"),
    tr_later("The arm is moving: wait until it stands"),
)
_DONE = tr_later("All is marked. Take the calibration below, or choose a joint to do it again.")
_MARKS = {
    "first pose": tr_later("Mark first pose"),
    "second pose": tr_later("Mark second pose"),
    "open": tr_later("Mark open"),
    "closed": tr_later("Mark closed"),
    "least end": tr_later("Mark this end"),
    "largest end": tr_later("Mark this end"),
}
_SKIPS = {"least end": tr_later("Skip both ends"), "largest end": tr_later("Skip this end")}


class StepSection(QWidget):
    """Shows a wizard's step.

    Signals:
        part_chosen(part): another joint (from 0), or None for the gripper.
        pulse_wanted(µs), near_wanted(): the servo is to be nudged there; all are to go near the pose.
        ends_wanted(on): whether to ask how far each joint may go.
        mark_wanted(), undo_wanted(), skip_wanted(), other_wanted(): the buttons.
    """

    part_chosen = Signal(object)
    pulse_wanted = Signal(float)
    near_wanted = Signal()
    ends_wanted = Signal(bool)
    mark_wanted = Signal()
    undo_wanted = Signal()
    skip_wanted = Signal()
    other_wanted = Signal()

    def __init__(self) -> None:
        super().__init__()
        self._wizard: CalibrationWizard | None = None
        self._parts: tuple[Part, ...] = ()
        self.title, self.instruction = wrapped_label("title"), wrapped_label()
        self.title.setObjectName("calibrate_title")
        self.instruction.setObjectName("calibrate_instruction")
        self.where, self.virtual = wrapped_label("muted"), wrapped_label("muted")
        self.where.setObjectName("calibrate_where")
        self.virtual.setObjectName("calibrate_virtual")
        self.virtual.setText(tr(_VIRTUAL))
        self.hint, self.problem = wrapped_label("muted"), wrapped_label()
        self.hint.setText(tr(_HINT))
        self.problem.setObjectName("calibrate_problem")
        set_role(self.problem, level="error")
        self.progress = QProgressBar()
        self.progress.setObjectName("calibrate_progress")
        self.progress.setTextVisible(False)
        self.progress.setFixedHeight(6)
        self.part = combo("calibrate_joint", tr("Which joint is calibrated"))
        self.part.activated.connect(lambda _: self.part_chosen.emit(self._chosen))
        self.nudge = NudgeRow()
        self.nudge.pulse_wanted.connect(self.pulse_wanted)
        self._make_buttons()
        self._lay_out()

    def _make_buttons(self) -> None:
        self.near = button(
            "calibrate_near", tr("Go near it, slowly"),
            tr("All joints go to where the calibration so far has this pose. Where a direction is wrong they go the "
            "other way: keep clear, and a finger at Esc"), self.near_wanted.emit,
        )  # fmt: skip
        self.mark = button(
            "calibrate_mark", tr("Mark"), tr(_MARK_TIP), self.mark_wanted.emit,
            primary=True,
        )  # fmt: skip
        self.undo = button("calibrate_undo", tr("Undo mark"), tr("Back to the step before"), self.undo_wanted.emit)
        self.skip = button("calibrate_skip", tr("Skip"), "", self.skip_wanted.emit)
        self.other = button(
            "calibrate_other_pose", tr("It does not come that far"), tr("Ask for a pose nearer to the middle"),
            self.other_wanted.emit,
        )  # fmt: skip

        self.ends = QCheckBox(tr("Also find how far each joint may go"))
        self.ends.setObjectName("calibrate_ends")
        self.ends.setToolTip(tr("Two more steps a joint. Without them a joint may go as far as before, in degrees"))
        self.ends.toggled.connect(self.ends_wanted)

    def _lay_out(self) -> None:
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(8)
        words = (self.where, self.title, self.instruction, self.virtual)
        for widget in (self.part, self.progress, *words, self.near, self.nudge, self.mark):
            column.addWidget(widget)
        row = QHBoxLayout()
        row.setSpacing(6)
        row.addWidget(self.undo, 1)
        row.addWidget(self.skip, 1)
        column.addLayout(row)
        for below in (self.other, self.problem, self.ends, self.hint):
            column.addWidget(below)
        self._of_a_step = (self.where, self.near, self.nudge, self.mark, self.skip, self.hint)

    @property
    def _chosen(self) -> Part:
        number = int(self.part.currentData())
        return None if number == _GRIPPER else number

    def show_wizard(self, wizard: CalibrationWizard) -> None:
        """Show where a wizard stands."""
        self._wizard = wizard
        step = wizard.step
        self._show_parts(wizard)
        self.progress.setRange(0, wizard.count)
        self.progress.setValue(round(wizard.progress * wizard.count))
        self.title.setText(tr("All is marked") if step is None else step.title)
        self.where.setText(where_words(wizard))
        self.instruction.setText(tr(_DONE) if step is None else step.instruction)
        for widget in self._of_a_step:
            widget.setVisible(step is not None)
        self.other.setVisible(step is not None and step.value is not None)
        self.undo.setEnabled(bool(wizard.marks))
        if step is not None:
            self._show_step(step)

    def _show_step(self, step: Step) -> None:
        self.mark.setText(tr(_MARKS[step.stage]))
        self.skip.setText(tr(_SKIPS[step.stage]) if step.stage in _SKIPS else tr("Skip"))
        self.skip.setToolTip(step.skip)

    def _show_parts(self, wizard: CalibrationWizard) -> None:
        robot, found = wizard.robot, found_parts(wizard)
        parts = (*range(robot.dof), *((None,) if None in wizard.parts else ()))
        with QSignalBlocker(self.part):
            if parts != self._parts or self.part.count() != len(parts):
                self._parts = parts
                self.part.clear()
                for part in parts:
                    color = "#2ca02c" if part is None else robot.joints[part].color
                    self.part.addItem(dot(color), "", _GRIPPER if part is None else part)
            for row, part in enumerate(parts):
                self.part.setItemText(row, part_title(robot, part) + ("  ✓" if part in found else ""))
            self.part.setCurrentIndex(parts.index(current_part(wizard)))

    def show_virtual(self, virtual: bool) -> None:
        """Say what to look at where the window sees how the arm really stands."""
        posed = self._wizard is not None and self._wizard.step is not None and self._wizard.step.value is not None
        self.virtual.setVisible(virtual and posed)

    def show_pulse(self, pulse_us: float, moving: bool) -> None:
        """Show where the servo is [µs], NaN: it sleeps; nothing can be marked while the arm is moving."""
        awake = math.isfinite(pulse_us)
        for widget in (self.nudge, self.near):
            widget.setEnabled(awake)
        self.mark.setEnabled(awake and not moving)
        self.mark.setToolTip(tr(_WAIT_TIP if moving else _MARK_TIP))
        if awake:
            self.nudge.show_pulse(pulse_us)

    def show_problem(self, sentence: str) -> None:
        """Say why something was not done; "" takes it away."""
        self.problem.setText(sentence)
        self.problem.setVisible(bool(sentence))
