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
from rvsim.experiment.notes import NO_NOTES, Notes
from rvsim.experiment.session_state import CameraView, DeviceSettings, SessionState, TrackedFrom, View
from rvsim.experiment.shapes import SHAPE_KINDS, Placement, Shape

__all__ = [
    "NO_LOAD",
    "NO_NOTES",
    "SHAPE_KINDS",
    "CameraView",
    "DeviceSettings",
    "Experiment",
    "LimitViolation",
    "LineTask",
    "Load",
    "NamedPose",
    "Notes",
    "PathOrientation",
    "Placement",
    "SessionState",
    "Shape",
    "TrackedFrom",
    "TrajectoryTask",
    "View",
    "WrenchAxes",
    "limit_violations",
    "random_pose",
]
