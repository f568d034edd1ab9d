"""The coursework that the sources set, done in the window: a star drawn in a plane, its curves, then a written name."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QAction, QKeyEvent
from PySide6.QtWidgets import QAbstractButton, QAbstractSpinBox, QApplication, QComboBox, QLabel, QLineEdit, QSlider
from pytestqt.qtbot import QtBot

from rvsim.gui.app import build_window
from rvsim.gui.main_window import MainWindow
from rvsim.gui.plots.time_plot import TimePlot
from rvsim.gui.preferences import Preferences
from rvsim.kinematics import forward_kinematics
from rvsim.motion.trajectory import accelerations, speeds
from rvsim.spatial import rotation_from_rpy

CURVES = ("q", "qd", "qdd", "tool")
# The arm, the middle of the star [mm], and how its plane is turned: roll, pitch, yaw [°].
STARS = [
    ("rv-m1", ("320", "0", "200"), ("0", "-30", "0")),
    ("ur5e", ("450", "100", "350"), ("20", "-30", "0")),
    ("al5b", ("180", "0", "90"), ("15", "-20", "0")),
]


@pytest.fixture
def window_of(qtbot: QtBot) -> Iterator[Callable[[str], MainWindow]]:
    """The window with an arm, its Path panel in front."""
    made: list[MainWindow] = []

    def make(name: str) -> MainWindow:
        window = build_window(Preferences(), robot=name)
        qtbot.addWidget(window)
        window.show()
        window.docks.show_panel("path")
        made.append(window)
        return window

    yield make
    for window in made:
        window.motion.pause()


def find(window: MainWindow, kind: type, name: str) -> Any:
    widget = window.findChild(kind, name)
    assert widget is not None, f"no {kind.__name__} named {name}"
    return widget


def choose(window: MainWindow, name: str, data: str) -> None:
    box = find(window, QComboBox, name)
    box.setCurrentIndex(box.findData(data))
    box.activated.emit(box.currentIndex())


def type_into(qtbot: QtBot, box: QAbstractSpinBox | QLineEdit, text: str) -> None:
    box.setFocus()
    box.selectAll()
    qtbot.keyClicks(box, text)
    qtbot.keyClick(box, Qt.Key.Key_Return)


def track(qtbot: QtBot, window: MainWindow) -> None:
    find(window, QAbstractButton, "track_trajectory_button").click()
    qtbot.waitUntil(lambda: window.session.tracking is not None)
    window.motion.pause()


def show_curves(qtbot: QtBot, window: MainWindow) -> None:
    find(window, QAction, "action_show_plots").trigger()
    for name in (*CURVES, "deviation"):
        button = find(window, QAbstractButton, f"plot_{name}_button")
        button.setChecked(name in CURVES)
    qtbot.waitUntil(lambda: all(window.findChild(TimePlot, f"plot_{name}") for name in CURVES))


def corner_times(window: MainWindow) -> np.ndarray:
    """When the arm is in each corner, in both ends too [s]."""
    trajectory = window.motion.player.trajectory
    along = [start for start, stretch in zip(trajectory.starts, trajectory.stretches, strict=False)
             if stretch.phase == "path"]  # fmt: skip
    return np.array([*along, trajectory.duration])


def least_tilt(dof: int, points: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """The least angles (m,) between tool axis and normal [rad]: a 5R arm turns its tool in an upright plane."""
    if dof == 6:
        return np.zeros(len(points))
    waist = np.arctan2(points[:, 1], points[:, 0])
    across = np.column_stack([-np.sin(waist), np.cos(waist), np.zeros(len(points))])
    return np.arcsin(np.abs(across @ normal))


@pytest.mark.parametrize(("name", "middle", "turn"), STARS)
def test_a_star_in_a_tilted_plane(qtbot, window_of, name, middle, turn) -> None:
    window = window_of(name)
    choose(window, "trajectory_selector", "star")
    choose(window, "trajectory_orientation", "normal")
    for row, names, texts in (("center", "xyz", middle), ("turn", ("roll", "pitch", "yaw"), turn)):
        for part, text in zip(names, texts, strict=True):
            type_into(qtbot, find(window, QAbstractSpinBox, f"path_{row}_{part}"), text)
    assert find(window, QLabel, "reach_label").text().startswith("100 % within limits")
    track(qtbot, window)

    tracking, robot = window.session.tracking, window.session.robot
    assert tracking.complete
    assert not tracking.jumps
    T = forward_kinematics(robot, tracking.q)
    points = tracking.path.points
    np.testing.assert_allclose(T[:, :3, 3], points, atol=1e-6)
    normal = rotation_from_rpy(np.radians([float(text) for text in turn]))[:, 2]
    assert np.abs((points - points[0]) @ normal).max() < 1e-9
    off = np.arcsin(np.linalg.norm(np.cross(T[:, :3, 2], normal), axis=1))
    np.testing.assert_allclose(off, least_tilt(robot.dof, points, normal), atol=1e-6)

    trajectory = window.motion.player.trajectory
    times = corner_times(window)
    assert len(times) == 6
    place = forward_kinematics(robot, trajectory.at(times).q)[:, :3, 3]
    np.testing.assert_allclose(place, points[[0, *tracking.path.corners, -1]], atol=1e-6)
    np.testing.assert_allclose(trajectory.at(times).qd, 0.0, atol=1e-9)
    every = trajectory.at(np.linspace(0.0, trajectory.duration, 3001))
    assert (np.abs(every.qd) <= speeds(robot) * (1 + 1e-6)).all()
    assert (np.abs(every.qdd) <= accelerations(robot) * (1 + 1e-6)).all()

    show_curves(qtbot, window)
    for curve, values in zip(CURVES[:3], every[:3], strict=True):
        lines = [line for line in find(window, TimePlot, f"plot_{curve}").drawing.lines if not line.dashed]
        assert len(lines) == robot.dof
        shown = max(np.abs(line.values).max() for line in lines)
        assert shown == pytest.approx(np.degrees(np.abs(values)).max(), rel=0.01)
    slider = find(window, QSlider, "time_slider")
    slider.setValue(slider.maximum())
    np.testing.assert_allclose(window.session.q, tracking.q[-1], atol=1e-9)


@pytest.mark.parametrize("name", ["rv-m1", "ur5e", "al5b"])
def test_a_written_name(qtbot, window_of, name) -> None:
    window = window_of(name)
    choose(window, "trajectory_selector", "text")
    box = find(window, QLineEdit, "shape_text")
    type_into(qtbot, box, "Zo")
    # The test library's own typing knows ASCII only.
    QApplication.sendEvent(box, QKeyEvent(QEvent.Type.KeyPress, 0, Qt.KeyboardModifier.NoModifier, "ë"))
    assert find(window, QLabel, "reach_label").text() == "100 % within limits"
    track(qtbot, window)
    tracking = window.session.tracking
    path = tracking.path
    assert tracking.complete
    assert not tracking.jumps
    np.testing.assert_allclose(forward_kinematics(window.session.robot, tracking.q)[:, :3, 3], path.points, atol=1e-6)
    height = path.points[:, 2] - path.points[:, 2].min()
    strokes = 1 + np.count_nonzero(np.diff(path.pen_up.astype(int)) == 1)
    assert strokes == 7  # three of the Z, o, e, two dots
    assert height[~path.pen_up].max() < 1e-9
    assert height.max() > 1e-3
