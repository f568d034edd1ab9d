"""PyOpenGL and pyqtgraph's view, imported in the one order that works: import them from here, nowhere else."""

from PySide6.QtGui import QGuiApplication

from rvsim.gui.renderers.opengl_context import match_pyopengl, probe_opengl

# PyOpenGL binds to EGL or GLX while it is imported; it must be the one that Qt uses.
if QGuiApplication.instance() is not None:
    match_pyopengl(probe_opengl())

import OpenGL

# Asking for errors after each call costs a fifth of the frame rate; the first frame is proven by its pixels instead.
OpenGL.ERROR_CHECKING = False

from OpenGL import GL  # noqa: E402
from pyqtgraph.opengl.GLGraphicsItem import GLGraphicsItem  # noqa: E402
from pyqtgraph.opengl.GLViewWidget import GLViewWidget  # noqa: E402

__all__ = ["GL", "GLGraphicsItem", "GLViewWidget"]
