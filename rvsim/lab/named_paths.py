"""The paths that have names: those of the sources, as printed and where an arm can draw them, and a few of our own."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path as FilePath
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import UnknownNameError
from rvsim.experiment import SHAPE_KINDS, LineTask, PathOrientation, TrajectoryTask
from rvsim.lab import drawings
from rvsim.lab.lines import line_presets
from rvsim.lab.orientations import SourceRotations, level_rotations, oriented
from rvsim.lab.path_file import read_path
from rvsim.language import tr_later
from rvsim.motion import Path, line_path
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.robot.edits import original_name
from rvsim.units import millimetres_from_metres


class _Wish(NamedTuple):
    """What was asked for; None where nothing was said."""

    robot: Robot
    samples: int | None
    height: float
    start: ArrayLike | None
    end: ArrayLike | None


class NamedPath(NamedTuple):
    """An entry of the table.

    Args:
        title: what people call it, in English, as are the others: `tr` says them.
        citation: where it comes from, and what is worth knowing.
        arms: the names of the arms it is meant for, () for any.
        orientation: what "source" stands for, in a word for the screen.
        draw: makes the points (m, 3) of what was asked for.
        rotations: the source's own (m, 3, 3) of points (m, 3), None for tool-down.
    """

    name: str
    title: str
    citation: str
    arms: tuple[str, ...]
    orientation: str
    draw: Callable[[_Wish], FloatArray]
    rotations: SourceRotations | None = None


def _line(wish: _Wish) -> FloatArray:
    preset = line_presets(wish.robot)[0]
    start = preset.start if wish.start is None else wish.start
    end = preset.end if wish.end is None else wish.end
    return line_path(start, end, wish.samples or preset.task().samples).points


def _star(wish: _Wish) -> FloatArray:
    """About the middle of the arm's first line, a third of its length across."""
    preset = line_presets(wish.robot)[0]
    size = float(np.linalg.norm(preset.end - preset.start))
    return drawings.star(0.5 * (preset.start + preset.end), size / 6.0, wish.samples or 101)


def _curve(draw: Callable[[int], FloatArray], samples: int) -> Callable[[_Wish], FloatArray]:
    return lambda wish: draw(wish.samples or samples)


def _scaled_letter(wish: _Wish) -> FloatArray:
    return drawings.letter_scaled(wish.samples or drawings.LETTER_SAMPLES, wish.height)


def _ellipse_rotations(points: FloatArray) -> FloatArray:
    return np.broadcast_to(drawings.ellipse_rotation(), (len(points), 3, 3))


def _upright(points: FloatArray) -> FloatArray:
    return np.broadcast_to(np.eye(3), (len(points), 3, 3))


_LETTER, _RVM1 = drawings.LETTER_SAMPLES, ("rv-m1",)
_DOWN = tr_later("tool down")
_TABLE = (
    NamedPath("line", tr_later("Line"), tr_later("A straight line, as in source 000, Program 7."), (), _DOWN, _line),
    NamedPath(
        "letter-raw",
        tr_later("Letter as printed"),
        tr_later(
            "Source 000, Program 9: the spline through twelve points in decimetres, with the parameter as height. It "
            "lies up to 7 m away; nothing of it is in reach."
        ),
        _RVM1,
        _DOWN,
        _curve(drawings.letter_raw, _LETTER),
    ),
    NamedPath(
        "letter-scaled",
        tr_later("Letter divided by 40"),
        tr_later(
            "Source 000, Program 16: the same spline divided by 40. The source gives no height; at 300 mm 21 of 50 "
            "points are in reach."
        ),
        _RVM1,
        _DOWN,
        _scaled_letter,
    ),
    NamedPath(
        "letter-flat",
        tr_later("Letter on a table"),
        tr_later(
            "Source 000's letter divided by 40 and moved to where the arm can draw all of it: x + 256 mm, y − 87 mm, "
            "on a table of 150 mm."
        ),
        _RVM1,
        _DOWN,
        _curve(drawings.letter_flat, _LETTER),
    ),
    NamedPath(
        "letter-board",
        tr_later("Letter on a board"),
        tr_later("Source 000's letter divided by 40, upright on a board at x = 340 mm, the tool level."),
        _RVM1,
        tr_later("tool level, away from the base"),
        _curve(drawings.letter_board, _LETTER),
        level_rotations,
    ),
    NamedPath(
        "ellipse",
        tr_later("Ellipse as printed"),
        tr_later(
            "Source 002: 184 points on the mounting plane, with the printed orientation made orthogonal. 70 of them "
            "are too near to the base axis for that orientation."
        ),
        ("ur5e",),
        tr_later("120° about z"),
        _curve(drawings.ellipse, drawings.ELLIPSE_SAMPLES),
        _ellipse_rotations,
    ),
    NamedPath(
        "ellipse-moved",
        tr_later("Ellipse moved"),
        tr_later("Source 002's ellipse moved by +300 mm along x and z, where all of it is in reach."),
        ("ur5e",),
        tr_later("120° about z"),
        _curve(drawings.ellipse_moved, drawings.ELLIPSE_SAMPLES),
        _ellipse_rotations,
    ),
    NamedPath(
        "spiral",
        tr_later("Spiral"),
        tr_later("Source 003: straight up, then a spiral, 2001 points in the source's unit of length."),
        ("rrrp",),
        tr_later("upright"),
        _curve(drawings.spiral, drawings.SPIRAL_SAMPLES),
        _upright,
    ),
    NamedPath(
        "star",
        tr_later("Star"),
        tr_later("A five-pointed star in one stroke, about the middle of the arm's line."),
        (),
        _DOWN,
        _star,
    ),
)
_BY_NAME = {entry.name: entry for entry in _TABLE}


def path_names(robot: Robot | None = None) -> tuple[str, ...]:
    """The names of all paths, or of those that are meant for an arm."""
    return tuple(e.name for e in _TABLE if robot is None or not e.arms or original_name(robot) in e.arms)


def path_entry(name: str) -> NamedPath:
    """The entry of that name: title, citation, arms.

    Raises:
        UnknownNameError: no such path.
    """
    if name not in _BY_NAME:
        raise UnknownNameError(tr_later("path"), name, tuple(dict.fromkeys((*path_names(), *SHAPE_KINDS))))
    return _BY_NAME[name]


def named_path(
    name: str,
    robot: Robot,
    *,
    samples: int | None = None,
    orientation: PathOrientation | None = None,
    height: float = 0.3,
    start: ArrayLike | None = None,
    end: ArrayLike | None = None,
    q: ArrayLike | None = None,
    plane: str | None = None,
) -> Path:
    """A path by its name, or through the points of a CSV file (mm, or units as the arm has) if it ends in ".csv".

    The kinds of shapes are names too: "circle", "text" … draw what fits the arm.

    Args:
        samples: the number of points; None for the source's own. A file keeps its points.
        orientation: None or "source" for the path's own: that of its source; of a line and a star that of the arm's
            first line; of a file free.
        height: of the letter divided by 40, whose source gives none [m].
        start, end: (3,) of the line [m]; None for those of the arm's first preset.
        q: (n,) the pose whose orientation "keep" keeps; None for home.
        plane: of a flat shape, "level", "facing" (upright, facing the arm) or "sideways"; None for the shape's own.

    Raises:
        UnknownNameError: no such path, orientation or plane.
        PathFileError: the file cannot be understood.
        OSError: the file cannot be read.
    """
    if plane is not None:
        return _shape(name, robot, samples, _or_own(orientation, "source"), q, plane)
    if name.lower().endswith(".csv"):
        return oriented(robot, _from_file(name, robot), _or_own(orientation, "free"), None, q)
    if name in SHAPE_KINDS and name not in _BY_NAME:
        return _shape(name, robot, samples, _or_own(orientation, "source"), q, plane)
    entry = path_entry(name)
    points = entry.draw(_Wish(robot, samples, height, start, end))
    path = Path(entry.name, points, title=entry.title, notes=entry.citation)
    return oriented(robot, path, _or_own(orientation, _own_orientation(entry, robot)), entry.rotations, q)


def line_of(robot: Robot, task: LineTask, q: ArrayLike | None = None) -> Path:
    """The path of an experiment's line. It asks for no preset: for an arm of one's own those are found by trying."""
    entry = path_entry("line")
    points = line_path(task.start, task.end, task.samples).points
    path = Path(entry.name, points, title=entry.title, notes=entry.citation)
    return oriented(robot, path, task.orientation, entry.rotations, q)


def _or_own(orientation: PathOrientation | None, own: PathOrientation) -> PathOrientation:
    return own if orientation in (None, "source") else orientation


def _own_orientation(entry: NamedPath, robot: Robot) -> PathOrientation:
    return "source" if entry.arms else line_presets(robot)[0].orientation


def _shape(
    name: str,
    robot: Robot,
    samples: int | None,
    orientation: PathOrientation,
    q: ArrayLike | None,
    plane: str | None,
) -> Path:
    from rvsim.lab.shape_paths import in_plane, sampled, task_path  # which places paths of sources too, by this module

    task = TrajectoryTask(name, orientation)
    laid = task if plane is None else in_plane(robot, task, plane)
    return task_path(robot, sampled(robot, laid, samples), q)


def _from_file(name: str, robot: Robot) -> Path:
    """A file's numbers are millimetres, but units for an arm whose lengths have no other."""
    path = read_path(name)
    points = path.points if robot.length_unit == "millimetre" else millimetres_from_metres(path.points)
    return replace(path, points=points, title=FilePath(name).name, notes=tr_later("Read from a file."))
