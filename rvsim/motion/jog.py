"""Jogging: the arm moves along or about an axis, or by one joint, as long as a key is held. Arithmetic only.

The way ahead is worked out as points on a course, at least as far as a stop takes; the speed is then the largest that
starts, passes and ends smoothly: v² ≤ v_k² + 2a(s_k − s) for every point k ahead. So the arm slows down before a
joint limit or a singularity, and stops at it; a held key never makes it jump.
"""

from __future__ import annotations

import math
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.kinematics.rates import tool_twist
from rvsim.motion.jog_course import LONGEST_STEP, Course, JointMotion, Limit, ToolMotion, course_of
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

RAMP = 0.25  # seconds from rest to full speed, and from full speed to rest
_HORIZON = 0.5 * RAMP + LONGEST_STEP[0]  # [s at full speed]: a stop, and what lies between two points
_STEP = 1e-3  # [s] of the speed law; the course is exact whatever it is
_REST = 2e-5  # [s at full speed]: so near to the end of a course is there; the speed law comes no nearer


class JogStep(NamedTuple):
    """Where a jog has come to: q (n,) [rad, m], its speeds qd (n,), the tool's twist (6,) [m/s, rad/s; base axes].

    `stopped_reason` is a sentence once the course has ended, else ""; `slowed_reason` says why it is not at full speed.
    `cause` is what ended the course; None while it goes on, and where the arm cannot do what is wished from the start.
    """

    q: FloatArray
    qd: FloatArray
    twist: FloatArray
    stopped_reason: str = ""
    slowed_reason: str = ""
    cause: Limit | Literal["singularity"] | None = None


class Jog:
    """One hold of a key: `advance` while it is held, `release`, and `advance` until `resting`.

    Args:
        robot: the arm.
        motion: where to, at full speed.
        limits: (n, 2) of the joints; None: the arm's own.
    """

    def __init__(self, robot: Robot, motion: ToolMotion | JointMotion, limits: FloatArray | None = None) -> None:
        self._robot, self._motion = robot, motion
        self._limits = robot.limits if limits is None else limits
        self._course: Course | None = None
        self._held = True
        self._share, self._way = 0.0, 0.0  # of full speed; along the course [s at full speed]
        self._q: FloatArray = robot.home

    @property
    def resting(self) -> bool:
        """Whether it has come to rest after the release, or at the end of its course."""
        return self._share == 0.0 and (not self._held or bool(self._stopped()))

    @property
    def share(self) -> float:
        """The present speed, as a share of the full one."""
        return self._share

    def release(self) -> None:
        """The key is up: slow down and stop."""
        self._held = False

    def advance(self, q: ArrayLike, dt: float) -> JogStep:
        """Move on by dt [s] from q (n,); an arm that somebody else has moved meanwhile begins anew from there."""
        course = self._course_from(np.asarray(q, dtype=np.float64))
        course.reach(self._way + dt + _HORIZON)
        speed_limits = course.speed_limits(1.0 / RAMP)
        steps = max(1, math.ceil(dt / _STEP))
        for _ in range(steps):
            self._step(speed_limits, course.end, dt / steps)
        self._q = course.at(self._way)
        qd = self._share * course.rates(self._q)
        stopped = self._stopped()
        cause = course.cause if stopped else None
        return JogStep(self._q, qd, tool_twist(self._robot, self._q, qd), stopped, course.slowed(self._way), cause)

    def _course_from(self, q: FloatArray) -> Course:
        if self._course is None or not np.allclose(q, self._q, rtol=0.0, atol=1e-12):
            self._course = course_of(self._robot, q, self._motion, self._limits)
            self._share, self._way, self._q = 0.0, 0.0, q
        return self._course

    def _step(self, speed_limits: tuple[FloatArray, FloatArray], end: float, dt: float) -> None:
        """One step of the speed law, at constant acceleration."""
        before, change = self._share, dt / RAMP
        wished = min(before + change, 1.0) if self._held else max(before - change, 0.0)
        ways, squares = speed_limits
        ahead = self._way + 0.5 * (before + wished) * dt
        allowed = math.sqrt(max(float(np.interp(ahead, ways, squares)), 0.0))
        self._share = min(wished, allowed)
        self._way = min(self._way + 0.5 * (before + self._share) * dt, end)
        if end - self._way < _REST:
            self._share = 0.0

    def _stopped(self) -> str:
        course = self._course
        return course.reason if course is not None and course.end - self._way < _REST else ""
