"""One column of the Jacobian in the scene: the joint's axis z, the arm p − o, and what they make of the tool."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rvsim.kinematics import link_transforms
from rvsim.robot import Robot
from rvsim.scene.arrows import ON_TOP, arrow_items, turn_arrow_items
from rvsim.scene.palette import ScenePalette, mixed
from rvsim.scene.points import joint_axes
from rvsim.scene.primitives import Color, Item, Label, Labels, Polyline

FloatArray = NDArray[np.float64]

VELOCITY_SCALE = 0.4  # of a second: how far along its arrow the tool would come
_KEY = f"{ON_TOP}jacobian"
_AXIS, _HEAD, _RADIUS = 0.26, 0.05, 0.08  # in sizes of the arm
_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


def frame_of_joint(robot: Robot, joint: int) -> int:
    """The number of the frame whose z is the axis of a joint (from 0): one less in the standard convention."""
    return joint if robot.convention == "standard" else joint + 1


def column_items(robot: Robot, q: ArrayLike, joint: int, speed: str, palette: ScenePalette) -> tuple[Item, ...]:
    """What is lit for the column of `joint` (from 0) at q (n,).

    Args:
        speed: the length of the linear part with its unit, for the label at the tool.
    """
    T = link_transforms(robot, q)
    frame, z = frame_of_joint(robot, joint), joint_axes(robot, T)[joint]
    o, p = T[frame, :3, 3], (T[-1] @ robot.T_flange_tool)[:3, 3]
    color, sign = Color.from_hex(robot.joints[joint].color), str(frame).translate(_SUBSCRIPTS)
    items = _axis(o, z, color, robot.size, palette)
    labels = [Label(o + _AXIS * robot.size * z, f"z{sign}", palette.text, (6.0, -8.0), 12.5)]
    if robot.joints[joint].revolute:
        items += _turning(o, p, z, robot.size, palette)
        labels += [
            Label(o + 0.4 * (p - o), f"p − o{sign}", palette.text, (9.0, -9.0), 12.5),
            _at_end(p, np.cross(z, p - o), f"z{sign} × (p − o{sign})   {speed}", palette),
        ]
    else:
        items += _arrow("v", p, 0.5 * robot.size * VELOCITY_SCALE * z, palette.actual, robot.size, palette)
        labels.append(_at_end(p, 0.5 * robot.size * z, f"z{sign}   {speed}", palette))
    return (*items, Labels(f"{_KEY}.labels", tuple(labels)))


def _axis(o: FloatArray, z: FloatArray, color: Color, size: float, palette: ScenePalette) -> list[Item]:
    line = np.stack([o - 1.5 * _AXIS * size * z, o + 1.5 * _AXIS * size * z])
    ink = mixed(color, palette.text, 0.35)  # not quite the joint's own: it would be lost before its housing
    return [
        Polyline(f"{_KEY}.line", line, ink.faded(0.9), 1.6, dashed=True),
        *_arrow("z", o, _AXIS * size * z, ink, size, palette, width=4.0),
    ]


def _turning(o: FloatArray, p: FloatArray, z: FloatArray, size: float, palette: ScenePalette) -> list[Item]:
    turn = turn_arrow_items(f"{_KEY}.w", p, z, math.radians(250.0), _RADIUS * size, palette.desired, palette, width=3.4)
    return [
        *_arrow("arm", o, p - o, palette.text, size, palette, width=2.2),
        *turn,
        *_arrow("v", p, VELOCITY_SCALE * np.cross(z, p - o), palette.actual, size, palette, width=4.0),
    ]


def _arrow(
    name: str,
    start: FloatArray,
    vector: FloatArray,
    color: Color,
    size: float,
    palette: ScenePalette,
    width: float = 3.4,
) -> tuple[Item, ...]:
    return arrow_items(f"{_KEY}.{name}", start, vector, color, palette, width=width, longest_head=_HEAD * size)


def _at_end(p: FloatArray, v: FloatArray, text: str, palette: ScenePalette) -> Label:
    return Label(p + VELOCITY_SCALE * v, text, palette.actual, (8.0, -24.0), 12.5)
