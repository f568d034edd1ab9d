"""Importing tables: what stands where is guessed and can be said, and a spoilt file is named by row and column."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PySide6.QtWidgets import QCheckBox, QComboBox, QLabel, QPushButton, QTableWidget, QWidget
from pytestqt.qtbot import QtBot

from rvsim import load_robot
from rvsim.experiment import Experiment, LineTask
from rvsim.experiment.program import JointMove, LineMove
from rvsim.gui.import_dialog import ImportDialog, open_import
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.preferences import Preferences
from rvsim.gui.session import Session
from rvsim.gui.tracker import PathTracker
from rvsim.lab.motion_table import motion_csv
from rvsim.motion import joint_move
from rvsim.playback.curves import curves_of
from rvsim.robot import Robot


def experiment(robot: Robot) -> Experiment:
    return Experiment(robot, robot.home, LineTask((0.11, 0.0, 0.13), (0.23, 0.0, 0.33)))


class Window(QWidget):
    """All of a window that an import needs."""

    def __init__(self) -> None:
        super().__init__()
        self.session = Session(experiment(load_robot("rv-m1")), experiment)
        self.motion = MotionControl(self.session, Preferences(), self)
        self.tracker = PathTracker(self.session, self.motion, self)


@pytest.fixture
def window(qtbot: QtBot) -> Window:
    made = Window()
    qtbot.addWidget(made)
    made.show()
    return made


def opened(window: Window, file: Path, text: str) -> ImportDialog:
    file.write_text(text, encoding="utf-8")
    dialog = open_import(window, window.session, window.motion, window.tracker, file)
    assert dialog is not None
    return dialog


def summary(dialog: ImportDialog) -> str:
    return dialog.findChild(QLabel, "import_summary").text()


def choose(dialog: ImportDialog, name: str, data: object) -> None:
    box = dialog.findChild(QComboBox, name)
    box.setCurrentIndex(box.findData(data))
    box.activated.emit(box.currentIndex())


def press(dialog: ImportDialog) -> None:
    dialog.findChild(QPushButton, "import_start").click()


@pytest.mark.parametrize("units", ["si", "screen"])
def test_an_exported_motion_comes_back_at_its_times(window: Window, tmp_path: Path, units: str) -> None:
    robot = window.session.robot
    motion = joint_move(robot, robot.home, np.add(robot.home, (0.5, 0.2, -0.4, 0.1, 0.0)), seconds=2.0)
    dialog = opened(window, tmp_path / "m.csv", motion_csv(curves_of(robot, motion, samples=101), units))
    assert dialog.content == "joints"
    assert summary(dialog) == "101 poses."
    press(dialog)
    player = window.motion.player
    window.motion.pause()
    begin = player.trajectory.path_start
    assert player.duration - begin == pytest.approx(2.0)
    np.testing.assert_allclose(player.trajectory.q(begin + 0.7), motion.q(0.7), atol=1e-6)
    assert not dialog.isVisible()


def test_joints_become_moves_behind_those_of_the_program_undoably(window: Window, tmp_path: Path) -> None:
    text = "10;20;-30;0;0\n11,5;21;-31;0;0\n"
    dialog = opened(window, tmp_path / "q.csv", text)
    assert dialog.table.delimiter == ";"
    choose(dialog, "import_use", "program")
    press(dialog)
    program = window.session.experiment.program
    assert [type(move) for move in program] == [JointMove, JointMove]
    np.testing.assert_allclose(np.degrees(program[1].q), [11.5, 21.0, -31.0, 0.0, 0.0])
    window.session.undo_stack.undo()
    assert window.session.experiment.program == ()


def test_points_become_the_trajectory_or_lines(window: Window, tmp_path: Path) -> None:
    text = "z,x,y\n0.2,0.3,-0.1\n0.2,0.31,0.0\n0.25,0.3,0.1\n"
    dialog = opened(window, tmp_path / "p.csv", text)
    assert dialog.content == "points"
    choose(dialog, "import_length_unit", "m")
    press(dialog)
    shape = window.session.experiment.trajectory.shape
    np.testing.assert_allclose(shape.points[0], [0.3, -0.1, 0.2])
    dialog = opened(window, tmp_path / "p.csv", text)
    choose(dialog, "import_length_unit", "m")
    choose(dialog, "import_use", "program")
    press(dialog)
    assert window.session.experiment.program[0] == LineMove((0.3, -0.1, 0.2))


def test_columns_are_chosen_and_the_first_row_is_a_header_or_not(window: Window, tmp_path: Path) -> None:
    dialog = opened(window, tmp_path / "p.txt", "7 300 0 200\n8 310 0 210\n")
    choose(dialog, "import_content", "points")
    assert dialog.findChild(QTableWidget, "import_preview").columnCount() == 4
    for number, column in ((1, 1), (2, 2), (3, 3)):
        choose(dialog, f"import_column_{number}", column)
    np.testing.assert_allclose(dialog._values()[0], [0.3, 0.0, 0.2])
    dialog.findChild(QCheckBox, "import_header").click()
    assert len(dialog._values()) == 1
    dialog.reject()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("q1,q2,q3,q4,q5\n0,0,-10,0,0\n0,up,-10,0,0\n", "row 3, column 2 (q2): found “up”"),
        ("q1,q2,q3,q4,q5\n0,0,-10,0,0\n0,0,50,0,0\n", "row 3, column 3 (q3): found 50°, expected the elbow"),
        ("t,q1,q2,q3,q4,q5\n1,0,0,-1,0,0\n1,0,0,-2,0,0\n", "row 3, column 1 (t): found 1 s"),
    ],
)
def test_a_spoilt_file_is_named_by_row_and_column(window: Window, tmp_path: Path, text: str, message: str) -> None:
    dialog = opened(window, tmp_path / "q.csv", text)
    assert message in summary(dialog)
    assert not dialog.findChild(QPushButton, "import_start").isEnabled()
    dialog.reject()


def test_a_file_without_a_table_is_told_of(window: Window, tmp_path: Path) -> None:
    said: list[str] = []
    window.session.said.connect(lambda text, level: said.append(f"{level}: {text}"))
    for name, data in (("empty.csv", b""), ("picture.csv", b"\x89PNG\xff\xfe")):
        (tmp_path / name).write_bytes(data)
        assert open_import(window, window.session, window.motion, window.tracker, tmp_path / name) is None
        assert name in said[-1]
    assert open_import(window, window.session, window.motion, window.tracker, tmp_path / "none.csv") is None
    assert said[-1].startswith("error")
