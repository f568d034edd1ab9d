"""The session as a file, in the window: open, save, undo, the question, safety copies, what a crash leaves."""

from __future__ import annotations

import errno
import os
import signal
import subprocess
import sys
import textwrap
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QMimeData, QPoint, QPointF, Qt, QUrl
from PySide6.QtGui import QDragEnterEvent, QDropEvent
from PySide6.QtWidgets import QApplication, QDialog, QFileDialog, QMenu, QMessageBox, QWidget
from pytestqt.qtbot import QtBot

from rvsim.cli.arguments import named_session
from rvsim.experiment import DeviceSettings, SessionState, TrajectoryTask
from rvsim.experiment.shapes import TextShape
from rvsim.files import load_robot, save_robot
from rvsim.files.session_file import load_session, session_bytes
from rvsim.gui.app import build_window
from rvsim.gui.autosave import autosave_seconds, leftovers
from rvsim.gui.document_state import state_of
from rvsim.gui.help.examples import follow
from rvsim.gui.main_window import MainWindow
from rvsim.gui.preferences import Preferences
from rvsim.gui.recovery_dialog import RecoveryDialog, offer_recovery
from rvsim.lab.repairs import Offer, track_lifted

Button = QMessageBox.StandardButton


@pytest.fixture(scope="module")
def shared(qapp: QApplication, tmp_path_factory: pytest.TempPathFactory) -> Iterator[MainWindow]:
    """One window for the tests that do not close it: to make one takes longer than they do."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("RVSIM_USER_FOLDER", str(tmp_path_factory.mktemp("user")))
        made = build_window(Preferences())
    made.preferences.set("animated", False)
    yield made
    made.close()
    made.deleteLater()


@pytest.fixture
def window(shared: MainWindow) -> MainWindow:
    """The shared one as it is after a start."""
    for dialog in shared.findChildren(QDialog):
        dialog.close()
    shared.preferences.set("live", True)
    shared.preferences.set("recent", "")
    shared.document.asks = False
    shared.session.use_robot(shared.library["rv-m1"])
    shared.document._port.show_settings(DeviceSettings())
    shared.document.new()
    return shared


@pytest.fixture
def own_window(qtbot: QtBot) -> MainWindow:
    made = build_window(Preferences())
    made.preferences.set("animated", False)
    qtbot.addWidget(made)
    return made


def question(window: MainWindow) -> QMessageBox:
    (box,) = [box for box in window.findChildren(QMessageBox, "unsaved_question") if box.isVisible()]
    return box


def set_up(window: MainWindow) -> None:
    """Something in every corner."""
    window.session.use_robot(window.library["ur5e"])
    window.session.move_to(np.radians([10.0, -80.0, 70.0, -100.0, -90.0, 20.0]), "Go")
    window.session.use_robot(window.library["rv-m1"])
    window.session.move_to(np.radians([30.0, 40.0, -50.0, 20.0, 60.0]), "Go")
    window.joints.save_pose_as("ready")
    window.commands.show_notes()
    notes = window.findChild(QWidget, "notes_dialog")
    notes.student.setText("Ada")
    notes.text.setPlainText("It moved.\nWe saw it.")
    window.document._port.address.setText("socket://10.0.0.1:4001")
    window.document._port.port.setCurrentIndex(window.document._port.port.count() - 1)
    window.docks.show_panel("dh")
    window.player_bar.loop.setChecked(True)
    window.scene_view.take_stance(window.scene_view.stance[0], framed=False)


def test_a_saved_session_opens_the_same_in_another_window_and_saves_to_the_same_bytes(
    window: MainWindow, own_window: MainWindow, tmp_path: Path
) -> None:
    set_up(window)
    file = tmp_path / "first.rvsim"
    assert window.document.save_to(file)
    other = own_window
    assert other.document.open(file)
    found, wanted = other.session.experiment, window.session.experiment
    np.testing.assert_array_equal(found.q, wanted.q)
    assert found.notes == wanted.notes
    assert found.poses[0].name == "ready"
    assert other.document._port.url == "socket://10.0.0.1:4001"
    assert other.player_bar.loop.isChecked()
    assert other.library["rv-m1"] is found.robot, "the built-in arm stays one"
    other.session.use_robot(other.library["ur5e"])
    assert np.degrees(other.session.q[1]) == pytest.approx(-80.0), "the other arm is as it was left"
    other.document.open(file)
    assert not other.session.undo_stack.canUndo()
    assert other.document.save_to(tmp_path / "second.rvsim")
    assert (tmp_path / "second.rvsim").read_bytes() == file.read_bytes()


def test_a_path_that_was_tracked_is_tracked_again_and_not_played(
    window: MainWindow, own_window: MainWindow, tmp_path: Path
) -> None:
    window.tracker.track_line()
    window.motion.pause()
    window.motion.seek(1.5)
    file, second = tmp_path / "first.rvsim", tmp_path / "second.rvsim"
    assert window.document.save_to(file)
    assert own_window.document.open(file)
    assert window.session.tracking is not None
    assert own_window.session.tracking is not None
    assert len(own_window.session.tracking.q) == len(window.session.tracking.q)
    assert not own_window.motion.player.playing
    assert own_window.motion.player.time == pytest.approx(1.5), "where the arm stands"
    assert not own_window.document.dirty
    assert own_window.document.save_to(second)
    assert second.read_bytes() == file.read_bytes()
    own_window.tracker.clear()
    assert own_window.document.save_to(second)
    assert '"tracked"' not in second.read_text()


@pytest.mark.parametrize("repaired", [False, True])
def test_an_opened_session_has_the_motion_that_was_saved_whatever_came_before_it(
    own_window: MainWindow, window: MainWindow, qtbot: QtBot, tmp_path: Path, repaired: bool
) -> None:
    session, tracker = window.session, window.tracker
    session.use_robot(window.library["al5b"])
    tracker.track_line()
    window.motion.seek(window.motion.player.duration)  # the letter is approached from where the line ends
    text = TrajectoryTask("text", "down", shape=TextShape(0.03, "RV"))
    session.edit("Text", replace(session.experiment, trajectory=text))
    tracker.track_trajectory()
    qtbot.waitUntil(lambda: not tracker.busy)
    if repaired:
        lifted = track_lifted(session.tracking, (40,))
        tracker.apply(Offer("split", "Lift", "", lifted, None, (40,)))
    window.motion.seek(window.motion.player.duration)
    file, second = tmp_path / "first.rvsim", tmp_path / "second.rvsim"
    assert window.document.save_to(file)
    assert own_window.document.open(file)
    qtbot.waitUntil(lambda: not own_window.tracker.busy)
    one, other = window.motion.player, own_window.motion.player
    assert one.duration == other.duration
    times = np.linspace(0.0, one.duration, 40)
    np.testing.assert_array_equal(one.trajectory.q(times), other.trajectory.q(times))
    assert own_window.document.save_to(second)
    assert second.read_bytes() == file.read_bytes()


def test_the_title_says_name_arm_and_whether_there_is_something_to_save(window: MainWindow, tmp_path: Path) -> None:
    assert window.windowTitle() == "Untitled – Mitsubishi RV-M1 – rvsim"
    window.joints._rows[2].moved.emit(2, -0.5)
    assert window.windowTitle() == "Untitled* – Mitsubishi RV-M1 – rvsim"
    window.document.save_to(tmp_path / "lab 3.rvsim")
    assert window.windowTitle() == "lab 3 – Mitsubishi RV-M1 – rvsim"
    window.joints._rows[2].moved.emit(2, -0.6)
    assert window.document.dirty, "an edit that goes on after saving is none of what was saved"
    window.session.undo_stack.undo()
    assert not window.document.dirty
    window.document._port.baud.setCurrentIndex(1)
    assert window.windowTitle().startswith("lab 3* ")
    window.document.new()
    assert window.windowTitle() == "Untitled – Mitsubishi RV-M1 – rvsim"
    np.testing.assert_array_equal(window.session.q, window.session.robot.home)


def test_before_work_is_lost_it_asks_and_does_as_it_is_told(own_window: MainWindow, tmp_path: Path) -> None:
    window = own_window
    window.document.asks = True
    window.document.new()
    assert window.findChild(QMessageBox) is None, "nothing to lose, nothing to ask"
    window.joints.go_random()
    q = window.session.q
    window.document.new()
    question(window).button(Button.Cancel).click()
    assert window.session.q is q
    window.document._file.path = tmp_path / "kept.rvsim"
    window.document.new()
    question(window).button(Button.Save).click()
    np.testing.assert_array_equal(load_session(tmp_path / "kept.rvsim").state.experiment.q, q)
    assert window.document.path is None
    window.joints.go_random()
    window.show()
    window.close()
    assert window.isVisible(), "closing asks too"
    question(window).button(Button.Discard).click()
    assert not window.isVisible()


def test_a_full_disk_and_a_folder_that_cannot_be_written_lose_nothing(
    window: MainWindow, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "work.rvsim"
    window.document.save_to(file)
    before = file.read_bytes()
    window.joints.go_random()

    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "replace", full)
    assert not window.document.save()
    box = window.findChild(QMessageBox, "file_problem")
    assert "no space left on device" in box.informativeText()
    assert window.document.dirty
    assert file.read_bytes() == before
    window.document.autosave.tick()
    assert "No safety copy" in window.message.text()
    monkeypatch.undo()
    assert not window.document.save_to(tmp_path / "missing" / "work.rvsim")
    assert window.document.save()


def test_a_file_of_a_newer_rvsim_is_not_replaced(
    window: MainWindow, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "new.rvsim"
    file.write_bytes(session_bytes(state_of(window)).replace(b'"version": 1', b'"version": 9'))
    before = file.read_bytes()
    assert window.document.open(file)
    assert "newer rvsim" in window.message.text()
    (tmp_path / "new 2.rvsim").touch()
    proposed: list[str] = []
    monkeypatch.setattr(QFileDialog, "selectFile", lambda _, name: proposed.append(name))
    monkeypatch.setattr(QFileDialog, "exec", lambda _: True)
    monkeypatch.setattr(QFileDialog, "selectedFiles", lambda _: [str(file)])
    assert not window.document.save()
    assert proposed == ["new 3.rvsim"]
    assert file.read_bytes() == before


def test_a_broken_file_is_explained_and_the_present_session_stays(window: MainWindow, tmp_path: Path) -> None:
    file = tmp_path / "broken.rvsim"
    file.write_bytes(session_bytes(state_of(window)).replace(b'"law"', b'"lav"'))
    before = window.session.experiment
    assert not window.document.open(file)
    assert "experiment, 'lav'" in window.findChild(QMessageBox).informativeText()
    assert window.session.experiment is before


def test_an_arm_that_bears_a_built_in_name_becomes_a_copy(window: MainWindow, tmp_path: Path) -> None:
    odd = window.session.experiment.with_robot(window.session.robot.with_joint(1, a=0.3))
    (tmp_path / "odd.rvsim").write_bytes(session_bytes(SessionState(odd)))
    window.document.open(tmp_path / "odd.rvsim")
    assert window.session.robot.name == "my-rv-m1"
    assert window.session.robot.joints[1].a == pytest.approx(0.3, abs=1e-12)
    assert window.library["rv-m1"].joints[1].a == load_robot("rv-m1").joints[1].a


@pytest.mark.parametrize("link", ["rvsim:show/singular?robot=ur5e", "rvsim:source/000-P7"])
def test_an_example_is_a_session_without_a_name_that_undo_gives_the_name_back(
    own_window: MainWindow, tmp_path: Path, link: str
) -> None:
    document, stack = own_window.document, own_window.session.undo_stack
    assert document.save_to(tmp_path / "mine.rvsim")
    before, index = (tmp_path / "mine.rvsim").read_bytes(), stack.index()
    follow(own_window, link)
    own_window.motion.pause()
    assert (document.path, document.dirty) == (None, True)
    assert own_window.windowTitle().startswith("Untitled*")
    stack.setIndex(index)
    assert (document.path, document.dirty) == (tmp_path / "mine.rvsim", False)
    assert own_window.windowTitle().startswith("mine ")
    stack.setIndex(stack.count())
    assert document.save_to(tmp_path / "example.rvsim")
    stack.setIndex(index)
    assert (document.path, document.dirty) == (tmp_path / "mine.rvsim", True)
    stack.setIndex(stack.count())
    assert (document.path, document.dirty) == (tmp_path / "example.rvsim", False)
    assert (tmp_path / "mine.rvsim").read_bytes() == before


def test_recent_files_are_eight_and_those_that_are_gone_are_grey(window: MainWindow, tmp_path: Path) -> None:
    for number in range(10):
        window.document.save_to(tmp_path / f"file {number}.rvsim")
    (tmp_path / "file 8.rvsim").unlink()
    menu = window.findChild(QMenu, "recent_menu")
    menu.aboutToShow.emit()
    assert [action.isEnabled() for action in menu.actions()] == [True, False] + [True] * 6
    menu.actions()[2].trigger()
    assert window.document.name == "file 7"


def test_a_dropped_file_is_opened_by_its_kind(window: MainWindow, tmp_path: Path) -> None:
    window.document.save_to(tmp_path / "dropped.rvsim")
    window.document.new()
    save_robot(load_robot("ur5e").renamed("dropped", "Dropped"), tmp_path / "arm.toml")

    def drop(file: Path) -> bool:
        data = QMimeData()
        data.setUrls([QUrl.fromLocalFile(str(file))])
        left, none = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
        QApplication.sendEvent(window, QDragEnterEvent(QPoint(9, 9), Qt.DropAction.CopyAction, data, left, none))
        event = QDropEvent(QPointF(9, 9), Qt.DropAction.CopyAction, data, left, none)
        event.ignore()
        QApplication.sendEvent(window, event)
        return event.isAccepted()

    assert drop(tmp_path / "dropped.rvsim")
    assert window.document.name == "dropped"
    assert drop(tmp_path / "arm.toml")
    assert window.session.robot.title == "Dropped"
    assert not drop(tmp_path / "picture.png")


def test_a_session_may_be_named_on_the_command_line_without_a_word() -> None:
    assert named_session(["a.rvsim"]) == ["--open=a.rvsim"]
    assert named_session(["--theme", "dark", "A.RVSIM", "--size", "9x9"])[2] == "--open=A.RVSIM"
    assert named_session(["fk", "a.rvsim"]) == ["fk", "a.rvsim"]


# --- undo ------------------------------------------------------------------------------------------------------------


def test_undo_says_what_it_undoes(window: MainWindow) -> None:
    undo = window.actions_by_name["undo"]
    assert undo.text() == "Undo"
    window.joints._rows[2].moved.emit(2, -0.5)
    assert undo.text() == "Undo: move joint 3 (elbow)"
    window.joints.save_pose_as("a&b")
    assert undo.text() == "Undo: save pose a&&b"
    undo.trigger()
    assert window.actions_by_name["redo"].text() == "Redo: save pose a&&b"


def test_what_is_typed_but_not_drawn_and_notes_are_undone_too(window: MainWindow) -> None:
    window.preferences.set("live", False)
    start = window.session.experiment
    window.joints._rows[2].moved.emit(2, -0.5)
    assert window.actions_by_name["undo"].text() == "Undo: type joint 3 (elbow)"
    assert window.joints._rows[2].box.quantity == pytest.approx(-0.5)
    assert window.session.q is start.q
    window.joints.go_home()
    assert window.session.experiment.typed is None, "what was typed goes when the arm goes elsewhere"
    window.session.undo_stack.undo()
    assert window.joints._rows[2].box.quantity == pytest.approx(-0.5)
    window.session.undo_stack.undo()
    assert window.joints._rows[2].box.quantity == pytest.approx(float(start.q[2]))
    window.commands.show_notes()
    notes = window.findChild(QWidget, "notes_dialog")
    notes.text.setPlainText("one")
    notes.text.setPlainText("two")
    assert window.actions_by_name["undo"].text() == "Undo: write notes"
    window.session.undo_stack.undo()
    assert (notes.text.toPlainText(), window.session.experiment) == ("", start)


# --- safety copies ---------------------------------------------------------------------------------------------------


def test_a_safety_copy_is_made_of_what_is_unsaved_and_goes_when_it_is_saved(
    own_window: MainWindow, tmp_path: Path
) -> None:
    window = own_window
    autosave = window.document.autosave
    autosave.tick()
    assert autosave.file is None, "nothing to lose, no copy"
    window.joints.go_random()
    autosave.tick()
    copy = load_session(autosave.file).state.experiment
    np.testing.assert_array_equal(copy.q, window.session.q)
    assert str(os.getpid()) in autosave.file.name
    assert leftovers() == (), "the copy of an open window is nobody else's"
    window.document.save_to(tmp_path / "saved.rvsim")
    assert not autosave.file.exists()
    assert 0.0 < autosave_seconds() <= 10.0


CRASHING = """
    import sys
    import numpy as np
    from PySide6.QtCore import QTimer
    from rvsim.gui.app import build_window, make_application
    from rvsim.gui.preferences import Preferences

    app = make_application(["rvsim"])
    window = build_window(Preferences())
    window.document._file.path = __import__("pathlib").Path(sys.argv[1])
    window.document.begin()
    window.session.edit("Work", window.session.experiment.with_pose("afternoon's work"))
    app.exec()
"""


def test_after_kill_9_the_work_is_offered_again_once_and_recovered(
    qtbot: QtBot, own_window: MainWindow, tmp_path: Path
) -> None:
    window = own_window
    copies = tmp_path / "rvsim-user" / "autosave"
    environment = {**os.environ, "RVSIM_AUTOSAVE_SECONDS": "0.05", "QT_QPA_PLATFORM": "offscreen"}
    command = [sys.executable, "-c", textwrap.dedent(CRASHING), str(tmp_path / "lab.rvsim")]
    with subprocess.Popen(command, env=environment) as process:
        qtbot.waitUntil(lambda: any(copies.glob(f"{process.pid}-*.rvsim")), timeout=60_000)
        assert leftovers() == (), "it lives still"
        process.send_signal(signal.SIGKILL)
    offer_recovery(window.document, window)
    dialog = window.findChild(RecoveryDialog)
    assert dialog.list.item(0).text().startswith("lab\nMitsubishi RV-M1, ")
    assert leftovers() == (), "another window that starts now is not offered the same"
    dialog.recover_button.click()
    assert window.session.experiment.poses[0].name == "afternoon's work"
    assert window.windowTitle().startswith("lab* ")
    assert [file.name for file in copies.glob("*.rvsim")] == [window.document.autosave.file.name]
    window.document.save()
    assert not list(copies.glob("*.rvsim"))


def test_a_copy_that_nobody_wants_now_is_offered_at_the_next_start_or_deleted(
    window: MainWindow, tmp_path: Path
) -> None:
    copies = tmp_path / "rvsim-user" / "autosave"
    copies.mkdir(parents=True)
    (copies / "1-old.rvsim").write_bytes(session_bytes(state_of(window)))
    (copies / "2-torn.rvsim").write_bytes(b"{")
    for expected in (2, 2):
        offer_recovery(window.document, window)
        dialog = window.findChild(RecoveryDialog)
        assert dialog.list.count() == expected
        dialog.close()
        QApplication.sendPostedEvents(dialog, QEvent.Type.DeferredDelete)
    offer_recovery(window.document, window)
    dialog = window.findChild(RecoveryDialog)
    dialog.delete_button.click()
    dialog.delete_button.click()
    assert not list(copies.glob("*"))
