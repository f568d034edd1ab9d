"""When an environment serves as it is, and when it is made anew."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from dev_environment import Stamp

CONSTRAINTS = "numpy==2.4.6\n"


def _stamp(
    place: str = "/here/.venv", python: str = "3.11.2", pins: str = "abc", extras: tuple[str, ...] = ()
) -> Stamp:
    from dev_environment import Stamp

    return Stamp(place, python, pins, extras)


def test_one_that_is_as_wanted_serves() -> None:
    from dev_environment import reason_to_make

    assert reason_to_make(_stamp(), _stamp(), exists=True, starts=True) is None


def test_extras_alone_are_no_reason_to_make_it_anew_but_are_added() -> None:
    from dev_environment import extras_to_install, reason_to_make

    bare, whole = _stamp(), _stamp(extras=("test",))
    assert reason_to_make(bare, whole, exists=True, starts=True) is None
    assert extras_to_install(bare, whole) == ("test",)
    assert extras_to_install(whole, bare) == ()


@pytest.mark.parametrize(
    ("place", "python", "pins", "word"),
    [
        ("/there/.venv", "3.11.2", "abc", "copied"),
        ("/here/.venv", "3.12.1", "abc", "another Python"),
        ("/here/.venv", "3.11.2", "def", "changed"),
    ],
)
def test_a_copied_one_another_python_and_other_pins_are_reasons(place: str, python: str, pins: str, word: str) -> None:
    from dev_environment import reason_to_make

    assert word in (reason_to_make(_stamp(place, python, pins), _stamp(), exists=True, starts=True) or "")


def test_a_missing_a_half_made_and_a_broken_one_are_made_anew() -> None:
    from dev_environment import reason_to_make

    assert "not there" in (reason_to_make(None, _stamp(), exists=False, starts=False) or "")
    assert "not finished" in (reason_to_make(None, _stamp(), exists=True, starts=True) or "")
    assert "gone" in (reason_to_make(_stamp(), _stamp(), exists=True, starts=False) or "")


@pytest.mark.parametrize("text", ["", "{", "[]", '{"place": 1}', '{"extras": []}'])
def test_a_stamp_that_cannot_be_read_is_none(tmp_path: Path, text: str) -> None:
    from dev_environment import read_stamp

    assert read_stamp(tmp_path / "missing") is None
    (tmp_path / "stamp").write_text(text)
    assert read_stamp(tmp_path / "stamp") is None


def test_the_fingerprint_follows_what_is_installed_and_not_how_it_is_linted() -> None:
    from dev_environment import fingerprint

    pyproject = {"project": {"dependencies": ["numpy"]}, "tool": {"ruff": {"line-length": 120}}}
    before = fingerprint(pyproject, CONSTRAINTS)
    assert fingerprint({**pyproject, "tool": {}}, CONSTRAINTS) == before
    assert fingerprint({**pyproject, "project": {"dependencies": []}}, CONSTRAINTS) != before
    assert fingerprint(pyproject, "numpy==2.4.5\n") != before
    assert fingerprint(pyproject, CONSTRAINTS, ("pin",)) != before


def test_foreign_packages_are_kept_out_of_our_processes(monkeypatch: pytest.MonkeyPatch) -> None:
    from dev_environment import child_environment

    monkeypatch.setenv("PYTHONPATH", "/opt/ros/lib/python3.10/site-packages")
    monkeypatch.setenv("LANG", "C.UTF-8")
    environment = child_environment(QT_QPA_PLATFORM="offscreen")
    assert "PYTHONPATH" not in environment
    assert (environment["LANG"], environment["QT_QPA_PLATFORM"]) == ("C.UTF-8", "offscreen")


def test_every_dependency_is_pinned_exactly() -> None:
    from dev_environment import ROOT

    lines = (ROOT / "packaging" / "constraints.txt").read_text(encoding="utf-8").splitlines()
    pins = [line for line in lines if line and not line.startswith("#")]
    assert all("==" in pin for pin in pins)
