"""From an arm and its pose to a scene. Pure functions; what does not move is the same object in every frame."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rvsim.kinematics import link_transforms
from rvsim.language import tr
from rvsim.robot import Robot
from rvsim.scene.floor import Extent, floor_items
from rvsim.scene.palette import ScenePalette
from rvsim.scene.points import frames
from rvsim.scene.primitives import Item, Labels, Scene, Triads
from rvsim.scene.solid import body_points, solid_items
from rvsim.scene.stick import LINK_WIDTH, Pose, joint_labels, posed, stick_items

FloatArray = NDArray[np.float64]
Look = Literal["stick", "solid", "both"]
LOOKS: tuple[Look, ...] = ("stick", "solid", "both")

_SEE_THROUGH = 0.45  # how opaque the body is when the figure inside is to be seen as well
_SAMPLES = 1024
_BELOW = 0.08


@dataclass(frozen=True)
class SceneOptions:
    """What of the scene is switched on, and the unit of the floor's numbers (an arm without one keeps its own)."""

    look: Look = "solid"
    frames: bool = False
    labels: bool = True
    floor: bool = True
    length_unit: Literal["mm", "m"] = "mm"


def compose(
    robot: Robot,
    q: ArrayLike,
    palette: ScenePalette,
    options: SceneOptions | None = None,
    extras: Iterable[Item] = (),
    *,
    opening: float = 1.0,
) -> Scene:
    """The arm at q (n,) on its floor, with more items (paths, trails, ghosts) if given.

    Args:
        opening: of the gripper, 0 (closed) … 1 (open).
    """
    chosen = options or SceneOptions()
    unit = tr("unit") if robot.length_unit == "unit" else chosen.length_unit
    floor = floor_items(palette, floor_extent(robot), unit) if chosen.floor else ()
    arm = arm_items(robot, q, palette, look=chosen.look, frames=chosen.frames, labels=chosen.labels, opening=opening)
    return Scene((*floor, *extras, *arm), palette.background, scene_bounds(robot))


def arm_items(
    robot: Robot,
    q: ArrayLike,
    palette: ScenePalette,
    *,
    look: Look = "stick",
    frames: bool = False,
    labels: bool = True,
    key: str = "arm",
    alpha: float = 1.0,
    opening: float = 1.0,
) -> tuple[Item, ...]:
    """The arm at q (n,); a ghost is the same arm under another key with a smaller alpha and no labels."""
    pose = posed(robot, link_transforms(robot, q), opening)
    items: list[Item] = []
    if look != "stick":
        items += solid_items(pose, palette, key, alpha if look == "solid" else _SEE_THROUGH * alpha)
    if look != "solid":
        items += stick_items(pose, palette, key, alpha, LINK_WIDTH if look == "stick" else 0.7 * LINK_WIDTH)
    if frames:
        items.append(_triads(pose, key, alpha))
    if labels:
        items.append(Labels(f"{key}.labels", tuple(joint_labels(pose, palette))))
    return tuple(items)


def _triads(pose: Pose, key: str, alpha: float) -> Triads:
    return Triads(f"{key}.frames", frames(pose.robot, pose.T), 0.11 * pose.robot.size, letters=True, alpha=alpha)


@lru_cache(maxsize=32)
def scene_bounds(robot: Robot) -> FloatArray:
    """(2, 3) the box that the arm never leaves, floor included [m]: sampled within its limits, the same for each q.

    Below the floor only a little is shown: an arm without limits could turn there, but stands on a table.
    """
    T = link_transforms(robot, _poses(robot))
    points = np.concatenate([(T[:, -1] @ robot.T_flange_tool)[:, :3, 3], *body_points(robot, T)])
    points = np.concatenate([T[..., :3, 3].reshape(-1, 3), points, np.zeros((1, 3))])
    margin = 0.02 * (float(np.ptp(points, axis=0).max()) or robot.size)
    bounds: FloatArray = np.array([points.min(axis=0) - margin, points.max(axis=0) + margin])
    bounds[0, 2] = max(bounds[0, 2], -_BELOW * robot.size)
    bounds.setflags(write=False)
    return bounds


def _poses(robot: Robot) -> FloatArray:
    """(m, n) poses spread over what the joints can do; the same each time."""
    spans = np.where(robot.is_revolute, np.pi, robot.size)[:, None] * (-1.0, 1.0)
    lower, upper = np.where(np.isfinite(robot.limits), robot.limits, spans).T
    return np.random.default_rng(0).uniform(lower, upper, (_SAMPLES, robot.dof))


def floor_extent(robot: Robot) -> Extent:
    """What the floor must cover [m]: everything that the arm reaches over."""
    (x_min, y_min, _), (x_max, y_max, _) = scene_bounds(robot).tolist()
    return Extent(x_min, x_max, y_min, y_max)
