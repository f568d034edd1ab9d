"""The panels of the window: which there are, in which dock each lies, and the keys that bring it to the front."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtWidgets import QApplication, QDockWidget, QMainWindow, QMenu, QTabBar, QTabWidget, QWidget

from rvsim.gui.page_stack import Page, PageStack
from rvsim.language import language, tr


class _NoWheel(QObject):
    """Keeps the wheel from tabs: somebody who scrolls a panel would find another one in front."""

    def eventFilter(self, _watched: QObject, event: QEvent) -> bool:
        """Whether it is one of the wheel, which ends here."""
        return event.type() == QEvent.Type.Wheel


def _tell(dock: QDockWidget, set_seen: Callable[[bool], object], shown: bool) -> None:
    """Tell a panel whether it is seen: of a dock that begins to float Qt says that it goes, and no more."""
    set_seen(dock.isVisible() if dock.isFloating() else shown)


class PanelDocks:
    """Docks at the left and at the right, those at the right behind each other; mirrored for who reads from the right.

    Args:
        window: where they are put.
        left: (object name without "_dock", title, widget) of the one dock at the left.
        right: the same for those at the right; a `PageStack` holds several pages.
    """

    def __init__(
        self, window: QMainWindow, left: tuple[str, str, QWidget], right: Sequence[tuple[str, str, QWidget]]
    ) -> None:
        self._window = window
        options = QMainWindow.DockOption
        window.setDockOptions(options.AnimatedDocks | options.AllowTabbedDocks | options.AllowNestedDocks)
        first, second = Qt.DockWidgetArea.LeftDockWidgetArea, Qt.DockWidgetArea.RightDockWidgetArea
        if language().right_to_left:  # Qt mirrors what is in a dock, not where docks are
            first, second = second, first
        window.setTabPosition(second, QTabWidget.TabPosition.North)
        self.left = self._add(*left, first)
        self.right = [self._add(*entry, second) for entry in right]
        for dock in self.right[1:]:
            window.tabifyDockWidget(self.right[0], dock)
        for dock in self.right:
            dock.setTitleBarWidget(QWidget())  # the tab says it already; a low screen needs the room
        self.right[0].raise_()
        self._no_wheel = _NoWheel(window)
        for dock in self.right:
            dock.visibilityChanged.connect(self._calm_tabs)  # Qt makes the tabs when it lays the docks out

    def _calm_tabs(self) -> None:
        for bar in self._window.findChildren(QTabBar, options=Qt.FindChildOption.FindDirectChildrenOnly):
            bar.installEventFilter(self._no_wheel)

    def _add(self, name: str, title: str, panel: QWidget, area: Qt.DockWidgetArea) -> QDockWidget:
        dock = QDockWidget(tr(title), self._window)
        dock.setObjectName(f"{name}_dock")
        dock.setWidget(panel)
        self._window.addDockWidget(area, dock)
        if hasattr(panel, "set_seen"):
            dock.visibilityChanged.connect(partial(_tell, dock, panel.set_seen))
            dock.topLevelChanged.connect(partial(_tell, dock, panel.set_seen))
        return dock

    @property
    def all(self) -> list[QDockWidget]:
        """Every dock, the left one first."""
        return [self.left, *self.right]

    @property
    def front(self) -> QDockWidget:
        """Of the docks at the right the one that can be seen."""
        return next((dock for dock in self.right if not dock.visibleRegion().isEmpty()), self.right[0])

    def make_menu(self) -> QMenu:
        """Keys that bring each panel to the front, its pages, and switches that hide it."""
        panels, hidden = QMenu(tr("Panels"), self._window), QMenu(tr("Hide or show"), self._window)
        for number, dock in enumerate(self.all, 1):
            action = panels.addAction(dock.windowTitle())
            action.setObjectName(f"action_go_to_{dock.objectName()}")
            action.setShortcut(f"Alt+{number}")
            action.triggered.connect(partial(self.go_to, dock))
            hidden.addAction(dock.toggleViewAction())
        for dock in self.right:
            if isinstance(dock.widget(), PageStack):
                panels.addSeparator()
                self._add_pages(panels, dock)
        panels.addSeparator()
        panels.addMenu(hidden)
        return panels

    def _add_pages(self, menu: QMenu, dock: QDockWidget) -> None:
        pages = dock.widget()
        assert isinstance(pages, PageStack)
        for page in pages.pages:
            action = menu.addAction(f"{dock.windowTitle()} › {tr(page.title)}")
            action.setObjectName(f"action_go_to_{page.name}_page")
            action.setStatusTip(tr(page.tip))
            action.triggered.connect(partial(self._go_to_page, dock, page))

    def go_to(self, dock: QDockWidget, _checked: bool = False) -> None:
        """Bring a dock to the front, with the focus in it."""
        dock.show()
        dock.raise_()
        QApplication.sendPostedEvents()  # the dock takes its place, so that what lies in it can be seen
        inside = [child for child in dock.widget().findChildren(QWidget) if takes_tab(child)]
        if inside:
            inside[0].setFocus(Qt.FocusReason.ShortcutFocusReason)

    def _go_to_page(self, dock: QDockWidget, page: Page, _checked: bool = False) -> None:
        self.show_panel(page.name)
        self.go_to(dock)

    def close_workers(self) -> None:
        """End the threads of all pages and dialogs and close the dialogs beside the window, for it closes.

        Qt leaves them open, and what they are at half done.
        """
        for widget in self._window.findChildren(QWidget):
            if hasattr(widget, "close_worker"):  # of a hidden dialog too: it may go without being closed
                widget.close_worker()
            if widget.isWindow() and widget.isVisible() and not isinstance(widget, QDockWidget):
                widget.close()

    def take_over(self, other: PanelDocks) -> None:
        """Let pages go on with what those of a window had begun that this one takes the place of."""
        for page, old in zip(self._pages(), other._pages(), strict=True):
            if hasattr(page.widget, "take_over"):
                page.widget.take_over(old.widget)

    def _pages(self) -> list[Page]:
        stacks = [dock.widget() for dock in self.right]
        return [page for stack in stacks if isinstance(stack, PageStack) for page in stack.pages]

    @property
    def front_page(self) -> str:
        """The name of the page that can be seen, or of the panel where it has no pages."""
        pages = self.front.widget()
        return pages.current.name if isinstance(pages, PageStack) else self.front.objectName().removesuffix("_dock")

    def show_panel(self, name: str) -> bool:
        """Bring the panel or page of that name to the front; whether there is one."""
        for dock in self.right:
            pages = dock.widget()
            if isinstance(pages, PageStack) and name in [page.name for page in pages.pages]:
                pages.show_page(name)
            elif dock.objectName() != f"{name}_dock":
                continue
            dock.show()
            dock.raise_()
            return True
        return False


def takes_tab(widget: QWidget) -> bool:
    """Whether the Tab key stops there."""
    return bool(widget.focusPolicy().value & Qt.FocusPolicy.TabFocus.value) and widget.isVisible()


def lies_behind(widget: QWidget) -> bool:
    """Whether a widget is in a dock of which nothing can be seen."""
    parent: QWidget | None = widget
    while parent is not None and not isinstance(parent, QDockWidget):
        parent = parent.parentWidget()
    return parent is not None and parent.visibleRegion().isEmpty()
