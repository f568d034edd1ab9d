"""The Program page: moves are taught, changed where they stand, undone, checked, run, saved and opened."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QPushButton
from pytestqt.qtbot import QtBot

from rvsim import forward_kinematics
from rvsim.experiment.program import ArcMove, Gripper, JointMove, LineMove, Wait
from rvsim.files import load_robot
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.panels.path_program import ProgramPage
from rvsim.gui.quantity_box import QuantityBox
from rvsim.gui.renderers.painter import PainterRenderer
from rvsim.gui.scene_view import SceneView
from rvsim.gui.stage import Stage
from rvsim.gui.tracker import PathTracker


@pytest.fixture
def page(session_with, preferences, shown, qtbot: QtBot):
    session = session_with("rv-m1")
    motion = MotionControl(session, preferences, session)
    tracker = PathTracker(session, motion, session)
    view = SceneView(PainterRenderer)
    qtbot.addWidget(view)
    stage = Stage(session, motion, preferences, view, session)
    made = shown(ProgramPage(session, preferences, stage, tracker, motion))
    made.set_seen(True)
    yield made
    motion.pause()
    made.close_worker()


def press(page: ProgramPage, name: str) -> None:
    page.findChild(QPushButton, f"program_{name}").click()


def teach(page: ProgramPage) -> None:
    """A pose, a line to another one's place, and a rest."""
    session = page._session
    press(page, "add_joint")
    start = session.q
    session.move_to(np.radians([20.0, 40.0, -70.0, -60.0, 0.0]), "there")
    press(page, "add_line")
    press(page, "add_wait")
    session.move_to(start, "back")


def planned(page: ProgramPage, qtbot: QtBot):
    qtbot.waitUntil(lambda: page.plan is not None)
    return page.plan


def test_moves_are_taught_by_driving_there_and_each_is_an_undo_step(page: ProgramPage, qtbot: QtBot) -> None:
    teach(page)
    kinds = [type(move) for move in page.program]
    assert kinds == [JointMove, LineMove, Wait]
    there = forward_kinematics(page._session.robot, np.radians([20.0, 40.0, -70.0, -60.0, 0.0]))[:3, 3]
    np.testing.assert_allclose(page.program[1].to, there)
    assert planned(page, qtbot).complete
    assert [row.sign for row in page.model.rows] == ["✓"] * 3
    page._session.undo_stack.undo()
    page._session.undo_stack.undo()
    assert [type(move) for move in page.program] == [JointMove, LineMove]


def test_the_numbers_of_the_chosen_move_are_changed_where_they_stand(page: ProgramPage) -> None:
    teach(page)
    page.list.choose(1)
    box = page.findChild(QuantityBox, "program_to_x")
    box.setValue(250.0)
    assert page.program[1].to[0] == pytest.approx(0.25)
    speed = page.findChild(QuantityBox, "program_speed")
    speed.setValue(20.0)
    assert page.program[1].speed == pytest.approx(0.2)
    speed.setValue(200.0)
    assert page.program[1].speed == pytest.approx(0.2)
    page.list.choose(2)
    page.findChild(QuantityBox, "program_seconds").setValue(2.5)
    assert page.program[2] == Wait(2.5)


def test_keys_and_buttons_shift_duplicate_and_delete(page: ProgramPage, qtbot: QtBot) -> None:
    teach(page)
    page.activateWindow()
    page.list.choose(2)
    page.list.setFocus()
    qtbot.keyClick(page.list, Qt.Key.Key_Up, Qt.KeyboardModifier.AltModifier)
    assert [type(move) for move in page.program] == [JointMove, Wait, LineMove]
    qtbot.keyClick(page.list, Qt.Key.Key_Down, Qt.KeyboardModifier.AltModifier)
    press(page, "duplicate")
    assert [type(move) for move in page.program] == [JointMove, LineMove, Wait, Wait]
    qtbot.keyClick(page.list, Qt.Key.Key_Delete)
    press(page, "delete")
    assert [type(move) for move in page.program] == [JointMove, LineMove]
    press(page, "up")
    assert [type(move) for move in page.program] == [LineMove, JointMove]


def test_what_cannot_be_done_says_why_and_the_rest_waits(page: ProgramPage, qtbot: QtBot) -> None:
    teach(page)
    page.list.choose(1)
    page.findChild(QuantityBox, "program_to_x").setValue(2000.0)
    assert not planned(page, qtbot).complete
    assert [row.sign for row in page.model.rows] == ["✓", "✗", "·"]
    assert "out of reach" in page.verdict.text()
    press(page, "check")
    assert page._session.sentences[-1][1] == "warning"


def test_run_plays_what_can_be_done_from_where_the_arm_is_and_marks_the_move(page: ProgramPage, qtbot: QtBot) -> None:
    teach(page)
    before = page._session.q
    press(page, "run")
    qtbot.waitUntil(lambda: page._motion.player.trajectory is not None)
    plan = page.plan
    np.testing.assert_array_equal(plan.q, before)
    page._motion.seek(0.5 * (plan.starts[1] + plan.starts[2]))
    assert page.model.running == 1
    page._motion.seek(plan.starts[-1])
    assert page.model.running == 2
    page.refresh()
    assert page.plan is plan  # the moments of its own run ask for no other plan
    page._session.move_to(0.5 * before - 0.1, "away")
    assert page.plan is None


def test_an_arc_begins_as_a_half_way_up_and_the_gripper_closes_then_opens(page: ProgramPage) -> None:
    teach(page)
    press(page, "add_arc")
    arc = page.program[-1]
    assert isinstance(arc, ArcMove)
    assert arc.via[2] > 0.5 * (arc.to[2] + page.program[1].to[2])
    press(page, "add_gripper")
    press(page, "add_gripper")
    assert page.program[-2:] == (Gripper(0.0), Gripper(1.0))


def test_the_gripper_is_seen_to_close_while_the_program_runs(page: ProgramPage, qtbot: QtBot) -> None:
    session, motion, stage = page._session, page._motion, page._stage
    page._put("Grip", (Gripper(0.0, 2.0), Wait(1.0), Gripper(0.5, 1.0)), 0)
    planned(page, qtbot)
    press(page, "run")
    motion.pause()
    width = _seen_width(stage)
    widths = {}
    for t in (0.0, 1.0, 2.0, 3.0, 4.0):
        motion.seek(t)
        qtbot.waitUntil(lambda: not stage._stale.isActive())
        widths[t] = _seen_width(stage) / width
    closed = 1.0 - 2.0 * 0.032 / 0.070  # what the robot file says, of the 70 mm between the fingers
    expected = np.interp((1.0, 0.5, 0.0, 0.0, 0.5), (0.0, 1.0), (closed, 1.0))
    np.testing.assert_allclose(list(widths.values()), expected, atol=1e-9)
    stage.show_gripper(1.0)  # a connected arm's own
    qtbot.waitUntil(lambda: not stage._stale.isActive())
    assert _seen_width(stage) == pytest.approx(width)
    stage.show_gripper(None)
    assert stage.opening == pytest.approx(0.5)
    motion.load(None, "")
    assert stage.opening == pytest.approx(0.5)  # nothing has opened it
    session.use_robot(load_robot("al5b"))
    assert stage.opening == 1.0


def _seen_width(stage: Stage) -> float:
    stage._preferences.set("look", "stick")
    (outline,) = [item for item in stage.view.scene.items if item.key == "arm.gripper"]
    return float(np.linalg.norm(outline.points[0] - outline.points[-1]))


def test_the_tool_may_be_turned_kept_or_free(page: ProgramPage) -> None:
    teach(page)
    page.list.choose(1)
    page.editor._choose_tool("turn")
    assert page.program[1].tool == "turn"
    assert page.findChild(QuantityBox, "program_roll") is not None
    page.editor._choose_tool("free")
    assert page.program[1].tool == "free"


def test_a_saved_program_is_opened_again_and_a_spoilt_one_says_where(page: ProgramPage, tmp_path: Path) -> None:
    teach(page)
    file, program = tmp_path / "p.toml", page.program
    page.save_to(file)
    press(page, "delete")
    page.open_from(file)
    assert page.program == program or len(page.program) == len(program)
    file.write_text(file.read_text(encoding="utf-8").replace("seconds", "secs"), encoding="utf-8")
    page.open_from(file)
    assert "key 'secs'" in page._session.sentences[-1][0]
    page.save_to(tmp_path / "no folder" / "p.toml")
    assert page._session.sentences[-1][1] == "error"


def test_another_arm_has_a_program_of_its_own(page: ProgramPage, session_with) -> None:
    teach(page)
    page._session.use_robot(session_with("ur5e").robot)
    assert page.model.rowCount() == 0
    page._session.undo_stack.undo()
    assert page.model.rowCount() == 3
