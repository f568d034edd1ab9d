"""Small fields of the laboratory: a number in any magnitude, a disclosure, a start joint with slider."""

from __future__ import annotations

import math

from PySide6.QtCore import QEvent, QObject, QSignalBlocker, QSize, Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QLineEdit, QScrollArea, QSizePolicy, QToolButton, QWidget

from rvsim.errors import ExpressionError
from rvsim.expressions import evaluate
from rvsim.gui.calm_boxes import Slider
from rvsim.gui.panels.joint_row import slider_range
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import joint_kind
from rvsim.gui.quantity_box import QuantityBox
from rvsim.gui.theme import number_font
from rvsim.language import tr
from rvsim.robot import Robot

_SLIDER_STEPS = 1000


class NumberEdit(QLineEdit):
    """A number of any magnitude, 1e−10 as well as 1500; `number_changed(float)`, or `refused(sentence)`."""

    number_changed = Signal(float)
    refused = Signal(str)

    def __init__(self, name: str, title: str, tip: str = "") -> None:
        super().__init__()
        self._title, self._number = title, math.nan
        self.setObjectName(name)
        self.setAccessibleName(title)
        self.setToolTip(tip or title)
        self.setFont(number_font(self.font()))
        self.setLayoutDirection(Qt.LayoutDirection.LeftToRight)
        self.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.setMinimumWidth(44)
        self.editingFinished.connect(self._take)

    @property
    def number(self) -> float:
        """What stands there."""
        return self._number

    def set_number(self, number: float) -> None:
        """Show a number, silently."""
        self._number = number
        self.setText(_number_text(number))
        self.setModified(False)

    def _take(self) -> None:
        if not self.isModified():
            return
        self.setModified(False)
        try:
            number = evaluate(self.text())
        except ExpressionError as problem:
            self.set_number(self._number)
            self.refused.emit(f"{self._title}: {problem}")
            return
        if number != self._number:
            self.set_number(number)
            self.number_changed.emit(number)


def _number_text(number: float) -> str:
    return f"{number:.6g}".replace("e-0", "e-").replace("e+0", "e").replace("e+", "e").replace("-", "\u2212")


class ContentArea(QScrollArea):
    """A column that scrolls, and would like to be as high as all of it, whatever in it is shown or hidden."""

    def __init__(self, inside: QWidget) -> None:
        super().__init__()
        self._inside = inside
        self.setWidget(inside)
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Preferred)
        inside.setAutoFillBackground(False)
        self.viewport().setAutoFillBackground(False)

    def sizeHint(self) -> QSize:
        """The size of all of it."""
        return self._inside.sizeHint()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """What is inside wants another size."""
        if event.type() == QEvent.Type.LayoutRequest and watched is self._inside:
            self.updateGeometry()
        return super().eventFilter(watched, event)


class Disclosure(QToolButton):
    """Shows and hides what stands below it; `show` and `hide` say what a click does then."""

    def __init__(self, name: str, show: str, hide: str, content: QWidget) -> None:
        super().__init__()
        self._tips = {False: show, True: hide}
        self._content = content
        self.setObjectName(name)
        self.clicked.connect(lambda: self.show_content(self._content.isHidden()))
        self.show_content(False)

    def show_content(self, on: bool) -> None:
        """Show or hide."""
        self._content.setVisible(on)
        self.setText("▾" if on else tr("▸"))
        self.setAccessibleName(self._tips[on])
        self.setToolTip(self.accessibleName())


class StartJoint(QWidget):
    """One joint of the start, in one line; `moved(index, value)` tells a new value [rad, m]."""

    moved = Signal(int, float)

    def __init__(self, robot: Robot, index: int, preferences: Preferences) -> None:
        super().__init__()
        self._index, self._ends = index, slider_range(robot, index, False)
        title = tr("Start of J{number} {joint}", number=index + 1, joint=tr(robot.joint_names[index]))
        self.slider = Slider()
        self.slider.setObjectName(f"lab_start_slider_{index + 1}")
        self.slider.setAccessibleName(tr("{title}, slider", title=title))
        self.slider.setToolTip(title)
        self.slider.setRange(0, _SLIDER_STEPS)
        self.slider.setPageStep(_SLIDER_STEPS // 20)
        self.box = QuantityBox(joint_kind(robot, index), preferences, title)
        self.box.setObjectName(f"lab_start_value_{index + 1}")
        self.box.setFixedWidth(92)
        self.box.quantity_changed.connect(lambda value: self.moved.emit(index, value))
        self.slider.valueChanged.connect(self._on_slider)
        chip = QLabel()
        chip.setFixedSize(10, 10)
        chip.setStyleSheet(f"background: {robot.joints[index].color}; border-radius: 5px;")
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(8)
        row.addWidget(chip)
        row.addWidget(QLabel(f"J{index + 1}"))
        row.addWidget(self.slider, 1)
        row.addWidget(self.box)

    def show_value(self, value: float) -> None:
        """Show a value [rad, m], silently."""
        self.box.set_quantity(value)
        lower, upper = self._ends
        with QSignalBlocker(self.slider):
            self.slider.setValue(round(_SLIDER_STEPS * (value - lower) / (upper - lower)))

    def _on_slider(self, step: int) -> None:
        lower, upper = self._ends
        value = lower + (upper - lower) * step / _SLIDER_STEPS
        self.box.set_quantity(value)
        self.moved.emit(self._index, value)
