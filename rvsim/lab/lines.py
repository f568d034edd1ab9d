"""The lines that are offered for each arm: first one that the arm can draw, whole and within its limits."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rvsim.experiment import Experiment, LineTask, PathOrientation, TrajectoryTask
from rvsim.kinematics import forward_kinematics
from rvsim.lab.orientations import oriented
from rvsim.motion import Path, line_path, track
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
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
    title: str = "Within limits"
    name: str = "within-limits"


# Ours, but for the one of source 000 (decimetres there). The arms of source 003 and the planar one: in their own reach.
_LINES: dict[str, tuple[_Row, ...]] = {
    "rv-m1": (
        _Row((300, -180, 110), (300, 180, 210), "down"),
        _Row((110, 0, 130), (230, 0, 333), "down", 0.1, "Source 000", "source-000"),
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
# Directions and lengths that are tried for an arm of one's own, through the tool's place at home.
_TRIED = tuple(
    np.array(direction) * length
    for length in (0.3, 0.15, 0.06, 0.02)
    for direction in ((0.0, 1.0, 0.3), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
)


def line_presets(robot: Robot) -> tuple[LinePreset, ...]:
    """The lines offered for an arm, the one that succeeds first; for an arm of one's own, a line through its home."""
    rows = _LINES.get(robot.name)
    return tuple(map(_preset, rows)) if rows else (_found_line(robot),)


def default_experiment(robot: Robot) -> Experiment:
    """An arm at home with a line that it can draw."""
    letters = TrajectoryTask() if robot.name == "rv-m1" else TrajectoryTask("star")
    return Experiment(robot, robot.home, line_presets(robot)[0].task(), letters)


def _preset(row: _Row) -> LinePreset:
    start, end = metres_from_millimetres(row.start_mm), metres_from_millimetres(row.end_mm)
    return LinePreset(row.name, row.title, start, end, row.resolution, row.orientation)


def _found_line(robot: Robot) -> LinePreset:
    """The longest of a few lines through the tool's place at home that the arm can draw; else one to that place."""
    place = forward_kinematics(robot, robot.home)[:3, 3]
    for half in _TRIED:
        start, end = place - half * robot.size, place + half * robot.size
        for orientation in ("keep", "free"):
            preset = LinePreset("through-home", "Through home", start, end, 0.02, orientation)
            if track(robot, preset_path(robot, preset), near=robot.home).complete:
                return preset
    return LinePreset("through-home", "Through home", place, place, 0.5, "keep")


def preset_path(robot: Robot, preset: LinePreset) -> Path:
    """The path of a preset."""
    return oriented(robot, line_path(preset.start, preset.end, preset.task().samples, None), preset.orientation, None)
