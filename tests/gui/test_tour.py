"""The tour points at what is there, locks nothing, and comes by itself only to whom it has not been shown."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, QRect, QSize, Qt
from pytestqt.qtbot import QtBot

from rvsim.gui.app import build_window
from rvsim.gui.main_window import MainWindow
from rvsim.gui.preferences import Preferences
from rvsim.gui.tour import Tour, begin_tour, offer_tour, place_beside
from rvsim.gui.tour_steps import STEPS


def made(qtbot: QtBot, preferences: Preferences, size: tuple[int, int] = (1366, 768)) -> MainWindow:
    window = build_window(preferences)
    window.preferences.set("animated", False)
    qtbot.addWidget(window)
    window.resize(*size)
    window.show()
    return window


@pytest.mark.parametrize("size", [(1366, 768), (1024, 600)])
def test_every_step_points_at_something_and_stays_beside_it(qtbot: QtBot, size: tuple[int, int]) -> None:
    window = made(qtbot, Preferences(), size)
    tour = begin_tour(window)
    for step in STEPS:
        target = step.where(window)
        card = tour.card.geometry()
        assert not target.isEmpty(), step.title
        assert window.rect().contains(card), step.title
        assert not card.intersects(target), step.title
        read_out = window.tool_card
        if step is STEPS[0]:  # beside it there is room
            assert not card.intersects(QRect(read_out.mapTo(window, QPoint(0, 0)), read_out.size()))
        assert tour.card.height() >= tour.card.layout().totalHeightForWidth(tour.card.width()), step.title
        tour.card.next_button.click()
    assert window.findChild(Tour, "tour") is None


def test_a_window_does_not_begin_the_tour_by_itself(qtbot: QtBot) -> None:
    assert made(qtbot, Preferences()).findChild(Tour) is None


def test_it_is_offered_at_the_first_start_and_remembers_that_it_was_seen(qtbot: QtBot, tmp_path: Path) -> None:
    file = tmp_path / "settings.ini"
    window = made(qtbot, Preferences(file))
    offer_tour(window)
    qtbot.waitUntil(lambda: window.findChild(Tour, "tour") is not None)
    assert not Preferences(file)["tour_seen"], "a window that is closed meanwhile has not shown it"
    window.findChild(Tour, "tour").card.skip_button.click()
    assert Preferences(file)["tour_seen"]


def test_whoever_wants_to_see_it_again_does(qtbot: QtBot) -> None:
    window = made(qtbot, Preferences())
    tour = begin_tour(window)
    tour.card.never.setChecked(False)
    tour.end()
    assert not window.preferences["tour_seen"]


def test_the_keyboard_leads_through_and_the_window_stays_usable(qtbot: QtBot) -> None:
    window = made(qtbot, Preferences())
    window.docks.show_panel("forces")
    window.actions_by_name["tour"].trigger()
    tour = window.findChild(Tour, "tour")
    qtbot.keyClick(tour.card.next_button, Qt.Key.Key_Right)
    qtbot.keyClick(tour.card.next_button, Qt.Key.Key_Right)
    qtbot.keyClick(tour.card.next_button, Qt.Key.Key_Left)
    assert tour.step == 1
    qtbot.keyClick(tour.card.next_button, Qt.Key.Key_Return)
    qtbot.keyClick(tour.card.never, Qt.Key.Key_Enter)
    assert tour.step == 3
    qtbot.keyClick(tour.card.back_button, Qt.Key.Key_Return)
    assert tour.step == 2
    assert tour.shade.testAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
    assert begin_tour(window) is tour
    assert tour.step == 0
    qtbot.keyClick(tour.card.next_button, Qt.Key.Key_Escape)
    assert window.findChild(Tour, "tour") is None
    assert not window.docks.front.widget().visibleRegion().isEmpty()
    assert window.docks.front.objectName() == "inspect_dock"


def test_a_card_finds_its_place_or_the_middle() -> None:
    room, size = QRect(0, 0, 1000, 600), QSize(300, 150)
    for target in (QRect(0, 0, 200, 30), QRect(800, 500, 200, 100), QRect(0, 400, 1000, 50)):
        card = QRect(place_beside(target, size, room), size)
        assert room.contains(card)
        assert not card.intersects(target)
    middle = QRect(place_beside(QRect(), size, room), size).center()
    assert (middle - QPoint(500, 300)).manhattanLength() < 4
