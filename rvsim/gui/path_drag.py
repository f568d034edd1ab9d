"""Moves, turns and scales the path with the hand: a gizmo at its middle; a drag is one step of undo."""

from __future__ import annotations

import math
from dataclasses import replace

from PySide6.QtCore import QObject, QPointF, Qt, Signal

from rvsim.errors import RvsimError
from rvsim.experiment import Experiment, Placement
from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import format_quantity, length_kind
from rvsim.gui.scene_view import Grabber
from rvsim.gui.session import Session
from rvsim.gui.stage import Stage
from rvsim.lab.shape_paths import placed_task, placement_of
from rvsim.language import tr
from rvsim.robot.arrays import FloatArray
from rvsim.scene import Ray
from rvsim.scene.gizmo import GIZMO_KEY, Gizmo, Grip, Handle, dragged, gizmo_at, gizmo_items, handle_under, take_hold
from rvsim.scene.primitives import Item
from rvsim.spatial import rotation_from_rpy, rpy_from_rotation, transform

LAYER = "path gizmo"
SIZE = "size"  # the arrow along the diagonal, which scales
_SNAP_ANGLE = math.radians(5.0)
_SNAP_SCALE = 0.1
_SNAP = {"millimetre": 1e-2, "unit": 0.1}  # [m] with Ctrl held
_SMALLEST = 1e-3


def path_handles(R: FloatArray) -> tuple[Handle, ...]:
    """Rings about the plane's axes R (3, 3), a square and arrows along them, and one arrow for the size."""
    rings = [Handle("ring", name, R[:, axis], axis) for axis, name in enumerate("xyz")]
    arrows = [Handle("axis", name, R[:, axis], axis) for axis, name in enumerate("xyz")]
    plane = Handle("plane", "xy", R[:, 2], 2)
    diagonal = Handle("axis", SIZE, -(R[:, 0] + R[:, 1]) / math.sqrt(2.0))
    return (*rings, plane, *arrows, diagonal, Handle("free", "free", R[:, 2]))


class PathDrag(QObject):
    """Stands before whoever else listens to the pointer in the scene, while it is on.

    Signals:
        switched(on): the gizmo has come or gone.
    """

    switched = Signal(bool)

    def __init__(self, session: Session, preferences: Preferences, stage: Stage, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session, self._preferences, self._stage = session, preferences, stage
        self._view = stage.view
        self._on = self._tracked = False
        self._behind: Grabber | None = None
        self._grip: Grip | None = None
        self._held_size = 1.0  # the gizmo's, when it was taken hold of
        self._began: tuple[Experiment, Placement] | None = None
        self._amount, self._lit = 0.0, ""
        self._view.camera_changed.connect(lambda _: self._show())
        session.settled.connect(self._on_settled)
        preferences.changed.connect(lambda name: self._show() if name == "theme" else None)

    @property
    def on(self) -> bool:
        """Whether the gizmo is there."""
        return self._on

    def switch(self, on: bool) -> None:
        """Show the gizmo, or take it away."""
        if on == self._on:
            return
        self.release()
        self._on, self._lit = on, ""
        if on:
            self._behind, self._tracked = self._view.grabber, self._view.hasMouseTracking()
            self._view.grabber = self
            self._view.setMouseTracking(True)
        else:
            self._view.setMouseTracking(self._tracked)
            self._view.unsetCursor()
            if self._view.grabber is self:  # else somebody stands before us, and we only pass on
                self._view.grabber = self._behind
        self._show()
        self.switched.emit(on)

    # --- what the view tells ---------------------------------------------------------------------------------------

    def hover(self, at: QPointF | None) -> None:
        """The pointer is here, or has left."""
        handle = self._under(at) if at is not None else None
        lit = handle.key if handle is not None else ""
        if lit != self._lit:
            self._lit = lit
            self._view.setCursor(Qt.CursorShape.OpenHandCursor if lit else Qt.CursorShape.ArrowCursor)
            self._show()
        if self._behind is not None:
            self._behind.hover(None if lit else at)

    def press(self, at: QPointF) -> bool:
        """Take hold of what is under the pointer, or let the next one try."""
        gizmo, handle = self._gizmo(), self._under(at)
        if gizmo is None or handle is None:
            return self._behind is not None and self._behind.press(at)
        self._grip = take_hold(gizmo, handle, self._ray(at))
        if self._grip is None:
            return False
        experiment = self._session.experiment
        self._began = experiment, placement_of(experiment.robot, experiment.trajectory)
        self._amount, self._lit, self._held_size = 0.0, handle.key, gizmo.size
        self._session.end_stroke()
        self._view.setCursor(Qt.CursorShape.ClosedHandCursor)
        self._show()
        return True

    def drag(self, at: QPointF, modifiers: Qt.KeyboardModifier) -> None:
        """The pointer has moved with a handle held; with Ctrl in round steps."""
        if self._grip is None or self._began is None:
            if self._behind is not None:
                self._behind.drag(at, modifiers)
            return
        snap = self._snap(self._grip.handle) if modifiers & Qt.KeyboardModifier.ControlModifier else 0.0
        where = dragged(self._grip, self._ray(at), self._amount, snap)
        if where is None:
            return
        self._amount = where.amount
        self._put(self._placement(where.T, self._began[1]))

    def release(self) -> None:
        """Let go."""
        if self._grip is None:
            if self._behind is not None and self._on:
                self._behind.release()
            return
        self._let_go()
        self._session.end_stroke()

    def key(self, key: Qt.Key, modifiers: Qt.KeyboardModifier, repeated: bool) -> bool:
        """Esc gives the drag up."""
        if self._grip is not None and key == Qt.Key.Key_Escape and self._began is not None:
            self._put(None)
            self._let_go()
            self._session.end_stroke()
            return True
        return self._behind is not None and self._behind.key(key, modifiers, repeated)

    # --- inside ----------------------------------------------------------------------------------------------------

    def _let_go(self) -> None:
        self._grip, self._began, self._lit = None, None, ""
        self._view.unsetCursor()
        self._show()

    def _snap(self, handle: Handle) -> float:
        if handle.kind == "ring":
            return _SNAP_ANGLE
        return _SNAP_SCALE * self._held_size if handle.name == SIZE else _SNAP[self._session.robot.length_unit]

    def _placement(self, T: FloatArray, began: Placement) -> Placement:
        """Where a held handle has brought it from where it began."""
        assert self._grip is not None
        if self._grip.handle.name == SIZE:
            return replace(began, scale=max(began.scale * math.exp(self._amount / self._held_size), _SMALLEST))
        return Placement(T[:3, 3], rpy_from_rotation(T[:3, :3]), began.scale)

    def _put(self, placement: Placement | None) -> None:
        """Lay it there; None to lay it where it was before the drag."""
        assert self._began is not None
        if self._session.robot is not self._began[0].robot:
            return  # what is held was the path of another arm
        task = self._began[0].trajectory
        moved = task if placement is None else placed_task(self._session.robot, task, placement)
        self._session.edit(
            tr("Move the path"), replace(self._session.experiment, trajectory=moved), merge="drag the path"
        )

    def _on_settled(self, before: Experiment, after: Experiment) -> None:
        if after.trajectory is not before.trajectory or after.robot is not before.robot:
            self._show()

    def _show(self) -> None:
        gizmo = self._gizmo()
        items: tuple[Item, ...] = ()
        if gizmo is not None:
            # The arrow of the size has none of the axes' colours for a guide line: it stays among the others.
            held = self._grip.handle.key if self._grip is not None and self._grip.handle.name != SIZE else ""
            drawn = gizmo_items(gizmo, self._stage.palette, self._lit, held, self._note())
            # The target may have a gizmo too: no two items of a scene have the same key.
            items = tuple(replace(item, key=f"{GIZMO_KEY}.path{item.key.removeprefix(GIZMO_KEY)}") for item in drawn)
        self._stage.set_layer(LAYER, items)

    def _note(self) -> str:
        """How far it has gone."""
        if self._grip is None:
            return ""
        if self._grip.handle.name == SIZE:
            return f"× {math.exp(self._amount / self._held_size):.2f}"
        kind = "angle" if self._grip.handle.kind == "ring" else length_kind(self._session.robot)
        return format_quantity(self._amount, kind, self._preferences)

    def _gizmo(self) -> Gizmo | None:
        """At the path's middle, along its axes; None while it is off, or where there is no path."""
        if not self._on:
            return None
        try:
            where = placement_of(self._session.robot, self._session.experiment.trajectory)
        except (RvsimError, OSError):
            return None
        R = rotation_from_rpy(where.rpy)
        return gizmo_at(transform(R, where.center), path_handles(R), self._view.camera, self._view.height())

    def _under(self, at: QPointF) -> Handle | None:
        gizmo = self._gizmo()
        size = self._view.width(), self._view.height()
        return None if gizmo is None else handle_under(gizmo, self._view.camera, at.x(), at.y(), *size)

    def _ray(self, at: QPointF) -> Ray:
        return self._view.camera.ray(at.x(), at.y(), self._view.width(), self._view.height())
