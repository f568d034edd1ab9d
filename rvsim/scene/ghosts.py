"""Ghosts: the other poses of an arm, translucent. One that breaks a limit is grey and dashed; one may be lit."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rvsim.kinematics import link_transforms
from rvsim.robot import Robot
from rvsim.scene.build import Look, arm_items
from rvsim.scene.palette import ScenePalette
from rvsim.scene.points import frames
from rvsim.scene.primitives import Color, Dots, Item, Label, Labels, Polyline
from rvsim.scene.stick import Pose, link_polylines, posed

FloatArray = NDArray[np.float64]

GHOST_KEY = "ghost"
_WIDTH, _ALPHA = 7.0, 0.50
_LIT_ALPHA = 0.55
_OUTSIDE_WIDTH, _OUTSIDE_ALPHA = 2.6, 0.85


class Ghost(NamedTuple):
    """One pose: what it is called in scene and table, its joints (n,), whether it keeps the limits, and is lit."""

    name: str
    q: FloatArray
    within: bool
    lit: bool = False


def ghost_items(robot: Robot, ghosts: Sequence[Ghost], palette: ScenePalette, look: Look = "stick") -> tuple[Item, ...]:
    """All ghosts, keyed `ghost<name>…`, with their names; the lit one in the look of the arm and before the others."""
    if not ghosts:
        return ()
    T = link_transforms(robot, np.stack([ghost.q for ghost in ghosts]))
    poses = [posed(robot, each) for each in T]
    items: list[Item] = []
    for ghost, pose in sorted(zip(ghosts, poses, strict=True), key=lambda pair: pair[0].lit):
        items += _lit(robot, ghost, palette, look) if ghost.lit else _faint(ghost, pose, palette)
    return (*items, Labels(f"{GHOST_KEY}s.names", tuple(_names(ghosts, poses, palette))))


def _lit(robot: Robot, ghost: Ghost, palette: ScenePalette, look: Look) -> list[Item]:
    key = f"{GHOST_KEY}{ghost.name}"
    items = list(arm_items(robot, ghost.q, palette, look=look, labels=False, key=key, alpha=_LIT_ALPHA))
    return items if ghost.within else [*items, _outline(key, posed(robot, link_transforms(robot, ghost.q)), palette)]


def _faint(ghost: Ghost, pose: Pose, palette: ScenePalette) -> list[Item]:
    key = f"{GHOST_KEY}{ghost.name}"
    if not ghost.within:
        return [_outline(key, pose, palette)]
    items: list[Item] = [
        Polyline(f"{key}.link{index}", points, _link_color(pose.robot, joint, palette), _WIDTH)
        for index, (joint, points) in enumerate(link_polylines(pose))
    ]
    tip = frames(pose.robot, pose.T)[-2:, :3, 3]
    if np.ptp(tip, axis=0).max() > 1e-9:
        items.append(Polyline(f"{key}.tool", tip, palette.gripper.faded(_ALPHA), 0.6 * _WIDTH))
    return [*items, Dots(f"{key}.joints", pose.joints, palette.ghost.faded(0.8), 6.0)]


def _outline(key: str, pose: Pose, palette: ScenePalette) -> Item:
    points = np.concatenate([*(points for _, points in link_polylines(pose)), frames(pose.robot, pose.T)[-1:, :3, 3]])
    return Polyline(f"{key}.outside", points, palette.ghost.faded(_OUTSIDE_ALPHA), _OUTSIDE_WIDTH, dashed=True)


def _link_color(robot: Robot, joint: int, palette: ScenePalette) -> Color:
    own = Color.from_hex(robot.joints[joint].color) if joint >= 0 else palette.stick
    return own.faded(_ALPHA)


def _names(ghosts: Sequence[Ghost], poses: Sequence[Pose], palette: ScenePalette) -> list[Label]:
    """Each ghost's name where the ghost is farthest from the others; ghosts at one place share their names."""
    near = 0.03 * poses[0].robot.size
    places: list[tuple[FloatArray, list[Ghost]]] = []
    for index, ghost in enumerate(ghosts):
        place = _own_place(index, poses)
        shared = [names for other, names in places if np.linalg.norm(other - place) < near]
        if shared:
            shared[0].append(ghost)
        else:
            places.append((place, [ghost]))
    return [_name(place, named, palette) for place, named in places]


def _name(place: FloatArray, ghosts: list[Ghost], palette: ScenePalette) -> Label:
    lit = any(ghost.lit for ghost in ghosts)
    color = palette.text if lit or any(ghost.within for ghost in ghosts) else palette.muted_text
    return Label(place, " ".join(ghost.name for ghost in ghosts), color, (8.0, -8.0), 16.0 if lit else 13.0)


def _own_place(index: int, poses: Sequence[Pose]) -> FloatArray:
    own = np.concatenate([poses[index].corners, poses[index].joints])
    others = [pose.joints for number, pose in enumerate(poses) if number != index]
    if not others:
        return np.array(own[len(own) // 2], dtype=np.float64)
    gaps = np.linalg.norm(own[:, None] - np.concatenate(others)[None], axis=2).min(axis=1)
    return np.array(own[int(np.argmax(gaps))], dtype=np.float64)
