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
from rvsim.scene.points import link_corners
from rvsim.scene.primitives import Color, Item, Label, Labels, Polyline, Segments
from rvsim.scene.stick import Pose, posed

FloatArray = NDArray[np.float64]

GHOST_KEY = "ghost"
_WIDTH, _ALPHA = 7.0, 0.50
_LIT_ALPHA = 0.55
_OUTSIDE_WIDTH, _OUTSIDE_ALPHA = 2.6, 0.85
_MIXED = np.sqrt([2.0, 3.0, 5.0, 7.0, 11.0, 13.0])  # six numbers in one that tells them apart


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
    outside = [i for i, ghost in enumerate(ghosts) if not (ghost.within or ghost.here)]
    items = _outlines(robot, T[outside], [ghosts[i] for i in outside], palette)
    faint = [ghost.within and not (ghost.lit or ghost.here) for ghost in ghosts]
    items += _links(robot, T[faint], palette) if any(faint) else []
    for ghost in ghosts:
        if ghost.lit:
            key = f"{GHOST_KEY}{ghost.key}"
            items += arm_items(robot, ghost.q, palette, look=look, labels=False, key=key, alpha=_LIT_ALPHA)
    return (*items, Labels(f"{GHOST_KEY}s.names", tuple(_names(ghosts, poses, palette))))


def _links(robot: Robot, T: FloatArray, palette: ScenePalette) -> list[Item]:
    """The links of many poses T (b, n + 1, 4, 4), joint by joint, and their tools."""
    tools = np.stack([T[:, -1, :3, 3], (T[:, -1] @ robot.T_flange_tool)[:, :3, 3]], axis=1)
    pieces = [*_bent_links(robot, T), (robot.dof, tools)]
    return [
        Segments(
            f"{GHOST_KEY}s.link{joint}",
            _distinct([points for owner, points in pieces if owner == joint]),
            _color(robot, joint, palette),
            _WIDTH,
        )
        for joint in sorted({joint for joint, _ in pieces})
    ]


def _distinct(lines: Sequence[FloatArray]) -> FloatArray:
    """(2m, 3) the pieces of lines (b, k, 3), each once: ghosts share their bases, and see-through lines add up."""
    ends = np.concatenate([np.repeat(line, 2, axis=1)[:, 1:-1].reshape(-1, 6) for line in lines])
    long = np.abs(ends[:, :3] - ends[:, 3:]).max(axis=1) > 1e-9
    _, first = np.unique(np.round(ends[long] @ _MIXED, 7), return_index=True)
    return np.asarray(ends[long][first].reshape(-1, 3))


def _bent_links(robot: Robot, T: FloatArray) -> list[tuple[int, FloatArray]]:
    """(joint that moves it, points (b, k, 3)) for each piece, as `link_polylines` has them for one pose."""
    origins, corners = T[:, :, :3, 3], link_corners(robot, T)
    if robot.convention == "standard":
        return [(i, np.stack([origins[:, i], corners[:, i], origins[:, i + 1]], axis=1)) for i in range(robot.dof)]
    before = [(i - 1, np.stack([origins[:, i], corners[:, i]], axis=1)) for i in range(robot.dof)]
    return [*before, *((i, np.stack([corners[:, i], origins[:, i + 1]], axis=1)) for i in range(robot.dof))]


def _outlines(robot: Robot, T: FloatArray, ghosts: Sequence[Ghost], palette: ScenePalette) -> list[Item]:
    """One dashed line a ghost, through all its links to its tool; T (b, n + 1, 4, 4)."""
    if not ghosts:
        return []
    origins, corners = T[:, :, :3, 3], link_corners(robot, T)
    bent = np.stack([origins[:, :-1], corners, origins[:, 1:]], axis=2).reshape(len(T), -1, 3)
    points = np.concatenate([bent, (T[:, -1:] @ robot.T_flange_tool)[..., :3, 3]], axis=1)
    moves = np.abs(np.diff(points, axis=1)).max(axis=2, initial=0.0) > 1e-9
    color = palette.ghost.faded(_OUTSIDE_ALPHA)
    return [
        Polyline(f"{GHOST_KEY}{ghost.key}.outside", line[np.append(True, moved)], color, _OUTSIDE_WIDTH, dashed=True)
        for ghost, line, moved in zip(ghosts, points, moves, strict=True)
    ]


def _color(robot: Robot, joint: int, palette: ScenePalette) -> Color:
    if joint == robot.dof:
        return palette.gripper.faded(_ALPHA)
    own = Color.from_hex(robot.joints[joint].color) if joint >= 0 else palette.stick
    return own.faded(_ALPHA)


def _names(ghosts: Sequence[Ghost], poses: Sequence[Pose], palette: ScenePalette) -> list[Label]:
    """Each ghost's name where the ghost is farthest from the others; ghosts at one place share their names."""
    near = 0.06 * poses[0].robot.size
    places: list[tuple[FloatArray, list[Ghost]]] = []
    for ghost, place in zip(ghosts, _own_places(poses), strict=True):
        shared = [names for other, names in places if float(np.abs(other - place).max()) < near]
        if shared:
            shared[0].append(ghost)
        else:
            places.append((place, [ghost]))
    return [_name(place, named, palette) for place, named in places]


def _name(place: FloatArray, ghosts: list[Ghost], palette: ScenePalette) -> Label:
    lit = any(ghost.lit for ghost in ghosts)
    color = palette.text if lit or any(ghost.within for ghost in ghosts) else palette.muted_text
    return Label(place, " ".join(ghost.title for ghost in ghosts), color, (8.0, -8.0), 16.0 if lit else 13.0)


def _own_places(poses: Sequence[Pose]) -> FloatArray:
    """(b, 3) where each ghost is farthest from all others, but for those that look just like it."""
    points = np.stack([np.concatenate([pose.corners, pose.joints]) for pose in poses])
    between = points[:, :, None, None] - points[None, None]
    gaps = np.sqrt(np.einsum("akbli,akbli->akbl", between, between)).min(axis=3)  # (b, k, b): a point to another ghost
    alike = gaps.max(axis=1) <= 1e-3 * poses[0].robot.size
    away = np.where(alike[:, None, :], np.inf, gaps).min(axis=2)
    return np.asarray(points[np.arange(len(poses)), np.argmax(away, axis=1)])
