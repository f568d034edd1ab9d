"""The small card in the corner of the scene: where the tool is, readable while the eyes are on the arm."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from PySide6.QtCore import QEvent, QObject, QRect, QSize, Qt, QTimer
from PySide6.QtGui import QFont, QPainter, QPaintEvent
from PySide6.QtWidgets import QLabel, QStyle, QStyleOption, QWidget

from rvsim.experiment import Experiment
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Kind, display, format_number, half_turn_up, length_kind
from rvsim.gui.session import Session
from rvsim.kinematics import forward_kinematics
from rvsim.language import tr
from rvsim.robot.arrays import FloatArray
from rvsim.spatial import rpy_from_rotation

_MARGIN = 12
_PADDING_X, _PADDING_Y = 12, 6
_NAME_GAP, _GAP = 5, 14  # [pixels] between a name and its number, and between a number and the next name
_WIDEST_LENGTH = -8.888  # [m]
_UNIT_SETTINGS = ("angle_unit", "length_unit", "extra_decimals", "theme", "presentation")
_NAMES = (("x", "y", "z"), ("roll", "pitch", "yaw"))


class _Row(NamedTuple):
    """A line of the card: names, numbers, their unit, and the room for the widest usual number [pixels]."""

    names: tuple[str, ...]
    numbers: tuple[str, ...]
    unit: str
    room: int


class ToolCard(QLabel):
    """Position and roll, pitch, yaw of the tool, in the upper left corner of `stage`.

    It paints its numbers itself: rich text takes a millisecond, in every frame.
    """

    def __init__(self, session: Session, preferences: Preferences, stage: QWidget) -> None:
        super().__init__(stage)
        self._session, self._preferences, self._stage = session, preferences, stage
        self._rows: tuple[_Row, ...] = ()
        self.setObjectName("tool_card")
        self.setAccessibleName(tr("Tool pose"))
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.setTextFormat(Qt.TextFormat.PlainText)
        self.setLayoutDirection(Qt.LayoutDirection.LeftToRight)  # numbers behind their names, in any language
        session.changed.connect(self._on_changed)
        preferences.changed.connect(self._on_preference)
        stage.installEventFilter(self)
        self.move(_MARGIN, _MARGIN)
        self._show()

    def _on_changed(self, before: Experiment, after: Experiment) -> None:
        if after.q is not before.q or after.robot is not before.robot:
            self._show()

    def _on_preference(self, name: str) -> None:
        if name in _UNIT_SETTINGS:
            QTimer.singleShot(0, self, self._show)  # when the theme has given the card its font

    def _show(self) -> None:
        robot = self._session.robot
        T = forward_kinematics(robot, self._session.q)
        values = (T[:3, 3], rpy_from_rotation(T[:3, :3]))
        kinds: tuple[Kind, Kind] = (length_kind(robot), "angle")
        self._rows = tuple(self._row(*each) for each in zip(_NAMES, values, kinds, strict=True))
        self._fit()
        self.update()

    def _fit(self) -> None:
        """As large as it wants to be, and smaller in a stage that has no room for it: large letters, a small window."""
        wanted, room = self.sizeHint(), self._stage.width() - 2 * _MARGIN
        if wanted.width() > room > 0:
            wanted = QSize(room, wanted.height() * room // wanted.width())
        if wanted != self.size():
            self.setFixedSize(wanted)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """The stage has another size."""
        if event.type() == QEvent.Type.Resize:
            self._fit()
        return super().eventFilter(watched, event)

    def text(self) -> str:
        """What is read out, for screen readers and for whoever asks."""
        lines = (" ".join(f"{n} {v}" for n, v in zip(row.names, row.numbers, strict=True)) for row in self._rows)
        return "\n".join(f"{line} {row.unit}" for line, row in zip(lines, self._rows, strict=True))

    def _row(self, names: tuple[str, ...], values: FloatArray, kind: Kind) -> _Row:
        shown = display(kind, self._preferences)
        widest = format_number((-math.pi if kind == "angle" else _WIDEST_LENGTH) * shown.factor, shown.decimals)
        if kind == "angle":
            values = np.array([half_turn_up(float(value), shown) for value in values])
        numbers = tuple(format_number(float(value) * shown.factor, shown.decimals) for value in values)
        return _Row(tuple(map(tr, names)), numbers, shown.suffix.strip(), self.fontMetrics().horizontalAdvance(widest))

    def _columns(self) -> tuple[list[int], list[int], int]:
        """How wide the names, the numbers and the unit of each column are [pixels]."""
        width = self.fontMetrics().horizontalAdvance
        names = [max(width(row.names[i]) for row in self._rows) for i in range(3)]
        numbers = [max(max(row.room, width(row.numbers[i])) for row in self._rows) for i in range(3)]
        return names, numbers, max(width(row.unit) for row in self._rows)

    def sizeHint(self) -> QSize:
        """Room for every column; it does not change while the arm moves, unless a number is longer than usual."""
        names, numbers, unit = self._columns()
        width = sum(names) + sum(numbers) + 3 * (_NAME_GAP + _GAP) + unit
        height = len(self._rows) * self.fontMetrics().height()
        return QSize(width + 2 * _PADDING_X, height + 2 * _PADDING_Y)

    def paintEvent(self, _event: QPaintEvent) -> None:
        """The card and its two lines."""
        option = QStyleOption()
        option.initFrom(self)
        painter = QPainter(self)
        painter.setLayoutDirection(Qt.LayoutDirection.LeftToRight)  # it takes that of the application by itself
        self.style().drawPrimitive(QStyle.PrimitiveElement.PE_Widget, option, painter, self)
        scale = self.width() / self.sizeHint().width()
        painter.scale(scale, scale)
        painter.setLayoutDirection(self.layoutDirection())  # a minus before its number
        painter.setPen(self.palette().windowText().color())
        upright, slanted = QFont(self.font()), QFont(self.font())
        slanted.setItalic(True)
        names, numbers, _ = self._columns()
        height = self.fontMetrics().height()
        middle = Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignAbsolute  # or the language decides what is left
        left, right = Qt.AlignmentFlag.AlignLeft | middle, Qt.AlignmentFlag.AlignRight | middle
        for line, row in enumerate(self._rows):
            x, y = _PADDING_X, _PADDING_Y + line * height
            for i, (name, number) in enumerate(zip(row.names, row.numbers, strict=True)):
                painter.setFont(slanted)
                painter.drawText(QRect(x, y, names[i] + _GAP, height), left, name)
                x += names[i] + _NAME_GAP
                painter.setFont(upright)
                painter.drawText(QRect(x, y, numbers[i], height), right, number)
                x += numbers[i] + _GAP
            painter.drawText(QRect(x, y, self.width(), height), left, row.unit)
