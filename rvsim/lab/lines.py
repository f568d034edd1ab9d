"""The lines that are offered for each arm: first one that the arm can draw, whole and within its limits."""

from __future__ import annotations

import math
from functools import lru_cache
from itertools import product
from typing import NamedTuple

import numpy as np

from rvsim.errors import NoClosedFormError
from rvsim.experiment import Experiment, LineTask, PathOrientation, TrajectoryTask
from rvsim.kinematics import forward_kinematics
from rvsim.lab.orientations import oriented
from rvsim.language import tr_later
from rvsim.motion import Path, line_path, track
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.robot.edits import original_name
from rvsim.units import metres_from_millimetres


class LinePreset(NamedTuple):
    """A line worth tracking: start and end (3,) [m], the step as a fraction of the line, and the orientation."""

    name: str
    title: str
    start: FloatArray
    end: FloatArray
    resolution: float
    orientation: PathOrientation

    def task(self) -> LineTask:
        """What the experiment stores."""
        return LineTask(self.start, self.end, self.resolution, self.orientation)


class _Row(NamedTuple):
    start_mm: tuple[float, float, float]
    end_mm: tuple[float, float, float]
    orientation: PathOrientation
    resolution: float = 0.02
    title: str = tr_later("Within limits")
    name: str = "within-limits"


# Ours, but for the one of source 000 (decimetres there). The arms of source 003 and the planar one: in their own reach.
_LINES: dict[str, tuple[_Row, ...]] = {
    "rv-m1": (
        _Row((300, -180, 110), (300, 180, 210), "down"),
        _Row((110, 0, 130), (230, 0, 333), "down", 0.1, tr_later("Source 000"), "source-000"),
    ),
    "rv-1a": (_Row((320, -180, 150), (320, 180, 250), "down"),),
    "ur5e": (_Row((450, -350, 150), (450, 350, 450), "down"),),
    "rrrp": (_Row((4800, 3200, 4500), (4800, 4800, 5500), "free"),),
    "al5b": (_Row((180, -90, 30), (180, 90, 70), "down"),),
    "planar": (_Row((400, -150, 120), (100, 400, 120), "free"),),
    "articulated": (_Row((400, -250, 350), (400, 250, 600), "free"),),
    "spherical": (_Row((250, -250, 450), (250, 250, 700), "free"),),
    "scara": (_Row((350, -250, 180), (350, 250, 290), "down"),),
    "cylindrical": (_Row((320, -250, 220), (320, 250, 420), "free"),),
    "cartesian": (_Row((50, 50, 50), (550, 350, 220), "free"),),
}
# Half lengths [sizes of the arm] and directions that are tried for an arm of one's own.
_HALF_LENGTHS = (0.3, 0.15, 0.06, 0.02)
_DIRECTIONS = ((0.0, 1.0, 0.3), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
_ORIENTATIONS: tuple[PathOrientation, ...] = ("keep", "free")


def line_presets(robot: Robot) -> tuple[LinePreset, ...]:
    """The lines offered for an arm, the one that succeeds first; for an arm of one's own, one found by trying."""
    rows = _LINES.get(original_name(robot))
    return tuple(map(_preset, rows)) if rows else (_found_line(robot),)


def default_experiment(robot: Robot) -> Experiment:
    """An arm at home with a line that it can draw."""
    letters = TrajectoryTask() if original_name(robot) == "rv-m1" else TrajectoryTask("star")
    return Experiment(robot, robot.home, line_presets(robot)[0].task(), letters)


def _preset(row: _Row) -> LinePreset:
    start, end = metres_from_millimetres(row.start_mm), metres_from_millimetres(row.end_mm)
    return LinePreset(row.name, row.title, start, end, row.resolution, row.orientation)


@lru_cache(maxsize=8)
def _found_line(robot: Robot) -> LinePreset:
    """The longest of a few lines about the tool's place at home, or in mid-range; else one that stays at home."""
    home, middle = (forward_kinematics(robot, q)[:3, 3] for q in (robot.home, _mid_range(robot)))
    at_home = LinePreset("own", tr_later("At its home"), home, home, 0.5, "keep")
    for length, place, direction, orientation in product(_HALF_LENGTHS, (home, middle), _DIRECTIONS, _ORIENTATIONS):
        half = length * robot.size * np.array(direction)
        preset = LinePreset("own", tr_later("About its home"), place - half, place + half, 0.02, orientation)
        if _can_draw(robot, preset):
            return preset
    return at_home


def _can_draw(robot: Robot, preset: LinePreset) -> bool:
    """Asked of a few points first: most lines fail there already, and a free orientation takes its time."""
    steps = (0.25, preset.resolution)
    return all(_draws(robot, preset_path(robot, preset._replace(resolution=step))) for step in steps)


def _draws(robot: Robot, path: Path) -> bool:
    try:
        tracking = track(robot, path, near=robot.home)
    except NoClosedFormError:
        return False
    return tracking.complete and not tracking.jumps


def _mid_range(robot: Robot) -> FloatArray:
    """(n,) every joint halfway between its limits, at home where it has none."""
    bounded = [math.isfinite(joint.lower) and math.isfinite(joint.upper) for joint in robot.joints]
    finite = np.where(np.isfinite(robot.limits), robot.limits, 0.0)
    return np.where(bounded, finite.mean(axis=1), robot.home)


def preset_path(robot: Robot, preset: LinePreset) -> Path:
    """The path of a preset."""
    return oriented(robot, line_path(preset.start, preset.end, preset.task().samples, None), preset.orientation, None)
