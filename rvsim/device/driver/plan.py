"""A trajectory made ready to be sent: looked at once, checked, and from then on a table without surprises."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rvsim.device.driver.actions import Playable, Refusal
from rvsim.device.words import axis_name
from rvsim.language import tr
from rvsim.motion import joint_move
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray, frozen_array
from rvsim.units import degrees_from_radians, millimetres_from_metres

_STEP = 0.01  # [s] between samples; straight lines between them are within 0.01° at 400 °/s²
_MOST = 120_000
_ROUNDING = 1e-9
_MORE = 1.02  # than a joint's speed: speeds are seen between samples
# So far [rad, m] a trajectory may begin from where the arm is: it is passed in one set-point.
_NEAR = 0.05


@dataclass(frozen=True, eq=False)
class Plan:
    """Poses q (k, n) at times (k,) from `begins` ≤ 0 (the way to the start) to `duration` [s]."""

    times: FloatArray
    poses: FloatArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "times", frozen_array("times", self.times, (-1,)))
        object.__setattr__(self, "poses", frozen_array("poses", self.poses, (len(self.times), -1)))

    @property
    def begins(self) -> float:
        """[s], 0 without an approach."""
        return float(self.times[0])

    @property
    def duration(self) -> float:
        """[s]."""
        return float(self.times[-1])

    def q(self, t: ArrayLike) -> FloatArray:
        """(n,) at a time [s], or (j, n) at times (j,); clamped."""
        times = np.clip(np.asarray(t, dtype=np.float64), self.begins, self.duration)
        index = np.clip(np.searchsorted(self.times, times, side="right") - 1, 0, len(self.times) - 2)
        start, end = self.times[index], self.times[index + 1]
        part = ((times - start) / (end - start))[..., None]
        return np.asarray(self.poses[index] + part * (self.poses[index + 1] - self.poses[index]))

    def after(self, approach: Plan) -> Plan:
        """The same with a way to its start before it."""
        times = np.concatenate([approach.times[:-1] - approach.duration, self.times])
        return Plan(times, np.concatenate([approach.poses[:-1], self.poses]))


def plan_of(trajectory: Playable, robot: Robot, limits: FloatArray) -> Plan | Refusal:
    """The trajectory as a table, or why it is not run: no number, or outside limits (n, 2) of arm and servos."""
    duration = float(trajectory.duration)
    if not (math.isfinite(duration) and duration > 0.0):
        return Refusal(tr("The trajectory lasts {duration:g} s; it must last some time.", duration=duration))
    times = np.linspace(0.0, duration, min(max(math.ceil(duration / _STEP), 2), _MOST))
    poses = _sampled(trajectory, times)
    if poses.shape != (len(times), robot.dof):
        joints = poses.shape[-1] if poses.ndim else 0
        return Refusal(tr("The trajectory has {found} joints, the arm has {wanted}.", found=joints, wanted=robot.dof))
    refusal = outside(robot, limits, poses, times) or _too_quick(robot, poses, times)
    return refusal or Plan(times, poses)


def approach_of(robot: Robot, here: FloatArray, start: FloatArray) -> Plan:
    """The calm way from one pose (n,) to another; not checked, set-points are held at the limits anyway."""
    move = joint_move(robot, here, start)
    times = np.linspace(0.0, move.duration, max(math.ceil(move.duration / _STEP), 2))
    return Plan(times, move.q(times))


def _sampled(trajectory: Playable, times: FloatArray) -> FloatArray:
    poses = np.asarray(trajectory.q(times), dtype=np.float64)
    if poses.ndim == 2 and len(poses) == len(times):
        return poses
    return np.array([trajectory.q(float(time)) for time in times], dtype=np.float64)


def _too_quick(robot: Robot, poses: FloatArray, times: FloatArray) -> Refusal | None:
    """Why poses (k, n) are refused: a joint is known to be slower than that, or the trajectory jumps."""
    most = np.array([math.inf if joint.max_speed is None else joint.max_speed.value for joint in robot.joints])
    speeds = np.abs(np.diff(poses, axis=0)) / np.diff(times)[:, None]
    beyond = np.argwhere(speeds > _MORE * most)
    if not len(beyond):
        return None
    index, joint = beyond[0]
    found, can = (shown(robot, joint, speed) for speed in (speeds[index, joint], most[joint]))
    return Refusal(
        tr(
            "{joint} would move at {speed}/s after {time:.2f} s; it can do {possible}/s. Give it more time.",
            joint=axis_name(robot, joint),
            speed=found,
            time=times[index],
            possible=can,
        )
    )


def outside(robot: Robot, limits: FloatArray, poses: FloatArray, times: FloatArray | None = None) -> Refusal | None:
    """Why poses (k, n) are refused: joint, time, value and limits (n, 2); None where they are all well."""
    wrong = np.argwhere(~np.isfinite(poses))
    if len(wrong):
        index, joint = wrong[0]
        if times is None:
            return Refusal(tr("{joint} is no number, so nothing is sent.", joint=axis_name(robot, joint)))
        return Refusal(
            tr(
                "{joint} after {time:.2f} s is no number, so nothing is sent.",
                joint=axis_name(robot, joint),
                time=times[index],
            )
        )
    excess = np.maximum(limits[:, 0] - poses, poses - limits[:, 1])
    beyond = np.argwhere(excess > _ROUNDING)
    if not len(beyond):
        return None
    index, joint = beyond[0]
    lower, upper = (shown(robot, joint, end) for end in limits[joint])
    found = shown(robot, joint, poses[index, joint], instead_of=limits[joint])
    values = {"joint": axis_name(robot, joint), "angle": found, "lower": lower, "upper": upper}
    if times is None:
        return Refusal(tr("{joint} would be at {angle}; arm and servo together allow {lower} to {upper}.", **values))
    return Refusal(
        tr(
            "{joint} would be at {angle} after {time:.2f} s; arm and servo together allow {lower} to {upper}.",
            **values,
            time=times[index],
        )
    )


def far_start(robot: Robot, here: FloatArray, start: FloatArray) -> Refusal | None:
    """Why a trajectory that begins in a pose (n,) is not run from another one; None where they are near enough."""
    joint = int(np.argmax(np.abs(start - here)))
    if abs(start[joint] - here[joint]) <= _NEAR:
        return None
    wanted, found = (shown(robot, joint, float(pose[joint])) for pose in (start, here))
    return Refusal(
        tr(
            "The trajectory begins with {joint} at {wanted}, but the arm is at {found}. Go to its start first.",
            joint=axis_name(robot, joint),
            wanted=wanted,
            found=found,
        )
    )


def shown(robot: Robot, joint: int, value: float, instead_of: Sequence[float] | FloatArray = ()) -> str:
    """A joint's value with its unit, with so many digits that it differs from those it stands against."""
    revolute = robot.joints[joint].revolute
    convert = degrees_from_radians if revolute else millimetres_from_metres
    number, others = float(convert(value)), [float(convert(other)) for other in instead_of]
    digits = 1
    while digits < 6 and any(f"{number:.{digits}f}" == f"{other:.{digits}f}" for other in others):
        digits += 1
    return f"{number:.{digits}f}".replace("-", "−") + ("°" if revolute else " mm")
