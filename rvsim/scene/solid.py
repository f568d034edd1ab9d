"""The solid look: the capsules and boxes of the robot file, or shells made from the DH table where it has none."""

from __future__ import annotations

from itertools import product

import numpy as np
from numpy.typing import NDArray

from rvsim.robot import BoxShape, CapsuleShape, Robot, Shape
from rvsim.scene.palette import ScenePalette, contrast, luminance, mixed
from rvsim.scene.points import frames
from rvsim.scene.primitives import Box, Capsule, Color, Item
from rvsim.scene.stick import Pose, link_polylines

FloatArray = NDArray[np.float64]

_LEAST_CONTRAST = 2.2
_HAND_RADIUS, _PALM = 0.028, 0.55  # of the arm's size; of the way to the tool point


def solid_items(pose: Pose, palette: ScenePalette, key: str, alpha: float) -> list[Item]:
    """The arm's body."""
    if not pose.robot.shapes:
        return _shells(pose, palette, key, alpha)
    T = frames(pose.robot, pose.T)
    items = [
        _solid(shape, _moved(pose, T, shape), f"{key}.solid{index}", _color(pose.robot, shape, palette).faded(alpha))
        for index, shape in enumerate(pose.robot.shapes)
    ]
    return items + _hand(pose, T, palette, key, alpha)


def _hand(pose: Pose, T: FloatArray, palette: ScenePalette, key: str, alpha: float) -> list[Item]:
    """What holds the tool point where it is away from the flange, and the robot file gives the tool no shape."""
    flange, tool = T[-2, :3, 3], T[-1, :3, 3]
    shaped = any(shape.frame > pose.robot.dof for shape in pose.robot.shapes)
    if shaped or np.linalg.norm(tool - flange) < 1e-9:
        return []
    color, size, palm = palette.gripper.faded(alpha), pose.robot.size, flange + _PALM * (tool - flange)
    return [
        Capsule(f"{key}.hand", flange, palm, _HAND_RADIUS * size, color),
        Capsule(f"{key}.hand_tip", palm, tool, 0.4 * _HAND_RADIUS * size, color),
    ]


def _moved(pose: Pose, T: FloatArray, shape: Shape) -> FloatArray:
    """The frame of a shape among T (n + 2, 4, 4); that of a finger comes with it."""
    placed: FloatArray = T[shape.frame]
    if not shape.finger or pose.robot.gripper is None:
        return placed
    middle = 0.5 * (shape.start + shape.end) if isinstance(shape, CapsuleShape) else shape.center
    moved = placed.copy()
    moved[:3, 3] += placed[:3, :3] @ pose.robot.gripper.shift(middle, pose.opening)
    return moved


def _solid(shape: Shape, T: FloatArray, key: str, color: Color) -> Item:
    rotation, origin = T[:3, :3], T[:3, 3]
    if isinstance(shape, CapsuleShape):
        return Capsule(key, rotation @ shape.start + origin, rotation @ shape.end + origin, shape.radius, color)
    return Box(key, _at(T, shape), shape.size, color)


def _at(T: FloatArray, shape: BoxShape) -> FloatArray:
    placed = T.copy()
    placed[:3, 3] += T[:3, :3] @ shape.center
    return placed


def body_points(robot: Robot, T: FloatArray) -> list[FloatArray]:
    """For each shape (k, 3) points that it never leaves, of link transforms T (m, n + 1, 4, 4) [m]."""
    placed = np.concatenate([T, T[:, -1:] @ robot.T_flange_tool], axis=1)
    return [_placed(_corners(shape), placed[:, shape.frame]) for shape in robot.shapes]


def _placed(points: FloatArray, T: FloatArray) -> FloatArray:
    turned = points @ np.swapaxes(T[:, :3, :3], 1, 2) + T[:, None, :3, 3]
    return np.asarray(turned.reshape(-1, 3))


def _corners(shape: Shape) -> FloatArray:
    """Points (k, 3) in the link's frame around a shape."""
    if isinstance(shape, CapsuleShape):
        reach = shape.radius * np.concatenate([np.eye(3), -np.eye(3)])
        return np.concatenate([shape.start + reach, shape.end + reach])
    signs = np.array(list(product((-0.5, 0.5), repeat=3)))
    return np.asarray(shape.center + signs * shape.size)


def _color(robot: Robot, shape: Shape, palette: ScenePalette) -> Color:
    """The shape's own colour; without one, that of the joint that moves it. Nothing melts into the background."""
    if shape.color:
        return _visible(Color.from_hex(shape.color), palette)
    if shape.frame == 0:
        return palette.body_dark
    return Color.from_hex(robot.joints[min(shape.frame, robot.dof) - 1].color)


def _visible(color: Color, palette: ScenePalette) -> Color:
    faint = contrast(color, palette.background) < _LEAST_CONTRAST and luminance(palette.background) < 0.5
    return mixed(color, palette.body, 0.28) if faint else color


def _shells(pose: Pose, palette: ScenePalette, key: str, alpha: float) -> list[Item]:
    """Slim bodies along the links with a housing in the joint's colour at each joint."""
    radius = 0.035 * pose.robot.size
    body = mixed(palette.body, palette.body_dark, 0.15).faded(alpha)
    items: list[Item] = [
        Capsule(f"{key}.shell{number}.{piece}", points[piece], points[piece + 1], radius, body)
        for number, (_, points) in enumerate(link_polylines(pose))
        for piece in range(len(points) - 1)
    ]
    items += _hand(pose, frames(pose.robot, pose.T), palette, key, alpha)
    return items + [
        Capsule(f"{key}.housing{index}", point, point + 1e-6, 1.35 * radius, Color.from_hex(joint.color, alpha))
        for index, (joint, point) in enumerate(zip(pose.robot.joints, pose.joints, strict=True))
    ]
