"""The points of a stick figure: where the frames, the joints and the gripper of an arm are."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rvsim.kinematics import link_transforms
from rvsim.robot import Robot

FloatArray = NDArray[np.float64]


def source_points(robot: Robot, q: ArrayLike) -> FloatArray:
    """The table of source 000's Program 3 at q (n,): origins of the n + 1 link frames, then the gripper's points [m].

    (n + 1 + k, 3), base axes; (11, 3) for the RV-M1: 6 origins and the 5 points of its gripper's U.
    """
    T = link_transforms(robot, q)
    return np.vstack([T[:, :3, 3], gripper_points(robot, T)])


def gripper_points(robot: Robot, T: FloatArray, opening: float = 1.0) -> FloatArray:
    """(k, 3) the gripper's outline at link transforms T (n + 1, 4, 4), base axes [m]; k = 0 without a gripper.

    `opening` is 0 (closed) … 1 (open).
    """
    if robot.gripper is None:
        return np.empty((0, 3))
    points = robot.gripper.points + robot.gripper.shift(robot.gripper.points, opening)
    return np.asarray(points @ T[-1, :3, :3].T + T[-1, :3, 3])


def frames(robot: Robot, T: FloatArray) -> FloatArray:
    """(n + 2, 4, 4) the base, every link, and the tool, of link transforms T (n + 1, 4, 4)."""
    return np.concatenate([T, (T[-1] @ robot.T_flange_tool)[None]])


def link_corners(robot: Robot, T: FloatArray) -> FloatArray:
    """(…, n, 3) where each DH row turns from its d into its a (standard) or from its a into its d (modified) [m].

    Of link transforms T (…, n + 1, 4, 4). A link drawn over this corner looks like the arm, where the straight line
    between two origins would not.
    """
    a = robot.dh[:, 2, None]
    if robot.convention == "standard":
        return np.asarray(T[..., 1:, :3, 3] - a * T[..., 1:, :3, 0])
    return np.asarray(T[..., :-1, :3, 3] + a * T[..., :-1, :3, 0])


def joint_points(robot: Robot, T: FloatArray, corners: FloatArray) -> FloatArray:
    """(n, 3) a point on each joint's axis, where the figure shows the joint [m]."""
    return T[:-1, :3, 3] if robot.convention == "standard" else corners


def joint_axes(robot: Robot, T: FloatArray) -> FloatArray:
    """(n, 3) the unit vector of each joint's axis: z of frame i − 1 (standard) or of frame i (modified)."""
    return np.asarray(T[:-1, :3, 2] if robot.convention == "standard" else T[1:, :3, 2])
