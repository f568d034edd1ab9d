"""Clicks in the scene become places on a working plane; drags still turn the view."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QObject, QPointF, Qt, Signal

from rvsim.experiment import Experiment
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import display, format_number, length_kind
from rvsim.gui.scene_view import Grabber
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.language import tr, tr_later
from rvsim.robot.arrays import FloatArray
from rvsim.scene.primitives import Item
from rvsim.scene.work_plane import WorkPlane, point_items, pointer_items, work_plane_items

LAYER = "point clicks"
_STEP = {"millimetre": 1e-3, "unit": 1e-2}  # [m] a click is rounded to
_COARSE = 10.0  # times that with Ctrl held
_FARTHEST = 3.0  # sizes of the arm from its base
_HALF = 0.35  # of the square that is drawn, in sizes of the arm
_BEGIN = tr_later(
    "Click in the scene: each click adds a point on the plane that is drawn. A drag turns the view, Esc ends."
)
_GO_ON = tr_later("Click the next one; Ctrl+Z takes it back, Esc ends.")
_EDGE_ON = tr_later("Seen from here the working plane is a line, or behind you: turn the view, then click.")
_FAR = tr_later("That is far beyond the arm's reach: turn the view until the working plane is seen more from its side.")


class PointClicks(QObject):
    """While it is on, it stands before whoever else listens to the pointer in the scene.

    Signals:
        switched(on): it has begun or ended.
        picked(point): a click meant this place (3,) [m].
    """

    switched = Signal(bool)
    picked = Signal(object)

    def __init__(self, session: Session, preferences: Preferences, stage: Stage, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session, self._preferences, self._stage = session, preferences, stage
        self._view = stage.view
        self._on = self._tracked = False
        self._behind: Grabber | None = None
        self._plane = WorkPlane(2, 0.0)
        self._points: FloatArray = np.empty((0, 3))
        self._middle: FloatArray = np.zeros(3)
        self._pointer: FloatArray | None = None
        self._view.clicked.connect(self._on_click)
        session.settled.connect(self._on_settled)
        preferences.changed.connect(lambda _: self._show())

    @property
    def on(self) -> bool:
        """Whether clicks are listened to."""
        return self._on

    @property
    def plane(self) -> WorkPlane:
        """Where clicks put points."""
        return self._plane

    def set_plane(self, plane: WorkPlane) -> None:
        """Work on another plane, of which a square about the middle of the points is drawn."""
        self._plane, self._pointer = plane, None
        self._middle = self._points.mean(axis=0) if len(self._points) else np.zeros(3)
        self._show()

    def show_points(self, points: FloatArray) -> None:
        """Show the points (k, 3) that there are, while more are added."""
        self._points = points
        self._show()

    def switch(self, on: bool) -> None:
        """Begin or end."""
        if on == self._on:
            return
        self._on, self._pointer = on, None
        self._view.takes_clicks = on
        if on:
            self._stand_before()
            self._tracked = self._view.hasMouseTracking()
            self._view.setFocus()  # for Esc
        elif self._view.grabber is self:  # else somebody stands before us, and we only pass on
            self._view.grabber = self._behind
        self._view.setMouseTracking(on or self._tracked)
        self._view.unsetCursor()
        self._show()
        if on:
            self._session.say(tr(_BEGIN))
        self.switched.emit(on)

    def _stand_before(self) -> None:
        """Nobody stands in the row twice: it would never end."""
        asked = self._view.grabber
        while asked is not None and asked is not self:
            asked = getattr(asked, "_behind", None)
        if asked is None:
            self._behind, self._view.grabber = self._view.grabber, self

    # --- what the view tells ---------------------------------------------------------------------------------------

    def hover(self, at: QPointF | None) -> None:
        """The pointer is here, or has left."""
        if self._behind is not None:
            self._behind.hover(at)
        if not self._on:
            return
        if self._view.cursor().shape() != Qt.CursorShape.OpenHandCursor:
            self._view.setCursor(Qt.CursorShape.CrossCursor)
        point = None if at is None else self._place(at)
        self._pointer = point if point is not None and self._is_near(point) else None
        self._show()

    def press(self, at: QPointF) -> bool:
        """What lies under the pointer and can be dragged, is dragged."""
        return self._behind is not None and self._behind.press(at)

    def drag(self, at: QPointF, modifiers: Qt.KeyboardModifier) -> None:
        """That is somebody else's."""
        if self._behind is not None:
            self._behind.drag(at, modifiers)

    def release(self) -> None:
        """That is somebody else's."""
        if self._behind is not None:
            self._behind.release()

    def key(self, key: Qt.Key, modifiers: Qt.KeyboardModifier, repeated: bool) -> bool:
        """Esc ends it."""
        if self._on and key == Qt.Key.Key_Escape:
            self.switch(False)
            return True
        return self._behind is not None and self._behind.key(key, modifiers, repeated)

    def _on_click(self, at: QPointF, modifiers: Qt.KeyboardModifier) -> None:
        if not self._on:
            return
        point = self._place(at, bool(modifiers & Qt.KeyboardModifier.ControlModifier))
        if point is None:
            self._session.warn(tr(_EDGE_ON))
        elif not self._is_near(point):
            self._session.warn(tr(_FAR))
        else:
            self._pick(point)

    def _pick(self, point: FloatArray) -> None:
        before = self._session.experiment
        self.picked.emit(point)
        if self._session.experiment is not before:  # else it has been said why not
            self._session.say(f"{tr('Point at {place}.', place=self.text(point))} {tr(_GO_ON)}")

    # --- inside ----------------------------------------------------------------------------------------------------

    def text(self, point: FloatArray) -> str:
        """The numbers of a place as the screen shows them."""
        shown = display(length_kind(self._session.robot), self._preferences)
        numbers = (format_number(float(value) * shown.factor, shown.decimals) for value in point)
        return f"{', '.join(f'{name} {number}' for name, number in zip('xyz', numbers, strict=True))}{shown.suffix}"

    def _place(self, at: QPointF, coarse: bool = False) -> FloatArray | None:
        step = _STEP[self._session.robot.length_unit] * (_COARSE if coarse else 1.0)
        ray = self._view.camera.ray(at.x(), at.y(), self._view.width(), self._view.height())
        return self._plane.meets(ray, step)

    def _is_near(self, point: FloatArray) -> bool:
        robot = self._session.robot
        return float(np.linalg.norm(point - robot.T_base_0[:3, 3])) <= _FARTHEST * robot.size

    def _on_settled(self, before: Experiment, after: Experiment) -> None:
        if after.robot.name != before.robot.name:
            self.switch(False)

    def _show(self) -> None:
        items: tuple[Item, ...] = ()
        if self._on:
            palette = self._stage.palette
            items = work_plane_items(self._plane, self._middle, _HALF * self._session.robot.size, palette)
            items += point_items(self._points, palette)
            if self._pointer is not None:
                items += pointer_items(self._pointer, self.text(self._pointer), palette)
        self._stage.set_layer(LAYER, items)
