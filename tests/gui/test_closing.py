"""The window is closed in the middle of its work: nothing raises, warns, stays on the screen, on the disk or at work.

A few of the works that `tests/soak/soak_closing.py` goes through.
"""

from __future__ import annotations

import importlib
import threading
from pathlib import Path

import pytest
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from rvsim.gui.app import build_window
from rvsim.gui.preferences import Preferences

SOAK = Path(__file__).parents[1] / "soak"


@pytest.mark.parametrize(
    "work",
    [
        *("action_lab_report", "action_save_animation", "action_help", "action_track_line", "action_all_experiments"),
        *("lab/lab_run_button", "workspace/sample_workspace_button", "compare/compare_run_button"),
        *("device/device_connect_button", "calibrate/calibrate_automatic", "program/program_run"),
    ],
)
def test_closing_in_the_middle_leaves_nothing(qapp: QApplication, monkeypatch: pytest.MonkeyPatch, work: str) -> None:
    monkeypatch.syspath_prepend(str(SOAK))
    closing, watching, around = (importlib.import_module(f"monkey_{part}") for part in ("closing", "watch", "world"))
    quits = qapp.quitOnLastWindowClosed()
    qapp.setQuitOnLastWindowClosed(False)
    with around.temporary_world(hard=False) as world, watching.Watch(slowness=False) as watch:
        closing.Closing(work, 0.05, world, watch, slowness=False).run()
    qapp.setQuitOnLastWindowClosed(quits)
    assert not watch.findings, "\n".join(watch.findings)


def test_a_window_that_another_one_follows_leaves_no_thread(qtbot: QtBot) -> None:
    """With the language the window changes: the old one ends, but nobody closes it."""
    before = set(threading.enumerate())
    window = build_window(Preferences(), robot="rv-m1")
    qtbot.addWidget(window)
    action = window.findChild(QAction, "action_all_experiments")
    assert action is not None
    action.trigger()
    assert set(threading.enumerate()) - before, "something is worked out"
    window.end()
    assert set(threading.enumerate()) - before == set()
