"""The wheel scrolls past boxes, lists and sliders; it changes only the one that was clicked or reached with Tab."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QHelpEvent, QWheelEvent
from PySide6.QtWidgets import QAbstractSpinBox, QApplication, QComboBox, QSlider, QToolTip, QWidget
from pytestqt.qtbot import QtBot

from rvsim.gui.app import build_window
from rvsim.gui.calm_boxes import ComboBox, CountBox, Slider
from rvsim.gui.help.examples import panel_names
from rvsim.gui.main_window import MainWindow
from rvsim.gui.preferences import Preferences

LONG = "A polynomial of the fifth degree, without a jump of the acceleration"
KINDS = (QComboBox, QAbstractSpinBox, QSlider)


def notch(widget: QWidget, up: int = 1) -> None:
    at = QPointF(widget.rect().center())
    none = Qt.MouseButton.NoButton, Qt.KeyboardModifier.NoModifier, Qt.ScrollPhase.NoScrollPhase
    event = QWheelEvent(at, QPointF(widget.mapToGlobal(at)), QPoint(), QPoint(0, 120 * up), *none, False)
    QApplication.sendEvent(widget, event)


def shown(widget: QWidget) -> object:
    return widget.currentIndex() if isinstance(widget, QComboBox) else widget.value()


@pytest.fixture
def window(qtbot: QtBot) -> MainWindow:
    made = build_window(Preferences())
    qtbot.addWidget(made)
    made.show()
    made.activateWindow()
    return made


def test_no_field_of_any_panel_is_changed_by_a_wheel_that_passes(window: MainWindow) -> None:
    window.scene_view.setFocus()
    seen = set()
    for name in panel_names(window):
        window.docks.show_panel(name)
        for widget in [one for kind in KINDS for one in window.findChildren(kind) if one.isVisible()]:
            before = shown(widget), window.session.experiment
            for up in (1, -1, -1):
                notch(widget, up)
            assert (shown(widget), window.session.experiment) == before, (name, widget)
            assert QApplication.focusWidget() is window.scene_view
            seen.add(widget)
    assert len(seen) > 60


@pytest.mark.parametrize("make", [ComboBox, CountBox, Slider])
def test_with_the_focus_the_wheel_steps(qtbot: QtBot, make: type[QWidget]) -> None:
    around = QWidget()
    box = make(around)
    other = QComboBox(around)
    if isinstance(box, QComboBox):
        box.addItems(["a", "b", "c"])
        box.setCurrentIndex(1)
    else:
        box.setValue(50)
    qtbot.addWidget(around)
    with qtbot.waitActive(around):
        around.show()
        around.activateWindow()
    other.setFocus()
    before = shown(box)
    notch(box)
    assert shown(box) == before
    box.setFocus(Qt.FocusReason.TabFocusReason)
    notch(box)
    assert shown(box) != before


@pytest.mark.parametrize(("width", "said"), [(120, [LONG]), (900, [])])
def test_what_a_list_cannot_show_whole_stands_in_its_tooltip(
    qtbot: QtBot, monkeypatch: pytest.MonkeyPatch, width: int, said: list[str]
) -> None:
    told: list[str] = []
    monkeypatch.setattr(QToolTip, "showText", lambda _at, text, _widget: told.append(text))
    box = ComboBox()
    box.addItem(LONG)
    qtbot.addWidget(box)
    box.setFixedWidth(width)
    box.show()
    box.grab()
    at = QPoint(5, 5)
    QApplication.sendEvent(box, QHelpEvent(QHelpEvent.Type.ToolTip, at, box.mapToGlobal(at)))
    assert told == said
