"""The sources in the window: every experiment can be seen there, and the table of all numbers leads to each."""

from __future__ import annotations

import csv
from collections.abc import Iterator

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QGuiApplication
from PySide6.QtWidgets import QApplication, QDockWidget, QLabel, QMenu, QWidget
from pytestqt.qtbot import QtBot

from rvsim.dynamics import joint_torques, wrench_in_base
from rvsim.gui.actions import shortcut_table
from rvsim.gui.app import build_window
from rvsim.gui.main_window import MainWindow
from rvsim.gui.page_stack import PageStack
from rvsim.gui.panels.inspect_forces import ForcesPage
from rvsim.gui.panels.inspect_source import SourcePage
from rvsim.gui.preferences import Preferences
from rvsim.gui.sources_dialog import SourcesDialog, sources_dialog
from rvsim.gui.sources_menu import KEYS
from rvsim.gui.sources_show import show_experiment
from rvsim.gui.sources_table import SIGNS
from rvsim.lab.sources.experiment import SourceExperiment
from rvsim.lab.sources.experiments import SOURCE_TITLES, experiment_of, experiments
from rvsim.lab.sources.reproduce import KeyedReproduction, reproduce_by_key
from rvsim.lab.sources.reproduction_texts import COLUMNS, VERDICTS

ALL = experiments()
TRACKED = [experiment for experiment in ALL if experiment.setup.track]
LONG_MS = 20_000  # a worker on a busy machine


@pytest.fixture(scope="module")
def one_window(qapp: QApplication, tmp_path_factory: pytest.TempPathFactory) -> Iterator[MainWindow]:
    """One for all experiments: each must be seen whatever was there before."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("RVSIM_USER_FOLDER", str(tmp_path_factory.mktemp("user")))
        made = build_window(Preferences())
    made.preferences.set("animated", False)
    made.show()
    yield made
    made.close()
    made.deleteLater()


@pytest.fixture
def window(qtbot: QtBot) -> MainWindow:
    made = build_window(Preferences())
    made.preferences.set("animated", False)
    qtbot.addWidget(made)
    made.show()
    return made


@pytest.fixture(scope="module")
def rows() -> tuple[KeyedReproduction, ...]:
    return reproduce_by_key()


@pytest.fixture
def dialog(window: MainWindow, rows: tuple[KeyedReproduction, ...], monkeypatch, qtbot: QtBot) -> SourcesDialog:
    """The table with its rows worked out beforehand."""
    monkeypatch.setattr("rvsim.gui.sources_dialog.reproduction_parts", lambda: iter([rows]))
    made = sources_dialog(window)
    with qtbot.waitSignal(made.worker.done, timeout=LONG_MS):
        made.show_source("")
    return made


def in_front(window: MainWindow, name: str) -> bool:
    """Whether the panel or page of that name is what its dock shows, before all others."""
    for dock in window.findChildren(QDockWidget):
        pages = dock.widget()
        found = pages.current.name == name if isinstance(pages, PageStack) else dock.objectName() == f"{name}_dock"
        if found:
            return not dock.visibleRegion().isEmpty()
    return False


@pytest.mark.parametrize("experiment", ALL, ids=lambda experiment: experiment.key)
def test_every_experiment_can_be_seen_in_the_window(
    one_window: MainWindow, experiment: SourceExperiment, qtbot: QtBot
) -> None:
    window = one_window
    session, setup = window.session, experiment.setup
    before, steps = session.experiment, session.undo_stack.index()
    said: list[tuple[str, str]] = []
    session.said.connect(lambda text, level: said.append((text, level)))
    show_experiment(window, experiment)
    window.motion.pause()
    assert session.robot.name == experiment.robot
    pose = session.robot.home if setup.pose is None else setup.pose
    np.testing.assert_allclose(session.q, pose, atol=1e-9)
    qtbot.waitUntil(lambda: in_front(window, setup.panel))
    assert any(experiment.shows in text for text, _ in said)
    assert not any(level == "error" for _, level in said)
    assert session.undo_stack.index() == steps + 1
    session.undo_stack.undo()
    assert (session.robot, session.q.tolist()) == (before.robot, before.q.tolist())


@pytest.mark.parametrize("experiment", TRACKED, ids=lambda experiment: experiment.key)
def test_as_many_points_are_reached_as_the_numbers_say(
    one_window: MainWindow, experiment: SourceExperiment, rows: tuple[KeyedReproduction, ...], qtbot: QtBot
) -> None:
    window = one_window
    show_experiment(window, experiment)
    qtbot.waitUntil(lambda: not window.tracker.busy, timeout=LONG_MS)
    window.motion.pause()
    label = window.findChild(QLabel, "reached_label")
    tracking = window.session.tracking
    for row in (row for key, row in rows if key == experiment.key and "points reached of" in row.item):
        assert row.ours == tracking.reached_count
        assert label.text().startswith(f"{row.ours:.0f} of {row.printed:.0f}")


@pytest.mark.parametrize("key", ["004-cubic", "004-quintic"])
def test_a_law_of_motion_is_played_with_its_curves(window: MainWindow, key: str) -> None:
    show_experiment(window, experiment_of(key))
    window.motion.pause()
    assert window.motion.player.trajectory.duration == pytest.approx(2.0)
    assert window.plots.isVisible()
    assert window.plots.chosen == ["q", "qd", "qdd"]
    assert window.session.experiment.law == key.removeprefix("004-")
    window.motion.seek(2.0)
    assert np.degrees(window.session.q) == pytest.approx([40, 0, 0, 0, 0])


def test_pages_show_what_the_experiment_is_about(window: MainWindow) -> None:
    show_experiment(window, experiment_of("000-14"))
    assert window.findChild(SourcePage).chosen.key == "000-14"
    show_experiment(window, experiment_of("002-rms"))
    assert window.laboratory.pages.currentWidget() is window.laboratory.source_002
    show_experiment(window, experiment_of("004-4.24"))
    robot, q = window.session.robot, window.session.q
    expected = joint_torques(robot, q, wrench_in_base(robot, q, np.array([0, 0, 10.0, 0, 0, 0])))
    shown = [value.value for value in window.findChild(ForcesPage)._values()]
    assert shown == pytest.approx(expected.tolist())


# --- the table -------------------------------------------------------------------------------------------------------


def test_the_table_works_its_rows_out_beside_the_window(window: MainWindow, qtbot: QtBot) -> None:
    made, shares = sources_dialog(window), []
    made.worker.part.connect(lambda part: shares.append(part) if isinstance(part, float) else None)
    with qtbot.waitSignal(made.worker.done, timeout=LONG_MS):
        made.show_source("")
        assert made.progress.isVisible()
        assert made.sentence.text().startswith("Working")
    assert shares == sorted(shares)
    assert shares[-1] == 1.0
    assert made.progress.isHidden()
    assert made.chosen == made.filter.rows[0]
    assert made.sentence.text().startswith(experiment_of(made.chosen.key).title)


def test_the_table_has_every_row_with_a_sign_for_its_verdict(dialog: SourcesDialog, rows) -> None:
    assert str(dialog.filter.rows) == str(rows)
    assert set(SIGNS) == set(VERDICTS) == {row.verdict for _, row in rows}
    assert len({sign for sign, _ in SIGNS.values()}) == len(SIGNS)
    last = dialog.filter.index(0, len(COLUMNS) - 1)
    assert last.data() == f"{SIGNS[rows[0].row.verdict][0]} {rows[0].row.verdict}"


def test_the_table_can_be_sorted_and_narrowed(dialog: SourcesDialog) -> None:
    dialog.table.sortByColumn(4, Qt.SortOrder.DescendingOrder)
    assert dialog.filter.rows[0].row.ours == 2001.0
    dialog.sources.setCurrentIndex(dialog.sources.findData("003"))
    assert {keyed.row.source for keyed in dialog.filter.rows} == {"003"}
    dialog.words.setText("SPIRAL")
    assert dialog.filter.rows[0].key == "003-spiral"
    dialog.words.setText("no such words")
    assert not dialog.filter.rows
    assert not dialog.show_button.isEnabled()


def test_a_row_is_shown_in_the_window_and_the_table_makes_room(dialog: SourcesDialog, window: MainWindow) -> None:
    dialog.choose("004-3.1")
    dialog.show_button.click()
    assert window.session.robot.name == "al5b"
    assert dialog.isHidden()
    dialog.show_source("")
    dialog.keep.setChecked(True)
    dialog.choose("001-table")
    dialog.table.doubleClicked.emit(dialog.table.currentIndex())
    assert window.session.robot.name == "rv-1a"
    assert dialog.isVisible()
    assert sources_dialog(window) is dialog


def test_what_is_copied_is_what_is_seen(dialog: SourcesDialog) -> None:
    dialog.sources.setCurrentIndex(dialog.sources.findData("003"))
    count = len(dialog.filter.rows)
    dialog.copy.copy_as("CSV")
    table = list(csv.reader(QGuiApplication.clipboard().text().splitlines()))
    assert table[0] == list(COLUMNS)
    assert len(table) == count + 1
    dialog.copy.copy_as("LaTeX")
    assert QGuiApplication.clipboard().text().count(r" \\") == count + 1
    assert QGuiApplication.clipboard().text().isascii()
    dialog.copy.copy_as("text")
    assert len(QGuiApplication.clipboard().text().splitlines()) == 2 * count


# --- the menu --------------------------------------------------------------------------------------------------------


def every_action(menu: QMenu) -> list[QAction]:
    """Those of a menu and of the menus in it."""
    return [
        found
        for action in menu.actions()
        for found in (every_action(action.menu()) if action.menu() is not None else [action])
    ]


def test_the_menu_leads_to_every_experiment_and_to_the_table(window: MainWindow, monkeypatch) -> None:
    monkeypatch.setattr("rvsim.gui.sources_dialog.reproduction_parts", lambda: iter(()))
    menu = window.findChild(QMenu, "sources_menu")
    menus = [window.findChild(QMenu, f"source_{source}_menu") for source in SOURCE_TITLES]
    assert all(inner.menuAction() in menu.actions() for inner in menus)
    names = [action.objectName() for inner in menus for action in every_action(inner)]
    experiments_in_order = [f"action_experiment_{experiment.key}" for experiment in ALL]
    assert [name for name in names if name.startswith("action_experiment_")] == experiments_in_order
    assert [keys for _, _, keys in shortcut_table(window)].count(KEYS) == 1
    window.findChild(QAction, "action_experiment_000-P3").trigger()
    assert in_front(window, "points")
    window.findChild(QAction, "action_source_002_numbers").trigger()
    assert window.findChild(QWidget, "sources_dialog").sources.currentData() == "002"
