"""A page that is made when it is seen for the first time: what few need does not hold up every start."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from PySide6.QtWidgets import QVBoxLayout, QWidget


class LatePage(QWidget):
    """Stands where the page will be; `make` makes it, and only once."""

    def __init__(self, make: Callable[[], QWidget]) -> None:
        super().__init__()
        self._make = make
        self._page: Any = None
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)

    @property
    def page(self) -> QWidget:
        """The page, made if it has not been yet."""
        if self._page is None:
            self._page = self._make()
            self._column.addWidget(self._page)
        page: QWidget = self._page
        return page

    def take_over(self, other: LatePage) -> None:
        """Go on with what the page of another window had begun."""
        if hasattr(other._page, "take_over"):
            page: Any = self.page
            page.take_over(other._page)

    def set_seen(self, seen: bool) -> None:
        """It comes to the front, or goes."""
        if seen or self._page is not None:
            page: Any = self.page
            page.set_seen(seen)
