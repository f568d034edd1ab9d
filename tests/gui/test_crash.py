"""An exception that nobody caught becomes a plain sentence, details and a log entry; the window lives on."""

from __future__ import annotations

import logging
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtWidgets import QMessageBox
from pytestqt.qtbot import QtBot

from rvsim.errors import ExpressionError
from rvsim.gui.crash import CrashReporter, start_log


@pytest.fixture
def log(tmp_path: Path) -> Iterator[Path]:
    file = start_log(tmp_path / "log")
    assert file is not None
    yield file
    logger = logging.getLogger("rvsim")
    for handler in list(logger.handlers):
        handler.close()
        logger.removeHandler(handler)


def raised(error: Exception) -> Exception:
    try:
        raise error
    except Exception as caught:
        return caught


def report(reporter: CrashReporter, error: Exception) -> None:
    caught = raised(error)
    reporter.report(type(caught), caught, caught.__traceback__)


def shown(qtbot: QtBot, reporter: CrashReporter) -> QMessageBox:
    qtbot.waitUntil(lambda: reporter.dialog is not None)
    assert reporter.dialog is not None
    return reporter.dialog


def test_the_dialog_says_it_plainly_and_keeps_the_details(qtbot: QtBot, log: Path) -> None:
    reporter = CrashReporter(log)
    report(reporter, ZeroDivisionError("x"))
    box = shown(qtbot, reporter)
    assert "Traceback" not in box.text()
    assert "you can go on" in box.text()
    assert "ZeroDivisionError" in box.detailedText()
    assert "ZeroDivisionError" in log.read_text(encoding="utf-8")
    box.close()


def test_an_error_of_ours_speaks_for_itself(qtbot: QtBot, log: Path) -> None:
    reporter = CrashReporter(log)
    report(reporter, ExpressionError("abc", "it cannot be read"))
    box = shown(qtbot, reporter)
    assert "“abc” is no number" in box.text()
    box.close()


def test_a_flood_of_errors_is_one_dialog(qtbot: QtBot, log: Path) -> None:
    reporter = CrashReporter(log)
    for _ in range(20):
        report(reporter, ValueError("again"))
    box = shown(qtbot, reporter)
    qtbot.waitUntil(lambda: "20 times" in box.informativeText())
    box.close()


def test_an_error_in_a_thread_reaches_the_window(qtbot: QtBot, log: Path) -> None:
    reporter = CrashReporter(log)
    thread = threading.Thread(target=report, args=(reporter, RuntimeError("worker")))
    thread.start()
    thread.join()
    box = shown(qtbot, reporter)
    assert "RuntimeError" in box.detailedText()
    box.close()


def test_no_log_can_be_written(tmp_path: Path) -> None:
    blocked = tmp_path / "file"
    blocked.write_text("")
    assert start_log(blocked) is None
