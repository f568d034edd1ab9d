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
from rvsim.experiment.shapes import SHAPE_KINDS, Placement, Shape

__all__ = [
    "SHAPE_KINDS",
    "Experiment",
    "LimitViolation",
    "LineTask",
    "NamedPose",
    "PathOrientation",
    "Placement",
    "Shape",
    "TrajectoryTask",
    "limit_violations",
    "random_pose",
]
