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

__all__ = [
    "Experiment",
    "LimitViolation",
    "LineTask",
    "NamedPose",
    "PathOrientation",
    "TrajectoryTask",
    "limit_violations",
    "random_pose",
]
