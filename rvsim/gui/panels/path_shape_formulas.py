"""Formulas x(t), y(t), z(t) in stages, typed as source 003 has them."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QGridLayout, QHBoxLayout, QLabel, QLineEdit, QVBoxLayout, QWidget

from rvsim.errors import FormulaError
from rvsim.experiment import Shape
from rvsim.experiment.shapes import FormulaShape, FormulaStage
from rvsim.gui.calm_boxes import CountBox
from rvsim.gui.panels.path_shape_rows import ShapeEditor
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantity_box import QuantityBox
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import button, silence
from rvsim.lab.shape_paths import MOST_SAMPLES, SPIRAL_STAGES, formula_points
from rvsim.language import tr
from rvsim.robot import Robot

_MOST_STAGES = 8


class _StageRows(QWidget):
    """One stage: until when, how many points, and the three formulas. `edited()` tells of each change."""

    edited = Signal()
    removed = Signal()

    def __init__(self, number: int, preferences: Preferences) -> None:
        super().__init__()
        self._stage: FormulaStage | None = None
        self.end = QuantityBox("time", preferences, tr("Stage {number} until", number=number))
        self.end.setObjectName(f"stage{number}_end")
        self.end.quantity_changed.connect(lambda _: self._tell())
        self.samples = CountBox()
        self.samples.setObjectName(f"stage{number}_samples")
        self.samples.setAccessibleName(tr("Stage {number}: number of points", number=number))
        self.samples.setRange(2, MOST_SAMPLES)
        self.samples.setKeyboardTracking(False)
        self.samples.setSuffix(tr(" pts"))
        self.samples.valueChanged.connect(lambda _: self._tell())
        self.remove = button(f"stage{number}_remove", "\u2212", tr("Take this stage out"), self.removed.emit)
        self.remove.setMaximumWidth(28)
        self.setLayoutDirection(Qt.LayoutDirection.LeftToRight)  # formulas, in any language
        self.lines = {name: self._line(number, name) for name in "xyz"}
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 4)
        grid.setSpacing(4)
        head = QHBoxLayout()
        head.setSpacing(6)
        self.title = QLabel()
        for widget, stretch in ((self.title, 0), (self.end, 1), (self.samples, 1), (self.remove, 0)):
            head.addWidget(widget, stretch)
        grid.addLayout(head, 0, 0, 1, 2)
        for row, (name, line) in enumerate(self.lines.items(), 1):
            grid.addWidget(QLabel(f"{name} ="), row, 0)
            grid.addWidget(line, row, 1)

    def _line(self, number: int, name: str) -> QLineEdit:
        line = QLineEdit()
        line.setObjectName(f"stage{number}_{name}")
        line.setAccessibleName(tr("Stage {number}: {name} as a formula of t", number=number, name=name))
        line.setMaxLength(200)
        line.editingFinished.connect(self._tell)
        return line

    def show_stage(self, begin: float, stage: FormulaStage, *, only: bool) -> None:
        """Show a stage, silently; the only one cannot be taken out."""
        self._stage = stage
        self.title.setText(tr("t = {begin:g} s to", begin=begin))
        self.end.set_range(begin + 1e-3, 1e4, tr("The stage begins at {begin:g} s.", begin=begin))
        self.end.set_quantity(stage.end)
        with QSignalBlocker(self.samples):
            self.samples.setValue(stage.samples)
        for name, line in self.lines.items():
            if line.text() != getattr(stage, name):
                line.setText(getattr(stage, name))
        self.remove.setEnabled(not only)

    @property
    def stage(self) -> FormulaStage:
        """What stands in the boxes."""
        x, y, z = (line.text() for line in self.lines.values())
        return FormulaStage(self.end.quantity, self.samples.value(), x, y, z)

    def _tell(self) -> None:
        if self._stage is not None and self.stage != self._stage:
            self.edited.emit()


class FormulaRows(ShapeEditor):
    """All stages, one below the other. Formulas that do not work are told of, and not taken."""

    def __init__(self, robot: Robot, preferences: Preferences) -> None:
        super().__init__()
        self._preferences = preferences
        self._shape: FormulaShape | None = None
        self._rows: list[_StageRows] = []
        self.unit = QLabel(wordWrap=True)
        set_role(self.unit, role="muted")
        length = "mm" if robot.length_unit == "millimetre" else tr("the arm’s unit")
        self.unit.setText(tr("x, y, z in {length}, t in s, angles in rad: sin, cos, sqrt, exp, pi …", length=length))
        self.problem = QLabel(wordWrap=True)
        self.problem.setObjectName("formula_problem")
        set_role(self.problem, level="error")
        self.add = button("stage_add", tr("Add a stage"), tr("Go on from where the last stage ends"), self._add_stage)
        tip = tr("The two stages of source 003: straight up, then a spiral, 2001 points in its unit")
        self.spiral = button("formula_spiral", tr("Source 003"), tip, self._take_spiral)
        self._column = QVBoxLayout()
        self._column.setSpacing(4)
        buttons = QHBoxLayout()
        buttons.addWidget(self.add)
        buttons.addWidget(self.spiral)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(4)
        column.addWidget(self.unit)
        column.addLayout(self._column)
        column.addWidget(self.problem)
        column.addLayout(buttons)
        self.problem.hide()

    def show_shape(self, shape: Shape) -> None:
        """Show its stages, silently."""
        assert isinstance(shape, FormulaShape)
        if shape is self._shape:
            return
        self._shape = shape
        self.problem.hide()
        self._match(len(shape.stages))
        begin = shape.begin
        for rows, stage in zip(self._rows, shape.stages, strict=True):
            rows.show_stage(begin, stage, only=len(shape.stages) == 1)
            begin = stage.end
        self.add.setEnabled(len(shape.stages) < _MOST_STAGES)

    def _match(self, count: int) -> None:
        """As many rows as there are stages."""
        while len(self._rows) > count:
            last = self._rows.pop()
            silence(last)
            last.hide()
            last.deleteLater()
        while len(self._rows) < count:
            number = len(self._rows)
            rows = _StageRows(number + 1, self._preferences)
            rows.edited.connect(lambda number=number: self._on_stage(number))
            rows.removed.connect(lambda number=number: self._take_out(number))
            rows.end.refused.connect(self.refused)
            self._rows.append(rows)
            self._column.addWidget(rows)

    def _on_stage(self, number: int) -> None:
        """All that stands in the boxes counts: another formula may wait for being mended too."""
        assert self._shape is not None
        stages = [rows.stage for rows in self._rows]
        later = number + 1
        if later < len(stages) and stages[later].end <= stages[number].end:
            self._complain(
                tr("Stage {number} ends at {end:g} s, before it begins.", number=later + 1, end=stages[later].end)
            )
            return
        self._take(replace(self._shape, stages=tuple(stages)))

    def _take(self, shape: FormulaShape) -> None:
        try:
            formula_points(shape)
        except FormulaError as problem:
            self._complain(str(problem))
            return
        self.problem.hide()
        self.edited.emit(shape, "")

    def _complain(self, sentence: str) -> None:
        self.problem.setText(sentence)
        self.problem.show()

    def _add_stage(self) -> None:
        """As long as the last one, standing where that one ends, to be typed over."""
        assert self._shape is not None
        last = self._shape.stages[-1]
        place = formula_points(self._shape)[-1] / self._shape.unit
        x, y, z = (f"{value + 0.0:.6g}" for value in place)
        begin = self._shape.stages[-2].end if len(self._shape.stages) > 1 else self._shape.begin
        stage = FormulaStage(2 * last.end - begin, last.samples, x, y, z)
        self._take(replace(self._shape, stages=(*self._shape.stages, stage)))

    def _take_out(self, number: int) -> None:
        assert self._shape is not None
        stages = self._shape.stages
        self._take(replace(self._shape, stages=(*stages[:number], *stages[number + 1 :])))

    def _take_spiral(self) -> None:
        assert self._shape is not None
        self._take(replace(self._shape, stages=SPIRAL_STAGES, begin=0.0))
