"""The hand on the gizmo: pointer and arrow keys become wishes for another target; a drag is one step of undo."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from PySide6.QtCore import QObject, QPointF, Qt, Signal

from rvsim.gui.preferences import Preferences
from rvsim.gui.quantities import Kind, format_quantity, length_kind
from rvsim.gui.scene_view import SceneView
from rvsim.gui.stage import Stage
from rvsim.gui.target import TargetControl, Wish
from rvsim.gui.target_solution import CLOSED_FORM
from rvsim.kinematics import link_transforms
from rvsim.language import tr
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.scene import Ray
from rvsim.scene.gizmo import Gizmo, Grip, Handle, dragged, gizmo_at, gizmo_items, handle_under, moved, take_hold
from rvsim.scene.points import joint_axes
from rvsim.scene.primitives import Item

GIZMO = "gizmo"  # this watcher's name
_AXES = "xyz"
_PLANES = ("yz", "xz", "xy")
_SNAP_ANGLE = math.radians(5.0)
_NUDGE = {Qt.KeyboardModifier.ShiftModifier: 10.0, Qt.KeyboardModifier.ControlModifier: 0.1}
_STEP = {"millimetre": 1e-3, "unit": 1e-2}  # [m] of an arrow key
_ARROWS = {
    Qt.Key.Key_Left: (-1.0, 0.0), Qt.Key.Key_Right: (1.0, 0.0), Qt.Key.Key_Up: (0.0, 1.0), Qt.Key.Key_Down: (0.0, -1.0),
}  # fmt: skip
_LIFTS = {Qt.Key.Key_PageUp: 1.0, Qt.Key.Key_PageDown: -1.0}


class Freedom(NamedTuple):
    """What a drag may do: the axes the tool can be moved along, the rings by (name, joint), the task to solve."""

    axes: str
    rings: tuple[tuple[str, int], ...]  # turned about that joint's axis; joint −1 is an axis of the base
    task: str


def freedom_of(robot: Robot, task: str, solver: str) -> Freedom:
    """The handles that this arm can follow when that is asked of it."""
    if task == "x,y":
        return Freedom("xy", (), task)
    if task.startswith("position") and task not in ("position+pitch+roll", "position+yaw"):
        return Freedom("xyz", (), task)
    if task == "position+yaw":
        return Freedom("xyz", (("z", -1),), task)
    if robot.dof >= 6:
        return Freedom("xyz", tuple((axis, -1) for axis in _AXES), task)
    if robot.dof == 5 and solver == CLOSED_FORM:
        # The waist gives the yaw: free are the pitch about the wrist's axis and the roll about the tool's.
        return Freedom("xyz", (("pitch", 3), ("roll", 4)), "position+pitch+roll")
    return Freedom("xyz", (), "position")


def handles_of(freedom: Freedom, axes: FloatArray, own: FloatArray | None = None) -> tuple[Handle, ...]:
    """The handles for a freedom; `axes` (n, 3) are those of the joints, base coordinates.

    Where the tool can go anywhere, arrows and squares may lie along the columns of `own` (3, 3), its own axes, and so
    may the rings of an arm that can turn it anyhow. Others lie along the base's.
    """
    base = np.eye(3)
    along = own.T if own is not None and freedom.axes == _AXES else base
    about = along if len(freedom.rings) == len(_AXES) else base
    arrows = [Handle("axis", axis, along[_AXES.index(axis)], _AXES.index(axis)) for axis in freedom.axes]
    planes = [
        Handle("plane", plane, along[normal], normal)
        for normal, plane in enumerate(_PLANES)
        if set(plane) <= set(freedom.axes)
    ]
    rings = [
        Handle("ring", name, about[_AXES.index(name)], _AXES.index(name))
        if joint < 0
        else Handle("ring", name, axes[joint], 1 if name == "pitch" else 2)
        for name, joint in freedom.rings
    ]
    free = [Handle("free", "free", base[2])] if freedom.axes == _AXES else []
    return (*rings, *planes, *arrows, *free)


class GizmoDrag(QObject):
    """Shows the gizmo while it is on, and turns what the hand does with it into wishes.

    Signals:
        switched(on): the gizmo has come or gone.
        axes_switched(on): its axes are the tool's own, or the base's again.
    """

    switched = Signal(bool)
    axes_switched = Signal(bool)

    def __init__(self, control: TargetControl, view: SceneView, stage: Stage, preferences: Preferences) -> None:
        super().__init__(view)
        self._control, self._view, self._stage, self._preferences = control, view, stage, preferences
        self._lit = ""
        self._tool_axes = False
        self._grip: Grip | None = None
        self._amount = 0.0
        self._before = control.session.experiment  # when the drag began
        for signal in (control.changed, control.offer_changed, view.camera_changed):
            signal.connect(lambda *_: self._show())
        preferences.changed.connect(lambda name: self._show() if name == "theme" else None)
        view.grabber = self

    @property
    def on(self) -> bool:
        """Whether the gizmo is there."""
        return self._control.is_watched_by(GIZMO)

    @property
    def tool_axes(self) -> bool:
        """Whether arrows and rings lie along the tool's own axes."""
        return self._tool_axes

    def set_tool_axes(self, on: bool) -> None:
        """Let arrows and rings lie along the tool's own axes, or along the base's; not while one is held."""
        if on == self._tool_axes or self._grip is not None:
            return
        self._tool_axes = on
        self._control.session.say(
            tr("The arrows lie along the tool's own axes. Press T for the base's.")
            if on
            else tr("The arrows lie along the base's axes. Press T for the tool's own.")
        )
        self.axes_switched.emit(on)
        self._show()

    def switch(self, on: bool) -> None:
        """Show the gizmo, or take it away."""
        if on == self.on:
            return
        self.release()
        self._lit = ""
        self._view.setMouseTracking(on)
        self._control.watch(GIZMO, on)
        self._show()
        self.switched.emit(on)

    # --- the pointer -----------------------------------------------------------------------------------------------

    def hover(self, at: QPointF | None) -> None:
        """The pointer is here, or has left."""
        handle = self._under(at) if self.on and at is not None else None
        lit = handle.key if handle is not None else ""
        if lit != self._lit:
            self._lit = lit
            self._view.setCursor(Qt.CursorShape.OpenHandCursor if lit else Qt.CursorShape.ArrowCursor)
            self._show()

    def press(self, at: QPointF) -> bool:
        """Take hold of what is under the pointer; whether there is something."""
        handle = self._under(at) if self.on else None
        if handle is None:
            return False
        self._grip = take_hold(self._gizmo(), handle, self._ray(at))
        if self._grip is None:
            return False
        self._amount, self._lit = 0.0, handle.key
        self._before = self._control.session.experiment
        self._control.session.end_stroke()
        self._view.setCursor(Qt.CursorShape.ClosedHandCursor)
        self._show()
        return True

    def drag(self, at: QPointF, modifiers: Qt.KeyboardModifier) -> None:
        """The pointer has moved with a handle held; with Ctrl in round steps."""
        if self._grip is None:
            return
        snap = self._snap() if modifiers & Qt.KeyboardModifier.ControlModifier else 0.0
        where = dragged(self._grip, self._ray(at), self._amount, snap)
        if where is not None:
            self._amount = where.amount
            self._wish(where.T, self._text(), "drag the target")

    def release(self) -> None:
        """Let go: the drag becomes one step of undo."""
        if self._grip is None:
            return
        self._control.settle()
        self._grip = None
        self._control.session.end_stroke()
        self._view.unsetCursor()
        self._show()

    def give_up(self) -> bool:
        """Esc: back to where the drag began; whether there was one."""
        if self._grip is None:
            return False
        text, self._grip = self._text(), None
        self._control.take_back(self._before, text, "drag the target")
        self._control.session.end_stroke()
        self._show()
        return True

    def _snap(self) -> float:
        assert self._grip is not None, "only what is held snaps"
        step = 10.0 * _STEP[self._control.session.robot.length_unit]
        return _SNAP_ANGLE if self._grip.handle.kind == "ring" else step

    def _text(self) -> str:
        ring = self._grip is not None and self._grip.handle.kind == "ring"
        return tr("Turn the tool") if ring else tr("Drag the tool")

    def _wish(self, T: FloatArray, text: str, merge: str) -> None:
        self._control.request(Wish(T, text, merge, self._freedom().task, creeps=True))

    # --- the keyboard ----------------------------------------------------------------------------------------------

    def key(self, key: Qt.Key, modifiers: Qt.KeyboardModifier, repeated: bool) -> bool:
        """Arrow keys nudge the target along the base's axes, as they lie on the screen; Page up and down lift it.

        T turns the arrows to the tool's own axes and back.
        """
        if not self.on:
            return False
        if key == Qt.Key.Key_Escape:
            return self.give_up()
        if key == Qt.Key.Key_T and not modifiers:
            self.set_tool_axes(not self._tool_axes)
            return True
        step = self._step(key)
        if step is None:
            return False
        if not repeated:
            self._control.settle()
            self._control.session.end_stroke()
        scale = next((scale for modifier, scale in _NUDGE.items() if modifiers & modifier), 1.0)
        length = scale * _STEP[self._control.session.robot.length_unit]
        self._control.flush()
        self._wish(moved(self._control.T, length * step), tr("Nudge the tool"), "nudge the target")
        return True

    def _step(self, key: Qt.Key) -> FloatArray | None:
        """The base axis (3,) that a key moves along; None for other keys and axes the arm has not."""
        if key in _LIFTS:
            step = np.array([0.0, 0.0, _LIFTS[key]])
        elif key in _ARROWS:
            across, away = _ARROWS[key]
            right = _nearest_axis(self._view.camera.axes[0])
            step = across * right + away * np.array([-right[1], right[0], 0.0])
        else:
            return None
        axis = _AXES[int(np.argmax(np.abs(step)))]
        return step if axis in self._freedom().axes else None

    # --- the picture -----------------------------------------------------------------------------------------------

    def _show(self) -> None:
        items: tuple[Item, ...] = ()
        if self.on:
            held = self._grip.handle.key if self._grip is not None else ""
            items = gizmo_items(self._gizmo(), self._stage.palette, self._lit, held, self._note())
        self._stage.set_layer(GIZMO, items)

    def _note(self) -> str:
        """How far it has gone."""
        if self._grip is None:
            return ""
        ring = self._grip.handle.kind == "ring"
        kind: Kind = "angle" if ring else length_kind(self._control.session.robot)
        text = format_quantity(self._amount, kind, self._preferences)
        return text if text.startswith("\u2212") or self._grip.handle.kind in ("free", "plane") else f"+{text}"

    def _freedom(self) -> Freedom:
        control = self._control
        return freedom_of(control.session.robot, control.task, control.solver)

    def _gizmo(self) -> Gizmo:
        session = self._control.session
        axes = joint_axes(session.robot, link_transforms(session.robot, session.q))
        T = self._control.T
        # What is held stays along the axes of when it was taken, even where the arm must turn the tool on its way.
        held = T if self._grip is None else self._grip.T
        handles = handles_of(self._freedom(), axes, held[:3, :3] if self._tool_axes else None)
        return gizmo_at(T, handles, self._view.camera, self._view.height())

    def _under(self, at: QPointF) -> Handle | None:
        size = self._view.width(), self._view.height()
        return handle_under(self._gizmo(), self._view.camera, at.x(), at.y(), *size)

    def _ray(self, at: QPointF) -> Ray:
        return self._view.camera.ray(at.x(), at.y(), self._view.width(), self._view.height())


def _nearest_axis(direction: FloatArray) -> FloatArray:
    """The horizontal base axis (3,), with its sign, that is nearest to a direction (3,)."""
    axis = int(np.argmax(np.abs(direction[:2])))
    step = np.zeros(3)
    step[axis] = math.copysign(1.0, direction[axis])
    return step
