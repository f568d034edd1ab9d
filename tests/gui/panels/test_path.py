"""The Path panel: each choice is an undo step of its own, and what was missed comes with what would help."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtWidgets import QComboBox, QPushButton, QSpinBox
from pytestqt.qtbot import QtBot

from rvsim.experiment import Load, TrajectoryTask
from rvsim.gui.motion_control import MotionControl
from rvsim.gui.panels.path import PathPanel
from rvsim.gui.tracker import PathTracker
from rvsim.lab.lines import line_presets


@pytest.fixture
def panel(session_with, preferences, shown) -> Iterator[PathPanel]:
    session = session_with("rv-m1")
    motion = MotionControl(session, preferences, session)
    tracker = PathTracker(session, motion, session)
    made = shown(PathPanel(session, preferences, tracker))
    yield made
    tracker.close()


def choose(panel: PathPanel, name: str, data: object) -> None:
    box = panel.findChild(QComboBox, name)
    box.setCurrentIndex(box.findData(data))
    box.activated.emit(box.currentIndex())


@pytest.mark.parametrize(
    ("selector", "choices"),
    [
        ("line_orientation", ("free", "keep", "down")),
        ("trajectory_orientation", ("free", "keep", "down")),
        ("trajectory_selector", ("star", "letter-raw", "letter-flat")),
    ],
)
def test_each_choice_is_an_undo_step_and_the_same_one_again_is_none(
    panel: PathPanel, selector: str, choices: tuple[str, ...]
) -> None:
    stack = panel.line._session.undo_stack
    for choice in choices:
        choose(panel, selector, choice)
        choose(panel, selector, choice)
    assert stack.count() == len(choices)
    stack.undo()
    assert panel.findChild(QComboBox, selector).currentData() == choices[-2]


def test_two_steps_typed_one_after_the_other_are_two_undo_steps(panel: PathPanel) -> None:
    box = panel.line.resolution
    for value in (0.05, 0.2):
        box.setValue(value)
        box.editingFinished.emit()
    panel.line._session.undo_stack.undo()
    assert box.value() == pytest.approx(0.05)


def repairs(panel: PathPanel, qtbot: QtBot) -> dict[str, QPushButton]:
    """What is offered when the search is over: button texts by the names of the repairs."""
    search = panel.result._tracker.search
    qtbot.waitUntil(lambda: not search.busy)
    found = {button.objectName(): button for button in panel.result.findChildren(QPushButton)}
    return {offer.name: found[f"repair_{offer.name.replace(' ', '_')}"] for offer in search.offers}


def track_the_sources_line(panel: PathPanel) -> None:
    preset = line_presets(panel.line._session.robot)[-1]
    for end, point in (("start", preset.start), ("end", preset.end)):
        for box, value in zip(panel.line.boxes[end], point, strict=True):
            box.setValue(1e3 * value)
    panel.line.button.click()
    assert "reached points" in panel.result.rms.text()


def test_missed_points_come_with_the_repairs_that_the_check_page_offers(panel: PathPanel, qtbot: QtBot) -> None:
    track_the_sources_line(panel)
    texts = {name: button.text() for name, button in repairs(panel, qtbot).items()}
    assert set(texts) == {"free", "move", "ignore limits"}
    assert texts["free"] == "Free pitch"
    assert texts["move"].startswith("Move by (")
    assert texts["ignore limits"] == "Ignore limits"


def test_repairs_are_told_in_the_units_that_are_preferred_now(panel: PathPanel, preferences, qtbot: QtBot) -> None:
    track_the_sources_line(panel)
    assert repairs(panel, qtbot)["move"].text().endswith(" mm")
    preferences.set("length_unit", "m")
    assert repairs(panel, qtbot)["move"].text().endswith(" m")


def test_the_result_is_said_in_the_preferred_units(panel: PathPanel, preferences) -> None:
    track_the_sources_line(panel)
    sentence, session = panel.result.sentence, panel.line._session
    assert "−110°" in sentence.text()
    assert " mm " in panel.result.rms.text()
    preferences.set("angle_unit", "rad")
    preferences.set("length_unit", "m")
    assert "−1.92 rad" in sentence.text()
    assert "°" not in sentence.text()
    assert " m (reached points)" in panel.result.rms.text()
    panel.line.button.click()
    assert session.sentences[-1][0] == sentence.text()


@pytest.mark.parametrize(("name", "reached"), [("free", 6), ("ignore limits", 11), ("move", 11)])
def test_each_repair_of_the_sources_line_reaches_more_than_four_points(
    panel: PathPanel, name: str, reached: int, qtbot: QtBot
) -> None:
    track_the_sources_line(panel)
    repairs(panel, qtbot)[name].click()
    assert panel.line._session.tracking.reached_count == reached


def test_a_letter_out_of_reach_is_moved_and_scaled_to_where_it_can_be_drawn(panel: PathPanel, qtbot: QtBot) -> None:
    choose(panel, "trajectory_selector", "letter-raw")
    panel.trajectory.button.click()
    offered = repairs(panel, qtbot)
    assert set(offered) == {"move and scale"}
    assert panel.result.rms.text() == "–"
    offered["move and scale"].click()
    tracking = panel.line._session.tracking
    assert tracking.complete
    assert not np.isnan(tracking.q).any()


def test_limits_that_count_again_bring_back_what_is_reached_within_them(panel: PathPanel, qtbot: QtBot) -> None:
    session = panel.line._session
    track_the_sources_line(panel)
    repairs(panel, qtbot)["ignore limits"].click()
    assert session.tracking.complete
    session.edit("Respect limits", replace(session.experiment, ignore_limits=False))
    assert session.tracking.reached_count == 4


def test_limits_that_count_again_leave_a_path_that_heeds_them(panel: PathPanel) -> None:
    session = panel.line._session
    line = line_presets(session.robot)[0].task()
    session.edit("Ignore limits", replace(session.experiment, ignore_limits=True, line=line))
    panel.line.button.click()
    session.edit("Respect limits", replace(session.experiment, ignore_limits=False))
    assert session.tracking is not None


def test_the_number_of_points_can_be_typed(panel: PathPanel) -> None:
    panel.findChild(QSpinBox, "line_points").setValue(11)
    assert panel.line.resolution.quantity == pytest.approx(0.1)
    assert panel.line._session.experiment.line.samples == 11


def test_a_result_goes_with_what_it_was_the_result_of_and_undo_brings_it_back(panel: PathPanel) -> None:
    session = panel.line._session
    panel.line.button.click()
    tracking = session.tracking
    assert tracking is not None
    panel.line.boxes["end"][2].setValue(205.0)
    assert session.tracking is None
    assert panel.result.reached.text() == "\u2013"
    session.undo_stack.undo()
    assert session.tracking is tracking
    panel.findChild(QSpinBox, "line_points").setValue(21)
    panel.line.button.click()
    assert session.tracking is not None
    assert session.tracking is not tracking


def test_undo_brings_back_the_motion_of_what_was_edited_at_the_moment_that_was_shown(
    panel: PathPanel, qtbot: QtBot
) -> None:
    session, tracker = panel.line._session, panel.result._tracker
    player = tracker._motion.player
    tracker.track_line()
    session.edit("Circle", replace(session.experiment, trajectory=TrajectoryTask("circle", "free")))
    tracker.track_trajectory()
    qtbot.waitUntil(lambda: not tracker.busy)
    circle = session.tracking
    for time in (0.5 * player.duration, player.duration):
        tracker._motion.seek(time)
        time = player.time
        smaller = replace(session.experiment.trajectory, height=0.2)
        session.edit("Change the circle", replace(session.experiment, trajectory=smaller))
        assert session.tracking is None  # and not the line
        assert player.trajectory is None
        session.undo_stack.undo()
        assert session.tracking is circle
        assert player.time == pytest.approx(time, abs=1e-12)
        np.testing.assert_allclose(player.q, session.q, atol=1e-12)


def test_undo_and_redo_show_the_motion_that_belonged_to_each_state(panel: PathPanel, qtbot: QtBot) -> None:
    session, tracker = panel.line._session, panel.result._tracker
    player, stack = tracker._motion.player, session.undo_stack
    shown = []
    for number, track in enumerate((tracker.track_line, tracker.track_trajectory, tracker.track_line)):
        session.edit("Take a circle", replace(session.experiment, trajectory=TrajectoryTask("circle", "free")))
        track()
        qtbot.waitUntil(lambda: not tracker.busy)
        session.edit("Another time", replace(session.experiment, path_seconds=3.0 + number))
        tracker._motion.seek(0.4 * player.duration)
        shown.append((stack.index(), session.tracking, player.trajectory, player.time))
        session.edit("Load", session.experiment.with_load(Load(payload=0.1 * number)))
    for index, tracking, trajectory, time in (*reversed(shown), *shown):
        stack.setIndex(index)
        assert session.tracking is tracking
        assert player.trajectory is trajectory
        assert player.time == pytest.approx(time, abs=1e-12)
        np.testing.assert_allclose(player.q, session.q, atol=1e-12)


def seconds_on_the_path(tracker: PathTracker) -> float:
    assert tracker.trajectory is not None
    return tracker.trajectory.duration - tracker.trajectory.path_start


def test_a_time_too_short_is_said_and_a_click_slows_the_path_down_only_where_it_must(
    panel: PathPanel, qtbot: QtBot
) -> None:
    session, tracker = panel.line._session, panel.result._tracker
    session.edit("pace", replace(session.experiment, path_seconds=0.8, trajectory=TrajectoryTask("letter-board")))
    panel.trajectory.button.click()
    as_a_whole = seconds_on_the_path(tracker)
    offered = repairs(panel, qtbot)
    assert set(offered) == {"ease", "longer"}
    seconds = float(offered["ease"].text().removeprefix("Slow down only there: ").removesuffix(" s"))
    offered["ease"].click()
    assert session.experiment.ease
    assert seconds_on_the_path(tracker) == pytest.approx(seconds, abs=0.01)
    assert seconds < 0.6 * as_a_whole
    assert not repairs(panel, qtbot)
    tracker._motion.pause()
    while session.experiment.ease:
        session.undo_stack.undo()
    assert seconds_on_the_path(tracker) == pytest.approx(as_a_whole)


def test_a_long_path_is_worked_out_beside_the_window_and_can_be_given_up(panel: PathPanel, qtbot: QtBot) -> None:
    session, tracker = panel.line._session, panel.result._tracker
    panel.line.button.click()
    short = session.tracking
    panel.findChild(QSpinBox, "line_points").setValue(501)
    tracker.track_line()
    assert tracker.busy
    assert panel.result.cancel.isVisible()
    panel.result.cancel.click()
    assert not tracker.busy
    session.undo_stack.undo()
    assert session.tracking is short
    session.undo_stack.redo()
    tracker.track_line()
    qtbot.waitUntil(lambda: not tracker.busy)
    assert session.tracking is not None
    assert session.tracking.samples == 501
    tracker.close()
