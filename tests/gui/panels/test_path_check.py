"""The Check page: findings that lead to their moment, repairs that work when pressed, the best way that is gone."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QPushButton, QWidget
from pytestqt.qtbot import QtBot

from rvsim.experiment import TrajectoryTask
from rvsim.files import load_robot
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.panels.path_check import CheckPage
from rvsim.gui.panels.path_check_rows import FindingRow
from rvsim.gui.renderers.choose import Choice, renderer_factory
from rvsim.gui.scene_view import SceneView
from rvsim.gui.stage import Stage
from rvsim.gui.tracker import PathTracker
from rvsim.gui.widgets import column_of
from rvsim.kinematics import forward_kinematics

Make = Callable[[str, str], CheckPage]


@pytest.fixture
def page_of(session_with, preferences, shown, qtbot) -> Iterator[Make]:
    """The page of an arm, with a path tracked: "line" or the name of a trajectory."""
    kept: list[tuple[CheckPage, PathTracker, object]] = []

    def make(name: str, path: str) -> CheckPage:
        session = session_with(name)
        view = SceneView(renderer_factory(Choice("painter", "for a test", "")))
        qtbot.addWidget(view)
        motion = MotionControl(session, preferences, session)
        tracker = PathTracker(session, motion, session)
        page = CheckPage(session, preferences, Stage(session, motion, preferences, view), tracker, motion)
        host = QWidget()
        column_of(host, page)
        kept.append((page, tracker, host))
        shown(host)
        if path == "line":
            tracker.track_line()
        elif path:
            session.edit("path", replace(session.experiment, trajectory=TrajectoryTask(path)))
            tracker.track_trajectory()
        motion.pause()
        page.set_seen(True)
        return page

    yield make
    for _, tracker, _ in kept:
        tracker.close()


def rows(page: CheckPage) -> list[FindingRow]:
    return [row for row in page.findings.rows if not row.isHidden()]


def test_without_a_path_it_says_what_it_is_for(page_of: Make) -> None:
    page = page_of("rv-m1", "")
    assert "Path page" in page.summary.text()
    assert not rows(page)
    assert page.repair_box.isHidden()


def test_the_sources_line_says_which_joints_keep_it_from_7_of_11_points(page_of: Make) -> None:
    texts = [row.sentence.text() for row in rows(page_of("rv-m1", "line"))]
    assert texts[0] == "36 %: 4 of 11 points reached."
    assert texts[1] == "Points 1–6: the elbow needs −156.7° … −117.3° and stops at −110°."
    assert texts[2] == "Point 11: the wrist pitch needs −93.6°, stops at −90°."


def test_a_click_on_a_finding_shows_the_arm_at_that_moment(page_of: Make, qtbot: QtBot) -> None:
    page = page_of("ur5e", "ellipse")
    report = page.report
    assert report is not None
    number = next(i for i, finding in enumerate(report.findings) if finding.kind == "singular")
    row = rows(page)[number]
    qtbot.mouseClick(row, Qt.MouseButton.LeftButton)
    assert report.trajectory is not None
    np.testing.assert_allclose(page._session.q, report.trajectory.q(report.findings[number].time or 0.0))


def test_a_repair_does_what_its_button_says(page_of: Make, qtbot: QtBot) -> None:
    page = page_of("ur5e", "ellipse")
    qtbot.waitUntil(lambda: not page.repairs.search.busy)
    move = page.findChild(QPushButton, "check_repair_move")
    assert move is not None
    assert move.text().startswith("Move by (")
    qtbot.mouseClick(move, Qt.MouseButton.LeftButton)
    tracking = page._session.tracking
    assert tracking is not None
    assert tracking.complete
    assert rows(page)[0].sentence.text() != "62 %: 114 of 184 points reached."
    page._motion.pause()
    page._session.undo_stack.undo()
    page._session.undo_stack.undo()
    assert page._session.experiment.trajectory.placement is None


def test_a_clean_path_offers_no_repairs(page_of: Make) -> None:
    page = page_of("al5b", "star")
    assert page.summary.text() == "✓ Nothing speaks against running it."
    assert page.repair_box.isHidden()
    assert not page.repairs.search.worker.busy


def test_a_search_that_is_given_up_offers_nothing_later(page_of: Make, qtbot: QtBot) -> None:
    page = page_of("ur5e", "ellipse")
    search = page.repairs.search
    qtbot.mouseClick(page.repairs.cancel_button, Qt.MouseButton.LeftButton)
    search.close()
    assert not search.offers
    assert page.repairs.searching.isHidden()


def test_the_best_way_home_is_found_and_gone(page_of: Make) -> None:
    page = page_of("ur5e", "")
    session, section = page._session, page.best_way
    session.edit("pose", session.experiment.at(np.radians([40, -60, 80, -50, -70, 20])))
    section.search()
    assert len(section.ways) > 1
    section.go()
    assert page._motion.player.trajectory is section.ways[0].moves[section.ways[0].law]
    page._motion.seek(page._motion.player.duration)
    home = forward_kinematics(session.robot, session.robot.home)
    np.testing.assert_allclose(forward_kinematics(session.robot, session.q), home, atol=1e-9)
    page._motion.pause()


def test_no_way_of_another_arm_is_gone(page_of: Make) -> None:
    page = page_of("ur5e", "")
    page.best_way.search()
    page.hide()
    page._session.use_robot(load_robot("rv-m1"))
    page.best_way.go()
    assert page._motion.player.trajectory is None


def test_what_was_found_is_of_the_pose_where_it_was_asked(page_of: Make) -> None:
    page = page_of("ur5e", "")
    page.best_way.search()
    assert page.best_way.ways
    page._session.edit("pose", page._session.experiment.at(page._session.q + 0.1))
    assert not page.best_way.ways
