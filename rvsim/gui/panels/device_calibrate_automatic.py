"""Letting the arm calibrate itself, where the real angles can be seen; and why it cannot where they cannot."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QGroupBox, QProgressBar, QVBoxLayout

from rvsim.device.calibrate import CalibrationWizard
from rvsim.device.driver.state import DriverState
from rvsim.gui.device_control import DeviceControl
from rvsim.gui.panels.device_calibrate_jog import Jog
from rvsim.gui.panels.device_calibrate_sweep import Sweep, sweep_seconds
from rvsim.gui.panels.how_steps import wrapped_label
from rvsim.gui.widgets import button
from rvsim.language import tr, tr_later
from rvsim.robot.arrays import FloatArray

_VIRTUAL = tr_later(
    "This arm is virtual, so the window can see where it really stands. It can do what you do: sweep each joint "
    "gently between its two poses and lay a line through what it sees. Hobby servos alone cannot tell their angles."
)
_ENCODERS = tr_later(
    "The angles of this arm are measured. Each joint sweeps gently between its two poses, and a line is laid through "
    "what is measured. Keep clear; Esc stops."
)
_TAPS = tr_later(
    "The potentiometers are those inside the servos: they tell the pulse at which a servo stands, not the angle of "
    "the joint. So this arm cannot calibrate itself; mark its poses."
)
_POTENTIOMETERS = "potentiometers"


class AutomaticSection(QGroupBox):
    """Owns the sweep; `begin_wanted()` asks for it."""

    begin_wanted = Signal()

    def __init__(self, device: DeviceControl, jog: Jog) -> None:
        super().__init__(tr("Automatic"))
        self._device = device
        self._timed: tuple[CalibrationWizard | None, str] = (None, "")
        self.sweep = Sweep(device, jog, self._seen_angles, self)
        self.about, self.ending = wrapped_label("muted"), wrapped_label()
        self.about.setObjectName("calibrate_automatic_about")
        self.ending.setObjectName("calibrate_automatic_ending")
        self.progress = QProgressBar()
        self.progress.setObjectName("calibrate_automatic_progress")
        self.progress.setFixedHeight(6)
        self.progress.setTextVisible(False)
        self.begin = button(
            "calibrate_automatic",
            tr("Sweep the joints"),
            tr("From the joint chosen above on; each moves slowly"),
            self._on_begin,
        )
        self.cancel = button(
            "calibrate_automatic_cancel", tr("Cancel the sweep"), tr("The arm holds where it is; what was found stays"),
            self.sweep.cancel,
        )  # fmt: skip
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 6, 0, 0)
        column.setSpacing(6)
        for widget in (self.about, self.progress, self.begin, self.cancel, self.ending):
            column.addWidget(widget)
        self.ending.hide()

    def show_state(self, ready: bool, state: DriverState | None, wizard: CalibrationWizard | None) -> None:
        """Offer it where angles can be seen, and say why not where one would expect it."""
        running = self.sweep.running
        words = self._words(state) if ready else ""
        self.setVisible(bool(words) or running)
        able = words in (_VIRTUAL, _ENCODERS)
        self.about.setText(f"{tr(words)} {self._duration(wizard)}".rstrip() if able else tr(words) if words else "")
        self.begin.setVisible(able and not running)
        self.cancel.setVisible(running)
        self.progress.setVisible(running)
        if running:
            self.show_ending(self.sweep.words)
            self.progress.setRange(0, 100)
            self.progress.setValue(round(100.0 * self.sweep.progress))

    def show_ending(self, sentence: str) -> None:
        """How it ended."""
        self.ending.setText(sentence)
        self.ending.setVisible(bool(sentence))

    def _duration(self, wizard: CalibrationWizard | None) -> str:
        """A sentence; reckoned once a step."""
        if wizard is not self._timed[0]:
            self._timed = (wizard, "" if wizard is None else _duration_words(sweep_seconds(wizard)))
        return self._timed[1]

    def _words(self, state: DriverState | None) -> str:
        if state is not None and state.measured_kind == _POTENTIOMETERS:
            return _TAPS
        if state is not None and state.measured_kind == "encoders":
            return _ENCODERS
        return _VIRTUAL if self._device.virtual is not None else ""

    def _seen_angles(self) -> FloatArray | None:
        """(n,) where the joints really are [rad, m], or None when nobody knows."""
        state, virtual = self._device.state, self._device.virtual
        if state is not None and state.measured_kind == "encoders":
            return state.measured_q
        return None if virtual is None else virtual.true_q

    def _on_begin(self) -> None:
        self.show_ending("")
        self.begin_wanted.emit()


def _duration_words(seconds: float) -> str:
    if not seconds:
        return ""
    minutes = round(seconds / 60.0)
    if minutes > 1:
        return tr("It takes about {minutes}\u00a0min.", minutes=minutes)
    return tr("It takes about {seconds:.0f}\u00a0s.", seconds=max(round(seconds, -1), 10))
