"""Export: where to, and the motion that is loaded as a table or as a script; the window's menu calls these."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from PySide6.QtWidgets import QFileDialog, QWidget

from rvsim.files.atomic import write_atomically
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.session import Session
from rvsim.lab.motion_table import TableUnits, motion_csv
from rvsim.lab.script import motion_script, tracking_script
from rvsim.language import tr
from rvsim.motion import Trajectory
from rvsim.playback.curves import curves_of

_RATE = 50.0  # rows a second
_FEWEST, _MOST = 101, 4000
_MOST_IN_SCRIPT = 2001


def motion_table(session: Session, motion: MotionControl, units: TableUnits = "screen") -> str | None:
    """The motion that is loaded as CSV, None when there is none."""
    trajectory = motion.player.trajectory
    if not isinstance(trajectory, Trajectory):
        return None
    return motion_csv(curves_of(session.robot, trajectory, samples=_samples(trajectory, _MOST)), units)


def script(session: Session, motion: MotionControl) -> str | None:
    """The script of the tracked path, or else of the motion that is loaded; None when there is neither."""
    loaded = motion.player.trajectory
    trajectory = loaded if isinstance(loaded, Trajectory) else None
    if session.tracking is not None and session.tracking.reached_count:
        return tracking_script(session.tracking, trajectory)
    if trajectory is None:
        return None
    times = np.linspace(0.0, trajectory.duration, _samples(trajectory, _MOST_IN_SCRIPT))
    return motion_script(session.robot, times, trajectory.q(times))


def _samples(trajectory: Trajectory, most: int) -> int:
    return int(np.clip(round(_RATE * trajectory.duration) + 1, _FEWEST, most))


def ask_motion_csv(parent: QWidget, session: Session, motion: MotionControl, units: TableUnits = "screen") -> None:
    """Ask for a place and write the motion there as CSV."""
    _ask(parent, session, tr("Export motion as CSV"), "motion.csv", lambda: motion_table(session, motion, units))


def ask_script(parent: QWidget, session: Session, motion: MotionControl) -> None:
    """Ask for a place and write the script there."""
    _ask(parent, session, tr("Export Python script"), "motion.py", lambda: script(session, motion))


def _ask(parent: QWidget, session: Session, title: str, name: str, make: Callable[[], str | None]) -> None:
    text = make()
    if text is None:
        session.warn(tr("No motion yet: track a line or run a program first."))
        return
    ending = Path(name).suffix
    start = str(Path.home() / f"{session.robot.name}-{name}")
    chosen, _ = QFileDialog.getSaveFileName(parent, title, start, f"*{ending}")
    if chosen:
        write_export(session, Path(chosen) if Path(chosen).suffix else Path(chosen).with_suffix(ending), text)


def write_export(session: Session, path: Path, text: str) -> None:
    """Write it whole or not at all, and say how it went."""
    try:
        write_atomically(path, text.encode())
    except OSError as problem:
        reason = problem.strerror or problem
        session.say(tr("Not saved: {path} cannot be written ({reason}).", path=path, reason=reason), "error")
        return
    session.say(tr("Saved {path}.", path=path))
