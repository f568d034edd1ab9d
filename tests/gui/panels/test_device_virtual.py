"""The Virtual page: faults are switched on the arm that is in use, and another program drives one that is served."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
import serial
from PySide6.QtWidgets import QAbstractButton, QCheckBox, QComboBox, QLabel, QTableView
from pytestqt.qtbot import QtBot

from rvsim.device.virtual.faults import FAULT_WORDS, Fault
from rvsim.gui.app import build_window
from rvsim.gui.device_scene import LAYER
from rvsim.gui.main_window import MainWindow
from rvsim.gui.preferences import Preferences

LONG_MS = 20_000


@pytest.fixture
def window(qtbot: QtBot) -> Iterator[MainWindow]:
    made = build_window(Preferences(), robot="al5b")
    qtbot.addWidget(made)
    made.show()
    made.docks.show_panel("virtual")
    yield made
    made.close()


def press(window: MainWindow, name: str) -> None:
    button = window.findChild(QAbstractButton, name)
    assert button is not None
    assert button.isEnabled(), name
    button.click()


def test_faults_wait_for_an_arm_and_are_switched_on_it(qtbot: QtBot, window: MainWindow) -> None:
    boxes = {fault: window.findChild(QCheckBox, f"fault_{fault.name.lower()}") for fault in Fault}
    assert all(box is not None and not box.isEnabled() for box in boxes.values())
    window.device.connect_to("al5b://", baud=115200)
    qtbot.waitUntil(lambda: window.device.virtual is not None, timeout=LONG_MS)
    qtbot.waitUntil(lambda: all(box.isEnabled() for box in boxes.values()), timeout=LONG_MS)
    arm = window.device.virtual
    assert arm is not None
    boxes[Fault.STUCK_MOVING].click()
    assert arm.faults.on == {Fault.STUCK_MOVING}
    label = window.findChild(QLabel, "status_message")
    assert label is not None
    assert label.text() == FAULT_WORDS[Fault.STUCK_MOVING]
    servo = window.findChild(QComboBox, "fault_servo")
    assert servo is not None
    servo.setCurrentIndex(2)
    assert (arm.faults.stalled, arm.faults.sagging) == ((2,), (2,))
    press(window, "faults_clear")
    assert not arm.faults.on


def test_another_program_drives_a_served_arm_and_the_window_shows_it(qtbot: QtBot, window: MainWindow) -> None:
    way = window.findChild(QComboBox, "serve_way")
    assert way is not None
    way.setCurrentIndex(way.findData("tcp"))
    press(window, "serve_button")
    arm = window.served.arm
    assert arm is not None
    before = arm.true_q
    address = window.findChild(QLabel, "serve_address")
    assert address is not None
    assert window.served.address in address.text()
    with serial.serial_for_url(window.served.address, timeout=10.0) as port:
        port.write(b"VER\r#0P1800\r")
        assert port.read_until(b"\r").startswith(b"SSC32")
        qtbot.waitUntil(lambda: bool(np.abs(arm.true_q - before).max() > 0.2), timeout=LONG_MS)
    traffic = window.findChild(QLabel, "serve_traffic")
    assert traffic is not None
    qtbot.waitUntil(lambda: traffic.text().startswith("12 bytes came in, 14 went out"), timeout=LONG_MS)
    window.docks.show_panel("wire")
    model = window.findChild(QTableView, "wire_log").model()
    qtbot.waitUntil(lambda: model.rowCount() == 3, timeout=LONG_MS)
    assert [model.index(row, 2).data() for row in range(3)] == ["VER\\r", "SSC32-V2.04GP\\r", "#0P1800\\r"]
    assert model.index(2, 3).data() == "Wakes the base: it jumps to 1800 µs."
    window.docks.show_panel("virtual")
    qtbot.waitUntil(lambda: bool(window.stage._layers.get(LAYER)), timeout=LONG_MS)
    press(window, "serve_button")
    assert window.served.arm is None
    qtbot.waitUntil(lambda: not window.stage._layers.get(LAYER), timeout=LONG_MS)


def test_with_two_virtual_arms_it_is_chosen_whose_faults_are_switched(qtbot: QtBot, window: MainWindow) -> None:
    which = window.findChild(QComboBox, "virtual_which")
    way = window.findChild(QComboBox, "serve_way")
    jam = window.findChild(QCheckBox, "fault_stuck_moving")
    assert which is not None
    assert way is not None
    assert jam is not None
    way.setCurrentIndex(way.findData("tcp"))
    press(window, "serve_button")
    assert which.isHidden()
    window.device.connect_to("al5b://", baud=115200)
    qtbot.waitUntil(which.isVisible, timeout=LONG_MS)
    connected, served = window.device.virtual, window.served.arm
    assert connected is not None
    assert served is not None
    jam.click()
    assert (bool(connected.faults.on), bool(served.faults.on)) == (True, False)
    which.setCurrentIndex(1)
    assert not jam.isChecked()
    jam.click()
    assert served.faults.on == {Fault.STUCK_MOVING}
    press(window, "serve_button")
    assert which.isHidden()
