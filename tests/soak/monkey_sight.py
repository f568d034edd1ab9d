"""What the monkey sees: which window is in front, what lies where, and what a deed is."""

from __future__ import annotations

from typing import Any, NamedTuple, Protocol

from monkey_world import World
from PySide6.QtCore import QObject
from PySide6.QtGui import QAction, QWindow
from PySide6.QtWidgets import QApplication, QFileDialog, QMenu, QWidget

from rvsim.gui.main_window import MainWindow


class Deed(NamedTuple):
    """What is done, and words for the reader about where."""

    name: str
    values: tuple[Any, ...] = ()
    words: str = ""


class Playing(Protocol):
    """What the monkey plays with."""

    world: World

    @property
    def window(self) -> MainWindow:
        """The one that is seen now."""


def front() -> QWidget | None:
    """The only window that takes clicks, if there is such a one."""
    return QApplication.activePopupWidget() or QApplication.activeModalWidget()


def file_dialog() -> QFileDialog | None:
    """A file dialog that is open."""
    return next((w for w in QApplication.topLevelWidgets() if isinstance(w, QFileDialog) and w.isVisible()), None)


def name_of(widget: QWidget) -> str:
    return f"{type(widget).__name__} {widget.objectName() or widget.accessibleName()}".strip()


def handle_of(widget: QWidget | None) -> QWindow | None:
    return widget.windowHandle() if widget is not None and widget.isVisible() else None


def focus_words() -> str:
    focused = QApplication.focusWidget()
    return name_of(focused) if focused is not None else "nowhere"


def can_be_reached(action: QAction) -> bool:
    """Whether a person could trigger it now: in the window's menus, or of something that can be seen."""
    if not action.objectName() or not action.isEnabled():
        return False
    owners: list[QObject | None] = list(action.associatedObjects())
    while any(isinstance(owner, QMenu) for owner in owners):
        owners = [owner.parent() if isinstance(owner, QMenu) else owner for owner in owners]
    return any(isinstance(owner, QWidget) and not owner.visibleRegion().isEmpty() for owner in owners)
