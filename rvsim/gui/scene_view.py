"""The widget in the middle of the window: it hosts a renderer, owns the camera and turns mouse and keys into moves."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Protocol

import numpy as np
from PySide6.QtCore import QEasingCurve, QEvent, QPointF, QSize, Qt, QVariantAnimation, Signal
from PySide6.QtGui import (
    QImage,
    QKeyEvent,
    QMouseEvent,
    QNativeGestureEvent,
    QResizeEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QVBoxLayout, QWidget

from rvsim.gui.renderers.base import Renderer
from rvsim.gui.scene_overlay import CornerAxes, ZoomBox
from rvsim.language import tr
from rvsim.scene import Camera, Scene
from rvsim.scene.camera_moves import blended, framed, same_view
from rvsim.scene.picking import point_under

_ORBIT = math.radians(0.4)  # [rad / pixel]
_KEY_ORBIT = math.radians(5.0)
_KEY_PAN = 30.0  # [pixels]
_WHEEL_ZOOM = 1.16  # a notch of the wheel
_MOVE_MS = 260
_CLICK_ROOM = 4.0  # [pixels] a press that moves by less is a click
_SMALLEST_BOX = 6.0  # [pixels] less is a click, not a box
_REFIT = 0.25  # an arm whose reach differs by more than this share is framed anew

_Point = tuple[float, float]
_ARROWS = {
    Qt.Key.Key_Left: (-1.0, 0.0),
    Qt.Key.Key_Right: (1.0, 0.0),
    Qt.Key.Key_Up: (0.0, -1.0),
    Qt.Key.Key_Down: (0.0, 1.0),
}
_ZOOM_KEYS = {Qt.Key.Key_Plus: 1.2, Qt.Key.Key_Equal: 1.2, Qt.Key.Key_Minus: 1 / 1.2}


class Grabber(Protocol):
    """Something in the scene that the hand may take hold of before the view moves."""

    def hover(self, at: QPointF | None) -> None:
        """The pointer is here with no button down, or has left."""
        ...

    def press(self, at: QPointF) -> bool:
        """Whether there is something to take hold of."""
        ...

    def drag(self, at: QPointF, modifiers: Qt.KeyboardModifier) -> None:
        """The pointer has moved while something is held."""
        ...

    def release(self) -> None:
        """Let go."""
        ...

    def key(self, key: Qt.Key, modifiers: Qt.KeyboardModifier, repeated: bool) -> bool:
        """Whether a key has been taken."""
        ...


class SceneView(QWidget):
    """Shows a scene; drag orbits, right drag or Shift + drag pans, the wheel zooms at the pointer.

    Signals:
        camera_changed: (Camera) the view has moved.
        painted: (milliseconds) a frame was painted in that time.
        clicked: (place, modifiers) the left button went down and up there, and nothing was dragged.
    """

    camera_changed = Signal(object)
    painted = Signal(float)
    clicked = Signal(QPointF, Qt.KeyboardModifier)

    def __init__(self, renderer_factory: Callable[[QWidget], Renderer], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("scene_view")
        self.setAccessibleName(tr("Scene"))
        self.setAccessibleDescription(tr("The arm. Arrow keys turn the view, plus and minus zoom, F shows everything."))
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMinimumSize(160, 120)
        self.animated = True
        self.grabber: Grabber | None = None
        self.takes_clicks = False  # then a hand that trembles does not turn the view, nor a double click centre it
        self._grabbing = False
        self._scene: Scene | None = None
        self._camera = Camera(np.zeros(3), 3.0)
        self._framed_bounds: np.ndarray | None = None
        self._outliers: Callable[[], np.ndarray] = lambda: np.empty((0, 3))
        self._follows_size = True  # framed as a whole, and to be kept so when the widget changes its size
        self._pressed: QPointF | None = None
        self._choosing_box = False
        self._renderer = renderer_factory(self)
        self._lay_out()
        self._animation = self._make_animation()
        self._renderer.on_painted(self.painted.emit)
        self._renderer.set_camera(self._camera)

    def _lay_out(self) -> None:
        shown = self._renderer.widget()
        shown.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        shown.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(shown)
        self._axes, self._box = CornerAxes(self), ZoomBox(self)

    def _make_animation(self) -> QVariantAnimation:
        animation = QVariantAnimation(self)
        animation.setStartValue(0.0)
        animation.setEndValue(1.0)
        animation.setDuration(_MOVE_MS)
        animation.setEasingCurve(QEasingCurve.Type.InOutCubic)
        animation.valueChanged.connect(self._animate)
        return animation

    # --- what is shown ---------------------------------------------------------------------------------------------

    @property
    def renderer(self) -> Renderer:
        """What draws."""
        return self._renderer

    @property
    def camera(self) -> Camera:
        """Where the eye is now."""
        return self._camera

    @property
    def scene(self) -> Scene | None:
        """What is shown."""
        return self._scene

    def sizeHint(self) -> QSize:
        """As much as there is."""
        return QSize(800, 600)

    def set_scene(self, scene: Scene) -> None:
        """Shows another scene; an arm of another size is framed anew."""
        if scene is self._scene:
            return
        self._scene = scene
        self._axes.set_background(scene.background)
        self._renderer.set_scene(scene)
        if self._needs_framing(scene.bounds):
            self._frame_now()

    def set_outliers(self, points: Callable[[], np.ndarray]) -> None:
        """Where points (k, 3) are to be had that are framed as well when somebody asks for everything."""
        self._outliers = points

    def image(self) -> QImage:
        """The picture as it is painted now."""
        return self._renderer.image()

    # --- moves -----------------------------------------------------------------------------------------------------

    def set_camera(self, camera: Camera) -> None:
        """Looks from elsewhere at once."""
        self._animation.stop()
        self._show_from(camera)

    @property
    def stance(self) -> tuple[Camera, bool]:
        """From where it is seen, or soon will be, and whether everything is framed, however large the widget is."""
        return self._goal(), self._follows_size

    def take_stance(self, camera: Camera, *, framed: bool) -> None:
        """Looks from elsewhere at once; `framed`: everything from that direction, else exactly so."""
        if framed:
            self.set_camera(self._framed(camera))
            self._follows_size = True
        else:
            self._move(camera)

    def fit(self) -> None:
        """Frames all that the arm can reach, and what it should reach, from the present direction."""
        self._go_framed(self._goal())

    def view(self, name: str) -> None:
        """Looks from a named direction ("top", "front", "side", "iso", "source") and frames everything."""
        self._go_framed(self._goal().from_preset(name))

    def set_orthographic(self, on: bool) -> None:
        """Parallel projection, or perspective."""
        if on != self._camera.orthographic:
            self.set_camera(replace(self._goal(), orthographic=on))

    def begin_box_zoom(self) -> None:
        """The next drag draws a box, which then fills the view; Esc gives up."""
        self._choosing_box = True
        self._show_cursor()

    def _goal(self) -> Camera:
        """Where a running move will end: a second move starts from there."""
        moving = self._animation.state() == QVariantAnimation.State.Running
        return self._end if moving else self._camera

    def _go_framed(self, camera: Camera) -> None:
        self._go(self._framed(camera))
        self._follows_size = True

    def _framed(self, camera: Camera) -> Camera:
        if self._scene is None:
            return camera
        self._framed_bounds = self._scene.bounds
        size = max(self.width(), 1), max(self.height(), 1)
        return framed(camera, self._scene.bounds, *size, also=self._outliers())

    def _frame_now(self) -> None:
        self.set_camera(self._framed(self._goal()))
        self._follows_size = True

    def _needs_framing(self, bounds: np.ndarray) -> bool:
        if self._framed_bounds is None:
            return True
        size = float(np.ptp(self._framed_bounds, axis=0).max())
        return bool(np.abs(bounds - self._framed_bounds).max() > _REFIT * size)

    def _go(self, camera: Camera) -> None:
        """Moves there smoothly, or at once where nobody sees it."""
        self._animation.stop()
        if not self.animated or not self.isVisible() or same_view(camera, self._camera):
            self._show_from(camera)
            return
        self._start, self._end = self._camera, camera
        self._animation.start()

    def _animate(self, share: float) -> None:
        if self._animation.state() == QVariantAnimation.State.Running:
            self._show_from(self._end if share >= 1.0 else blended(self._start, self._end, share))

    def _show_from(self, camera: Camera) -> None:
        if same_view(camera, self._camera):
            return
        self._camera = camera
        self._renderer.set_camera(camera)
        self._axes.set_camera(camera)
        self.camera_changed.emit(camera)

    def _move(self, camera: Camera) -> None:
        """A move by hand: from now on the view stays where it was put."""
        self._follows_size = False
        self.set_camera(camera)

    def _zoom(self, factor: float, at: QPointF | None = None) -> None:
        x, y = (at.x(), at.y()) if at is not None else (self.width() / 2, self.height() / 2)
        self._move(self._goal().zoomed(factor, x, y, self.width(), self.height()))

    # --- events ----------------------------------------------------------------------------------------------------

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keeps everything framed until the view is moved by hand."""
        super().resizeEvent(event)
        self._axes.move(4, self.height() - self._axes.height() - 4)
        self._box.resize(self.size())
        if self._follows_size and self._scene is not None:
            self._frame_now()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Begins a drag: of what can be taken hold of there, else of the view."""
        plain = event.button() == Qt.MouseButton.LeftButton and not self._choosing_box and self._pressed is None
        self._grabbing = plain and self.grabber is not None and self.grabber.press(event.position())
        if self._grabbing:
            return
        self._pressed = self._last = event.position()
        self._strayed = False
        self._panning = _pans(event)
        self._show_cursor()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Orbits, pans, or stretches the box."""
        at = event.position()
        if self._pressed is None:
            self._point(at, event.modifiers())
            return
        if not self._strayed and self.takes_clicks and _distance(self._pressed, at) < _CLICK_ROOM:
            return
        self._strayed = True
        step, self._last = at - self._last, at
        if self._choosing_box:
            self._box.stretch(self._pressed, at)
        elif self._panning:
            self._move(self._camera.panned(step.x(), step.y(), self.height()))
        else:
            self._move(self._camera.orbited(-_ORBIT * step.x(), _ORBIT * step.y()))

    def _point(self, at: QPointF, modifiers: Qt.KeyboardModifier) -> None:
        """No drag of the view: the pointer may hold something, or lie on it."""
        if self.grabber is not None:
            self.grabber.drag(at, modifiers) if self._grabbing else self.grabber.hover(at)

    def leaveEvent(self, event: QEvent) -> None:
        """The pointer lies on nothing any more."""
        super().leaveEvent(event)
        if self.grabber is not None and not self._grabbing:
            self.grabber.hover(None)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Ends a drag; a drawn box fills the view."""
        if self._grabbing and self.grabber is not None:
            self._grabbing = False
            self.grabber.release()
            return
        pressed, self._pressed = self._pressed, None
        if pressed is not None and self._choosing_box:
            self._zoom_to_box(pressed, event.position())
        elif pressed is not None and not self._strayed and not self._panning:
            self.clicked.emit(pressed, event.modifiers())
        self._show_cursor()

    def _zoom_to_box(self, start: QPointF, end: QPointF) -> None:
        self._end_box()
        if max(abs(end.x() - start.x()), abs(end.y() - start.y())) < _SMALLEST_BOX:
            return
        corners = (start.x(), start.y(), end.x(), end.y())
        self._follows_size = False
        self._go(self._goal().zoomed_to_box(*corners, self.width(), self.height()))

    def _end_box(self) -> None:
        self._choosing_box = False
        self._box.hide()

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Centres on what is under the pointer."""
        if self._scene is None or event.button() != Qt.MouseButton.LeftButton or self.takes_clicks:
            return
        at = event.position()
        point = point_under(self._scene, self._goal(), at.x(), at.y(), self.width(), self.height())
        if point is not None:
            self._follows_size = False
            self._go(replace(self._goal(), target=point))

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Zooms at the pointer."""
        notches = event.angleDelta().y() / 120.0
        if notches:
            self._zoom(_WHEEL_ZOOM**notches, event.position())
        event.accept()

    def event(self, event: QEvent) -> bool:
        """Zooms with two fingers on a touchpad."""
        if isinstance(event, QNativeGestureEvent) and event.gestureType() == Qt.NativeGestureType.ZoomNativeGesture:
            self._zoom(max(1.0 + event.value(), 0.2), event.position())
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Arrows orbit, or pan with Shift; plus and minus zoom; F frames everything; Esc gives up the box.

        What can be taken hold of is asked first.
        """
        key = Qt.Key(event.key())
        if self.grabber is not None and self.grabber.key(key, event.modifiers(), event.isAutoRepeat()):
            return
        if key in _ARROWS:
            self._step(_ARROWS[key], bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier))
        elif key in _ZOOM_KEYS:
            self._zoom(_ZOOM_KEYS[key])
        elif key == Qt.Key.Key_F:
            self.fit()
        elif key == Qt.Key.Key_Escape and self._choosing_box:
            self._end_box()
            self._show_cursor()
        else:
            super().keyPressEvent(event)

    def _step(self, direction: _Point, pans: bool) -> None:
        right, down = direction
        if pans:
            self._move(self._goal().panned(-_KEY_PAN * right, -_KEY_PAN * down, self.height()))
        else:
            self._move(self._goal().orbited(_KEY_ORBIT * right, -_KEY_ORBIT * down))

    def _show_cursor(self) -> None:
        if self._choosing_box:
            self.setCursor(Qt.CursorShape.CrossCursor)
        elif self._pressed is not None:
            self.setCursor(Qt.CursorShape.SizeAllCursor if self._panning else Qt.CursorShape.ClosedHandCursor)
        else:
            self.unsetCursor()


def _distance(one: QPointF, other: QPointF) -> float:
    return math.hypot(one.x() - other.x(), one.y() - other.y())


def _pans(event: QMouseEvent) -> bool:
    shifted = bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier)
    return event.button() != Qt.MouseButton.LeftButton or shifted
