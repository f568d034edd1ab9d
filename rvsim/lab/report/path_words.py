"""What a path is, in sentences: what is drawn and how large, in which plane, where it begins and ends."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from rvsim.errors import RvsimError
from rvsim.experiment import TrajectoryTask
from rvsim.experiment.shapes import (
    ArcShape,
    ArcThroughShape,
    CircleShape,
    EllipseShape,
    FormulaShape,
    FormulaStage,
    PointsShape,
    PolygonShape,
    Shape,
    StarShape,
    TextShape,
)
from rvsim.lab.planes import plane_name
from rvsim.lab.report.figures import Measures
from rvsim.lab.report.study import Study
from rvsim.lab.report.values import Run, Words
from rvsim.lab.shape_paths import is_flat, is_shape, placement_of, shape_of, task_path
from rvsim.language import left_to_right, tr, tr_later, trn
from rvsim.motion import Path
from rvsim.motion.path import TOOL_DOWN
from rvsim.robot.arrays import FloatArray
from rvsim.spatial import rotation_from_rpy

_SAME = 1e-9  # [m] and of a unit axis
_PLANES = {
    "level": tr_later("It lies in a level plane."),
    "facing": tr_later("It stands upright, facing the arm."),
    "sideways": tr_later("It stands upright, sideways to the arm."),
}
_JOINED = {
    "lines": tr_later("Straight lines join the points of a table."),
    "natural": tr_later("A spline with natural ends goes through the points of a table."),
    "not-a-knot": tr_later("A not-a-knot spline goes through the points of a table."),
    "closed": tr_later("A closed spline goes through the points of a table."),
    "none": tr_later("It is the points of a table alone."),
}


def drawn_task(study: Study) -> TrajectoryTask | None:
    """The shape that the tracked path is, None where it is none, or has been changed since."""
    task, tracking = study.experiment.trajectory, study.tracking
    if tracking is None or task.name != tracking.path.name or not is_shape(task):
        return None
    try:
        points = task_path(study.robot, task, study.q).points
    except RvsimError:
        return None
    known = tracking.path.points
    return task if points.shape == known.shape and np.allclose(points, known, atol=1e-6) else None


def path_words(study: Study, path: Path, measures: Measures) -> Iterator[str]:
    """Sentences about it, without its name and the number of its points."""
    if path.name == "line":
        yield tr(
            "It is straight, from x,\u00a0y,\u00a0z\u00a0= ({start}) to ({end}) {unit}.",
            start=_place(path.points[0], measures),
            end=_place(path.points[-1], measures),
            unit=measures.length.unit,
        )
    else:
        yield from _drawn(study, measures)
        yield from _where(path, measures)
    yield from _tool(path)


def path_formulas(study: Study) -> tuple[Words, ...]:
    """The formulas of a path that is given by some, one item a stage."""
    task = drawn_task(study)
    shape = None if task is None else shape_of(study.robot, task)
    return tuple(map(_stage, shape.stages)) if isinstance(shape, FormulaShape) else ()


def _stage(stage: FormulaStage) -> Words:
    until = trn("Until t = {end} s, {n} point:", "Until t = {end} s, {n} points:", stage.samples, end=f"{stage.end:g}")
    return (Run(f"{until} "), Run(left_to_right(f"x = {stage.x}, y = {stage.y}, z = {stage.z}"), "code"))


def _drawn(study: Study, measures: Measures) -> Iterator[str]:
    task = drawn_task(study)
    if task is None:
        return
    where = placement_of(study.robot, task)
    shape = shape_of(study.robot, task)
    scale = where.scale if is_flat(task) else 1.0
    yield _SHAPES[type(shape)](shape, lambda length: measures.length.shorter(scale * length), measures)
    if is_flat(task):
        plane = plane_name(where.center, rotation_from_rpy(where.rpy))
        angles = ", ".join(measures.angle.text(float(angle), 1) for angle in where.rpy)
        turned = tr("Its plane is turned by roll, pitch, yaw = ({angles}) {unit}.", angles=angles,
                    unit=measures.angle.unit)  # fmt: skip
        yield turned if plane is None else tr(_PLANES[plane])


def _where(path: Path, measures: Measures) -> Iterator[str]:
    start, end, unit = path.points[0], path.points[-1], measures.length.unit
    middle = _place(path.middle, measures)
    if np.allclose(start, end, atol=_SAME):
        yield tr(
            "Its middle is at x,\u00a0y,\u00a0z\u00a0= ({middle}) {unit}; it begins and ends at ({start}) {unit}.",
            middle=middle,
            start=_place(start, measures),
            unit=unit,
        )
        return
    yield tr(
        "Its middle is at x,\u00a0y,\u00a0z\u00a0= ({middle}) {unit}; it begins at ({start}) {unit} "
        "and ends at ({end}) {unit}.",
        middle=middle,
        start=_place(start, measures),
        end=_place(end, measures),
        unit=unit,
    )


def _tool(path: Path) -> Iterator[str]:
    if path.rotations is None:
        yield tr("The orientation of the tool is free.")
    elif np.allclose(path.rotations[:, :, 2], TOOL_DOWN[:, 2], atol=_SAME):
        yield tr("The tool points straight down.")


def _place(point: FloatArray, measures: Measures) -> str:
    return ",\u00a0".join(measures.length.text(float(value), 1) for value in point)  # in one line


# --- one sentence a shape ------------------------------------------------------------------------------------------

Amount = Callable[[float], str]


def _circle(shape: CircleShape, amount: Amount, _measures: Measures) -> str:
    return tr("It is a circle of radius {radius}.", radius=amount(shape.radius))


def _arc(shape: ArcShape, amount: Amount, measures: Measures) -> str:
    sweep = measures.angle.amount(shape.sweep)
    return tr("It is an arc of radius {radius} over {sweep}.", radius=amount(shape.radius), sweep=sweep)


def _arc_through(shape: ArcThroughShape, _amount: Amount, measures: Measures) -> str:
    return tr(
        "It is an arc over x,\u00a0y,\u00a0z\u00a0= ({via}) {unit}.",
        via=_place(shape.points[1], measures),
        unit=measures.length.unit,
    )


def _ellipse(shape: EllipseShape, amount: Amount, _measures: Measures) -> str:
    return tr("It is an ellipse with the half axes {a} and {b}.", a=amount(shape.a), b=amount(shape.b))


def _polygon(shape: PolygonShape, amount: Amount, _measures: Measures) -> str:
    return trn(
        "It is a regular polygon with {n} corner on a circle of radius {radius}.",
        "It is a regular polygon with {n} corners on a circle of radius {radius}.",
        shape.corners,
        radius=amount(shape.radius),
    )


def _star(shape: StarShape, amount: Amount, _measures: Measures) -> str:
    return tr("It is a five-pointed star, its tips on a circle of radius {radius}.", radius=amount(shape.radius))


def _text(shape: TextShape, amount: Amount, _measures: Measures) -> str:
    if not shape.lift:
        return tr("It writes “{text}” in letters {height} high.", text=shape.text, height=amount(shape.height))
    return tr(
        "It writes “{text}” in letters {height} high; between the strokes the pen is lifted by {lift}.",
        text=shape.text,
        height=amount(shape.height),
        lift=amount(shape.lift),
    )


def _formulas(_shape: FormulaShape, _amount: Amount, _measures: Measures) -> str:
    return tr("Its places are given by formulas of the time t.")


def _points(shape: PointsShape, _amount: Amount, _measures: Measures) -> str:
    return tr(_JOINED[shape.join])


_SHAPES: dict[type[Shape], Callable[[Any, Amount, Measures], str]] = {
    CircleShape: _circle,
    ArcShape: _arc,
    ArcThroughShape: _arc_through,
    EllipseShape: _ellipse,
    PolygonShape: _polygon,
    StarShape: _star,
    TextShape: _text,
    FormulaShape: _formulas,
    PointsShape: _points,
}


# --- the title -----------------------------------------------------------------------------------------------------

_ON_A_PATH = {
    "line": (tr_later("{robot}: tracking a line"), tr_later("{robot}: tracking a line, also on the arm")),
    "text": (tr_later("{robot}: writing “{path}”"), tr_later("{robot}: writing “{path}”, also on the arm")),
    "": (tr_later("{robot}: the path “{path}”"), tr_later("{robot}: the path “{path}”, also on the arm")),
}


def path_title(study: Study, path: Path, *, ran: bool) -> str:
    """A title of what the arm did: which line or path, which letters; and whether an arm ran it."""
    task = drawn_task(study)
    shape = None if task is None else shape_of(study.robot, task)
    if path.name == "line":
        return tr(_ON_A_PATH["line"][ran], robot=tr(study.robot.title))
    if isinstance(shape, TextShape):
        return tr(_ON_A_PATH["text"][ran], robot=tr(study.robot.title), path=shape.text)
    return tr(_ON_A_PATH[""][ran], robot=tr(study.robot.title), path=tr(path.title or path.name))
