"""The OpenGL renderer: pyqtgraph's view with our camera, and with layers that never swallow an error."""

from __future__ import annotations

from collections.abc import Callable
from time import perf_counter
from typing import NamedTuple

import numpy as np
from PySide6.QtCore import QRect, Qt, QTimer, Signal
from PySide6.QtGui import QImage, QMatrix4x4, QOpenGLContext, QSurfaceFormat
from PySide6.QtOpenGL import QOpenGLFramebufferObject, QOpenGLFramebufferObjectFormat
from PySide6.QtWidgets import QWidget

from rvsim.errors import RvsimError
from rvsim.gui.renderers.opengl_binding import GL, GLViewWidget
from rvsim.gui.renderers.opengl_bodies import BodyLayer, GhostLayer, PlateLayer, unit_bodies
from rvsim.gui.renderers.opengl_context import probe_opengl
from rvsim.gui.renderers.opengl_frame import Frame, to_qt
from rvsim.gui.renderers.opengl_labels import LabelLayer
from rvsim.gui.renderers.opengl_shadow import ShadowLayer
from rvsim.gui.renderers.opengl_strokes import StrokeLayer
from rvsim.gui.renderers.painter_ink import qcolor
from rvsim.language import tr
from rvsim.scene import Box, Camera, Capsule, Color, Dots, Labels, Polyline, Scene, Segments, Triads
from rvsim.scene.floor import FLOOR_KEY
from rvsim.scene.gizmo import GIZMO_KEY
from rvsim.scene.palette import DARK, LIGHT, luminance

_PROOF = 16  # pixels
_PICTURE_SAMPLES = 4
_REST = 150  # milliseconds
_LINES = (Polyline, Segments, Dots)
_START = Camera(np.zeros(3), 3.0)


class NothingPaintedError(RvsimError):
    """OpenGL reports no error, and yet the picture is not there."""

    def __init__(self) -> None:
        super().__init__(tr("it reports no error but paints nothing"))


def _canvas(width: int, height: int, samples: int) -> QOpenGLFramebufferObject:
    """A picture beside the screen to paint on, of so many pixels; the context must be current."""
    form = QOpenGLFramebufferObjectFormat()
    form.setAttachment(QOpenGLFramebufferObject.Attachment.CombinedDepthStencil)
    form.setSamples(samples)
    canvas = QOpenGLFramebufferObject(max(width, 1), max(height, 1), form)
    canvas.bind()
    GL.glViewport(0, 0, width, height)
    return canvas


class _Layers(NamedTuple):
    """The picture from back to front."""

    plate: PlateLayer
    grid: StrokeLayer
    shadow: ShadowLayer
    ghosts: GhostLayer
    bodies: BodyLayer
    lines: StrokeLayer
    frames: StrokeLayer
    gizmo: StrokeLayer
    texts: LabelLayer


def _new_layers() -> _Layers:
    units = unit_bodies()
    return _Layers(
        PlateLayer(units),
        StrokeLayer(use_depth=False),
        ShadowLayer(units),
        GhostLayer(units),
        BodyLayer(units),
        StrokeLayer(),
        StrokeLayer(on_top=True),
        StrokeLayer(use_depth=False),
        LabelLayer(),
    )


def _shadow_color(background: Color) -> Color:
    return (LIGHT if luminance(background) > 0.5 else DARK).shadow


class OpenGLView(GLViewWidget):  # type: ignore[misc]
    """The widget: transparent to the mouse, in the background colour of its scene.

    Signals:
        failed: (reason) the first error of a paint; nothing more is painted afterwards.
    """

    failed = Signal(str)

    def __init__(self, parent: QWidget | None, samples: int = 0) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._samples = samples
        self._set_format()
        self.camera = _START
        self.frame: Frame | None = None
        self._layers = _new_layers()
        for layer in self._layers:
            self.addItem(layer)
        self._broken = False
        # Without multisampling edges are rough while something moves, and smoothed when all is at rest.
        self._at_rest = False
        self._rest = QTimer(self, singleShot=True, interval=_REST)
        self._rest.timeout.connect(self._smooth)
        self._began: float | None = None
        self.report: Callable[[float], None] | None = None
        self.frameSwapped.connect(self._tell_time)

    def _set_format(self) -> None:
        surface = QSurfaceFormat(QSurfaceFormat.defaultFormat())
        surface.setSamples(self._samples)
        surface.setDepthBufferSize(24)
        self.setFormat(surface)

    def show_scene(self, scene: Scene) -> None:
        """Show a scene at the next paint."""
        background, layers = scene.background, self._layers
        floor = [item for item in scene.items if item.key.startswith(FLOOR_KEY)]
        things = [item for item in scene.items if not item.key.startswith(FLOOR_KEY)]
        bodies = [item for item in things if isinstance(item, Capsule | Box)]
        opaque = [body for body in bodies if body.color.alpha >= 1.0]
        layers.plate.show_items(item for item in floor if isinstance(item, Capsule | Box))
        layers.grid.show_items((item for item in floor if isinstance(item, _LINES)), background)
        layers.ghosts.show_items(body for body in bodies if body.color.alpha < 1.0)
        layers.bodies.show_items(opaque)
        layers.shadow.show_shadow(layers.bodies.placed if floor else {}, _shadow_color(background))
        lines = [item for item in things if isinstance(item, _LINES)]
        layers.lines.show_items((item for item in lines if not item.key.startswith(GIZMO_KEY)), background)
        layers.gizmo.show_items((item for item in lines if item.key.startswith(GIZMO_KEY)), background)
        layers.frames.show_items((item for item in things if isinstance(item, Triads)), background)
        layers.texts.show_items((item for item in scene.items if isinstance(item, Labels | Triads)), background)
        self.setBackgroundColor(qcolor(background))
        self._at_rest = False

    def look_from(self, camera: Camera) -> None:
        """Look from elsewhere at the next paint."""
        self.camera = camera
        self._at_rest = False
        self.update()

    # --- pyqtgraph's hooks -----------------------------------------------------------------------------------------

    def viewMatrix(self) -> QMatrix4x4:
        """The scene's camera instead of pyqtgraph's."""
        return to_qt(self.camera.view_matrix())

    def projectionMatrix(self, *_region_and_viewport: object) -> QMatrix4x4:
        """The scene's camera instead of pyqtgraph's; the whole picture is always drawn."""
        return to_qt(self.camera.projection_matrix(self.width(), self.height()))

    def drawItemTree(self, *_item: object, **_options: object) -> None:
        """The layers in their order. pyqtgraph would print an error and go on."""
        for layer in self.items:
            if self.default_vao.isCreated():
                self.default_vao.bind()
            layer.paint()

    def initializeGL(self) -> None:
        """Prepare the layers; also when the context has been made anew, as for a dock that is floated."""
        self._guarded(self._initialize)

    def paintGL(self) -> None:
        """Paint, and say so the first time that it fails."""
        self._began = None if self._at_rest else perf_counter()
        if not self._broken:
            self._guarded(self._paint_smoothly if self._at_rest else self._paint)
        if not self._at_rest and not self._samples:
            self._rest.start()

    def _smooth(self) -> None:
        self._at_rest = True
        self.update()

    def _paint_smoothly(self) -> None:
        width, height = self.deviceWidth(), self.deviceHeight()
        canvas = _canvas(width, height, _PICTURE_SAMPLES)
        self._paint()
        canvas.release()
        everything = QRect(0, 0, width, height)
        # Without a target it is the view's own.
        QOpenGLFramebufferObject.blitFramebuffer(None, everything, canvas, everything)  # type: ignore[call-overload]

    def _tell_time(self) -> None:
        # The window swaps frames for its other widgets too: those are not ours to report.
        if self._began is not None and self.report is not None:
            self.report(1e3 * (perf_counter() - self._began))
        self._began = None

    def _guarded(self, act: Callable[[], None]) -> None:
        # An exception must not leave a paint event: whatever the driver does, the window lives on with the painter.
        try:
            act()
        except Exception as error:
            self._broken = True
            self.failed.emit(str(error) or type(error).__name__)

    def _initialize(self) -> None:
        super().initializeGL()
        self._prove()

    def _paint(self) -> None:
        self.frame = self._frame_of(self.width(), self.height())
        self._layers.shadow.prepare(self.frame)
        self.frame.functions.glEnable(GL.GL_MULTISAMPLE)  # the texts' painter has switched it off
        try:
            super().paintGL()
        finally:
            self._let_go()

    def _let_go(self) -> None:
        """Keep no functions of the context between frames.

        They end with it, and whatever is made in their place then is taken for them: a context, for instance.
        """
        self.frame = None

    def _frame_of(self, width: int, height: int) -> Frame:
        return Frame(
            QOpenGLContext.currentContext().functions(),
            to_qt(self.camera.view_matrix()),
            to_qt(self.camera.projection_matrix(width, height)),
            self.camera,
            width,
            height,
            self.devicePixelRatioF(),
        )

    def picture(self) -> QImage:
        """What a paint would show now, smoothed even where the screen is not."""
        if not self.isValid():
            self.grabFramebuffer()  # makes the context of a widget that has never been shown
        self.makeCurrent()
        target = _canvas(self.deviceWidth(), self.deviceHeight(), _PICTURE_SAMPLES)
        self._guarded(self._paint)
        target.release()
        picture = target.toImage().convertToFormat(QImage.Format.Format_RGB32)
        picture.setDevicePixelRatio(self.devicePixelRatioF())
        self.doneCurrent()
        return picture

    def _prove(self) -> None:
        """Paint a white dot on black beside the screen and look at it: drivers may fail without an error."""
        target = _canvas(_PROOF, _PROOF, 0)
        self.frame = self._frame_of(_PROOF, _PROOF)._replace(pixel_ratio=1.0)
        GL.glClearColor(0.0, 0.0, 0.0, 1.0)
        GL.glClear(GL.GL_COLOR_BUFFER_BIT | GL.GL_DEPTH_BUFFER_BIT)
        dot = StrokeLayer()
        dot.initialize()
        dot.show_items(
            [Dots("proof", self.camera.target[None], Color(1.0, 1.0, 1.0), _PROOF / 2)], Color(0.0, 0.0, 0.0)
        )
        dot.draw(self.frame)
        self._let_go()
        target.release()
        picture = target.toImage()
        if picture.pixelColor(_PROOF // 2, _PROOF // 2).red() < 250 or picture.pixelColor(0, 0).red() > 5:
            raise NothingPaintedError


class OpenGLRenderer:
    """Draws a scene with OpenGL.

    Args:
        samples: subpixels for smooth edges; 0 where the processor draws, which they would slow down fivefold.

    Attributes:
        failed: signal (reason), emitted once if painting breaks; another renderer should then take over.
    """

    def __init__(self, parent: QWidget | None = None, samples: int = 0) -> None:
        self._view = OpenGLView(parent, samples)
        probe = probe_opengl()
        self.name = "opengl"
        self.description = "OpenGL {}.{}, {}".format(*probe.version, probe.renderer)
        self.failed = self._view.failed

    def widget(self) -> QWidget:
        """The widget that shows the scene."""
        return self._view

    def set_scene(self, scene: Scene) -> None:
        """Show another scene at the next paint; several calls before it cost one paint."""
        self._view.show_scene(scene)

    def set_camera(self, camera: Camera) -> None:
        """Look from elsewhere at the next paint."""
        self._view.look_from(camera)

    def image(self) -> QImage:
        """The picture as it would be painted now, texts included, in the pixels of the screen, with smooth edges."""
        return self._view.picture()

    def on_painted(self, report: Callable[[float], None]) -> None:
        """From now on `report(milliseconds)` is called after each frame: from the first call until it is shown."""
        self._view.report = report
