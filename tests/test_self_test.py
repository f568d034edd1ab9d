"""The self-test: it passes where all is well, and says what is broken where something is."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from rvsim.resources import resource_folder
from rvsim.self_test import outcomes_on, screens
from rvsim.self_test.arithmetic import CHECKS
from rvsim.self_test.outcome import SkippedError, expect, outcome_of

ROOT = Path(__file__).resolve().parent.parent
WITHOUT_SCREEN = ("DISPLAY", "WAYLAND_DISPLAY")


def test_this_checkout_passes_off_screen() -> None:
    environment = {name: value for name, value in os.environ.items() if name not in WITHOUT_SCREEN}
    command = [sys.executable, "-m", "rvsim", "self-test", "--json"]
    ended = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
    record: dict[str, Any] = json.loads(ended.stdout)
    assert [row for row in record["checks"] if row["verdict"] == "FAILED"] == []
    assert (ended.returncode, record["passed"], ended.stderr) == (0, True, "")
    assert {"virtual arm", "window, offscreen", "every panel, offscreen"} <= {row["check"] for row in record["checks"]}


@pytest.fixture
def resources(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A copy of the data that may be broken, in the place of the real one."""
    copied = tmp_path / "resources"
    shutil.copytree(ROOT / "resources", copied)
    monkeypatch.setattr("rvsim.resources._PLACES", (copied,))
    resource_folder.cache_clear()
    yield copied
    resource_folder.cache_clear()


@pytest.mark.parametrize(
    "file", ["help/robot-file.md", "icons/rvsim.svg", "help/pictures/how.png", "robots/scara.toml"]
)
def test_a_file_that_is_cut_off_is_told_by_name(resources: Path, file: str) -> None:
    assert outcome_of("resources", CHECKS["resources"]).verdict == "ok"
    whole = (resources / file).read_bytes()
    (resources / file).write_bytes(whole[: len(whole) // 2] if not file.endswith(".md") else b"")
    outcome = outcome_of("resources", CHECKS["resources"])
    assert outcome.verdict == "FAILED"
    assert outcome.words.startswith(f"{file} is broken: ")


def test_an_arm_whose_numbers_have_changed_is_told_by_name(resources: Path) -> None:
    file = resources / "robots" / "rv-m1.toml"
    file.write_text(file.read_text(encoding="utf-8").replace("a = 160", "a = 161"), encoding="utf-8")
    outcome = outcome_of("forward kinematics", CHECKS["forward kinematics"])
    assert (outcome.verdict, outcome.words[:10]) == ("FAILED", "rv-m1 at (")


def test_a_screen_that_ends_its_process_is_told_with_the_last_words(tmp_path: Path) -> None:
    (outcome,) = outcomes_on("no-such-screen", tmp_path)
    assert (outcome.check, outcome.verdict) == ("screen no-such-screen", "FAILED")
    assert "no-such-screen" in outcome.words


def test_an_exception_is_a_failed_check_and_a_missing_part_of_the_computer_is_none() -> None:
    def skipped() -> str:
        raise SkippedError("no graphics card")

    def broken() -> str:
        raise OSError("the disk is gone")

    def wrong() -> str:
        expect(0, "4 of 11")
        return ""

    outcomes = [outcome_of("check", check)[1:3] for check in (lambda: "fine", skipped, broken, wrong)]
    assert outcomes == [
        ("ok", "fine"),
        ("skipped", "no graphics card"),
        ("FAILED", "OSError: the disk is gone"),
        ("FAILED", "4 of 11"),
    ]


@pytest.mark.parametrize(
    ("environment", "system", "expected"),
    [
        ({}, "linux", ("offscreen",)),
        ({"DISPLAY": ":0", "WAYLAND_DISPLAY": "wayland-0"}, "linux", ("offscreen", "xcb", "wayland")),
        ({}, "win32", ("offscreen", "windows")),
        ({}, "darwin", ("offscreen", "cocoa")),
    ],
)
def test_each_screen_that_is_there_is_tried(
    environment: dict[str, str], system: str, expected: tuple[str, ...]
) -> None:
    assert screens(environment, system) == expected
