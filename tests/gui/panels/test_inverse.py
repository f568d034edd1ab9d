"""The Inverse panel: boxes, tasks, solvers, table, order; every row is a way to the same pose."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QFont
from PySide6.QtWidgets import QAbstractButton, QCheckBox, QComboBox, QLabel, QTableView, QWidget

from rvsim.files import load_robot
from rvsim.gui.branch_words import circled
from rvsim.gui.panels.inverse import InversePanel, _numeric_note
from rvsim.gui.panels.inverse_table import NAME_ROLE, SORT_ROLE
from rvsim.gui.quantities import format_scientific
from rvsim.gui.session import Session
from rvsim.gui.target import TargetControl, Wish
from rvsim.gui.target_solution import branch_at
from rvsim.kinematics import forward_kinematics
from rvsim.spatial import rotation_from_rpy

UR5E = np.array([0.3, -1.2, 1.4, -0.8, 1.1, 0.2])


@pytest.fixture
def panel_of(qtbot, session_with, preferences, shown):
    """The shown panel of an arm, with `session` and `control`."""
    controls: list[TargetControl] = []

    def make(name: str, q: np.ndarray | None = None) -> InversePanel:
        session: Session = session_with(name)
        if q is not None:
            session.move_to(q, "Go")
        control = TargetControl(session, preferences)
        controls.append(control)
        panel = shown(InversePanel(control, preferences))
        panel.session, panel.control = session, control
        return panel

    yield make
    for control in controls:
        control.close()


def table(panel: InversePanel) -> QTableView:
    return panel.findChild(QTableView, "branch_table")


def rows(panel: InversePanel) -> list[list[str]]:
    model = table(panel).model()
    return [[model.index(r, c).data() for c in range(model.columnCount())] for r in range(model.rowCount())]


def column(panel: InversePanel, head: str) -> int:
    model = table(panel).model()
    heads = [model.headerData(c, Qt.Orientation.Horizontal) for c in range(model.columnCount())]
    return next(c for c, text in enumerate(heads) if text.startswith(head))


def choose(panel: InversePanel, name: str, data: str) -> None:
    box = panel.findChild(QComboBox, name)
    box.setCurrentIndex(box.findData(data))
    box.activated.emit(box.currentIndex())


def down_at(x: float, y: float, z: float) -> np.ndarray:
    T = np.eye(4)
    T[:3, :3] = rotation_from_rpy([np.pi, 0.0, 0.0])
    T[:3, 3] = (x, y, z)
    return T


def test_the_table_lists_every_branch_with_its_joints_and_verdict(panel_of) -> None:
    panel = panel_of("ur5e", UR5E)
    listed = rows(panel)
    assert len(listed) == 8
    assert listed[0][0].endswith("right shoulder, wrist no-flip, elbow up")
    assert listed[0][1:4] == ["17.2", "\u221268.8", "80.2"]
    assert {row[column(panel, "limits")] for row in listed} == {"within"}
    assert all("e" in row[column(panel, "residual")] for row in listed)


@pytest.mark.parametrize("name", ["ur5e", "rv-m1", "scara", "rrrp"])
@pytest.mark.parametrize("units", [("deg", "mm"), ("rad", "m")])
def test_every_joint_is_seen_without_scrolling_sideways(qtbot, preferences, panel_of, name, units) -> None:
    panel = panel_of(name)
    for setting, unit in zip(("angle_unit", "length_unit"), units, strict=True):
        preferences.set(setting, unit)
    header = table(panel).horizontalHeader()
    for width in (336, 372, 800):
        panel.resize(width, 480)
        qtbot.waitUntil(lambda: header.length() <= table(panel).viewport().width() < header.length() + 8)
        assert not table(panel).horizontalScrollBar().isVisible()
        assert min(map(header.sectionSize, range(1, panel.session.robot.dof + 1))) > 40


def test_the_header_sorts_by_what_has_no_column_as_well(panel_of) -> None:
    panel = panel_of("ur5e", UR5E)
    action = next(a for a in table(panel).horizontalHeader().actions() if a.text() == "Sort by w")
    action.trigger()
    at = column(panel, "w")
    numbers = [table(panel).model().index(row, at).data(SORT_ROLE) for row in range(8)]
    assert numbers == sorted(numbers)
    assert table(panel).isColumnHidden(at)


def test_the_table_can_be_sorted_by_the_numbers_behind_its_texts(panel_of) -> None:
    panel = panel_of("ur5e", UR5E)
    by_preference = rows(panel)
    for head in ("J1", "margin", "moves", "w", "residual"):
        at = column(panel, head)
        for order, sign in ((Qt.SortOrder.AscendingOrder, 1.0), (Qt.SortOrder.DescendingOrder, -1.0)):
            table(panel).sortByColumn(at, order)
            model = table(panel).model()
            numbers = [sign * model.index(row, at).data(SORT_ROLE) for row in range(model.rowCount())]
            assert numbers == sorted(numbers), head
    table(panel).sortByColumn(-1, Qt.SortOrder.AscendingOrder)
    assert rows(panel) == by_preference


def test_a_click_on_any_row_brings_the_arm_there_with_the_tool_where_it_was(qtbot, panel_of) -> None:
    panel = panel_of("ur5e", UR5E)
    T = forward_kinematics(panel.session.robot, UR5E)
    seen = set()
    names = [table(panel).model().index(row, 0).data(NAME_ROLE) for row in range(8)]
    for name in names:
        model = table(panel).model()
        row = next(r for r in range(8) if model.index(r, 0).data(NAME_ROLE) == name)
        table(panel).scrollTo(model.index(row, 0))
        where = table(panel).visualRect(model.index(row, 0)).center()
        qtbot.mouseClick(table(panel).viewport(), Qt.MouseButton.LeftButton, pos=where)
        np.testing.assert_allclose(forward_kinematics(panel.session.robot, panel.session.q), T, atol=1e-9)
        assert rows(panel)[0][0].split(" ", 1)[0] == chr(0x245F + int(name))  # the arm is there: it is the best
        seen.add(tuple(panel.session.q.round(6)))
    assert len(seen) == 8


def test_enter_goes_to_the_row_that_the_keyboard_is_on(qtbot, panel_of) -> None:
    panel = panel_of("ur5e", UR5E)
    table(panel).setFocus()
    qtbot.keyClick(table(panel), Qt.Key.Key_Down)
    qtbot.keyClick(table(panel), Qt.Key.Key_Down)
    name = panel.control.lit
    qtbot.keyClick(table(panel), Qt.Key.Key_Return)
    assert table(panel).model().index(0, 0).data(NAME_ROLE) == name
    assert not np.allclose(panel.session.q, UR5E)


def test_the_pointer_lights_a_branch_and_says_all_about_it(qtbot, panel_of) -> None:
    panel = panel_of("ur5e", UR5E)
    where = table(panel).visualRect(table(panel).model().index(2, 0)).center()
    qtbot.mouseMove(table(panel).viewport(), where + QPoint(1, 1))
    qtbot.mouseMove(table(panel).viewport(), where)
    assert panel.control.lit == table(panel).model().index(2, 0).data(NAME_ROLE)
    assert "residual" in panel.findChild(QLabel, "branch_detail").text()


def test_an_edited_box_moves_the_tool_on_the_arms_own_branch(panel_of) -> None:
    panel = panel_of("ur5e", UR5E)
    box = panel.findChild(QWidget, "target_x")
    before = forward_kinematics(panel.session.robot, panel.session.q)
    box.setValue(box.value() + 25.0)
    after = forward_kinematics(panel.session.robot, panel.session.q)
    np.testing.assert_allclose(after[:3, 3] - before[:3, 3], (0.025, 0.0, 0.0), atol=1e-9)
    np.testing.assert_allclose(after[:3, :3], before[:3, :3], atol=1e-9)
    assert np.abs(panel.session.q - UR5E).max() < 0.3
    yaw = panel.findChild(QWidget, "target_yaw")
    yaw.setValue(yaw.value() + 10.0)
    turned = forward_kinematics(panel.session.robot, panel.session.q)
    np.testing.assert_allclose(turned[:3, :3], rotation_from_rpy([0, 0, np.radians(10)]) @ after[:3, :3], atol=1e-9)


def test_when_the_arm_does_not_follow_it_waits_for_solve(qtbot, panel_of) -> None:
    panel = panel_of("ur5e", UR5E)
    panel.findChild(QCheckBox, "arm_follows_switch").click()
    box = panel.findChild(QWidget, "target_z")
    box.setValue(box.value() - 40.0)
    np.testing.assert_array_equal(panel.session.q, UR5E)
    assert len(rows(panel)) == 8
    panel.findChild(QAbstractButton, "solve_button").click()
    assert forward_kinematics(panel.session.robot, panel.session.q)[2, 3] == pytest.approx(box.quantity, abs=1e-9)


def test_why_not_names_the_joint_and_its_limit_and_offers_the_nearest(qtbot, panel_of) -> None:
    panel = panel_of("rv-m1")
    home = panel.session.q
    panel.control.set_target(Wish(down_at(0.11, 0.0, 0.13), "Target", ""))
    sentence = panel.findChild(QLabel, "why_not_sentence")
    assert "elbow needs \u2212156.7°, stops at \u2212110.0°" in sentence.text()
    np.testing.assert_array_equal(panel.session.q, home)
    assert len(rows(panel)) == 4
    assert all("stop" in row[0] and "stops at" in row[column(panel, "limits")] for row in rows(panel))
    accept = panel.findChild(QAbstractButton, "accept_nearest_button")
    qtbot.waitUntil(accept.isEnabled)
    accept.click()
    limits = panel.session.robot.limits
    assert ((panel.session.q >= limits[:, 0] - 1e-9) & (panel.session.q <= limits[:, 1] + 1e-9)).all()
    assert not accept.isVisible()
    panel.session.undo_stack.undo()  # the wish comes back with the pose
    assert "\u2212156.7°" in sentence.text()
    panel.session.undo_stack.undo()
    assert not accept.isVisible()


def test_a_place_out_of_reach_is_said_at_once_and_by_how_much_when_it_is_known(qtbot, panel_of) -> None:
    panel = panel_of("ur5e", UR5E)
    panel.control.set_target(Wish(down_at(2.0, 0.0, 0.3), "Target", ""))
    sentence = panel.findChild(QLabel, "why_not_sentence")
    assert sentence.text() == "The place is out of reach."
    qtbot.waitUntil(lambda: "mm away" in sentence.text())
    panel.findChild(QAbstractButton, "target_at_tool_button").click()
    assert not panel.findChild(QWidget, "why_not").isVisible() or "out of reach" not in sentence.text()


def test_a_branch_outside_the_limits_is_refused_with_a_reason_unless_they_are_ignored(qtbot, panel_of) -> None:
    panel = panel_of("rv-m1")
    panel.control.set_target(Wish(down_at(0.11, 0.0, 0.13), "Target", ""))
    branch = panel.control.answer.branches[0]
    panel.control.go_to(branch)
    np.testing.assert_array_equal(panel.session.q, panel.session.robot.home)
    assert "outside the limits of elbow" in panel.session.sentences[-1][0]
    panel.session.edit("Ignore limits", replace(panel.session.experiment, ignore_limits=True))
    panel.control.go_to(panel.control.answer.branches[0])
    np.testing.assert_allclose(np.degrees(panel.session.q[2]), -156.7, atol=0.05)


@pytest.mark.parametrize("name", ["rv-m1", "rv-1a", "rrrp", "al5b", "scara", "planar", "spherical", "cartesian"])
def test_every_arm_offers_its_tasks_in_words_and_each_finds_where_the_arm_is(panel_of, name: str) -> None:
    panel = panel_of(name)
    box = panel.findChild(QComboBox, "ik_task_selector")
    for index in range(box.count()):
        assert box.itemText(index)[0].isupper()
        choose(panel, "ik_task_selector", box.itemData(index))
        assert panel.control.answer.usable, box.itemText(index)
        assert min(branch.distance for branch in panel.control.answer.usable) < 1e-6


def test_with_the_wrist_kept_only_the_arm_moves(panel_of) -> None:
    panel = panel_of("al5b", np.array([0.3, 1.0, -1.0, 0.2, 0.4]))
    choose(panel, "ik_task_selector", "position, wrist kept")
    wrist, box = panel.session.q[3:], panel.findChild(QWidget, "target_z")
    box.setValue(box.value() + 8.0)
    assert forward_kinematics(panel.session.robot, panel.session.q)[2, 3] == pytest.approx(box.quantity, abs=1e-9)
    np.testing.assert_allclose(panel.session.q[3:], wrist, atol=1e-12)


@pytest.mark.parametrize("solver", ["newton", "dls", "lm", "bfgs"])
def test_a_numeric_solver_gives_one_row_with_its_errors(panel_of, solver: str) -> None:
    panel = panel_of("ur5e", UR5E)
    choose(panel, "ik_solver_selector", solver)
    box = panel.findChild(QWidget, "target_y")
    box.setValue(box.value() + 10.0)
    assert len(rows(panel)) == 1
    assert "iterations" in panel.findChild(QLabel, "branch_detail").text()
    assert panel.control.answer.numeric.converged
    assert forward_kinematics(panel.session.robot, panel.session.q)[1, 3] == pytest.approx(box.quantity, abs=1e-5)


def test_an_arm_without_a_closed_form_is_solved_numerically(panel_of) -> None:
    panel = panel_of("ur5e", UR5E)
    bent = panel.session.robot.with_joint(1, alpha=0.3)
    panel.session.edit("Bend", panel.session.experiment.with_robot(bent))
    box = panel.findChild(QComboBox, "ik_solver_selector")
    assert box.findData("closed") < 0
    assert "no closed form" in box.toolTip()
    assert panel.control.answer.usable


def test_the_order_of_preference_can_be_changed(qtbot, panel_of, preferences) -> None:
    panel = panel_of("ur5e", UR5E)
    order = panel.order.list
    assert order.order == ("within limits", "least motion", "largest margin")
    order.setCurrentRow(3)
    order.item(3).setCheckState(Qt.CheckState.Checked)
    for _ in range(3):
        order.shift(-1)
    assert preferences["branch_order"].startswith("most manipulable, ")
    best = [branch.manipulability for branch in panel.control.answer.branches]
    assert np.round(best, 9).tolist() == sorted(np.round(best, 9).tolist(), reverse=True)


def test_near_a_singularity_it_says_what_is_lost(panel_of) -> None:
    panel = panel_of("rv-m1")  # at home the arm is stretched out along x
    assert "along x" in panel.findChild(QLabel, "why_not_sentence").text()


def test_a_hidden_panel_solves_nothing(panel_of) -> None:
    panel = panel_of("ur5e", UR5E)
    answer = panel.control.answer
    panel.hide()
    panel.session.move_to(UR5E + 0.1, "Go")
    assert panel.control.answer is answer
    panel.show()
    np.testing.assert_allclose(panel.control.T, forward_kinematics(panel.session.robot, UR5E + 0.1), atol=1e-12)


@pytest.mark.parametrize("place", [(0.11, 0.0, 0.13), (0.2, 0.28, 0.25), (0.9, 0.0, 0.2)])
def test_why_not_is_said_in_the_units_of_the_screen_also_when_these_change(qtbot, preferences, panel_of, place) -> None:
    panel = panel_of("rv-m1")
    T = forward_kinematics(panel.session.robot, panel.session.q)
    T[:3, 3] = place
    panel.control.set_target(Wish(T, "Target", ""))
    preferences.set("length_unit", "m")
    preferences.set("angle_unit", "rad")
    qtbot.waitUntil(lambda: panel.control.nearest is not None)
    said = [panel.findChild(QLabel, "why_not_sentence").text(), panel.why_not.left.text()]
    assert all(any(unit in text for unit in (" m", " rad")) for text in said)
    assert not any("°" in text or "mm" in text for text in said)


def test_nothing_is_left_of_the_other_arm_while_nobody_watches(panel_of) -> None:
    panel = panel_of("ur5e")
    panel.control.set_target(Wish(down_at(2.0, 0.0, 0.2), "Far", ""))
    panel.hide()
    panel.session.use_robot(load_robot("rv-m1"))
    assert panel.control.answer is panel.control.nearest is None
    panel.show()
    assert {len(branch.q) for branch in panel.control.answer.branches} == {5}


def test_a_numeric_row_tells_its_errors_in_the_shown_units(panel_of, preferences) -> None:
    panel = panel_of("ur5e", UR5E)
    choose(panel, "ik_solver_selector", "lm")
    found = panel.control.answer.numeric
    for units, shown in ((("deg", "mm"), "e−?\\d+ mm, .*e−?\\d+°"), (("rad", "m"), "e−?\\d+ m, .*e−?\\d+ rad")):
        preferences.set("angle_unit", units[0])
        preferences.set("length_unit", units[1])
        note = _numeric_note(panel.control.answer, preferences)
        assert re.search(shown.replace("−?", "[−+]"), note), note
    assert f"errors {format_scientific(found.position_error)} m" in note


def test_a_hand_beyond_the_reach_is_told_what_the_arm_does_and_the_nearest_at_rest(qtbot, panel_of) -> None:
    panel = panel_of("ur5e", UR5E)
    why, left = panel.why_not.sentence, panel.why_not.left
    panel.control.request(Wish(down_at(2.0, 0.0, 0.2), "Drag", "drag", creeps=True))
    panel.control.flush()
    assert (why.text(), left.text()) == (
        "Out of reach: the arm follows along the edge.",
        "The nearest pose is looked for at rest.",
    )
    qtbot.waitUntil(lambda: panel.control.nearest is not None)
    assert why.text().startswith("The place is out of reach")
    assert left.text().startswith("Nearest pose (with the orientation and the limits):")


@pytest.mark.parametrize("points", [9, 14])
@pytest.mark.parametrize("width", [300, 341, 408])
def test_no_button_is_cut_on_a_narrow_screen_or_in_large_type(qtbot, panel_of, width, points) -> None:
    panel = panel_of("ur5e")
    panel.setFont(QFont(panel.font().family(), points))
    panel.resize(width, 560)
    for name in ("paste_matrix_button", "target_at_tool_button", "solve_button", "arm_follows_switch"):
        made = panel.findChild(QAbstractButton, name)
        qtbot.waitUntil(lambda made=made: made.width() >= made.minimumSizeHint().width())
        assert made.mapTo(panel, made.rect().topRight()).x() < panel.width()
    assert not panel.target.paste.geometry().intersects(panel.target.at_tool.geometry())


def test_the_branch_keeps_its_name_where_two_singularities_meet(panel_of) -> None:
    q = np.radians([45.0, -90.0, 0.0, 30.0, 180.0, -90.0])
    panel = panel_of("ur5e", q)
    assert branch_at(panel.control.answer, q) is not None


def test_where_the_place_alone_is_wanted_the_boxes_of_the_orientation_are_grey_and_say_why(panel_of) -> None:
    panel = panel_of("ur5e")
    panel.control.set_task("position")
    boxes = panel.target.angles
    assert not boxes.isEnabled()
    assert "free" in boxes.rows["rpy"].boxes[0].toolTip()
    panel.control.set_task("pose")
    assert boxes.isEnabled()
    assert "free" not in boxes.rows["rpy"].boxes[0].toolTip()


def test_a_row_names_every_joint_beyond_its_limits_and_below_the_list_stands_where_the_arm_is(panel_of) -> None:
    panel = panel_of("rv-m1")
    assert panel.detail.text().startswith(circled(panel.model.rows[0].name))
    panel.control.set_target(Wish(down_at(0.11, 0.0, 0.13), "Target", ""))
    several = [row for row in panel.model.rows if (row.branch.limit_margin < -1e-6).sum() > 1]
    assert several
    for row in several:
        names = [panel.session.robot.joint_names[i] for i in np.flatnonzero(row.branch.limit_margin < -1e-6)]
        assert panel.model.text_of(row).stop == f"{', '.join(names)} stop"
