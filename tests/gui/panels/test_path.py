"""The Path panel: each choice is an undo step of its own, and what was missed comes with what would help."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtWidgets import QComboBox, QPushButton, QSpinBox
from pytestqt.qtbot import QtBot

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


def repairs(panel: PathPanel) -> set[str]:
    buttons = panel.result.findChildren(QPushButton)
    return {button.text() for button in buttons if button.objectName().startswith("repair_")}


def test_missed_points_come_with_what_would_help(panel: PathPanel) -> None:
    preset = line_presets(panel.line._session.robot)[-1]
    for end, point in (("start", preset.start), ("end", preset.end)):
        for box, value in zip(panel.line.boxes[end], point, strict=True):
            box.setValue(1e3 * value)
    panel.line.button.click()
    assert repairs(panel) == {"Free pitch", "Ignore limits", "Preset line"}
    assert "reached points" in panel.result.rms.text()


def test_the_result_is_said_in_the_preferred_units(panel: PathPanel, preferences) -> None:
    test_missed_points_come_with_what_would_help(panel)
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


@pytest.mark.parametrize(
    ("name", "reached"), [("repair_free_pitch", 6), ("repair_ignore_limits", 11), ("repair_preset_line", 51)]
)
def test_each_repair_of_the_sources_line_reaches_more_than_four_points(
    panel: PathPanel, name: str, reached: int
) -> None:
    test_missed_points_come_with_what_would_help(panel)
    panel.findChild(QPushButton, name).click()
    assert panel.line._session.tracking.reached_count == reached


def test_a_letter_out_of_reach_offers_the_drawable_placement(panel: PathPanel) -> None:
    choose(panel, "trajectory_selector", "letter-raw")
    panel.trajectory.button.click()
    assert repairs(panel) == {"Drawable placement"}
    assert panel.result.rms.text() == "–"
    panel.findChild(QPushButton, "repair_drawable_placement").click()
    tracking = panel.line._session.tracking
    assert tracking.complete
    assert not np.isnan(tracking.q).any()


def test_limits_that_count_again_bring_back_what_is_reached_within_them(panel: PathPanel) -> None:
    session = panel.line._session
    test_missed_points_come_with_what_would_help(panel)
    panel.findChild(QPushButton, "repair_ignore_limits").click()
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
