"""A student drives the virtual AL5B at the window: connect, wake, run a line, pull the plug, stop, reset.

Everything goes through object names. The driver has a thread of its own, so the test waits for what it says.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QAbstractButton, QCheckBox, QDialog, QLabel, QWidget
from pytestqt.qtbot import QtBot

from rvsim.device.driver.state import DriverState
from rvsim.device.virtual.faults import Fault
from rvsim.gui.app import build_window
from rvsim.gui.main_window import MainWindow
from rvsim.gui.preferences import Preferences
from rvsim.robot.arrays import FloatArray

LONG_MS = 30_000


@pytest.fixture
def window(qtbot: QtBot, quick_time: None) -> Iterator[MainWindow]:
    made = build_window(Preferences(), robot="al5b")
    qtbot.addWidget(made)
    made.show()
    made.docks.show_panel("device")
    yield made
    made.close()


def press(qtbot: QtBot, window: QWidget, name: str) -> None:
    button = window.findChild(QAbstractButton, name)
    assert button is not None
    assert button.isEnabled(), name
    button.click()


def message(window: QWidget) -> str:
    label = window.findChild(QLabel, "status_message")
    assert label is not None
    return label.text()


def wait(qtbot: QtBot, window: MainWindow, holds: Callable[[DriverState], bool]) -> DriverState:
    def reached() -> bool:
        window.device.poll()
        return window.device.state is not None and holds(window.device.state)

    qtbot.waitUntil(reached, timeout=LONG_MS)
    assert window.device.state is not None
    return window.device.state


def connect(qtbot: QtBot, window: MainWindow) -> None:
    page = window.findChild(QWidget, "device_page")
    assert page is not None
    page.port.baud.setCurrentIndex(page.port.baud.findData("115200"))  # type: ignore[attr-defined]
    press(qtbot, window, "device_connect_button")
    wait(qtbot, window, lambda state: state.phase == "asleep")


def wake(qtbot: QtBot, window: MainWindow) -> None:
    press(qtbot, window, "device_wake_all")
    wait(qtbot, window, lambda state: state.phase == "ready" and all(state.awake) and state.gripper_awake)


def test_a_tracked_line_outlives_the_other_limits(qtbot: QtBot, window: MainWindow) -> None:
    window.tracker.track_line()
    window.motion.pause()
    for _ in range(2):  # connect, disconnect
        press(qtbot, window, "device_connect_button")
        tracking = window.session.tracking
        assert tracking is not None
        assert tracking.robot is window.session.robot
        assert window.motion.player.state == "stopped"


def test_connecting_moves_nothing_and_brings_the_limits_of_the_servos(qtbot: QtBot, window: MainWindow) -> None:
    own = window.session.robot.limits
    connect(qtbot, window)
    arm = window.device.virtual
    assert arm is not None
    assert not np.isfinite(arm.commanded_pulses).any()
    assert np.degrees(window.session.robot.limits[1]) == pytest.approx([0.0, 168.0], abs=0.1)
    press(qtbot, window, "device_connect_button")
    assert window.device.state is None
    np.testing.assert_array_equal(window.session.robot.limits, own)


def test_a_joint_is_woken_alone_and_the_next_is_asked_for(qtbot: QtBot, window: MainWindow) -> None:
    connect(qtbot, window)
    text = window.findChild(QLabel, "device_wake_text")
    assert text is not None
    assert text.text() == "The base will jump to 0.0° (1500 µs)."
    press(qtbot, window, "device_wake")
    state = wait(qtbot, window, lambda state: state.phase == "ready")
    assert state.awake == (True, False, False, False, False)
    assert text.text().startswith("The shoulder will jump to 90.0°")
    window.device.send_pose()
    assert "asleep" in message(window)


def test_a_bridge_that_measures_is_not_said_to_jump(qtbot: QtBot, window: MainWindow) -> None:
    window.device.connect_to("al5b://", baud=115200, language="bridge")
    wait(qtbot, window, lambda state: state.phase == "asleep")
    text = window.findChild(QLabel, "device_wake_text")
    assert text is not None
    assert text.text() == "The base will go to 0.0°."


def test_a_line_is_run_to_its_end_and_then_the_plug_is_pulled(qtbot: QtBot, window: MainWindow) -> None:
    connect(qtbot, window)
    wake(qtbot, window)
    window.session.edit("Quickly", replace(window.session.experiment, path_seconds=1.0))
    window.tracker.track_line()
    press(qtbot, window, "device_run")
    wait(qtbot, window, lambda state: state.phase == "running")
    state = wait(qtbot, window, lambda state: state.phase == "ready")
    np.testing.assert_allclose(state.commanded_q, window.session.q, atol=np.radians(1.0))
    assert message(window).startswith("The arm has done the motion.")
    press(qtbot, window, "device_run")
    wait(qtbot, window, lambda state: state.phase == "running")
    arm = window.device.virtual
    assert arm is not None
    arm.faults = arm.faults.switched(Fault.PORT_VANISHES)
    state = wait(qtbot, window, lambda state: state.phase == "lost")
    assert state.reason
    assert message(window) == state.reason
    press(qtbot, window, "device_connect_button")  # "Connect again"
    state = wait(qtbot, window, lambda state: state.phase == "asleep")
    assert not any(state.awake)


class Low:
    """Slowly from home to a place below the table."""

    duration = 4.0

    def __init__(self, home: FloatArray) -> None:
        self.home = home

    def q(self, t: object) -> FloatArray:
        share = np.asarray(t, dtype=np.float64)[..., None] / self.duration
        return np.asarray(self.home + share * (np.radians([0.0, 10.0, -50.0, 0.0, 0.0]) - self.home))


def test_an_arm_that_is_awake_refuses_follows_stops_and_is_let_go(qtbot: QtBot, window: MainWindow) -> None:
    connect(qtbot, window)
    wake(qtbot, window)
    refuses_what_would_hurt(qtbot, window)
    follows_and_is_held_at_its_limits(qtbot, window)
    stops_for_good_until_it_is_reset(qtbot, window)
    assert window.device.driver is not None
    log = window.device.driver.log
    sent = log.count
    window.close()
    assert any(b"STOP" in entry.data for entry in log.since(sent)[1] if entry.direction == "→")


def refuses_what_would_hurt(qtbot: QtBot, window: MainWindow) -> None:
    window.motion.load(Low(window.session.robot.home), "Reach for the table")
    press(qtbot, window, "device_run")
    assert "would touch the table" in message(window)
    assert window.device.state is not None
    assert window.device.state.phase == "ready"


def follows_and_is_held_at_its_limits(qtbot: QtBot, window: MainWindow) -> None:
    live = window.findChild(QCheckBox, "device_live")
    assert live is not None
    live.click()
    wanted = np.radians([20.0, 100.0, -80.0, 10.0, 30.0])
    window.session.move_to(wanted, "there")
    wait(qtbot, window, lambda state: bool(np.abs(state.commanded_q - wanted).max() < 0.01))
    window.session.edit("Ignore", window.session.experiment.at(np.radians([20.0, 100.0, -80.0, 10.0, 120.0])))
    state = wait(qtbot, window, lambda state: bool(state.clamped))
    assert state.clamped == ("wrist rotate",)


def stops_for_good_until_it_is_reset(qtbot: QtBot, window: MainWindow) -> None:
    press(qtbot, window, "emergency_stop_button")
    wait(qtbot, window, lambda state: state.phase == "stopped")
    assert message(window).startswith("The stop button was pressed.")
    window.device.send_pose()
    assert window.device.state is not None
    assert window.device.state.phase == "stopped"

    def reset(state: DriverState) -> bool:
        """It needs an answer of the controller since the stop, so it may have to be pressed again."""
        if state.phase == "stopped":
            press(qtbot, window, "device_reset")
        return state.phase == "ready"

    wait(qtbot, window, reset)


def test_escape_stops_even_in_a_dialog(qtbot: QtBot, window: MainWindow) -> None:
    connect(qtbot, window)
    dialog = QDialog(window)
    dialog.open()
    qtbot.keyClick(dialog, Qt.Key.Key_Escape)
    wait(qtbot, window, lambda state: state.phase == "stopped")
    assert message(window).startswith("Esc was pressed.")


def test_another_arm_lets_go_of_the_device(qtbot: QtBot, window: MainWindow) -> None:
    connect(qtbot, window)
    window.session.use_robot(window.library["ur5e"])
    assert window.device.state is None
    window.device.connect_to("al5b://")
    assert "no servos" in message(window)
