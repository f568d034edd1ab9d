"""Whether this copy of rvsim works on this computer: a checkout, a wheel and a bundle run it as `rvsim self-test`.

Each check is a function that says in a sentence what it has found, and raises where something is wrong. Those that need
a screen run once for each screen that is there, each time in a process of its own: a screen that ends its process is
told as well. Libraries are imported by the checks that need them, and nothing of the user's is touched.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

from rvsim.self_test.arithmetic import CHECKS
from rvsim.self_test.outcome import Outcome, outcome_of
from rvsim.self_test.screen import check_screen, time_start

__all__ = ["Outcome", "check_screen", "outcomes_on", "screens", "self_test", "time_start"]

_PATIENCE = 120.0  # [s] a screen's checks may take on the slowest computer


def screens(environment: Mapping[str, str], system: str = sys.platform) -> tuple[str, ...]:
    """What Qt calls the screens that are there; "offscreen" is there always."""
    if not system.startswith("linux"):
        return "offscreen", "cocoa" if system == "darwin" else "windows"
    asked = (("xcb", "DISPLAY"), ("wayland", "WAYLAND_DISPLAY"))
    return "offscreen", *(name for name, variable in asked if environment.get(variable))


def self_test(report: Callable[[Outcome], None]) -> list[Outcome]:
    """Make every check, telling each as it is done."""
    done: list[Outcome] = []
    with tempfile.TemporaryDirectory(prefix="rvsim-self-test-") as folder:
        for outcome in _every_outcome(Path(folder)):
            done.append(outcome)
            report(outcome)
    return done


def _every_outcome(folder: Path) -> Iterator[Outcome]:
    for name, check in CHECKS.items():
        yield outcome_of(name, check)
    for screen in screens(os.environ):
        yield from outcomes_on(screen, folder)


def outcomes_on(screen: str, folder: Path) -> Iterator[Outcome]:
    """What another process, which keeps its files in the folder, says of what Qt calls a screen.

    A process that has ended before its time is a failed check.
    """
    report, began = folder / f"{screen}.jsonl", time.perf_counter()
    report.touch()
    user = {"QT_QPA_PLATFORM": screen, "RVSIM_USER_FOLDER": str(folder / "user")}
    ending = _run([*_own_command(), "self-test", "--report", str(report)], {**os.environ, **user})
    lines = report.read_text(encoding="utf-8").splitlines()
    outcomes = [Outcome(*json.loads(line)) for line in lines]
    for outcome in outcomes:
        yield outcome._replace(check=f"{outcome.check}, {screen}")
    if ending and all(outcome.verdict != "FAILED" for outcome in outcomes):
        yield Outcome(f"screen {screen}", "FAILED", ending, time.perf_counter() - began)


def _own_command() -> list[str]:
    """What starts this very rvsim once more."""
    return [sys.executable] if getattr(sys, "frozen", False) else [sys.executable, "-m", "rvsim"]


def _run(command: Sequence[str], environment: Mapping[str, str]) -> str:
    """How the command went wrong, with its last words; "" if it did not."""
    try:
        ended = subprocess.run(
            command,
            env=dict(environment),
            stdin=subprocess.DEVNULL,
            capture_output=True,
            timeout=_PATIENCE,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return f"it has not ended within {_PATIENCE:.0f} s"
    last = " ".join(ended.stderr.decode(errors="replace").split())[-300:]
    return f"ended with {ended.returncode}: {last}" if ended.returncode else ""
