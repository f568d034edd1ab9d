"""The steps of the first tour: what each points at in the window, and what it says."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

from PySide6.QtCore import QPoint, QRect
from PySide6.QtWidgets import QMenu, QScrollArea, QTabBar, QWidget

from rvsim.language import tr, tr_later

if TYPE_CHECKING:
    from rvsim.gui.main_window import MainWindow


class Step(NamedTuple):
    """What a step says, and where in the window it points to: a rectangle in the window's own pixels."""

    title: str
    text: str
    where: Callable[[MainWindow], QRect]


def _widgets(*names: str, panel: str = "") -> Callable[[MainWindow], QRect]:
    """The place of some widgets, brought into view."""

    def where(window: MainWindow) -> QRect:
        if panel:
            window.docks.show_panel(panel)
        room = QRect()
        for name in names:
            widget = window.findChild(QWidget, name)
            if isinstance(widget, QWidget) and widget.isVisible():
                _scroll_to(widget)
                room = room.united(QRect(widget.mapTo(window, QPoint(0, 0)), widget.size()))
        return room.intersected(window.rect())

    return where


def _rows(*names: str) -> Callable[[MainWindow], QRect]:
    """The place of some widgets of the arm's panel, as wide as that."""
    find = _widgets(*names)

    def where(window: MainWindow) -> QRect:
        room, dock = find(window), window.docks.left.geometry()
        return room if room.isEmpty() else QRect(dock.left() + 4, room.top(), dock.width() - 8, room.height())

    return where


def _scroll_to(widget: QWidget) -> None:
    parent = widget.parentWidget()
    while parent is not None:
        if isinstance(parent, QScrollArea):
            parent.ensureWidgetVisible(widget)
        parent = parent.parentWidget()


def _tab(panel: str, title: str) -> Callable[[MainWindow], QRect]:
    """The tab of a panel, which comes to the front."""

    def where(window: MainWindow) -> QRect:
        window.docks.show_panel(panel)
        for bar in window.findChildren(QTabBar):
            for index in range(bar.count() if bar.isVisible() else 0):
                if bar.tabText(index) == tr(title):
                    tab = bar.tabRect(index)
                    return QRect(bar.mapTo(window, tab.topLeft()), tab.size()).intersected(window.rect())
        return QRect()

    return where


def _help_menu(window: MainWindow) -> QRect:
    menu = window.findChild(QMenu, "help_menu")
    if not isinstance(menu, QMenu):
        return QRect()
    inside = window.menuBar().actionGeometry(menu.menuAction())
    return QRect(window.menuBar().mapTo(window, inside.topLeft()), inside.size())


STEPS: tuple[Step, ...] = (
    Step(
        tr_later("An arm to begin with"),
        tr_later("Choose one here. All that follows works for each of them, and for arms of your own."),
        _widgets("robot_selector"),
    ),
    Step(
        tr_later("Move a joint"),
        tr_later(
            "Drag a slider, or type a value: <b>30</b>, <b>90/4</b> and <b>pi/4 rad</b> all work. Try it now: the "
            "window stays usable. Ctrl+Z takes anything back."
        ),
        _rows("joint_slider_1", "joint_value_1", "joint_slider_2", "joint_value_2"),
    ),
    Step(
        tr_later("Look around"),
        tr_later(
            "Drag turns the scene, right-drag moves it, the wheel zooms, a double click centres. With <b>G</b> you can "
            "drag the tool itself."
        ),
        _widgets("scene_view"),
    ),
    Step(
        tr_later("Follow a line"),
        tr_later(
            "Press this. Below it, <b>Result</b> then says how many points were reached and how exactly; where one is "
            "missed, which joint stands in the way."
        ),
        _widgets("track_line_button", panel="path"),
    ),
    Step(
        tr_later("Move through time"),
        tr_later(
            "The motion plays here: stop, drag to any moment, play it slower. <b>View › Curves</b> draws joints, "
            "speeds and torques over the same time."
        ),
        _widgets("play_button", "time_slider", "speed_selector"),
    ),
    Step(
        tr_later("Ask for a pose"),
        tr_later(
            "<b>Inverse</b> lists every way in which the arm can take a pose, works the solution out with its numbers, "
            "or says why there is none."
        ),
        _tab("inverse", tr_later("Inverse")),
    ),
    Step(
        tr_later("Look inside"),
        tr_later(
            "<b>Inspect</b> shows the Jacobian, singularities, forces, dynamics and the workspace of the pose you see; "
            "<b>Model</b> its matrices and DH table."
        ),
        _tab("jacobian", tr_later("Inspect")),
    ),
    Step(
        tr_later("When you want to know more"),
        tr_later(
            "<b>F1</b> explains the panel that you are in, with an example to try. This tour is in the same menu."
        ),
        _help_menu,
    ),
)
