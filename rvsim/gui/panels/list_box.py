"""A value box that a whole list of numbers can be pasted or typed into: a pose, a position, a quaternion."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import Signal
from PySide6.QtGui import QGuiApplication, QKeyEvent, QKeySequence

from rvsim.gui.panels.pose_text import pose_values
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Display, Kind, display
from rvsim.gui.quantity_box import QuantityBox


class ListBox(QuantityBox):
    """One of several boxes; `pose_given(values)` [shown units] tells that a list for all of them has been given.

    `units()` are those of all the boxes, as they are shown; `hint` stands in the tooltip below the value.
    """

    pose_given = Signal(tuple)

    def __init__(
        self, kind: Kind, preferences: Preferences, title: str, units: Callable[[], Sequence[str]], hint: str = ""
    ) -> None:
        self._units, self._hint, self._tip = units, hint, ""
        super().__init__(kind, preferences, title)

    @property
    def shown(self) -> Display:
        """How its value is shown at present."""
        return display(self._kind, self._preferences)

    def setToolTip(self, text: str) -> None:
        """The value in full, and the hint."""
        self._tip = text
        super().setToolTip(f"{text}\n{self._hint}" if self._hint else text)

    def set_hint(self, hint: str) -> None:
        """Another hint."""
        self._hint = hint
        self.setToolTip(self._tip)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """A pasted list is taken at once; all else goes into the box as text."""
        if not (event.matches(QKeySequence.StandardKey.Paste) and self._give(QGuiApplication.clipboard().text())):
            super().keyPressEvent(event)

    def fixup(self, text: str) -> str:
        """Asked for when what stands there is not one value: it may be a list."""
        return self.textFromValue(self.value()) if self._give(text) else super().fixup(text)

    def _give(self, text: str) -> bool:
        values = pose_values(text, self._units())
        if values:
            self._show()  # its own value until the list has been taken
            self.pose_given.emit(values)
            self.selectAll()
        return bool(values)
