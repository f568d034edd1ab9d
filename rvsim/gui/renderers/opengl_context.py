"""What OpenGL the running system has, asked through Qt alone; and PyOpenGL told to use the same one."""

from __future__ import annotations

import ctypes
import os
import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache

from PySide6.QtCore import QCoreApplication, Qt
from PySide6.QtGui import QOffscreenSurface, QOpenGLContext

_GL_RENDERER, _GL_VERSION = 0x1F01, 0x1F02
# The library and the function that say whether a context of that kind is current in this thread.
_CONTEXT_KINDS = (("egl", "libEGL.so.1", "eglGetCurrentContext"), ("glx", "libGL.so.1", "glXGetCurrentContext"))


@dataclass(frozen=True)
class OpenGLProbe:
    """What asking for a context brought.

    Args:
        created, current: whether a context could be made, and made current.
        version: (major, minor) of the context.
        renderer: the driver's own name for what draws.
        embedded: OpenGL ES instead of the desktop's OpenGL.
        api: "egl" or "glx" where that matters, else "".
    """

    created: bool = False
    current: bool = False
    version: tuple[int, int] = (0, 0)
    renderer: str = ""
    embedded: bool = False
    api: str = ""


def prepare_opengl() -> None:
    """Let all OpenGL contexts share their resources; must run before the application object exists.

    Without it a second view, or a dock that is floated, stays blank.
    """
    if QCoreApplication.instance() is None:
        QCoreApplication.setAttribute(Qt.ApplicationAttribute.AA_ShareOpenGLContexts)


@cache
def probe_opengl() -> OpenGLProbe:
    """Ask the running system, once: needs the application object and a platform that may have OpenGL at all."""
    context, surface = QOpenGLContext(), QOffscreenSurface()
    if not context.create():
        return OpenGLProbe()
    surface.setFormat(context.format())
    surface.create()
    with _made_current(context, surface) as current:
        return _describe(context) if current else OpenGLProbe(created=True)


@contextmanager
def _made_current(context: QOpenGLContext, surface: QOffscreenSurface) -> Iterator[bool]:
    current = context.makeCurrent(surface)
    try:
        yield current
    finally:
        if current:
            context.doneCurrent()


def _describe(context: QOpenGLContext) -> OpenGLProbe:
    functions = context.functions()
    return OpenGLProbe(
        created=True,
        current=True,
        version=_version(str(functions.glGetString(_GL_VERSION))),
        renderer=str(functions.glGetString(_GL_RENDERER)),
        embedded=context.isOpenGLES(),
        api=_current_api(),
    )


def _version(text: str) -> tuple[int, int]:
    found = re.search(r"(\d+)\.(\d+)", text)
    return (int(found[1]), int(found[2])) if found else (0, 0)


def _current_api() -> str:
    if not sys.platform.startswith("linux"):
        return ""
    return next((name for name, library, question in _CONTEXT_KINDS if _is_current(library, question)), "")


def _is_current(library: str, question: str) -> bool:
    try:
        ask = getattr(ctypes.CDLL(library), question)
    except (OSError, AttributeError):
        return False
    ask.restype = ctypes.c_void_p
    return bool(ask())


def match_pyopengl(probe: OpenGLProbe) -> None:
    """Make PyOpenGL, which is not imported yet, speak to the kind of context that Qt makes; else nothing is drawn."""
    if probe.api and "OpenGL" not in sys.modules:
        os.environ["PYOPENGL_PLATFORM"] = probe.api
