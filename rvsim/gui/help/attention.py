"""What the reader attends to: where the focus went last, or which panel came to the front after that."""

from __future__ import annotations

from typing import TYPE_CHECKING

import shiboken6
from PySide6.QtCore import QObject, Qt
from PySide6.QtWidgets import QApplication, QTabBar, QWidget

from rvsim.gui.page_stack import PageStack
from rvsim.gui.panel_docks import lies_behind

if TYPE_CHECKING:
    from rvsim.gui.main_window import MainWindow


class Attention(QObject):
    """One to a window. A tab, or the button of a page, takes no focus: the focus alone would tell of another panel."""

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window)
        self._window = window
        self._last: QWidget | None = None
        for pages in window.findChildren(PageStack):
            pages.fronted.connect(self._on_fronted)
        application = QApplication.instance()
        assert isinstance(application, QApplication)
        application.focusChanged.connect(self._on_focus)

    @property
    def widget(self) -> QWidget | None:
        """The widget, in the window or a dialog of it; None where there is none that can be seen."""
        focused = QApplication.focusWidget()
        if focused is not None and focused.window() is not self._window:
            return focused
        last = self._last
        if last is None or not shiboken6.isValid(last) or not last.isVisible() or lies_behind(last):
            return self._window.docks.front.widget()
        return self._window.docks.front.widget() if isinstance(last, QTabBar) else last

    def _on_focus(self, _old: QWidget | None, now: QWidget | None) -> None:
        if now is not None and now.window() is self._window:
            self._last = now

    def _on_fronted(self, pages: PageStack) -> None:
        self._last = pages
        for tabs in self._window.findChildren(QTabBar, options=Qt.FindChildOption.FindDirectChildrenOnly):
            tabs.setFocusPolicy(Qt.FocusPolicy.StrongFocus)  # or a click on one, or where the focus was, goes unseen
