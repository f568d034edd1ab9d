"""Where the tool goes and when: path (geometry), time law, trajectory = path ∘ law, tracking (path → joints)."""

from rvsim.motion.path import TOOL_DOWN, Path, line_path, through_points
from rvsim.motion.spline import spline_points
from rvsim.motion.tracking import track
from rvsim.motion.tracking_result import Tracking, Unreached, UnreachedKind
from rvsim.motion.trajectory import Trajectory, joint_move, trajectory_of

__all__ = [
    "TOOL_DOWN",
    "Path",
    "Tracking",
    "Trajectory",
    "Unreached",
    "UnreachedKind",
    "joint_move",
    "line_path",
    "spline_points",
    "through_points",
    "track",
    "trajectory_of",
]
