"""Boxes side by side for the numbers of one thing: a position, three angles, a quaternion."""

from __future__ import annotations

from functools import partial

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QGridLayout, QLabel, QSizePolicy, QWidget

from rvsim.gui.panels.list_box import ListBox
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Kind, display, half_turn_up
from rvsim.gui.theme import set_role
from rvsim.language import tr, tr_later
from rvsim.robot.arrays import FloatArray

_LARGEST = 1e9


class NumberRow(QWidget):
    """Boxes side by side under their names, which are English; all their numbers can be pasted into any of them.

    Signals:
        edited(index): one has another value; of several given at once the one that took them tells.
        refused(sentence): why something typed was not taken.
        finished(): Enter has been pressed in a box, or it has been left.
    """

    edited = Signal(int)
    refused = Signal(str)
    finished = Signal()

    def __init__(
        self,
        prefix: str,
        names: tuple[str, ...],
        kinds: tuple[Kind, ...],
        preferences: Preferences,
        title: str = tr_later("Tool"),
        hint: str = "",
    ) -> None:
        super().__init__()
        self.setLayoutDirection(Qt.LayoutDirection.LeftToRight)  # as the numbers stand in formulas, in any language
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(8)
        grid.setVerticalSpacing(2)
        self._names, self._kinds, self._preferences, self._title = names, kinds, preferences, title
        self.hint = hint
        self.boxes: list[ListBox] = []
        for column, (name, kind) in enumerate(zip(names, kinds, strict=True)):
            box = ListBox(kind, preferences, f"{tr(title)} {tr(name)}", self._units, tr(hint))
            box.setObjectName(f"{prefix}_{name.replace(' ', '_')}")
            box.setMinimumWidth(64)
            box.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
            label = QLabel(tr(name))
            label.setBuddy(box)
            set_role(label, role="muted")
            grid.addWidget(label, 0, column, Qt.AlignmentFlag.AlignRight)
            grid.addWidget(box, 1, column)
            grid.setColumnStretch(column, 1)
            self.boxes.append(box)
            self._connect(column, box)

    def _connect(self, index: int, box: ListBox) -> None:
        box.pose_given.connect(partial(self._fill, index))
        box.quantity_changed.connect(lambda _: self.edited.emit(index))
        box.refused.connect(self.refused)
        box.editingFinished.connect(self.finished)

    @property
    def values(self) -> FloatArray:
        """(k,) what stands in the boxes [SI]."""
        return np.array([box.quantity for box in self.boxes])

    def show_values(self, values: FloatArray) -> None:
        """Show SI values, silently."""
        for box, kind, value in zip(self.boxes, self._kinds, values.tolist(), strict=True):
            shown = half_turn_up(value, display(kind, self._preferences)) if kind == "angle" else value
            box.set_quantity(shown)

    def _units(self) -> list[str]:
        return [box.shown.suffix.strip() for box in self.boxes]

    def _fill(self, index: int, values: tuple[float, ...]) -> None:
        """Take all the numbers [shown units], given to the box of that index."""
        box = self.boxes[index]
        if len(values) != len(self.boxes) or not all(abs(value) <= _LARGEST for value in values):
            wanted = tr("{count} numbers: {names}", count=len(self.boxes), names=", ".join(map(tr, self._names)))
            box.refused.emit(
                tr(
                    "{title}: not taken, for here one number can be given, or {wanted}.",
                    title=tr(self._title),
                    wanted=wanted,
                )
            )
            return
        for each, value in zip(self.boxes, values, strict=True):
            each.set_quantity(value / each.shown.factor)
        box.quantity_changed.emit(box.quantity)
