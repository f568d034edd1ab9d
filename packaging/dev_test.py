"""The checks: linters, then the tests without a screen, then those that need OpenGL, on a virtual screen."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Sequence
from typing import NamedTuple

import dev_environment
import dev_screen
import dev_system
from dev_environment import ROOT

_NO_TESTS = 5  # pytest's exit status when it found none
_LINTERS = (
    ("ruff check", ("ruff", "check")),
    ("ruff format", ("ruff", "format", "--check")),
    ("mypy", ("mypy",)),
)


class Outcome(NamedTuple):
    """How one leg of the checks went; `code` is its exit status."""

    leg: str
    code: int


def test(arguments: list[str]) -> int:
    """Run every leg; 0 only if all are good. With arguments, only the tests that pytest chooses by them."""
    has_opengl_leg = sys.platform == "linux"
    dev_system.provide((*dev_environment.needs(), *dev_system.QT, *dev_system.VIRTUAL_SCREEN))
    python = str(dev_environment.ensure(extras=("test",)))
    linted = [] if arguments else [_leg(name, [python, "-m", *command]) for name, command in _LINTERS]
    tested = [_off_screen(python, arguments, judges_coverage=not has_opengl_leg)]
    if has_opengl_leg:
        tested.append(_opengl(python, arguments))
    print(summary([*linted, *tested], selected=bool(arguments), has_opengl_leg=has_opengl_leg), flush=True)
    return exit_status(linted, tested, selected=bool(arguments))


def exit_status(linted: Sequence[Outcome], tested: Sequence[Outcome], selected: bool) -> int:
    """0 only if every leg is good; a leg without tests is good only where the person selected those of the other."""
    ran = [outcome for outcome in tested if not (selected and outcome.code == _NO_TESTS)]
    if not ran:
        return _NO_TESTS
    return next((outcome.code for outcome in [*linted, *ran] if outcome.code), 0)


def summary(outcomes: Sequence[Outcome], selected: bool, has_opengl_leg: bool) -> str:
    """One line that tells how each leg went, and which were left out."""
    parts = [f"{outcome.leg}: {_verdict(outcome.code, selected)}" for outcome in outcomes]
    if selected:
        parts.append("linters and coverage: only without arguments")
    if not has_opengl_leg:
        parts.append("OpenGL tests: on Linux only")
    return " | ".join(parts)


def _verdict(code: int, selected: bool) -> str:
    if code == _NO_TESTS:
        return "none selected" if selected else "FAILED, no tests found"
    return "ok" if code == 0 else f"FAILED ({code})"


def _leg(name: str, command: list[str], **variables: str) -> Outcome:
    print(f"--- {name}", flush=True)
    return Outcome(name, subprocess.call(command, cwd=ROOT, env=dev_environment.child_environment(**variables)))


def _off_screen(python: str, arguments: list[str], judges_coverage: bool) -> Outcome:
    workers = str(min(4, os.cpu_count() or 1))
    command = [python, "-m", "pytest", "-m", "not opengl", "-n", workers, "--dist", "worksteal"]
    if not arguments:
        command += ["--cov", "--cov-report=" if not judges_coverage else "--cov-report=term"]
        command += [] if judges_coverage else ["--cov-fail-under=0"]
    return _leg("tests off-screen", [*command, *arguments], QT_QPA_PLATFORM="offscreen")


def _opengl(python: str, arguments: list[str]) -> Outcome:
    """The tests with real pixels, one after the other; this last leg judges the coverage of both together."""
    command = [python, "-m", "pytest", "-m", "opengl", "-W", "error::RuntimeWarning"]
    if not arguments:
        command += ["--cov", "--cov-append", "--cov-report=term"]
    with dev_screen.virtual_screen() as variables:
        return _leg("tests with OpenGL", [*command, *arguments], **variables)
