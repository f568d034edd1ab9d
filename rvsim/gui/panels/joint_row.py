"""The row of a joint in the left panel: its name, its value, and a slider between its limits."""

from __future__ import annotations

import math

from PySide6.QtCore import QEvent, QSignalBlocker, Qt, Signal
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QHBoxLayout, QLabel, QVBoxLayout, QWidget

from rvsim.gui.calm_boxes import Slider
from rvsim.gui.panels.joint_box import JointBox
from rvsim.gui.panels.tables import text_metrics
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import display, format_number, joint_kind
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import ElidedLabel
from rvsim.language import tr, tr_later
from rvsim.robot import Robot

IGNORE_HINT = tr_later("Switch “Ignore limits” on to go there.")
_LONGEST = "−1000.0 mm"
_SLIDER_STEPS = {"angle": math.radians(0.1), "length": 1e-4, "unit_length": 1e-3}


def slider_range(robot: Robot, joint: int, ignore_limits: bool) -> tuple[float, float]:
    """The span of a joint's slider [rad, m]: its limits, or a full turn or the arm's size where there are none."""
    lower, upper = robot.limits[joint]
    free = 2 * math.pi if robot.joints[joint].continuous else math.pi
    free = free if robot.joints[joint].revolute else robot.size
    if ignore_limits or math.isinf(lower):
        lower = min(lower, -free) if math.isfinite(lower) else -free
    if ignore_limits or math.isinf(upper):
        upper = max(upper, free) if math.isfinite(upper) else free
    return float(lower), float(upper)


class JointRow(QWidget):
    """One joint: name in its colour, value box, slider between its written limits.

    `moved(index, value)` tells a new value [rad, m]; `released()` that a drag or an edit is over.
    """

    moved = Signal(int, float)
    released = Signal()
    refused = Signal(str)

    def __init__(self, robot: Robot, index: int, preferences: Preferences) -> None:
        super().__init__()
        self._robot, self._index, self._preferences = robot, index, preferences
        self._kind = joint_kind(robot, index)
        joint = robot.joints[index]
        title = tr("J{number} {joint}", number=index + 1, joint=tr(joint.name))
        self.box = JointBox(robot, index, preferences, title)
        self.box.setObjectName(f"joint_value_{index + 1}")
        self.slider = Slider()
        self.slider.setObjectName(f"joint_slider_{index + 1}")
        self.slider.setAccessibleName(tr("{title}, slider", title=title))
        self._lower, self._upper = QLabel(), QLabel()
        self._mark = QLabel("⚠")
        self._step = _SLIDER_STEPS[self._kind]
        self._lay_out(title, joint.color)
        self._size_box()
        self.slider.valueChanged.connect(self._on_slider)
        self.slider.sliderReleased.connect(self.released)
        self.box.quantity_changed.connect(self._on_box)
        self.box.editingFinished.connect(self.released)
        self.box.refused.connect(self.refused)

    def _lay_out(self, title: str, color: str) -> None:
        chip = QLabel()
        chip.setFixedSize(10, 10)
        chip.setStyleSheet(f"background: {color}; border-radius: 5px;")
        name = ElidedLabel()
        name.setText(title)
        name.setBuddy(self.box)
        for label in (self._lower, self._upper):
            set_role(label, role="muted")
        set_role(self._mark, level="error")
        self._mark.setToolTip(tr("{title} is outside its limits", title=title))
        self._mark.setAccessibleName(tr("{title} is outside its limits", title=title))
        self._mark.hide()
        self.slider.setStyleSheet(_slider_style(color))
        top = QHBoxLayout()
        top.setSpacing(8)
        top.addWidget(chip)
        top.addWidget(name, 1)
        top.addWidget(self._mark)
        top.addWidget(self.box)
        ends = QWidget()
        ends.setLayoutDirection(Qt.LayoutDirection.LeftToRight)  # numbers grow to the right, in any language
        bottom = QHBoxLayout(ends)
        bottom.setContentsMargins(0, 0, 0, 0)
        bottom.setSpacing(6)
        bottom.addWidget(self._lower)
        bottom.addWidget(self.slider, 1)
        bottom.addWidget(self._upper)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2)
        column.addLayout(top)
        column.addWidget(ends)

    def changeEvent(self, event: QEvent) -> None:
        """Larger digits need a wider box."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._size_box()

    def _size_box(self) -> None:
        self.box.setFixedWidth(max(104, text_metrics().horizontalAdvance(_LONGEST) + 18))

    def show_limits(self, ignore_limits: bool, hint: str = IGNORE_HINT) -> None:
        """Let box and slider go as far as they may, and write at the slider's ends how far that is.

        Args:
            hint: a sentence about values beyond the limits, in English.
        """
        lower, upper = self._robot.limits[self._index]
        taken = (-math.inf, math.inf) if ignore_limits else (float(lower), float(upper))
        self.box.set_range(taken[0], taken[1], tr(hint))
        shown = display(self._kind, self._preferences)
        ends = slider_range(self._robot, self._index, ignore_limits)
        decimals = 0 if self._kind == "angle" and shown.factor != 1.0 else shown.decimals
        for label, limit, end in zip((self._lower, self._upper), (lower, upper), ends, strict=True):
            free = math.isinf(limit)
            label.setText(format_number(end * shown.factor, decimals))
            label.setToolTip(
                tr("No limit") if free else tr("Limit: {limit}", limit=f"{limit * shown.factor:g}{shown.suffix}")
            )
        with QSignalBlocker(self.slider):
            self.slider.setRange(math.ceil(ends[0] / self._step - 1e-6), math.floor(ends[1] / self._step + 1e-6))
            self.slider.setSingleStep(round(shown.step / shown.factor / self._step) or 1)
            self.slider.setPageStep(10 * self.slider.singleStep())

    def show_value(self, value: float) -> None:
        """Show a joint value [rad, m], silently."""
        self.box.set_quantity(value)
        with QSignalBlocker(self.slider):
            # Where limits are ignored a value may lie beyond the slider, and beyond the integers that it counts in.
            position = min(max(value / self._step, self.slider.minimum()), self.slider.maximum())
            self.slider.setValue(round(position))
        lower, upper = self._robot.limits[self._index]
        outside = not lower - 1e-9 <= value <= upper + 1e-9
        if outside == self._mark.isHidden():
            self._mark.setVisible(outside)
            set_role(self.box, outside=outside)

    def _on_slider(self, position: int) -> None:
        lower, upper = self.box.limits
        self.moved.emit(self._index, min(max(position * self._step, lower), upper))
        if not self.slider.isSliderDown():
            self.released.emit()

    def _on_box(self, value: float) -> None:
        self.moved.emit(self._index, value)


def _slider_style(color: str) -> str:
    handle = QColor(color).darker(115).name()
    return (
        "QSlider { min-height: 20px; }"
        "QSlider::groove:horizontal { height: 4px; border-radius: 2px; background: palette(mid); }"
        f"QSlider::sub-page:horizontal {{ height: 4px; border-radius: 2px; background: {color}; }}"
        "QSlider::handle:horizontal { width: 14px; height: 14px; margin: -5px 0; border-radius: 7px;"
        f" background: {color}; border: 1px solid {handle}; }}"
        "QSlider::handle:horizontal:focus { border: 2px solid palette(text); }"
    )
