"""The small card in the corner of the scene: where the tool is, readable while the eyes are on the arm."""

from __future__ import annotations

import math
import re

import numpy as np
from PySide6.QtCore import QEvent, Qt, QTimer
from PySide6.QtWidgets import QLabel, QWidget

from rvsim.experiment import Experiment
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Kind, display, format_number, half_turn_up, length_kind
from rvsim.gui.session import Session
from rvsim.kinematics import forward_kinematics
from rvsim.robot.arrays import FloatArray
from rvsim.spatial import rpy_from_rotation

_MARGIN = 12
_GAP = 14  # [pixels] between a number and the next name; a cell's width contains it
_NUMBERS = re.compile(r"−?\d{1,4}")
_WIDEST_LENGTH = -8.888  # [m]
_UNIT_SETTINGS = ("angle_unit", "length_unit", "extra_decimals", "theme", "presentation")


class ToolCard(QLabel):
    """Position and roll, pitch, yaw of the tool, in the upper left corner of `stage`."""

    def __init__(self, session: Session, preferences: Preferences, stage: QWidget) -> None:
        super().__init__(stage)
        self._session, self._preferences = session, preferences
        self._outline = ""
        self.setObjectName("tool_card")
        self.setAccessibleName("Tool pose")
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.setTextFormat(Qt.TextFormat.RichText)
        session.changed.connect(self._on_changed)
        preferences.changed.connect(self._on_preference)
        self.move(_MARGIN, _MARGIN)
        self._show()

    def event(self, event: QEvent) -> bool:
        """Without the text's own belated update: it would have the scene below painted a second time."""
        return event.type() == QEvent.Type.UpdateLater or super().event(event)

    def _on_changed(self, before: Experiment, after: Experiment) -> None:
        if after.q is not before.q or after.robot is not before.robot:
            self._show()

    def _on_preference(self, name: str) -> None:
        if name in _UNIT_SETTINGS:
            self._outline = ""
            QTimer.singleShot(0, self, self._show)  # when the theme has given the card its font

    def _show(self) -> None:
        robot = self._session.robot
        T = forward_kinematics(robot, self._session.q)
        lengths = self._row(("x", "y", "z"), T[:3, 3], length_kind(robot))
        angles = self._row(("roll", "pitch", "yaw"), rpy_from_rotation(T[:3, :3]), "angle")
        text = f"<table cellspacing=0>{lengths}{angles}</table>"
        self.setText(text)
        # A label of a fixed size never makes the window lay itself out anew, and measuring takes a millisecond: only a
        # number that is too long for its column makes the card wider.
        outline = _NUMBERS.sub("0", text)
        if outline != self._outline:
            self._outline = outline
            self.setFixedSize(self.sizeHint())

    def _row(self, names: tuple[str, ...], values: FloatArray, kind: Kind) -> str:
        shown = display(kind, self._preferences)
        widest = format_number((-math.pi if kind == "angle" else _WIDEST_LENGTH) * shown.factor, shown.decimals)
        width = self.fontMetrics().horizontalAdvance(widest) + _GAP
        if kind == "angle":
            values = np.array([half_turn_up(float(value), shown) for value in values])
        cells = "".join(
            f"<td style='padding-right:4px'><i>{name}</i></td>"
            f"<td align=right width={width} style='padding-right:{_GAP}px'>"
            f"{format_number(value * shown.factor, shown.decimals)}</td>"
            for name, value in zip(names, values, strict=True)
        )
        return f"<tr>{cells}<td>{shown.suffix.strip()}</td></tr>"
