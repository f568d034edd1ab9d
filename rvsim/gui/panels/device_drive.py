"""The Drive page: connect an arm, wake it, let it follow or run, grip, stop and reset."""

from __future__ import annotations

import math

from PySide6.QtCore import QSignalBlocker, Qt
from PySide6.QtWidgets import QCheckBox, QHBoxLayout, QLabel, QSizePolicy, QVBoxLayout, QWidget

from rvsim.device.driver.state import MEASURED_WORDS, DriverState
from rvsim.experiment import Experiment
from rvsim.gui.calm_boxes import Slider
from rvsim.gui.device_control import DeviceControl
from rvsim.gui.device_words import phase_level, phase_words
from rvsim.gui.panels.device_port import PortSection
from rvsim.gui.panels.device_readings import ReadingsModel
from rvsim.gui.panels.device_wake import WakeSection
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.inspect_page import InspectPage
from rvsim.gui.panels.tables import fit_height, keep_whole, plain_table
from rvsim.gui.preferences import Preferences
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import button, column_of, scrolled
from rvsim.language import tr, tr_later
from rvsim.robot import Robot

_GHOST_TRUE = tr_later("The translucent arm in the scene is where the virtual arm really is.")
_GHOST_BACK = tr_later("The translucent arm in the scene is what came back.")
_STEPS = 100  # of the gripper's slider
_NO_SERVOS = tr_later(
    "The {arm} has no servos to drive: choose the Lynxmotion AL5B at the left, or an arm of your own whose robot file "
    "has [[servo]] tables."
)


class DrivePage(InspectPage):
    """Everything that makes the arm move is refused with a sentence where it must not move."""

    title = tr_later("Drive")
    name = "device"

    def __init__(self, session: Session, preferences: Preferences, stage: Stage, device: DeviceControl) -> None:
        super().__init__(session, preferences, stage)
        self._device = device
        self._phase = ""
        self.light = QLabel("●")
        self.light.setObjectName("device_light")
        self.state_label = wrapped_label("title")
        self.state_label.setObjectName("device_state")
        self.reason = wrapped_label()
        self.reason.setObjectName("device_reason")
        self.port = PortSection()
        self.wake = WakeSection(preferences)
        self.readings = ReadingsModel(preferences)
        self.table = plain_table("device_table", tr("Shown, sent and measured joints"), self.readings)
        keep_whole(self.table, range(1, self.readings.columnCount()), "−180.0°")
        self.measured = wrapped_label("muted")
        self.measured.setObjectName("device_measured_words")
        self._make_buttons()
        self._lay_out()
        self._connect()

    def _make_buttons(self) -> None:
        device = self._device
        self.send = button(
            "device_send", tr("Go to the shown pose"), tr("The arm moves calmly to the pose in the "
                                                          "window"), device.send_pose,
            primary=True,
        )  # fmt: skip
        self.live = QCheckBox(tr("Follow the window (live)"))
        self.live.setObjectName("device_live")
        self.live.setToolTip(
            tr("The arm follows every slider, drag and motion that is shown, held to its limits and speed")
        )
        self.run = button(
            "device_run", tr("Run the motion on the arm"), tr("Checked first: limits, speeds, the table, the "
                                                              "arm itself"),
            device.run_motion,
        )  # fmt: skip
        self.take = button(
            "device_take_pose", tr("Show where the arm is"), tr("The window takes the pose that the arm has "
                                                                "been sent to"),
            device.take_pose,
        )  # fmt: skip
        self.gripper = Slider()
        self.gripper.setLayoutDirection(Qt.LayoutDirection.LeftToRight)  # as those of the joints, in any language
        self.gripper.setObjectName("device_gripper")
        self.gripper.setAccessibleName(tr("Gripper, from closed to open"))
        self.gripper.setRange(0, _STEPS)
        self.gripper.setPageStep(_STEPS // 10)
        self.gripper_label = QLabel("–")
        self.reset = button(
            "device_reset",
            tr("Reset the stop"),
            tr("Leave the latched stop. Nothing moves by that"),
            device.reset,
            primary=True,
        )

    def _lay_out(self) -> None:
        inside = QWidget()
        column = QVBoxLayout(inside)
        column.setContentsMargins(12, 8, 12, 12)
        column.setSpacing(8)
        head = QHBoxLayout()
        head.setSpacing(8)
        head.addWidget(self.light, 0, Qt.AlignmentFlag.AlignTop)
        head.addWidget(self.state_label, 1)
        column.addLayout(head)
        for widget in (self.reason, self.reset, self.port, self.wake):
            column.addWidget(widget)
        column.addWidget(self._drive_box())
        column.addStretch(1)
        column_of(self, scrolled(inside))

    def _drive_box(self) -> QWidget:
        self.drive = QWidget()
        column = QVBoxLayout(self.drive)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(8)
        self.hint = wrapped_label("muted")
        self.hint.setObjectName("device_hint")
        for widget in (self.hint, self.send, self.live, self.run, self.take):
            column.addWidget(widget)
        grip = QHBoxLayout()
        grip.setSpacing(8)
        name = QLabel(tr("Gripper"))
        name.setBuddy(self.gripper)
        self.gripper_label.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self.gripper_label.setMinimumWidth(64)
        grip.addWidget(name)
        grip.addWidget(self.gripper, 1)
        grip.addWidget(self.gripper_label)
        column.addLayout(grip)
        column.addWidget(self.table)
        column.addWidget(self.measured)
        return self.drive

    def _connect(self) -> None:
        device = self._device
        self.port.connect_wanted.connect(self._on_connect)
        self.port.disconnect_wanted.connect(device.disconnect_device)
        self.wake.wake_wanted.connect(self._on_wake)
        self.wake.wake_all_wanted.connect(device.wake_all)
        self.live.toggled.connect(device.set_live)
        self.gripper.sliderReleased.connect(self._on_grip)
        self.gripper.valueChanged.connect(self._on_gripper_value)
        device.state_changed.connect(lambda _: self._refresh_if_seen())
        device.motion.loaded.connect(self._refresh_if_seen)
        device.live_changed.connect(self._show_live)

    def concerns(self, before: Experiment, after: Experiment) -> bool:
        """The pose is what the arm will be sent to."""
        return after.q is not before.q or after.robot is not before.robot

    # --- what is shown ---------------------------------------------------------------------------------------------

    def refresh(self) -> None:
        """Show the state of the arm, and what can be done now."""
        robot, state = self._session.robot, self._device.state
        able = bool(robot.servos)
        self._show_head(robot, state)
        self.port.setVisible(able or state is not None)
        self.port.show_connected(state is not None, state is not None and state.phase == "lost")
        self.drive.setVisible(state is not None and state.phase not in ("lost", "disconnected", "connecting"))
        self.reset.setVisible(state is not None and state.phase == "stopped")
        self.wake.hide()
        if state is None or not able:
            return
        if state.phase in ("asleep", "ready"):
            virtual, driver = self._device.virtual is not None, self._device.driver
            gentle = driver is not None and driver.language == "bridge"
            self.wake.show_state(robot, self._session.q, state, virtual=virtual, gentle=gentle)
        self._show_drive(robot, state)

    def _show_head(self, robot: Robot, state: DriverState | None) -> None:
        phase = state.phase if state else "disconnected"
        if phase != self._phase:
            self._phase = phase
            set_role(self.light, level=phase_level(phase), role="" if phase_level(phase) else "muted")
        self.state_label.setText(phase_words(state, self._device.title))
        reason = state.reason if state else ("" if robot.servos else tr(_NO_SERVOS, arm=tr(robot.title)))
        self.reason.setText(reason)
        self.reason.setVisible(bool(reason))
        set_role(self.reason, level="error" if phase in ("stopped", "lost") else "")

    def _show_drive(self, robot: Robot, state: DriverState) -> None:
        free = state.phase in ("ready", "streaming", "moving")
        awake = all(state.awake)
        self.send.setEnabled(free and awake and not self._device.live)
        self.live.setEnabled(free and awake)
        loaded = self._device.motion.player.trajectory is not None
        self.run.setEnabled(loaded and awake and state.phase in ("ready", "streaming"))
        self.hint.setText(self._hint(state))
        self.hint.setVisible(bool(self.hint.text()))
        self.take.setVisible(awake and not state.busy and self._device.differs)
        grips = robot.gripper_servo is not None
        self.gripper.setEnabled(grips and free and state.gripper_awake)
        if math.isfinite(state.gripper) and not self.gripper.isSliderDown() and not self.gripper.hasFocus():
            with QSignalBlocker(self.gripper):
                self.gripper.setValue(round(_STEPS * state.gripper))
        self.gripper_label.setText(_opening_words(state.gripper))
        self.readings.show_readings(robot, self._session.q, state)
        fit_height(self.table)
        ghost = _GHOST_TRUE if self._device.virtual is not None else _GHOST_BACK
        self.measured.setText(f"{tr(MEASURED_WORDS[state.measured_kind])} {tr(ghost)}")

    def _hint(self, state: DriverState) -> str:
        """Why the buttons below are grey, or what they would do now."""
        if state.phase == "stopped":
            return tr("Reset the stop first; nothing moves by that.")
        if not all(state.awake):
            return tr("The arm can be sent somewhere when every joint is awake.")
        if self._device.motion.player.trajectory is None:
            return tr("To run a motion, track a line or a trajectory first (Path).")
        return ""

    def _show_live(self, on: bool) -> None:
        with QSignalBlocker(self.live):
            self.live.setChecked(on)
        self._refresh_if_seen()

    # --- what is done ----------------------------------------------------------------------------------------------

    def _on_connect(self, url: str, baud: int, language: str) -> None:
        self.wake.begin()
        state = self._device.state
        if state is not None and state.phase == "lost":
            self._device.reconnect()
        else:
            self._device.connect_to(url, baud=baud, language="bridge" if language == "bridge" else "ssc32")

    def _on_wake(self, number: int) -> None:
        self._device.wake(number if number < self._session.robot.dof else None)

    def _on_grip(self) -> None:
        self._device.grip(self.gripper.value() / _STEPS)

    def _on_gripper_value(self, value: int) -> None:
        """A key or a click beside the handle; a drag is sent when it ends."""
        if not self.gripper.isSliderDown():
            self._device.grip(value / _STEPS)


def _opening_words(opening: float) -> str:
    return tr("{percent} % open", percent=round(100.0 * opening)) if math.isfinite(opening) else tr("asleep")
