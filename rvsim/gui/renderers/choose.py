"""Which renderer draws, and why: a table of reasons against OpenGL, read from the top; the first that holds decides."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QVBoxLayout, QWidget

from rvsim.gui.renderers.base import Renderer
from rvsim.gui.renderers.opengl_context import OpenGLProbe
from rvsim.language import tr, tr_later
from rvsim.scene import Camera, Scene

PLATFORMS_WITHOUT_OPENGL = frozenset({"offscreen", "minimal", "vnc", "linuxfb"})
SOFTWARE_NAMES = (
    "llvmpipe",
    "softpipe",
    "swrast",
    "swiftshader",
    "software rasterizer",
    "warp",
    "basic render",
)
_OLDEST = (2, 1)
_SAMPLES = 4


class Choice(NamedTuple):
    """The renderer's name ("gl" or "painter"), a sentence that says why, and what the system said about itself."""

    name: str
    reason: str
    details: str
    samples: int = 0


def is_software(probe: OpenGLProbe) -> bool:
    """Whether the processor, not a graphics card, does the drawing."""
    return any(name in probe.renderer.lower() for name in SOFTWARE_NAMES)


# What makes OpenGL unusable, in the order in which it can be asked.
_OBSTACLES: tuple[tuple[Callable[[OpenGLProbe], bool], str], ...] = (
    (lambda probe: not probe.created, tr_later("this system gives no OpenGL context")),
    (lambda probe: not probe.current, tr_later("the OpenGL context of this system cannot be used")),
    (lambda probe: probe.version < _OLDEST, tr_later("the OpenGL of this system is older than 2.1")),
    (lambda probe: "gdi generic" in probe.renderer.lower(), tr_later("this Windows has no graphics driver")),
    (lambda probe: probe.embedded, tr_later("this system has OpenGL ES only")),
)


def choose_renderer(wanted: str, platform_name: str, probe: Callable[[], OpenGLProbe]) -> Choice:
    """Decide which renderer draws.

    Args:
        wanted: "auto", "gl" or "painter". Where OpenGL is wanted but missing the painter draws; the reason says so.
        platform_name: Qt's name of the window system.
        probe: asks the system for OpenGL; called only if the answer can matter.
    """
    if wanted == "painter":
        return Choice("painter", tr("The painter draws, as wished."), "OpenGL was not asked for")
    if platform_name in PLATFORMS_WITHOUT_OPENGL:
        return _without_opengl(wanted, tr("the platform {platform!r} has no OpenGL", platform=platform_name), "")
    return _judge(wanted, probe())


def _judge(wanted: str, probe: OpenGLProbe) -> Choice:
    details = "OpenGL {}.{}, {}".format(*probe.version, probe.renderer) if probe.current else ""
    for holds, obstacle in _OBSTACLES:
        if holds(probe):
            return _without_opengl(wanted, tr(obstacle), details)
    if not is_software(probe):
        return Choice("gl", tr("OpenGL draws on the graphics card."), details, _SAMPLES)
    if wanted == "gl":
        return Choice("gl", tr("OpenGL draws in software, as wished."), details)
    return Choice("painter", tr("The painter draws: OpenGL is only emulated here, and the painter is faster."), details)


def _without_opengl(wanted: str, obstacle: str, details: str) -> Choice:
    if wanted == "gl":
        reason = tr("The painter draws: OpenGL was wished, but {obstacle}.", obstacle=obstacle)
    else:
        reason = tr("The painter draws: {obstacle}.", obstacle=obstacle)
    return Choice("painter", reason, details)


def renderer_factory(choice: Choice, on_change: Callable[[str], None] | None = None) -> Callable[[QWidget], Renderer]:
    """A function that makes the chosen renderer inside a parent widget.

    `on_change` is called with a sentence if OpenGL breaks while it draws and the painter takes over.
    """
    if choice.name == "painter":
        return _make_painter
    return lambda parent: ResilientRenderer(parent, choice.samples, on_change)


def _make_painter(parent: QWidget) -> Renderer:
    from rvsim.gui.renderers.painter import PainterRenderer

    return PainterRenderer(parent)


def _broken(reason: object) -> str:
    return tr("The painter draws: OpenGL failed ({reason}).", reason=reason)


class ResilientRenderer(QObject):
    """Draws with OpenGL until that breaks, then with the painter in the same place; the arm is seen either way.

    Signals:
        changed: (sentence) the painter has taken over, and why.
    """

    changed = Signal(str)

    def __init__(self, parent: QWidget, samples: int = 0, on_change: Callable[[str], None] | None = None) -> None:
        super().__init__(parent)
        self._place = QWidget(parent)
        self._place.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        QVBoxLayout(self._place).setContentsMargins(0, 0, 0, 0)
        self._scene: Scene | None = None
        self._camera: Camera | None = None
        self._report: Callable[[float], None] | None = None
        self._failure = ""
        if on_change is not None:
            self.changed.connect(on_change)
        self._renderer = self._start(samples)

    def _start(self, samples: int) -> Renderer:
        try:
            return self._show(self._make_opengl(samples))
        except Exception as error:  # a library that is missing, a driver that refuses: the painter needs neither
            self.changed.emit(_broken(error))
            return self._show(_make_painter(self._place))

    def _make_opengl(self, samples: int) -> Renderer:
        # Imported here: whoever draws with the painter never waits for OpenGL's libraries.
        from rvsim.gui.renderers.opengl import OpenGLRenderer

        renderer = OpenGLRenderer(self._place, samples)
        renderer.failed.connect(self._note)
        # Queued: a widget must not be replaced while it paints.
        renderer.failed.connect(self._fall_back, Qt.ConnectionType.QueuedConnection)
        return renderer

    def _show(self, renderer: Renderer) -> Renderer:
        self.name, self.description = renderer.name, renderer.description
        layout = self._place.layout()
        if layout is not None:
            layout.addWidget(renderer.widget())
        return renderer

    def _note(self, reason: str) -> None:
        self._failure = reason

    def _fall_back(self) -> None:
        if not self._failure:
            return
        reason, self._failure = self._failure, ""
        broken = self._renderer.widget()
        self._renderer = self._show(_make_painter(self._place))
        self._renderer.widget().show()
        broken.hide()
        broken.deleteLater()
        self._repeat()
        self.changed.emit(_broken(reason))

    def _repeat(self) -> None:
        if self._camera is not None:
            self._renderer.set_camera(self._camera)
        if self._scene is not None:
            self._renderer.set_scene(self._scene)
        if self._report is not None:
            self._renderer.on_painted(self._report)

    def widget(self) -> QWidget:
        """The widget to be put into the window; it stays the same when the painter takes over."""
        return self._place

    def set_scene(self, scene: Scene) -> None:
        """Show a scene."""
        self._scene = scene
        self._renderer.set_scene(scene)

    def set_camera(self, camera: Camera) -> None:
        """Look from somewhere else."""
        self._camera = camera
        self._renderer.set_camera(camera)

    def image(self) -> QImage:
        """The picture as it would be painted now."""
        # A place that has never been shown has not yet given its size to what is in it.
        self._renderer.widget().setGeometry(self._place.rect())
        picture = self._renderer.image()
        if self._failure:
            self._fall_back()
            picture = self._renderer.image()
        return picture

    def on_painted(self, report: Callable[[float], None]) -> None:
        """From now on `report(milliseconds)` is called after each paint with the time that it took."""
        self._report = report
        self._renderer.on_painted(report)
