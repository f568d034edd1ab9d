"""What the Singular page draws: the lost motions, the ellipsoids at the tool, the planar arm's row of ellipses."""

from __future__ import annotations

import math
from typing import Literal, cast

import numpy as np

from rvsim.gui.panels.inspect_singular_words import ellipsoid_scale
from rvsim.kinematics import LostMotion, Singularity, ellipsoid, forward_kinematics, pose_and_jacobian
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.scene.ellipsoids import ellipsoid_items
from rvsim.scene.ghosts import Ghost, ghost_items
from rvsim.scene.lost_motions import lost_motion_items
from rvsim.scene.palette import ScenePalette
from rvsim.scene.primitives import Item

_ARROW = 0.28  # of the arm's size
_BENDS = np.deg2rad(np.arange(0.0, 181.0, 30.0))
_SMALLER = 0.5  # a row of ellipses at full size would be a tangle


def lost_items(found: Singularity, motions: tuple[LostMotion, ...], palette: ScenePalette) -> tuple[Item, ...]:
    """A double arrow for each lost motion, at the tool."""
    if not motions:
        return ()
    tip = forward_kinematics(found.robot, found.q)[:3, 3]
    size = _ARROW * found.robot.size
    return tuple(
        item
        for number, motion in enumerate(motions)
        for item in lost_motion_items(f"lost{number}", tip, motion, size, palette)
    )


def ellipsoids_at_tool(
    found: Singularity, part: str, kinds: tuple[str, ...], palette: ScenePalette
) -> tuple[Item, ...]:
    """The chosen ellipsoids about the tool origin, forces cut at the longest half axis."""
    if not kinds:
        return ()
    tip = forward_kinematics(found.robot, found.q)[:3, 3]
    return tuple(item for kind in kinds for item in _one(found.robot, found.J, tip, part, kind, palette))


def _one(robot: Robot, J: FloatArray, tip: FloatArray, part: str, kind: str, palette: ScenePalette) -> tuple[Item, ...]:
    rows = cast(Literal["linear", "angular"], part)
    shape = ellipsoid(J, rows, cast(Literal["velocity", "force"], kind))
    factor, longest, _ = ellipsoid_scale(robot, part, kind)
    radii = np.minimum(factor * shape.radii, longest if kind == "force" else np.inf)
    color = palette.desired if kind == "velocity" else palette.unreached
    return ellipsoid_items(f"ellipsoid.{kind}", tip, shape.axes, radii, color, palette)


def ellipse_row_items(robot: Robot, q: FloatArray, palette: ScenePalette) -> tuple[Item, ...]:
    """The planar arm at bends of every 30° to its present side, joint 1 as it is, each with its velocity ellipse."""
    bends = math.copysign(1.0, q[1]) * _BENDS
    bends = bends[(robot.limits[1, 0] - 1e-9 <= bends) & (bends <= robot.limits[1, 1] + 1e-9)]
    poses = np.stack([np.full(bends.shape, q[0]), bends], axis=-1)
    T, J = pose_and_jacobian(robot, poses)
    ghosts = [Ghost(f"bend{number}", "", pose, True) for number, pose in enumerate(poses)]
    ellipses = (
        item
        for number, (tip, each) in enumerate(zip(T[:, :3, 3], J, strict=True))
        for item in _row_ellipse(robot, each, tip, palette, f"ellipsoid.bend{number}")
    )
    return (*ghost_items(robot, ghosts, palette), *ellipses)


def _row_ellipse(robot: Robot, J: FloatArray, tip: FloatArray, palette: ScenePalette, key: str) -> tuple[Item, ...]:
    shape = ellipsoid(J)
    factor = _SMALLER * ellipsoid_scale(robot, "linear", "velocity").factor
    return ellipsoid_items(key, tip, shape.axes, factor * shape.radii, palette.trail, palette)
