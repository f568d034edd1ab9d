"""The Velocity page solves both ways round, says what is lost, and jogs the arm as one step of the undo stack."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLineEdit, QPushButton

from rvsim.gui.panels.inspect_velocity import VelocityPage
from rvsim.gui.panels.inspect_velocity_jog import Direction
from rvsim.gui.quantity_box import QuantityBox
from rvsim.kinematics import forward_kinematics, jacobian
from rvsim.kinematics.rates import joint_accelerations, tool_acceleration

POSE = np.radians([30.0, 40.0, -70.0, -30.0, 20.0])
UR = np.radians([20.0, -70.0, 100.0, -120.0, -80.0, 10.0])


@pytest.fixture
def page_of(inspecting):
    def make(name, q, mode="tool"):
        page = inspecting(VelocityPage, name, q)
        page.choose(mode)
        return page

    return make


def box(page, name):
    found = page.findChild(QuantityBox, name)
    assert found is not None, name
    return found


def rates(page):
    return np.array([row.quantity for row in page.rows.boxes])


@pytest.mark.parametrize("axes", ["base", "tool"])
def test_a_typed_velocity_becomes_joint_speeds_that_make_it(page_of, axes):
    page = page_of("ur5e", UR)
    page.axes.setCurrentIndex(page.axes.findData(axes))
    box(page, "velocity_vx").setValue(80.0)
    box(page, "velocity_wz").setValue(-15.0)
    twist = jacobian(page._session.robot, UR) @ rates(page)
    if axes == "tool":
        R = forward_kinematics(page._session.robot, UR)[:3, :3]
        twist = np.concatenate([R.T @ twist[:3], R.T @ twist[3:]])
    np.testing.assert_allclose(twist, [0.08, 0.0, 0.05, 0.0, 0.0, -np.radians(15.0)], atol=1e-9)
    assert "nothing is lost" in page.verdict.text()
    assert page._stage.layers["inspect_velocity"]


def test_typed_joint_speeds_become_the_velocity_of_the_tool(page_of):
    page = page_of("rv-m1", POSE, "joints")
    box(page, "joint_speed_2").setValue(30.0)
    shown = np.array([b.quantity for b in page.twist.boxes])
    np.testing.assert_allclose(shown, jacobian(page._session.robot, POSE)[:, 1] * np.radians(30.0), atol=1e-9)
    assert box(page, "velocity_vx").isReadOnly()


def test_what_the_arm_cannot_do_is_named_and_the_nearest_shown(page_of):
    page = page_of("articulated", np.radians([20.0, 40.0, -60.0]))
    box(page, "velocity_vz").setValue(0.0)
    box(page, "velocity_wx").setValue(30.0)
    assert "turning about x" in page.verdict.text()
    assert "rank J = 3 < rank [J | ζ] = 4" in page.test.text()
    notes = [note.text() for note in page.twist.notes]
    assert all(notes)
    assert not page.twist.notes[0].isHidden()


def test_near_a_singularity_the_damping_is_shown_and_the_arm_is_said_to_be_able(page_of):
    page = page_of("ur5e", np.radians([20.0, -70.0, 100.0, -120.0, 0.2, 10.0]))
    assert "λ" in page.damping.text()
    assert "would have to race" in page.verdict.text()
    assert "is in the range" in page.test.text()


def test_bars_compare_with_the_top_speed_and_mark_an_assumed_one(page_of):
    page = page_of("rv-m1", POSE, "joints")
    box(page, "joint_speed_1").setValue(60.0)
    assert page.rows.bars[0].text == "50 % of 120*"
    assert not page.assumed.isHidden()
    box(page, "joint_speed_2").setValue(100.0)
    assert page.damping.text() == "Faster than its top speed: shoulder."
    assert page_of("ur5e", UR).rows.bars[0].text.endswith("of 180")


def test_accelerations_take_the_speeds_into_account(page_of):
    page = page_of("ur5e", UR)
    page.acceleration.title.setChecked(True)
    box(page, "acceleration_vz").setValue(200.0)
    robot, qd = page._session.robot, rates(page)
    qdd = np.array([row.quantity for row in page.acceleration.rows.boxes])
    np.testing.assert_allclose(tool_acceleration(robot, UR, qd, qdd), [0.0, 0.0, 0.2, 0.0, 0.0, 0.0], atol=1e-9)
    np.testing.assert_allclose(qdd, joint_accelerations(robot, UR, qd, [0.0, 0.0, 0.2, 0.0, 0.0, 0.0]).qdd)
    assert "q" in page.acceleration.drift.text()


def test_the_drawing_goes_with_the_page(page_of):
    page = page_of("ur5e", UR)
    page.set_seen(False)
    assert page._stage.layers["inspect_velocity"] == ()


# --- jogging ---------------------------------------------------------------------------------------------------------


def run(page, seconds):
    for _ in range(round(60 * seconds)):
        page.pad.driver.advance(1 / 60)


def rest(page):
    run(page, 1.0)
    assert not page.pad.driver.running


def test_a_held_button_moves_the_tool_and_is_one_undo_step(page_of):
    page = page_of("ur5e", UR, "jog")
    session = page._session
    steps, start = session.undo_stack.count(), forward_kinematics(session.robot, UR)[:3, 3]
    button = page.findChild(QPushButton, "jog_plus_x")
    button.pressed.emit()
    run(page, 1.0)
    assert page.twist.boxes[0].quantity == pytest.approx(0.05, abs=1e-6)
    button.released.emit()
    rest(page)
    way = forward_kinematics(session.robot, session.q)[:3, 3] - start
    np.testing.assert_allclose(way[1:], 0.0, atol=1e-6)
    assert way[0] == pytest.approx(0.05, rel=0.05)
    assert session.undo_stack.count() == steps + 1
    session.undo_stack.undo()
    np.testing.assert_array_equal(session.q, UR)


def test_keys_work_while_the_pad_has_the_focus_and_shift_turns(page_of, qtbot):
    page = page_of("ur5e", UR, "jog")
    pad = page.pad
    for key, modifier, direction in (
        (Qt.Key.Key_Left, Qt.KeyboardModifier.NoModifier, Direction("x", -1)),
        (Qt.Key.Key_PageUp, Qt.KeyboardModifier.NoModifier, Direction("z", 1)),
        (Qt.Key.Key_Up, Qt.KeyboardModifier.ShiftModifier, Direction("pitch", 1)),
    ):
        qtbot.keyPress(pad, key, modifier)
        assert pad.held == direction
        run(page, 0.1)
        qtbot.keyRelease(pad, key, modifier)
        assert pad.held is None
        rest(page)


def test_escape_stops(page_of, qtbot):
    page = page_of("ur5e", UR, "jog")
    qtbot.keyPress(page.pad, Qt.Key.Key_Right)
    run(page, 0.2)
    qtbot.keyPress(page.pad, Qt.Key.Key_Escape)
    rest(page)


def test_a_pad_that_is_left_stops(page_of, qtbot, shown):
    page = page_of("ur5e", UR, "jog")
    page.pad.hold(Direction("y", 1))
    other = shown(QLineEdit())
    page.pad._on_focus(page.pad, other)
    rest(page)
    page.pad.hold(Direction("y", 1))
    page.choose("tool")
    rest(page)


def test_a_limit_stops_it_with_a_sentence(page_of):
    page = page_of("rv-m1", POSE, "jog")
    page.pad.hold(Direction(2, -1))
    run(page, 4.0)
    assert not page.pad.driver.running
    assert page.pad.status.text() == "Stopped: the elbow is at its lower limit, −110.0°."


def test_a_singularity_stops_it_with_its_name_and_what_is_lost(page_of):
    page = page_of("ur5e", np.radians([0.0, -90.0, 90.0, -90.0, -90.0, 0.0]), "jog")
    page.pad.speed.set_quantity(0.3)
    page.pad.hold(Direction("x", 1))
    run(page, 6.0)
    text = page.pad.status.text()
    assert text.startswith("Stopped before the elbow singularity, J3 = ")
    assert "there the tool cannot move along" in text


def test_another_arm_ends_it_and_brings_its_own_buttons(page_of, session_with, qtbot):
    page = page_of("ur5e", UR, "jog")
    page.pad.hold(Direction("x", 1))
    run(page, 0.2)
    page._session.use_robot(session_with("rv-m1").robot)
    run(page, 0.1)
    assert not page.pad.driver.running
    assert {direction.what for direction in page.pad.buttons if isinstance(direction.what, int)} == set(range(5))

    def names():
        return [child.objectName() for child in page.pad.findChildren(QPushButton) if not child.isHidden()]

    qtbot.waitUntil(lambda: "jog_plus_j5" in names())  # a new button is shown once the layout hears of it
    assert "jog_plus_j6" not in names()


def test_a_second_key_waits_until_the_first_motion_has_come_to_rest(page_of):
    page = page_of("ur5e", UR, "jog")
    page.pad.hold(Direction("x", 1))
    run(page, 0.5)
    page.pad.hold(Direction("z", 1))
    run(page, 1.0)
    assert page.twist.boxes[2].quantity == pytest.approx(0.05, abs=1e-6)
    assert page.twist.boxes[0].quantity == pytest.approx(0.0, abs=1e-6)
