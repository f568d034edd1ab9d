"""The hand on the wrench: its arrow's end is taken hold of and dragged in the plane that faces the eye."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from PySide6.QtCore import QObject, QPointF, Qt, Signal

from rvsim.gui.scene_view import Grabber, SceneView
from rvsim.robot.arrays import FloatArray
from rvsim.scene import Ray
from rvsim.scene.wrench import WrenchArrows, met_in_view_plane, tip_is_under

_SMALLEST = 14.0  # [pixels] an arrow that is dragged shorter than this is none


class WrenchDrag(QObject):
    """Stands before whoever else takes hold of things in the view, and passes on what is not the arrow's.

    Args:
        view: the scene.
        arrows: what is drawn now, or None while nothing is.

    Signals:
        pulled(force): (3,) [N] base axes, while the end is dragged.
        lit(on): the pointer lies on the end, or holds it.
        released(given_up): the hand has let go; Esc gives the drag up.
    """

    pulled = Signal(object)
    lit = Signal(bool)
    released = Signal(bool)

    def __init__(self, view: SceneView, arrows: Callable[[], WrenchArrows | None], parent: QObject) -> None:
        super().__init__(parent)
        self._view, self._arrows = view, arrows
        self._behind: Grabber | None = None
        self._on = self._linked = self._held = self._is_lit = False

    @property
    def held(self) -> bool:
        """Whether the hand holds the arrow."""
        return self._held

    @property
    def lit_now(self) -> bool:
        """Whether the pointer lies on the arrow's end, or holds it."""
        return self._is_lit

    def switch(self, on: bool) -> None:
        """Begin to listen to the pointer, or leave it to the others."""
        if on == self._on:
            return
        self._on = on
        if on:
            self._view.setMouseTracking(True)
            if not self._linked:
                self._behind, self._view.grabber, self._linked = self._view.grabber, self, True
            return
        self._let_go(given_up=False)
        self._light(False)
        if self._view.grabber is self:  # else somebody stands before us, and we only pass on
            self._view.grabber, self._linked = self._behind, False

    # --- what the view tells ---------------------------------------------------------------------------------------

    def hover(self, at: QPointF | None) -> None:
        """The pointer is here, or has left."""
        over = at is not None and self._lies_on_tip(at)
        self._light(over)
        if self._behind is not None:
            self._behind.hover(None if over else at)

    def press(self, at: QPointF) -> bool:
        """Take hold of the arrow's end, or let the next one try."""
        if self._lies_on_tip(at):
            self._held = True
            self._light(True)
            self._view.setCursor(Qt.CursorShape.ClosedHandCursor)
            return True
        return self._behind is not None and self._behind.press(at)

    def drag(self, at: QPointF, modifiers: Qt.KeyboardModifier) -> None:
        """The end follows the pointer; with Ctrl in whole newtons."""
        if not self._held:
            if self._behind is not None:
                self._behind.drag(at, modifiers)
            return
        force = self._force_under(at)
        if force is not None:
            self.pulled.emit(np.round(force) if modifiers & Qt.KeyboardModifier.ControlModifier else force)

    def release(self) -> None:
        """Let go."""
        if self._held:
            self._let_go(given_up=False)
        elif self._behind is not None:
            self._behind.release()

    def key(self, key: Qt.Key, modifiers: Qt.KeyboardModifier, repeated: bool) -> bool:
        """Esc gives the drag up."""
        if self._held and key == Qt.Key.Key_Escape:
            self._let_go(given_up=True)
            return True
        return self._behind is not None and self._behind.key(key, modifiers, repeated)

    # --- inside ----------------------------------------------------------------------------------------------------

    def _let_go(self, *, given_up: bool) -> None:
        if self._held:
            self._held = False
            self._view.unsetCursor()
            self.released.emit(given_up)

    def _light(self, on: bool) -> None:
        if on == self._is_lit or self._held:
            return
        self._is_lit = on
        if on:
            self._view.setCursor(Qt.CursorShape.OpenHandCursor)
        else:
            self._view.unsetCursor()
        self.lit.emit(on)

    def _lies_on_tip(self, at: QPointF) -> bool:
        arrows = self._arrows() if self._on else None
        size = float(self._view.width()), float(self._view.height())
        return arrows is not None and tip_is_under(arrows, self._view.camera, (at.x(), at.y()), size)

    def _force_under(self, at: QPointF) -> FloatArray | None:
        arrows = self._arrows()
        if arrows is None:
            return None
        tip = met_in_view_plane(arrows.tip, self._view.camera, self._ray(at))
        if tip is None:
            return None
        pixels = self._view.camera.project(np.stack([arrows.origin, tip]), self._view.width(), self._view.height())
        short = float(np.hypot(*(pixels[1] - pixels[0])[:2])) < _SMALLEST
        return np.zeros(3) if short else arrows.force_at(tip)

    def _ray(self, at: QPointF) -> Ray:
        return self._view.camera.ray(at.x(), at.y(), self._view.width(), self._view.height())
