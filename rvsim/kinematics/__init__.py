"""Where the arm is: forward kinematics, Jacobian, inverse kinematics."""

from rvsim.kinematics.dh import dh_transform, joint_transforms
from rvsim.kinematics.forward import forward_kinematics, link_transforms
from rvsim.kinematics.jacobian import jacobian

__all__ = ["dh_transform", "forward_kinematics", "jacobian", "joint_transforms", "link_transforms"]
