"""Plots: one cursor through window and curves, units that are said, and nothing worked out while nobody looks."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QToolButton
from pytestqt.qtbot import QtBot

from rvsim import load_robot
from rvsim.gui.app import build_window
from rvsim.gui.main_window import MainWindow
from rvsim.gui.plots.catalogue import PLOTS
from rvsim.gui.preferences import Preferences
from rvsim.lab import named_path
from rvsim.motion import joint_move, track, trajectory_of
from rvsim.playback.curves import curves_of


@pytest.fixture
def window(qtbot: QtBot) -> MainWindow:
    made = build_window(Preferences(), robot="rv-m1")
    made.preferences.set("animated", False)
    qtbot.addWidget(made)
    with qtbot.waitExposed(made):
        made.show()
    made.preferences.set("show_plots", True)
    made.tracker.track_line()
    made.motion.pause()
    qtbot.waitUntil(lambda: set(made.plots.plots) == {"q", "qd", "deviation"})
    return made


def test_a_click_in_a_plot_takes_the_arm_and_the_slider_along(qtbot: QtBot, window: MainWindow) -> None:
    plot = window.plots.plots["q"]
    qtbot.waitUntil(lambda: plot.plot.width() == plot.width())
    view = plot.plot.getViewBox().sceneBoundingRect()
    qtbot.mouseClick(plot, Qt.MouseButton.LeftButton, pos=QPoint(round(view.center().x()), plot.height() // 2))
    player = window.motion.player
    assert player.time == pytest.approx(0.5 * player.duration, rel=0.02)
    np.testing.assert_array_equal(window.session.q, player.q)
    assert window.player_bar.slider.value() == pytest.approx(5000, abs=100)


def test_the_time_slider_takes_the_cursor_of_every_plot_along(window: MainWindow) -> None:
    window.player_bar.slider.setValue(2500)
    assert {round(plot._time, 9) for plot in window.plots.plots.values()} == {round(window.motion.player.time, 9)}
    degrees = np.degrees(window.session.q)
    shown = [value for _, _, value in window.plots.plots["q"].value_texts()]
    np.testing.assert_allclose(shown, degrees, atol=0.3)


def test_each_entry_draws_a_titled_plot_with_its_unit_for_every_arm() -> None:
    for name in ("rv-m1", "rrrp", "scara", "planar"):
        arm = load_robot(name)
        tracking = track(arm, named_path("line", arm))
        curves = curves_of(arm, trajectory_of(tracking, arm.home), tracking)
        for kind in PLOTS:
            drawing = kind.draw(curves, Preferences())
            assert drawing.title
            assert bool(drawing.lines) != bool(drawing.empty), (name, kind.name)
            assert drawing.unit or kind.name in ("sigma", "deviation")
            assert all(line.values.shape == curves.times.shape for line in drawing.lines)


def test_radians_are_plotted_where_they_are_preferred(window: MainWindow) -> None:
    curves = curves_of(window.session.robot, window.motion.player.trajectory)
    preferences = Preferences()
    degrees = PLOTS[1].draw(curves, preferences)
    preferences.set("angle_unit", "rad")
    radians = PLOTS[1].draw(curves, preferences)
    assert (degrees.unit, radians.unit) == ("°/s", "rad/s")
    np.testing.assert_allclose(degrees.lines[0].values, np.degrees(radians.lines[0].values))


def test_more_than_six_are_not_shown_and_the_choice_is_kept(qtbot: QtBot, window: MainWindow) -> None:
    for kind in PLOTS:
        window.plots.findChild(QToolButton, f"plot_{kind.name}_button").setChecked(True)
    qtbot.waitUntil(lambda: len(window.plots.plots) == 6)
    assert window.preferences["plots"].split(",") == window.plots.chosen


def test_without_a_motion_it_says_how_to_get_one(qtbot: QtBot, window: MainWindow) -> None:
    window.tracker.clear()
    qtbot.waitUntil(lambda: window.plots.empty.isVisible() and not window.plots.plots)
    assert "Track line" in window.plots.empty.text()


def test_curves_of_a_motion_agree_with_each_other() -> None:
    arm = load_robot("rv-m1")
    tracking = track(arm, named_path("letter-board", arm))
    curves = curves_of(arm, trajectory_of(tracking, arm.home), tracking, samples=2001)
    step = curves.times[1] - curves.times[0]
    middle = np.diff(curves.place, axis=0) / step
    assert np.abs(np.linalg.norm(middle, axis=1) - 0.5 * (curves.speed[1:] + curves.speed[:-1])).max() < 2e-3
    on_path = np.isfinite(curves.path_index)
    assert np.nanmax(curves.deviation) < 1e-3
    away = np.linalg.norm(curves.place - curves.desired, axis=1)[on_path]
    assert (away >= curves.deviation[on_path] - 1e-9).all()


def test_an_arm_without_masses_has_no_torques_and_says_where_to_enter_them() -> None:
    arm = load_robot("rrrp")
    curves = curves_of(arm, joint_move(arm, arm.home, arm.home + 0.1))
    assert curves.torque is None
    assert "Dynamics" in next(kind for kind in PLOTS if kind.name == "torque").draw(curves, Preferences()).empty


def test_the_plots_fit_a_small_screen(qtbot: QtBot, window: MainWindow) -> None:
    window.resize(1024, 600)
    qtbot.waitUntil(lambda: window.width() == 1024)
    window.findChild(QToolButton, "plot_tool_button").setChecked(True)
    qtbot.waitUntil(lambda: "tool" in window.plots.plots)
    for plot in window.plots.plots.values():
        qtbot.waitUntil(
            lambda plot=plot: plot.mapTo(window.plots, plot.rect().bottomRight()).x() <= window.plots.width()
        )
    plot = window.plots.plots["deviation"]
    assert plot.drawing.title not in plot.toolTip()
    plot.resize(plot.minimumSize())
    plot.repaint_curves()
    assert plot.toolTip().startswith(f"{plot.drawing.title}\n"), "there is no room for all of it"


def test_the_largest_value_is_told_with_its_joint_and_time(window: MainWindow) -> None:
    plot = window.plots.plots["qd"]
    name, value, time = plot.largest()
    speeds = np.degrees(window.motion.player.trajectory.at(time).qd)
    joint = int(name[1]) - 1
    assert np.abs(speeds).argmax() == joint
    assert speeds[joint] == pytest.approx(value, rel=1e-6)
    window.plots._read_from("qd")
    assert "°/s" in window.plots.readout.text()
