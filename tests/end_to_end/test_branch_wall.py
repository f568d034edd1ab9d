"""The branch wall as a person uses it: drag the gizmo, look at the ghosts, take a branch, ask for what cannot be."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtWidgets import QAbstractButton, QApplication, QLabel, QTableView, QWidget
from pytestqt.qtbot import QtBot

from rvsim.gui.app import build_window
from rvsim.gui.main_window import MainWindow
from rvsim.gui.panels.inverse_table import NAME_ROLE
from rvsim.gui.preferences import Preferences
from rvsim.gui.target import Wish
from rvsim.kinematics import forward_kinematics
from rvsim.scene import Labels
from rvsim.scene.gizmo import Handle
from rvsim.spatial import rpy_from_rotation

LEFT, NONE = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
POSES = {
    "ur5e": [0.3, -1.2, 1.4, -0.8, 1.1, 0.2],
    "rv-m1": [0.3, 0.7, -1.0, 0.2, 0.4],
    "rv-1a": [0.3, 0.3, 1.2, 0.4, 0.9, 0.4],
    "al5b": [0.3, 1.0, -1.0, 0.2, 0.4],
    "rrrp": [0.4, 1.2, 0.3, 1.0],
    "scara": [0.4, 0.8, 0.05, 0.3],
    "articulated": [0.3, 0.5, -0.8],
    "planar": [0.3, 0.9],
    "cartesian": [0.2, 0.1, 0.05],
}


@pytest.fixture
def window_of(qtbot: QtBot) -> Callable[[str], MainWindow]:
    """The window with that arm in a regular pose and the Inverse panel in front."""

    def make(name: str) -> MainWindow:
        window = build_window(Preferences(), robot=name)
        window.preferences.set("animated", False)
        qtbot.addWidget(window)
        with qtbot.waitExposed(window):
            window.show()
        window.session.move_to(np.array(POSES[name]), "Go")
        window.docks.show_panel("inverse")
        qtbot.waitUntil(lambda: any(item.key.startswith("gizmo") for item in window.scene_view.scene.items))
        return window

    return make


def tool(window: MainWindow) -> np.ndarray:
    return forward_kinematics(window.session.robot, window.session.q)


def place_of(window: MainWindow, key: str) -> QPointF:
    """A pixel on a handle of the gizmo."""
    gizmo, view = window.gizmo._gizmo(), window.scene_view
    handle: Handle = next(each for each in gizmo.handles if each.key == key)
    items = [item for item in view.scene.items if item.key == f"gizmo.{key}"]
    point = gizmo.origin + 0.9 * gizmo.size * handle.direction
    if handle.kind == "ring":
        point = items[0].points[len(items[0].points) // 3]
    elif handle.kind == "plane":
        point = items[0].points[:4].mean(axis=0)
    elif handle.kind == "free":
        point = gizmo.origin
    x, y, _ = view.camera.project(point, view.width(), view.height())
    return QPointF(x, y)


def move(window: MainWindow, at: QPointF) -> None:
    view = window.scene_view
    event = QMouseEvent(QEvent.Type.MouseMove, at, view.mapToGlobal(at), Qt.MouseButton.NoButton, LEFT, NONE)
    QApplication.sendEvent(view, event)


def drag(qtbot: QtBot, window: MainWindow, key: str, by: tuple[float, float], steps: int = 12) -> list[np.ndarray]:
    """Take a handle and move the pointer by pixels; the joints after each step."""
    view, start = window.scene_view, place_of(window, key)
    move(window, start)
    assert window.gizmo._lit == key
    qtbot.mousePress(view, LEFT, NONE, start.toPoint())
    followed = [window.session.q]
    for step in range(1, steps + 1):
        move(window, start + QPointF(*by) * step / steps)
        qtbot.waitUntil(lambda: window.target._pending is None)
        followed.append(window.session.q)
    qtbot.mouseRelease(view, LEFT, NONE, (start + QPointF(*by)).toPoint())
    qtbot.waitUntil(lambda: not window.stage._stale.isActive())  # all handles are in the scene again
    return followed


def ghosts(window: MainWindow) -> list[str]:
    return [item.key for item in window.scene_view.scene.items if item.key.startswith("ghost")]


def branch_table(window: MainWindow) -> QTableView:
    return window.findChild(QTableView, "branch_table")


@pytest.mark.parametrize(("name", "key", "by"), [
    ("ur5e", "axis z", (0, -40)), ("ur5e", "axis x", (30, 10)), ("ur5e", "plane xy", (-20, 15)),
    ("ur5e", "free free", (25, -25)), ("rv-1a", "axis y", (20, -10)), ("rv-m1", "axis y", (20, -8)),
    ("rv-m1", "axis z", (0, 30)), ("al5b", "axis x", (10, 4)), ("rrrp", "axis z", (0, 20)),
    ("scara", "axis y", (-12, 6)), ("articulated", "axis z", (0, -20)), ("planar", "axis x", (-15, -5)),
    ("cartesian", "plane xy", (-12, 6)),
])  # fmt: skip
def test_the_arm_follows_a_dragged_handle_on_its_branch(qtbot, window_of, name, key, by) -> None:
    window = window_of(name)
    before = tool(window)
    followed = drag(qtbot, window, key, by)
    step = tool(window)[:3, 3] - before[:3, 3]
    kind, name_of_handle = key.split()
    others = [] if kind == "free" else [axis for axis in range(3) if "xyz"[axis] not in name_of_handle]
    assert np.linalg.norm(step) > 1e-3
    np.testing.assert_allclose(step[others], 0.0, atol=1e-8)
    assert np.abs(np.diff(followed, axis=0)).max() < 0.35  # no flip: small steps of the pointer, small ones of the arm
    np.testing.assert_allclose(window.target.T, tool(window), atol=1e-9)


def test_rings_turn_the_tool_in_place(qtbot, window_of) -> None:
    window = window_of("ur5e")
    before = tool(window)
    drag(qtbot, window, "ring z", (30, 0))
    np.testing.assert_allclose(tool(window)[:3, 3], before[:3, 3], atol=1e-9)
    turn = tool(window)[:3, :3] @ before[:3, :3].T
    assert abs(rpy_from_rotation(turn)[2]) > 0.1
    np.testing.assert_allclose(turn[2], (0, 0, 1), atol=1e-9)


def test_a_5_axis_arm_keeps_its_cup_level_and_turns_only_as_it_can(qtbot, window_of) -> None:
    window = window_of("rv-m1")
    before = rpy_from_rotation(tool(window)[:3, :3])
    drag(qtbot, window, "axis y", (25, -10))
    after = rpy_from_rotation(tool(window)[:3, :3])
    np.testing.assert_allclose(after[:2], before[:2], atol=1e-8)
    assert {handle.name for handle in window.gizmo._gizmo().handles if handle.kind == "ring"} == {"pitch", "roll"}
    place = tool(window)[:3, 3]
    pitched = drag(qtbot, window, "ring pitch", (10, 10))
    np.testing.assert_allclose(tool(window)[:3, 3], place, atol=1e-9)
    assert np.ptp(np.array(pitched), axis=0)[3] > 0.01


def test_a_place_only_arm_has_no_rings(window_of) -> None:
    for name, axes in (("articulated", 3), ("planar", 2), ("cartesian", 3)):
        handles = window_of(name).gizmo._gizmo().handles
        assert [handle.kind for handle in handles].count("axis") == axes
        assert all(handle.kind != "ring" for handle in handles)


def test_one_drag_is_one_step_of_undo_and_escape_takes_it_back(qtbot, window_of) -> None:
    window = window_of("ur5e")
    q, count = window.session.q, window.session.undo_stack.count()
    drag(qtbot, window, "axis z", (0, -30))
    drag(qtbot, window, "axis x", (20, 5))
    assert window.session.undo_stack.count() == count + 2
    window.session.undo_stack.undo()
    window.session.undo_stack.undo()
    np.testing.assert_array_equal(window.session.q, q)
    np.testing.assert_allclose(window.target.T, tool(window), atol=1e-12)
    start = place_of(window, "axis z")
    qtbot.mousePress(window.scene_view, LEFT, NONE, start.toPoint())
    move(window, start - QPointF(0, 20))
    qtbot.waitUntil(lambda: window.target._pending is None)
    qtbot.keyClick(window.scene_view, Qt.Key.Key_Escape)
    np.testing.assert_allclose(window.session.q, q, atol=1e-9)


def test_many_moves_of_the_mouse_between_two_frames_are_solved_once(qtbot, window_of) -> None:
    window = window_of("ur5e")
    start, solved = place_of(window, "axis z"), []
    qtbot.mousePress(window.scene_view, LEFT, NONE, start.toPoint())
    window.target.changed.connect(lambda: solved.append(window.session.q))
    for pixels in range(50):
        move(window, start - QPointF(0, 0.5 * pixels))
    assert len(solved) == 0
    qtbot.waitUntil(lambda: window.target._pending is None)
    assert len(solved) == 1
    qtbot.mouseRelease(window.scene_view, LEFT, NONE, (start - QPointF(0, 24.5)).toPoint())


def test_beside_the_gizmo_a_drag_turns_the_view(qtbot, window_of) -> None:
    window = window_of("ur5e")
    view, q = window.scene_view, window.session.q
    azimuth, corner = view.camera.azimuth, QPoint(view.width() - 40, 60)
    qtbot.mousePress(view, LEFT, NONE, corner)
    move(window, QPointF(corner) - QPointF(30, 0))
    qtbot.mouseRelease(view, LEFT, NONE, corner - QPoint(30, 0))
    assert view.camera.azimuth != azimuth
    np.testing.assert_array_equal(window.session.q, q)


def test_arrow_keys_nudge_the_tool_while_the_gizmo_is_there_and_turn_the_view_without_it(qtbot, window_of) -> None:
    window = window_of("ur5e")
    before = tool(window)[:3, 3]
    for key in (Qt.Key.Key_PageUp, Qt.Key.Key_PageUp, Qt.Key.Key_Right):
        qtbot.keyClick(window.scene_view, key)
    window.target.flush()
    step = tool(window)[:3, 3] - before
    assert step[2] == pytest.approx(2e-3, abs=1e-9)
    assert np.abs(step[:2]).max() == pytest.approx(1e-3, abs=1e-9)
    window.actions_by_name["drag_tool"].trigger()
    assert not window.gizmo.on
    azimuth = window.scene_view.camera.azimuth
    qtbot.keyClick(window.scene_view, Qt.Key.Key_Right)
    assert window.scene_view.camera.azimuth != azimuth


def test_the_wall_shows_every_branch_and_the_table_lights_one(qtbot, window_of) -> None:
    window = window_of("ur5e")
    qtbot.waitUntil(lambda: any(key.startswith("ghost") for key in ghosts(window)))
    names = next(item for item in window.scene_view.scene.items if item.key == "ghosts.names")
    assert isinstance(names, Labels)
    assert sorted("".join(label.text for label in names.labels).replace(" ", "")) == list("①②③④⑤⑥⑦⑧")
    table = branch_table(window)
    index = table.model().index(3, 0)
    name = index.data(NAME_ROLE)

    def hovered() -> bool:  # again and again: the rows get their heights when the panel has its width
        for shift in (2, 0):
            qtbot.mouseMove(table.viewport(), table.visualRect(index).center() + QPoint(shift, 0))
        return any(key.startswith(f"ghost{name}.") for key in ghosts(window))

    qtbot.waitUntil(hovered)
    window.findChild(QWidget, "all_ghosts_switch").click()
    qtbot.waitUntil(lambda: all(key.startswith(f"ghost{name}.") for key in ghosts(window) if key != "ghosts.names"))
    window.docks.show_panel("path")
    qtbot.waitUntil(lambda: not ghosts(window))
    assert not window.actions_by_name["drag_tool"].isChecked()


def test_an_unreachable_drag_says_why_when_it_ends_and_the_nearest_can_be_had(qtbot, window_of) -> None:
    window = window_of("rv-m1")
    followed = drag(qtbot, window, "axis z", (0, -330), steps=33)
    sentence = window.findChild(QLabel, "why_not_sentence")
    assert sentence.isVisible()
    limits = window.session.robot.limits
    assert ((np.array(followed) >= limits[:, 0] - 1e-9) & (np.array(followed) <= limits[:, 1] + 1e-9)).all()
    assert window.target.T[2, 3] > tool(window)[2, 3] + 0.01
    qtbot.waitUntil(lambda: "ghost.gap" in ghosts(window))
    accept = window.findChild(QAbstractButton, "accept_nearest_button")
    qtbot.waitUntil(accept.isEnabled)
    qtbot.waitUntil(lambda: any(key.startswith("ghostnearest.") for key in ghosts(window)))
    accept.click()
    q = window.session.q
    assert ((q >= limits[:, 0] - 1e-9) & (q <= limits[:, 1] + 1e-9)).all()
    assert not accept.isVisible()
    window.session.undo_stack.undo()
    assert accept.isVisible()


def test_beyond_its_reach_the_arm_creeps_along_the_edge_and_comes_back_on_its_own_branch(qtbot, window_of) -> None:
    window = window_of("ur5e")
    q, count, begin = window.session.q, window.session.undo_stack.count(), tool(window)
    shown = [q]
    window.session.changed.connect(lambda _, after: shown.append(after.q))
    drag(qtbot, window, "axis x", (-420, 330), steps=60)
    assert window.target.answer.missed
    assert abs(window.target.T[0, 3] - begin[0, 3]) > 0.3
    assert np.abs(np.diff(shown, axis=0)).max() < 0.3
    assert np.linalg.norm(tool(window)[:3, 3] - window.target.T[:3, 3]) < np.linalg.norm(
        begin[:3, 3] - window.target.T[:3, 3]
    )
    qtbot.waitUntil(lambda: window.target.nearest is not None)
    away = np.linalg.norm(tool(window)[:3, 3] - window.target.T[:3, 3])
    assert away == pytest.approx(window.target.nearest.position_error, abs=1e-3)
    assert window.session.undo_stack.count() == count + 1
    window.target.request(Wish(begin, "Drag the tool", "back", creeps=True))
    window.target.settle()
    np.testing.assert_allclose(window.session.q, q, atol=1e-6)
    window.session.undo_stack.undo()
    window.session.undo_stack.undo()
    np.testing.assert_array_equal(window.session.q, q)


def test_escape_brings_a_creeping_arm_back_as_if_nothing_had_been(qtbot, window_of) -> None:
    window = window_of("rv-m1")
    q, count, start = window.session.q, window.session.undo_stack.count(), place_of(window, "axis z")
    qtbot.mousePress(window.scene_view, LEFT, NONE, start.toPoint())
    for pixels in range(0, 330, 30):
        move(window, start - QPointF(0, pixels))
        qtbot.waitUntil(lambda: window.target._pending is None)
    assert window.session.experiment.target is not None
    qtbot.keyClick(window.scene_view, Qt.Key.Key_Escape)
    np.testing.assert_array_equal(window.session.q, q)
    assert window.session.experiment.target is None
    assert window.session.undo_stack.count() == count


def test_t_lays_arrows_and_rings_along_the_tools_own_axes_and_back(qtbot, window_of) -> None:
    window = window_of("ur5e")
    before = tool(window)
    qtbot.keyClick(window.scene_view, Qt.Key.Key_T)
    assert window.gizmo.tool_axes
    qtbot.waitUntil(lambda: not window.stage._stale.isActive())
    drag(qtbot, window, "axis z", (15, -20))
    step = tool(window)[:3, 3] - before[:3, 3]
    assert np.linalg.norm(step) > 1e-3
    np.testing.assert_allclose(np.cross(step, before[:3, 2]), 0.0, atol=1e-9)
    placed = tool(window)
    drag(qtbot, window, "ring x", (20, 10))
    np.testing.assert_allclose(tool(window)[:3, 0], placed[:3, 0], atol=1e-9)
    assert np.abs(tool(window)[:3, :3] - placed[:3, :3]).max() > 0.05
    qtbot.keyClick(window.scene_view, Qt.Key.Key_T)
    np.testing.assert_array_equal(
        [handle.direction for handle in window.gizmo._gizmo().handles if handle.kind == "axis"], np.eye(3)
    )


def test_an_arm_that_keeps_in_a_plane_keeps_the_bases_axes(window_of) -> None:
    window = window_of("planar")
    window.gizmo.set_tool_axes(True)
    arrows = [handle.direction for handle in window.gizmo._gizmo().handles if handle.kind == "axis"]
    np.testing.assert_array_equal(arrows, np.eye(3)[:2])


def test_fit_shows_a_target_however_far_it_was_typed(qtbot, window_of) -> None:
    window = window_of("ur5e")
    view, T = window.scene_view, tool(window)
    camera = view.camera
    T[:3, 3] = (6.0, -4.0, 3.0)
    window.target.set_target(Wish(T, "Target", ""))
    qtbot.waitUntil(lambda: not window.stage._stale.isActive())
    assert view.camera is camera  # nothing moves under the hand
    view.fit()
    x, y, depth = view.camera.project(T[:3, 3], view.width(), view.height())
    assert 0 < x < view.width()
    assert 0 < y < view.height()
    assert depth > 0
    away = view.camera.distance
    window.session.undo_stack.undo()
    qtbot.waitUntil(lambda: not window.stage._stale.isActive())
    view.fit()
    assert view.camera.distance < 0.5 * away


def test_sliders_and_other_arms_take_the_target_along(window_of) -> None:
    window = window_of("ur5e")
    window.joints.findChild(QWidget, "joint_value_1").setValue(40.0)
    np.testing.assert_allclose(window.target.T, tool(window), atol=1e-12)
    window.session.use_robot(window.library["scara"])
    np.testing.assert_allclose(window.target.T, tool(window), atol=1e-12)
    assert branch_table(window).model().rowCount() == 2
