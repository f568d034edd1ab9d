"""What the monkey may do next: a deed is chosen by dice, with where and how."""

from __future__ import annotations

import random
from typing import TypeVar

from monkey_sight import Deed, Playing, can_be_reached, file_dialog, focus_words, front, name_of
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QAbstractSlider,
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QLineEdit,
    QTabBar,
    QWidget,
)  # fmt: skip

from rvsim.gui.page_stack import PageStack

_DESCRIPTION = Qt.ItemDataRole.AccessibleDescriptionRole
W = TypeVar("W", bound=QWidget)
TEXTS = (
    *("nan", "inf", "-inf", "1e308", "-1e308", "1e-320", "", " ", "0", "-0", "1,5", "1.234,5", "12 345", "9" * 400),
    *(
        "٣٫٥",
        "١٢٣",
        "-٤٥",
        "９０",
        "pi/4",
        "2*30",
        "sqrt(2)/2",
        "1/0",
        "2**99999",
        "(" * 500,
        "90/",
        "__import__('os')",
    ),
    *(
        "90 rad",
        "30 deg",
        "1 m",
        "5 mm",
        "30°",
        "\u2212" + "30",
        "\u202e12",
        "\U0001f916",
        "\ud7ff",
        "abc",
        "a\tb\nc",
        "--3",
    ),
    *(
        "10",
        "-20",
        "45",
        "90",
        "0.1",
        "150",
        "300",
        "1e9",
        "1e6",
        "t",
        "cos(t)",
        "100*sin(3*t)",
        "exp(t)**9",
        "al5b://?x=1",
    ),
)
SEARCHED: tuple[type[QWidget], ...] = (
    *(QAbstractButton, QAbstractSpinBox, QComboBox, QLineEdit, QAbstractSlider, QAbstractItemView, QTabBar, QWidget),
)
KEYS = (
    *("Tab", "Backtab", "Return", "Enter", "Escape", "Space", "Up", "Down", "Left", "Right", "PageUp", "PageDown"),
    *("Home", "End", "Delete", "Backspace", "Plus", "Minus", "F1", "F2", "F5", "F6", "F7", "T", "G", "A", "1", "Menu"),
)
MODIFIERS = ("NoModifier", "NoModifier", "NoModifier", "ShiftModifier", "ControlModifier", "AltModifier")
BUTTONS = ("LeftButton", "LeftButton", "LeftButton", "RightButton", "MiddleButton")
HUGE = 10_000_000  # characters that are pasted
FORBIDDEN = ("action_quit",)


_WEIGHTS: dict[str, float] = {
    "click": 30,
    "double_click": 2,
    "context_menu": 2,
    "drag": 9,
    "wheel": 6,
    "key": 12,
    "type": 6,
    "box": 14,
    "paste": 2,
    "trigger": 8,
    "page": 8,
    "robot": 1.5,
    "undo": 3,
    "combo": 5,
    "resize": 1,
    "dock": 1.5,
    "connect_arm": 1,
    "fault": 1,
    "wait": 4,
    "stall": 0.1,
    "clock": 0.3,
    "folder": 0.3,
    "disk": 0.4,
    "drop": 0.4,
}


class Choices:
    """Chooses deeds by dice."""

    def __init__(self, play: Playing, dice: random.Random) -> None:
        self._play, self._dice = play, dice

    def named(self, name: str) -> Deed:
        """Some deed of that name."""
        chosen: Deed = getattr(self, f"_{name}", lambda: Deed(name))()
        return chosen

    def choose(self) -> Deed:
        """Any deed; while something is in front, often an answer to it."""
        if file_dialog() is not None:
            return Deed("file_dialog")
        ahead = front()
        if ahead is not None and self._dice.random() < 0.3:
            return Deed("answer", (self._dice.random(),), name_of(ahead))
        names = tuple(_WEIGHTS)
        name = self._dice.choices(names, tuple(_WEIGHTS.values()))[0]
        return self.named(name)

    def _top(self) -> QWidget:
        """A window that can be clicked."""
        ahead = front()
        if ahead is not None:
            return ahead
        tops = [w for w in QApplication.topLevelWidgets() if w.isVisible() and w.windowHandle() is not None]
        others = [w for w in tops if w is not self._play.window]
        return self._dice.choice(others) if others and self._dice.random() < 0.3 else self._play.window

    def _seen(self, top: QWidget, kind: type[W]) -> W | None:
        """Some widget of a kind that can be seen there."""
        found = top.findChildren(kind)
        for _ in range(min(len(found), 60)):
            widget = self._dice.choice(found)
            if widget.isVisible() and not widget.visibleRegion().isEmpty():
                return widget
        return None

    def _spot(self, kind: type[QWidget] | None = None) -> tuple[str, int, int, str]:
        """A point in a window, and what lies there."""
        top = self._top()
        widget: QWidget = self._seen(top, kind or self._dice.choice(SEARCHED)) or top
        room: QRect = widget.visibleRegion().boundingRect()
        inside = QPoint(
            self._dice.randint(room.left(), max(room.right(), room.left())),
            self._dice.randint(room.top(), max(room.bottom(), room.top())),
        )
        point = widget.mapTo(top, inside) if widget is not top else inside
        return top.objectName(), point.x(), point.y(), name_of(widget)

    def _click(self) -> Deed:
        top, x, y, words = self._spot()
        modifier = self._dice.choice(MODIFIERS)
        return Deed("click", (top, x, y, self._dice.choice(BUTTONS), modifier), words)

    def _double_click(self) -> Deed:
        top, x, y, words = self._spot()
        return Deed("double_click", (top, x, y), words)

    def _context_menu(self) -> Deed:
        top, x, y, words = self._spot()
        return Deed("click", (top, x, y, "RightButton", "NoModifier"), words)

    def _drag(self) -> Deed:
        kind = self._play.window.scene_view.__class__ if self._dice.random() < 0.3 else None
        top, x, y, words = self._spot(kind)
        path = [(self._dice.randint(-300, 300), self._dice.randint(-200, 200)) for _ in range(self._dice.randint(1, 5))]
        modifier = self._dice.choice(MODIFIERS)
        return Deed("drag", (top, x, y, self._dice.choice(BUTTONS), modifier, path), words)

    def _wheel(self) -> Deed:
        top, x, y, words = self._spot()
        return Deed("wheel", (top, x, y, self._dice.choice((-1200, -120, 120, 15, 1200))), words)

    def _key(self) -> Deed:
        return Deed("key", (self._dice.choice(KEYS), self._dice.choice(MODIFIERS)), focus_words())

    def _type(self) -> Deed:
        return Deed("type", (self._dice.choice(TEXTS),), focus_words())

    def _box(self) -> Deed:
        kind = self._dice.choice((QAbstractSpinBox, QAbstractSpinBox, QLineEdit))
        top, x, y, words = self._spot(kind)
        return Deed("box", (top, x, y, self._dice.choice(TEXTS), self._dice.choice(("Return", "Tab", "Escape"))), words)

    def _paste(self) -> Deed:
        size = HUGE if self._dice.random() < 0.05 else 0
        return Deed("paste", (self._dice.choice(TEXTS) or "1\t2\n3\t4", size), focus_words())

    def _trigger(self) -> Deed:
        found = [action for action in self._play.window.findChildren(QAction) if can_be_reached(action)]
        names = sorted({action.objectName() for action in found}.difference(FORBIDDEN))
        return Deed("trigger", (self._dice.choice(names),)) if names else Deed("wait", (0.01,))

    def _page(self) -> Deed:
        pages = [page.name for stack in self._play.window.findChildren(PageStack) for page in stack.pages]
        return Deed("page", (self._dice.choice(pages),))

    def _robot(self) -> Deed:
        return Deed("robot", (self._dice.randrange(max(self._play.window.joints.robots.count(), 1)),))

    def _undo(self) -> Deed:
        return Deed("undo", (self._dice.random() < 0.4,))

    def _combo(self) -> Deed:
        widget = self._seen(self._top(), QComboBox)
        number = self._dice.randrange(widget.count()) if widget is not None and widget.count() else 0
        if widget is None or widget.itemData(number, _DESCRIPTION) == "separator":
            return Deed("wait", (0.01,))
        return Deed("combo", (name_of(widget), number), name_of(widget))

    def _resize(self) -> Deed:
        return Deed("resize", self._dice.choice(((1024, 600), (1366, 768), (300, 200), (1920, 1080), (1100, 900))))

    def _dock(self) -> Deed:
        deeds = ("float", "hide", "show", "show", "raise", "left", "below", "back")
        return Deed("dock", (self._dice.randrange(len(self._play.window.docks.all)), self._dice.choice(deeds)))

    def _connect_arm(self) -> Deed:
        return Deed("connect_arm", (self._dice.randrange(4),))

    def _fault(self) -> Deed:
        return Deed("fault", (self._dice.randrange(30),))

    def _wait(self) -> Deed:
        return Deed("wait", (self._dice.choice((0.01, 0.03, 0.1, 0.25)),))

    def _stall(self) -> Deed:
        return Deed("stall", (0.2,))

    def _clock(self) -> Deed:
        return Deed("clock", (self._dice.choice((-1e9, -3600.0, 3600.0, 1e8)),))

    def _folder(self) -> Deed:
        return Deed("folder", (self._dice.choice(("sound", "sound", "blocked")),))

    def _disk(self) -> Deed:
        return Deed("disk", (self._dice.random() < 0.3,))
