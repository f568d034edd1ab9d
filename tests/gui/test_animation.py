"""Animations: as many frames as it says, each at its moment, in three formats, given up without a trace."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from PySide6.QtWidgets import QComboBox, QLabel, QLineEdit, QPushButton
from pytestqt.qtbot import QtBot

from rvsim import load_robot
from rvsim.gui.animation import FORMATS, Animation, AnimationSettings, Picturing, encoded
from rvsim.gui.animation_dialog import AnimationDialog
from rvsim.gui.app import build_window
from rvsim.gui.main_window import MainWindow
from rvsim.gui.preferences import Preferences
from rvsim.motion import Trajectory, joint_move
from rvsim.scene import Camera
from rvsim.scene.build import SceneOptions
from rvsim.scene.palette import LIGHT

SMALL = AnimationSettings(160, 90, 10, 2.0)


@pytest.fixture
def motion() -> Trajectory:
    robot = load_robot("rv-m1")
    return joint_move(robot, robot.home, np.add(robot.home, (0.8, 0.3, -0.5, 0.2, 0.0)), seconds=2.0)


@pytest.fixture
def painted(qapp, motion: Trajectory) -> Animation:
    camera = Camera(np.zeros(3), 2.5)
    made = Animation(motion, Picturing(load_robot("rv-m1"), camera, LIGHT, SceneOptions(labels=False)), SMALL)
    while made.step():
        pass
    return made


def test_the_moments_are_even_and_end_with_the_last(motion: Trajectory) -> None:
    times = AnimationSettings(rate=10, speed=2.0).times(2.05)
    assert len(times) == 12
    assert times[0] == 0.0
    assert times[-1] == 2.05
    np.testing.assert_allclose(np.diff(times[:-1]), 0.2)
    assert AnimationSettings().frames(0.0) == 2
    assert AnimationSettings(1920, 1080, 30).too_many(60.0)


@pytest.mark.parametrize("ending", FORMATS)
def test_each_format_plays_all_of_it(painted: Animation, ending: str) -> None:
    assert painted.share == 1.0
    file = Image.open(io.BytesIO(painted.encode(ending)))
    assert file.size == (160, 90)
    assert file.n_frames == painted.total == 11
    lasting = []
    for frame in range(file.n_frames):
        file.seek(frame)
        file.load()
        lasting.append(file.info["duration"])
    assert sum(lasting) / 1000.0 == pytest.approx(SMALL.seconds(2.0), abs=0.02)
    last = np.asarray(file.convert("RGB"), dtype=float)
    wanted = np.asarray(painted.frames[-1], dtype=float)
    assert np.abs(last - wanted).mean() < 4.0
    assert np.abs(last - np.asarray(painted.frames[0], dtype=float)).mean() > 0.5


class GivenUpError(Exception):
    """Somebody gives up."""


@pytest.mark.parametrize("ending", FORMATS)
def test_writing_can_be_given_up_at_any_frame(painted: Animation, ending: str) -> None:
    asked = 0

    def go_on() -> None:
        nonlocal asked
        asked += 1
        if asked >= 5:
            raise GivenUpError

    with pytest.raises(GivenUpError):
        encoded(painted.frames, SMALL, ending, go_on)
    assert asked < 8  # it may tidy up
    painted.give_up()
    assert painted.encode(ending) == b""


@pytest.fixture
def window(qtbot: QtBot) -> MainWindow:
    made = build_window(Preferences(), robot="rv-m1")
    made.preferences.set("animated", False)
    qtbot.addWidget(made)
    with qtbot.waitExposed(made):
        made.show()
    return made


def opened(window: MainWindow) -> AnimationDialog:
    dialog = AnimationDialog(window, window.session, window.motion, window.stage, window.preferences)
    dialog.show()
    return dialog


def test_the_dialog_says_how_long_it_will_be_and_writes_it(window: MainWindow, qtbot: QtBot, tmp_path: Path) -> None:
    window.tracker.track_line()
    window.motion.pause()
    dialog = opened(window)
    dialog.findChild(QComboBox, "animation_size").setCurrentIndex(0)
    dialog.findChild(QComboBox, "animation_rate").setCurrentIndex(0)
    speed = dialog.findChild(QComboBox, "animation_speed")
    speed.setCurrentIndex(speed.count() - 1)
    summary = dialog.findChild(QLabel, "animation_summary")
    frames = dialog.settings.frames(window.motion.player.duration)
    assert summary.text().startswith(f"{frames} frames")
    file = tmp_path / "arm.gif"
    dialog.findChild(QLineEdit, "animation_file").setText(str(file))
    dialog.findChild(QComboBox, "animation_format").setCurrentIndex(2)
    file = file.with_suffix(".webp")
    assert dialog.findChild(QLineEdit, "animation_file").text() == str(file)
    dialog.findChild(QPushButton, "animation_start").click()
    assert dialog.busy
    qtbot.waitUntil(lambda: not dialog.busy, timeout=20_000)
    assert summary.text().startswith("Saved")
    with Image.open(file) as written:
        assert written.n_frames > 3
    dialog.close()


def test_given_up_it_leaves_nothing_behind(window: MainWindow, qtbot: QtBot, tmp_path: Path) -> None:
    window.tracker.track_line()
    window.motion.pause()
    dialog = opened(window)
    dialog.findChild(QLineEdit, "animation_file").setText(str(tmp_path / "arm.gif"))
    dialog.findChild(QPushButton, "animation_start").click()
    dialog._paint_next()
    cancel = dialog.findChild(QPushButton, "animation_cancel")
    assert cancel.text() == "Cancel"
    cancel.click()
    assert not dialog.busy
    assert not list(tmp_path.glob("*.gif"))
    cancel.click()
    assert not dialog.isVisible()


def test_a_folder_that_is_not_there_is_said(window: MainWindow, qtbot: QtBot, tmp_path: Path) -> None:
    window.tracker.track_line()
    window.motion.pause()
    dialog = opened(window)
    dialog.findChild(QLineEdit, "animation_file").setText(str(tmp_path / "none" / "arm.gif"))
    dialog._animation = Animation(window.motion.player.trajectory, dialog._picturing(), dialog.settings)
    dialog._on_encoded(b"GIF")
    assert "cannot be written" in dialog.findChild(QLabel, "animation_summary").text()
    dialog.close()


def test_without_a_motion_there_is_nothing_to_export(window: MainWindow) -> None:
    dialog = opened(window)
    assert not dialog.findChild(QPushButton, "animation_start").isEnabled()
    assert "No motion yet" in dialog.findChild(QLabel, "animation_summary").text()
    dialog.close()


def test_it_paints_the_motion_it_was_opened_for_whatever_the_window_shows_since(window: MainWindow) -> None:
    window.tracker.track_line()
    window.motion.pause()
    dialog = opened(window)
    window.session.use_robot(window.library["ur5e"])
    dialog.findChild(QComboBox, "animation_size").setCurrentIndex(0)
    dialog.start()
    assert dialog.busy
    dialog._paint_next()
    dialog.close()
