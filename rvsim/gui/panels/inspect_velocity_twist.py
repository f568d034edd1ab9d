"""Six boxes for a velocity or an acceleration of the tool: three linear, three angular."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QGridLayout, QLabel, QSizePolicy, QWidget

from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Kind, display, format_number
from rvsim.gui.quantity_box import QuantityBox
from rvsim.gui.theme import set_role
from rvsim.motion.jog_course import Axes
from rvsim.robot.arrays import FloatArray


class TwistBoxes(QWidget):
    """Two rows of three boxes under their names; `edited(index, value)` tells what was typed, in SI."""

    edited = Signal(int, float)

    def __init__(self, prefix: str, signs: tuple[str, str], preferences: Preferences) -> None:
        super().__init__()
        self._kinds: tuple[Kind, Kind] = ("length_speed", "angle_speed")
        self.boxes: list[QuantityBox] = []
        self.notes: list[QLabel] = []
        self._preferences = preferences
        self.setLayoutDirection(Qt.LayoutDirection.LeftToRight)
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(8)
        grid.setVerticalSpacing(2)
        for index in range(6):
            name = f"{signs[index // 3]}{'xyz'[index % 3]}"
            box = QuantityBox(self._kinds[index // 3], preferences, name)
            box.setObjectName(f"{prefix}_{'vw'[index // 3]}{'xyz'[index % 3]}")
            box.setMinimumWidth(64)
            box.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
            box.quantity_changed.connect(lambda value, i=index: self.edited.emit(i, value))
            label = QLabel(name)
            label.setBuddy(box)
            set_role(label, role="muted")
            note = QLabel()
            note.setAlignment(Qt.AlignmentFlag.AlignRight)
            note.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
            note.setContentsMargins(0, 0, 6, 2)
            note.hide()
            set_role(note, level="warning")
            for row, widget in enumerate((label, box, note)):
                grid.addWidget(widget, 3 * (index // 3) + row, index % 3)
            label.setAlignment(Qt.AlignmentFlag.AlignRight)
            grid.setColumnStretch(index % 3, 1)
            self.boxes.append(box)
            self.notes.append(note)

    def take_kinds(self, kinds: tuple[Kind, Kind]) -> None:
        """Show other kinds of quantities: linear, angular."""
        if kinds != self._kinds:
            self._kinds = kinds
            for index, box in enumerate(self.boxes):
                box.set_kind(kinds[index // 3])

    def set_editable(self, editable: bool) -> None:
        """Whether they can be typed into."""
        for box in self.boxes:
            box.setReadOnly(not editable)

    def show_values(self, values: FloatArray) -> None:
        """Show SI values (6,), silently."""
        for box, value in zip(self.boxes, values.tolist(), strict=True):
            box.set_quantity(value)

    def show_notes(self, values: FloatArray | None) -> None:
        """Write SI values (6,) below the boxes, or nothing."""
        for index, note in enumerate(self.notes):
            if values is not None:
                shown = display(self._kinds[index // 3], self._preferences)
                note.setText(f"{format_number(float(values[index]) * shown.factor, shown.decimals)}{shown.suffix}")
            note.setVisible(values is not None)


def in_axes(twist: FloatArray, T: FloatArray, axes: Axes, *, inverse: bool = False) -> FloatArray:
    """A twist (6,) of base axes in the chosen ones, or back; T (4, 4) is the tool's pose."""
    if axes == "base":
        return twist
    R = T[:3, :3] if inverse else T[:3, :3].T
    return np.concatenate([R @ twist[:3], R @ twist[3:]])
