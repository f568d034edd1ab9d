"""A row for every joint: its speed, and a bar that compares it with the top speed."""

from __future__ import annotations

import math
from typing import NamedTuple

from PySide6.QtCore import QRectF, QSize, Qt, Signal
from PySide6.QtGui import QBrush, QColor, QPainter, QPaintEvent, QPalette
from PySide6.QtWidgets import QGridLayout, QLabel, QSizePolicy, QWidget

from rvsim.gui.panels.tables import dot
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Kind, display, format_number
from rvsim.gui.quantity_box import QuantityBox
from rvsim.gui.theme import THEMES
from rvsim.gui.widgets import ElidedLabel, silence
from rvsim.language import tr
from rvsim.robot import Datum, Joint, Robot
from rvsim.robot.arrays import FloatArray

_MOST_SHOWN = 999.0  # per cent


class Rated(NamedTuple):
    """What the rows compare with: the kinds of a turning and of a sliding joint, and where the top value stands."""

    prefix: str  # of the boxes' names
    sign: str
    turning: Kind
    sliding: Kind
    limit: str  # the field of `Joint`

    def kind(self, robot: Robot, joint: int) -> Kind:
        """Of a joint's value."""
        if robot.joints[joint].revolute:
            return self.turning
        return self.sliding if robot.length_unit == "millimetre" else _UNITS[self.sliding]

    def top(self, joint: Joint) -> Datum | None:
        """The largest value a joint can have, if it is known."""
        datum: Datum | None = getattr(joint, self.limit)
        return datum


_UNITS: dict[Kind, Kind] = {"length_speed": "unit_speed", "length_acceleration": "unit_acceleration"}
SPEEDS = Rated("joint_speed", "q̇", "angle_speed", "length_speed", "max_speed")
ACCELERATIONS = Rated("joint_acceleration", "q̈", "angle_acceleration", "length_acceleration", "max_acceleration")


class ShareBar(QWidget):
    """How much of the most a joint does; hatched where it is more than the most."""

    def __init__(self, preferences: Preferences) -> None:
        super().__init__()
        self._preferences = preferences
        self._share, self._text, self._short = 0.0, "", ""
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def show_share(self, share: float, text: str, short: str, tip: str) -> None:
        """Show a share 0… of the most, nan: nothing is known; the text is the `short` one where room is short."""
        if (share, text) != (self._share, self._text):
            self._share, self._text, self._short = share, text, short
            self.setToolTip(tip)
            self.setAccessibleName(text)
            self.update()

    @property
    def text(self) -> str:
        """What stands in it."""
        return self._text

    def sizeHint(self) -> QSize:
        """As high as its text."""
        return QSize(90, self.fontMetrics().height() + 4)

    def minimumSizeHint(self) -> QSize:
        """Narrower."""
        return QSize(60, self.sizeHint().height())

    def paintEvent(self, _event: QPaintEvent) -> None:
        """The ground, the bar, the text on both."""
        painter = QPainter(self)
        theme = THEMES[self._preferences["theme"]]
        ground = QRectF(self.rect()).adjusted(0.0, 1.0, 0.0, -1.0)
        painter.fillRect(ground, self.palette().color(QPalette.ColorRole.Mid).lighter(100 if theme.dark else 112))
        over = self._share > 1.0
        color = QColor(theme.error if over else theme.accent)
        color.setAlphaF(0.45)
        if math.isfinite(self._share):
            rest = ground.width() * (1.0 - min(self._share, 1.0))
            ground.adjust(rest * self.isRightToLeft(), 0.0, -rest * self.isLeftToRight(), 0.0)
            painter.fillRect(ground, QBrush(color, Qt.BrushStyle.BDiagPattern) if over else QBrush(color))
        painter.setPen(self.palette().color(QPalette.ColorRole.Text))
        room = self.rect().adjusted(4, 0, -2, 0)
        metrics, text = self.fontMetrics(), self._text
        if metrics.horizontalAdvance(text) > room.width():  # the tooltip says of what
            text = metrics.elidedText(self._short, Qt.TextElideMode.ElideRight, room.width())
        painter.drawText(room, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, text)


class JointRows(QWidget):
    """The rows of an arm; `edited(joint, value)` tells what was typed, in SI."""

    edited = Signal(int, float)

    def __init__(self, rated: Rated, preferences: Preferences) -> None:
        super().__init__()
        self._rated, self._preferences = rated, preferences
        self._robot: Robot | None = None
        self.boxes: list[QuantityBox] = []
        self.bars: list[ShareBar] = []
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setHorizontalSpacing(6)
        self._grid.setVerticalSpacing(3)
        self._grid.setColumnStretch(1, 4)
        self._grid.setColumnStretch(2, 4)
        self._grid.setColumnStretch(3, 4)

    def take_robot(self, robot: Robot) -> None:
        """Rows for another arm."""
        if robot is self._robot:
            return
        self._robot = robot
        for child in self.findChildren(QWidget, options=Qt.FindChildOption.FindDirectChildrenOnly):
            self._grid.removeWidget(child)
            silence(child)
            child.hide()
            child.deleteLater()
        self.boxes, self.bars = [], []
        for index, joint in enumerate(robot.joints):
            self._add_row(index, joint, self._rated.kind(robot, index))

    def _add_row(self, index: int, joint: Joint, kind: Kind) -> None:
        mark, name = QLabel(), ElidedLabel()
        mark.setPixmap(dot(joint.color).pixmap(10, 10))
        name.setText(f"J{index + 1} {tr(joint.name)}" if joint.name != f"J{index + 1}" else joint.name)
        box = QuantityBox(kind, self._preferences, tr("{rate} of J{number}", rate=self._rated.sign, number=index + 1))
        box.setObjectName(f"{self._rated.prefix}_{index + 1}")
        box.setMinimumWidth(60)
        box.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        box.quantity_changed.connect(lambda value, i=index: self.edited.emit(i, value))
        bar = ShareBar(self._preferences)
        widgets: tuple[QWidget, ...] = (mark, name, box, bar)
        for column, widget in enumerate(widgets):
            self._grid.addWidget(widget, index, column)
        self.boxes.append(box)
        self.bars.append(bar)

    def set_editable(self, editable: bool) -> None:
        """Whether the values can be typed."""
        for box in self.boxes:
            box.setReadOnly(not editable)

    def show_values(self, values: FloatArray) -> None:
        """Show SI values (n,), silently."""
        assert self._robot is not None
        for index, value in enumerate(values.tolist()):
            self.boxes[index].set_quantity(value)
            kind = self._rated.kind(self._robot, index)
            self.bars[index].show_share(*self._compared(value, self._rated.top(self._robot.joints[index]), kind))

    def _compared(self, value: float, top: Datum | None, kind: Kind) -> tuple[float, str, str, str]:
        """The share of the top value: in a few signs, in fewer, and in full."""
        if top is None:
            unknown = tr("no top value known")
            return math.nan, unknown, unknown, tr("No source gives one.")
        shown, share = display(kind, self._preferences), abs(value) / top.value
        percent = f"{100.0 * share:.0f} %" if 100.0 * share < _MOST_SHOWN else f"> {_MOST_SHOWN:.0f} %"
        most = format_number(top.value * shown.factor, 0 if shown.factor > 1.0 else 2)
        whole = {"percent": percent, "most": f"{most}{shown.suffix}", "source": tr(top.source)}
        if top.assumed:
            tip = tr("{percent} of {most}, assumed: {source}.", **whole)
        else:
            tip = tr("{percent} of {most}, known: {source}.", **whole)
        return (
            share,
            tr("{percent} of {most}", percent=percent, most=f"{most}{'*' if top.assumed else ''}"),
            percent,
            tip,
        )

    @property
    def assumed(self) -> bool:
        """Whether a top value is assumed."""
        joints = self._robot.joints if self._robot else ()
        return any(datum.assumed for datum in map(self._rated.top, joints) if datum)
