"""A second way to the tool, which shares nothing with `forward`: the product of exponentials.

    T_base_tool = e^[S1]q1 · … · e^[Sn]qn · M

S are the joints' screws and M the tool's pose, all read in base axes from the arm standing at q = 0; no DH parameter is
met again on the way. Source: Murray, Li, Sastry (1994), eq. (3.4); Lynch and Park (2017), eq. (4.14).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache, reduce
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.kinematics.dh import joint_array, joint_transforms
from rvsim.kinematics.forward import forward_kinematics
from rvsim.robot import Robot
from rvsim.robot.arrays import frozen_array
from rvsim.spatial import transform_from_twist
from rvsim.spatial.arrays import FloatArray


@dataclass(frozen=True, eq=False)
class ProductOfExponentials:
    """An arm as `screws` (n, 6), linear part first, base axes [m, 1], and the tool's zero pose `M` (4, 4)."""

    screws: FloatArray
    M: FloatArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "screws", frozen_array("screws", self.screws, (-1, 6)))
        object.__setattr__(self, "M", frozen_array("M", self.M, (4, 4)))

    def forward(self, q: FloatArray) -> FloatArray:
        """T_base_tool (..., 4, 4) of q (..., n) [rad, m]."""
        motions = transform_from_twist(self.screws * q[..., None])
        T: FloatArray = reduce(np.matmul, np.moveaxis(motions, -3, 0)) @ self.M
        return T


class ForwardDifference(NamedTuple):
    """How far the two ways are apart: `position` (...) [m], and `rotation` (...), the largest entry of |ΔR|."""

    position: FloatArray
    rotation: FloatArray


@lru_cache(maxsize=64)
def product_of_exponentials(robot: Robot) -> ProductOfExponentials:
    """The arm's screws and zero pose."""
    frames = [robot.T_base_0]
    for A in joint_transforms(robot, np.zeros(robot.dof)):
        frames.append(frames[-1] @ A)
    M = frames[-1] @ robot.T_flange_tool
    at_axis = frames[:-1] if robot.convention == "standard" else frames[1:]
    screws = [_screw(T[:3, 2], T[:3, 3], turns) for T, turns in zip(at_axis, robot.is_revolute, strict=True)]
    return ProductOfExponentials(np.array(screws), M)


def screw_axes(robot: Robot) -> FloatArray:
    """The joints' screws (n, 6) at q = 0, base axes, linear part first: (o × z, z) turning, (z, 0) sliding."""
    return product_of_exponentials(robot).screws


def forward_by_exponentials(robot: Robot, q: ArrayLike) -> FloatArray:
    """T_base_tool (..., 4, 4) of q (..., n) [rad, m], the second way.

    Raises:
        ShapeError: the last axis of q is not the number of joints.
    """
    return product_of_exponentials(robot).forward(joint_array(robot, q))


def forward_difference(robot: Robot, q: ArrayLike) -> ForwardDifference:
    """How far `forward_kinematics` and `forward_by_exponentials` are apart at q (..., n): rounding, if all is right.

    Raises:
        ShapeError: the last axis of q is not the number of joints.
    """
    difference = forward_kinematics(robot, q) - forward_by_exponentials(robot, q)
    position = np.linalg.norm(difference[..., :3, 3], axis=-1)
    rotation = np.abs(difference[..., :3, :3]).max(axis=(-2, -1))
    return ForwardDifference(np.asarray(position), np.asarray(rotation))


def _screw(axis: FloatArray, point: FloatArray, turns: bool) -> FloatArray:
    return np.concatenate([np.cross(point, axis), axis] if turns else [axis, np.zeros(3)])
