"""What lies in the graphics memory: vertices that are uploaded when first drawn, and programs with their layout."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from PySide6.QtGui import QMatrix4x4, QVector4D
from PySide6.QtOpenGL import QOpenGLBuffer, QOpenGLShaderProgram

from rvsim.gui.renderers.opengl_binding import GL
from rvsim.scene import Color

_FLOAT_BYTES = 4


class Attribute(NamedTuple):
    """One input of a vertex: its name, its first float within the vertex, and how many floats it has."""

    name: str
    first: int
    size: int


BODY_LAYOUT = (Attribute("position", 0, 3), Attribute("normal", 3, 3), Attribute("end", 6, 1))
STROKE_LAYOUT = (
    *(Attribute(name, 3 * i, 3) for i, name in enumerate(("before", "start", "end", "after"))),
    Attribute("corner", 12, 2),
    Attribute("so_far", 14, 1),
)


class Vertices:
    """Vertices (k, floats) float32 in graphics memory. May be made and replaced while no context is current."""

    def __init__(self, data: NDArray[np.float32]) -> None:
        self._buffer = QOpenGLBuffer(QOpenGLBuffer.Type.VertexBuffer)
        self.replace(data)

    def replace(self, data: NDArray[np.float32]) -> None:
        """Other vertices from the next drawing on."""
        self.count = len(data)
        self._waiting: bytes | None = data.tobytes()

    def bind(self) -> None:
        """Make this the source of the attributes; uploads what is waiting. The context must be current."""
        if not self._buffer.isCreated():
            self._buffer.create()
        self._buffer.bind()
        if self._waiting is not None:
            self._buffer.allocate(self._waiting, len(self._waiting))
            self._waiting = None

    def release(self) -> None:
        """Unbind."""
        self._buffer.release()


class Pipeline:
    """A shader program together with the layout of the vertices that it reads."""

    def __init__(self, program: QOpenGLShaderProgram, layout: tuple[Attribute, ...]) -> None:
        self._program = program
        self._stride = sum(attribute.size for attribute in layout) * _FLOAT_BYTES
        self._inputs = [
            (program.attributeLocation(attribute.name), attribute.first * _FLOAT_BYTES, attribute.size)
            for attribute in layout
        ]
        self._places: dict[str, int] = {}

    def bind(self) -> None:
        """Use this program from now on."""
        self._program.bind()

    def release(self) -> None:
        """Back to no program."""
        for location, _, _ in self._inputs:
            self._program.disableAttributeArray(location)
        self._program.release()

    def read_from(self, vertices: Vertices) -> None:
        """Take the attributes from these vertices."""
        vertices.bind()
        for location, offset, size in self._inputs:
            self._program.enableAttributeArray(location)
            self._program.setAttributeBuffer(location, GL.GL_FLOAT, offset, size, self._stride)
        vertices.release()

    def _place(self, name: str) -> int:
        if name not in self._places:
            self._places[name] = self._program.uniformLocation(name)
        return self._places[name]

    def set_matrix(self, name: str, matrix: QMatrix4x4) -> None:
        """A uniform mat4."""
        self._program.setUniformValue(self._place(name), matrix)

    def set_color(self, name: str, color: Color) -> None:
        """A uniform vec4."""
        self._program.setUniformValue(self._place(name), QVector4D(*color))

    def set_vector(self, name: str, *values: float) -> None:
        """A uniform vec2 or vec3."""
        self._program.setUniformValue(self._place(name), *values)

    def set_number(self, name: str, value: float) -> None:
        """A uniform float."""
        self._program.setUniformValue1f(self._place(name), value)
