"""The IK lab: all solvers from one start, seen as curves, rows, words and a fading arm; and source 002 as printed."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import QObject
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractSlider,
    QAbstractSpinBox,
    QComboBox,
    QLabel,
    QLineEdit,
    QScrollBar,
    QSlider,
    QTableView,
)
from pytestqt.qtbot import QtBot

from rvsim.gui.app import build_window
from rvsim.gui.main_window import MainWindow
from rvsim.gui.panels.laboratory import LaboratoryPanel
from rvsim.gui.panels.laboratory_fields import NumberEdit
from rvsim.gui.panels.laboratory_scene import ITERATES_KEY, SOURCE_002_KEY
from rvsim.gui.preferences import Preferences
from rvsim.kinematics.numeric import AS_IN_SOURCE_002, SOLVERS


@pytest.fixture
def panel(qtbot: QtBot, session_with, preferences, shown) -> LaboratoryPanel:
    made = shown(LaboratoryPanel(session_with("ur5e"), preferences))
    finished(qtbot, made)
    return made


def finished(qtbot: QtBot, panel: LaboratoryPanel) -> None:
    page = panel.contest
    qtbot.waitUntil(lambda: page.contest is not None and not page._worker.busy)


def find(panel: QObject, kind: type, name: str):
    found = panel.findChild(kind, name)
    assert found is not None, name
    return found


def choose(panel: LaboratoryPanel, name: str, data: str) -> None:
    box = find(panel, QComboBox, name)
    box.setCurrentIndex(box.findData(data))
    box.activated.emit(box.currentIndex())


def type_number(panel: LaboratoryPanel, name: str, text: str) -> None:
    edit = find(panel, NumberEdit, name)
    edit.setText(text)
    edit.setModified(True)
    edit.editingFinished.emit()


def test_run_shows_four_rows_four_curves_and_a_sentence(qtbot: QtBot, panel: LaboratoryPanel) -> None:
    find(panel, QAbstractButton, "lab_run_button").click()
    finished(qtbot, panel)
    page = panel.contest
    assert page.model.rowCount() == len(SOLVERS)
    for plot in page.plots:
        for outcome in page.contest.outcomes:
            x, y = plot.curves[outcome.solver].getOriginalDataset()
            assert len(x) == len(outcome.result.history.q)
            assert (y > 0.0).all()
    assert find(panel, QLabel, "lab_sentence").text().startswith("All 4 reach the target.")


def test_curves_differ_by_more_than_colour(panel: LaboratoryPanel) -> None:
    pens = [curve.opts["pen"] for curve in panel.contest.plots[0].curves.values()]
    assert len({tuple(pen.dashPattern()) for pen in pens}) == len(SOLVERS)


def test_a_row_shows_the_iterates_of_its_solver_and_its_verdict(panel: LaboratoryPanel) -> None:
    told = []
    panel.contest.iterates_changed.connect(told.append)
    panel.contest.table.selectRow(SOLVERS.index("bfgs"))
    bfgs = panel.contest.contest.outcomes[-1]
    assert told[-1].solver == "bfgs"
    assert np.array_equal(told[-1].q, bfgs.result.history.q)
    assert find(panel, QLabel, "lab_sentence").text().startswith("BFGS gradient projection ends after")


def test_moving_a_start_slider_runs_again_from_there(qtbot: QtBot, panel: LaboratoryPanel) -> None:
    before = panel.contest.contest
    find(panel, QSlider, "lab_start_slider_2").setValue(300)
    qtbot.waitUntil(lambda: panel.contest.contest is not before)
    assert find(panel, QComboBox, "lab_start_selector").currentData() == "own"
    assert panel.contest.contest.trial.q0[1] == pytest.approx(np.radians(-360.0 + 0.3 * 720.0))


def test_damping_and_settings_reach_the_solvers(qtbot: QtBot, panel: LaboratoryPanel) -> None:
    find(panel, QSlider, "lab_damping_slider").setValue(300)
    assert panel.contest.trial.options.damping == pytest.approx(0.1)
    type_number(panel, "lab_position_tolerance", "2e-3")
    assert panel.contest.trial.options.position_tolerance == pytest.approx(2e-6)
    type_number(panel, "lab_max_iterations", "7")
    assert find(panel, QComboBox, "lab_rules_selector").currentData() == "own"
    finished(qtbot, panel)
    assert all(outcome.result.iterations <= 7 for outcome in panel.contest.contest.outcomes)


def test_a_setting_that_makes_no_sense_is_refused_with_a_sentence(panel: LaboratoryPanel) -> None:
    type_number(panel, "lab_max_iterations", "0")
    assert panel.contest.trial.options.max_iterations == 1500
    assert find(panel, NumberEdit, "lab_max_iterations").number == 1500
    type_number(panel, "lab_max_iterations", "many")
    sentences = [text for text, _ in panel.contest._session.sentences]
    assert "max_iterations" in sentences[-2]
    assert "MaxIterations" in sentences[-1]


def test_the_preset_of_source_002_brings_its_guess(panel: LaboratoryPanel) -> None:
    choose(panel, "lab_rules_selector", AS_IN_SOURCE_002.title)
    trial = panel.contest.trial
    assert trial.task == "position"
    assert trial.options.max_iterations == 300
    assert trial.q0 == pytest.approx(AS_IN_SOURCE_002.guess)


def test_out_of_reach_the_reasons_are_told(qtbot: QtBot, panel: LaboratoryPanel) -> None:
    before = panel.contest.contest
    panel.contest.target.position.boxes[0].setValue(5000.0)
    qtbot.waitUntil(lambda: panel.contest.contest is not before)
    assert find(panel, QLabel, "lab_sentence").text().startswith("None of the 4 reaches the target.")
    for row, outcome in enumerate(panel.contest.contest.outcomes):
        panel.contest.table.selectRow(row)
        assert outcome.result.reason in find(panel, QLabel, "lab_sentence").text()


def test_a_cancelled_run_leaves_the_old_result(qtbot: QtBot, panel: LaboratoryPanel) -> None:
    before = panel.contest.contest
    find(panel, QAbstractButton, "lab_run_button").click()
    find(panel, QAbstractButton, "lab_cancel_button").click()
    qtbot.waitUntil(lambda: not panel.contest._worker._running)
    assert panel.contest.contest is before


def test_go_to_result_moves_the_arm_there(panel: LaboratoryPanel) -> None:
    panel.contest.table.selectRow(0)
    find(panel, QAbstractButton, "lab_go_button").click()
    assert np.array_equal(panel.contest._session.q, panel.contest.contest.outcomes[0].result.q)


def test_source_002_as_printed_misses_by_431_millimetres(qtbot: QtBot, panel: LaboratoryPanel) -> None:
    panel.pages.setCurrentIndex(1)
    page = panel.source_002
    qtbot.waitUntil(lambda: page.comparison is not None)
    assert "431 mm RMS away" in page.sentence.text()
    assert "e−13 mm RMS" in page.sentence.text()
    for curve in page.plot.curves.values():
        assert len(curve.getOriginalDataset()[0]) == 184


def test_every_control_can_be_found_and_read_out(panel: LaboratoryPanel) -> None:
    controls = [
        control
        for kind in (QAbstractButton, QAbstractSlider, QAbstractSpinBox, QComboBox, QLineEdit, QTableView)
        for control in panel.contest.findChildren(kind)
        if not control.objectName().startswith("qt_") and type(control) is not QAbstractButton
    ]
    inner = {control for control in controls if control.parent() in controls or isinstance(control, QScrollBar)}
    for control in set(controls) - inner:
        assert control.objectName().startswith("lab_"), control
        assert control.accessibleName() or control.text(), control.objectName()


# --- in the window ---------------------------------------------------------------------------------------------------


@pytest.fixture
def window(qtbot: QtBot) -> MainWindow:
    made = build_window(Preferences(), robot="ur5e")
    made.preferences.set("animated", False)
    qtbot.addWidget(made)
    made.show()
    return made


def keys(window: MainWindow, start: str) -> set[str]:
    return {item.key for item in window.scene_view.scene.items if item.key.startswith(start)}


def test_behind_another_panel_nothing_is_run_or_drawn(window: MainWindow) -> None:
    assert window.laboratory.contest.contest is None
    assert not window.laboratory.contest.plots
    assert not keys(window, ITERATES_KEY)


def test_in_front_the_iterates_fade_in_the_scene_and_go_with_the_panel(qtbot: QtBot, window: MainWindow) -> None:
    window.docks.show_panel("lab")
    qtbot.waitUntil(lambda: bool(keys(window, ITERATES_KEY)))
    assert {f"{ITERATES_KEY}.way", f"{ITERATES_KEY}.target", f"{ITERATES_KEY}.0.link0"} <= keys(window, ITERATES_KEY)
    window.docks.show_panel("path")
    qtbot.waitUntil(lambda: not keys(window, ITERATES_KEY))


def test_the_ellipse_is_drawn_beside_the_ur5e_alone(qtbot: QtBot, window: MainWindow) -> None:
    window.laboratory.pages.setCurrentIndex(1)
    window.docks.show_panel("lab")
    qtbot.waitUntil(lambda: bool(keys(window, SOURCE_002_KEY)))
    window.session.use_robot(window.library["rv-m1"])
    qtbot.waitUntil(lambda: not keys(window, SOURCE_002_KEY))


def test_it_fits_a_small_screen(qtbot: QtBot, window: MainWindow) -> None:
    window.docks.show_panel("lab")
    page = window.laboratory.contest
    finished(qtbot, window.laboratory)
    for part in (page.target, page.start, page.rules):
        part.disclosure.click()
    assert window.minimumSizeHint().width() <= 1024
    assert window.minimumSizeHint().height() <= 600
    assert page.rules.details.minimumSizeHint().width() <= 330
