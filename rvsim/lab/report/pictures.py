"""The pictures of a report: scenes composed in light colours, and where the eye stands. They are painted elsewhere."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rvsim.kinematics import link_transforms
from rvsim.kinematics.inverse import Branch
from rvsim.lab.report.study import Study
from rvsim.lab.report.values import ScenePicture
from rvsim.language import tr
from rvsim.motion import Tracking
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.scene import Camera
from rvsim.scene.build import SceneOptions, compose, floor_extent
from rvsim.scene.floor import FLOOR_NUMBERS_KEY, line_distance
from rvsim.scene.ghosts import Ghost, ghost_items
from rvsim.scene.palette import LIGHT
from rvsim.scene.paths import path_items
from rvsim.scene.primitives import Item

_WIDTH, _HEIGHT = 620, 372
_TURNS = tuple(np.radians([0.0, 60.0, -60.0, 120.0, -120.0, 180.0]).tolist())
_ASIDE = 0.6  # the cosine between the way to the path and the way to the eye
_AIR = 0.04  # about what is shown, as a part of its size
_LINK = 0.12  # of the arm's size: how far its links and frames stand out above its joints


def robot_picture(study: Study) -> ScenePicture:
    """The arm in its pose, with its frames."""
    options = SceneOptions("both", frames=True, length_unit=study.units.length)
    return _picture(study, study.q, (), [study.q], options, tr("The arm with its frames."))


def floor_distance(robot: Robot) -> float:
    """How far the lines of the floor are apart in all these pictures [m]."""
    return line_distance(floor_extent(robot))


def branches_picture(study: Study, branches: Sequence[Branch]) -> ScenePicture:
    """The arm, and every other branch as a ghost with its number."""
    ghosts = [
        Ghost(str(number), str(number), branch.q, branch.within_limits, here=_same(branch.q, study.q))
        for number, branch in enumerate(branches, 1)
    ]
    options = SceneOptions("stick", labels=False, length_unit=study.units.length)
    items = ghost_items(study.robot, ghosts, LIGHT)
    return _picture(study, study.q, items, [branch.q for branch in branches], options, tr("All branches."))


def path_picture(study: Study, tracking: Tracking) -> ScenePicture:
    """The arm on its path, at three quarters of what it reached."""
    reached = np.flatnonzero(tracking.reached)
    q = tracking.q[reached[3 * len(reached) // 4]] if len(reached) else study.q
    items = path_items(
        tracking.path.points, tracking.reached, tracking.actual[reached], LIGHT, pen_up=tracking.path.pen_up
    )
    options = SceneOptions("solid", labels=False, length_unit=study.units.length)
    return _picture(study, q, items, [q], options, tr("The arm on its path."), tracking.path.points)


def _picture(
    study: Study,
    q: FloatArray,
    extras: tuple[Item, ...],
    shown: Sequence[FloatArray],
    options: SceneOptions,
    text: str,
    more: FloatArray | None = None,
) -> ScenePicture:
    composed = compose(study.robot, q, LIGHT, options, extras)
    # The edges of the floor, where its numbers stand, lie outside the picture.
    scene = replace(composed, items=tuple(item for item in composed.items if item.key != FLOOR_NUMBERS_KEY))
    camera = _before(more, _arm_points(study.robot, shown)).fitted(_box(study.robot, shown, more), _WIDTH, _HEIGHT)
    return ScenePicture(scene, camera, _WIDTH, _HEIGHT, text)


def _box(robot: Robot, poses: Sequence[FloatArray], more: FloatArray | None) -> FloatArray:
    """(2, 3) around the base and the arm in all these poses, with some air [m]."""
    points = np.concatenate([np.zeros((1, 3)), _arm_points(robot, poses), *([] if more is None else [more])])
    air = _AIR * max(float(np.ptp(points, axis=0).max()), 0.5 * robot.size)
    above = max(air, _LINK * robot.size)
    return np.array([points.min(axis=0) - (air, air, 0.0), np.add(points.max(axis=0), (air, air, above))])


def _arm_points(robot: Robot, poses: Sequence[FloatArray]) -> FloatArray:
    """(k, 3) joints and tools [m]."""
    T = link_transforms(robot, np.stack(poses))
    tools = (T[:, -1] @ robot.T_flange_tool)[:, :3, 3]
    return np.concatenate([T[..., :3, 3].reshape(-1, 3), tools])


def _before(path: FloatArray | None, arm: FloatArray) -> Camera:
    """The eye on the side on which the path is, a little aside, so that neither hides the other."""
    cameras = [Camera(np.zeros(3), 1.0).orbited(turn, 0.0) for turn in _TURNS]
    if path is None:
        return cameras[0]
    way = path.mean(axis=0)[:2] - arm.mean(axis=0)[:2]
    if np.linalg.norm(way) < 1e-9:
        return cameras[0]
    straight = way / np.linalg.norm(way)
    return min(cameras, key=lambda camera: abs(float(_flat(camera) @ straight) - _ASIDE))


def _flat(camera: Camera) -> FloatArray:
    """(2,) the unit direction to the eye, seen from above."""
    across = camera.axes[2, :2]
    return np.asarray(across / np.linalg.norm(across))


def _same(one: FloatArray, other: FloatArray) -> bool:
    return float(np.abs(one - other).max()) < 1e-6
