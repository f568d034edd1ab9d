"""The plane that a shape lies in: named ones a click each, angles, a normal, or three points."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QGridLayout, QLabel, QVBoxLayout, QWidget

from rvsim.errors import RvsimError
from rvsim.experiment import Experiment, Placement, TrajectoryTask
from rvsim.gui.panels.number_row import NumberRow
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Kind, length_kind
from rvsim.gui.session import Session
from rvsim.gui.theme import set_role
from rvsim.gui.widgets import button, combo, select, silence
from rvsim.kinematics import forward_kinematics
from rvsim.lab.planes import PLANES, laid, plane_name, three_points, through_three, with_normal
from rvsim.lab.shape_paths import is_flat, level_yaw, placed_task, placement_of
from rvsim.language import tr, tr_later
from rvsim.robot.arrays import FloatArray
from rvsim.spatial import rotation_from_rpy

TILTED, NORMAL, THREE = "tilted", "normal", "points"
_CHOICES = {
    **{name: plane.title for name, plane in PLANES.items()},
    TILTED: tr_later("Tilted (angles)"),
    NORMAL: tr_later("Square to a normal"),
    THREE: tr_later("Through three points"),
}
_TYPED = ("points", "arc-through")  # their points lie where they were typed
_TRIANGLE = 0.15  # the side of the points that are offered, in sizes of the arm
_ON_A_LINE = tr_later("These three points lie on a line: no plane goes through them alone. Move one aside.")
_TOOL_KEEPS = tr_later(
    "The tool stays as it was turned: for a pen square to the plane choose “Normal to the plane” under Tool."
)
_FEWEST_TO_TURN = 4  # joints
_SAME = 1e-6
_CORNERS = (  # what a point is called, and what its button does
    (tr_later("First point"), tr_later("The first point is where the tool is now: drive the arm there")),
    (tr_later("Second point"), tr_later("The second point is where the tool is now: drive the arm there")),
    (tr_later("Third point"), tr_later("The third point is where the tool is now: drive the arm there")),
)
_NO_NORMAL = tr_later("A normal needs a length: one of its three numbers must not be 0.")


class _Corner(QWidget):
    """One of three points: its boxes, and a button that takes the place where the tool is.

    Signals:
        taken(): it is to be where the tool is.
    """

    taken = Signal()

    def __init__(self, number: int, kind: Kind, preferences: Preferences) -> None:
        super().__init__()
        title, tip = map(tr, _CORNERS[number])
        self.row = NumberRow(f"plane_point_{number + 1}", ("x", "y", "z"), (kind,) * 3, preferences, title)
        self.take = button(f"plane_take_{number + 1}", tr("Tool"), tip, self.taken.emit)
        self.take.setProperty("compact", True)
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(6)
        label = QLabel(f"{number + 1}")
        label.setToolTip(title)
        set_role(label, role="muted")
        grid.addWidget(label, 1, 0)
        grid.addWidget(self.row, 0, 1, 2, 1)
        grid.addWidget(self.take, 1, 2)
        grid.setColumnStretch(1, 1)


class PlaneRows(QWidget):
    """The choice, and below it the numbers that some planes need; those of three points stand in `corners`.

    Signals:
        edited(task, merge, text): the trajectory is wanted there; edits of the same `merge` in a row are one.
    """

    edited = Signal(object, str, str)

    def __init__(self, session: Session, preferences: Preferences) -> None:
        super().__init__()
        self._session, self._preferences = session, preferences
        self._task: TrajectoryTask | None = None
        self._where: Placement | None = None
        self._by_hand = ""  # how the plane is given, where the student has said so
        self._points: FloatArray | None = None
        self._unit: Kind | None = None
        self._robot_name = ""
        self._corners: list[_Corner] = []
        self.choice = combo("path_plane", tr("The plane that the shape lies in"), _CHOICES)
        for index, plane in enumerate(PLANES.values()):
            self.choice.setItemData(index, tr(plane.tip), Qt.ItemDataRole.ToolTipRole)
        self.choice.activated.connect(lambda _: self._on_choice(self.choice.currentData()))
        self.turn = NumberRow("path_turn", ("roll", "pitch", "yaw"), ("angle",) * 3, preferences, tr("Path turned by"))
        self.normal = NumberRow("path_normal", ("x", "y", "z"), ("number",) * 3, preferences, tr("Normal of the plane"))
        self.turn.edited.connect(lambda _: self._on_turn())
        self.normal.edited.connect(lambda _: self._on_normal())
        for row in (self.turn, self.normal):
            row.refused.connect(session.warn)
            row.finished.connect(session.end_stroke)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(4)
        for widget in (self.choice, self.turn, self.normal):
            column.addWidget(widget)
        self.corners = QWidget()  # for the whole width of the panel
        below = QVBoxLayout(self.corners)
        below.setContentsMargins(0, 0, 0, 0)
        below.setSpacing(4)

    @property
    def label(self) -> str:
        """What stands before it; nothing where there is nothing to choose."""
        if self._task is None or self._task.name in _TYPED:
            return ""
        return tr("Plane") if is_flat(self._task) else tr("Turned")

    # --- showing ---------------------------------------------------------------------------------------------------

    def show_task(self, experiment: Experiment) -> None:
        """Show how the experiment's trajectory lies."""
        robot, task = experiment.robot, experiment.trajectory
        if self._task is None or task.name != self._task.name or robot.name != self._robot_name:
            self._by_hand = ""
        self._task, self._robot_name = task, robot.name
        try:
            self._where = placement_of(robot, task)
        except (RvsimError, OSError):
            self._where = None
        self.setEnabled(self._where is not None)
        if self._where is not None:
            self._show(self._where, is_flat(task))

    def _show(self, where: Placement, flat: bool) -> None:
        R = rotation_from_rpy(where.rpy)
        shown = self._by_hand or plane_name(where.center, R) or TILTED
        select(self.choice, shown)
        self.choice.setVisible(flat)
        self.turn.setVisible(not flat or shown == TILTED)
        self.normal.setVisible(flat and shown == NORMAL)
        self.turn.show_values(where.rpy)
        self._show_normal(R[:, 2])
        if flat and shown == THREE:
            self._show_corners(where, R)
        self.corners.setVisible(flat and shown == THREE)

    def _show_normal(self, normal: FloatArray) -> None:
        """A typed normal keeps its length."""
        typed = self.normal.values
        if float(np.linalg.norm(np.cross(typed, normal))) > _SAME or float(typed @ normal) <= 0.0:
            self.normal.show_values(np.round(normal, 9) + 0.0)

    def _show_corners(self, where: Placement, R: FloatArray) -> None:
        """The points that were given, as long as the plane goes through them; else an even triangle on it."""
        self._make_corners()
        given = None if self._points is None else through_three(where, self._points)
        if self._points is None or given is None or not _same_plane(given, where):
            self._points = np.round(three_points(where, R, _TRIANGLE * self._session.robot.size), 6)
        for corner, point in zip(self._corners, self._points, strict=True):
            corner.row.show_values(point)

    def _make_corners(self) -> None:
        """Boxes in the arm's unit of length, when they are needed first."""
        kind = length_kind(self._session.robot)
        if self._corners and self._unit == kind:
            return
        for corner in self._corners:
            silence(corner)
            corner.setParent(None)
            corner.deleteLater()
        self._unit, self._points = kind, None
        layout = self.corners.layout()
        assert layout is not None
        self._corners = [_Corner(number, kind, self._preferences) for number in range(3)]
        for number, corner in enumerate(self._corners):
            corner.row.edited.connect(partial(self._on_corner, number))
            corner.row.refused.connect(self._session.warn)
            corner.row.finished.connect(self._session.end_stroke)
            corner.taken.connect(partial(self._take, number))
            layout.addWidget(corner)

    # --- edits -----------------------------------------------------------------------------------------------------

    def _on_choice(self, name: str) -> None:
        if self._where is None or self._task is None:
            return
        self._points = None
        self._by_hand = "" if name in PLANES else name
        if name not in PLANES:
            self._show(self._where, True)
            return
        title = tr(PLANES[name].title)
        self._lay(laid(self._where, name, level_yaw(self._task.name, self._where.center)), "", title)
        if name != "level" and self._task.orientation == "source" and self._session.robot.dof >= _FEWEST_TO_TURN:
            self._session.say(f"{title}. {tr(_TOOL_KEEPS)}")

    def _on_turn(self) -> None:
        if self._where is not None:
            self._lay(replace(self._where, rpy=self.turn.values), "path turn")

    def _on_normal(self) -> None:
        if self._where is None:
            return
        self._lay_or_say(with_normal(self._where, self.normal.values), "path normal", tr(_NO_NORMAL))

    def _on_corner(self, number: int, _box: int) -> None:
        self._put_point(number, self._corners[number].row.values, f"plane point {number}")

    def _take(self, number: int) -> None:
        """A point is where the tool is."""
        self._put_point(number, forward_kinematics(self._session.robot, self._session.q)[:3, 3], "")

    def _put_point(self, number: int, point: FloatArray, merge: str) -> None:
        if self._where is None or self._points is None:
            return
        self._points = self._points.copy()
        self._points[number] = point
        self._corners[number].row.show_values(point)
        self._lay_or_say(through_three(self._where, self._points), merge, tr(_ON_A_LINE))

    def _lay_or_say(self, where: Placement | None, merge: str, why_not: str) -> None:
        if where is None:
            self._session.warn(why_not)
        else:
            self._lay(where, merge)

    def _lay(self, where: Placement, merge: str, text: str = "") -> None:
        assert self._task is not None
        task = placed_task(self._session.robot, self._task, where)
        self.edited.emit(task, merge, text or tr("Turn the plane"))


def _same_plane(a: Placement, b: Placement) -> bool:
    same = np.allclose(rotation_from_rpy(a.rpy), rotation_from_rpy(b.rpy), rtol=0.0, atol=_SAME)
    return bool(same and np.allclose(a.center, b.center, rtol=0.0, atol=_SAME))
