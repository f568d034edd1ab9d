"""The sources page shows what is printed, ours and the difference at the arm's pose, and where the source leads."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QComboBox, QLabel, QListWidget, QPushButton

from rvsim import forward_kinematics, load_robot, robot_names
from rvsim.gui.formula import typeset
from rvsim.gui.panels.inspect_source import SourcePage
from rvsim.gui.panels.inspect_source_grid import Grid
from rvsim.lab.sources import errata, erratum_of
from rvsim.scene.primitives import Labels, Polyline, Triads


@pytest.fixture
def page_of(inspecting):
    def make(name, key=""):
        page = inspecting(SourcePage, name)
        if key:
            page.choose(key)
        return page

    return make


def grids(page):
    return [grid for grid in page.findChildren(Grid) if grid.isVisible()]


def numbers(grid):
    cells = [[text.replace("\u2212", "-") for text in row] for row in grid.sheet.cells]
    return np.array([[np.nan if text == "–" else float(text) for text in row] for row in cells])


def label(page, name):
    return page.findChild(QLabel, f"source_{name}")


def drawn(page):
    return page._stage.layers.get("inspect_source", ())


def test_a_number_stands_beside_ours_with_the_difference(page_of):
    page = page_of("rv-m1", "000-15")
    page.findChild(QPushButton, "source_pose").click()
    (grid,) = grids(page)
    assert grid.sheet.columns == ("printed", "ours", "off by")
    assert grid.sheet.rows == ("θ₃ [°]",)
    assert numbers(grid) == pytest.approx(np.array([[60.0, -50.0, 110.0]]))
    assert grid.sheet.wrong.tolist() == [[True, False, True]]


def test_a_matrix_stands_above_ours_and_the_wrong_entries_are_marked(page_of):
    page = page_of("al5b", "004-3.12")
    page.findChild(QPushButton, "source_pose").click()
    printed, ours, difference = grids(page)
    assert np.argwhere(printed.sheet.wrong).tolist() == [[2, 0], [2, 1]]
    assert not ours.sheet.wrong.any()
    assert numbers(printed) - numbers(ours) == pytest.approx(numbers(difference), abs=2e-3)
    assert "2 of 16 entries" in label(page, "verdict").text()


def test_the_button_goes_to_the_pose_of_the_text_and_undo_brings_the_present_one_back(page_of):
    page = page_of("rv-m1", "000-8")
    session, button = page._session, page.findChild(QPushButton, "source_pose")
    before = session.q
    button.click()
    assert session.q == pytest.approx(erratum_of("000-8").pose)
    assert not button.isEnabled()
    session.undo_stack.undo()
    assert session.q == pytest.approx(before)
    assert button.isEnabled()


def test_every_pose_of_the_text_is_one_that_the_window_takes(session_with):
    for name in ("rv-m1", "rv-1a", "ur5e", "rrrp", "al5b"):
        session = session_with(name)
        assert all(session.move_to(entry.pose, "Pose") for entry in errata(name))


def test_the_scene_shows_where_the_source_puts_the_tool(page_of):
    page = page_of("rv-m1", "000-8")
    page.findChild(QPushButton, "source_pose").click()
    (triad,) = (item for item in drawn(page) if isinstance(item, Triads))
    (gap,) = (item for item in drawn(page) if isinstance(item, Polyline))
    assert np.linalg.norm(gap.points[1] - gap.points[0]) == pytest.approx(0.072)
    assert gap.points[0] == pytest.approx(forward_kinematics(page._session.robot, page._session.q)[:3, 3])
    assert triad.T_base_frame[0, :3, 3] == pytest.approx(gap.points[1])
    assert any(item.labels[0].text == "000 (7) and (8)" for item in drawn(page) if isinstance(item, Labels))
    assert "72.0 mm away" in label(page, "drawn").text()


def test_the_drawing_goes_with_the_page_and_with_an_erratum_that_moves_nothing(page_of):
    page = page_of("rv-m1", "000-8")
    assert drawn(page)
    page.choose("000-22")
    assert not drawn(page)
    page.choose("000-8")
    page.set_seen(False)
    assert not drawn(page)


def test_a_formula_without_a_value_says_why(page_of):
    page = page_of("rrrp", "003-l6")
    page.findChild(QPushButton, "source_pose").click()
    (grid,) = grids(page)
    assert grid.sheet.cells[0][0] == "–"
    assert "C₂ is 0" in label(page, "verdict").text()


def test_a_pose_at_which_the_printed_formula_is_right_is_said_to_be_one(page_of):
    page = page_of("rrrp", "003-l6")
    page._session.move_to([0.3, 0.5, 0.1, 1.2], "Plot")
    assert "happens to be right" in label(page, "verdict").text()


def test_the_numbers_follow_the_arm_and_the_units(page_of):
    page = page_of("rv-m1", "000-10")
    page._session.move_to(np.radians([50.0, 40.0, -50.0, 20.0, 60.0]), "Plot")
    assert numbers(grids(page)[0])[0, :2] == pytest.approx([40.0, 50.0])
    page._preferences.set("angle_unit", "rad")
    assert numbers(grids(page)[0])[0, :2] == pytest.approx(np.radians([40.0, 50.0]), abs=1e-3)


def test_errata_are_listed_under_their_topics_and_filtered_by_them(page_of):
    page = page_of("al5b")
    topics, listed = page.findChild(QComboBox, "source_topics"), page.findChild(QListWidget, "source_errata")
    keys = [listed.item(row).data(Qt.ItemDataRole.UserRole) for row in range(listed.count())]
    assert keys.count(None) == 6
    topics.setCurrentIndex(topics.findData("time law"))
    assert [listed.item(row).data(Qt.ItemDataRole.UserRole).key for row in range(listed.count())] == ["004-5.22"]
    assert page.chosen.key == "004-5.22"


def test_a_remark_has_no_numbers_and_no_pose(page_of):
    page = page_of("al5b", "004-4.6")
    assert grids(page) == []
    assert not page.findChild(QPushButton, "source_pose").isVisible()


def test_an_arm_without_errata_says_so(page_of):
    page = page_of("scara")
    assert "No formula" in label(page, "nothing").text() or "no formula" in label(page, "nothing").text()
    assert label(page, "nothing").isVisible()
    assert not page.detail.isVisible()


def test_the_page_follows_to_another_arm(page_of):
    page = page_of("rv-m1", "000-8")
    for name in robot_names():
        page._session.use_robot(load_robot(name))
        assert (page.chosen is None) == (errata(name) == ())
        assert page.chosen is None or page.chosen.robot == name


def test_nothing_is_wider_than_the_page(page_of):
    page = page_of("rv-m1")
    for entry in errata("rv-m1"):
        page.choose(entry.key)
        for grid in grids(page):
            assert grid._needed(grid.sheet) <= grid.width()


def test_every_formula_of_the_list_can_be_set(qapp):
    for entry in errata():
        for latex in (*entry.printed_latex, *entry.right_latex):
            assert typeset(latex) is not None, (entry.key, latex)
