"""The layer of lines, dots and frames. An item that is the same object as before is left alone."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from rvsim.gui.renderers.opengl_binding import GL, GLGraphicsItem
from rvsim.gui.renderers.opengl_buffers import STROKE_LAYOUT, Pipeline, Vertices
from rvsim.gui.renderers.opengl_frame import Frame, blend, use_depth
from rvsim.gui.renderers.opengl_meshes import Stroke, strokes_of
from rvsim.gui.renderers.opengl_shaders import stroke_program
from rvsim.scene import Color, Dots, Polyline, Segments, Triads

Line = Polyline | Segments | Dots | Triads

# A line lies one pixel before what is at the same depth, and each later one a little more.
_LIFT_PIXELS, _LIFT_STEP = 1.0, 0.1
# Dash and gap together, as the painter has them [pixels].
_DASH_PERIOD = 13.0
# From this width on an opaque line looks round.
_TUBE_WIDTH = 4.0


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
        use_depth(frame.functions, self._use_depth)
        blend(frame.functions)
        self._pipeline.bind()
        self._pipeline.set_matrix("view", frame.view)
        self._pipeline.set_matrix("projection", frame.projection)
        self._pipeline.set_vector("viewport", frame.width * frame.pixel_ratio, frame.height * frame.pixel_ratio)
        # What is seen through comes last and hides nothing; at the same place the opaque wins.
        self._draw_strokes(frame, self._pipeline, opaque=True)
        frame.functions.glDepthMask(False)
        self._draw_strokes(frame, self._pipeline, opaque=False)
        frame.functions.glDepthMask(True)
        self._pipeline.release()

    def _draw_strokes(self, frame: Frame, pipeline: Pipeline, opaque: bool) -> None:
        for order, drawn in enumerate(self._drawn.values()):
            for stroke, vertices in zip(drawn.strokes, drawn.vertices, strict=True):
                if vertices.count and (stroke.color.alpha >= 1.0) == opaque:
                    _set_stroke(pipeline, frame, stroke, _LIFT_PIXELS + _LIFT_STEP * order if opaque else 0.0)
                    pipeline.read_from(vertices)
                    frame.functions.glDrawArrays(GL.GL_TRIANGLES, 0, vertices.count)


def _set_stroke(pipeline: Pipeline, frame: Frame, stroke: Stroke, lift: float) -> None:
    pixel = frame.camera.metres_per_pixel(frame.height)
    width = max(stroke.width, 1.0)
    # Thinner than a pixel is drawn as fainter.
    pipeline.set_color("color", stroke.color.faded(min(stroke.width, 1.0)))
    pipeline.set_number("half_width", 0.5 * width * frame.pixel_ratio)
    # A dot is a ball: it lies before the lines that end in it.
    pipeline.set_number("lift", pixel * (lift + (stroke.width if stroke.is_dot else 0.0)))
    pipeline.set_number("dash", pixel * _DASH_PERIOD if stroke.dashed else 0.0)
    _set_relief(pipeline, stroke, frame.pixel_ratio)


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
