"""What the Export menu writes: the loaded motion as a table and as a script, and nothing without a motion."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtWidgets import QFileDialog, QWidget
from pytestqt.qtbot import QtBot

from rvsim import load_robot
from rvsim.experiment import Experiment
from rvsim.gui.exports import ask_motion_csv, ask_script, motion_table, script
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.preferences import Preferences
from rvsim.gui.session import Session
from rvsim.gui.tracker import PathTracker
from rvsim.lab.lines import line_presets
from rvsim.robot import Robot


def experiment(robot: Robot) -> Experiment:
    return Experiment(robot, robot.home, line_presets(robot)[0].task())


@pytest.fixture
def session(qapp) -> Session:
    made = Session(experiment(load_robot("rv-m1")), experiment)
    made.sentences = []
    made.said.connect(lambda text, level: made.sentences.append((text, level)))
    return made


def test_the_tracked_motion_is_written_where_one_says(
    session: Session, qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    motion = MotionControl(session, Preferences(), session)
    PathTracker(session, motion, session).track_line()
    motion.pause()
    parent = QWidget()
    qtbot.addWidget(parent)
    for ask, name in ((ask_motion_csv, "m.csv"), (ask_script, "m.py")):
        monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_, name=name: (str(tmp_path / name), ""))
        ask(parent, session, motion)
        assert session.sentences[-1] == (f"Saved {tmp_path / name}.", "info")
    assert "q1 [deg]" in (tmp_path / "m.csv").read_text(encoding="utf-8")
    assert "WANTED = np.array" in (tmp_path / "m.py").read_text(encoding="utf-8")
    assert "TIMES = np.array" in (tmp_path / "m.py").read_text(encoding="utf-8")
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(tmp_path / "none" / "m.csv"), ""))
    ask_motion_csv(parent, session, motion, "si")
    assert session.sentences[-1][1] == "error"
    session.set_tracking(None)
    assert "WANTED = None" in script(session, motion)


def test_without_a_motion_there_is_nothing_to_write(session: Session) -> None:
    motion = MotionControl(session, Preferences(), session)
    assert motion_table(session, motion) is None
    assert script(session, motion) is None
    ask_script(QWidget(), session, motion)
    assert session.sentences[-1][1] == "warning"
