"""The course of a jog: joint values along a straight way of the tool, as far as the arm can go.

The position comes first, the orientation is kept or turned with what freedom is left: an arm of five joints moves its
tool straight all the same. Source: Siciliano et al., Robotics (2009), eq. (3.54), task priority.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from typing import Literal, NamedTuple, Protocol

import numpy as np

from rvsim.kinematics import jacobian, pose_and_jacobian
from rvsim.language import tr, tr_later
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.spatial import rotation_from_vector, rotation_vector

Axes = Literal["base", "tool"]

LONGEST_STEP = (0.02, 0.002, math.radians(1.0))  # between two points: [s at full speed], [m], [rad]
_ITERATIONS = 8
_POSITION, _TURN = 1e-8, math.radians(0.1)  # [m], [rad] off the course that pass
_SMALLEST = 1e-4  # singular values below are lost; lengths in sizes of the arm
_DAMPING = 0.02  # of the orientation, which comes second: what it cannot have must not throw the arm about
_LOST = 1e-2  # of a wished velocity: an arm that misses more cannot do it
_SLOWEST = 0.05  # of full speed: where a joint's top speed allows no more, a singularity ends the course
_AT_LIMIT = (
    tr_later("Stopped: the {joint} is at its lower limit."),
    tr_later("Stopped: the {joint} is at its upper limit."),
)
_HALVINGS = 5  # of a step: the end of a course is found as closely as that
_USUAL_SPEED = math.radians(120.0)  # of a joint without a known top speed; a sliding one: the arm's size in 2 s


class ToolMotion(NamedTuple):
    """The tool moves at v (3,) [m/s] and turns at w (3,) [rad/s], both in base axes or in the tool's at the start."""

    v: FloatArray
    w: FloatArray
    axes: Axes = "base"
    name: str = tr_later("moving that way")  # for sentences: "moving along x", "turning about z"


class JointMotion(NamedTuple):
    """One joint (from 0) moves at a rate [rad/s, m/s]."""

    joint: int
    rate: float


class Limit(NamedTuple):
    """The lower (side 0) or upper (1) limit `value` [rad, m] of a joint (from 0)."""

    joint: int
    side: int
    value: float


class Point(NamedTuple):
    """Joint values (n,) on a course, or the sentence why there are none."""

    q: FloatArray
    problem: str = ""


class Guide(Protocol):
    """Knows where the points of a course are."""

    def point(self, before: FloatArray, way: float) -> Point:
        """The joint values at a place, nearest to those (n,) before."""

    def rates(self, q: FloatArray) -> FloatArray:
        """(n,) how fast the joints move at q (n,), at full speed [rad/s, m/s]."""


class Course:
    """Joint values over the way, which is counted in seconds at full speed; worked out as far as it is asked for.

    Args:
        robot: the arm.
        q: (n,) where it begins.
        pace: the way from point to point [s at full speed].
        guide: finds the next point.
        limits: (n, 2); a joint that is outside already may move in, and no further out.
        refusal: why it ends where it begins, or "".
    """

    def __init__(
        self, robot: Robot, q: FloatArray, pace: float, guide: Guide, limits: FloatArray, refusal: str = ""
    ) -> None:
        self._robot, self._pace, self._guide = robot, pace, guide
        self._own_limits = limits
        self._limits = np.stack([np.minimum(limits[:, 0], q), np.maximum(limits[:, 1], q)], axis=1)
        self._top = top_speeds(robot)
        self._ways: list[float] = [0.0]
        self._points: list[FloatArray] = [np.array(q)]
        self._caps: list[float] = []  # one an interval: the share of full speed that the joints can follow
        self._slowest: list[int] = []  # the joint that says so
        self._broken: Limit | None = None  # by the last point that was tried
        self.end = 0.0 if refusal else math.inf
        self.reason = refusal
        self.cause: Limit | Literal["singularity"] | None = None  # of its end, where it does not end at once

    def reach(self, way: float) -> None:
        """Know the course as far as that, or to its end."""
        while math.isinf(self.end) and self._ways[-1] < way:
            self._extend()

    def _extend(self) -> None:
        problem = self._try(self._pace)
        if not problem:
            return
        cause: Limit | Literal["singularity"] = self._broken or "singularity"
        step = self._pace
        for _ in range(_HALVINGS):
            step *= 0.5
            self._try(step)
        self.end, self.reason, self.cause = self._ways[-1], problem, cause

    def _try(self, step: float) -> str:
        """Go on by a step, if the arm can; else the sentence why not."""
        before = self._points[-1]
        point = self._guide.point(before, self._ways[-1] + step)
        self._broken = None if point.problem else self._outside(point.q)
        problem = point.problem or self._limit_text(self._broken)
        speeds = np.abs(point.q - before) / (step * self._top)
        joint = int(np.argmax(speeds))
        if not problem and speeds[joint] * _SLOWEST > 1.0:
            problem = _singular(tr("the {joint} would have to move too fast", joint=tr(self._robot.joint_names[joint])))
        if not problem:
            self._ways.append(self._ways[-1] + step)
            self._points.append(point.q)
            self._caps.append(min(1.0, 1.0 / max(float(speeds[joint]), 1e-12)))
            self._slowest.append(joint)
        return problem

    def _outside(self, q: FloatArray) -> Limit | None:
        for side, beyond in enumerate((self._limits[:, 0] - q, q - self._limits[:, 1])):
            joint = int(np.argmax(beyond))
            if beyond[joint] > 0.0 and abs(self._limits[joint, side]) < math.inf:
                return Limit(joint, side, float(self._own_limits[joint, side]))
        return None

    def _limit_text(self, limit: Limit | None) -> str:
        if limit is None:
            return ""
        return tr(_AT_LIMIT[limit.side], joint=tr(self._robot.joint_names[limit.joint]))

    # --- along it --------------------------------------------------------------------------------------------------

    def at(self, way: float) -> FloatArray:
        """(n,) the joint values there: cubic between the points, with a continuous rate."""
        index, length, share = self._interval(way)
        if not length:
            return self._points[index]
        one, other = self._points[index : index + 2]
        low, high = self._tangent(index) * length, self._tangent(index + 1) * length
        rise, rest = other - one, 1.0 - share
        bulge = share * rest * (rest * (low - rise) + share * (rise - high))
        near = np.asarray(np.clip(one + share * rise + bulge, *self._limits.T))
        exact = self._guide.point(near, way)  # the cubic leaves the line where the joints turn fast
        return near if exact.problem or self._outside(exact.q) is not None else exact.q

    def rates(self, q: FloatArray) -> FloatArray:
        """(n,) how fast the joints move at q (n,), at full speed [rad/s, m/s]."""
        return self._guide.rates(q)

    def _interval(self, way: float) -> tuple[int, float, float]:
        """The interval that holds a place, its length, and the share of it that has been passed."""
        last = len(self._ways) - 2
        if last < 0:
            return 0, 0.0, 0.0
        index = min(max(bisect_right(self._ways, way) - 1, 0), last)
        length = self._ways[index + 1] - self._ways[index]
        return index, length, min(max((way - self._ways[index]) / length, 0.0), 1.0)

    def _tangent(self, index: int) -> FloatArray:
        """dq over the way at a point: that of the parabola through it and its neighbours."""
        ways, points, last = self._ways, self._points, len(self._ways) - 1
        middle = min(max(index, 1), last - 1)
        if last == 1:
            return np.asarray((points[1] - points[0]) / (ways[1] - ways[0]))
        before, behind = ways[middle] - ways[middle - 1], ways[middle + 1] - ways[middle]
        first = (points[middle] - points[middle - 1]) / before
        second = (points[middle + 1] - points[middle]) / behind
        curve = (second - first) / (before + behind)
        return np.asarray(first + curve * (before + 2.0 * (ways[index] - ways[middle])))

    # --- how fast --------------------------------------------------------------------------------------------------

    def slowed(self, way: float) -> str:
        """Why the arm cannot pass there at full speed, or ""."""
        index, length, _ = self._interval(way)
        if not length or self._caps[index] > 0.999:
            return ""
        joint = tr(self._robot.joint_names[self._slowest[index]])
        return tr("Slowed: the {joint} moves at its top speed.", joint=joint)

    def speed_limits(self, deceleration: float) -> tuple[FloatArray, FloatArray]:
        """Places (k,) and the squares (k,) of the largest share of full speed there that can still be braked.

        Args:
            deceleration: of the share [1/s].
        """
        ways = np.array(self._ways)
        caps = np.array([*self._caps, 0.0])
        squares = np.minimum(caps, np.concatenate([caps[:1], caps[:-1]])) ** 2
        for index in range(len(ways) - 2, -1, -1):
            braked = squares[index + 1] + 2.0 * deceleration * (ways[index + 1] - ways[index])
            squares[index] = min(squares[index], braked)
        return ways, squares


def course_of(robot: Robot, q: FloatArray, motion: ToolMotion | JointMotion, limits: FloatArray) -> Course:
    """The course of that motion from q (n,) on."""
    if isinstance(motion, JointMotion):
        return Course(robot, q, LONGEST_STEP[0], _JointGuide(robot, q, motion), limits)
    guide = _ToolGuide(robot, q, motion)
    return Course(robot, q, guide.pace, guide, limits, guide.refusal)


def top_speeds(robot: Robot) -> FloatArray:
    """(n,) the joints' top speeds [rad/s, m/s]; where none is known, a usual one."""
    usual = (_USUAL_SPEED, 0.5 * robot.size)
    return np.array([joint.max_speed.value if joint.max_speed else usual[not joint.revolute] for joint in robot.joints])


class _JointGuide:
    """Moves one joint."""

    def __init__(self, robot: Robot, q: FloatArray, motion: JointMotion) -> None:
        self._q, self._rates = q, np.zeros(robot.dof)
        self._rates[motion.joint] = motion.rate

    def point(self, _before: FloatArray, way: float) -> Point:
        """The others stay."""
        return Point(self._q + way * self._rates)

    def rates(self, _q: FloatArray) -> FloatArray:
        """The same everywhere."""
        return self._rates


class _ToolGuide:
    """Leads the tool straight along v, turning about w."""

    def __init__(self, robot: Robot, q: FloatArray, motion: ToolMotion) -> None:
        self._robot, self._motion = robot, motion
        self._T, J = pose_and_jacobian(robot, q)
        R = self._T[:3, :3] if motion.axes == "tool" else np.eye(3)
        self._v, self._w = R @ motion.v, R @ motion.w
        self._strict = bool(np.any(motion.w)) or robot.dof >= 6  # whether the orientation must be as it should
        speeds = (1.0, float(np.linalg.norm(self._v)), float(np.linalg.norm(self._w)))
        self.pace = min(step / speed for step, speed in zip(LONGEST_STEP, speeds, strict=True) if speed > 0.0)
        self.refusal = self._refusal(J)

    def _refusal(self, J: FloatArray) -> str:
        """Source 004's test of the range, eq. (4.20): whether [v; w] is a velocity that this arm can have here."""
        twist = J @ first_then(J, self._v, self._w, self._robot.size, 0.0)
        missed = np.linalg.norm(twist[:3] - self._v) > _LOST * np.linalg.norm(self._v) + 1e-9
        turned = np.linalg.norm(twist[3:] - self._w) > _LOST * max(float(np.linalg.norm(self._w)), 0.1)
        if missed or (turned and self._strict):
            motion = tr(self._motion.name)
            if np.any(self._w):
                return tr(
                    "This arm cannot do that here: {motion} is lost while its tool stays in place.", motion=motion
                )
            return tr("This arm cannot do that here: {motion} is lost.", motion=motion)
        return ""

    def rates(self, q: FloatArray) -> FloatArray:
        """By the Jacobian there."""
        return first_then(jacobian(self._robot, q), self._v, self._w, self._robot.size, _DAMPING)

    def point(self, before: FloatArray, way: float) -> Point:
        """The values nearest to those before that put the tool there."""
        p = self._T[:3, 3] + way * self._v
        R = rotation_from_vector(way * self._w) @ self._T[:3, :3]
        q, off, turned = before, np.zeros(3), np.zeros(3)
        for _ in range(_ITERATIONS):
            T, J = pose_and_jacobian(self._robot, q)
            off, turned = p - T[:3, 3], rotation_vector(R @ T[:3, :3].T)
            step = first_then(J, off, turned, self._robot.size, _DAMPING)
            if np.linalg.norm(off) < 0.01 * _POSITION and float(np.abs(step).max()) < 1e-7:
                break
            q = q + step
        if np.linalg.norm(off) > _POSITION or (self._strict and np.linalg.norm(turned) > _TURN):
            return Point(q, _singular(tr("{motion} is lost there", motion=tr(self._motion.name))))
        return Point(q)


def first_then(J: FloatArray, v: FloatArray, w: FloatArray, size: float, damping: float) -> FloatArray:
    """(n,) the smallest joint step that moves by v (3,) as exactly as it can, then turns by w (3,) as nearly as it can.

    Args:
        J: (6, n).
        size: the length that is 1, for what counts as singular [m].
        damping: of the turning.
    """
    linear, angular = J[:3] / size, J[3:]
    inverse = np.linalg.pinv(linear, rcond=_SMALLEST)
    step = inverse @ (v / size)
    left = angular @ (np.eye(J.shape[1]) - inverse @ linear)
    u, s, vt = np.linalg.svd(left, full_matrices=False)
    gains = np.where(s > _SMALLEST, s / (s**2 + damping**2 + 1e-30), 0.0)
    return np.asarray(step + vt.T @ (gains * (u.T @ (w - angular @ step))))


def _singular(why: str) -> str:
    return tr("Stopped before a singularity: {why}.", why=why)
