"""The layer of the soft shadow on the floor, as if the light stood right above: drawn small, blurred, enlarged."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray
from PySide6.QtGui import QMatrix4x4, QVector3D
from PySide6.QtOpenGL import QOpenGLFramebufferObject

from rvsim.gui.renderers.opengl_binding import GL
from rvsim.gui.renderers.opengl_bodies import BodyLayer, Placed
from rvsim.gui.renderers.opengl_buffers import Attribute, Pipeline, Vertices
from rvsim.gui.renderers.opengl_frame import Frame, blend, use_depth
from rvsim.gui.renderers.opengl_shaders import blur_program
from rvsim.scene import Color

FloatArray = NDArray[np.float64]

_ONTO_FLOOR = QMatrix4x4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1)
_COARSE = 5.0  # pixels of the picture in one of the shadow, as the painter has it
_ROOM = 5 * _COARSE  # [pixels] how far the blur reaches
_CORNERS = ((-1, -1), (-1, 1), (1, -1), (1, 1))
_WHITE = Color(1.0, 1.0, 1.0)
_WHOLE_PICTURE = np.array([[-1, -1], [1, -1], [1, 1], [-1, -1], [1, 1], [-1, 1]], dtype=np.float32)


class ShadowLayer(BodyLayer):
    """One shadow for all opaque bodies."""

    def __init__(self, units: dict[str, Vertices]) -> None:
        super().__init__(units)
        self._color = Color(0.0, 0.0, 0.0)
        self._everywhere = Vertices(_WHOLE_PICTURE)
        self._blur: Pipeline | None = None
        self._shadow: QOpenGLFramebufferObject | None = None

    def initializeGL(self) -> None:
        """Compile the programs; a context made anew asks again."""
        super().initializeGL()
        self._blur = Pipeline(blur_program(), (Attribute("corner", 0, 2),))

    def show_shadow(self, bodies: dict[str, Placed], color: Color) -> None:
        """Show the shadow of exactly these."""
        self._color = color
        self.placed = bodies

    def prepare(self, frame: Frame) -> None:
        """Draw the bodies flat beside the screen and blur them along both directions.

        To be called before the picture is begun: software renderers must finish what they have when the target changes.
        """
        if not self.placed or self._pipeline is None or self._blur is None:
            return
        screen = int(GL.glGetIntegerv(GL.GL_FRAMEBUFFER_BINDING))
        width, height = math.ceil(frame.width / _COARSE), math.ceil(frame.height / _COARSE)
        # Made anew for each frame: unlike vertices they belong to one context, and a floated view gets another.
        sharp, smeared = QOpenGLFramebufferObject(width, height), QOpenGLFramebufferObject(width, height)
        use_depth(frame.functions, False)
        frame.functions.glDisable(GL.GL_BLEND)
        frame.functions.glViewport(0, 0, width, height)
        self._draw_flat(frame, self._pipeline, sharp)
        self._blur.bind()
        self._smear(frame, self._blur, sharp, smeared, 1.0 / width, 0.0)
        self._smear(frame, self._blur, smeared, sharp, 0.0, 1.0 / height)
        self._blur.release()
        self._shadow = sharp
        frame.functions.glBindFramebuffer(GL.GL_FRAMEBUFFER, screen)
        ratio = frame.pixel_ratio
        frame.functions.glViewport(0, 0, round(frame.width * ratio), round(frame.height * ratio))

    def paint(self) -> None:
        """Lay the shadow over what there is."""
        if self._shadow is None or self._blur is None:
            return
        frame: Frame = self.view().frame
        use_depth(frame.functions, False)
        blend(frame.functions)
        # Where there is no shadow nothing is to be enlarged, which software is slow at.
        frame.functions.glEnable(GL.GL_SCISSOR_TEST)
        frame.functions.glScissor(*_region(self.placed.values(), frame))
        self._blur.bind()
        self._lay(frame, self._blur, self._shadow, self._color)
        self._blur.release()
        frame.functions.glDisable(GL.GL_SCISSOR_TEST)
        self._shadow = None

    def _draw_flat(self, frame: Frame, pipeline: Pipeline, target: QOpenGLFramebufferObject) -> None:
        target.bind()
        frame.functions.glClearColor(0.0, 0.0, 0.0, 0.0)
        frame.functions.glClear(GL.GL_COLOR_BUFFER_BIT)
        pipeline.bind()
        pipeline.set_matrix("projection", frame.projection)
        pipeline.set_number("lit", 0.0)
        flat = frame._replace(view=frame.view * _ONTO_FLOOR)
        self._draw_bodies(self.placed.values(), flat, pipeline)
        pipeline.release()

    def _smear(
        self,
        frame: Frame,
        blur: Pipeline,
        source: QOpenGLFramebufferObject,
        target: QOpenGLFramebufferObject,
        right: float,
        up: float,
    ) -> None:
        target.bind()
        blur.set_vector("stride", right, up)
        self._lay(frame, blur, source, _WHITE)
        blur.set_vector("stride", 0.0, 0.0)

    def _lay(self, frame: Frame, blur: Pipeline, source: QOpenGLFramebufferObject, color: Color) -> None:
        gl = frame.functions
        gl.glBindTexture(GL.GL_TEXTURE_2D, source.texture())
        gl.glTexParameteri(GL.GL_TEXTURE_2D, GL.GL_TEXTURE_MIN_FILTER, GL.GL_LINEAR)
        gl.glTexParameteri(GL.GL_TEXTURE_2D, GL.GL_TEXTURE_MAG_FILTER, GL.GL_LINEAR)
        blur.set_color("color", color)
        blur.read_from(self._everywhere)
        gl.glDrawArrays(GL.GL_TRIANGLES, 0, self._everywhere.count)
        gl.glBindTexture(GL.GL_TEXTURE_2D, 0)


def _region(bodies: Iterable[Placed], frame: Frame) -> tuple[int, int, int, int]:
    """Left, bottom, width and height of what the shadow may touch, in the pixels of the screen."""
    squares = np.concatenate([_square(body) for body in bodies])
    pixels = frame.camera.project(squares, frame.width, frame.height)
    lower, upper = np.zeros(2), np.array([frame.width, frame.height], dtype=np.float64)
    if frame.camera.orthographic or (pixels[:, 2] > 0).all():
        lower, upper = (
            np.clip(pixels[:, :2].min(axis=0) - _ROOM, lower, upper),
            np.clip(pixels[:, :2].max(axis=0) + _ROOM, lower, upper),
        )
    left, top, right, bottom = (frame.pixel_ratio * edge for edge in (*lower.tolist(), *upper.tolist()))
    return (
        math.floor(left),
        math.floor(frame.height * frame.pixel_ratio - bottom),
        math.ceil(right - left) + 1,
        math.ceil(bottom - top) + 1,
    )


def _square(body: Placed) -> FloatArray:
    """(8, 3) corners on the floor of two squares that enclose the footprints of a body's ends [m]."""
    radius = max(body.scale) if body.shape == "capsule" else 0.5 * math.hypot(*body.scale)
    ends = [body.place.map(QVector3D(0.0, 0.0, height)) for height in (0.0, body.stretch)]
    return np.array([(end.x() + x * radius, end.y() + y * radius, 0.0) for end in ends for x, y in _CORNERS])
