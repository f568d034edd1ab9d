"""The target at the door: poses that can be asked for at all."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import PoseError
from rvsim.kinematics.numeric.options import Task
from rvsim.language import tr
from rvsim.spatial import nearest_rotation
from rvsim.spatial.arrays import FloatArray, floats

# A rotation typed with four digits (source 002's has three) is mended, one that is further off is no rotation.
_ASTRAY = 1e-2
_EXACT = 1e-14


def target_poses(T: ArrayLike, task: Task) -> FloatArray:
    """T (..., 4, 4), with the nearest rotations where the entries are rounded.

    Raises:
        ShapeError: T is not (..., 4, 4). PoseError: an entry is not finite or, for the task "pose", T is no pose.
    """
    poses = floats("T", T, 4, 4)
    if not np.isfinite(poses).all():
        raise PoseError(tr("its entries must be finite."))
    if task == "position":
        return poses
    R = poses[..., :3, :3]
    astray = float(np.abs(np.swapaxes(R, -1, -2) @ R - np.eye(3)).max(initial=0.0))
    if astray > _ASTRAY or (np.linalg.det(R) < 0.0).any():
        raise PoseError(
            tr("its columns are no right-handed, orthogonal unit vectors (off by {astray:.3g}).", astray=astray)
        )
    if astray < _EXACT:
        return poses
    mended = poses.copy()
    mended[..., :3, :3] = nearest_rotation(R)
    return mended
