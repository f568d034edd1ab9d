"""What a student draws, as a path for an arm: curve, place by the arm's first line, orientation."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import ExpressionError, FormulaError, LetterError, TooManyPointsError, UnknownNameError
from rvsim.experiment import SHAPE_KINDS, Placement, Shape, TrajectoryTask
from rvsim.experiment.shapes import (
    ArcShape,
    ArcThroughShape,
    CircleShape,
    EllipseShape,
    FormulaShape,
    FormulaStage,
    PointsShape,
    PolygonShape,
    StarShape,
    TextShape,
)
from rvsim.expressions import evaluate_formula
from rvsim.lab.lines import line_presets
from rvsim.lab.named_paths import named_path
from rvsim.lab.orientations import Wanted, oriented
from rvsim.lab.planes import PLANES, laid
from rvsim.language import tr, tr_later
from rvsim.motion import Path, shapes
from rvsim.motion.lettering import text_strokes
from rvsim.motion.shapes import Drawing
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray, check_size
from rvsim.robot.edits import original_name
from rvsim.spatial import rotation_from_rpy, transform

MOST_SAMPLES = 20_001
_LARGEST = 1e9  # of lengths [m] and factors: as much as can be typed
_COORDINATES = ("x", "y", "z")


class ShapeKind(NamedTuple):
    """A kind of shape: its title, whether its numbers are places in base axes, and how it is made and drawn.

    Args:
        default: what fits an arm, of the middle (3,) and half the length [m] of its first line.
        draw: its points, about the origin of a plane (m, 2 or 3) unless they are places already.
    """

    title: str
    placed: bool
    default: Callable[[Robot, FloatArray, float], Shape]
    draw: Callable[[Any], Drawing]


def _text(shape: TextShape) -> Drawing:
    lines = text_strokes(shape.text, shape.height)
    if not lines:
        raise LetterError("")
    points = _count(lines, shape)
    if points > MOST_SAMPLES:
        raise TooManyPointsError(tr("The text"), points, MOST_SAMPLES, tr("space them wider, or write smaller letters"))
    return shapes.strokes(lines, shape.spacing, shape.lift)


def _count(lines: list[FloatArray], shape: TextShape) -> float:
    """How many points the strokes and the ways between them would have, about: known before any is made."""
    drawn = sum(float(np.linalg.norm(np.diff(line, axis=0), axis=1).sum()) for line in lines)
    hops = sum(float(np.linalg.norm(after[0] - line[-1])) + 2.0 * shape.lift for line, after in pairwise(lines))
    return (drawn + hops / shapes.HOP_STEP) / shape.spacing


def _through(shape: ArcThroughShape) -> Drawing:
    start, via, end = shape.points
    return Drawing(shapes.arc_through(start, via, end, shape.samples), np.empty(0, dtype=np.intp))


def _points(shape: PointsShape) -> Drawing:
    known = shape.points
    if shape.join == "none" or not np.any(known != known[:1]):  # nothing joins a point to itself
        return Drawing(known, np.arange(1, len(known) - 1))
    if shape.join == "lines":
        return shapes.polyline(known, shape.samples)
    return shapes.spline_curve(known, shape.samples, shape.join)


def formula_times(shape: FormulaShape) -> list[FloatArray]:
    """The moments [s] of each stage: the first with both its ends, each other one after where the last one ended."""
    begins = [shape.begin, *(stage.end for stage in shape.stages)]
    return [
        np.linspace(begin, stage.end, stage.samples + (number > 0))[int(number > 0) :]
        for number, (begin, stage) in enumerate(zip(begins[:-1], shape.stages, strict=True))
    ]


def formula_points(shape: FormulaShape) -> FloatArray:
    """(m, 3) all stages one after the other [m].

    Raises:
        FormulaError: with the stage (from 1), the coordinate, and what is wrong.
    """
    if sum(stage.samples for stage in shape.stages) > MOST_SAMPLES:
        raise FormulaError(
            len(shape.stages),
            tr("points"),
            "",
            tr("all stages together have more than {most} points", most=MOST_SAMPLES),
        )
    pieces = [
        np.column_stack([_coordinate(number, name, getattr(stage, name), t) for name in _COORDINATES])
        for number, (stage, t) in enumerate(zip(shape.stages, formula_times(shape), strict=True), 1)
    ]
    return np.concatenate(pieces) * shape.unit


def _coordinate(stage: int, name: str, text: str, t: FloatArray) -> FloatArray:
    try:
        return evaluate_formula(text, t)
    except ExpressionError as problem:
        raise FormulaError(stage, name, text, problem.reason) from None


def _formulas(shape: FormulaShape) -> Drawing:
    points = formula_points(shape)
    return Drawing(points, np.asarray(Path("formulas", points).corners))


# Source 003's two stages as it prints them, its lengths l1 = l2 = 4 and l5 = 1 put in.
SPIRAL_STAGES = (
    FormulaStage(10.0, 1001, "4 + 0*t", "4 + 0*t - 1", "0.1*t + 4"),
    FormulaStage(20.0, 1000, "4 + 1*sin(pi/2*t)", "4 + 1*cos(pi/2*t)", "0.1*t + 4"),
)


def formula_unit(robot: Robot) -> float:
    """How long one unit of typed formulas is [m]: a millimetre, or the arm's own unit."""
    return 1e-3 if robot.length_unit == "millimetre" else 1.0


def _round(value: float) -> float:
    """Two digits: a number to begin with."""
    return float(f"{value:.2g}")


def _default_formulas(robot: Robot, middle: FloatArray, half: float) -> FormulaShape:
    """Source 003's spiral for its arm; for others a straight way up and a turn of a spiral in their own reach."""
    unit = formula_unit(robot)
    if original_name(robot) == "rrrp":
        return FormulaShape(SPIRAL_STAGES, unit=unit)
    (x, y, z), r = np.round(middle / unit, 3).tolist(), _round(0.25 * half / unit)
    up = f"{z:g}" if original_name(robot) == "planar" else f"{z:g} + {_round(0.02 * r):g}*t"
    stages = (
        FormulaStage(5.0, 51, f"{x:g}", f"{y:g} + {r / 5.0:g}*t", up),
        FormulaStage(15.0, 100, f"{x:g} - {r:g}*sin(pi/5*t)", f"{y:g} - {r:g}*cos(pi/5*t)", up),
    )
    return FormulaShape(stages, unit=unit)


def _default_points(_robot: Robot, middle: FloatArray, half: float) -> PointsShape:
    rows = ((-1, -1, 0), (1, -1, 0), (1, 0, 0), (-1, 1, 0), (1, 1, 0))
    return PointsShape(np.round(middle + 0.3 * half * np.array(rows, dtype=np.float64), 3))


def _default_arc_through(_robot: Robot, middle: FloatArray, half: float) -> ArcThroughShape:
    return ArcThroughShape(np.round(middle + 0.5 * half * np.array([(0, -1, 0), (-0.6, 0, 0), (0, 1, 0)]), 3))


def _default_text(robot: Robot, _middle: FloatArray, half: float) -> TextShape:
    lift = 0.0 if original_name(robot) == "planar" else half / 12  # that arm cannot leave its plane
    return TextShape(_round(half / 3), lift=_round(lift), spacing=_round(half / 40))


SHAPES: dict[str, ShapeKind] = {
    "circle": ShapeKind(
        tr_later("Circle"),
        False,
        lambda _r, _m, half: CircleShape(_round(half / 3)),
        lambda s: shapes.circle(s.radius, s.samples),
    ),
    "arc": ShapeKind(
        tr_later("Arc"),
        False,
        lambda _r, _m, half: ArcShape(_round(half / 3)),
        lambda s: shapes.arc(s.radius, s.begin, s.sweep, s.samples),
    ),
    "arc-through": ShapeKind(tr_later("Arc through three points"), True, _default_arc_through, _through),
    "ellipse-shape": ShapeKind(
        tr_later("Ellipse"),
        False,
        lambda _r, _m, half: EllipseShape(_round(half / 3), _round(half / 5)),
        lambda s: shapes.ellipse(s.a, s.b, s.samples),
    ),
    "polygon": ShapeKind(
        tr_later("Polygon"),
        False,
        lambda _r, _m, half: PolygonShape(_round(half / 3)),
        lambda s: shapes.regular_polygon(s.corners, s.radius, s.samples),
    ),
    "star": ShapeKind(
        tr_later("Star"),
        False,
        lambda _r, _m, half: StarShape(_round(half / 3)),
        lambda s: shapes.five_pointed_star(s.radius, s.samples),
    ),
    "text": ShapeKind(tr_later("Text"), False, _default_text, _text),
    "formulas": ShapeKind(tr_later("Formulas"), True, _default_formulas, _formulas),
    "points": ShapeKind(tr_later("Points"), True, _default_points, _points),
}


FLAT_SHAPES = tuple(name for name, kind in SHAPES.items() if not kind.placed)


def is_shape(task: TrajectoryTask) -> bool:
    """Whether the task's path is a shape, not one of a source or a file."""
    return task.name in SHAPE_KINDS


def shape_of(robot: Robot, task: TrajectoryTask) -> Shape:
    """What the task draws: its own shape, or what fits the arm."""
    return SHAPES[task.name].default(robot, *_first_line(robot)) if task.shape is None else task.shape


def sampled(robot: Robot, task: TrajectoryTask, samples: int | None) -> TrajectoryTask:
    """A shape's task with that many points, as it is for None; text and formulas have their own."""
    shape = shape_of(robot, task)
    if samples is None or isinstance(shape, TextShape | FormulaShape):
        return task
    return replace(task, shape=replace(shape, samples=samples))


def placement_of(robot: Robot, task: TrajectoryTask) -> Placement:
    """Where the task's path lies: its own placement; else as its source has it, or a shape by the arm's first line."""
    if task.placement is not None:
        return task.placement
    if is_flat(task):
        middle, _ = _first_line(robot)
        return Placement(middle, np.array([0.0, 0.0, level_yaw(task.name, middle)]))
    return Placement(_unplaced(robot, task, None).middle, np.zeros(3))


def level_yaw(name: str, middle: FloatArray) -> float:
    """How a level shape is turned at first [rad]: letters so that somebody who faces the arm can read them."""
    return math.atan2(middle[1], middle[0]) + math.pi / 2 if name == "text" else 0.0


def in_plane(robot: Robot, task: TrajectoryTask, plane: str) -> TrajectoryTask:
    """A flat shape's task in a plane of `PLANES`, its middle where it is.

    Raises:
        UnknownNameError: no such plane, or no flat shape.
    """
    if plane not in PLANES:
        raise UnknownNameError(tr_later("plane"), plane, tuple(PLANES))
    if not is_flat(task):
        raise UnknownNameError(tr_later("flat shape"), task.name, FLAT_SHAPES)
    where = placement_of(robot, task)
    return placed_task(robot, task, laid(where, plane, level_yaw(task.name, where.center)))


def is_flat(task: TrajectoryTask) -> bool:
    """Whether it draws a shape in a plane that can be chosen."""
    return task.name in FLAT_SHAPES


def task_path(robot: Robot, task: TrajectoryTask, q: ArrayLike | None = None) -> Path:
    """The path of an experiment's trajectory, placed and with its orientation.

    Args:
        q: (n,) the present pose, whose orientation some paths keep or begin with; None for home.

    Raises:
        UnknownNameError: no such path.
        LetterError, TooManyPointsError: a text that cannot be written, or that is too finely drawn.
        FormulaError: a formula that cannot be worked out.
        ShapeError: a shape without points.
        TooLargeError: a shape, or where it is put, beyond any arm.
        PathFileError, OSError: a file that cannot be read.
    """
    own = line_presets(robot)[0].orientation if is_shape(task) else "source"
    orientation = own if task.orientation == "source" else task.orientation
    path = _placed(robot, task, q)
    if orientation == "source":
        return path
    wanted = Wanted(task.turn_from, task.turn_to, task.pitch, plane_normal(robot, task))
    return oriented(robot, path, orientation, None, q, wanted)


def plane_normal(robot: Robot, task: TrajectoryTask) -> FloatArray | None:
    """(3,) of the plane that a flat shape is drawn in; None for other paths."""
    if not is_flat(task):
        return None
    return np.asarray(rotation_from_rpy(placement_of(robot, task).rpy)[:, 2])


def _placed(robot: Robot, task: TrajectoryTask, q: ArrayLike | None) -> Path:
    if is_flat(task):
        kind, where = SHAPES[task.name], placement_of(robot, task)
        drawing = _drawn(robot, task)
        check_size(tr("placement"), (*where.center, *where.rpy, where.scale), _LARGEST)
        scaled = replace(drawing, points=where.scale * drawing.points)
        T = transform(rotation_from_rpy(where.rpy), where.center)
        return shapes.drawn_on(T, scaled, name=task.name, title=kind.title)
    path = _unplaced(robot, task, q)
    moved = task.placement
    return path if moved is None else path.placed(moved.center, rotation_from_rpy(moved.rpy), moved.scale)


def _unplaced(robot: Robot, task: TrajectoryTask, q: ArrayLike | None) -> Path:
    if not is_shape(task):
        return named_path(task.name, robot, orientation="source", height=task.height, q=q)
    return shapes.drawn_on(np.eye(4), _drawn(robot, task), name=task.name, title=SHAPES[task.name].title)


def _drawn(robot: Robot, task: TrajectoryTask) -> Drawing:
    """What the task's shape draws, in the plane or where it is."""
    shape = shape_of(robot, task)
    for name, value in vars(shape).items():
        if isinstance(value, float | np.ndarray):
            check_size(name, value, _LARGEST)
    return SHAPES[task.name].draw(shape)


def _first_line(robot: Robot) -> tuple[FloatArray, float]:
    """The middle (3,) and half the length of the arm's first line [m]."""
    preset = line_presets(robot)[0]
    return 0.5 * (preset.start + preset.end), 0.5 * float(np.linalg.norm(preset.end - preset.start))


def placed_task(robot: Robot, task: TrajectoryTask, placement: Placement) -> TrajectoryTask:
    """The task with its path there; points that were typed are moved themselves, so that their table stays true."""
    shape = shape_of(robot, task) if is_shape(task) else None
    if not isinstance(shape, PointsShape | ArcThroughShape):
        return replace(task, placement=placement)
    R, middle = rotation_from_rpy(placement.rpy), placement_of(robot, task).center
    points = placement.center + placement.scale * (shape.points - middle) @ R.T
    return replace(task, shape=replace(shape, points=points), placement=None)
