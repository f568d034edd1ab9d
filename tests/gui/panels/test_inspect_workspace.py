"""The workspace page: sampling beside the window, the old map until the new one is there, nothing left behind."""

from __future__ import annotations

import threading

import numpy as np
import pytest
import shiboken6
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFileDialog, QWidget

from rvsim.files import load_robot
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.panels.inspect_workspace import WorkspacePage
from rvsim.gui.panels.inspect_workspace_words import FIGURES, Values, cloud_shares, values_of
from rvsim.gui.renderers.choose import Choice, renderer_factory
from rvsim.gui.scene_view import SceneView
from rvsim.gui.stage import Stage
from rvsim.gui.widgets import column_of, select
from rvsim.kinematics import forward_kinematics


@pytest.fixture
def page_of(session_with, preferences, shown, qtbot):
    """The page of an arm, with few poses so that it is quick."""
    made: list[WorkspacePage] = []

    def make(name: str) -> WorkspacePage:
        session = session_with(name)
        view = SceneView(renderer_factory(Choice("painter", "for a test", "")))
        qtbot.addWidget(view)
        motion = MotionControl(session, preferences)
        page = WorkspacePage(session, preferences, Stage(session, motion, preferences, view))
        page.drawn = []
        page.draw = page.drawn.append
        host = QWidget()
        column_of(host, page)
        make.kept.append((host, motion, view))
        shown(host)
        page.set_seen(True)
        page.poses.addItem("a few", 20_000)
        select(page.poses, 20_000)
        made.append(page)
        return page

    make.made, make.kept = made, []
    yield make
    for page in made:
        page.close_worker()


def sampled(page: WorkspacePage, qtbot) -> WorkspacePage:
    with qtbot.waitSignal(page.worker.done, timeout=20_000):
        qtbot.mouseClick(page.sample, Qt.MouseButton.LeftButton)
    return page


def test_before_the_first_map_the_page_says_what_to_do(page_of) -> None:
    page = page_of("rv-m1")
    assert "press Sample" in page.state.text()
    assert not page.save_csv.isEnabled()
    assert not page.cancel.isEnabled()


def test_sample_fills_map_scale_and_scene(page_of, qtbot) -> None:
    page = sampled(page_of("rv-m1"), qtbot)
    plot, bar = page._drawn()
    assert plot.cells.image is not None
    assert "√det(JᵀJ)" in bar.accessibleName()
    assert "20,000 poses" in page.state.text()
    assert "exact" in page.place.text()
    keys = [item.key for item in page.drawn[-1]]
    assert {"workspace.side", "workspace.top", "workspace.cloud.0"} <= set(keys)
    assert page.sample.isEnabled()
    assert page.save_csv.isEnabled()


def test_the_tool_is_marked_where_it_is(page_of, qtbot) -> None:
    page = sampled(page_of("rv-m1"), qtbot)
    session = page._session
    session.move_to(np.radians([0.0, 30.0, -50.0, 10.0, 0.0]), "Move")
    x, _, z = forward_kinematics(session.robot, session.q)[:3, 3]
    (mark,) = page._plot.tool.points()
    assert (mark.pos().x(), mark.pos().y()) == pytest.approx((1e3 * x, 1e3 * z))
    page._preferences.set("length_unit", "m")
    (mark,) = page._plot.tool.points()
    assert (mark.pos().x(), mark.pos().y()) == pytest.approx((x, z))


def test_a_cancelled_map_never_comes_and_the_old_one_stays(page_of, qtbot) -> None:
    page = sampled(page_of("ur5e"), qtbot)
    old = page.survey
    page.poses.addItem("very many", 10**12)
    select(page.poses, 10**12)
    with qtbot.waitSignal(page.worker.part, timeout=20_000):
        page.start()
    assert page.cancel.isEnabled()
    assert not page.sample.isEnabled()
    qtbot.mouseClick(page.cancel, Qt.MouseButton.LeftButton)
    assert not page.worker.busy
    assert page.survey is old
    select(page.poses, 20_000)
    sampled(page, qtbot)
    assert page.survey is not old


def test_branches_are_counted_once_they_are_asked_for(page_of, qtbot) -> None:
    page = sampled(page_of("ur5e"), qtbot)
    page.colors.setCurrentIndex(page.colors.findData("branches"))
    assert "Sample again" in page.state.text()
    sampled(page, qtbot)
    assert page.section.branches is not None
    assert "branches" in page._bar.accessibleName()


def test_maps_and_cloud_have_one_scale(page_of, qtbot) -> None:
    page = page_of("rv-m1")
    select(page.colors, "branches")
    survey = sampled(page, qtbot).survey
    result = survey.workspace
    for color in ("branches", "manipulability"):
        largest = {values_of(survey, section, color).largest for section in (result.side, result.top)}
        assert len(largest) == 1
        assert 0.0 <= cloud_shares(survey, color).min() <= cloud_shares(survey, color).max() <= 1.0


def test_with_the_tool_held_no_poses_are_sampled(page_of, qtbot) -> None:
    page = page_of("ur5e")
    page.orientations.setCurrentIndex(page.orientations.findData("fixed"))
    assert not page.poses.isEnabled()
    sampled(page, qtbot)
    assert page.state.text().startswith("Every cell asked")


def test_what_an_arm_cannot_do_is_greyed_out_with_the_reason(page_of) -> None:
    page = page_of("articulated")
    row = page.orientations.findData("fixed")
    assert not page.orientations.model().item(row).isEnabled()
    assert "cannot hold" in page.orientations.itemData(row, Qt.ItemDataRole.ToolTipRole)


@pytest.mark.parametrize("name", sorted(FIGURES))
def test_a_textbook_arm_names_its_classic_figure(page_of, name: str) -> None:
    page = page_of(name)
    assert "source 004" in page.figure.text()
    assert page.figure.isVisible()


def test_another_arm_begins_anew(page_of, qtbot) -> None:
    page = sampled(page_of("rv-m1"), qtbot)
    page._session.use_robot(load_robot("ur5e"))
    assert page.survey is None
    assert page.drawn[-1] == ()
    assert "press Sample" in page.state.text()


def test_the_scene_is_left_alone_if_the_student_wants_so(page_of, qtbot) -> None:
    page = sampled(page_of("cylindrical"), qtbot)
    page.in_scene.setChecked(False)
    assert page.drawn[-1] == ()
    page.in_scene.setChecked(True)
    assert page.drawn[-1]
    page.set_seen(False)
    assert page.drawn[-1] == ()


def test_a_map_is_saved_as_table_and_picture(page_of, qtbot, tmp_path, monkeypatch) -> None:
    page = sampled(page_of("rv-m1"), qtbot)
    for button, file in ((page.save_csv, tmp_path / "map.csv"), (page.save_png, tmp_path / "map.png")):
        monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_, file=file: (str(file), ""))
        qtbot.mouseClick(button, Qt.MouseButton.LeftButton)
    head, *rows = (tmp_path / "map.csv").read_text(encoding="utf-8").splitlines()
    assert head == "x_mm,y_mm,z_mm,manipulability,branches"
    assert len(rows) == page.section.reached.sum()
    places = np.array([[float(value) for value in row.split(",")[:3]] for row in rows])
    assert np.linalg.norm(places - (0.0, 0.0, 152.0), axis=1).max() < 482.0 + 1e3 * page.section.grid.cell
    assert (tmp_path / "map.png").stat().st_size > 1000


def test_the_picture_of_a_map_has_a_colour_for_each_cell_that_is_reached() -> None:
    from rvsim.gui.panels.inspect_workspace_map import map_image

    reached = np.array([[True, False], [True, True]])
    counts = Values(np.array([[1.0, np.nan], [4.0, 4.0]]), 4.0, "branches", whole=True)
    image = map_image(counts, reached, dark=False)
    assert image[..., 3].astype(bool).tolist() == reached.tolist()
    assert image[1, 0].tolist() == image[1, 1].tolist() != image[0, 0].tolist()


def test_nothing_is_left_behind_when_the_page_goes_while_it_works(page_of, qtbot) -> None:
    page = page_of("ur5e")
    page.poses.addItem("very many", 10**12)
    select(page.poses, 10**12)
    with qtbot.waitSignal(page.worker.part, timeout=20_000):
        page.start()
    page.close_worker()
    assert not any(thread.name == "rvsim-worker" for thread in threading.enumerate())


def test_a_page_that_is_destroyed_while_it_works_takes_its_thread_along(page_of, qtbot) -> None:
    page = page_of("ur5e")
    page.poses.addItem("very many", 10**12)
    select(page.poses, 10**12)
    with qtbot.waitSignal(page.worker.part, timeout=20_000):
        page.start()
    shiboken6.delete(page)  # without close_worker
    page_of.made.clear()
    assert not any(thread.name == "rvsim-worker" for thread in threading.enumerate())


def ask(page: WorkspacePage, *point: float) -> str:
    page.query.ask(np.array(point))
    return page.query.answer.text()


def test_a_place_is_asked_for_in_three_boxes_and_answered_by_the_closed_form(page_of) -> None:
    page = page_of("articulated")
    robot, q = page._session.robot, page._session.q
    np.testing.assert_allclose(page.query.place.values, forward_kinematics(robot, q)[:3, 3])
    reached = forward_kinematics(robot, np.array([0.2, 0.4, -1.0]))[:3, 3]
    assert ask(page, *reached).startswith("Yes: ")
    assert "branch" in page.query.answer.text()
    far = ask(page, 10.0 * robot.size, 0.0, 0.0)
    assert far.startswith("No: the tool comes no nearer than ")
    page.query.at_tool.click()
    np.testing.assert_allclose(page.query.place.values, forward_kinematics(robot, q)[:3, 3])


def test_the_answer_obeys_the_limits_that_are_chosen(page_of) -> None:
    page = page_of("rv-m1")
    beyond = forward_kinematics(page._session.robot, np.radians([170.0, 20.0, -40.0, 0.0, 0.0]))[:3, 3]
    assert ask(page, *beyond).startswith("No")
    page.limits.setCurrentIndex(page.limits.findData("ignored"))
    assert page.query.answer.text().startswith("Yes")


def test_an_arm_in_a_plane_reaches_nothing_beside_it(page_of) -> None:
    page = page_of("planar")
    x, y, z = forward_kinematics(page._session.robot, page._session.q)[:3, 3]
    assert ask(page, x, y, z).startswith("Yes")
    assert "outside of it" in ask(page, x, y, z + 1.0)


def test_the_pointer_on_the_map_tells_its_place_and_a_click_asks_for_it(page_of, qtbot) -> None:
    page = sampled(page_of("rv-m1"), qtbot)
    page._plot.pointed.emit(0.3, 0.2)
    assert page.pointed.text() == "x 300.0, y 0.0, z 200.0 mm"
    page._plot.clicked.emit(0.3, 0.2)
    np.testing.assert_allclose(page.query.place.values, [0.3, 0.0, 0.2], atol=1e-12)
    page._plot.pointed.emit(float("nan"), float("nan"))
    assert page.pointed.text().startswith("Point at the map")


def test_a_click_on_the_map_of_another_arm_asks_nothing(page_of, qtbot) -> None:
    page = sampled(page_of("rv-m1"), qtbot)
    page._session.use_robot(load_robot("ur5e"))
    assert page.section is None
    page._plot.clicked.emit(0.1, 0.1)
    assert page.section is None
