"""The numbers of a shape as boxes: which there are for each kind, and one widget that edits any of them."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Literal, NamedTuple

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QGridLayout, QLabel, QLineEdit, QSizePolicy, QWidget

from rvsim.experiment import Shape
from rvsim.experiment.shapes import (
    ArcShape,
    ArcThroughShape,
    CircleShape,
    EllipseShape,
    PolygonShape,
    StarShape,
    TextShape,
)
from rvsim.gui.calm_boxes import CountBox
from rvsim.gui.panels.number_row import NumberRow
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Kind, length_kind
from rvsim.gui.quantity_box import QuantityBox
from rvsim.gui.theme import set_role
from rvsim.language import tr, tr_later
from rvsim.robot import Robot

_IN_ROW = 3


class Field(NamedTuple):
    """One number of a shape: its attribute, the English above its box, what kind it is, and what it may be [SI]."""

    name: str
    title: str
    kind: Literal["length", "angle", "count"]
    lower: float
    upper: float


def _length(name: str, title: str, lower: float = 1e-4) -> Field:
    return Field(name, title, "length", lower, 1e3)


_RADIUS = tr_later("radius")
_POINTS = Field("samples", tr_later("points"), "count", 2, 5001)
FIELDS: dict[type[Shape], tuple[Field, ...]] = {
    CircleShape: (_length("radius", _RADIUS), _POINTS),
    ArcShape: (
        _length("radius", _RADIUS),
        Field("begin", tr_later("from"), "angle", -12.6, 12.6),
        Field("sweep", tr_later("by"), "angle", -12.6, 12.6),
        _POINTS,
    ),
    ArcThroughShape: (_POINTS,),
    EllipseShape: (_length("a", tr_later("half axis x")), _length("b", tr_later("half axis y")), _POINTS),
    PolygonShape: (_length("radius", _RADIUS), Field("corners", tr_later("corners"), "count", 3, 60), _POINTS),
    StarShape: (_length("radius", _RADIUS), _POINTS),
    TextShape: (
        _length("height", tr_later("letter height")),
        _length("lift", tr_later("pen lift"), 0.0),
        _length("spacing", tr_later("point spacing"), 1e-4),
    ),
}


_ENDS = {  # of an arc: the label of a point, and what messages call it
    "start": (tr_later("Start"), tr_later("Arc start")),
    "via": (tr_later("Via"), tr_later("Arc via")),
    "end": (tr_later("End"), tr_later("Arc end")),
}


class ShapeEditor(QWidget):
    """What edits one kind of shape.

    Signals:
        edited(shape, merge): another one is wanted; edits of the same `merge` in a row are one.
        refused(sentence): why something typed was not taken.
        finished(): a box has been left.
    """

    edited = Signal(object, str)
    refused = Signal(str)
    finished = Signal()


class ShapeRows(ShapeEditor):
    """The boxes of one kind of shape."""

    def __init__(self, kind: type[Shape], robot: Robot, preferences: Preferences) -> None:
        super().__init__()
        self._shape: Any = None
        self._robot, self._preferences = robot, preferences
        self._boxes: dict[str, QuantityBox | CountBox] = {}
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setHorizontalSpacing(8)
        self._grid.setVerticalSpacing(2)
        self.text: QLineEdit | None = None
        self.corners: list[NumberRow] = []
        if kind is TextShape:
            self._add_text()
        if kind is ArcThroughShape:
            self._add_corners()
        for number, field in enumerate(FIELDS.get(kind, ())):
            self._add(field, self._grid.rowCount() if number % _IN_ROW == 0 else self._row, number % _IN_ROW)

    def _add(self, field: Field, row: int, column: int) -> None:
        self._row = row
        box = self._count(field) if field.kind == "count" else self._quantity(field)
        box.setObjectName(f"shape_{field.name}")
        box.setMinimumWidth(64)
        box.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        box.editingFinished.connect(self.finished)
        label = QLabel(tr(field.title))
        label.setBuddy(box)
        set_role(label, role="muted")
        self._grid.addWidget(label, row, column)
        self._grid.addWidget(box, row + 1, column)
        self._grid.setColumnStretch(column, 1)
        self._boxes[field.name] = box

    def _count(self, field: Field) -> CountBox:
        box = CountBox()
        box.setRange(int(field.lower), int(field.upper))
        box.setKeyboardTracking(False)
        box.setAccessibleName(tr("Shape: {quantity}", quantity=tr(field.title)))
        box.valueChanged.connect(lambda value: self._edit(**{field.name: value}))
        return box

    def _quantity(self, field: Field) -> QuantityBox:
        kind: Kind = length_kind(self._robot) if field.kind == "length" else "angle"
        box = QuantityBox(kind, self._preferences, tr("Shape: {quantity}", quantity=tr(field.title)))
        box.set_range(field.lower, field.upper, tr("Nothing of that size can be drawn."))
        box.quantity_changed.connect(lambda value: self._edit(**{field.name: value}))
        box.refused.connect(self.refused)
        return box

    def _add_text(self) -> None:
        self.text = QLineEdit()
        self.text.setObjectName("shape_text")
        self.text.setAccessibleName(tr("Text to write"))
        self.text.setMaxLength(60)
        self.text.textEdited.connect(lambda text: self._edit(text=text))
        self.text.editingFinished.connect(self.finished)
        self._grid.addWidget(self.text, 0, 0, 1, _IN_ROW)

    def _add_corners(self) -> None:
        kind = length_kind(self._robot)
        for number, (name, (title, long_title)) in enumerate(_ENDS.items()):
            row = NumberRow(f"arc_{name}", ("x", "y", "z"), (kind,) * 3, self._preferences, tr(long_title))
            row.edited.connect(lambda _, number=number: self._on_corner(number))
            row.refused.connect(self.refused)
            row.finished.connect(self.finished)
            label = QLabel(tr(title))
            self._grid.addWidget(label, 2 * number, 0, 1, _IN_ROW)
            self._grid.addWidget(row, 2 * number + 1, 0, 1, _IN_ROW)
            self.corners.append(row)

    def _on_corner(self, number: int) -> None:
        points = self._shape.points.copy()
        points[number] = self.corners[number].values
        self._edit(points=points)

    def _edit(self, **changes: Any) -> None:
        self.edited.emit(replace(self._shape, **changes), f"shape {' '.join(changes)}")

    def show_shape(self, shape: Shape) -> None:
        """Show its numbers, silently."""
        self._shape = shape
        for name, box in self._boxes.items():
            value = getattr(shape, name)
            if isinstance(box, QuantityBox):
                box.set_quantity(float(value))
                continue
            with QSignalBlocker(box):
                box.setValue(value)
        if self.text is not None and isinstance(shape, TextShape) and self.text.text() != shape.text:
            self.text.setText(shape.text)
        if isinstance(shape, ArcThroughShape):
            for row, point in zip(self.corners, shape.points, strict=True):
                row.show_values(point)
