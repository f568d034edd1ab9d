"""The layers of the OpenGL picture. Each keeps its items by key.

Within a layer an item that is the same object as before is left alone; another object under the same key takes over its
buffers, and a body is only moved, never built again.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from PySide6.QtGui import QMatrix4x4, QOpenGLFunctions

from rvsim.gui.renderers.opengl_binding import GL, GLGraphicsItem
from rvsim.gui.renderers.opengl_buffers import BODY_LAYOUT, STROKE_LAYOUT, Pipeline, Vertices
from rvsim.gui.renderers.opengl_meshes import Stroke, box_body, capsule_body, capsule_transform, strokes_of
from rvsim.gui.renderers.opengl_shaders import body_program, stroke_program
from rvsim.scene import Box, Camera, Capsule, Color, Dots, Polyline, Segments, Triads

Body = Capsule | Box
Line = Polyline | Segments | Dots | Triads

# A line lies one pixel before what is at the same depth, and each later one a little more.
_LIFT_PIXELS, _LIFT_STEP = 1.0, 0.1
# Dash and gap, as the painter has them [pixels].
_DASH_PERIOD = 13.0
# From this width on an opaque line looks round.
_TUBE_WIDTH = 4.0
# The shadow is drawn once for each of these widths, so that it is softer towards its rim.
_SOFTNESS = (1.5, 1.15, 0.8)
_ONTO_FLOOR = QMatrix4x4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1)


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


def _use_depth(gl: QOpenGLFunctions, wanted: bool) -> None:
    gl.glDepthFunc(GL.GL_LEQUAL)
    (gl.glEnable if wanted else gl.glDisable)(GL.GL_DEPTH_TEST)


def _blend(gl: QOpenGLFunctions) -> None:
    """Mix by alpha over an opaque picture that stays opaque."""
    gl.glEnable(GL.GL_BLEND)
    gl.glBlendFuncSeparate(GL.GL_SRC_ALPHA, GL.GL_ONE_MINUS_SRC_ALPHA, GL.GL_ONE, GL.GL_ONE_MINUS_SRC_ALPHA)


# --- bodies --------------------------------------------------------------------------------------------------------


class _Placed(NamedTuple):
    item: Body
    shape: str
    place: QMatrix4x4
    scale: tuple[float, float, float]
    stretch: float


def _place(item: Body) -> _Placed | None:
    """Where a body goes; None if it is nowhere."""
    if isinstance(item, Capsule):
        matrix, stretch = capsule_transform(item.start, item.end)
        sizes, shape = np.full(3, item.radius), "capsule"
    else:
        matrix, stretch = np.asarray(item.T_base_box, dtype=np.float64), 0.0
        sizes, shape = np.asarray(item.size, dtype=np.float64), "box"
    if not (np.isfinite(matrix).all() and np.isfinite(sizes).all()):
        return None
    return _Placed(item, shape, to_qt(matrix), (float(sizes[0]), float(sizes[1]), float(sizes[2])), stretch)


@cache
def _bodies() -> dict[str, Vertices]:
    # Shared by all views of the program: their contexts share what lies in graphics memory.
    return {"capsule": Vertices(capsule_body()), "box": Vertices(box_body())}


class BodyLayer(GLGraphicsItem):  # type: ignore[misc]
    """Capsules and boxes, all drawn from two shared unit bodies."""

    def __init__(self) -> None:
        super().__init__()
        self._placed: dict[str, _Placed] = {}
        self._pipeline: Pipeline | None = None

    def initializeGL(self) -> None:
        """Compile the program; a context made anew asks again."""
        self._pipeline = Pipeline(body_program(), BODY_LAYOUT)

    def show_items(self, items: Iterable[Body]) -> None:
        """Show exactly these."""
        old, self._placed = self._placed, {}
        for item in items:
            known = old.get(item.key)
            placed = known if known is not None and known.item is item else _place(item)
            if placed is not None:
                self._placed[item.key] = placed

    def paint(self) -> None:
        """Draw what there is into the view."""
        if self._placed and self._pipeline is not None:
            frame: Frame = self.view().frame
            self._pipeline.bind()
            self._pipeline.set_matrix("projection", frame.projection)
            self._pipeline.set_number("lit", 1.0)
            self.draw(frame, self._pipeline)
            self._pipeline.release()

    def draw(self, frame: Frame, pipeline: Pipeline) -> None:
        """Draw all bodies, hidden by what stands before them."""
        gl = frame.functions
        _use_depth(gl, True)
        gl.glDisable(GL.GL_BLEND)
        gl.glEnable(GL.GL_CULL_FACE)
        self._draw_each(frame, pipeline)
        gl.glDisable(GL.GL_CULL_FACE)

    def _draw_each(self, frame: Frame, pipeline: Pipeline) -> None:
        for shape, vertices in _bodies().items():
            placed = [body for body in self._placed.values() if body.shape == shape]
            if placed:
                pipeline.read_from(vertices)
                pipeline.set_number("gloss", 1.0 if shape == "capsule" else 0.3)
            for body in placed:
                pipeline.set_matrix("model_view", frame.view * body.place)
                pipeline.set_vector("scale", *body.scale)
                pipeline.set_number("stretch", body.stretch)
                pipeline.set_color("color", body.item.color)
                frame.functions.glDrawArrays(GL.GL_TRIANGLES, 0, vertices.count)


class PlateLayer(BodyLayer):
    """The floor's plate: under everything, in its own colour whatever the light."""

    def draw(self, frame: Frame, pipeline: Pipeline) -> None:
        """Draw without a depth, so that nothing is hidden by the floor."""
        _use_depth(frame.functions, False)
        frame.functions.glDisable(GL.GL_BLEND)
        pipeline.set_number("lit", 0.0)
        self._draw_each(frame, pipeline)


class GhostLayer(BodyLayer):
    """Translucent bodies behind all others. Only their fronts are seen: each arm is one smooth veil."""

    def draw(self, frame: Frame, pipeline: Pipeline) -> None:
        """Draw into the depth buffer first, then what is nearest, then forget the depth."""
        gl = frame.functions
        gl.glColorMask(False, False, False, False)
        super().draw(frame, pipeline)
        gl.glColorMask(True, True, True, True)
        gl.glEnable(GL.GL_CULL_FACE)
        _blend(gl)
        self._draw_each(frame, pipeline)
        gl.glDisable(GL.GL_CULL_FACE)
        gl.glClear(GL.GL_DEPTH_BUFFER_BIT)


class ShadowLayer(BodyLayer):
    """The soft shadow of the bodies on the floor, as if the light stood right above."""

    def __init__(self) -> None:
        super().__init__()
        self._color = Color(0.0, 0.0, 0.0)

    def show_shadow(self, items: Sequence[Body], color: Color) -> None:
        """Show the shadow of exactly these."""
        self._color = color.faded(1.0 / len(_SOFTNESS))
        self.show_items(items)

    def draw(self, frame: Frame, pipeline: Pipeline) -> None:
        """Draw all bodies flat; the stencil lets each width darken a pixel once."""
        gl = frame.functions
        _use_depth(gl, False)
        _blend(gl)
        gl.glEnable(GL.GL_STENCIL_TEST)
        gl.glClear(GL.GL_STENCIL_BUFFER_BIT)
        gl.glStencilOp(GL.GL_KEEP, GL.GL_KEEP, GL.GL_INCR)
        pipeline.set_number("lit", 0.0)
        pipeline.set_color("color", self._color)
        for order, width in enumerate(_SOFTNESS):
            gl.glStencilFunc(GL.GL_EQUAL, order, 0xFF)
            self._draw_flat(frame, pipeline, width)
        gl.glDisable(GL.GL_STENCIL_TEST)

    def _draw_flat(self, frame: Frame, pipeline: Pipeline, width: float) -> None:
        on_floor = frame.view * _ONTO_FLOOR
        for body in self._placed.values():
            vertices = _bodies()[body.shape]
            wider = width if body.shape == "capsule" else 0.75 + 0.25 * width
            pipeline.read_from(vertices)
            pipeline.set_matrix("model_view", on_floor * body.place)
            pipeline.set_vector("scale", *(wider * edge for edge in body.scale))
            pipeline.set_number("stretch", body.stretch)
            frame.functions.glDrawArrays(GL.GL_TRIANGLES, 0, vertices.count)


# --- lines and dots ------------------------------------------------------------------------------------------------


class _Drawn(NamedTuple):
    item: Line
    strokes: tuple[Stroke, ...]
    vertices: tuple[Vertices, ...]


def _upload(item: Line, known: _Drawn | None, background: Color) -> _Drawn:
    strokes = strokes_of(item, background)
    if known is None or len(known.vertices) != len(strokes):
        return _Drawn(item, strokes, tuple(Vertices(stroke.vertices) for stroke in strokes))
    for vertices, stroke in zip(known.vertices, strokes, strict=True):
        vertices.replace(stroke.vertices)
    return _Drawn(item, strokes, known.vertices)


class StrokeLayer(GLGraphicsItem):  # type: ignore[misc]
    """Lines, dots and frames: widths in pixels, smooth edges.

    Args:
        use_depth: hidden by what stands before them.
        on_top: before all that was drawn until now.
    """

    def __init__(self, use_depth: bool = True, on_top: bool = False) -> None:
        super().__init__()
        self._use_depth, self._on_top = use_depth, on_top
        self._drawn: dict[str, _Drawn] = {}
        self._background: Color | None = None
        self._pipeline: Pipeline | None = None

    def initializeGL(self) -> None:
        """Compile the program; a context made anew asks again."""
        self._pipeline = Pipeline(stroke_program(), STROKE_LAYOUT)

    def show_items(self, items: Iterable[Line], background: Color) -> None:
        """Show exactly these, later ones over earlier ones of the same depth."""
        # The colours of the frames' axes depend on what they are seen against.
        old = self._drawn if background == self._background else {}
        self._drawn, self._background = {}, background
        for item in items:
            known = old.get(item.key)
            unchanged = known is not None and known.item is item
            self._drawn[item.key] = known if known is not None and unchanged else _upload(item, known, background)

    def paint(self) -> None:
        """Draw into the view."""
        self.draw(self.view().frame)

    def draw(self, frame: Frame) -> None:
        """Draw all lines, in their order, into the picture that is bound."""
        if not self._drawn or self._pipeline is None:
            return
        if self._on_top:
            frame.functions.glClear(GL.GL_DEPTH_BUFFER_BIT)
        _use_depth(frame.functions, self._use_depth)
        _blend(frame.functions)
        self._pipeline.bind()
        self._pipeline.set_matrix("view", frame.view)
        self._pipeline.set_matrix("projection", frame.projection)
        self._pipeline.set_vector("viewport", frame.width * frame.pixel_ratio, frame.height * frame.pixel_ratio)
        for order, drawn in enumerate(self._drawn.values()):
            for stroke, vertices in zip(drawn.strokes, drawn.vertices, strict=True):
                if vertices.count:
                    _draw_stroke(self._pipeline, frame, stroke, vertices, order)
        self._pipeline.release()


def _draw_stroke(pipeline: Pipeline, frame: Frame, stroke: Stroke, vertices: Vertices, order: int) -> None:
    pixel = frame.camera.metres_per_pixel(frame.height)
    width = max(stroke.width, 1.0)
    # Thinner than a pixel is drawn as fainter.
    pipeline.set_color("color", stroke.color.faded(min(stroke.width, 1.0)))
    pipeline.set_number("half_width", 0.5 * width * frame.pixel_ratio)
    pipeline.set_number("lift", pixel * (_LIFT_PIXELS + _LIFT_STEP * order + (stroke.width if stroke.is_dot else 0.0)))
    pipeline.set_number("dash", pixel * _DASH_PERIOD if stroke.dashed else 0.0)
    _set_relief(pipeline, stroke, frame.pixel_ratio)
    pipeline.read_from(vertices)
    frame.functions.glDrawArrays(GL.GL_TRIANGLES, 0, vertices.count)


def _set_relief(pipeline: Pipeline, stroke: Stroke, ratio: float) -> None:
    """A dark rim and a light spot where a line is thick enough to look round, or a dot is large enough."""
    rim, spot = (0.0, 0.0), (0.0, 0.0, 0.0, 0.0)
    if stroke.is_dot:
        radius = 0.5 * stroke.width
        rim = (0.45, 1.2)
        spot = (-0.22 * radius, 0.25 * radius, 0.15 * radius, 0.55 if radius > 4.0 else 0.0)
    elif stroke.width >= _TUBE_WIDTH and stroke.color.alpha >= 1.0 and not stroke.dashed:
        rim = (0.4, 1.0)
        spot = (-0.12 * stroke.width, 0.14 * stroke.width, 0.14 * stroke.width, 0.4)
    pipeline.set_vector("rim", rim[0], rim[1] * ratio)
    pipeline.set_vector("spot", *(ratio * size for size in spot[:3]), spot[3])
