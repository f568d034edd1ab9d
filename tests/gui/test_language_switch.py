"""A switch of the language loses nothing."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot
from shiboken6 import isValid

from rvsim.files.session_file import session_bytes
from rvsim.gui.app import build_window
from rvsim.gui.document_state import state_of
from rvsim.gui.help.show import show_help
from rvsim.gui.help.window import HelpWindow
from rvsim.gui.language_switch import WindowKeeper
from rvsim.gui.languages import wear_language
from rvsim.gui.main_window import MainWindow
from rvsim.gui.notes_dialog import NotesDialog
from rvsim.gui.panels.device_calibrate import CalibratePage
from rvsim.gui.panels.joint_box import JointBox
from rvsim.gui.preferences import Preferences
from rvsim.gui.tour import Tour, begin_tour
from rvsim.language import language, tr


@pytest.fixture(autouse=True)
def _english_again(qapp: QApplication) -> Iterator[None]:
    yield
    wear_language(qapp, "en")


@pytest.fixture
def keeper(qtbot: QtBot) -> Iterator[WindowKeeper]:
    """A window that is shown, in English."""
    preferences = Preferences()
    preferences.set("animated", False)
    made = WindowKeeper(build_window(preferences))
    made.window.show()
    yield made
    made.window.document.asks = False
    made.window.close()
    made.window.deleteLater()


def switched(keeper: WindowKeeper, qtbot: QtBot, code: str) -> MainWindow:
    """The window that takes the place of the present one."""
    old = keeper.window
    keeper.window.preferences.set("language", code)
    qtbot.waitUntil(lambda: keeper.window is not old)
    return keeper.window


def test_a_switch_keeps_session_undo_file_motion_and_view(keeper: WindowKeeper, qtbot: QtBot, tmp_path: Path) -> None:
    window = keeper.window
    window.document.save_to(tmp_path / "mine.rvsim")
    window.session.move_to(window.session.q + 0.1, "Move")
    window.tracker.track_line()
    window.motion.pause()
    window.motion.seek(1.0)
    window.preferences.set("look", "stick")
    window.docks.show_panel("singular")
    before, q, steps = session_bytes(state_of(window)), window.session.q, window.session.undo_stack.count()
    width = window.docks.left.width()
    for code in ("ar", "de", "en"):
        window = switched(keeper, qtbot, code)
        assert language().code == code
        assert session_bytes(state_of(window)) == before
        assert (window.document.path, window.document.dirty) == (tmp_path / "mine.rvsim", True)
        assert (window.motion.player.time, window.docks.front_page) == (1.0, "singular")
        assert window.session.tracking is not None
    assert window.docks.left.width() <= width  # not that of German, which needs more
    assert not window.dragged_widths
    for _ in range(steps):
        window.actions_by_name["undo"].trigger()
    assert not window.document.dirty
    for _ in range(steps):
        window.actions_by_name["redo"].trigger()
    assert np.array_equal(window.session.q, q)


def test_a_value_that_is_being_typed_is_taken_before_the_switch(keeper: WindowKeeper, qtbot: QtBot) -> None:
    box = keeper.window.findChild(JointBox, "joint_value_1")
    box.selectAll()
    qtbot.keyClicks(box, "25")
    window = switched(keeper, qtbot, "de")
    assert np.degrees(window.session.q[0]) == pytest.approx(25.0)
    assert window.session.undo_stack.count() == 1


def test_what_was_tracked_stays_the_same_thing_and_its_motion_one_step(keeper: WindowKeeper, qtbot: QtBot) -> None:
    window = keeper.window
    window.tracker.track_line()
    window.motion.pause()
    tracking, trajectory = window.session.tracking, window.motion.player.trajectory
    window.motion.seek(0.5)
    steps = window.session.undo_stack.count()
    window = switched(keeper, qtbot, "de")
    assert window.session.tracking is tracking
    assert window.tracker.trajectory is window.motion.player.trajectory is trajectory
    window.motion.seek(1.0)
    assert window.session.undo_stack.count() == steps
    window.actions_by_name["undo"].trigger()
    assert window.motion.player.time == 0.0


def test_a_path_that_is_being_worked_out_is_worked_out_by_the_new_window(keeper: WindowKeeper, qtbot: QtBot) -> None:
    window = keeper.window
    experiment = window.session.experiment
    letter = replace(experiment.trajectory, name="letter-flat", orientation="free")
    window.session.edit("letter", replace(experiment, trajectory=letter))
    window.tracker.track_trajectory()
    assert window.tracker.busy
    window = switched(keeper, qtbot, "de")
    assert window.tracker.busy
    qtbot.waitUntil(lambda: window.session.tracking is not None)
    assert not window.motion.player.playing


def test_a_calibration_the_tour_notes_and_help_go_on(keeper: WindowKeeper, qtbot: QtBot) -> None:
    keeper.window.session.use_robot(keeper.window.library["al5b"])
    keeper.window.docks.show_panel("calibrate")
    page = keeper.window.findChild(CalibratePage)
    page.refresh()
    page._go_on_with(page._wizard.mark(page._wizard.step.expected_us))
    begin_tour(keeper.window).go(2)
    keeper.window.commands.show_notes()
    notes = keeper.window.findChild(NotesDialog)
    qtbot.keyClicks(notes.text, "seen")
    cursor = notes.text.textCursor()
    cursor.setPosition(2)
    notes.text.setTextCursor(cursor)
    show_help(keeper.window, "arm")
    show_help(keeper.window, "files").browser.verticalScrollBar().setValue(99)
    window = switched(keeper, qtbot, "ar")
    other = window.findChild(CalibratePage)
    other.refresh()
    assert other._wizard.marks == page._wizard.marks != ()
    beside = window.findChild(NotesDialog), window.findChild(HelpWindow)
    assert all(one.isVisible() and one.layoutDirection() == Qt.LayoutDirection.RightToLeft for one in beside)
    assert (beside[0].text.toPlainText(), beside[0].text.textCursor().position()) == ("seen", 2)
    assert (beside[1].place.page, beside[1].browser.verticalScrollBar().value() > 0) == ("files", True)
    beside[1].go_back()
    assert beside[1].place.page == "arm"
    assert window.findChild(Tour).step == 2


def test_a_connected_arm_stays_connected_and_does_not_move(keeper: WindowKeeper, qtbot: QtBot) -> None:
    window = keeper.window
    window.session.use_robot(window.library["al5b"])
    window.device.connect_to("al5b://")
    qtbot.waitUntil(lambda: window.device.state is not None and window.device.state.connected)
    driver = window.device.driver
    window.device._live = True  # to wake every joint before would take seconds
    sent = driver.state.commanded_q
    window = switched(keeper, qtbot, "de")
    assert not window.device.live
    assert window.message.text() == tr(
        "The arm no longer follows: switch “Follow the window” on again under Device › Drive."
    )
    assert window.device.driver is driver
    qtbot.waitUntil(lambda: window.device.state is not None and window.device.state.connected)
    assert np.array_equal(window.device.state.commanded_q, sent, equal_nan=True)
    assert window.session.servo_limits is not None
    window.device.disconnect_device()


def test_undo_steps_are_named_in_the_new_language(keeper: WindowKeeper, qtbot: QtBot) -> None:
    keeper.window.joints.go_zero()
    with keeper.window.session.one_step(tr("Show an example of the help")):
        keeper.window.joints.go_home()
    english = keeper.window.session.undo_stack.undoText()
    window = switched(keeper, qtbot, "de")
    german = window.session.undo_stack.undoText()
    assert german != english
    assert german.lower() in window.actions_by_name["undo"].text().lower()
    assert switched(keeper, qtbot, "en").session.undo_stack.undoText() == english


def test_the_old_window_goes(keeper: WindowKeeper, qtbot: QtBot) -> None:
    old = keeper.window
    qtbot.mouseClick(old, Qt.MouseButton.LeftButton, pos=old.docks.left.geometry().topRight() + QPoint(3, 300))
    new = switched(keeper, qtbot, "de")
    assert new.dragged_widths, "somebody has taken hold of what parts the docks"
    assert [one for one in QApplication.topLevelWidgets() if isinstance(one, MainWindow) and one.isVisible()] == [new]
    qtbot.waitUntil(lambda: not isValid(old))
