"""Points by clicks in the scene: each is one step of undo, a drag still turns the view, and Esc ends it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QComboBox, QPushButton
from pytestqt.qtbot import QtBot

from rvsim import load_robot
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.panels.path import PathPanel
from rvsim.gui.path_preview import LAYER as PREVIEW
from rvsim.gui.point_clicks import LAYER, PointClicks
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantity_box import QuantityBox
from rvsim.gui.renderers.painter import PainterRenderer
from rvsim.gui.scene_view import SceneView
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.gui.tracker import PathTracker
from rvsim.lab.lines import default_experiment
from rvsim.scene.work_plane import WorkPlane

LEFT, NONE = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier


class Desk(NamedTuple):
    session: Session
    stage: Stage
    panel: PathPanel
    qtbot: QtBot
    said: list[str]

    @property
    def view(self) -> SceneView:
        return self.stage.view

    @property
    def clicks(self) -> PointClicks:
        assert self.panel.point_clicks is not None
        return self.panel.point_clicks

    @property
    def points(self) -> np.ndarray:
        return self.session.experiment.trajectory.shape.points  # type: ignore[union-attr]

    def choose(self, name: str, data: object) -> None:
        box = self.panel.findChild(QComboBox, name)
        box.setCurrentIndex(box.findData(data))
        box.activated.emit(box.currentIndex())

    def button(self, name: str) -> QPushButton:
        return self.panel.findChild(QPushButton, name)

    def click(self, at: np.ndarray | tuple[float, float], modifiers: Qt.KeyboardModifier = NONE) -> None:
        self.qtbot.mouseClick(self.view, LEFT, modifiers, QPoint(round(at[0]), round(at[1])))

    def click_on(self, place: tuple[float, float, float], modifiers: Qt.KeyboardModifier = NONE) -> None:
        self.click(self.view.camera.project(place, self.view.width(), self.view.height()), modifiers)


@pytest.fixture
def desk(qtbot: QtBot) -> Iterator[Desk]:
    session, preferences = Session(default_experiment(load_robot("rv-m1")), default_experiment), Preferences()
    motion = MotionControl(session, preferences, session)
    tracker = PathTracker(session, motion, session)
    view = SceneView(PainterRenderer)
    view.animated = False
    view.resize(700, 500)
    stage = Stage(session, motion, preferences, view, view)
    panel = PathPanel(session, preferences, tracker, stage)
    for widget in (view, panel):
        qtbot.addWidget(widget)
        widget.show()
    said: list[str] = []
    session.said.connect(lambda text, _level: said.append(text))
    made = Desk(session, stage, panel, qtbot, said)
    made.choose("trajectory_selector", "points")
    yield made
    tracker.close()
    motion.load(None, "")


def test_clicks_begin_a_path_of_ones_own_and_each_is_one_step_of_undo(desk: Desk) -> None:
    desk.button("points_click").click()
    assert "each click adds a point" in desk.said[-1]
    assert desk.clicks.plane == WorkPlane(2, pytest.approx(0.16))
    before = desk.session.undo_stack.count()
    places = [(0.25, -0.1, 0.16), (0.3, 0.0, 0.16), (0.25, 0.1, 0.16)]
    for number, place in enumerate(places, 1):
        desk.click_on(place)
        assert len(desk.points) == number
        assert desk.session.undo_stack.count() == before + number
    np.testing.assert_allclose(desk.points, places, atol=3e-3)  # a pixel is about two millimetres
    np.testing.assert_array_equal(desk.points[:, 2], 0.16)
    assert desk.said[-1].startswith(
        f"Point at x {1e3 * desk.points[2, 0]:.1f}, y {1e3 * desk.points[2, 1]:.1f}, z 160.0 mm"
    )
    assert desk.stage._layers[PREVIEW]
    desk.session.undo_stack.undo()
    assert len(desk.points) == 2


def test_a_drag_turns_the_view_and_a_trembling_or_double_click_is_one_point(desk: Desk) -> None:
    desk.button("points_click").click()
    camera = desk.view.camera
    desk.qtbot.mousePress(desk.view, LEFT, NONE, QPoint(300, 300))
    desk.qtbot.mouseMove(desk.view, QPoint(340, 320))
    desk.qtbot.mouseRelease(desk.view, LEFT, NONE, QPoint(340, 320))
    assert desk.view.camera.azimuth != camera.azimuth
    assert desk.session.experiment.trajectory.shape is None
    camera = desk.view.camera
    desk.qtbot.mousePress(desk.view, LEFT, NONE, QPoint(300, 300))
    desk.qtbot.mouseMove(desk.view, QPoint(302, 301))
    desk.qtbot.mouseRelease(desk.view, LEFT, NONE, QPoint(302, 301))
    desk.qtbot.mouseDClick(desk.view, LEFT, NONE, QPoint(302, 301))
    assert len(desk.points) == 1
    assert desk.view.camera is camera


def test_another_plane_its_place_and_round_numbers_with_ctrl(desk: Desk) -> None:
    desk.button("points_click").click()
    desk.choose("points_plane", 0)
    offset = desk.panel.findChild(QuantityBox, "points_offset")
    offset.setValue(320.0)
    assert desk.clicks.plane == WorkPlane(0, pytest.approx(0.32))
    desk.click_on((0.32, 0.05, 0.25), Qt.KeyboardModifier.ControlModifier)
    np.testing.assert_allclose(desk.points, [(0.32, 0.05, 0.25)], atol=1e-12)
    desk.choose("points_plane", 1)
    assert desk.clicks.plane == WorkPlane(1, pytest.approx(0.05))  # through the last point
    desk.click_on((0.2, 0.05, 0.1), Qt.KeyboardModifier.ControlModifier)
    np.testing.assert_allclose(desk.points[-1], (0.2, 0.05, 0.1), atol=1e-12)
    desk.choose("points_plane", 2)
    assert desk.clicks.plane == WorkPlane(2, pytest.approx(0.1))
    desk.choose("points_plane", 1)
    desk.view.view("top")
    desk.click((350, 250))
    assert "turn the view" in desk.said[-1]
    assert len(desk.points) == 2


def test_esc_the_button_another_shape_or_arm_end_it_and_dragging_the_path_does(desk: Desk) -> None:
    button = desk.button("points_click")

    def begin() -> None:
        desk.button("points_click").click()
        assert desk.clicks.on
        assert desk.view.grabber is desk.clicks

    begin()
    desk.qtbot.keyClick(desk.view, Qt.Key.Key_Escape)
    assert not desk.clicks.on
    assert not button.isChecked()
    begin()
    desk.qtbot.keyClick(button, Qt.Key.Key_Escape)
    assert not desk.clicks.on
    begin()
    button.click()
    assert not desk.clicks.on
    begin()
    assert desk.panel.path_drag is not None
    desk.panel.path_drag.switch(True)
    assert not desk.clicks.on
    desk.button("points_click").click()
    assert desk.clicks.on
    assert not desk.panel.path_drag.on
    desk.view.grabber.hover(None)  # the row of those who listen has an end
    desk.choose("trajectory_selector", "star")
    assert not desk.clicks.on
    desk.choose("trajectory_selector", "points")
    begin()
    desk.session.use_robot(load_robot("ur5e"))
    assert not desk.clicks.on
    assert desk.stage._layers[LAYER] == ()
    camera = desk.view.camera
    desk.click((300, 300))  # nobody listens
    assert desk.view.camera is camera
