"""File › Lab report: from the menu to the folder, and what is said when it cannot be."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtWidgets import QCheckBox, QLabel, QLineEdit, QPushButton, QWidget
from pytestqt.qtbot import QtBot

from rvsim import load_robot
from rvsim.experiment import SessionState
from rvsim.files.session_file import session_of
from rvsim.gui.app import build_window
from rvsim.gui.preferences import Preferences
from rvsim.gui.report.dialog import ReportDialog
from rvsim.gui.session import Session
from rvsim.lab import default_experiment
from rvsim.lab.report import Study


@pytest.fixture
def dialog(qtbot: QtBot, tmp_path: Path) -> Iterator[ReportDialog]:
    experiment = default_experiment(load_robot("planar"))
    session, parent = Session(experiment, default_experiment), QWidget()
    qtbot.addWidget(parent)
    made = ReportDialog(parent, session, Preferences(), Study(experiment), SessionState(experiment))
    yield prepared(made, tmp_path)
    parent.close()


def prepared(dialog: ReportDialog, folder: Path) -> ReportDialog:
    """A short report, into that folder."""
    for name in ("robot", "pose", "inverse", "steps", "torques"):
        dialog.findChild(QCheckBox, f"report_part_{name}").setChecked(False)
    dialog.findChild(QLineEdit, "report_folder").setText(str(folder / "made"))
    dialog.findChild(QLineEdit, "report_name").setText("  Layla Haddad ")
    return dialog


def status(dialog: ReportDialog) -> str:
    return dialog.findChild(QLabel, "report_status").text()


def test_one_action_makes_the_bundle(qtbot: QtBot, tmp_path: Path) -> None:
    window = build_window(Preferences(), robot="planar")
    qtbot.addWidget(window)
    window.actions_by_name["lab_report"].trigger()
    dialog = prepared(window.findChild(ReportDialog), tmp_path)
    dialog.notes_box.setPlainText("Two links.")
    dialog.findChild(QPushButton, "report_start").click()
    qtbot.waitUntil(lambda: status(dialog).startswith("Made"), timeout=30_000)
    assert (tmp_path / "made" / "report.pdf").is_file()
    kept = session_of((tmp_path / "made" / "experiment.rvsim").read_bytes(), "file").state.experiment.notes
    assert (kept.student, kept.text) == ("Layla Haddad", "Two links.")
    assert window.preferences["student"] == "Layla Haddad"
    assert dialog.folder_box.text().endswith("made-2")  # the next one is another


def test_a_part_that_is_not_there_says_why(dialog: ReportDialog) -> None:
    box = dialog.findChild(QCheckBox, "report_part_measured")
    assert not box.isEnabled()
    assert "run on an arm" in box.toolTip()


def test_a_folder_that_cannot_be_is_told(dialog: ReportDialog, qtbot: QtBot, tmp_path: Path) -> None:
    dialog.folder_box.setText(str(tmp_path / "missing" / "made"))
    dialog.start()
    qtbot.waitUntil(lambda: bool(status(dialog)))
    assert "no folder" in status(dialog)
    assert dialog.start_button.isEnabled()


def test_closing_in_the_middle_leaves_nothing(dialog: ReportDialog, qtbot: QtBot, tmp_path: Path) -> None:
    dialog.start()
    with qtbot.waitSignal(dialog.progress.valueChanged):
        pass
    assert any(path.name.startswith(".made") for path in tmp_path.iterdir())
    dialog.close()
    assert not any("made" in path.name for path in tmp_path.iterdir())
