"""Rotations and transforms. No robots here."""

from rvsim.spatial.orientation import (
    AxisAngle,
    axis_angle_from_rotation,
    rotation_from_axis_angle,
    rotation_from_rpy,
    rotation_from_zyx,
    rotation_from_zyz,
    rpy_from_rotation,
    zyx_from_rotation,
    zyz_from_rotation,
)
from rvsim.spatial.quaternions import quaternion_from_rotation, rotation_from_quaternion
from rvsim.spatial.rotation_vectors import (
    rotation_error,
    rotation_error_angle,
    rotation_from_vector,
    rotation_vector,
)
from rvsim.spatial.rotations import nearest_rotation, rot_x, rot_y, rot_z, skew
from rvsim.spatial.transforms import (
    PoseDifference,
    inverse_transform,
    pose_difference,
    transform,
    transform_from_twist,
    translation,
)

__all__ = [
    "AxisAngle",
    "PoseDifference",
    "axis_angle_from_rotation",
    "inverse_transform",
    "nearest_rotation",
    "pose_difference",
    "quaternion_from_rotation",
    "rot_x",
    "rot_y",
    "rot_z",
    "rotation_error",
    "rotation_error_angle",
    "rotation_from_axis_angle",
    "rotation_from_quaternion",
    "rotation_from_rpy",
    "rotation_from_vector",
    "rotation_from_zyx",
    "rotation_from_zyz",
    "rotation_vector",
    "rpy_from_rotation",
    "skew",
    "transform",
    "transform_from_twist",
    "translation",
    "zyx_from_rotation",
    "zyz_from_rotation",
]
