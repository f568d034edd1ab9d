"""What the sources say of singularities, with the numbers of a pose: source 000's minors and barriers of the RV-M1, and
the factors of a determinant for an arm with a spherical wrist (source 001's arm; source 004, §4.2.1 states the rule).

Source 000 looks at the position alone, Ĵ (3, 4) of joints 1 to 4, and asks where its minors vanish. Its (29) is right
but forgets the tip on the base axis; its (31) is no singularity but a barrier: a joint is at its stop, and the other
three have lost a direction. Its θ₄ is the DH angle, 90° more than the joint's; here the joint's angle is written.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rvsim.kinematics import jacobian, link_transforms, pose_and_jacobian
from rvsim.kinematics.dh import joint_array
from rvsim.language import tr
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.units import degrees_from_radians

_STOP = 1e-9  # [rad] how exactly a barrier is within the limits
_SAMPLE_ELBOW = math.radians(-60.0)  # where the elbow of (31) is free, this pose of it is shown


class Minor(NamedTuple):
    """The determinant of three columns of Ĵ: its columns (from 1), its formula in LaTeX and its value [m³]."""

    name: str
    columns: tuple[int, int, int]
    formula: str
    value: float


def position_jacobian(robot: Robot, q: ArrayLike) -> FloatArray:
    """Source 000's Ĵ (3, 4), (26)-(27), at q (5,): how joints 1 to 4 move the tip [m]; joint 5 does not.

    The source counts θ₁ clockwise, so its first column has the other sign; all other printed entries are right.

    Raises:
        ShapeError: q is not one value a joint.
    """
    return jacobian(robot, joint_array(robot, q))[:3, :4]


def minors(robot: Robot, q: ArrayLike) -> tuple[Minor, ...]:
    """The three minors of (28) at q (5,), with what they are when worked out: each has the factor r.

    Raises:
        ShapeError: q is not one value a joint.
    """
    J = position_jacobian(robot, q)
    return tuple(
        Minor(name, columns, formula, float(np.linalg.det(J[:, [column - 1 for column in columns]])))
        for name, columns, formula in MINORS
    )


MINORS = (
    (r"\det\hat J_1", (1, 2, 3), r"-r\,a_2\,(a_3 s_3 + d_5 s_{34})"),
    (r"\det\hat J_2", (1, 2, 4), r"-r\,d_5\,(a_2 s_{34} + a_3 s_4)"),
    (r"\det\hat J_3", (1, 3, 4), r"-r\,a_3\,d_5\,s_4"),
)


class Barrier(NamedTuple):
    """A pose of the source's list.

    Args:
        printed: the source's number, or "" where only its procedure gives the pose.
        title: its joints, in the joint's own angles.
        q: (5,) the pose [rad], the joints it leaves free taken from the present one.
        stop: the joint (from 0) that is at a limit.
        sigma: (3,) the singular values of Ĵ there [m].
    """

    printed: str
    title: str
    q: FloatArray
    stop: int
    sigma: FloatArray

    @property
    def singular(self) -> bool:
        """Whether Ĵ loses rank there."""
        return bool(self.sigma[-1] <= 1e-6)

    @property
    def verdict(self) -> str:
        """The sentence about it."""
        if self.singular:
            return tr("Singular: upper arm, forearm and hand are in line.")
        numbers = ", ".join(f"{value:.3f}" for value in self.sigma)
        return tr(
            "Not singular: σ = {numbers} m. A barrier: joint {joint} is at its stop, and the other three "
            "joints have lost a direction.",
            numbers=numbers,
            joint=self.stop + 1,
        )


def barriers(robot: Robot, q: ArrayLike) -> tuple[Barrier, ...]:
    """The poses that source 000's procedure gives for this arm's own lengths and limits: one joint at a stop, and the
    minor of the other three columns 0. Joints 1 and 5, which play no part, are taken from q (5,).

    Raises:
        ShapeError: q is not one value a joint.
    """
    here = joint_array(robot, q)
    a2, a3 = robot.dh[1, 2], robot.dh[2, 2]
    hand = robot.dh[4, 1] + robot.T_flange_tool[2, 3]
    found = [_barrier(robot, here, "(30)", 2, robot.joints[2].upper, 3, 0.0)]
    found += [_barrier(robot, here, "(31)", 1, stop, 3, 0.0) for stop in robot.limits[1]]
    elbow = robot.joints[2].lower
    wrist = math.atan2(-a2 * math.sin(elbow), a3 + a2 * math.cos(elbow))
    found += [_barrier(robot, here, "", 2, elbow, 3, angle) for angle in (wrist, wrist - math.pi)]
    for stop in robot.limits[3]:
        bend = math.atan2(-hand * math.sin(stop), a3 + hand * math.cos(stop))
        found.append(_barrier(robot, here, "", 3, float(stop), 2, bend))
    inside = [(robot.limits[:, 0] - _STOP <= b.q) & (b.q <= robot.limits[:, 1] + _STOP) for b in found]
    return tuple(barrier for barrier, keeps in zip(found, inside, strict=True) if keeps.all())


def _barrier(robot: Robot, here: FloatArray, printed: str, stop: int, at: float, other: int, angle: float) -> Barrier:
    """With joint `stop` at its limit and joint `other` at the angle that makes the minor vanish."""
    q = np.clip(here, *robot.limits.T)
    if 2 not in (stop, other):
        q[2] = _SAMPLE_ELBOW
    if 1 not in (stop, other):
        q[1] = robot.home[1]
    q[stop], q[other] = at, angle
    title = ", ".join(f"θ{_LOW[i]} = {_degrees(q[i])}" for i in sorted((stop, other)))
    sigma = np.asarray(np.linalg.svd(position_jacobian(robot, q), compute_uv=False))
    return Barrier(printed, title, q, stop, sigma)


_LOW = "₁₂₃₄₅"


def _degrees(angle: float) -> str:
    number = f"{degrees_from_radians(angle):.3f}".rstrip("0").rstrip(".")
    return f"{number.replace('-', chr(0x2212))}°"


class WristSplit(NamedTuple):
    """det J of an arm with a spherical wrist as a product: the arm's J11 (3, 3) [m], seen at the wrist centre, and the
    wrist's J22 (3, 3); `whole` is det J [m³]."""

    J11: FloatArray
    J22: FloatArray
    arm: float
    wrist: float
    whole: float


def wrist_split(robot: Robot, q: ArrayLike) -> WristSplit:
    """At q (6,) of an arm whose axes 4, 5 and 6 meet: at their point the last three columns have no linear part, so
    det J = det J11 · det J22. Siciliano et al., Robotics (2009), §3.3.1; source 004, §4.2.1.

    Raises:
        ShapeError: q is not one value a joint.
    """
    joints = joint_array(robot, q)
    T, J = pose_and_jacobian(robot, joints)
    to_centre = link_transforms(robot, joints)[4, :3, 3] - T[:3, 3]
    J11 = J[:3, :3] + np.cross(J[3:, :3], to_centre, axisa=0, axisc=0)
    J22 = J[3:, 3:]
    arm, wrist = float(np.linalg.det(J11)), float(np.linalg.det(J22))
    return WristSplit(J11, J22, arm, wrist, float(np.linalg.det(J)))
