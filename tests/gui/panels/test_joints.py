"""The joints' panel: what was being typed for one arm is nothing to the next one."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractSpinBox, QWidget
from pytestqt.qtbot import QtBot

from rvsim.files import load_robot
from rvsim.gui.panels.joints import JointsPanel
from rvsim.gui.preferences import Preferences
from rvsim.gui.servo_limits import ServoLimits
from rvsim.gui.session import Session


def test_a_number_half_typed_goes_with_its_arm(
    qtbot: QtBot, session_with: Callable[[str], Session], preferences: Preferences, shown: Callable[[QWidget], QWidget]
) -> None:
    session = session_with("ur5e")
    panel = shown(JointsPanel(session, preferences))
    panel.activateWindow()
    box = panel.findChild(QAbstractSpinBox, "joint_value_1")
    assert box is not None
    box.setFocus()
    qtbot.waitUntil(box.hasFocus)
    box.selectAll()
    QTest.keyClicks(box, "45")
    session.use_robot(load_robot("rv-m1"))
    np.testing.assert_array_equal(session.q, session.robot.home)
    assert session.undo_stack.count() == 1


def test_a_value_beyond_a_servo_is_not_said_to_be_reached_by_ignoring_limits(
    qtbot: QtBot, session_with: Callable[[str], Session], preferences: Preferences, shown: Callable[[QWidget], QWidget]
) -> None:
    session = session_with("al5b")
    panel = shown(JointsPanel(session, preferences))
    session.servo_limits = ServoLimits(session.robot)
    session.edit("Narrow", session.experiment.with_robot(session.servo_limits.narrow(session.robot)))
    box = panel.findChild(QAbstractSpinBox, "joint_value_2")
    assert box is not None
    box.setFocus()
    box.selectAll()
    said: list[str] = []
    session.said.connect(lambda text, _: said.append(text))
    QTest.keyClicks(box, "175")
    QTest.keyClick(box, Qt.Key.Key_Return)
    assert "the servo of the connected arm does not reach" in said[-1].replace("The", "the")
    assert "Ignore limits" not in said[-1]
