"""From the tool back to the joints: closed forms, all branches, and why not."""

from rvsim.kinematics.inverse.batch import inverse_kinematics_batch
from rvsim.kinematics.inverse.copies import LimitCopies, limit_copies, limit_margins
from rvsim.kinematics.inverse.families import branch_labels
from rvsim.kinematics.inverse.free_pitch import free_pitch_batch

__all__ = [
    "LimitCopies",
    "branch_labels",
    "free_pitch_batch",
    "inverse_kinematics_batch",
    "limit_copies",
    "limit_margins",
]
