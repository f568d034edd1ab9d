"""Points by clicks in the scene: the switch, and the plane that they are put on."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QHBoxLayout, QVBoxLayout, QWidget

from rvsim.gui.point_clicks import PointClicks
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import length_kind
from rvsim.gui.quantity_box import QuantityBox
from rvsim.gui.widgets import button, combo, select
from rvsim.language import tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.scene.work_plane import WorkPlane

_PLANES = {
    2: (tr_later("Level, z"), tr_later("A level plane at this height above the base")),
    0: (tr_later("Upright facing, x"), tr_later("An upright plane that faces the arm, so far before the base")),
    1: (tr_later("Upright sideways, y"), tr_later("An upright plane straight ahead, so far beside the base")),
}


class ClickRows(QWidget):
    """A button that stays down while clicks add points, and below it the working plane.

    Signals:
        picked(point): a click meant this place (3,) [m].
        refused(sentence): why something typed was not taken.
    """

    picked = Signal(object)
    refused = Signal(str)

    def __init__(self, robot: Robot, preferences: Preferences, clicks: PointClicks) -> None:
        super().__init__()
        self._clicks = clicks
        self._near: FloatArray = np.zeros(3)  # the place of the chosen point
        self.button = button(
            "points_click",
            tr("Click points in the scene"),
            tr("Each click in the scene adds a point on the plane below; a drag still turns the view. Esc ends it."),
            self._switch,
        )
        self.button.setCheckable(True)
        self.choice = combo("points_plane", tr("The plane that clicks put points on"), {})
        for index, (axis, (title, tip)) in enumerate(_PLANES.items()):
            self.choice.addItem(tr(title), axis)
            self.choice.setItemData(index, tr(tip), Qt.ItemDataRole.ToolTipRole)
        self.choice.activated.connect(lambda _: self._on_axis(self.choice.currentData()))
        self.offset = QuantityBox(length_kind(robot), preferences, tr("Where the working plane lies"))
        self.offset.setObjectName("points_offset")
        self.offset.quantity_changed.connect(lambda value: self._lay(WorkPlane(self._clicks.plane.axis, value)))
        self.offset.refused.connect(self.refused)
        self._lay_out()
        clicks.switched.connect(self._show_switched)
        clicks.picked.connect(self.picked)

    def _lay_out(self) -> None:
        self._plane_row = QWidget()
        row = QHBoxLayout(self._plane_row)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(self.choice, 4)
        row.addWidget(self.offset, 3)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(4)
        column.addWidget(self.button)
        column.addWidget(self._plane_row)
        self._plane_row.hide()

    def show_points(self, points: FloatArray, chosen: int) -> None:
        """The points (k, 3) that there are; a plane that is chosen goes through that one at first."""
        self._near = points[chosen]
        self._clicks.show_points(points)

    def _switch(self) -> None:
        on = self.button.isChecked()
        if on:
            self._lay(WorkPlane(2, float(self._near[2])))
        self._clicks.switch(on)

    def _show_switched(self, on: bool) -> None:
        self.button.setChecked(on)
        self._plane_row.setVisible(on)

    def _on_axis(self, axis: int) -> None:
        self._lay(WorkPlane(axis, float(self._near[axis])))

    def _lay(self, plane: WorkPlane) -> None:
        select(self.choice, plane.axis)
        self.offset.set_quantity(plane.offset)
        self._clicks.set_plane(plane)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Esc ends the clicks."""
        if event.key() == Qt.Key.Key_Escape and self._clicks.on:
            self._clicks.switch(False)
        else:
            super().keyPressEvent(event)
