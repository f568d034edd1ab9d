"""A target's orientation in any notation: what is typed stays till all is there, and means one orientation."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QComboBox, QWidget

from rvsim.gui.orientations import NOTATIONS
from rvsim.gui.panels.inverse import InversePanel
from rvsim.gui.quantity_box import QuantityBox
from rvsim.gui.target import TargetControl
from rvsim.kinematics import forward_kinematics
from rvsim.spatial import rot_x, rotation_from_quaternion

UR5E = np.array([0.3, -1.2, 1.4, -0.8, 1.1, 0.2])


@pytest.fixture
def panel(qtbot, session_with, preferences, shown):
    """The Inverse panel of a UR5e; its `session` and `control` are at hand."""
    session = session_with("ur5e")
    session.move_to(UR5E, "Go")
    control = TargetControl(session, preferences)
    made = shown(InversePanel(control, preferences))
    made.session, made.control = session, control
    yield made
    control.close()


def box(panel: InversePanel, name: str) -> QuantityBox:
    found = panel.findChild(QuantityBox, f"target_{name}")
    assert found is not None, name
    return found


def enter(qtbot, field: QuantityBox, text: str) -> None:
    field.setFocus()
    field.selectAll()
    qtbot.keyClicks(field, text)
    qtbot.keyClick(field, Qt.Key.Key_Return)


def paste(qtbot, field: QuantityBox, text: str) -> None:
    QGuiApplication.clipboard().setText(text)
    field.setFocus()
    qtbot.keyClick(field, Qt.Key.Key_V, Qt.KeyboardModifier.ControlModifier)


def rotation(panel: InversePanel) -> np.ndarray:
    return forward_kinematics(panel.session.robot, panel.session.q)[:3, :3]


def numbers(panel: InversePanel, notation: str) -> np.ndarray:
    return panel.target.angles.rows[notation].values


@pytest.mark.parametrize("notation", NOTATIONS)
def test_every_notation_is_chosen_in_words_and_shows_the_target(panel, preferences, notation) -> None:
    selector = panel.findChild(QComboBox, "target_notation_selector")
    assert [selector.itemText(i) for i in range(selector.count())] == [n.title for n in NOTATIONS.values()]
    selector.setCurrentIndex(selector.findData(notation))
    selector.activated.emit(selector.currentIndex())
    assert preferences["orientation"] == notation
    assert panel.target.angles.rows[notation].isVisible()
    assert sum(row.isVisible() for row in panel.target.angles.rows.values()) == 1
    np.testing.assert_allclose(NOTATIONS[notation].write(numbers(panel, notation)), rotation(panel), atol=1e-12)


def test_where_the_tool_is_shown_as_a_matrix_the_target_has_boxes(panel, preferences) -> None:
    preferences.set("orientation", "matrix")
    assert panel.target.angles.rows["rpy"].isVisible()
    assert panel.findChild(QComboBox, "target_notation_selector").currentData() == "rpy"


def test_four_numbers_typed_one_after_the_other_are_the_quaternion_they_are(qtbot, panel, preferences) -> None:
    preferences.set("orientation", "quaternion")
    place = forward_kinematics(panel.session.robot, UR5E)[:3, 3]
    for name, text in zip("wxyz", ("0", "1", "1", "0"), strict=True):
        enter(qtbot, box(panel, f"quaternion_{name}"), text)
    np.testing.assert_allclose(panel.control.T[:3, :3], rotation_from_quaternion([0, 1, 1, 0]), atol=1e-9)
    np.testing.assert_allclose(panel.control.T[:3, 3], place, atol=1e-9)
    np.testing.assert_array_equal(numbers(panel, "quaternion"), [0, 1, 1, 0])
    assert "Length 1.4142, taken as 0.0000, 0.7071, 0.7071, 0.0000." in [text for text, _ in panel.session.sentences]
    panel.findChild(QWidget, "ik_task_selector").setFocus()  # the boxes are left
    np.testing.assert_allclose(numbers(panel, "quaternion"), np.array([0, 1, 1, 0]) / np.sqrt(2), atol=1e-9)


def test_an_axis_of_any_length_is_a_direction(qtbot, panel, preferences) -> None:
    preferences.set("orientation", "axis_angle")
    for name, text in (("axis_x", "3"), ("axis_y", "0"), ("axis_z", "0"), ("angle", "150")):
        enter(qtbot, box(panel, f"axis_angle_{name}"), text)
    np.testing.assert_allclose(panel.control.T[:3, :3], rot_x(np.radians(150.0)), atol=1e-9)
    panel.findChild(QWidget, "ik_task_selector").setFocus()
    np.testing.assert_allclose(numbers(panel, "axis_angle"), [1, 0, 0, np.radians(150.0)], atol=1e-9)


@pytest.mark.parametrize(
    ("notation", "text", "sentence"),
    [("quaternion", "0 0 0 0", "one of w, x, y, z must"), ("axis_angle", "0 0 0 30", "one of axis x, axis y, axis z")],
)
def test_no_direction_is_refused_and_gone_when_the_boxes_are_left(
    qtbot, panel, preferences, notation, text, sentence
) -> None:
    preferences.set("orientation", notation)
    before = panel.control.T
    paste(qtbot, panel.target.angles.rows[notation].boxes[1], text)
    assert sentence in panel.session.sentences[-1][0]
    np.testing.assert_array_equal(panel.control.T, before)
    np.testing.assert_array_equal(panel.session.q, UR5E)
    panel.findChild(QWidget, "ik_task_selector").setFocus()
    np.testing.assert_allclose(NOTATIONS[notation].write(numbers(panel, notation)), before[:3, :3], atol=1e-12)


def test_a_pasted_quaternion_fills_all_boxes_moves_the_arm_and_can_be_undone(qtbot, panel, preferences) -> None:
    preferences.set("orientation", "quaternion")
    old = numbers(panel, "quaternion")
    wanted = NOTATIONS["quaternion"].read(rotation(panel) @ rot_x(0.2))
    for index, text in ((0, " ".join(map(str, wanted))), (3, f"[{', '.join(map(str, -wanted))}]")):
        paste(qtbot, panel.target.angles.rows["quaternion"].boxes[index], text)
        np.testing.assert_allclose(rotation(panel), rotation_from_quaternion(wanted), atol=1e-9)
    panel.session.undo_stack.undo()
    np.testing.assert_array_equal(panel.session.q, UR5E)
    np.testing.assert_allclose(numbers(panel, "quaternion"), old, atol=1e-12)


def test_a_list_of_another_length_is_refused_with_what_is_wanted(qtbot, panel, preferences) -> None:
    preferences.set("orientation", "quaternion")
    paste(qtbot, box(panel, "quaternion_w"), "1 2 3")
    assert "4 numbers: w, x, y, z" in panel.session.sentences[-1][0]
    np.testing.assert_array_equal(panel.session.q, UR5E)


def test_a_place_is_pasted_as_well(qtbot, panel) -> None:
    paste(qtbot, box(panel, "y"), "400 100 300")
    np.testing.assert_allclose(panel.control.T[:3, 3], [0.4, 0.1, 0.3], atol=1e-9)


def test_position_only_lets_the_tool_turn_where_it_must(qtbot, panel) -> None:
    task = panel.findChild(QComboBox, "ik_task_selector")
    assert task.findText("Position only") >= 0
    task.setCurrentIndex(task.findData("position"))
    task.activated.emit(task.currentIndex())
    paste(qtbot, box(panel, "x"), "100 0 200")  # pointing down it cannot stand so near to its base axis
    place = forward_kinematics(panel.session.robot, panel.session.q)[:3, 3]
    np.testing.assert_allclose(place, [0.1, 0.0, 0.2], atol=1e-9)
