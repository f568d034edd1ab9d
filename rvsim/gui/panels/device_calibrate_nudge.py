"""Nudging one servo: big buttons that repeat while they are held, arrow keys, and a box for the pulse itself."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QHBoxLayout, QPushButton, QSizePolicy, QWidget

from rvsim.gui.calm_boxes import CountBox
from rvsim.gui.quantities import format_number
from rvsim.language import left_to_right, tr, tr_later
from rvsim.robot.servo import LONGEST_US, SHORTEST_US

_STEPS = (-10, -1, 1, 10)
_ARROWS = {Qt.Key.Key_Left: -1, Qt.Key.Key_Down: -1, Qt.Key.Key_Right: 1, Qt.Key.Key_Up: 1}
_LONGER = (
    tr_later("{step} µs longer"),
    tr_later("A pulse {step} µs longer; hold the button to go on. Arrow keys: 1 µs, with Shift 10 µs"),
)
_SHORTER = (
    tr_later("{step} µs shorter"),
    tr_later("A pulse {step} µs shorter; hold the button to go on. Arrow keys: 1 µs, with Shift 10 µs"),
)
_DELAY_MS, _REPEAT_MS = 350, 100


class NudgeRow(QWidget):
    """Emits `pulse_wanted(µs)`. What it shows is what was last asked for, or what the arm is known to have."""

    pulse_wanted = Signal(float)

    def __init__(self) -> None:
        super().__init__()
        self.box = CountBox()
        self.box.setObjectName("calibrate_pulse")
        self.box.setAccessibleName(tr("Pulse of this servo"))
        self.box.setToolTip(
            tr("The pulse of this servo; typed ones are gone to slowly. Arrows: 1 µs, page keys: 10 µs")
        )
        self.box.setRange(round(SHORTEST_US), round(LONGEST_US))
        self.box.setSuffix(" µs")
        self.setLayoutDirection(Qt.LayoutDirection.LeftToRight)  # shorter at the left, as on a scale
        self.box.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.box.setKeyboardTracking(False)
        self.box.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.box.valueChanged.connect(lambda value: self.pulse_wanted.emit(float(value)))
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(4)
        for step in _STEPS:
            if step == 1:
                row.addWidget(self.box, 2)
            row.addWidget(self._button(step), 1)

    def _button(self, step: int) -> QPushButton:
        made = _StepButton(left_to_right(format_number(step, 0) if step < 0 else f"+{step}"))
        made.setObjectName(f"calibrate_{'minus' if step < 0 else 'plus'}_{abs(step)}")
        name, tip = _LONGER if step > 0 else _SHORTER
        made.setAccessibleName(tr(name, step=abs(step)))
        made.setToolTip(tr(tip, step=abs(step)))
        made.setAutoDefault(False)
        made.setAutoRepeat(True)
        made.setAutoRepeatDelay(_DELAY_MS)
        made.setAutoRepeatInterval(_REPEAT_MS)
        made.clicked.connect(partial(self.nudge, step))
        made.stepped.connect(self.nudge)
        return made

    @property
    def pulse_us(self) -> float:
        """What is shown [µs]."""
        return float(self.box.value())

    def show_pulse(self, pulse_us: float) -> None:
        """Show where the servo is, silently; not over what is being typed."""
        if not self.box.lineEdit().isModified():
            with QSignalBlocker(self.box):
                self.box.setValue(round(pulse_us))

    def nudge(self, step: int, _checked: bool = False) -> None:
        """A step from what was asked for last [µs]."""
        self.box.setValue(self.box.value() + step)


class _StepButton(QPushButton):
    """Arrow keys step here too, instead of going to a neighbour."""

    stepped = Signal(int)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """1 µs, with Shift 10 µs; everything else is the button's own."""
        key = Qt.Key(event.key())
        if key in _ARROWS:
            self.stepped.emit(_ARROWS[key] * (10 if event.modifiers() & Qt.KeyboardModifier.ShiftModifier else 1))
        else:
            super().keyPressEvent(event)
