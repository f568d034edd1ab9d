"""Several pages in one panel, one seen at a time, with a button for each above them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from PySide6.QtCore import QEvent, QSize, Qt, Signal
from PySide6.QtGui import QFont, QFontMetrics, QKeyEvent
from PySide6.QtWidgets import QButtonGroup, QHBoxLayout, QStackedWidget, QToolButton, QVBoxLayout, QWidget

from rvsim.gui.rows import rows_of
from rvsim.language import tr

_WIDEST_ROW = 342  # [pixels]: what a panel can spare on a small screen
_ROOM = 8  # [pixels] of padding in a button
_GAP = 2  # [pixels] between buttons


class Page(NamedTuple):
    """One page: its name for tests and commands, the text on its button, what that shows, and the widget."""

    name: str
    title: str
    tip: str
    widget: QWidget


class PageStack(QWidget):
    """A page that has a method `set_seen(bool)` is told when it comes to the front and when it goes.

    Signals:
        fronted(self): the panel, or another page of it, can be seen now.
    """

    fronted = Signal(object)

    def __init__(self, object_name: str, pages: Sequence[Page]) -> None:
        super().__init__()
        self.setObjectName(object_name)
        self._pages = tuple(pages)
        self._seen = False
        self.setFocusPolicy(Qt.FocusPolicy.ClickFocus)  # a click between the controls leaves what had the focus
        self.stack = QStackedWidget()
        self._buttons = QButtonGroup(self)
        self._buttons.setExclusive(True)
        for page in self._pages:
            self.stack.addWidget(page.widget)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        self._rows = QVBoxLayout()
        self._rows.setContentsMargins(6, 6, 6, 2)
        self._rows.setSpacing(_GAP)
        self._counts: tuple[int, ...] = ()
        column.addLayout(self._rows)
        column.addWidget(self.stack, 1)
        for number, page in enumerate(self._pages):
            self._button(number, page)
        self._share_out()
        self._buttons.idClicked.connect(self._go)
        self._buttons.button(0).setChecked(True)
        self._tell()

    def changeEvent(self, event: QEvent) -> None:
        """Other letters may need other rows."""
        super().changeEvent(event)
        if event.type() in (QEvent.Type.FontChange, QEvent.Type.StyleChange):
            self._share_out()

    def _share_out(self) -> None:
        """Rows of buttons alike in width where there is room; where there is not, each as wide as its own word."""
        made = self._buttons.buttons()
        counts = rows_of([each.minimumSizeHint().width() for each in made], _GAP, _WIDEST_ROW)
        if counts == self._counts:
            return
        self._counts = counts
        while (old := self._rows.takeAt(0)) is not None:
            old.deleteLater() if isinstance(old, QHBoxLayout) else None
        for count in counts:
            row = QHBoxLayout()
            row.setSpacing(_GAP)
            self._rows.addLayout(row)
            for each in made[:count]:
                row.addWidget(each, 1)
            if count < max(counts):
                row.addStretch(max(counts) - count)
            del made[:count]

    def _button(self, number: int, page: Page) -> None:
        made = _PageButton(self)
        made.setObjectName(f"{page.name}_page_button")
        made.setText(tr(page.title))
        made.setToolTip(tr(page.tip))
        made.setStatusTip(tr("{tip}. F1 explains this page.", tip=tr(page.tip)))
        made.setCheckable(True)
        made.setProperty("role", "page")
        made.setSizePolicy(made.sizePolicy().horizontalPolicy().Expanding, made.sizePolicy().verticalPolicy())
        self._buttons.addButton(made, number)

    @property
    def pages(self) -> tuple[Page, ...]:
        """All pages, in the order of their buttons."""
        return self._pages

    @property
    def current(self) -> Page:
        """The page in front."""
        return self._pages[self.stack.currentIndex()]

    def show_page(self, name: str) -> None:
        """Bring a page to the front of this panel."""
        self._go([page.name for page in self._pages].index(name))

    def step(self, by: int, *, focus: bool = False) -> None:
        """To the next page or the one before, round and round."""
        number = (self.stack.currentIndex() + by) % len(self._pages)
        self._go(number)
        if focus:
            self._buttons.button(number).setFocus(Qt.FocusReason.TabFocusReason)

    def set_seen(self, seen: bool) -> None:
        """Whether the panel can be seen: a dock behind another one counts as shown for Qt, but not for the eye."""
        self._seen = seen
        self._tell()

    def _go(self, number: int) -> None:
        self._buttons.button(number).setChecked(True)
        self.stack.setCurrentIndex(number)
        self._tell()

    def _tell(self) -> None:
        """Those that go before the one that comes: they may draw in the same place."""
        for page in sorted(self._pages, key=lambda page: page is self.current):
            if hasattr(page.widget, "set_seen"):
                page.widget.set_seen(self._seen and page is self.current)
        if self._seen:
            self.fronted.emit(self)


class _PageButton(QToolButton):
    """Left and right arrows go to the neighbours, as in a row of tabs."""

    def __init__(self, stack: PageStack) -> None:
        super().__init__()
        self._stack = stack

    def minimumSizeHint(self) -> QSize:
        """As wide as the word when it is bold, with a little room."""
        font = QFont(self.font())
        font.setBold(True)
        return QSize(QFontMetrics(font).horizontalAdvance(self.text()) + _ROOM, super().minimumSizeHint().height())

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Step with the arrows; anything else is the button's own."""
        onward = -1 if self.isRightToLeft() else 1
        steps = {Qt.Key.Key_Left: -onward, Qt.Key.Key_Right: onward}
        key = Qt.Key(event.key())
        if key in steps:
            self._stack.step(steps[key], focus=True)
        else:
            super().keyPressEvent(event)
