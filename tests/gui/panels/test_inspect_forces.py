"""The Forces page: what is asked at the tool and what the joints hold, by boxes, by the hand in the scene, and back."""

import math

import numpy as np
import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QTableView

from rvsim.dynamics import gravity_torques, joint_torques, wrench_in_base
from rvsim.files import load_robot
from rvsim.gui.app import build_window
from rvsim.gui.panels.inspect_forces import ForcesPage
from rvsim.gui.quantity_box import QuantityBox
from rvsim.kinematics import forward_kinematics
from rvsim.motion import joint_move

POSE = np.radians([30.0, 40.0, -50.0, 20.0, 60.0])


@pytest.fixture
def page_of(qtbot, preferences):
    def make(name, pose=None):
        window = build_window(preferences, robot=name, renderer="painter")
        qtbot.addWidget(window)
        window.resize(1200, 800)
        page = ForcesPage(window.session, preferences, window.stage, window)
        if pose is not None:
            assert window.session.move_to(pose, "Plot")
        page.set_seen(True)
        return page

    return make


def enter(page, name, value):
    box = page.findChild(QuantityBox, name)
    box.setValue(value)


def torques(page):
    return np.array([row.total for row in page.model.rows])


def test_the_table_shows_what_the_wrench_takes(page_of):
    page = page_of("rv-m1", POSE)
    wrench = np.array([5.0, -3.0, 12.0, 0.4, -0.2, 0.1])
    for name, value in zip(("fx", "fy", "fz", "mx", "my", "mz"), wrench, strict=True):
        enter(page, f"wrench_{name}", value)
    session = page._session
    np.testing.assert_allclose(torques(page), joint_torques(session.robot, session.q, wrench), atol=1e-12)
    table = page.findChild(QTableView, "torque_table")
    shown = table.model().index(1, 3).data()
    assert shown == f"{torques(page)[1]:.2f}".replace("-", "\u2212")
    assert session.move_to(POSE + 0.1, "Plot")
    np.testing.assert_allclose(torques(page), joint_torques(session.robot, session.q, wrench), atol=1e-12)


def test_other_axes_show_the_same_wrench_in_other_numbers(page_of):
    page = page_of("rv-m1", POSE)
    enter(page, "wrench_fz", 10.0)
    before = torques(page)
    page.axes.setCurrentIndex(page.axes.findData("tool"))
    page.axes.activated.emit(page.axes.currentIndex())
    np.testing.assert_allclose(torques(page), before, atol=1e-12)
    session = page._session
    np.testing.assert_allclose(
        wrench_in_base(session.robot, session.q, page.load.wrench), [0, 0, 10, 0, 0, 0], atol=1e-9
    )
    assert session.move_to(np.zeros(5), "Zero")  # now the wrench turns with the tool
    in_base = wrench_in_base(session.robot, session.q, page.load.wrench)
    np.testing.assert_allclose(torques(page), joint_torques(session.robot, session.q, in_base), atol=1e-12)


def test_a_payload_and_the_own_weight_are_added(page_of):
    page = page_of("ur5e")
    enter(page, "payload", 2.0)
    page.weight.setChecked(True)
    session = page._session
    expected = gravity_torques(session.robot, session.q, payload=2.0)
    np.testing.assert_allclose(torques(page), expected, atol=1e-9)
    page.clear.click()
    np.testing.assert_allclose(torques(page), gravity_torques(session.robot, session.q), atol=1e-9)
    assert page.payload.quantity == 0.0


def test_an_arm_without_masses_offers_no_weight_and_names_its_sliding_joint_in_newtons(page_of):
    page = page_of("rrrp")
    enter(page, "wrench_fz", 5.0)
    assert page.weight.isHidden()
    assert page.model.index(3, 3).data() == "5.0 N"
    assert page.model.index(0, 3).data().endswith(" N unit")
    assert "No joint of this arm has a torque rating" in page.largest.text()


def test_the_largest_force_names_the_joint_that_limits_it(page_of):
    page = page_of("rv-m1", np.zeros(5))
    robot = page._session.robot
    # At q = 0 the wrist pitch holds fz with d5 = 72 mm of lever, and is rated for 2 N m.
    assert page.largest.text() == f"{2.0 / 0.072:.1f} N: then J4 wrist pitch reaches its 2.00 N m, an assumed rating."
    assert robot.joints[3].max_torque.value == 2.0


def rate(page, joint, text):
    model = page.ratings.model
    return model.setData(model.index(joint, 1), text)


def origins(page):
    model = page.ratings.model
    return [model.index(joint, 2).data() for joint in range(model.rowCount())]


def test_a_typed_rating_goes_to_a_copy_and_bars_and_largest_force_follow(page_of):
    page = page_of("rv-m1", np.zeros(5))
    session = page._session
    enter(page, "wrench_fz", 10.0)
    assert origins(page) == ["assumed"] * 5
    assert rate(page, 3, "2*1.5")
    assert session.robot.name == "my-rv-m1"
    assert session.undo_stack.undoText() == "Edit the torque rating of J4 of my RV-M1"
    assert page.largest.text() == f"{3.0 / 0.072:.1f} N: then J4 wrist pitch reaches its 3.00 N m, your rating."
    assert page.model.index(3, 4).data() == "24 %"
    assert page.model.index(1, 4).data().startswith("≈ ")
    assert origins(page) == ["assumed"] * 3 + ["yours"] + ["assumed"]
    assert "yours, entered by hand" in page.model.index(3, 4).data(Qt.ItemDataRole.ToolTipRole)
    session.undo_stack.undo()
    assert session.robot.name == "rv-m1"
    assert "reaches its 2.00 N m" in page.largest.text()
    np.testing.assert_array_equal(page.load.wrench[:3], [0.0, 0.0, 10.0])


@pytest.mark.parametrize(
    ("text", "word"), [("0", "above 0"), ("-3", "above 0"), ("nan", "nan"), ("1/0", "1/0"), ("strong", "strong")]
)
def test_a_rating_that_no_drive_has_is_refused_with_a_sentence(page_of, text, word):
    page = page_of("rv-m1")
    rate(page, 1, text)
    assert not page.ratings.message.isHidden()
    assert word in page.ratings.message.text()
    assert page._session.undo_stack.count() == 0
    rate(page, 1, "25")
    assert page.ratings.message.isHidden()


def test_an_arm_without_ratings_can_be_given_some_and_a_joint_none(page_of):
    page = page_of("rrrp")
    assert origins(page) == ["–"] * 4
    assert "No source gives" in page.ratings.note.text()
    page.ratings.guess.click()
    assert page._session.robot.name == "my-rrrp"
    assert page.ratings.guess.isHidden()
    assert origins(page) == ["assumed"] * 4
    assert page.ratings.model.index(3, 1).data() == "100.0 N"
    assert "reaches its" in page.largest.text()
    rate(page, 3, "")
    assert origins(page) == ["assumed"] * 3 + ["–"]
    assert page.model.index(3, 4).data() == "–"


def test_a_payload_leaves_less_for_the_largest_force(page_of):
    page = page_of("rv-m1", np.zeros(5))
    enter(page, "payload", 1.0)
    assert page.largest.text().startswith(f"{2.0 / 0.072 - 9.80665:.1f} N: ")
    assert "payload of 1.000 kg counted in" in page.largest.text()


def test_hidden_pages_draw_nothing_and_leave_the_pointer_alone(page_of):
    page = page_of("rv-m1")
    view, drag = page._stage.view, page.drag
    assert view.grabber is drag
    page.set_seen(False)
    assert view.grabber is not drag
    assert page._stage._layers["inspect_forces"] == ()


def pixel_of(page, point):
    view = page._stage.view
    x, y, _ = view.camera.project(np.asarray(point)[None], view.width(), view.height())[0]
    return QPointF(float(x), float(y))


def test_dragging_the_arrows_end_changes_the_force_in_the_plane_that_faces_the_eye(page_of):
    page = page_of("ur5e")
    drag, view = page.drag, page._stage.view
    enter(page, "wrench_fx", 60.0)
    arrows = page._arrows
    start, normal = pixel_of(page, arrows.tip), view.camera.axes[2]
    drag.hover(start)
    assert drag.lit_now
    assert drag.press(start)
    drag.drag(start + QPointF(40.0, -60.0), Qt.KeyboardModifier.NoModifier)
    change = page.load.wrench[:3] - [60.0, 0.0, 0.0]
    assert np.linalg.norm(change) > 5.0
    assert abs(change @ normal) < 1e-9 * np.linalg.norm(change)
    moved = pixel_of(page, page._arrows.tip)
    assert math.hypot(moved.x() - start.x() - 40.0, moved.y() - start.y() + 60.0) < 1e-6
    drag.release()
    assert not drag.held


def test_a_drag_pulls_a_force_out_of_the_tool_and_escape_takes_it_back(page_of):
    page = page_of("rv-m1")
    at = pixel_of(page, forward_kinematics(page._session.robot, page._session.q)[:3, 3])
    assert page.drag.press(at)
    page.drag.drag(at + QPointF(0.0, -80.0), Qt.KeyboardModifier.ControlModifier)
    assert np.any(page.load.wrench)
    np.testing.assert_array_equal(page.load.wrench, np.round(page.load.wrench))
    assert page.drag.key(Qt.Key.Key_Escape, Qt.KeyboardModifier.NoModifier, False)
    assert not np.any(page.load.wrench)
    assert not page.drag.press(at + QPointF(0.0, -300.0))


def test_a_drag_is_one_undo_step_and_one_that_is_given_up_is_none(page_of):
    page = page_of("rv-m1")
    stack = page._session.undo_stack
    at = pixel_of(page, page._arrows.tip)
    for keep in (True, False):
        assert page.drag.press(at)
        for step in range(5):
            page.drag.drag(at + QPointF(10.0 * step, -80.0), Qt.KeyboardModifier.NoModifier)
        if keep:
            at = pixel_of(page, page._arrows.tip)
            pulled = page.load
            page.drag.release()
        else:
            page.drag.key(Qt.Key.Key_Escape, Qt.KeyboardModifier.NoModifier, False)
    assert page.load is pulled
    assert stack.count() == 1
    assert stack.undoText() == "Pull at the tool"
    stack.undo()
    assert not np.any(page.load.wrench)
    assert page.forces.boxes[2].quantity == 0.0
    np.testing.assert_allclose(torques(page), 0.0)


def test_what_is_entered_can_be_undone_one_by_one_and_the_boxes_follow(page_of):
    page = page_of("ur5e")
    stack = page._session.undo_stack
    enter(page, "wrench_fz", 20.0)
    page.forces.finished.emit()
    enter(page, "wrench_mx", 3.0)
    enter(page, "payload", 2.0)
    page.weight.click()
    page.axes.setCurrentIndex(page.axes.findData("tool"))
    page.axes.activated.emit(page.axes.currentIndex())
    page.clear.click()
    page.clear.click()  # nothing is left to take away
    texts = [stack.text(index) for index in range(stack.count())]
    assert texts == [
        "Set the force at the tool",
        "Set the moment at the tool",
        "Set the payload",
        "Count the arm's own weight",
        "Write the wrench in tool axes",
        "Take the load away",
    ]
    stack.setIndex(3)
    assert (page.axes.currentData(), page.weight.isChecked(), page.payload.quantity) == ("base", False, 2.0)
    stack.setIndex(1)
    assert page.payload.quantity == 0.0
    np.testing.assert_array_equal(page.forces.values, [0.0, 0.0, 20.0])
    np.testing.assert_array_equal(page.moments.values, 0.0)


def test_every_arm_keeps_its_own_load(page_of):
    page = page_of("rv-m1")
    session = page._session
    enter(page, "payload", 1.0)
    first, other = session.robot, load_robot("ur5e")
    session.use_robot(other)
    assert page.payload.quantity == 0.0
    enter(page, "payload", 3.0)
    session.use_robot(first)
    assert page.payload.quantity == 1.0
    session.use_robot(other)
    assert page.payload.quantity == 3.0


def test_the_arm_can_be_pulled_at_while_it_moves_and_that_is_one_undo_step(page_of):
    page = page_of("rv-m1")
    session, motion, stack = page._session, page._stage.motion, page._session.undo_stack
    home = session.q
    motion.load(joint_move(session.robot, home, home + 0.4, seconds=2.0), "Move")
    motion.play()
    motion.advance(0.1)
    began = session.q
    at = pixel_of(page, page._arrows.tip)
    assert page.drag.press(at)
    for step in range(1, 6):
        page.drag.drag(at + QPointF(10.0 * step, -40.0), Qt.KeyboardModifier.NoModifier)
        motion.advance(0.05)
    page.drag.release()
    assert motion.player.playing
    motion.advance(0.05)
    assert [stack.text(index) for index in range(stack.count())] == ["Move", "Pull at the tool", "Move"]
    stack.undo()
    stack.undo()
    np.testing.assert_array_equal(session.q, began)
    assert not np.any(page.load.wrench)


def test_the_payload_hangs_apart_from_the_arrow_of_the_force(page_of):
    page = page_of("rv-m1")
    enter(page, "payload", 1.2)
    tip = pixel_of(page, page._arrows.tip)
    assert page.drag.press(tip)
    page.drag.drag(tip, Qt.KeyboardModifier.NoModifier)
    page.drag.release()
    np.testing.assert_allclose(page.load.wrench, 0.0, atol=1e-6)
    np.testing.assert_allclose(page._arrows.force, 0.0, atol=1e-6)
    arrow = next(item for item in page._stage._layers["inspect_forces"] if ".payload" in item.key)
    assert np.ptp(arrow.points[:, 2]) > 0.0
    assert arrow.points[:, 2].max() <= page._arrows.origin[2] + 1e-12
    assert page._arrows.mass_text == "1.200 kg"


def test_copies_name_joint_and_unit(page_of):
    page = page_of("rv-m1")
    enter(page, "wrench_fz", 10.0)
    page.copy.copy_as("text")
    lines = QGuiApplication.clipboard().text().splitlines()
    assert len(lines) == 5
    assert lines[1].startswith("tau_2 (shoulder)")
    assert lines[1].endswith(" N m")
