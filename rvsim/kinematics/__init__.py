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
from rvsim.kinematics.inverse import branch_labels, free_pitch_batch, inverse_kinematics_batch, limit_copies
from rvsim.kinematics.jacobian import PoseAndJacobian, jacobian, pose_and_jacobian

__all__ = [
    "ForwardDifference",
    "PoseAndJacobian",
    "ProductOfExponentials",
    "branch_labels",
    "dh_transform",
    "forward_by_exponentials",
    "forward_difference",
    "forward_kinematics",
    "free_pitch_batch",
    "inverse_kinematics_batch",
    "jacobian",
    "joint_transforms",
    "limit_copies",
    "link_transforms",
    "pose_and_jacobian",
    "product_of_exponentials",
    "screw_axes",
]
