"""Searching bytes and words of a long log, a slice at a time, so that the window never waits."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from time import perf_counter

from PySide6.QtCore import QObject, QTimer, Signal

from rvsim.gui.panels.device_wire_lines import Line
from rvsim.gui.panels.device_wire_model import WireModel
from rvsim.language import without_isolates

_SLICE = 0.006  # [s] of work at once
_STRIDE = 50  # lines between two looks at the clock


class WireSearch(QObject):
    """Looks for a text in the lines that a model shows; new lines are looked at as they come.

    Signals:
        changed(): there are more or fewer matches, or all lines have been looked at.
    """

    changed = Signal()

    def __init__(self, model: WireModel, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._model = model
        self._wanted = ""
        self._next = 0  # the number of the line to be looked at next
        self.matches: list[int] = []  # numbers of lines, ascending
        self._timer = QTimer(self, interval=0)
        self._timer.timeout.connect(self._look)
        model.rowsInserted.connect(self._go_on)
        model.rowsRemoved.connect(self._forget_gone)
        model.modelReset.connect(self._again)

    @property
    def wanted(self) -> str:
        """What is searched for, "" for nothing."""
        return self._wanted

    @property
    def searching(self) -> bool:
        """Whether lines are left that have not been looked at."""
        return self._timer.isActive()

    def search(self, text: str) -> None:
        """Search for another text, in bytes and words; capitals do not matter."""
        self._wanted = text.strip().casefold()
        self._again()

    @property
    def end(self) -> int:
        """A number behind those of all lines that have been looked at."""
        return self._next

    def after(self, number: int) -> int | None:
        """The first match behind the line of that number, or else the first one of all."""
        place = bisect_right(self.matches, number)
        return self.matches[place % len(self.matches)] if self.matches else None

    def before(self, number: int) -> int | None:
        """The last match before the line of that number, or else the last one of all."""
        return self.matches[bisect_left(self.matches, number) - 1] if self.matches else None

    def place(self, number: int) -> int:
        """Which of the matches the line of that number is, from 1; 0 if it is none."""
        place = bisect_left(self.matches, number)
        return place + 1 if place < len(self.matches) and self.matches[place] == number else 0

    def _again(self) -> None:
        self.matches, self._next = [], 0
        self._model.tint(None)
        self._go_on()
        self.changed.emit()

    def _go_on(self) -> None:
        if self._wanted:
            self._timer.start()
        else:
            self._timer.stop()

    def _look(self) -> None:
        """A slice."""
        ends = perf_counter() + _SLICE
        shown, row = self._model.shown, self._model.row_of(self._next)
        found: list[int] = []
        while row < len(shown) and perf_counter() < ends:
            stride = shown[row : row + _STRIDE]
            found.extend(line.number for line in stride if self._matches(line))
            row += len(stride)
        done = row >= len(shown)
        self._next = shown[-1].number + 1 if done and shown else shown[row].number if shown else 0
        self._take(found)
        if done:
            self._timer.stop()
        if found or done:
            self.changed.emit()

    def _take(self, found: list[int]) -> None:
        if found:
            self.matches.extend(found)
            self._model.tint(found)

    def _matches(self, line: Line) -> bool:
        model = self._model
        return (
            self._wanted in model.text(line).casefold()
            or self._wanted in without_isolates(model.words.of(line)).casefold()
        )

    def _forget_gone(self) -> None:
        first = self._model.shown[0].number if self._model.shown else self._next
        gone = bisect_left(self.matches, first)
        if gone:
            del self.matches[:gone]
            self.changed.emit()
