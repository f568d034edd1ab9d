"""The Compare page: a row for each method, the closed form first; the old table stays until the new one is there."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

from rvsim.experiment import TrajectoryTask
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.panels.path_compare import ComparePage
from rvsim.gui.renderers.choose import Choice, renderer_factory
from rvsim.gui.scene_view import SceneView
from rvsim.gui.stage import Stage
from rvsim.gui.tracker import PathTracker
from rvsim.gui.widgets import column_of


@pytest.fixture
def page(session_with, preferences, shown, qtbot: QtBot) -> Iterator[ComparePage]:
    session = session_with("ur5e")
    session.edit("path", replace(session.experiment, trajectory=TrajectoryTask("ellipse-moved")))
    view = SceneView(renderer_factory(Choice("painter", "for a test", "")))
    qtbot.addWidget(view)
    motion = MotionControl(session, preferences, session)
    tracker = PathTracker(session, motion, session)
    tracker.track_trajectory()
    motion.pause()
    made = ComparePage(session, preferences, Stage(session, motion, preferences, view), tracker, motion)
    host = QWidget()
    column_of(host, made)
    shown(host)
    made.set_seen(True)
    yield made
    made.close_worker()
    tracker.close()


def compared(page: ComparePage, qtbot: QtBot) -> None:
    qtbot.mouseClick(page.run_button, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: bool(page.entries) and not page.worker.busy, timeout=60_000)


def names(page: ComparePage) -> list[str]:
    return [row.texts[0] for row in page.model.rows]


def test_each_method_has_a_row_and_the_closed_form_is_the_first(page: ComparePage, qtbot: QtBot) -> None:
    assert page.table.isHidden()
    compared(page, qtbot)
    assert names(page) == ["Closed", "Newton", "DLS", "LM", "BFGS", "As 000"]
    assert {row.texts[4] for row in page.model.rows} == {"100 %"}
    assert "184 points" in page.verdict.text()
    csv = page.copy._formats["CSV"]().splitlines()
    assert len(csv) == 7
    assert len({line.count(",") for line in csv}) == 1


def test_given_up_the_old_table_stays(page: ComparePage, qtbot: QtBot) -> None:
    compared(page, qtbot)
    before = page.entries
    page.start()
    assert page.run_button.isHidden()
    assert names(page)
    page.cancel()
    assert page.entries is before
    assert not page.run_button.isHidden()
    page.close_worker()


def test_other_units_change_the_heads_and_the_numbers(page: ComparePage, preferences, qtbot: QtBot) -> None:
    compared(page, qtbot)
    assert page.model.headerData(3, Qt.Orientation.Horizontal) == "max mm"
    preferences.set("length_unit", "m")
    assert page.model.headerData(3, Qt.Orientation.Horizontal) == "max m"
