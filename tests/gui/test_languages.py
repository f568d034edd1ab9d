"""The window in other languages: everything goes through `tr`."""

from __future__ import annotations

import re
from collections.abc import Iterator
from xml.etree import ElementTree

import pytest
from PySide6.QtCore import QModelIndex, QPoint, Qt, QTranslator
from PySide6.QtGui import QAction, QUndoCommand, QUndoStack
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
from rvsim.gui.app import build_window
from rvsim.gui.help.window import HelpWindow
from rvsim.gui.languages import wear_language
from rvsim.gui.preferences import Preferences
from rvsim.gui.robot_library import RobotLibrary
from rvsim.gui.undo_words import UndoWords
from rvsim.language import LANGUAGES, Catalogue, catalogue_file, has_right_to_left, tr


@pytest.fixture(autouse=True)
def _english_again(qapp: QApplication) -> Iterator[None]:
    yield
    wear_language(qapp, "en")


def test_arabic_is_written_from_right_to_left_and_numbers_are_not(qapp: QApplication, qtbot: QtBot) -> None:
    wear_language(qapp, "ar")
    window = build_window(Preferences())
    qtbot.addWidget(window)
    assert window.layoutDirection() == Qt.LayoutDirection.RightToLeft
    window.session.move_to(window.session.q - 0.2, "")
    for name in ("joint_value_1", "joint_slider_1", "time_slider", "tool_card", "device_gripper"):
        found = window.findChild(QWidget, name)
        assert found is not None, name
        assert found.layoutDirection() == Qt.LayoutDirection.LeftToRight, name
    window.close()


def test_in_arabic_help_opens_away_from_the_panels_and_points_stand_from_left_to_right(
    qapp: QApplication, qtbot: QtBot
) -> None:
    wear_language(qapp, "ar")
    window = build_window(Preferences())
    qtbot.addWidget(window)
    window.resize(1366, 768)
    window.show()
    window.docks.show_panel("path")
    places = [window.findChild(QWidget, f"line_start_{axis}").mapTo(window, QPoint()).x() for axis in "xyz"]
    assert places == sorted(places)
    shown = HelpWindow(window, "path")
    assert window.frameGeometry().center().x() < shown.geometry().center().x() < window.geometry().right()
    window.close()


@pytest.mark.parametrize("from_the_start", [True, False])
def test_large_letters_of_the_language_with_the_longest_words_fit_a_small_screen(
    qapp: QApplication, qtbot: QtBot, from_the_start: bool
) -> None:
    wear_language(qapp, "de")
    preferences = Preferences()
    preferences.set("presentation", from_the_start)
    window = build_window(preferences, robot="al5b")
    qtbot.addWidget(window)
    window.show()
    preferences.set("presentation", True)
    qapp.processEvents()
    assert window.minimumSizeHint().width() <= 1024
    preferences.set("presentation", False)
    window.close()


def test_file_dialogs_speak_arabic_in_the_words_of_the_window(qapp: QApplication) -> None:
    wear_language(qapp, "ar")
    said = [
        qapp.translate(*key)
        for key in (
            ("QFileDialog", "&Look in:"),
            ("QFileDialog", "Files of &type:"),
            ("QAbstractFileIconProvider", "Folder", "All other platforms"),
        )
    ]
    assert all(map(has_right_to_left, said))
    assert qapp.translate("QPlatformTheme", "Close") == tr("Close")
    wear_language(qapp, "en")
    assert qapp.translate("QPlatformTheme", "Close") == "Close"


def test_the_words_for_qt_are_those_of_their_source(qapp: QApplication) -> None:
    source = catalogue_file("ar").with_name("qt_ar.ts")
    words = QTranslator()
    assert words.load(str(source.with_suffix(".qm")))
    wanted = [
        (context.findtext("name"), one.findtext("source"), one.findtext("translation"))
        for context in ElementTree.parse(source).iter("context")
        for one in context.iter("message")
    ]
    said = [(context, text, words.translate(context, text)) for context, text, _ in wanted]
    assert said == wanted, "pyside6-lrelease qt_ar.ts makes the other file anew"


def test_undo_says_what_in_a_window_that_takes_over_steps(qtbot: QtBot) -> None:
    stack, undo, redo = QUndoStack(), QAction("Undo: old"), QAction("Redo: old")
    stack.push(QUndoCommand("Move joint 3"))
    UndoWords(undo, redo, stack, stack)
    assert (undo.text(), redo.text()) == ("Undo: move joint 3", "Redo")


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
