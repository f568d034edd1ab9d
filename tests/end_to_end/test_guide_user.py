"""Source 000's user at the window: types five angles, Plot, Home, a line, Track line, Track trajectory.

Everything goes through the object names that stand in the README; nothing reaches into the program.
"""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QAbstractButton, QComboBox, QDoubleSpinBox, QLabel, QSlider, QWidget
from pytestqt.qtbot import QtBot

from rvsim.gui.app import build_window
from rvsim.gui.main_window import MainWindow
from rvsim.gui.preferences import Preferences


@pytest.fixture
def window(qtbot: QtBot) -> MainWindow:
    made = build_window(Preferences())
    qtbot.addWidget(made)
    made.show()
    return made


def find(window: QWidget, kind: type, name: str) -> QWidget:
    widget = window.findChild(kind, name)
    assert widget is not None, f"no {kind.__name__} named {name}"
    return widget


def type_into(qtbot: QtBot, window: QWidget, name: str, text: str) -> None:
    box = find(window, QDoubleSpinBox, name)
    box.setFocus()
    box.selectAll()
    qtbot.keyClicks(box, text)
    qtbot.keyClick(box, Qt.Key.Key_Return)


def press(qtbot: QtBot, window: QWidget, name: str) -> None:
    qtbot.mouseClick(find(window, QAbstractButton, name), Qt.MouseButton.LeftButton)


def values(window: QWidget) -> list[float]:
    return [find(window, QDoubleSpinBox, f"joint_value_{i}").value() for i in range(1, 6)]


def tool(window: QWidget) -> list[float]:
    return [find(window, QDoubleSpinBox, f"tool_{axis}").value() for axis in "xyz"]


def message(window: QWidget) -> str:
    return find(window, QLabel, "status_message").text()


def test_five_angles_are_typed_and_plotted(qtbot: QtBot, window: MainWindow) -> None:
    for index, text in enumerate(["30", "2*20", "-50", "20", "60,0"], 1):
        type_into(qtbot, window, f"joint_value_{index}", text)
    press(qtbot, window, "plot_button")
    assert values(window) == pytest.approx([30.0, 40.0, -50.0, 20.0, 60.0])
    np.testing.assert_allclose(tool(window), [363.7, 210.0, 297.4], atol=0.05)
    press(qtbot, window, "home_button")
    assert values(window) == [0.0] * 5
    np.testing.assert_allclose(tool(window), [482.0, 0.0, 152.0], atol=1e-9)


def test_what_is_not_live_waits_for_plot(qtbot: QtBot, window: MainWindow) -> None:
    window.preferences.set("live", False)
    type_into(qtbot, window, "joint_value_1", "90")
    assert window.session.q[0] == 0.0
    press(qtbot, window, "plot_button")
    assert window.session.q[0] == pytest.approx(np.pi / 2)
    type_into(qtbot, window, "joint_value_1", "45")
    press(qtbot, window, "live_switch")
    assert window.session.q[0] == pytest.approx(np.pi / 4), "live again, the arm is where the boxes say"


def test_a_value_outside_the_limits_is_refused_until_they_are_ignored(qtbot: QtBot, window: MainWindow) -> None:
    type_into(qtbot, window, "joint_value_3", "90")
    assert values(window)[2] == 0.0
    assert "outside" in message(window)
    press(qtbot, window, "ignore_limits_switch")
    type_into(qtbot, window, "joint_value_3", "90")
    assert values(window)[2] == pytest.approx(90.0)
    press(qtbot, window, "ignore_limits_switch")
    assert values(window)[2] == pytest.approx(90.0), "a pose outside the limits stays and is marked, never clamped"
    assert find(window, QDoubleSpinBox, "joint_value_3").property("outside") is True


def test_a_value_far_beyond_the_slider_is_taken_where_limits_are_ignored(qtbot: QtBot, window: MainWindow) -> None:
    press(qtbot, window, "ignore_limits_switch")
    type_into(qtbot, window, "joint_value_1", "-1e9")
    assert values(window)[0] == pytest.approx(-1e9)
    slider = find(window, QSlider, "joint_slider_1")
    assert slider.value() == slider.minimum()


def test_sliders_move_joints_and_undo_takes_them_back(window: MainWindow) -> None:
    slider = find(window, QSlider, "joint_slider_1")
    for position in (100, 300, 450):
        slider.setValue(position)
    assert values(window)[0] == pytest.approx(45.0)
    while window.session.undo_stack.canUndo():
        window.session.undo_stack.undo()
    assert values(window)[0] == 0.0


def run_to_the_end(window: MainWindow) -> None:
    while window.motion.player.playing:
        window.motion.advance(0.1)


def test_the_default_line_is_tracked_whole(qtbot: QtBot, window: MainWindow) -> None:
    press(qtbot, window, "track_line_button")
    tracking = window.session.tracking
    assert tracking is not None
    assert tracking.complete
    run_to_the_end(window)
    end = [find(window, QDoubleSpinBox, f"line_end_{axis}").value() for axis in "xyz"]
    np.testing.assert_allclose(tool(window), end, atol=1e-6)
    assert "mm" in find(window, QLabel, "rms_label").text()


def test_the_sources_line_says_which_points_and_why(qtbot: QtBot, window: MainWindow) -> None:
    for end, point in (("start", (110, 0, 130)), ("end", (230, 0, 333))):
        for axis, value in zip("xyz", point, strict=True):
            type_into(qtbot, window, f"line_{end}_{axis}", str(value))
    type_into(qtbot, window, "line_resolution", "0.1")
    press(qtbot, window, "track_line_button")
    tracking = window.session.tracking
    assert tracking is not None
    assert tracking.reached_count == 4
    sentence = find(window, QLabel, "tracking_sentence").text()
    for word in ("4 of 11", "elbow", "−156.7°", "−110°", "wrist pitch"):
        assert word in sentence, sentence
    qtbot.waitUntil(lambda: window.findChild(QAbstractButton, "repair_ignore_limits") is not None)
    press(qtbot, window, "repair_ignore_limits")
    assert window.session.tracking.complete


@pytest.mark.parametrize(("name", "reached"), [("letter-board", 50), ("letter-flat", 50), ("letter-raw", 0)])
def test_the_letter_is_tracked_in_each_placement(qtbot: QtBot, window: MainWindow, name: str, reached: int) -> None:
    selector = find(window, QComboBox, "trajectory_selector")
    selector.setCurrentIndex(selector.findData(name))
    selector.activated.emit(selector.currentIndex())
    press(qtbot, window, "track_trajectory_button")
    assert window.session.tracking.reached_count == reached
    run_to_the_end(window)


def test_every_arm_can_be_taken_and_posed(window: MainWindow) -> None:
    selector = find(window, QComboBox, "robot_selector")
    for index in range(selector.count()):
        selector.setCurrentIndex(index)
        selector.activated.emit(index)
        robot = window.session.robot
        assert robot.name == selector.itemData(index)
        window.joints.go_random()
        for joint in range(robot.dof):
            box = find(window, QDoubleSpinBox, f"joint_value_{joint + 1}")
            assert box.quantity == pytest.approx(float(window.session.q[joint]))


POSE_TEXT = "30, 40, -50, 20, 60"


def test_a_whole_pose_is_pasted_into_any_joint(qtbot: QtBot, window: MainWindow) -> None:
    box = find(window, QDoubleSpinBox, "joint_value_4")
    QGuiApplication.clipboard().setText(POSE_TEXT)
    box.setFocus()
    qtbot.keyClick(box, Qt.Key.Key_V, Qt.KeyboardModifier.ControlModifier)
    assert values(window) == pytest.approx([30.0, 40.0, -50.0, 20.0, 60.0])
    window.session.undo_stack.undo()
    assert values(window) == [0.0] * 5, "all joints are one step"
    type_into(qtbot, window, "joint_value_1", POSE_TEXT)
    assert values(window) == pytest.approx([30.0, 40.0, -50.0, 20.0, 60.0])
    type_into(qtbot, window, "joint_value_1", "1, 2, 3")
    assert values(window) == pytest.approx([30.0, 40.0, -50.0, 20.0, 60.0])
    assert "5 values" in message(window)
    type_into(qtbot, window, "joint_value_1", "12,5")
    assert values(window)[0] == pytest.approx(12.5)
    assert box.lineEdit().text() == "20.0°"


def test_enter_keeps_the_box_and_selects_its_number(qtbot: QtBot, window: MainWindow) -> None:
    type_into(qtbot, window, "joint_value_2", "40")
    box = find(window, QDoubleSpinBox, "joint_value_2")
    assert window.focusWidget() is box
    assert box.lineEdit().selectedText() == "40.0"


def test_a_sliders_ends_say_how_far_it_goes(qtbot: QtBot, window: MainWindow) -> None:
    row = find(window, QSlider, "joint_slider_3").parentWidget()
    assert {"−110", "0"} <= {label.text() for label in row.findChildren(QLabel)}
    press(qtbot, window, "ignore_limits_switch")
    assert {"−180", "180"} <= {label.text() for label in row.findChildren(QLabel)}
