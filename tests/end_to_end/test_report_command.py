"""`rvsim report`: a bundle without a window, and one sentence where it cannot be."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from PySide6.QtGui import QImage

from rvsim.cli import BAD_INPUT, DONE, main


def test_a_report_is_written_without_a_window(qapp, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder, picture = tmp_path / "made", tmp_path / "pages.png"
    arguments = ["report", "planar", "--deg", "20,30", "--name", "Layla", "--out", str(folder), "--png", str(picture)]
    assert main([*arguments, "--json"]) == DONE
    record = json.loads(capsys.readouterr().out)
    assert record["folder"] == str(folder)
    assert record["files"] == sorted(file.name for file in folder.iterdir())
    assert {"report.html", "report.pdf", "experiment.rvsim", "script.py"} == set(record["files"])
    pages = QImage(str(picture))
    assert pages.width() > 2 * pages.height()
    assert main(arguments) == BAD_INPUT
    assert "already" in capsys.readouterr().err


def test_an_unknown_path_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["report", "planar", "--path", "lime"]) == BAD_INPUT
    assert "Did you mean 'line'?" in capsys.readouterr().err
