"""The layer of the soft shadow on the floor, as if the light stood right above: drawn small, blurred, enlarged."""

from __future__ import annotations

import math

import numpy as np
from PySide6.QtGui import QMatrix4x4
from PySide6.QtOpenGL import QOpenGLFramebufferObject

from rvsim.gui.renderers.opengl_binding import GL
from rvsim.gui.renderers.opengl_bodies import BodyLayer, Placed
from rvsim.gui.renderers.opengl_buffers import Attribute, Pipeline, Vertices
from rvsim.gui.renderers.opengl_frame import Frame, blend, use_depth
from rvsim.gui.renderers.opengl_shaders import blur_program
from rvsim.scene import Color

_ONTO_FLOOR = QMatrix4x4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1)
_COARSE = 5.0  # pixels of the picture in one of the shadow, as the painter has it
_WHITE = Color(1.0, 1.0, 1.0)
_WHOLE_PICTURE = np.array([[-1, -1], [1, -1], [1, 1], [-1, -1], [1, 1], [-1, 1]], dtype=np.float32)


class ShadowLayer(BodyLayer):
    """One shadow for all opaque bodies."""

    def __init__(self, units: dict[str, Vertices]) -> None:
        super().__init__(units)
        self._color = Color(0.0, 0.0, 0.0)
        self._everywhere = Vertices(_WHOLE_PICTURE)
        self._blur: Pipeline | None = None

    def initializeGL(self) -> None:
        """Compile the programs; a context made anew asks again."""
        super().initializeGL()
        self._blur = Pipeline(blur_program(), (Attribute("corner", 0, 2),))

    def show_shadow(self, bodies: dict[str, Placed], color: Color) -> None:
        """Show the shadow of exactly these."""
        self._color = color
        self.placed = bodies

    def draw(self, frame: Frame, pipeline: Pipeline) -> None:
        """Draw the bodies flat beside the screen, blur them along both directions, and lay them over the floor."""
        if self._blur is None:
            return
        screen = int(GL.glGetIntegerv(GL.GL_FRAMEBUFFER_BINDING))
        width, height = math.ceil(frame.width / _COARSE), math.ceil(frame.height / _COARSE)
        # Made anew for each frame: unlike vertices they belong to one context, and a floated view gets another.
        sharp, smeared = QOpenGLFramebufferObject(width, height), QOpenGLFramebufferObject(width, height)
        use_depth(frame.functions, False)
        frame.functions.glDisable(GL.GL_BLEND)
        frame.functions.glViewport(0, 0, width, height)
        self._draw_flat(frame, pipeline, sharp)
        self._blur.bind()
        self._smear(frame, self._blur, sharp, smeared, 1.0 / width, 0.0)
        self._smear(frame, self._blur, smeared, sharp, 0.0, 1.0 / height)
        frame.functions.glBindFramebuffer(GL.GL_FRAMEBUFFER, screen)
        ratio = frame.pixel_ratio
        frame.functions.glViewport(0, 0, round(frame.width * ratio), round(frame.height * ratio))
        blend(frame.functions)
        self._lay(frame, self._blur, sharp, self._color)
        pipeline.bind()

    def _draw_flat(self, frame: Frame, pipeline: Pipeline, target: QOpenGLFramebufferObject) -> None:
        target.bind()
        frame.functions.glClearColor(0.0, 0.0, 0.0, 0.0)
        frame.functions.glClear(GL.GL_COLOR_BUFFER_BIT)
        pipeline.set_number("lit", 0.0)
        flat = frame._replace(view=frame.view * _ONTO_FLOOR)
        self._draw_bodies(self.placed.values(), flat, pipeline)

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
