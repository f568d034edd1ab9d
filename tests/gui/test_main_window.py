"""The window as a whole: every command does something, switches switch, units change what is shown, all is kept."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QAction, QGuiApplication, QImage, QStatusTipEvent, QWheelEvent
from PySide6.QtWidgets import QApplication, QDockWidget, QMessageBox, QScrollArea, QTabBar, QToolBar, QWidget
from pytestqt.qtbot import QtBot

from rvsim.files import load_robot, save_robot
from rvsim.gui.action_table import ACTIONS
from rvsim.gui.actions import shortcut_table
from rvsim.gui.app import build_window
from rvsim.gui.commands import SWITCHES
from rvsim.gui.device_control import DeviceControl
from rvsim.gui.main_window import MainWindow
from rvsim.gui.panels.inspect_page import InspectPage
from rvsim.gui.preferences import Preferences
from rvsim.gui.text_dialog import TextDialog

# These ask for a file or a name, or end the program: they are tested through what stands behind their dialogs.
ASKING = {"open", "save", "save_as", "open_robot", "save_robot", "save_picture", "save_csv", "save_pose", "quit"} | {
    "save_motion",
    "save_motion_si",
    "save_script",
    "import_table",
    "open_program",
    "save_program",
}


@pytest.fixture
def window(qtbot: QtBot) -> MainWindow:
    made = build_window(Preferences())
    made.preferences.set("animated", False)
    qtbot.addWidget(made)
    made.show()
    return made


def pixels(image: QImage) -> np.ndarray:
    rgba = image.convertToFormat(QImage.Format.Format_RGBA8888)
    return np.frombuffer(rgba.constBits(), np.uint8).reshape(rgba.height(), rgba.width(), 4)[..., :3].astype(int)


def test_every_command_can_be_triggered(window: MainWindow) -> None:
    for name in sorted({spec.name for spec in ACTIONS} - ASKING - set(SWITCHES)):
        window.tracker.track_line()
        window.motion.pause()
        window.actions_by_name[name].trigger()
        for box in window.findChildren(TextDialog):
            if box.isVisible():
                assert box.browser.toPlainText(), name
                assert box.height() <= window.height()
                box.close()


def test_every_switch_sets_its_preference(window: MainWindow) -> None:
    for name, switch in SWITCHES.items():
        action = window.actions_by_name[name]
        for _ in range(2):
            action.setChecked(not action.isChecked())
            if action.isChecked():
                assert window.preferences[switch.preference] == switch.on, name
            elif switch.off is not None:
                assert window.preferences[switch.preference] == switch.off, name


def test_every_command_has_keys_and_no_two_share_them(window: MainWindow) -> None:
    rows = shortcut_table(window)
    keys = [keys for _, _, keys in rows]
    assert sorted(set(keys)) == sorted(keys)
    assert {spec.text for spec in ACTIONS} | {"Undo", "Redo", "Path"} <= {text for _, text, _ in rows}


def test_units_change_what_is_shown_and_nothing_else(window: MainWindow) -> None:
    window.session.move_to(np.radians([30.0, 40.0, -50.0, 20.0, 60.0]), "Go")
    before = window.session.q.copy()
    box = window.joints.findChild(QWidget, "joint_value_1")
    window.preferences.set("angle_unit", "rad")
    assert box.text() == "0.524 rad"
    assert box.value() == pytest.approx(np.pi / 6)
    window.preferences.set("angle_unit", "deg")
    assert box.text() == "30.0°"
    np.testing.assert_array_equal(window.session.q, before)


def test_light_and_dark_look_so(window: MainWindow) -> None:
    brightness = {}
    for theme in ("light", "dark"):
        window.preferences.set("theme", theme)
        brightness[theme] = pixels(window.grab().toImage()).mean()
    assert brightness["light"] > 200
    assert brightness["dark"] < 70


@pytest.mark.parametrize("size", [(1024, 600), (1280, 720), (1366, 768), (3840, 2160)])
def test_it_fits_screens_small_and_large(qtbot: QtBot, window: MainWindow, size: tuple[int, int]) -> None:
    window.resize(*size)
    qtbot.waitUntil(lambda: window.width() == size[0])
    assert window.minimumSizeHint().width() <= 1024
    assert window.minimumSizeHint().height() <= 600
    assert window.scene_view.width() > 0.3 * size[0]


@pytest.mark.qt_log_ignore("does not support raise", extend=True)  # the off-screen platform
def test_panels_that_float_are_seen_like_those_that_do_not(qtbot: QtBot, window: MainWindow) -> None:
    with qtbot.waitExposed(window):
        window.show()
    for name in ("velocity", "calibrate"):
        window.docks.show_panel(name)
    for dock in ("inspect_dock", "device_dock"):
        window.findChild(QDockWidget, dock).setFloating(True)
    for name in ("inspect_velocity_page", "calibrate_page"):
        page = window.findChild(InspectPage, name)
        qtbot.waitUntil(lambda page=page: page.seen)


def test_the_layout_is_remembered(qtbot: QtBot, tmp_path: Path) -> None:
    file = tmp_path / "settings.ini"
    first = build_window(Preferences(file))
    qtbot.addWidget(first)
    first.show()
    first.findChild(QDockWidget, "model_dock").hide()
    first.close()
    second = build_window(Preferences(file))
    qtbot.addWidget(second)
    second.show()
    assert second.findChild(QDockWidget, "model_dock").isHidden()
    assert not second.findChild(QDockWidget, "path_dock").isHidden()


def test_a_robot_file_is_opened_and_a_bad_one_explained(window: MainWindow, tmp_path: Path) -> None:
    good, bad = tmp_path / "good.toml", tmp_path / "bad.toml"
    save_robot(load_robot("rv-m1").renamed("mine", "Mine"), good)
    window.commands.open_robot_file(good)
    assert window.session.robot.name == "mine"
    assert window.joints.robots.currentText() == "Mine"
    save_robot(load_robot("rv-m1").renamed("mine", "Mine, second edition"), good)
    window.commands.open_robot_file(good)
    assert window.joints.robots.currentText() == "Mine, second edition"
    bad.write_text(good.read_text(encoding="utf-8").replace("[[joint]]", "[[jiont]]"), encoding="utf-8")
    window.commands.open_robot_file(bad)
    box = window.findChild(QMessageBox)
    assert "bad.toml" in box.informativeText()
    assert "jiont" in box.informativeText()
    assert window.session.robot.name == "mine"
    box.close()


def test_saved_poses_are_recalled_and_forgotten(window: MainWindow) -> None:
    q = np.radians([30.0, 40.0, -50.0, 20.0, 60.0])
    window.session.move_to(q, "Go")
    window.joints.save_pose_as("ready")
    window.joints.go_home()
    window.joints.poses.setCurrentIndex(1)
    window.joints.poses.activated.emit(1)
    np.testing.assert_array_equal(window.session.q, q)
    window.joints.forget_pose.click()
    assert window.joints.poses.count() == 1


def test_copied_numbers_are_exact(window: MainWindow) -> None:
    window.session.move_to(np.radians([30.0, 40.0, -50.0, 20.0, 60.0]), "Go")
    window.actions_by_name["copy_pose_numpy"].trigger()
    found: dict[str, np.ndarray] = {}
    exec(QGuiApplication.clipboard().text(), {"np": np}, found)
    np.testing.assert_array_equal(found["q"], window.session.q)


def test_everything_can_be_reached_with_the_keyboard(window: MainWindow) -> None:
    reachable = Qt.FocusPolicy.TabFocus
    for name in ("robot_selector", "joint_value_1", "joint_slider_5", "plot_button", "track_line_button", "play_button",
                 "time_slider", "speed_selector", "trajectory_selector", "scene_view"):  # fmt: skip
        widget = window.findChild(QWidget, name)
        assert widget is not None, name
        assert widget.focusPolicy().value & reachable.value, name
        assert widget.accessibleName() or widget.text(), name


def test_undo_walks_back_through_everything(window: MainWindow) -> None:
    start = window.session.experiment
    window.joints.go_random()
    window.joints.ignore.toggle()
    window.joints.save_pose_as("somewhere")
    window.session.use_robot(window.library["ur5e"])
    window.joints.go_random()
    while window.session.undo_stack.canUndo():
        window.session.undo_stack.undo()
    assert window.session.experiment is start


def test_undo_works_while_the_value_that_was_typed_has_the_focus(qtbot: QtBot, window: MainWindow) -> None:
    window.activateWindow()
    box = window.findChild(QWidget, "joint_value_2")
    box.setFocus()
    box.selectAll()
    qtbot.keyClicks(box, "30")
    qtbot.keyClick(box, Qt.Key.Key_Return)
    assert np.degrees(window.session.q[1]) == pytest.approx(30.0)
    qtbot.keyClick(box, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert window.session.q[1] == 0.0
    assert window.message.text().startswith("Undone")


def test_a_sentence_goes_with_the_state_that_it_is_about(window: MainWindow) -> None:
    window.joints.go_home()
    assert "at home" in window.message.text()
    window.session.use_robot(window.library["ur5e"])
    assert window.message.text() == ""


def test_the_floor_is_in_metres_where_they_are_preferred(window: MainWindow) -> None:
    window.preferences.set("length_unit", "m")
    floor = next(item for item in window.scene_view.scene.items if item.key == "floor.numbers")
    assert {"x [m]", "y [m]"} <= {label.text for label in floor.labels}


def test_tab_walks_through_all_that_can_be_seen_and_comes_round(qtbot: QtBot, window: MainWindow) -> None:
    window.activateWindow()
    window.joints.robots.setFocus()
    visited: list[str] = []
    for _ in range(80):
        focused = QApplication.focusWidget()
        assert focused is not None
        assert window.rect().contains(focused.mapTo(window, focused.rect().center())), focused.objectName()
        visited.append(focused.objectName())
        qtbot.keyClick(focused, Qt.Key.Key_Tab)
    assert visited.count("robot_selector") >= 2
    assert {"joint_value_5", "track_line_button", "track_trajectory_button", "scene_view"} <= set(visited)


def test_each_panel_has_keys_that_bring_it_to_the_front(window: MainWindow) -> None:
    for dock in window.findChildren(QDockWidget):
        action = window.findChild(QAction, f"action_go_to_{dock.objectName()}")
        assert not action.shortcut().isEmpty()
        action.trigger()
        assert not dock.visibleRegion().isEmpty()
        focused = QApplication.focusWidget()
        assert focused is not None
        assert dock.isAncestorOf(focused)


def test_presentation_size_leaves_the_scene_its_share_and_takes_nothing_with_it(
    qtbot: QtBot, window: MainWindow
) -> None:
    arm = window.findChild(QDockWidget, "arm_dock")
    widths = arm.width(), window.scene_view.width()
    window.preferences.set("presentation", True)
    qtbot.waitUntil(lambda: arm.width() > widths[0])
    assert window.scene_view.width() >= 0.39 * window.width()
    window.preferences.set("presentation", False)
    qtbot.waitUntil(lambda: (arm.width(), window.scene_view.width()) == widths)


def test_on_a_small_screen_every_control_around_the_scene_can_be_reached(qtbot: QtBot, window: MainWindow) -> None:
    window.hide()
    window._laid_out = False  # as at the first start
    window.resize(1024, 600)
    window.show()
    bar = window.player_bar
    qtbot.waitUntil(lambda: bar.speed.geometry().right() <= bar.width())
    assert bar.loop.geometry().right() <= bar.width()
    tools = window.findChild(QToolBar, "toolbar")
    assert tools.widgetForAction(window.actions_by_name["dark"]).isVisible()
    assert window.emergency_stop.button.visibleRegion().boundingRect().size() == window.emergency_stop.button.size()
    tabs = next(bar for bar in window.findChildren(QTabBar) if bar.isVisible() and bar.count() > 1)
    assert all(
        tabs.tabRect(index).width() >= tabs.fontMetrics().horizontalAdvance(tabs.tabText(index))
        for index in range(tabs.count())
    )
    area = window.findChild(QDockWidget, "path_dock").findChild(QScrollArea)
    assert area.horizontalScrollBar().maximum() == 0


def test_what_a_command_does_takes_the_place_of_the_message_for_a_while(window: MainWindow) -> None:
    window.session.warn("Not moved.")
    QApplication.sendEvent(window, QStatusTipEvent("Look straight down"))
    assert window.message.text() == "Look straight down"
    assert not window.statusBar().currentMessage(), "nothing is written over the message"
    QApplication.sendEvent(window, QStatusTipEvent(""))
    assert (window.message.text(), window.message.property("level")) == ("Not moved.", "warning")


def test_saving_after_a_run_on_an_arm_says_that_the_run_is_kept_elsewhere(
    window: MainWindow, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    said: list[str] = []
    window.session.said.connect(lambda text, _level: said.append(text))
    for empty in (True, False):
        monkeypatch.setattr(DeviceControl, "recording", SimpleNamespace(empty=empty))
        assert window.document.save_to(tmp_path / "after.rvsim")
        assert ("The run on the arm is not in it" in said[-1]) is not empty


def test_the_wheel_over_the_tabs_brings_no_other_panel_to_the_front(window: MainWindow) -> None:
    window.docks.show_panel("path")
    bar = next(bar for bar in window.findChildren(QTabBar) if bar.parent() is window)
    at = QPointF(bar.rect().center())
    buttons, keys, phase = Qt.MouseButton.NoButton, Qt.KeyboardModifier.NoModifier, Qt.ScrollPhase.NoScrollPhase
    turned = QWheelEvent(at, bar.mapToGlobal(at), QPoint(), QPoint(0, -120), buttons, keys, phase, False)
    QApplication.sendEvent(bar, turned)
    assert window.docks.front_page == "path"
