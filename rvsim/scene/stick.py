"""The stick figure: links in the joints' colours, joints as dots, the gripper's outline, rails, labels."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rvsim.robot import Robot
from rvsim.scene.floor import FLOOR_KEY
from rvsim.scene.palette import ScenePalette
from rvsim.scene.points import frames, gripper_points, joint_axes, joint_points, link_corners
from rvsim.scene.primitives import Color, Dots, Item, Label, Polyline, Segments

FloatArray = NDArray[np.float64]

LINK_WIDTH = 7.0
JOINT_SIZE = 13.0


class Pose(NamedTuple):
    """An arm in a pose, with all that both looks need: link transforms T (n + 1, 4, 4) and points derived from them.

    Its gripper is `opening` open, 0 (closed) … 1.
    """

    robot: Robot
    T: FloatArray
    corners: FloatArray  # (n, 3)
    joints: FloatArray  # (n, 3)
    opening: float = 1.0


def posed(robot: Robot, T: FloatArray, opening: float = 1.0) -> Pose:
    """The points of an arm with link transforms T (n + 1, 4, 4)."""
    corners = link_corners(robot, T)
    return Pose(robot, T, corners, joint_points(robot, T, corners), opening)


def stick_items(pose: Pose, palette: ScenePalette, key: str, alpha: float, width: float = LINK_WIDTH) -> list[Item]:
    """The whole figure."""
    lines = [
        *_shadow(pose, palette, key, alpha, width),
        *_column(pose, palette, key, alpha, width),
        *_rails(pose, palette, key, alpha),
        *_links(pose, palette, key, alpha, width),
    ]
    return [*lines, *_tool(pose, palette, key, alpha, width), *_joints(pose, palette, key, alpha, width / LINK_WIDTH)]


def link_polylines(pose: Pose) -> list[tuple[int, FloatArray]]:
    """(joint that moves it, points (k, 3)) for each piece of the figure; joint −1 is the base."""
    origins = pose.T[:, :3, 3]
    if pose.robot.convention == "standard":
        pieces = [(i, np.stack([origins[i], pose.corners[i], origins[i + 1]])) for i in range(pose.robot.dof)]
    else:
        pieces = [
            (i - 1 + part, np.stack(ends))
            for i in range(pose.robot.dof)
            for part, ends in enumerate([(origins[i], pose.corners[i]), (pose.corners[i], origins[i + 1])])
        ]
    return [(joint, points) for joint, points in pieces if np.ptp(points, axis=0).max() > 1e-9]


def _links(pose: Pose, palette: ScenePalette, key: str, alpha: float, width: float) -> list[Item]:
    return [
        Polyline(f"{key}.link{index}", points, _joint_color(pose.robot, joint, palette).faded(alpha), width)
        for index, (joint, points) in enumerate(link_polylines(pose))
    ]


def _joint_color(robot: Robot, joint: int, palette: ScenePalette) -> Color:
    return Color.from_hex(robot.joints[joint].color) if joint >= 0 else palette.stick


def _shadow(pose: Pose, palette: ScenePalette, key: str, alpha: float, width: float) -> list[Item]:
    """What a light right above would throw on the floor; it tells how high the arm is."""
    pieces = [points for _, points in link_polylines(pose)]
    if alpha < 1.0 or not pieces:  # all of a Cartesian arm lies in one point at q = 0
        return []
    points = np.concatenate(pieces)
    points[:, 2] = 1e-4 * pose.robot.size
    return [Polyline(f"{FLOOR_KEY}.{key}.shadow", points, palette.shadow, 0.8 * width)]


def _column(pose: Pose, palette: ScenePalette, key: str, alpha: float, width: float) -> list[Item]:
    """An arm whose first frame is not on the floor stands on a column."""
    origin = pose.T[0, :3, 3]
    if abs(origin[2]) < 1e-9:
        return []
    foot = origin * (1.0, 1.0, 0.0)
    return [Polyline(f"{key}.column", np.stack([foot, origin]), palette.stick.faded(alpha), width)]


def _rails(pose: Pose, palette: ScenePalette, key: str, alpha: float) -> list[Item]:
    """A thin line over the stroke of each sliding joint whose stroke is known."""
    ends = [_rail(pose, index) for index in range(pose.robot.dof) if _has_stroke(pose.robot, index)]
    return [Segments(f"{key}.rails", np.concatenate(ends), palette.muted_text.faded(0.7 * alpha), 1.0)] if ends else []


def _has_stroke(robot: Robot, index: int) -> bool:
    return not robot.joints[index].revolute and bool(np.all(np.isfinite(robot.limits[index])))


def _rail(pose: Pose, index: int) -> FloatArray:
    strokes = pose.robot.dh[index, 1] + pose.robot.limits[index]
    return np.asarray(pose.joints[index] + strokes[:, None] * joint_axes(pose.robot, pose.T)[index])


def _tool(pose: Pose, palette: ScenePalette, key: str, alpha: float, width: float) -> list[Item]:
    color = _gripper_color(pose.robot, palette).faded(alpha)
    flange, tool = frames(pose.robot, pose.T)[-2:, :3, 3]
    items: list[Item] = []
    if np.linalg.norm(tool - flange) > 1e-9:
        items.append(Polyline(f"{key}.tool", np.stack([flange, tool]), color, 0.6 * width))
    outline = gripper_points(pose.robot, pose.T, pose.opening)
    if len(outline):
        items.append(Polyline(f"{key}.gripper", outline, color, 0.6 * width))
        items.append(Dots(f"{key}.gripper_points", outline, color, 0.9 * width))
    return items


def _gripper_color(robot: Robot, palette: ScenePalette) -> Color:
    return Color.from_hex(robot.gripper.color) if robot.gripper else palette.gripper


def _joints(pose: Pose, palette: ScenePalette, key: str, alpha: float, scale: float) -> list[Item]:
    """The joints in their colours over the plain dots of the frame origins."""
    tip = frames(pose.robot, pose.T)[-1:, :3, 3]
    origins = np.concatenate([pose.T[:, :3, 3], tip])
    items: list[Item] = [Dots(f"{key}.origins", origins, palette.stick.faded(alpha), 0.6 * JOINT_SIZE * scale)]
    for index, joint in enumerate(pose.robot.joints):
        color = Color.from_hex(joint.color, alpha)
        items.append(Dots(f"{key}.joint{index + 1}", pose.joints[index : index + 1], color, JOINT_SIZE * scale))
    return items


def joint_labels(pose: Pose, palette: ScenePalette) -> list[Label]:
    """J1 … Jn beside the joints; joints at the same place share one label."""
    near = 0.01 * pose.robot.size
    places: list[tuple[FloatArray, list[str]]] = []
    for index, point in enumerate(pose.joints):
        name = f"J{index + 1}"
        if places and np.linalg.norm(places[-1][0] - point) < near:
            places[-1][1].append(name)
        else:
            places.append((point, [name]))
    return [Label(point, " ".join(names), palette.text, (11.0, -11.0), 12.5) for point, names in places]
