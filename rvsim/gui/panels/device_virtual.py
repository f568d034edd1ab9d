"""The Virtual page: what goes wrong with the virtual arm, and other programs that drive one."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QCheckBox, QGroupBox, QHBoxLayout, QLabel, QVBoxLayout, QWidget

from rvsim.device.virtual.arm import VirtualArm
from rvsim.device.virtual.faults import FAULT_WORDS, NO_FAULTS, Fault
from rvsim.device.words import axis_names, with_capital
from rvsim.experiment import Experiment
from rvsim.gui.device_control import DeviceControl
from rvsim.gui.device_words import baud_words
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.panels.inspect_page import InspectPage
from rvsim.gui.preferences import Preferences
from rvsim.gui.served_arm import ServedArm, Way, ways
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import button, column_of, combo, form, scrolled
from rvsim.language import tr, tr_later

_NONE = tr_later(
    "No virtual arm is in use: connect one on the Drive page, or serve one below. Its faults are switched here."
)
_IN_USE = tr_later("What can go wrong on a real arm, switched while it runs. The stop must hold against all of it.")
_SERVE = tr_later(
    "Let another program, your own for instance, drive a virtual arm: it sends the same bytes as to a real one, "
    "and the ghost in the scene moves."
)
_SILENT = tr_later("No program has sent anything yet.")
_WHICH = {"connected": tr_later("The connected arm"), "served": tr_later("The served arm")}
_BAUDS = (9600, 38400, 115200)
_LINE = 'import serial\nport = serial.serial_for_url("{address}", baudrate={baud})\nport.write(b"#0P1600T1000\\r")'


class VirtualPage(InspectPage):
    """Faults of the virtual arm that is connected or served, and the serving."""

    title = tr_later("Virtual")
    name = "virtual"

    def __init__(
        self, session: Session, preferences: Preferences, stage: Stage, device: DeviceControl, served: ServedArm
    ) -> None:
        super().__init__(session, preferences, stage)
        self._device, self._served = device, served
        self.about = wrapped_label("muted")
        self.about.setObjectName("virtual_about")
        self.which = combo("virtual_which", tr("Which arm's faults are shown and switched"), _WHICH)
        self.which.currentIndexChanged.connect(lambda _: self._refresh_if_seen())
        self.faults = {fault: self._switch(fault) for fault in Fault}
        self.servo = combo("fault_servo", tr("The servo that is jammed or weak"))
        self.servo.currentIndexChanged.connect(lambda _: self._on_servo())
        self.clear = button("faults_clear", tr("No faults"), tr("Switch all of them off"), self._on_clear)
        self.power = button(
            "virtual_power_cycle", tr("Switch it off and on"), tr("The board starts anew: it has forgotten all "
                                                                  "positions"),
            self._on_power,
        )  # fmt: skip
        self._make_serving()
        self._lay_out()
        device.state_changed.connect(lambda _: self._on_device())
        served.changed.connect(self._refresh_if_seen)
        served.watched.connect(self._show_traffic)
        self._shown: VirtualArm | None = None

    def _switch(self, fault: Fault) -> QCheckBox:
        box = QCheckBox(with_capital(tr(fault.value)))
        box.setObjectName(f"fault_{fault.name.lower()}")
        box.setToolTip(tr(FAULT_WORDS[fault]))
        box.toggled.connect(lambda on, fault=fault: self._on_fault(fault, on))
        return box

    def _make_serving(self) -> None:
        self.way = combo("serve_way", tr("How other programs reach it"), ways())
        self.baud = combo("serve_baud", tr("Speed of its board"), {str(rate): baud_words(rate) for rate in _BAUDS})
        self.serve = button(
            "serve_button", tr("Serve a virtual arm"), tr("Other programs can drive it then"), self._on_serve
        )
        self.address = wrapped_label()
        self.address.setObjectName("serve_address")
        self.traffic = wrapped_label("muted")
        self.traffic.setObjectName("serve_traffic")
        self.example = QLabel()
        self.example.setObjectName("serve_example")
        self.example.setWordWrap(True)
        self.example.setLayoutDirection(Qt.LayoutDirection.LeftToRight)  # code, in any language
        set_role(self.example, role="code")
        self.copy = button("serve_copy", tr("Copy as Python"), tr("Three lines that move the base"), self._on_copy)

    def _lay_out(self) -> None:
        faults = QGroupBox(tr("Faults"))
        rows = QVBoxLayout(faults)
        rows.setSpacing(4)
        for box in self.faults.values():
            rows.addWidget(box)
        which = form()
        which.addRow(tr("Which servo"), self.servo)
        rows.addLayout(which)
        buttons = QHBoxLayout()
        buttons.addWidget(self.clear)
        buttons.addWidget(self.power)
        rows.addLayout(buttons)
        serving = QGroupBox(tr("For other programs"))
        column = QVBoxLayout(serving)
        column.setSpacing(6)
        about = wrapped_label("muted")
        about.setText(tr(_SERVE))
        column.addWidget(about)
        choices = form()
        choices.addRow(tr("Through"), self.way)
        choices.addRow(tr("Speed"), self.baud)
        column.addLayout(choices)
        for widget in (self.serve, self.address, self.traffic, self.example, self.copy):
            column.addWidget(widget)
        inside = QWidget()
        page = QVBoxLayout(inside)
        page.setContentsMargins(12, 8, 12, 12)
        page.setSpacing(8)
        for part in (self.about, self.which, faults, serving):
            page.addWidget(part)
        page.addStretch(1)
        column_of(self, scrolled(inside))

    @property
    def _arm(self) -> VirtualArm | None:
        connected, served = self._device.virtual, self._served.arm
        if connected is not None and served is not None:
            return served if self.which.currentData() == "served" else connected
        return connected or served

    def concerns(self, before: Experiment, after: Experiment) -> bool:
        """Only the arm: whether it has servos."""
        return after.robot is not before.robot

    def refresh(self) -> None:
        """Show which faults are on, and whether an arm is served."""
        arm, robot = self._arm, self._session.robot
        self._shown = arm
        self.about.setText(tr(_IN_USE if arm else _NONE))
        self._show_which()
        for fault, box in self.faults.items():
            box.setEnabled(arm is not None)
            with QSignalBlocker(box):
                box.setChecked(arm is not None and fault in arm.faults)
        for widget in (self.clear, self.power, self.servo):
            widget.setEnabled(arm is not None)
        self._show_servos(arm)
        address = self._served.address
        self.serve.setText(tr("Stop serving") if address else tr("Serve a virtual arm"))
        self.serve.setEnabled(bool(robot.servos) or bool(address))
        for widget in (self.way, self.baud):
            widget.setEnabled(not address)
        self.address.setText(tr("Waiting at {address}", address=address) if address else "")
        self.example.setText(self._line)
        for part in (self.address, self.traffic, self.example, self.copy):
            part.setVisible(bool(address))
        self._show_traffic()

    def _show_which(self) -> None:
        """There is a choice only while both are there; it begins with the connected one."""
        both = self._device.virtual is not None and self._served.arm is not None
        self.which.setVisible(both)
        if not both:
            with QSignalBlocker(self.which):
                self.which.setCurrentIndex(0)

    def _show_traffic(self) -> None:
        came, went = self._served.received_bytes, self._served.sent_bytes
        words = tr(
            "{came:,} bytes came in, {went:,} went out. The Wire page shows them while no arm is connected.",
            came=came,
            went=went,
        )
        text = words if came or went else tr(_SILENT)
        if self.traffic.text() != text:
            self.traffic.setText(text)

    def _show_servos(self, arm: VirtualArm | None) -> None:
        names = list(axis_names(self._session.robot)) if self._session.robot.servos else []
        with QSignalBlocker(self.servo):
            if [self.servo.itemText(i) for i in range(self.servo.count())] != names:
                self.servo.clear()
                self.servo.addItems(names)
            if arm is not None:
                self.servo.setCurrentIndex(arm.faults.stalled[0])

    @property
    def _line(self) -> str:
        return _LINE.format(address=self._served.address, baud=self.baud.currentData())

    def _on_device(self) -> None:
        """Each poll tells; what is shown here changes with the arm only."""
        both = self._device.virtual is not None and self._served.arm is not None
        if self._arm is not self._shown or both == self.which.isHidden():
            self._refresh_if_seen()

    def _on_fault(self, fault: Fault, on: bool) -> None:
        arm = self._arm
        if arm is not None:
            arm.faults = arm.faults.switched(fault, on)
            self._session.say(tr(FAULT_WORDS[fault]) if on else tr("Mended: {fault}.", fault=tr(fault.value)))

    def _on_servo(self) -> None:
        arm = self._arm
        if arm is not None:
            chosen = (self.servo.currentIndex(),)
            arm.faults = type(arm.faults)(arm.faults.on, arm.faults.seed, chosen, chosen)

    def _on_clear(self) -> None:
        arm = self._arm
        if arm is not None:
            arm.faults = NO_FAULTS
            self._refresh_if_seen()

    def _on_power(self) -> None:
        arm = self._arm
        if arm is not None:
            arm.power_cycle()

    def _on_serve(self) -> None:
        if self._served.address:
            self._served.end()
        else:
            way: Way = "pty" if self.way.currentData() == "pty" else "tcp"
            self._served.begin(way, int(self.baud.currentData()))

    def _on_copy(self) -> None:
        QGuiApplication.clipboard().setText(self._line)
        self._session.say(tr("Copied."))
