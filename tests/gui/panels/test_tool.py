"""The Tool panel reads out the pose in every notation; an edited number moves the arm or says why it cannot."""

import math

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QComboBox, QLabel

from rvsim.gui.matrix_view import MatrixView
from rvsim.gui.orientations import NOTATIONS
from rvsim.gui.panels.copying import CopyButton
from rvsim.gui.panels.tool import ToolPanel
from rvsim.gui.quantity_box import QuantityBox
from rvsim.kinematics import forward_kinematics
from rvsim.spatial import rot_z, rotation_from_quaternion, rotation_from_rpy, rpy_from_rotation, transform

POSE = np.radians([30.0, 40.0, -50.0, 20.0, 60.0])
POSES = {
    "rv-m1": POSE,
    "ur5e": np.radians([20.0, -70.0, 100.0, -50.0, 60.0, 35.0]),
    "al5b": np.radians([25.0, 60.0, -70.0, -35.0, 40.0]),
    "rv-1a": np.radians([10.0, 80.0, -20.0, 30.0, 40.0, 50.0]),
}


@pytest.fixture
def panel_with(session_with, preferences, shown):
    def make(name):
        session = session_with(name)
        if name in POSES:
            assert session.move_to(POSES[name], "Plot")
        return shown(ToolPanel(session, preferences))

    return make


@pytest.fixture
def panel(panel_with):
    return panel_with("rv-m1")


def box(panel, name):
    found = panel.findChild(QuantityBox, name)
    assert found is not None, name
    return found


def enter(panel, qtbot, name, text):
    field = box(panel, name)
    field.setFocus()
    field.selectAll()
    qtbot.keyClicks(field, text)
    qtbot.keyClick(field, Qt.Key.Key_Return)


def message(panel):
    label = panel.findChild(QLabel, "tool_message")
    return label.text() if label.isVisible() else ""


def tool(panel):
    return forward_kinematics(panel._session.robot, panel._session.q)


# --- showing -------------------------------------------------------------------------------------------------------


def test_position_and_roll_pitch_yaw_are_those_of_the_pose(panel):
    assert [box(panel, f"tool_{axis}").text() for axis in "xyz"] == ["363.7 mm", "210.0 mm", "297.4 mm"]
    shown = [box(panel, f"tool_{name}").quantity for name in ("roll", "pitch", "yaw")]
    np.testing.assert_allclose(shown, rpy_from_rotation(tool(panel)[:3, :3]), atol=1e-15)


@pytest.mark.parametrize("notation", NOTATIONS)
def test_every_notation_shows_the_same_rotation_and_says_its_convention(panel, preferences, notation):
    preferences.set("orientation", notation)
    row = panel.rows[notation]
    assert row.isVisible()
    assert panel.findChild(QLabel, "orientation_convention").text() == NOTATIONS[notation].convention
    values = np.array([field.quantity for field in row.boxes])
    np.testing.assert_allclose(NOTATIONS[notation].write(values), tool(panel)[:3, :3], atol=1e-14)


def test_the_matrix_is_a_notation_too_and_the_selector_chooses(panel, preferences, qtbot):
    selector = panel.findChild(QComboBox, "orientation_selector")
    selector.setCurrentIndex(selector.findData("matrix"))
    selector.activated.emit(selector.currentIndex())
    assert preferences["orientation"] == "matrix"
    view = panel.findChild(MatrixView, "tool_matrix")
    assert view.isVisible()
    assert "363.7" in view.text()
    assert "n, o, a" in panel.findChild(QLabel, "orientation_convention").text()


def test_the_second_way_is_shown_in_scientific_notation_and_explained(panel):
    label = panel.findChild(QLabel, "forward_difference")
    assert "e\u221216 m in position" in label.text()
    assert "1.018 dm" in label.text()
    assert "Program 6" in label.toolTip()


def test_the_tool_selector_offers_the_tools_of_the_arm(panel):
    selector = panel.findChild(QComboBox, "tool_selector")
    assert [selector.itemText(i) for i in range(selector.count())] == ["Flange (no tool)", "Standard hand, 107 mm"]
    before = tool(panel)
    selector.setCurrentIndex(1)
    selector.activated.emit(1)
    np.testing.assert_allclose(tool(panel)[:3, 3] - before[:3, 3], 0.107 * before[:3, 2], atol=1e-12)
    assert box(panel, "tool_x").quantity == pytest.approx(tool(panel)[0, 3])
    panel._session.undo_stack.undo()
    assert selector.currentIndex() == 0


def test_lengths_without_a_unit_are_shown_as_units(panel_with):
    assert box(panel_with("rrrp"), "tool_x").text() == "5.000 unit"


def test_its_numbers_stay_true_while_it_is_hidden(panel):
    panel.hide()
    panel._session.move_to(np.zeros(5), "Zero")
    assert box(panel, "tool_x").text() == "482.0 mm"
    panel.show()
    assert box(panel, "tool_x").text() == "482.0 mm"


# --- editing -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["ur5e", "rv-1a"])
@pytest.mark.parametrize(("field", "entry"), [("tool_x", (0, 3)), ("tool_y", (1, 3)), ("tool_z", (2, 3))])
def test_an_arm_of_six_joints_moves_and_keeps_its_orientation(panel_with, qtbot, name, field, entry):
    panel = panel_with(name)
    wanted = tool(panel)
    wanted[entry] += 0.01
    enter(panel, qtbot, field, f"{1e3 * wanted[entry]:.12f}")
    np.testing.assert_allclose(tool(panel), wanted, atol=1e-9)
    assert message(panel) == ""


@pytest.mark.parametrize("field", ["tool_roll", "tool_pitch", "tool_yaw"])
def test_an_arm_of_six_joints_turns_and_keeps_its_place(panel_with, qtbot, field):
    panel = panel_with("ur5e")
    p = tool(panel)[:3, 3]
    wanted = box(panel, field).quantity + math.radians(3.0)
    enter(panel, qtbot, field, f"{math.degrees(wanted):.12f}")
    np.testing.assert_allclose(tool(panel)[:3, 3], p, atol=1e-9)
    assert box(panel, field).quantity == pytest.approx(wanted, abs=1e-9)


@pytest.mark.parametrize("name", ["rv-m1", "al5b"])
def test_an_arm_of_five_joints_keeps_pitch_and_roll_when_moved_sideways(panel_with, qtbot, name):
    panel = panel_with(name)
    before = tool(panel)
    enter(panel, qtbot, "tool_y", f"{1e3 * before[1, 3] + 20:.9f}")
    after = tool(panel)
    np.testing.assert_allclose(after[:3, 3] - before[:3, 3], [0, 0.02, 0], atol=1e-9)
    np.testing.assert_allclose(after[2, :3], before[2, :3], atol=1e-9, err_msg="turned about the vertical alone")


def test_an_edit_goes_to_the_nearest_branch(panel, qtbot):
    before = panel._session.q
    enter(panel, qtbot, "tool_z", "300")
    assert np.abs(panel._session.q - before).max() < 0.05


def test_an_orientation_that_five_joints_cannot_have_is_refused_with_the_reason(panel, qtbot):
    before = panel._session.q
    yaw = box(panel, "tool_yaw").text()
    enter(panel, qtbot, "tool_yaw", "20")
    assert panel._session.q is before
    assert "not in this orientation" in message(panel)
    assert "5 joints" in message(panel)
    assert box(panel, "tool_yaw").text() == yaw, "the box goes back"
    assert (message(panel), "warning") in panel._session.sentences


def test_a_place_out_of_reach_is_refused_with_the_reason(panel, qtbot):
    before = panel._session.q
    enter(panel, qtbot, "tool_x", "900")
    assert panel._session.q is before
    assert "out of reach" in message(panel)
    assert box(panel, "tool_x").text() == "363.7 mm"


def test_a_place_outside_the_limits_is_refused_until_limits_are_ignored(panel, qtbot):
    from dataclasses import replace

    enter(panel, qtbot, "tool_z", "120")
    before = panel._session.q
    enter(panel, qtbot, "tool_x", "-200")
    assert panel._session.q is before
    assert "limits" in message(panel)
    session = panel._session
    session.edit("Ignore limits", replace(session.experiment, ignore_limits=True))
    enter(panel, qtbot, "tool_x", "-200")
    assert tool(panel)[0, 3] == pytest.approx(-0.2)


@pytest.mark.parametrize(
    ("name", "field"), [("articulated", "tool_pitch"), ("scara", "tool_roll"), ("planar", "tool_z")]
)
def test_what_an_arm_of_few_joints_cannot_follow_is_said(panel_with, qtbot, name, field):
    panel = panel_with(name)
    before = panel._session.q
    shown = box(panel, field).text()
    enter(panel, qtbot, field, "17.5")
    assert panel._session.q is before
    assert message(panel) != ""
    assert box(panel, field).text() == shown


def test_an_arm_of_three_joints_moves_to_a_place(panel_with, qtbot):
    panel = panel_with("articulated")
    wanted = tool(panel)[:3, 3] + [-0.02, 0.03, 0.0]
    for axis in (0, 1):
        enter(panel, qtbot, f"tool_{'xyz'[axis]}", f"{1e3 * wanted[axis]:.9f}")
    np.testing.assert_allclose(tool(panel)[:3, 3], wanted, atol=1e-9)


def test_an_arm_without_a_closed_form_says_so(panel, qtbot):
    session = panel._session
    session.edit("Odd", session.experiment.with_robot(session.robot.with_joint(1, alpha=0.3)))
    enter(panel, qtbot, "tool_x", "300")
    assert "no closed form" in message(panel)
    assert "Set its joints instead" in message(panel)


def test_steps_in_one_go_are_one_undo_step(panel, qtbot):
    session = panel._session
    count = session.undo_stack.count()
    before = session.q
    field = box(panel, "tool_z")
    field.setFocus()
    for _ in range(5):
        qtbot.keyClick(field, Qt.Key.Key_Down)
    assert session.undo_stack.count() == count + 1
    session.undo_stack.undo()
    np.testing.assert_array_equal(session.q, before)


@pytest.mark.parametrize(("notation", "numbers"), [("quaternion", "0 1 0 1"), ("axis_angle", "0 2 0 90")])
def test_a_whole_orientation_is_pasted_into_any_box(panel_with, preferences, qtbot, notation, numbers):
    panel = panel_with("ur5e")
    preferences.set("orientation", notation)
    p = tool(panel)[:3, 3]
    values = np.array([float(number) for number in numbers.split()])
    wanted = rotation_from_quaternion(values) if notation == "quaternion" else rotation_from_rpy([0, np.pi / 2, 0])
    field = panel.rows[notation].boxes[2]
    field.setFocus()
    QGuiApplication.clipboard().setText(numbers)
    qtbot.keyClick(field, Qt.Key.Key_V, Qt.KeyboardModifier.ControlModifier)
    np.testing.assert_allclose(tool(panel)[:3, :3], wanted, atol=1e-9)
    np.testing.assert_allclose(tool(panel)[:3, 3], p, atol=1e-9)
    panel._session.undo_stack.undo()
    np.testing.assert_array_equal(panel._session.q, POSES["ur5e"])


def test_a_quaternion_that_five_joints_cannot_have_yet_stays_as_it_is_typed(panel, preferences, qtbot):
    before, here = panel._session.q, tool(panel)
    preferences.set("orientation", "quaternion")
    target = NOTATIONS["quaternion"].read(here[:3, :3] @ rot_z(0.4))  # its roll
    fields = [f"tool_quaternion_{name}" for name in "wxyz"]
    for field, number in zip(fields[:3], target[:3], strict=True):
        enter(panel, qtbot, field, f"{number:.15f}")
    assert panel._session.q is before
    assert "not in this orientation" in message(panel)
    np.testing.assert_allclose(panel.rows["quaternion"].values[:3], target[:3], atol=1e-12)
    enter(panel, qtbot, fields[3], f"{target[3]:.15f}")
    assert message(panel) == ""
    np.testing.assert_allclose(tool(panel), here @ transform(rot_z(0.4), np.zeros(3)), atol=1e-7)


# --- copying -------------------------------------------------------------------------------------------------------


def test_the_copies_say_names_and_units_in_full_precision(panel, preferences):
    copy = panel.findChild(CopyButton, "tool_copy")
    copy.copy_as("NumPy")
    text = QGuiApplication.clipboard().text()
    assert text.startswith("# x [mm], y [mm], z [mm], roll [deg], pitch [deg], yaw [deg]\n")
    values = eval(text, {"np": np})
    np.testing.assert_array_equal(values[:3], 1e3 * tool(panel)[:3, 3])
    copy.copy_as("text")
    assert QGuiApplication.clipboard().text().isascii()
    preferences.set("orientation", "matrix")
    copy.copy_as("LaTeX")
    assert QGuiApplication.clipboard().text().startswith("% T_base_tool, lengths in mm\n\\begin{bmatrix}")
    copy.copy_as("NumPy")
    np.testing.assert_array_equal(eval(QGuiApplication.clipboard().text(), {"np": np})[:3, :3], tool(panel)[:3, :3])
    copy.copy_as("text")
    assert "\np = (363." in QGuiApplication.clipboard().text()


def test_a_refusal_is_said_in_the_units_of_the_screen(panel, preferences, qtbot):
    preferences.set("length_unit", "m")
    preferences.set("angle_unit", "rad")
    for name, number in (("tool_x", "0.9"), ("tool_yaw", "0.4")):
        enter(panel, qtbot, name, number)
        assert any(unit in message(panel) for unit in (" m ", " rad"))
        assert not any(unit in message(panel) for unit in ("°", "mm"))
