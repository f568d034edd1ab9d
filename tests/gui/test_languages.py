"""The window in other languages: everything goes through `tr`, and a switch loses nothing."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QModelIndex, Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QApplication,
    QComboBox,
    QLabel,
    QListView,
    QTabBar,
    QTableView,
    QTreeView,
    QWidget,
)
from pytestqt.qtbot import QtBot

import rvsim.language
from rvsim.files.session_file import session_bytes
from rvsim.gui.app import build_window
from rvsim.gui.document_state import state_of
from rvsim.gui.language_switch import WindowKeeper
from rvsim.gui.languages import wear_language
from rvsim.gui.main_window import MainWindow
from rvsim.gui.panels.device_calibrate import CalibratePage
from rvsim.gui.panels.joint_box import JointBox
from rvsim.gui.preferences import Preferences
from rvsim.gui.robot_library import RobotLibrary
from rvsim.gui.tour import Tour, begin_tour
from rvsim.language import LANGUAGES, Catalogue, language, tr


@pytest.fixture(autouse=True)
def _english_again(qapp: QApplication) -> Iterator[None]:
    yield
    wear_language(qapp, "en")


@pytest.fixture
def keeper(qtbot: QtBot) -> Iterator[WindowKeeper]:
    """A window that is shown, in English."""
    preferences = Preferences()
    preferences.set("animated", False)
    made = WindowKeeper(build_window(preferences))
    made.window.show()
    yield made
    made.window.document.asks = False
    made.window.close()
    made.window.deleteLater()


def switched(keeper: WindowKeeper, qtbot: QtBot, code: str) -> MainWindow:
    """The window that takes the place of the present one."""
    old = keeper.window
    keeper.window.preferences.set("language", code)
    qtbot.waitUntil(lambda: keeper.window is not old)
    return keeper.window


def test_a_switch_keeps_session_undo_file_motion_and_view(keeper: WindowKeeper, qtbot: QtBot, tmp_path: Path) -> None:
    window = keeper.window
    window.document.save_to(tmp_path / "mine.rvsim")
    window.session.move_to(window.session.q + 0.1, "Move")
    window.tracker.track_line()
    window.motion.pause()
    window.motion.seek(1.0)
    window.preferences.set("look", "stick")
    window.docks.show_panel("singular")
    before, q, steps = session_bytes(state_of(window)), window.session.q, window.session.undo_stack.count()
    for code in ("ar", "de", "en"):
        window = switched(keeper, qtbot, code)
        assert language().code == code
        assert session_bytes(state_of(window)) == before
        assert (window.document.path, window.document.dirty) == (tmp_path / "mine.rvsim", True)
        assert (window.motion.player.time, window.docks.front_page) == (1.0, "singular")
        assert window.session.tracking is not None
    for _ in range(steps):
        window.actions_by_name["undo"].trigger()
    assert not window.document.dirty
    for _ in range(steps):
        window.actions_by_name["redo"].trigger()
    assert np.array_equal(window.session.q, q)


def test_a_value_that_is_being_typed_is_taken_before_the_switch(keeper: WindowKeeper, qtbot: QtBot) -> None:
    box = keeper.window.findChild(JointBox, "joint_value_1")
    box.selectAll()
    qtbot.keyClicks(box, "25")
    window = switched(keeper, qtbot, "de")
    assert np.degrees(window.session.q[0]) == pytest.approx(25.0)
    assert window.session.undo_stack.count() == 1


def test_what_was_tracked_stays_the_same_thing_and_its_motion_one_step(keeper: WindowKeeper, qtbot: QtBot) -> None:
    window = keeper.window
    window.tracker.track_line()
    window.motion.pause()
    tracking, trajectory = window.session.tracking, window.motion.player.trajectory
    window.motion.seek(0.5)
    steps = window.session.undo_stack.count()
    window = switched(keeper, qtbot, "de")
    assert window.session.tracking is tracking
    assert window.tracker.trajectory is window.motion.player.trajectory is trajectory
    window.motion.seek(1.0)
    assert window.session.undo_stack.count() == steps
    window.actions_by_name["undo"].trigger()
    assert window.motion.player.time == 0.0


def test_a_path_that_is_being_worked_out_is_worked_out_by_the_new_window(keeper: WindowKeeper, qtbot: QtBot) -> None:
    window = keeper.window
    experiment = window.session.experiment
    letter = replace(experiment.trajectory, name="letter-flat", orientation="free")
    window.session.edit("letter", replace(experiment, trajectory=letter))
    window.tracker.track_trajectory()
    assert window.tracker.busy
    window = switched(keeper, qtbot, "de")
    assert window.tracker.busy
    qtbot.waitUntil(lambda: window.session.tracking is not None)
    assert not window.motion.player.playing


def test_marks_of_a_calibration_and_the_step_of_the_tour_stay(keeper: WindowKeeper, qtbot: QtBot) -> None:
    keeper.window.session.use_robot(keeper.window.library["al5b"])
    keeper.window.docks.show_panel("calibrate")
    page = keeper.window.findChild(CalibratePage)
    page.refresh()
    page._go_on_with(page._wizard.mark(page._wizard.step.expected_us))
    begin_tour(keeper.window).go(2)
    window = switched(keeper, qtbot, "ar")
    other = window.findChild(CalibratePage)
    other.refresh()
    assert other._wizard.marks == page._wizard.marks != ()
    assert window.findChild(Tour).step == 2


def test_a_connected_arm_stays_connected_and_does_not_move(keeper: WindowKeeper, qtbot: QtBot) -> None:
    window = keeper.window
    window.session.use_robot(window.library["al5b"])
    window.device.connect_to("al5b://")
    qtbot.waitUntil(lambda: window.device.state is not None and window.device.state.connected)
    driver = window.device.driver
    sent = driver.state.commanded_q
    window = switched(keeper, qtbot, "de")
    assert window.device.driver is driver
    qtbot.waitUntil(lambda: window.device.state is not None and window.device.state.connected)
    assert np.array_equal(window.device.state.commanded_q, sent, equal_nan=True)
    assert window.session.servo_limits is not None
    window.device.disconnect_device()


def test_undo_steps_are_named_in_the_new_language(keeper: WindowKeeper, qtbot: QtBot) -> None:
    keeper.window.joints.go_zero()
    with keeper.window.session.one_step(tr("Show an example of the help")):
        keeper.window.joints.go_home()
    english = keeper.window.session.undo_stack.undoText()
    window = switched(keeper, qtbot, "de")
    german = window.session.undo_stack.undoText()
    assert german != english
    assert german.lower() in window.actions_by_name["undo"].text().lower()
    assert switched(keeper, qtbot, "en").session.undo_stack.undoText() == english


def test_old_windows_go(keeper: WindowKeeper, qtbot: QtBot) -> None:
    switched(keeper, qtbot, "de")
    old = keeper.window
    switched(keeper, qtbot, "en")
    qtbot.waitUntil(lambda: [one for one in QApplication.topLevelWidgets() if isinstance(one, MainWindow)] != [])
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    assert old not in QApplication.topLevelWidgets()


def test_arabic_is_written_from_right_to_left_and_numbers_are_not(qapp: QApplication, qtbot: QtBot) -> None:
    wear_language(qapp, "ar")
    window = build_window(Preferences())
    qtbot.addWidget(window)
    assert window.layoutDirection() == Qt.LayoutDirection.RightToLeft
    window.session.move_to(window.session.q - 0.2, "")
    for name in ("joint_value_1", "joint_slider_1", "time_slider", "tool_card"):
        found = window.findChild(QWidget, name)
        assert found is not None, name
        assert found.layoutDirection() == Qt.LayoutDirection.LeftToRight, name
    window.close()


# --- every text goes through tr --------------------------------------------------------------------------------------

MARK, END = "⟦", "⟧"
WORD = re.compile(r"[A-Za-z]{3,}")
# Names and signs that are the same in every language, and what Qt and pyqtgraph say themselves.
NAMES = re.compile(
    r"<[^>]*>|&nbsp;|Ctrl|Shift|Alt|Esc|Del|Return|Space|Home|End|Left|Right|Up|Down|Ins|PgUp|PgDown|/dev/\w+|"
    r"rvsim|Python|LaTeX|Markdown|RMS|DLS|I[xyz]{2}|cos|sin|atan2|det|hat|tau|Scroll (Left|Right)|Close|Float|Export|"
    r"Language|"
    r"AllowRandomRestarts|EnforceJointLimits|UseErrorDamping|"
    + "|".join(
        (*(re.escape(title) for title in RobotLibrary().titles.values()), *(one.name for one in LANGUAGES.values()))
    )
)
CODE = ("serve_example",)  # object names
PAGES = (
    "path", "check", "program", "compare", "inverse", "how", "lab", "jacobian", "velocity", "singular", "forces",
    "dynamics", "workspace", "source", "tool", "matrices", "points", "dh", "device", "wire", "calibrate", "measured",
    "virtual",
)  # fmt: skip


class _Marked(dict[str, tuple[str, ...]]):
    """A catalogue of a language in which every text stands between marks."""

    def get(self, text: str, default: object = None) -> tuple[str, ...]:  # type: ignore[override]
        return (f"{MARK}{text}{END}",)


def unmarked(text: str) -> str:
    """What of a text no call of `tr` has said, without names."""
    depth, rest = 0, []
    for sign in text:
        depth += (sign == MARK) - (sign == END)
        rest.append(sign if depth == 0 and sign != END else "")
    return NAMES.sub(" ", "".join(rest))


def shown_texts(window: QWidget) -> Iterator[tuple[str, str]]:
    """What a person can read or hear in a window, with its place."""
    for widget in (window, *window.findChildren(QWidget)):
        if widget.objectName() in CODE:
            continue
        place = f"{type(widget).__name__} {widget.objectName()}"
        yield place, widget.toolTip()
        yield place, widget.accessibleName()
        if isinstance(widget, QLabel | QAbstractButton):
            yield place, widget.text()
        for name in ("title", "placeholderText", "suffix"):
            said = getattr(widget, name, str)
            yield place, said() if callable(said) else ""
        if isinstance(widget, QComboBox):
            yield from ((place, widget.itemText(row)) for row in range(widget.count()))
        if isinstance(widget, QTabBar):
            yield from ((place, widget.tabText(tab)) for tab in range(widget.count()))
        if isinstance(widget, QTableView | QTreeView | QListView) and not widget.visibleRegion().isEmpty():
            yield from ((place, text) for text in _cells(widget))
    for action in window.findChildren(QAction):
        yield from ((action.objectName(), text) for text in (action.text(), action.toolTip(), action.statusTip()))


def _cells(view: QAbstractItemView) -> Iterator[str]:
    model = view.model()
    if model is None:
        return
    columns = 1 if isinstance(view, QListView) else min(model.columnCount(QModelIndex()), 20)
    for role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.ToolTipRole):
        yield from (str(model.headerData(column, Qt.Orientation.Horizontal, role) or "") for column in range(columns))
        for row in range(min(model.rowCount(QModelIndex()), 40)):
            yield str(model.headerData(row, Qt.Orientation.Vertical, role) or "")
            yield from (str(model.index(row, column).data(role) or "") for column in range(columns))


@pytest.mark.parametrize("robot", ["rv-m1", "al5b"])
def test_every_text_of_the_window_goes_through_tr(robot: str, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch) -> None:
    marked = LANGUAGES["en"], Catalogue(_Marked(), lambda _: 0)
    monkeypatch.setattr(rvsim.language, "_spoken", marked)
    window = build_window(Preferences(), robot=robot)
    qtbot.addWidget(window)
    window.show()
    window.tracker.track_line()
    window.motion.pause()
    missed = set()
    for page in PAGES:
        window.docks.show_panel(page)
        QApplication.processEvents()
        missed |= {(page, *one) for one in shown_texts(window) if WORD.search(unmarked(one[1]))}
    window.close()
    found = sorted({(place, text) for _, place, text in missed})
    assert not found, "\n".join(f"{place}: {unmarked(text)[:90]}" for place, text in found)
