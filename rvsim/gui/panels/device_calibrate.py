"""The Calibrate page: a wizard that any student can finish, and all numbers of the servos below it."""

from __future__ import annotations

import math

from PySide6.QtWidgets import QGroupBox, QVBoxLayout, QWidget

from rvsim.device.calibrate import CalibrationWizard, Objection
from rvsim.device.driver.state import DriverState
from rvsim.experiment import Experiment
from rvsim.gui.device_control import DeviceControl
from rvsim.gui.panels.device_calibrate_automatic import AutomaticSection
from rvsim.gui.panels.device_calibrate_cells import CALIBRATED, Wiring, wiring_of
from rvsim.gui.panels.device_calibrate_flow import at_part, left_over, skipped, with_ends
from rvsim.gui.panels.device_calibrate_jog import Jog, Part
from rvsim.gui.panels.device_calibrate_results import ResultsSection
from rvsim.gui.panels.device_calibrate_step import StepSection
from rvsim.gui.panels.device_calibrate_sweep import near_pulses
from rvsim.gui.panels.device_calibrate_table import ServoTables, today
from rvsim.gui.panels.device_calibrate_target import target_items
from rvsim.gui.panels.device_wake import WakeSection
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.inspect_page import InspectPage
from rvsim.gui.panels.user_robot import ask_where_to_save, saved
from rvsim.gui.preferences import Preferences
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import button, column_of, scrolled
from rvsim.language import tr, tr_later

_NO_SERVOS = tr_later(
    "The {arm} has no servos: choose the Lynxmotion AL5B at the left, or an arm whose robot file has some."
)
_CONNECT = tr_later(
    "No two arms are put together alike: at the same pulse one stands at 30°, another at 35°, a third turns the other "
    "way. Here you find out how yours does: you nudge a joint until the arm stands like the picture, and press Mark. "
    "Two marks a joint are enough. Connect an arm on the page Drive first; a virtual one has hidden numbers to find."
)
_BRIDGE = tr_later(
    "The encoder bridge knows its servos itself and takes angles, not pulses: there is nothing to calibrate from here."
)
_LOST = tr_later("The connection is lost. Connect again on the page Drive; the marks are kept.")
_STOPPED = tr_later("The stop has latched. Reset it to go on; nothing moves by that, and the marks are kept.")
_STILL_MOVING = tr_later("The arm is still moving. Press Mark when it stands.")


class CalibratePage(InspectPage):
    """Nothing moves but by a button of this page, slowly; limits do not count, for a wrong sign must be seen."""

    title = tr_later("Calibrate")
    name = "calibrate"

    def __init__(self, session: Session, preferences: Preferences, stage: Stage, device: DeviceControl) -> None:
        super().__init__(session, preferences, stage)
        self._device = device
        self._jog = Jog(device)
        self._wizard: CalibrationWizard | None = None
        self._basis: Wiring | None = None  # the servos that the wizard began with, or that were taken from it
        self._taken = False
        self._drawn: object = None
        self.about = wrapped_label()
        self.about.setObjectName("calibrate_about")
        self.reset = button(
            "calibrate_reset", tr("Reset the stop"), tr("Leave the latched stop. Nothing moves by that"), device.reset,
            primary=True,
        )  # fmt: skip
        self.wake = WakeSection(preferences)
        self.wake.wake.setObjectName("calibrate_wake")
        self.wake.all.setObjectName("calibrate_wake_all")
        self.wake.what.setObjectName("calibrate_wake_text")
        self.wake.skip.setObjectName("calibrate_wake_skip")
        self.step = StepSection()
        self.automatic = AutomaticSection(device, self._jog)
        self.results = ResultsSection()
        self.tables = ServoTables(session, device)
        self._lay_out()
        self._connect()

    def _lay_out(self) -> None:
        inside = QWidget()
        column = QVBoxLayout(inside)
        column.setContentsMargins(12, 8, 12, 12)
        column.setSpacing(10)
        for part in (self.about, self.reset, self.wake, self.step, self.results, self.automatic):
            column.addWidget(part)
        self.numbers = QGroupBox(tr("All numbers of the servos"))
        rows = QVBoxLayout(self.numbers)
        rows.setContentsMargins(0, 6, 0, 0)
        rows.addWidget(self.tables)
        column.addWidget(self.numbers)
        column.addStretch(1)
        column_of(self, scrolled(inside))

    def _connect(self) -> None:
        step, device = self.step, self._device
        step.part_chosen.connect(self._on_part)
        step.pulse_wanted.connect(self._on_pulse)
        step.near_wanted.connect(self._on_near)
        step.ends_wanted.connect(self._on_ends)
        step.mark_wanted.connect(self._on_mark)
        step.undo_wanted.connect(lambda: self._answer(lambda wizard: wizard.undo()))
        step.skip_wanted.connect(lambda: self._answer(skipped))
        step.other_wanted.connect(lambda: self._answer(lambda wizard: wizard.cannot_reach()))
        self.wake.wake_wanted.connect(lambda axis: device.wake(axis if axis < self._session.robot.dof else None))
        self.wake.wake_all_wanted.connect(device.wake_all)
        self.results.take_wanted.connect(self._on_take)
        self.results.save_wanted.connect(self._on_save)
        self.automatic.begin_wanted.connect(self._on_automatic)
        self.automatic.sweep.advanced.connect(self._go_on_with)
        self.automatic.sweep.ended.connect(self._on_swept)
        device.state_changed.connect(self._on_state)

    # --- what is shown ---------------------------------------------------------------------------------------------

    def concerns(self, before: Experiment, after: Experiment) -> bool:
        """The arm; while it sleeps also the pose that it will jump to."""
        return after.robot is not before.robot or (after.q is not before.q and not self.wake.isHidden())

    def set_seen(self, seen: bool) -> None:
        """What is drawn goes with the page, and comes again with it."""
        self._drawn = None
        super().set_seen(seen)

    def take_over(self, other: CalibratePage) -> None:
        """Go on with the marks of the page of another window."""
        self.step.ends.setChecked(other.step.ends.isChecked())
        self._wizard, self._basis, self._taken = other._wizard, other._basis, other._taken

    def refresh(self) -> None:
        """Show the servos of the arm, and where its calibration stands."""
        robot = self._session.robot
        self.numbers.setVisible(bool(robot.servos))
        self.tables.show_robot(robot)
        if wiring_of(robot) != self._basis:
            self._begin_anew()
        self._show_wizard()
        self._show_state()

    def _begin_anew(self, parts: tuple[Part, ...] | None = None) -> None:
        robot = self._session.robot
        self._basis, self._taken = wiring_of(robot), False
        self._wizard = CalibrationWizard.begin(robot, parts, ends=self.step.ends.isChecked()) if robot.servos else None
        self.step.show_problem("")

    def _show_wizard(self) -> None:
        if self._wizard is None:
            return
        self.step.show_wizard(self._wizard)
        self.results.show_results(self._wizard.robot, self._wizard.results, self._taken)

    def _on_state(self, state: DriverState | None) -> None:
        self._jog.follow(state)
        if self._seen:
            self._show_state()

    def _show_state(self) -> None:
        """What can be done now."""
        state, robot = self._device.state, self._session.robot
        words = self._words(state)
        stopped = state is not None and state.phase == "stopped"
        ready = not words and state is not None and state.connected
        asleep = ready and state is not None and not _all_awake(state, robot.gripper_servo is not None)
        swept = self.automatic.sweep.running
        self.about.setText(words)
        self.about.setVisible(bool(words))
        set_role(self.about, level="error" if stopped or (state is not None and state.phase == "lost") else "")
        self.reset.setVisible(stopped)
        self._show_wake(state if asleep else None)
        self.step.setVisible(ready and not asleep and not swept)
        self.automatic.show_state(ready and not asleep, state, self._wizard)
        self.results.setVisible(self._wizard is not None and (self._taken or bool(self._wizard.results)))
        self.results.take.setEnabled(not swept and (state is None or not state.busy))
        if self._wizard is not None and self._wizard.step is not None:
            self.step.show_pulse(self._jog.pulse(self._wizard.step.joint), state is not None and state.busy)
        self.step.show_virtual(self._device.virtual is not None)
        self._draw_target(ready and not asleep)

    def _words(self, state: DriverState | None) -> str:
        """Why nothing can be calibrated now, or ""."""
        driver, robot = self._device.driver, self._session.robot
        if not robot.servos:
            return tr(_NO_SERVOS, arm=tr(robot.title))
        if driver is not None and driver.language == "bridge":
            return tr(_BRIDGE)
        if state is None or state.phase in ("disconnected", "connecting"):
            return tr(_CONNECT)
        words = {"lost": _LOST, "stopped": _STOPPED}.get(state.phase)
        return tr(words) if words else ""

    def _show_wake(self, state: DriverState | None) -> None:
        if state is None:
            self.wake.hide()
            return
        virtual = self._device.virtual is not None  # the bridge, which is gentle, is not calibrated here
        self.wake.show_state(self._session.robot, self._session.q, state, virtual=virtual, gentle=False)
        self.wake.skip.hide()
        self.wake.wake.setEnabled(not state.busy)

    def _draw_target(self, ready: bool) -> None:
        """The pose of the step, to be compared with the arm."""
        step = self._wizard.step if self._wizard is not None and ready else None
        palette = self._stage.palette
        wanted = (step, palette)
        if self._wizard is None or wanted == self._drawn or not self._seen:
            return
        self._drawn = wanted
        if step is None or step.joint is None:
            self.draw(())
            return
        self.draw(target_items(self._wizard.robot, step, palette))

    # --- what is done ----------------------------------------------------------------------------------------------

    def _answer(self, answer: object) -> None:
        """Go on with what an answer makes of the wizard, or say what is wrong with it."""
        assert callable(answer)
        if self._wizard is None:
            return
        after = answer(self._wizard)
        if isinstance(after, Objection):
            self.step.show_problem(after.sentence)
        else:
            self._go_on_with(after)
            self._show_picture()

    def _go_on_with(self, wizard: CalibrationWizard) -> None:
        robot = self._session.robot
        if not robot.servos or robot.joint_names != wizard.robot.joint_names:
            return  # a sweep that was told to end had one more thing to say, of the arm before
        self._wizard, self._taken = wizard, False
        self.step.show_problem("")
        self._show_wizard()
        self._show_state()

    def _show_picture(self) -> None:
        """Let the window's arm stand as the step wants it: the picture. The other arm follows nobody meanwhile."""
        step = self._wizard.step if self._wizard is not None else None
        if step is not None and step.value is not None and not self._device.live:
            self._session.move_to(step.posture, tr("Picture of a pose to be marked"), merge="calibration")

    def _on_ends(self, on: bool) -> None:
        if self._wizard is not None:
            self._go_on_with(with_ends(self._wizard, on))

    def _on_part(self, part: Part) -> None:
        if self._taken:
            self._begin_anew()
        self._answer(lambda wizard: at_part(wizard, part))

    def _on_pulse(self, pulse_us: float) -> None:
        step = self._wizard.step if self._wizard is not None else None
        if step is not None:
            self.step.show_problem(self._jog.go(step.joint, pulse_us))

    def _on_near(self) -> None:
        if self._wizard is not None:
            self.step.show_problem(self._jog.go_all(near_pulses(self._wizard)))
            self._show_state()
            self._show_picture()

    def _on_mark(self) -> None:
        self._device.poll()  # what was true a moment ago is not good enough
        state, wizard = self._device.state, self._wizard
        if state is None or wizard is None or wizard.step is None:
            return
        pulse = self._jog.pulse(wizard.step.joint)
        if state.busy or math.isnan(pulse):
            self.step.show_problem(tr(_STILL_MOVING))
            return
        self._answer(lambda wizard: wizard.mark(pulse))

    def _on_take(self) -> None:
        self.catch_up()  # of the arm that is there, not of the one before
        wizard, before = self._wizard, self._basis
        if wizard is None:
            return
        found = wizard.calibration(CALIBRATED.format(date=today()))
        left = left_over(wizard)
        self._basis, self._taken = (found.servos, found.gripper_servo), True
        self._device.use_servos(found.servos, found.gripper_servo, tr("Take the calibration"))
        if wiring_of(self._session.robot) != self._basis:
            self._basis, self._taken = before, False
            self.step.show_problem(tr("Not taken: see below, in the status line."))
        elif left:
            self._begin_anew(left)
            self._taken = True
        self._show_wizard()
        self._show_state()

    def _on_save(self) -> None:
        path = ask_where_to_save(self, self._session.robot)
        if path is not None:
            good, sentence = saved(self._session, path)
            self._session.say(sentence, "info" if good else "error")

    def _on_automatic(self) -> None:
        if self._wizard is not None:
            self.automatic.sweep.begin(self._wizard)
            self._show_state()

    def _on_swept(self, sentence: str) -> None:
        self.automatic.show_ending(sentence)
        self._show_wizard()
        self._show_state()


def _all_awake(state: DriverState, grips: bool) -> bool:
    return all(state.awake) and (state.gripper_awake or not grips)
