"""The view answers to mouse and keys as a person expects."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QWheelEvent
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from rvsim.files import load_robot
from rvsim.gui.renderers.painter import PainterRenderer
from rvsim.gui.scene_view import SceneView
from rvsim.kinematics import forward_kinematics
from rvsim.scene import PRESETS
from rvsim.scene.build import compose, scene_bounds
from rvsim.scene.camera_moves import dome, same_view
from rvsim.scene.palette import LIGHT

LEFT, RIGHT, NONE, SHIFT = (
    Qt.MouseButton.LeftButton,
    Qt.MouseButton.RightButton,
    Qt.KeyboardModifier.NoModifier,
    Qt.KeyboardModifier.ShiftModifier,
)
ROBOT = load_robot("rv-m1")


@pytest.fixture
def view(qtbot: QtBot) -> SceneView:
    made = SceneView(PainterRenderer)
    qtbot.addWidget(made)
    made.animated = False
    made.resize(640, 480)
    made.set_scene(compose(ROBOT, ROBOT.home, LIGHT))
    with qtbot.waitExposed(made):
        made.show()
    return made


def _drag(view: SceneView, qtbot: QtBot, button: Qt.MouseButton, start: tuple[int, int], end: tuple[int, int],
          modifier: Qt.KeyboardModifier = NONE) -> None:  # fmt: skip
    qtbot.mousePress(view, button, modifier, QPoint(*start))
    qtbot.mouseMove(view, QPoint(*end))
    qtbot.mouseRelease(view, button, modifier, QPoint(*end))


def _all_in_view(view: SceneView) -> bool:
    seen = view.camera.project(dome(scene_bounds(ROBOT)), view.width(), view.height())[:, :2]
    return bool((seen > 0.0).all() and (seen < (view.width(), view.height())).all())


def _wheel(view: SceneView, at: QPointF, notches: int) -> None:
    event = QWheelEvent(at, view.mapToGlobal(at), QPoint(), QPoint(0, 120 * notches), Qt.MouseButton.NoButton, NONE,
                        Qt.ScrollPhase.NoScrollPhase, False)  # fmt: skip
    QApplication.sendEvent(view, event)


def test_a_new_arm_is_wholly_in_view_also_after_a_resize(view: SceneView) -> None:
    assert _all_in_view(view)
    view.resize(300, 500)
    assert _all_in_view(view)


def test_a_left_drag_orbits_and_a_right_or_shifted_one_pans(view: SceneView, qtbot: QtBot) -> None:
    before = view.camera
    _drag(view, qtbot, LEFT, (300, 200), (340, 220))
    assert view.camera.azimuth < before.azimuth
    assert view.camera.elevation > before.elevation
    assert (view.camera.target == before.target).all()
    for button, modifier in ((RIGHT, NONE), (LEFT, SHIFT)):
        before = view.camera
        _drag(view, qtbot, button, (300, 200), (340, 220), modifier)
        moved = view.camera.project(before.target, 640, 480)[:2] - before.project(before.target, 640, 480)[:2]
        np.testing.assert_allclose(moved, (40.0, 20.0), atol=1e-6)
        assert view.camera.azimuth == before.azimuth


def test_after_a_move_by_hand_a_resize_leaves_the_view_alone(view: SceneView, qtbot: QtBot) -> None:
    _drag(view, qtbot, LEFT, (300, 200), (340, 220))
    before = view.camera
    view.resize(500, 500)
    assert view.camera is before


def test_the_wheel_zooms_at_the_pointer(view: SceneView) -> None:
    at = QPointF(400.0, 150.0)
    before = view.camera
    _wheel(view, at, 2)
    origin, direction = before.ray(at.x(), at.y(), 640, 480)
    under = origin + direction * before.distance / -(direction @ before.axes[2])  # on the plane of the target
    np.testing.assert_allclose(view.camera.project(under, 640, 480)[:2], (at.x(), at.y()), atol=1e-6)
    assert view.camera.distance < before.distance


def test_a_double_click_centres_on_what_is_under_the_pointer(view: SceneView, qtbot: QtBot) -> None:
    tool = forward_kinematics(ROBOT, ROBOT.home)[:3, 3]
    x, y, _ = view.camera.project(tool, 640, 480)
    qtbot.mouseDClick(view, LEFT, NONE, QPoint(round(x), round(y)))
    assert np.linalg.norm(view.camera.target - tool) < 0.1


def test_a_drawn_box_fills_the_view_once(view: SceneView, qtbot: QtBot) -> None:
    before = view.camera
    view.begin_box_zoom()
    plain = view.grab().toImage()
    qtbot.mousePress(view, LEFT, NONE, QPoint(280, 210))
    qtbot.mouseMove(view, QPoint(360, 270))
    assert view.grab().toImage().pixelColor(300, 230) != plain.pixelColor(300, 230)  # the box is seen while it is drawn
    qtbot.mouseRelease(view, LEFT, NONE, QPoint(360, 270))
    assert view.camera.distance == pytest.approx(before.distance / 8.0)
    zoomed = view.camera
    _drag(view, qtbot, LEFT, (300, 200), (340, 220))  # the next drag orbits again
    assert view.camera.azimuth != zoomed.azimuth


def test_escape_gives_the_box_up(view: SceneView, qtbot: QtBot) -> None:
    view.begin_box_zoom()
    assert view.cursor().shape() == Qt.CursorShape.CrossCursor
    qtbot.keyClick(view, Qt.Key.Key_Escape)
    assert view.cursor().shape() == Qt.CursorShape.ArrowCursor


def test_keys_turn_pan_zoom_and_frame(view: SceneView, qtbot: QtBot) -> None:
    framed = view.camera
    qtbot.keyClick(view, Qt.Key.Key_Left)
    assert view.camera.azimuth < framed.azimuth
    qtbot.keyClick(view, Qt.Key.Key_Plus)
    assert view.camera.distance < framed.distance
    qtbot.keyClick(view, Qt.Key.Key_Up, SHIFT)
    assert (view.camera.target != framed.target).any()
    qtbot.keyClick(view, Qt.Key.Key_Right)
    qtbot.keyClick(view, Qt.Key.Key_F)
    np.testing.assert_allclose(view.camera.target, framed.target, atol=1e-9)


@pytest.mark.parametrize("name", PRESETS)
def test_named_views_look_from_there_and_show_everything(view: SceneView, name: str) -> None:
    view.view(name)
    assert (view.camera.azimuth, view.camera.elevation) == PRESETS[name]
    assert _all_in_view(view)


def test_an_animated_move_ends_where_the_unanimated_one_does(view: SceneView, qtbot: QtBot) -> None:
    view.view("top")
    goal = view.camera
    view.view("iso")
    view.animated = True
    view.view("top")
    assert not same_view(view.camera, goal)
    qtbot.waitUntil(lambda: same_view(view.camera, goal))


def test_the_projection_can_be_switched_and_back(view: SceneView) -> None:
    before = view.camera
    view.set_orthographic(True)
    assert view.camera.orthographic
    view.set_orthographic(False)
    assert same_view(view.camera, before)


def test_nothing_is_emitted_when_nothing_changed(view: SceneView, qtbot: QtBot) -> None:
    with qtbot.assertNotEmitted(view.camera_changed):
        view.set_camera(replace(view.camera))
        view.set_orthographic(False)
        view.fit()
        view.set_scene(compose(ROBOT, ROBOT.home + 0.1, LIGHT))


def test_an_arm_of_another_size_is_framed_anew(view: SceneView) -> None:
    before = view.camera.distance
    other = load_robot("ur5e")
    view.set_scene(compose(other, other.home, LIGHT))
    assert view.camera.distance > 1.3 * before


def test_each_frame_tells_its_time(view: SceneView, qtbot: QtBot) -> None:
    with qtbot.waitSignal(view.painted) as painted:
        view.set_scene(compose(ROBOT, ROBOT.home + 0.1, LIGHT))
    assert painted.args[0] > 0.0


def test_the_renderer_leaves_the_mouse_to_the_view(view: SceneView) -> None:
    assert view.renderer.widget().testAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
    assert view.childAt(320, 240) is None
    assert view.accessibleName()


def test_fit_shows_what_is_drawn_beyond_the_reach_of_the_arm(view: SceneView) -> None:
    far = np.array([[0.0, 0.0, 3.0], [2.0, 0.0, 0.5]])
    view.set_outliers(lambda: far)
    view.fit()
    x, y, _ = view.camera.project(far, view.width(), view.height()).T
    assert ((x >= 0.0) & (x <= view.width()) & (y >= 0.0) & (y <= view.height())).all()
