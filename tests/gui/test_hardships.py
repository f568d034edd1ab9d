"""What a computer may do to the program: a full disk, a home that cannot be written, a wrong clock, a second window."""

from __future__ import annotations

import ast
import os
import subprocess
import sys
import textwrap
from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QFileDialog, QMessageBox
from pytestqt.qtbot import QtBot

import rvsim
from rvsim.experiment import SessionState
from rvsim.files import save_robot, user_robot_path
from rvsim.files.session_file import session_bytes
from rvsim.gui.app import build_window
from rvsim.gui.autosave import autosave_folder, leftovers
from rvsim.gui.crash import start_log
from rvsim.gui.main_window import MainWindow
from rvsim.gui.preferences import Preferences
from rvsim.gui.recovery_dialog import RecoveryDialog, offer_recovery

SAVING = ("save_csv", "save_motion", "save_motion_si", "save_picture", "save_program", "save_robot", "save_script")


@pytest.fixture
def window(qtbot: QtBot) -> MainWindow:
    made = build_window()
    made.preferences.set("animated", False)
    qtbot.addWidget(made)
    return made


# --- a full disk -----------------------------------------------------------------------------------------------------


@pytest.fixture
def full_disk() -> Iterator[None]:
    """No file can grow beyond some bytes."""
    resource = pytest.importorskip("resource")
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (20, before[1]))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, before)


def test_whatever_is_saved_on_a_full_disk_is_said_and_what_was_there_stays(
    window: MainWindow, qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
) -> None:
    window.tracker.track_line()
    qtbot.waitUntil(lambda: not window.tracker.busy)
    window.motion.pause()
    folder = tmp_path / "out"
    folder.mkdir()
    endings = {"save_picture": "png", "save_program": "toml", "save_robot": "toml", "save_script": "py"}
    files = {name: folder / f"{name}.{endings.get(name, 'csv')}" for name in SAVING}
    for file in files.values():
        file.write_bytes(b"before")
    request.getfixturevalue("full_disk")
    for name, file in files.items():
        monkeypatch.setattr(QFileDialog, "getSaveFileName", staticmethod(lambda *_, chosen=file: (str(chosen), "")))
        action = window.findChild(QAction, f"action_{name}")
        assert action is not None
        assert action.isEnabled()
        action.trigger()
        assert window.message.property("level") == "error", f"{name} said {window.message.text()!r}"
        assert file.read_bytes() == b"before"
        for box in window.findChildren(QMessageBox):
            box.close()
    assert sorted(folder.iterdir()) == sorted(files.values()), "nothing half made is left"


# --- a home that cannot be written -----------------------------------------------------------------------------------


def test_a_home_that_cannot_be_written_stops_nothing_and_is_said(
    qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "home").write_text("a file, where a folder is asked for", encoding="utf-8")
    monkeypatch.setenv("RVSIM_USER_FOLDER", str(tmp_path / "home" / "rvsim"))
    window = build_window()
    qtbot.addWidget(window)
    assert "cannot be written" in window.message.text()
    window.preferences.set("theme", "dark")
    window.document.begin()
    window.joints.go_random()
    window.document.autosave.tick()
    assert window.document.autosave.is_made, "in a temporary folder"
    save_robot(window.session.robot, user_robot_path("mine"))
    assert start_log(tmp_path / "home" / "log") is None
    window.document.autosave.close()


# --- a clock that is wrong -------------------------------------------------------------------------------------------


def test_copies_of_any_date_are_offered(window: MainWindow) -> None:
    folder = autosave_folder()
    folder.mkdir(parents=True)
    for number, seconds in enumerate((-1e9, 0.0, 1e9, 4e9)):
        file = folder / f"{number}-crashed.rvsim"
        file.write_bytes(session_bytes(SessionState(window.session.experiment)))
        os.utime(file, (seconds, seconds))
    left = leftovers()
    assert [one.file.name[0] for one in left] == ["3", "2", "1", "0"], "the newest first, whatever the clock says now"
    far = tuple(one._replace(when=1e15) for one in left[:1])
    dialog = RecoveryDialog(window.document, far, window)
    assert "unknown time" in dialog.list.item(0).text()
    dialog.close()
    for one in left:
        one.release()
    offer_recovery(window.document, window)
    offered = [dialog for dialog in window.findChildren(RecoveryDialog) if dialog.isVisible()]
    assert [dialog.list.count() for dialog in offered] == [4]
    offered[0].close()


def test_no_duration_is_taken_from_the_time_of_day() -> None:
    """That clock jumps: by hand, in spring, and when the computer finds a better one."""
    jumping = {("time", "time"), ("time", "time_ns"), ("datetime", "now"), ("QTime", "currentTime")}
    found = {}
    for file in Path(rvsim.__path__[0]).rglob("*.py"):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            owner = node.value if isinstance(node, ast.Attribute) else None
            if isinstance(node, ast.Attribute) and isinstance(owner, ast.Name) and (owner.id, node.attr) in jumping:
                found[file.name] = owner.id
    # The self-test tells when the first picture was there, to those who measure it from outside.
    assert found == {"screen.py": "time"}


# --- a second program ------------------------------------------------------------------------------------------------

SECOND = """
    from rvsim.gui.app import build_window, make_application

    app = make_application(["rvsim"])
    window = build_window()
    window.preferences.set("theme", "dark")
    window.document.begin()
    window.joints.go_random()
    window.document.autosave.tick()
    assert window.document.autosave.is_made
    print(window.document.autosave.file.name, flush=True)
    input()
    window.document.asks = False
    window.close()
"""


def test_two_programs_at_once_leave_each_other_s_copies_and_settings(window: MainWindow) -> None:
    window.document.begin()
    window.joints.go_random()
    window.document.autosave.tick()
    own = window.document.autosave.file
    assert own is not None
    window.preferences.set("student", "Ada")
    command = [sys.executable, "-c", textwrap.dedent(SECOND)]
    with subprocess.Popen(
        command,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, "QT_QPA_PLATFORM": "offscreen"},
    ) as other:
        assert other.stdout is not None
        theirs = own.parent / other.stdout.readline().strip()
        assert theirs.exists()
        assert leftovers() == (), "both live"
        window.preferences.set("length_unit", "m")
        other.communicate("\n")
        assert other.returncode == 0
    assert own.exists()
    assert not theirs.exists(), "it was closed as it should be"
    assert window.preferences._store is not None
    window.preferences._store.sync()
    again = Preferences(Path(os.environ["RVSIM_USER_FOLDER"]) / "settings.ini")
    assert (again["student"], again["length_unit"], again["theme"]) == ("Ada", "m", "dark")
    window.document.asks = False
