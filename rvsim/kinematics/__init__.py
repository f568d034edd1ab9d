"""Where the arm is: forward kinematics, Jacobian, inverse kinematics."""

from rvsim.kinematics.dh import dh_transform, joint_transforms
from rvsim.kinematics.exponentials import (
    ForwardDifference,
    ProductOfExponentials,
    forward_by_exponentials,
    forward_difference,
    product_of_exponentials,
    screw_axes,
)
from rvsim.kinematics.forward import forward_kinematics, link_transforms
from rvsim.kinematics.inverse import (
    DEFAULT_ORDER,
    ORDER_CRITERIA,
    Branch,
    Failure,
    InverseResult,
    LimitCopies,
    Nearest,
    branch_labels,
    free_pitch_batch,
    inverse_branches,
    inverse_kinematics,
    inverse_kinematics_batch,
    inverse_tasks,
    limit_copies,
    limit_margins,
)
from rvsim.kinematics.jacobian import PoseAndJacobian, jacobian, pose_and_jacobian
from rvsim.kinematics.numeric import BatchResult, solve_numeric_batch

__all__ = [
    "DEFAULT_ORDER",
    "ORDER_CRITERIA",
    "BatchResult",
    "Branch",
    "Failure",
    "ForwardDifference",
    "InverseResult",
    "LimitCopies",
    "Nearest",
    "PoseAndJacobian",
    "ProductOfExponentials",
    "branch_labels",
    "dh_transform",
    "forward_by_exponentials",
    "forward_difference",
    "forward_kinematics",
    "free_pitch_batch",
    "inverse_branches",
    "inverse_kinematics",
    "inverse_kinematics_batch",
    "inverse_tasks",
    "jacobian",
    "joint_transforms",
    "limit_copies",
    "limit_margins",
    "link_transforms",
    "pose_and_jacobian",
    "product_of_exponentials",
    "screw_axes",
    "solve_numeric_batch",
]
