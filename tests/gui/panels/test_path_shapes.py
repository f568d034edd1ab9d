"""Shapes in the Path panel, used as a person does: chosen, changed, moved, timed, tracked."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QComboBox, QLabel, QLineEdit, QPushButton, QTableView
from pytestqt.qtbot import QtBot

from rvsim import load_robot
from rvsim.experiment.shapes import FormulaShape, PointsShape
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.panels.path import PathPanel
from rvsim.gui.path_drag import SIZE
from rvsim.gui.path_preview import LAYER
from rvsim.gui.quantity_box import QuantityBox
from rvsim.gui.renderers.painter import PainterRenderer
from rvsim.gui.scene_view import SceneView
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.gui.tracker import PathTracker
from rvsim.lab import drawings
from rvsim.lab.shape_paths import placement_of, plane_normal
from rvsim.scene.gizmo import take_hold
from rvsim.scene.primitives import Polyline
from rvsim.spatial import rotation_from_rpy, transform


class Desk(NamedTuple):
    session: Session
    tracker: PathTracker
    motion: MotionControl
    stage: Stage
    panel: PathPanel

    def choose(self, name: str, data: object) -> None:
        box = self.panel.findChild(QComboBox, name)
        box.setCurrentIndex(box.findData(data))
        box.activated.emit(box.currentIndex())

    def click(self, name: str) -> None:
        self.panel.findChild(QPushButton, name).click()

    def type(self, name: str, text: str) -> None:
        line = self.panel.findChild(QLineEdit, name)
        line.setText(text)
        line.textEdited.emit(text)
        line.editingFinished.emit()

    def track(self) -> None:
        self.click("track_trajectory_button")

    @property
    def task(self):
        return self.session.experiment.trajectory

    @property
    def reach(self) -> str:
        return self.panel.findChild(QLabel, "reach_label").text()

    def lines(self, layer: str) -> list[Polyline]:
        return [item for item in self.stage._layers.get(layer, ()) if isinstance(item, Polyline)]


@pytest.fixture
def desk_of(session_with, preferences, shown, qtbot: QtBot) -> Iterator:
    made = []

    def make(arm: str) -> Desk:
        session = session_with(arm)
        motion = MotionControl(session, preferences, session)
        tracker = PathTracker(session, motion, session)
        view = SceneView(PainterRenderer)
        qtbot.addWidget(view)
        view.resize(600, 500)
        stage = Stage(session, motion, preferences, view, view)
        made.append(Desk(session, tracker, motion, stage, shown(PathPanel(session, preferences, tracker, stage))))
        return made[-1]

    yield make
    for desk in made:
        desk.tracker.close()
        desk.motion.load(None, "")


@pytest.mark.parametrize("arm", ["rv-m1", "ur5e", "al5b"])
def test_a_star_is_drawn_whole_with_rest_at_its_tips(desk_of, arm: str) -> None:
    desk = desk_of(arm)
    desk.choose("trajectory_selector", "star")
    assert desk.reach == "100 % within limits"
    desk.track()
    tracking, trajectory = desk.session.tracking, desk.tracker.trajectory
    assert tracking.complete
    assert tracking.path.corners.tolist() == [20, 40, 60, 80]
    times = [np.interp(tip, *_index_times(trajectory)) for tip in tracking.path.corners]
    np.testing.assert_allclose(trajectory.at(times).qd, 0.0, atol=1e-6)


def _index_times(trajectory) -> tuple[list[float], list[float]]:
    ends = trajectory.starts[1:].tolist()
    return [stretch.progress[-1] for stretch in trajectory.stretches], ends


@pytest.mark.parametrize("arm", ["rv-m1", "ur5e", "al5b"])
def test_a_name_is_written_with_the_pen_lifted_between_strokes(desk_of, arm: str) -> None:
    desk = desk_of(arm)
    desk.choose("trajectory_selector", "text")
    desk.type("shape_text", "RV")
    drawn = desk.lines(LAYER)
    assert {line.dashed for line in drawn} == {True, False}
    assert {line.width for line in drawn if line.dashed} == {1.0}
    desk.track()
    tracking = desk.session.tracking
    assert tracking.complete
    assert tracking.path.pen_up is not None
    assert tracking.path.points[tracking.path.pen_up, 2].max() > tracking.path.points[~tracking.path.pen_up, 2].max()
    desk.motion.seek(desk.motion.player.duration)
    trail = desk.stage._trail_now()
    assert len(trail) == 5  # three strokes of the R, two of the V
    assert desk.lines(LAYER) == []


def test_numbers_are_undone_one_by_one_and_each_kind_has_its_own(desk_of) -> None:
    desk = desk_of("rv-m1")
    stack = desk.session.undo_stack
    desk.choose("trajectory_selector", "polygon")
    desk.panel.findChild(QuantityBox, "shape_radius").setValue(40.0)
    desk.panel.trajectory._editor._boxes["corners"].setValue(5)
    assert (desk.task.shape.radius, desk.task.shape.corners) == (pytest.approx(0.04), 5)
    desk.choose("trajectory_selector", "circle")
    assert "corners" not in desk.panel.trajectory._editor._boxes
    for _ in range(2):
        stack.undo()
    assert desk.task.shape.corners == 6
    assert desk.panel.findChild(QuantityBox, "shape_radius").value() == pytest.approx(40.0)


def test_formulas_of_source_003_and_one_that_does_not_work(desk_of) -> None:
    desk = desk_of("rrrp")
    desk.choose("trajectory_selector", "formulas")
    np.testing.assert_allclose(desk.panel.preview.path.points, drawings.spiral(), rtol=0, atol=1e-12)
    count = desk.session.undo_stack.count()
    desk.type("stage2_y", "4 + cso(t)")
    problem = desk.panel.findChild(QLabel, "formula_problem")
    assert not problem.isHidden()
    assert "Stage 2, y" in problem.text()
    assert "no function “cso”" in problem.text()
    assert desk.session.undo_stack.count() == count
    desk.type("stage2_y", "4 + cos(t)")
    assert problem.isHidden()
    assert isinstance(desk.task.shape, FormulaShape)
    assert desk.task.shape.stages[1].y == "4 + cos(t)"
    desk.click("stage_add")
    assert len(desk.task.shape.stages) == 3
    desk.click("stage3_remove")
    assert len(desk.task.shape.stages) == 2


def test_points_are_typed_pasted_ordered_and_taken_out(desk_of) -> None:
    desk = desk_of("rv-m1")
    desk.choose("trajectory_selector", "points")
    table = desk.panel.findChild(QTableView, "path_points_table")
    model = table.model()
    table.selectRow(0)
    assert model.setData(model.index(0, 1), "25 cm")
    assert model.data(model.index(0, 1)) == "250.0"
    QGuiApplication.clipboard().setText("x\ty\tz\n300\t10,5\t150\n310\t0\t150\n")
    desk.click("points_paste")
    assert isinstance(desk.task.shape, PointsShape)
    np.testing.assert_allclose(desk.task.shape.points[1:3], [[0.3, 0.0105, 0.15], [0.31, 0.0, 0.15]])
    desk.click("points_up")
    np.testing.assert_allclose(desk.task.shape.points[1], [0.31, 0.0, 0.15])
    desk.click("points_delete")
    np.testing.assert_allclose(desk.task.shape.points[1], [0.3, 0.0105, 0.15])
    QGuiApplication.clipboard().setText("a;b;c\n1;2;3")
    before = desk.task
    desk.click("points_paste")
    assert desk.task is before
    assert "The clipboard: row 1" in desk.session.sentences[-1][0]
    desk.choose("points_join", "closed")
    desk.track()
    path = desk.session.tracking.path
    assert np.array_equal(path.points[0], path.points[-1])


def test_a_file_becomes_a_table_and_a_bad_one_is_told_of(desk_of, tmp_path) -> None:
    desk = desk_of("rv-m1")
    good, bad = tmp_path / "way.csv", tmp_path / "bad.csv"
    good.write_text("x,y,z\n300,0,200\n300,50,200\n310,50,200\n")
    bad.write_text("x,y,z\n300,zero,200\n")
    desk.panel.trajectory.load_file(str(good))
    assert desk.task.name == "points"
    assert desk.panel.findChild(QComboBox, "trajectory_selector").currentData() == "points"
    np.testing.assert_allclose(desk.panel.preview.path.points[1], [0.3, 0.05, 0.2])
    desk.panel.trajectory.load_file(str(bad))
    assert "row 2, column 2" in desk.session.sentences[-1][0]


def test_another_law_or_time_times_again_without_solving(desk_of) -> None:
    desk = desk_of("rv-m1")
    desk.choose("trajectory_selector", "star")
    desk.track()
    tracking, calm = desk.session.tracking, desk.motion.player.duration
    desk.choose("path_time", "quick")
    quick = desk.motion.player.duration
    desk.choose("path_law", "quickest")
    assert desk.motion.player.duration < quick < calm
    assert desk.session.tracking is tracking
    for _ in range(2):
        desk.session.undo_stack.undo()
    assert desk.motion.player.duration == pytest.approx(calm, rel=0.5)
    desk.choose("path_time", "seconds")
    desk.panel.findChild(QuantityBox, "path_seconds").setValue(60.0)
    assert desk.session.experiment.path_seconds == 60.0
    trajectory = desk.tracker.trajectory
    assert trajectory.duration - trajectory.path_start >= 60.0


def test_a_path_out_of_reach_says_how_much_of_it_is_not(desk_of, qtbot: QtBot) -> None:
    desk = desk_of("rv-m1")
    desk.choose("trajectory_selector", "star")
    desk.panel.findChild(QuantityBox, "path_scale").setValue(2.0)
    share = desk.panel.preview.reach.share
    assert 0.0 < share < 1.0
    assert desk.reach == f"{int(100 * share)} % within limits"
    assert any(line.dashed for line in desk.lines(LAYER))
    desk.track()
    assert desk.session.tracking.reached_count / 101 == share
    qtbot.waitUntil(lambda: not desk.tracker.search.busy)
    desk.click("repair_scale")
    assert desk.session.tracking.complete


def test_a_shape_is_seen_before_it_is_tracked_beside_a_tracked_line_too(desk_of) -> None:
    desk = desk_of("ur5e")
    assert desk.lines(LAYER) == []
    desk.panel.line.button.click()
    desk.choose("trajectory_selector", "star")
    assert desk.lines(LAYER)
    assert desk.session.tracking is not None
    desk.panel.line.button.click()
    assert desk.lines(LAYER) == []


def held(desk: Desk, key: str) -> tuple[QPointF, QPointF]:
    """Where a handle's tip is in the picture, and the way to it from the middle."""
    gizmo, view = desk.panel.path_drag._gizmo(), desk.stage.view
    handle = next(handle for handle in gizmo.handles if handle.key == key)
    ends = gizmo.origin + gizmo.size * np.array([[0.0], [0.9]]) * handle.direction
    start, end = view.camera.project(ends, view.width(), view.height())[:, :2].tolist()
    return QPointF(*end), QPointF(*end) - QPointF(*start)


def test_a_path_is_dragged_and_scaled_in_the_scene_in_one_undo_step_each(desk_of) -> None:
    desk = desk_of("ur5e")
    desk.choose("trajectory_selector", "star")
    desk.click("path_move_button")
    drag, none = desk.panel.path_drag, Qt.KeyboardModifier.NoModifier
    assert desk.stage.view.grabber is drag
    stack, count = desk.session.undo_stack, desk.session.undo_stack.count()
    before = placement_of(desk.session.robot, desk.task)
    for key in ("axis y", f"axis {SIZE}"):
        at, way = held(desk, key)
        assert drag.press(at)
        for share in (0.1, 0.3, 0.5):
            drag.drag(at + share * way, none)
        drag.release()
    after = desk.task.placement
    assert stack.count() == count + 2
    np.testing.assert_allclose((after.center - before.center)[[0, 2]], 0.0, atol=1e-12)
    assert after.center[1] > before.center[1]
    assert after.scale > 1.2
    at, way = held(desk, "axis y")
    drag.press(at)
    drag.drag(at + way, none)
    assert drag.key(Qt.Key.Key_Escape, none, False)
    np.testing.assert_allclose(placement_of(desk.session.robot, desk.task).center, after.center)
    desk.click("path_move_button")
    assert desk.stage.view.grabber is None
    desk.click("path_place_reset")
    assert desk.task.placement is None


def test_a_held_path_is_not_carried_over_to_another_arm(desk_of) -> None:
    desk = desk_of("ur5e")
    desk.choose("trajectory_selector", "star")
    desk.click("path_move_button")
    drag, none = desk.panel.path_drag, Qt.KeyboardModifier.NoModifier
    at, way = held(desk, "axis y")
    drag.press(at)
    desk.session.use_robot(load_robot("rv-m1"))
    task = desk.task
    drag.drag(at + way, none)
    assert drag.key(Qt.Key.Key_Escape, none, False)
    assert desk.task is task


def test_the_table_of_points_says_why_not_and_goes_there(desk_of) -> None:
    desk = desk_of("rv-m1")
    desk.choose("trajectory_selector", "star")
    desk.panel.findChild(QuantityBox, "path_scale").setValue(2.0)
    desk.track()
    tracking = desk.session.tracking
    desk.click("path_points_button")
    table = desk.panel.findChild(QTableView, "tracked_points_table")
    assert table.model().rowCount() == 101
    missed, reached = tracking.unreached[0], int(np.flatnonzero(tracking.reached)[7])
    assert "needed, limit" in table.model().index(missed.index, 4).data() or missed.kind == "reach"
    table.selectRow(reached)
    np.testing.assert_array_equal(desk.session.q, tracking.q[reached])
    table.selectRow(missed.index)
    assert f"Point {missed.index + 1} was not reached" in desk.session.sentences[-1][0]
    desk.panel.findChild(QuantityBox, "path_scale").setValue(1.0)
    assert table.model().rowCount() == 0
    desk.panel.result._table.close()


def test_the_tool_is_normal_to_a_tilted_plane_where_the_arm_can_and_else_it_is_said(desk_of) -> None:
    for arm, said in (("ur5e", ""), ("al5b", "from the normal, the nearest it can")):
        desk = desk_of(arm)
        desk.choose("trajectory_selector", "star")
        desk.choose("trajectory_orientation", "normal")
        box = desk.panel.findChild(QuantityBox, "path_turn_roll")
        box.setValue(20.0)
        assert said in desk.reach
        assert ("normal" in desk.reach) == bool(said)


def shown_plane(desk: Desk) -> str:
    return desk.panel.findChild(QComboBox, "path_plane").currentData()


def test_a_plane_is_a_click_and_the_handles_in_the_scene_turn_it_too(desk_of) -> None:
    desk = desk_of("ur5e")
    desk.choose("trajectory_selector", "star")
    rows, undo = desk.panel.trajectory.lies, desk.session.undo_stack
    assert shown_plane(desk) == "level"
    assert rows.turn.isHidden()
    desk.choose("path_plane", "facing")
    np.testing.assert_allclose(np.ptp(desk.panel.preview.path.points[:, 0]), 0.0, atol=1e-12)
    assert "Normal to the plane" in desk.session.sentences[-1][0]
    assert undo.undoText() == "Upright, facing the arm"
    drag = desk.panel.path_drag
    drag.switch(True)
    handle = next(handle for handle in drag._gizmo().handles if handle.kind == "ring" and handle.name == "x")
    drag._began = desk.session.experiment, placement_of(desk.session.robot, desk.task)
    turned = rotation_from_rpy(drag._began[1].rpy) @ rotation_from_rpy((0.3, 0.0, 0.0))
    drag._grip = take_hold(drag._gizmo(), handle, drag._ray(QPointF(300, 200)))
    drag._put(drag._placement(transform(turned, drag._began[1].center), drag._began[1]))
    assert shown_plane(desk) == "tilted"
    assert not rows.turn.isHidden()
    drag.switch(False)
    desk.choose("path_plane", "level")
    assert shown_plane(desk) == "level"
    np.testing.assert_allclose(np.ptp(desk.panel.preview.path.points[:, 2]), 0.0, atol=1e-12)
    undo.undo()
    assert shown_plane(desk) == "tilted"


def test_a_plane_is_given_by_its_normal_or_by_three_points_also_of_the_tool(desk_of) -> None:
    desk = desk_of("rv-m1")
    desk.choose("trajectory_selector", "circle")
    rows = desk.panel.trajectory.lies
    desk.choose("path_plane", "normal")
    desk.panel.findChild(QuantityBox, "path_normal_x").setValue(-1.0)
    np.testing.assert_allclose(
        plane_normal(desk.session.robot, desk.task), (-np.sqrt(0.5), 0.0, np.sqrt(0.5)), atol=1e-9
    )
    np.testing.assert_allclose(rows.normal.values, (-1.0, 0.0, 1.0))  # as typed
    for axis in "xz":
        desk.panel.findChild(QuantityBox, f"path_normal_{axis}").setValue(0.0)
    assert "needs a length" in desk.session.sentences[-1][0]
    desk.choose("path_plane", "points")
    for number, point in enumerate(((300, 0, 100), (300, 100, 100), (300, 0, 200)), 1):
        for axis, value in zip("xyz", point, strict=True):
            desk.panel.findChild(QuantityBox, f"plane_point_{number}_{axis}").setValue(float(value))
    np.testing.assert_allclose(plane_normal(desk.session.robot, desk.task), (1.0, 0.0, 0.0), atol=1e-9)
    where = placement_of(desk.session.robot, desk.task)
    np.testing.assert_allclose(where.center, (0.3, 0.1 / 3, 0.4 / 3), atol=1e-9)
    desk.click("plane_take_3")
    assert desk.panel.findChild(QuantityBox, "plane_point_3_x").value() == pytest.approx(482.0)
    desk.panel.findChild(QuantityBox, "plane_point_3_x").setValue(300.0)
    desk.panel.findChild(QuantityBox, "plane_point_3_z").setValue(100.0)
    assert "lie on a line" in desk.session.sentences[-1][0]


def test_what_is_no_flat_shape_has_no_plane_to_choose(desk_of) -> None:
    desk = desk_of("rv-m1")
    rows = desk.panel.trajectory.lies
    for name, label in (("letter-board", "Turned"), ("formulas", "Turned"), ("points", ""), ("star", "Plane")):
        desk.choose("trajectory_selector", name)
        assert rows.label == label
        assert rows.choice.isHidden() == (label != "Plane")
        assert rows.isHidden() == (not label)
