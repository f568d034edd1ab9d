"""What a renderer is: the two of them (OpenGL, painter) look the same to the rest of the window."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from PySide6.QtGui import QImage
from PySide6.QtWidgets import QWidget

from rvsim.scene import Camera, Scene


class Renderer(Protocol):
    """Draws a scene in a widget of its own. It keeps the mouse to itself never: `SceneView` does all the moves."""

    name: str  # "painter" or "opengl"
    description: str  # for the status text, for instance "painter" or "OpenGL 3.1, Mesa Intel UHD"

    def widget(self) -> QWidget:
        """The widget that shows the scene."""
        ...

    def set_scene(self, scene: Scene) -> None:
        """Shows another scene at the next paint; several calls before it cost one paint."""
        ...

    def set_camera(self, camera: Camera) -> None:
        """Looks from elsewhere at the next paint."""
        ...

    def image(self) -> QImage:
        """The picture as it would be painted now."""
        ...

    def on_painted(self, report: Callable[[float], None]) -> None:
        """From now on `report(milliseconds)` is called after each paint with the time that it took."""
        ...
