"""The How panel works the inverse kinematics out, follows the arm, and goes to the branch that is clicked."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QToolButton

from rvsim.files import load_robot
from rvsim.gui.panels.copying import CopyButton
from rvsim.gui.panels.how import HowPanel

POSE = np.radians([30.0, 40.0, -50.0, 20.0, 60.0])


@pytest.fixture
def panel(session_with, preferences, shown):
    session = session_with("rv-m1")
    session.move_to(POSE, "Plot")
    return shown(HowPanel(session, preferences))


def visible_steps(panel):
    return [view for view in panel.steps if view.isVisible()]


def settle(panel, qtbot):
    qtbot.waitUntil(lambda: not panel._pause.isActive())


def click(panel, qtbot, name):
    qtbot.mouseClick(panel.findChild(QToolButton, name), Qt.MouseButton.LeftButton)


def test_it_shows_the_steps_of_the_branch_the_arm_is_on(panel):
    assert panel.followed == ("front", "elbow up")
    assert [view.number.text() for view in visible_steps(panel)] == [str(i) for i in range(1, 9)]
    text = "\n".join(view.equations.text() for view in visible_steps(panel))
    assert "C = cos q₃ = (u²+w²−a₂²−a₃²)/(2 a₂ a₃)" in text
    for number in ("= 30.00°", "= 40.00°", "= −50.00°", "= 20.00°", "= 60.00°"):
        assert number in text
    assert any("−205.2 mm" in view.note.text() for view in visible_steps(panel))


def test_it_speaks_the_units_of_the_preferences(panel, preferences, qtbot):
    settle(panel, qtbot)
    preferences.set("angle_unit", "rad")
    preferences.set("length_unit", "m")
    settle(panel, qtbot)
    text = "\n".join(view.equations.text() + view.note.text() for view in visible_steps(panel))
    assert "= 0.5236 rad" in text
    assert "−0.2052 m" in text
    assert "°" not in text
    assert "mm" not in text


def test_the_way_can_be_chosen_without_moving_the_arm(panel, qtbot):
    click(panel, qtbot, "how_way_back")
    assert panel.followed[0] == "back"
    np.testing.assert_array_equal(panel._session.q, POSE)
    assert "≡ −150.00°" in "\n".join(view.equations.text() for view in visible_steps(panel))


def test_a_click_on_a_branch_goes_there(session_with, preferences, shown, qtbot):
    session = session_with("ur5e")
    panel = shown(HowPanel(session, preferences))
    click(panel, qtbot, "how_branch_left_shoulder_wrist_flip_elbow_down")
    settle(panel, qtbot)
    assert panel.followed == ("left shoulder", "wrist flip", "elbow down")
    row = panel.tree.rows[panel.followed]
    assert row.state.text() == "● the arm is here"
    assert session.undo_stack.undoText() == "Go to “left shoulder, wrist flip, elbow down”"


def test_a_branch_outside_the_limits_says_which_joint_and_is_not_taken(panel, qtbot):
    row = panel.tree.rows["front", "elbow down"]
    assert row.state.text() == "✕ outside limits"
    assert "elbow needs 50.00°, stops at 0.00°" in row.detail.text()
    click(panel, qtbot, "how_branch_front_elbow_down")
    np.testing.assert_array_equal(panel._session.q, POSE)
    assert panel.followed == ("front", "elbow down")


def test_a_target_out_of_reach_ends_in_reasons(panel):
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = np.diag([1.0, -1.0, -1.0]), (0.6, 0.0, 0.224)
    panel.set_target(T)
    panel._work_out()
    assert "mm outside the ring" in visible_steps(panel)[-1].failure.text()
    assert {row.state.text() for row in panel.tree.rows.values()} == {"✕ no solution"}
    panel.set_target(None)
    panel._work_out()
    assert panel.followed == ("front", "elbow up")


def test_it_follows_the_arm_but_not_while_hidden(panel, qtbot):
    settle(panel, qtbot)
    panel.hide()
    before = panel.solution
    panel._session.move_to(np.zeros(5), "Zero")
    assert panel.solution is before
    panel.show()
    settle(panel, qtbot)
    assert panel.solution is not before


def test_many_moves_are_worked_out_now_and_then_and_the_last_one_surely(panel, qtbot):
    settle(panel, qtbot)
    seen = []
    work_out = panel._work_out
    panel._work_out = lambda: (seen.append(1), work_out())
    for k in range(50):
        panel._session.move_to(POSE + 0.001 * k, "Drag", merge="drag")
    qtbot.waitUntil(lambda: len(seen) >= 2 and not panel._pause.isActive())
    assert len(seen) < 10
    here = min(panel.solution.solutions, key=panel._distance)
    np.testing.assert_allclose(here.branch.q, panel._session.q, atol=1e-9)


@pytest.mark.parametrize("name", ["rv-1a", "ur5e", "rrrp", "al5b", "scara", "cartesian", "cylindrical", "spherical"])
def test_every_arm_is_shown(session_with, preferences, shown, qtbot, name):
    panel = shown(HowPanel(session_with(name), preferences))
    assert visible_steps(panel)
    assert any(row.state.text() == "● the arm is here" for row in panel.tree.rows.values())
    qtbot.waitUntil(lambda: panel.typesetter.idle)


def test_an_arm_without_a_closed_form_says_why(session_with, preferences, shown):
    session = session_with("rv-m1")
    session.use_robot(session.robot.with_joint(3, alpha=0.3).renamed("odd", "Odd arm"))
    panel = shown(HowPanel(session, preferences))
    assert panel.solution is None
    assert panel.refusal.isVisible()
    assert "numeric" in panel.refusal.text()
    assert not visible_steps(panel)


def test_the_copy_is_a_latex_document(panel):
    panel.findChild(CopyButton, "how_copy").copy_as("LaTeX")
    text = QGuiApplication.clipboard().text()
    assert text.startswith("\\documentclass")
    assert "\\begin{align*}" in text
    assert text.count("\\subsection") > len(panel.solution.along(panel.followed))


@pytest.mark.parametrize("hidden", [False, True])
def test_what_is_copied_is_of_the_arm_that_is_there_now(panel, hidden):
    panel.setHidden(hidden)
    panel._session.move_to(POSE + 0.1, "Plot")
    panel._session.use_robot(load_robot("ur5e"))
    panel.copy.copy_as("LaTeX of this way only")
    assert {len(end.branch.q) for end in panel.solution.branches if end.branch} == {6}
