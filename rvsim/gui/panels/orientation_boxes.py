"""Boxes for an orientation in the notation one likes; what is typed stays until all of it is there."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import Signal
from PySide6.QtWidgets import QApplication, QVBoxLayout, QWidget

from rvsim.gui.orientations import NOTATIONS
from rvsim.gui.panels.number_row import NumberRow
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import format_number
from rvsim.language import tr
from rvsim.robot.arrays import FloatArray

_SAME = 1e-9  # entries of a rotation so close are the same one
_UNTURNED = 1e-12


class OrientationBoxes(QWidget):
    """One row of boxes a notation, of which one is seen.

    Each number that is entered turns the tool at once, to the orientation that all the numbers mean together: the four
    of a quaternion, and an axis, are brought to length 1 for that. The boxes keep what was typed until they are left or
    the orientation changes by other means: only so can four numbers be entered one after the other.

    Signals:
        turned(R, name): the orientation (3, 3) that is wanted now, and which number was changed.
        refused(sentence): why what was typed means no orientation.
        told(sentence): how numbers of another length than 1 have been taken.
        finished(): Enter has been pressed in a box, or it has been left.
    """

    turned = Signal(object, str)
    refused = Signal(str)
    told = Signal(str)
    finished = Signal()

    def __init__(self, prefix: str, title: str, preferences: Preferences) -> None:
        super().__init__()
        self._R: FloatArray = np.eye(3)
        self._kept: FloatArray | None = None  # the orientation for which the boxes keep what was typed
        self._turning = False
        self._free = ""  # why they are grey
        self._notation = "rpy"
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        self.rows: dict[str, NumberRow] = {}
        for name, notation in NOTATIONS.items():
            row_prefix = prefix if name == "rpy" else f"{prefix}_{name}"
            row = NumberRow(row_prefix, notation.names, notation.kinds, preferences, title, notation.hint)
            row.edited.connect(self._on_edited)
            row.refused.connect(self.refused)
            row.finished.connect(self._on_finished)
            row.setVisible(name == self._notation)
            column.addWidget(row)
            self.rows[name] = row

    def show_notation(self, name: str) -> None:
        """Show the boxes of another notation."""
        if name == self._notation:
            return
        self._notation = name
        for other, row in self.rows.items():
            row.setVisible(other == name)
        self._show()

    def set_free(self, why: str) -> None:
        """Grey the boxes, for the reason `why`; "" where the orientation counts."""
        if why == self._free:
            return
        self._free = why
        self.setEnabled(not why)
        self.setToolTip(why)
        for row in self.rows.values():
            for box in row.boxes:
                box.set_hint(why or tr(row.hint))

    def show_rotation(self, R: FloatArray) -> None:
        """Show an orientation (3, 3)."""
        self._R = R
        if not self._turning and (self._kept is None or np.abs(R - self._kept).max() > _SAME):
            self._show()

    def _show(self) -> None:
        self._kept = None
        self.rows[self._notation].show_values(NOTATIONS[self._notation].read(self._R))

    def _on_edited(self, index: int) -> None:
        notation, values = NOTATIONS[self._notation], self.rows[self._notation].values
        problem = notation.problem(values)
        if problem:
            self._kept = self._R
            self.refused.emit(problem)
            return
        R = notation.write(values)
        if np.abs(R - self._R).max() > _UNTURNED:
            self._turn(R, notation.names[index])
        # Angles that cannot be had go back; of numbers that belong together the others may still be to come.
        if notation.direction or np.abs(R - self._R).max() <= _SAME:
            self._kept = self._R
            self._tell_length(values[: notation.direction])
        else:
            self._show()

    def _turn(self, R: FloatArray, name: str) -> None:
        self._turning = True
        try:
            self.turned.emit(R, name)
        finally:
            self._turning = False

    def _tell_length(self, direction: FloatArray) -> None:
        length = float(np.linalg.norm(direction))
        if direction.size and abs(length - 1.0) > 5e-4:
            taken = ", ".join(format_number(number, 4) for number in (direction / length).tolist())
            self.told.emit(tr("Length {length}, taken as {taken}.", length=format_number(length, 4), taken=taken))

    def _on_finished(self) -> None:
        self.finished.emit()
        focus = QApplication.focusWidget()
        # Another window's turn is no leaving: somebody may look there for the next number.
        if self._kept is not None and focus is not None and not self.isAncestorOf(focus):
            self._show()
