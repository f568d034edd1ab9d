"""What all layers of the OpenGL picture share while it is painted."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from PySide6.QtGui import QMatrix4x4, QOpenGLFunctions

from rvsim.gui.renderers.opengl_binding import GL
from rvsim.scene import Camera


class Frame(NamedTuple):
    """What all layers need to know of the picture being painted: sizes in device-independent pixels."""

    functions: QOpenGLFunctions
    view: QMatrix4x4
    projection: QMatrix4x4
    camera: Camera
    width: int
    height: int
    pixel_ratio: float


def to_qt(matrix: NDArray[np.float64]) -> QMatrix4x4:
    """Of a matrix (4, 4)."""
    return QMatrix4x4(matrix.ravel().tolist())


def use_depth(gl: QOpenGLFunctions, wanted: bool) -> None:
    """Whether what is nearer hides what is farther, or what is later hides what is earlier."""
    gl.glDepthFunc(GL.GL_LEQUAL)
    (gl.glEnable if wanted else gl.glDisable)(GL.GL_DEPTH_TEST)


def blend(gl: QOpenGLFunctions) -> None:
    """Mix by alpha over an opaque picture that stays opaque."""
    gl.glEnable(GL.GL_BLEND)
    gl.glBlendFuncSeparate(GL.GL_SRC_ALPHA, GL.GL_ONE_MINUS_SRC_ALPHA, GL.GL_ONE, GL.GL_ONE_MINUS_SRC_ALPHA)
