"""From the tool back to the joints: closed forms, all branches, and why not."""

from rvsim.kinematics.inverse.batch import inverse_kinematics_batch, nearest_feasible_poses
from rvsim.kinematics.inverse.copies import LimitCopies, limit_copies, limit_margins
from rvsim.kinematics.inverse.families import branch_labels
from rvsim.kinematics.inverse.free_pitch import free_pitch_batch
from rvsim.kinematics.inverse.result import DEFAULT_ORDER, ORDER_CRITERIA, Branch, Failure, InverseResult, Nearest
from rvsim.kinematics.inverse.solve import inverse_branches, inverse_kinematics, inverse_tasks
from rvsim.kinematics.inverse.words import branch_title

__all__ = [
    "DEFAULT_ORDER",
    "ORDER_CRITERIA",
    "Branch",
    "Failure",
    "InverseResult",
    "LimitCopies",
    "Nearest",
    "branch_labels",
    "branch_title",
    "free_pitch_batch",
    "inverse_branches",
    "inverse_kinematics",
    "inverse_kinematics_batch",
    "inverse_tasks",
    "limit_copies",
    "limit_margins",
    "nearest_feasible_poses",
]
