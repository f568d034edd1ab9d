"""The Compare page: a row for each method, the closed form first; the old table stays until the new one is there."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QComboBox, QWidget
from pytestqt.qtbot import QtBot

from rvsim.experiment import TrajectoryTask
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.panels.path_compare import ComparePage
from rvsim.gui.renderers.choose import Choice, renderer_factory
from rvsim.gui.scene_view import SceneView
from rvsim.gui.stage import Stage
from rvsim.gui.tracker import PathTracker
from rvsim.gui.widgets import column_of
from rvsim.kinematics import forward_kinematics


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


def numbers(page: ComparePage) -> dict[str, tuple[str, ...]]:
    return {row.texts[0]: row.texts[1:] for row in page.deviation.model.rows}


def choose(box: QComboBox, data: str) -> None:
    box.setCurrentIndex(box.findData(data))
    box.activated.emit(box.currentIndex())


def drawn(page: ComparePage) -> set[str]:
    return {item.key.rstrip("0123456789") for item in page._stage._layers.get("path_compare", ())}


def test_asked_and_done_are_told_for_each_axis_at_the_points_and_between_them(page: ComparePage) -> None:
    section = page.deviation
    assert list(numbers(page)) == ["x", "y", "z", "all"]
    between = float(numbers(page)["all"][2].replace("\u2212", "-"))
    choose(section.where, "points")
    assert float(numbers(page)["all"][2].replace("\u2212", "-")) < 1e-9 * between
    assert "µs a point" in section.solved.text()
    assert len(section.copy._formats["CSV"]().splitlines()) == 5


def test_the_deviation_is_magnified_in_the_scene_and_the_legend_says_how_much(page: ComparePage) -> None:
    legend = page._stage._legend
    assert drawn(page) == {"deviation.along"}
    assert [entry.text for entry in legend.entries] == ["path asked for", "where the tool went"]
    choose(page.deviation.times, "1000")
    assert drawn(page) == {"deviation.along", "deviation.whiskers", "deviation.far"}
    assert legend.entries[-1].text == "deviation 1000 ×"
    page.set_seen(False)
    assert not drawn(page)
    assert len(legend.entries) == 2


def test_missed_stretches_have_looks_of_their_own(page: ComparePage) -> None:
    page._session.edit("path", replace(page._session.experiment, trajectory=TrajectoryTask("ellipse")))
    page._tracker.track_trajectory()
    page._motion.pause()
    assert "deviation.off" in drawn(page)
    texts = {entry.text: entry for entry in page._stage._legend.entries}
    assert texts["not reached"].dashed
    assert texts["not reached"].sign == "×"
    assert texts["off the path on purpose"].dashed
    assert "70 points are missed" in page.deviation.told.text()


def test_a_click_goes_to_where_the_tool_is_the_farthest_off(page: ComparePage, qtbot: QtBot) -> None:
    off = page.deviation.off
    assert off is not None
    qtbot.mouseClick(page.deviation.worst, Qt.MouseButton.LeftButton)
    tool = forward_kinematics(page._session.robot, page._session.q)[:3, 3]
    there = off.place[np.argmax(off.distance)]
    assert np.linalg.norm(tool - there) < 1e-3


def test_the_curves_are_a_click_away(page: ComparePage, preferences, qtbot: QtBot) -> None:
    preferences.set("plots", "q")
    qtbot.mouseClick(page.deviation.curves, Qt.MouseButton.LeftButton)
    assert preferences["show_plots"]
    assert preferences["plots"] == "q,deviation"
