"""The state that a session stores, as immutable values, and the edits between states."""

from rvsim.experiment.experiment import (
    Experiment,
    LimitViolation,
    LineTask,
    NamedPose,
    PathOrientation,
    TrajectoryTask,
    limit_violations,
    random_pose,
)
from rvsim.experiment.load import NO_LOAD, Load, WrenchAxes
from rvsim.experiment.shapes import SHAPE_KINDS, Placement, Shape

__all__ = [
    "NO_LOAD",
    "SHAPE_KINDS",
    "Experiment",
    "LimitViolation",
    "LineTask",
    "Load",
    "NamedPose",
    "PathOrientation",
    "Placement",
    "Shape",
    "TrajectoryTask",
    "WrenchAxes",
    "limit_violations",
    "random_pose",
]
