"""The layers of solid bodies. An item that is the same object as before is left alone; others are only moved."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from PySide6.QtGui import QMatrix4x4

from rvsim.gui.renderers.opengl_binding import GL, GLGraphicsItem
from rvsim.gui.renderers.opengl_buffers import BODY_LAYOUT, Pipeline, Vertices
from rvsim.gui.renderers.opengl_frame import Frame, blend, to_qt, use_depth
from rvsim.gui.renderers.opengl_meshes import box_body, capsule_body, capsule_transform
from rvsim.gui.renderers.opengl_shaders import body_program
from rvsim.scene import Box, Capsule

Body = Capsule | Box

# How much darker the edges of a box are.
_EDGES = 0.1


class Placed(NamedTuple):
    """A body, which unit body it is stretched from, and how: frame, edges or radius, length."""

    item: Body
    shape: str
    place: QMatrix4x4
    scale: tuple[float, float, float]
    stretch: float


def _place(item: Body) -> Placed | None:
    """Where a body goes; None if it is nowhere."""
    if isinstance(item, Capsule):
        if not np.isfinite([*item.start, *item.end, item.radius]).all():
            return None
        matrix, stretch = capsule_transform(item.start, item.end)
        return Placed(item, "capsule", to_qt(matrix), (item.radius, item.radius, item.radius), stretch)
    if not (np.isfinite(item.T_base_box).all() and np.isfinite(item.size).all()):
        return None
    x, y, z = item.size.tolist()
    return Placed(item, "box", to_qt(item.T_base_box), (x, y, z), 0.0)


def unit_bodies() -> dict[str, Vertices]:
    """What all bodies of a view are stretched from."""
    return {"capsule": Vertices(capsule_body()), "box": Vertices(box_body())}


class BodyLayer(GLGraphicsItem):  # type: ignore[misc]
    """Capsules and boxes, all drawn from the unit bodies of their view.

    Attributes:
        placed: what is shown, by key.
    """

    def __init__(self, units: dict[str, Vertices]) -> None:
        super().__init__()
        self._units = units
        self.placed: dict[str, Placed] = {}
        self._pipeline: Pipeline | None = None

    def initializeGL(self) -> None:
        """Compile the program; a context made anew asks again."""
        self._pipeline = Pipeline(body_program(), BODY_LAYOUT)

    def show_items(self, items: Iterable[Body]) -> None:
        """Show exactly these."""
        old, self.placed = self.placed, {}
        for item in items:
            known = old.get(item.key)
            placed = known if known is not None and known.item is item else _place(item)
            if placed is not None:
                self.placed[item.key] = placed

    def paint(self) -> None:
        """Draw what there is into the view."""
        if self.placed and self._pipeline is not None:
            frame: Frame = self.view().frame
            self._pipeline.bind()
            self._pipeline.set_matrix("projection", frame.projection)
            self._pipeline.set_number("lit", 1.0)
            self.draw(frame, self._pipeline)
            self._pipeline.release()

    def draw(self, frame: Frame, pipeline: Pipeline) -> None:
        """Draw all bodies, hidden by what stands before them."""
        gl = frame.functions
        use_depth(gl, True)
        gl.glDisable(GL.GL_BLEND)
        gl.glEnable(GL.GL_CULL_FACE)
        self._draw_bodies(self.placed.values(), frame, pipeline)
        gl.glDisable(GL.GL_CULL_FACE)

    def _draw_bodies(self, bodies: Iterable[Placed], frame: Frame, pipeline: Pipeline) -> None:
        for shape, vertices in self._units.items():
            alike = [body for body in bodies if body.shape == shape]
            if alike:
                pipeline.read_from(vertices)
                pipeline.set_number("edges", 0.0 if shape == "capsule" else _EDGES)
            for body in alike:
                pipeline.set_color("color", body.item.color)
                pipeline.set_matrix("model_view", frame.view * body.place)
                pipeline.set_vector("scale", *body.scale)
                pipeline.set_number("stretch", body.stretch)
                frame.functions.glDrawArrays(GL.GL_TRIANGLES, 0, vertices.count)


class PlateLayer(BodyLayer):
    """The floor's plate: under everything, in its own colour whatever the light."""

    def draw(self, frame: Frame, pipeline: Pipeline) -> None:
        """Draw without a depth, so that nothing is hidden by the floor."""
        use_depth(frame.functions, False)
        frame.functions.glDisable(GL.GL_BLEND)
        pipeline.set_number("lit", 0.0)
        self._draw_bodies(self.placed.values(), frame, pipeline)


class GhostLayer(BodyLayer):
    """Translucent bodies behind all others: those of one alpha are seen as one pane of glass, the faintest behind."""

    def draw(self, frame: Frame, pipeline: Pipeline) -> None:
        """Draw each pane into the depth buffer first, then what of it is nearest, then forget the depth."""
        gl = frame.functions
        use_depth(gl, True)
        blend(gl)
        gl.glEnable(GL.GL_CULL_FACE)
        for alpha in sorted({body.item.color.alpha for body in self.placed.values()}):
            pane = [body for body in self.placed.values() if body.item.color.alpha == alpha]
            gl.glColorMask(False, False, False, False)
            self._draw_bodies(pane, frame, pipeline)
            gl.glColorMask(True, True, True, True)
            self._draw_bodies(pane, frame, pipeline)
            gl.glClear(GL.GL_DEPTH_BUFFER_BIT)
        gl.glDisable(GL.GL_CULL_FACE)
