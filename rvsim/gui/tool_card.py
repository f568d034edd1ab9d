"""The small card in the corner of the scene: where the tool is, readable while the eyes are on the arm."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel, QWidget

from rvsim.experiment import Experiment
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Kind, display, format_number, length_kind
from rvsim.gui.session import Session
from rvsim.kinematics import forward_kinematics
from rvsim.robot.arrays import FloatArray
from rvsim.spatial import rpy_from_rotation

_MARGIN = 12
_UNIT_SETTINGS = ("angle_unit", "length_unit", "extra_decimals", "theme", "presentation")


class ToolCard(QLabel):
    """Position and roll, pitch, yaw of the tool, in the upper left corner of `stage`."""

    def __init__(self, session: Session, preferences: Preferences, stage: QWidget) -> None:
        super().__init__(stage)
        self._session, self._preferences = session, preferences
        self.setObjectName("tool_card")
        self.setAccessibleName("Tool pose")
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.setTextFormat(Qt.TextFormat.RichText)
        session.changed.connect(self._on_changed)
        preferences.changed.connect(self._on_preference)
        self.move(_MARGIN, _MARGIN)
        self._show()

    def _on_changed(self, before: Experiment, after: Experiment) -> None:
        if after.q is not before.q or after.robot is not before.robot:
            self._show()

    def _on_preference(self, name: str) -> None:
        if name in _UNIT_SETTINGS:
            self._show()

    def _show(self) -> None:
        robot = self._session.robot
        T = forward_kinematics(robot, self._session.q)
        lengths = self._row(("x", "y", "z"), T[:3, 3], length_kind(robot))
        angles = self._row(("roll", "pitch", "yaw"), rpy_from_rotation(T[:3, :3]), "angle")
        self.setText(f"<table cellspacing=0>{lengths}{angles}</table>")
        self.adjustSize()

    def _row(self, names: tuple[str, ...], values: FloatArray, kind: Kind) -> str:
        shown = display(kind, self._preferences)
        cells = "".join(
            f"<td style='padding-right:4px'><i>{name}</i></td>"
            f"<td align=right style='padding-right:14px'>{format_number(value * shown.factor, shown.decimals)}</td>"
            for name, value in zip(names, values, strict=True)
        )
        return f"<tr>{cells}<td>{shown.suffix.strip()}</td></tr>"
