"""Why a point was not reached: the limit that is least violated, or the orientation, or the reach."""

from __future__ import annotations

import numpy as np

from rvsim.motion.sequence import motion_weights
from rvsim.motion.tracking_result import Unreached
from rvsim.motion.turns import JointRange, existing
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray


def limit_culprit(robot: Robot, index: int, branches: FloatArray) -> Unreached:
    """The joint that keeps the arm from point `index`, though branches (s, n) exist (NaN rows are left out).

    Of the branch that violates its limits least, the joint farthest outside; of its copies q + 2πk the one nearest to
    the limits.
    """
    joints = JointRange.of(robot, ignore_limits=False)
    possible = branches[existing(branches)]
    copies = joints.nearest_copy(possible, possible)
    excess = motion_weights(robot) * joints.outside(copies)
    branch = int(np.argmin(excess.max(axis=1)))
    joint = int(np.argmax(excess[branch]))
    value = float(copies[branch, joint])
    limit = float(robot.limits[joint, 0 if value < robot.limits[joint, 0] else 1])
    return Unreached(index, "limits", robot.joint_names[joint], value, limit)
