"""Where the path lies: its middle, how large it is, and whether it can be dragged in the scene."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QVBoxLayout, QWidget

from rvsim.errors import RvsimError
from rvsim.experiment import Experiment, Placement, TrajectoryTask
from rvsim.gui.panels.number_row import NumberRow
from rvsim.gui.path_drag import PathDrag
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import length_kind
from rvsim.gui.quantity_box import QuantityBox
from rvsim.gui.session import Session
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import button, silence
from rvsim.lab.shape_paths import placed_task, placement_of
from rvsim.language import tr

# Their points are moved themselves: there is no turn or size to show.
_TABLES = ("points", "arc-through")


class PlaceRows(QWidget):
    """The placement as numbers.

    Signals:
        edited(task, merge): the trajectory is wanted there.
    """

    edited = Signal(object, str)

    def __init__(self, session: Session, preferences: Preferences, drag: PathDrag | None) -> None:
        super().__init__()
        self._session, self._preferences, self._drag = session, preferences, drag
        self._task: TrajectoryTask | None = None
        self._where: Placement | None = None
        self.center: NumberRow | None = None
        self.scale = QuantityBox("number", preferences, tr("How many times as large"))
        self.scale.setObjectName("path_scale")
        self.scale.set_range(1e-3, 1e3, tr("A path can be a thousandth to a thousand times as large."))
        self.reset = button(
            "path_place_reset", tr("As it was"), tr("Back to where it is without having been moved"), self._reset
        )
        self.drag = button(
            "path_move_button",
            tr("Move in the scene"),
            tr("Drag, turn and scale it by a gizmo at its middle"),
            self._switch,
        )
        self.drag.setCheckable(True)
        self.drag.setEnabled(drag is not None)
        self._size_label = QLabel(tr("size ×"))
        set_role(self._size_label, role="muted")
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        self._column.setSpacing(4)
        size = QHBoxLayout()
        for widget in (self._size_label, self.scale, self.reset):
            size.addWidget(widget)
        self._column.addLayout(size)
        self._column.addWidget(self.drag)
        self.scale.quantity_changed.connect(lambda value: self._edit("path scale", scale=value))
        self.scale.refused.connect(session.warn)
        self.scale.editingFinished.connect(session.end_stroke)
        if drag is not None:
            drag.switched.connect(self.drag.setChecked)

    def show_task(self, experiment: Experiment) -> None:
        """Show where the experiment's trajectory lies."""
        self._make_center(experiment)
        self._task = experiment.trajectory
        try:
            self._where = placement_of(experiment.robot, self._task)
        except (RvsimError, OSError):
            self._where = None
        for widget in (self.center, self.scale, self.reset):
            assert widget is not None
            widget.setEnabled(self._where is not None)
        if self._where is None or self.center is None:
            return
        self.center.show_values(self._where.center)
        self.scale.set_quantity(self._where.scale)
        self.reset.setEnabled(self._task.placement is not None)
        typed = self._task.name in _TABLES
        for shown in (self.scale, self._size_label, self.reset):
            shown.setVisible(not typed)

    def _make_center(self, experiment: Experiment) -> None:
        """Boxes in the arm's unit of length."""
        kind = length_kind(experiment.robot)
        if self.center is not None and self.center.property("kind") == kind:
            return
        if self.center is not None:
            silence(self.center)
            self.center.setParent(None)
            self.center.deleteLater()
        self.center = NumberRow("path_center", ("x", "y", "z"), (kind,) * 3, self._preferences, tr("Path middle"))
        self.center.setProperty("kind", kind)
        center = self.center
        center.edited.connect(lambda _: self._edit("path center", center=center.values))
        self.center.refused.connect(self._session.warn)
        self.center.finished.connect(self._session.end_stroke)
        self._column.insertWidget(0, self.center)

    def _edit(self, merge: str, **changes: Any) -> None:
        if self._where is not None and self._task is not None:
            placement = replace(self._where, **changes)
            self.edited.emit(placed_task(self._session.robot, self._task, placement), merge)

    def _reset(self) -> None:
        if self._task is not None:
            self.edited.emit(replace(self._task, placement=None), "")

    def _switch(self) -> None:
        if self._drag is not None:
            self._drag.switch(self.drag.isChecked())
