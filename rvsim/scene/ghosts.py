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
from rvsim.scene.primitives import Color, Item, Label, Labels, Polyline, Segments
from rvsim.scene.stick import Pose, link_polylines, posed

FloatArray = NDArray[np.float64]

GHOST_KEY = "ghost"
_WIDTH, _ALPHA = 7.0, 0.50
_LIT_ALPHA = 0.55
_OUTSIDE_WIDTH, _OUTSIDE_ALPHA = 2.6, 0.85


class Ghost(NamedTuple):
    """One pose: its key, what is written beside it, its joints (n,), whether it keeps the limits, and is lit.

    Where the arm itself stands (`here`) only the name is drawn.
    """

    key: str
    title: str
    q: FloatArray
    within: bool
    lit: bool = False
    here: bool = False


def ghost_items(robot: Robot, ghosts: Sequence[Ghost], palette: ScenePalette, look: Look = "stick") -> tuple[Item, ...]:
    """All ghosts with their names; the lit one, keyed `ghost<key>…`, in the look of the arm and before the others.

    The others share their items, one a joint and one for all that is dashed: eight arms are drawn like one.
    """
    if not ghosts:
        return ()
    T = link_transforms(robot, np.stack([ghost.q for ghost in ghosts]))
    poses = [posed(robot, each) for each in T]
    pairs = list(zip(ghosts, poses, strict=True))
    items = [_outline(ghost, pose, palette) for ghost, pose in pairs if not (ghost.within or ghost.here)]
    items += _links([pose for ghost, pose in pairs if ghost.within and not (ghost.lit or ghost.here)], palette)
    for ghost in ghosts:
        if ghost.lit:
            key = f"{GHOST_KEY}{ghost.key}"
            items += arm_items(robot, ghost.q, palette, look=look, labels=False, key=key, alpha=_LIT_ALPHA)
    return (*items, Labels(f"{GHOST_KEY}s.names", tuple(_names(ghosts, poses, palette))))


def _links(poses: Sequence[Pose], palette: ScenePalette) -> list[Item]:
    """The links of many poses, joint by joint, and their tools."""
    pieces: dict[int, list[FloatArray]] = {}
    for pose in poses:
        tool = (pose.robot.dof, frames(pose.robot, pose.T)[-2:, :3, 3])
        for joint, points in (*link_polylines(pose), tool):
            pieces.setdefault(joint, []).append(np.repeat(points, 2, axis=0)[1:-1])
    return [
        Segments(f"{GHOST_KEY}s.link{joint}", np.concatenate(parts), _color(poses[0].robot, joint, palette), _WIDTH)
        for joint, parts in pieces.items()
    ]


def _outline(ghost: Ghost, pose: Pose, palette: ScenePalette) -> Item:
    points = np.concatenate([*(points for _, points in link_polylines(pose)), frames(pose.robot, pose.T)[-1:, :3, 3]])
    return Polyline(
        f"{GHOST_KEY}{ghost.key}.outside", points, palette.ghost.faded(_OUTSIDE_ALPHA), _OUTSIDE_WIDTH, dashed=True
    )


def _color(robot: Robot, joint: int, palette: ScenePalette) -> Color:
    if joint == robot.dof:
        return palette.gripper.faded(_ALPHA)
    own = Color.from_hex(robot.joints[joint].color) if joint >= 0 else palette.stick
    return own.faded(_ALPHA)


def _names(ghosts: Sequence[Ghost], poses: Sequence[Pose], palette: ScenePalette) -> list[Label]:
    """Each ghost's name where the ghost is farthest from the others; ghosts at one place share their names."""
    near = 0.06 * poses[0].robot.size
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
    return Label(place, " ".join(ghost.title for ghost in ghosts), color, (8.0, -8.0), 16.0 if lit else 13.0)


def _own_place(index: int, poses: Sequence[Pose]) -> FloatArray:
    """Where a ghost is farthest from all others, but for those that look just like it."""
    points = [np.concatenate([pose.corners, pose.joints]) for pose in poses]
    own, near = points[index], 1e-3 * poses[index].robot.size
    gaps = [_gaps(own, other) for other in points]
    different = [gap for gap in gaps if gap.max() > near]
    best = int(np.argmax(np.min(different, axis=0))) if different else len(own) // 2
    return np.array(own[best], dtype=np.float64)


def _gaps(points: FloatArray, others: FloatArray) -> FloatArray:
    """(k,) how far each point (k, 3) is from the nearest of the others."""
    return np.asarray(np.linalg.norm(points[:, None] - others[None], axis=2).min(axis=1))
