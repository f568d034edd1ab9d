"""A motion through given poses: as fast as they were recorded, or at the pace of the arm."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import ShapeError
from rvsim.kinematics import forward_kinematics
from rvsim.motion.laws import PiecewisePolynomial
from rvsim.motion.path import Path
from rvsim.motion.tracking_result import Tracking
from rvsim.motion.trajectory import Law, Stretch, Trajectory, joint_move, trajectory_of
from rvsim.robot import Robot
from rvsim.robot.arrays import frozen_array

_EVEN = PiecewisePolynomial(np.array([0.0, 1.0]), np.array([[[0.0], [1.0]]]))  # from 0 to 1 in a second


def motion_through(
    robot: Robot, start_q: ArrayLike, q: ArrayLike, times: ArrayLike | None = None, *, law: Law = "quintic"
) -> Trajectory:
    """From `start_q` (n,) to the first of q (m, n) and through all of them, on a spline in joint space.

    Args:
        times: (m,) when each is passed [s], increasing; then the speeds are those of the record, whatever the joints
            may do. None for a pace that the joints can keep, from rest to rest with rests at sharp corners of the
            tool's way.
        law: of the way to the first pose, and of the rest where there are no times.

    Raises:
        ShapeError: no pose, or times that do not fit or do not increase.
    """
    poses = frozen_array("q", q, (-1, robot.dof))
    if not len(poses):
        raise ShapeError("q", f"(at least 1, {robot.dof})", poses.shape)
    approach = joint_move(robot, start_q, poses[0], law=law)
    if len(poses) == 1:
        return approach
    if times is None:
        places = forward_kinematics(robot, poses)[:, :3, 3]
        tracking = Tracking(robot, Path("record", places), poses, (), ignore_limits=True)
        motion = trajectory_of(tracking, start_q, law=law)
        assert motion is not None
        return motion
    moments = frozen_array("times", times, (len(poses),))
    if not (np.diff(moments) > 0.0).all():
        raise ShapeError("times", "increasing", moments.shape)
    duration = float(moments[-1] - moments[0])
    knots = (moments - moments[0]) / duration
    return Trajectory(
        (*_as_approach(approach), Stretch(duration, knots, poses, np.arange(len(poses), dtype=float), law=_EVEN))
    )


def _as_approach(motion: Trajectory) -> tuple[Stretch, ...]:
    """The way to the first pose: it draws nothing."""
    return tuple(Stretch(s.duration, s.knots, s.q, s.progress, "approach", s.law) for s in motion.stretches)
