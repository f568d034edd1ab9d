"""Ways into a singularity: the pose of a family that is near, within the limits."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rvsim.errors import UnknownNameError
from rvsim.kinematics.singular_families import SingularFamily, singular_families
from rvsim.language import tr
from rvsim.robot import Robot
from rvsim.spatial.arrays import FloatArray, floats

_STARTS, _NEWTON, _SLIDES = 24, 30, 20
_REACHED = 1e-10  # of the family's scaled terms
_PURE = 0.05  # of another family's scaled terms: nearer, the pose would show two singularities at once
_STEP = 1e-6


@dataclass(frozen=True, eq=False)
class SingularPose:
    """q (n,) within the limits, or None: then `outside` (n,) is a pose of the family that breaks them, and `joints`
    (from 0) are those that would leave theirs; `reason` says it in a sentence ("" where q is found)."""

    q: FloatArray | None
    outside: FloatArray | None = None
    joints: tuple[int, ...] = ()
    reason: str = ""


def go_to_singularity(robot: Robot, family: SingularFamily | str, q: ArrayLike) -> SingularPose:
    """A pose of a family near q (n,): Newton's method from q and from poses over the whole range, each then drawn
    towards q as far as the family and the limits let it; of all these the nearest that is in no other family.

    Raises:
        ShapeError: q is not one value a joint.
        UnknownNameError: the arm has no family of that name.
    """
    wanted = _named(robot, family) if isinstance(family, str) else family
    here = np.array(floats("q", q, robot.dof))
    found = _nearest(robot, wanted, here, robot.limits)
    if found is not None:
        return SingularPose(found)
    free = _nearest(robot, wanted, here, np.broadcast_to([-np.inf, np.inf], robot.limits.shape))
    if free is None:
        return SingularPose(
            None,
            reason=tr(
                "No pose of the {singularity} was found: this arm's lengths allow none.", singularity=wanted.title
            ),
        )
    outside = np.flatnonzero((free < robot.limits[:, 0]) | (free > robot.limits[:, 1]))
    names = tr(", ").join(tr(robot.joint_names[i]) for i in outside)
    reason = tr("The {singularity} lies outside the limits of {joints}.", singularity=wanted.title, joints=names)
    return SingularPose(None, free, tuple(int(i) for i in outside), reason)


def _named(robot: Robot, name: str) -> SingularFamily:
    families = singular_families(robot)
    for family in families:
        if family.name == name:
            return family
    raise UnknownNameError("family of singular poses", name, [family.name for family in families] or ["none"])


def _nearest(robot: Robot, family: SingularFamily, here: FloatArray, limits: FloatArray) -> FloatArray | None:
    """Of all poses on the way towards `here`: the nearest that is singular in this one way, else the nearest."""
    search = _Search(robot, family, limits)
    poses = search.settle(search.starts(here), _NEWTON)
    passed = [poses]
    for _ in range(_SLIDES):
        poses = search.settle(search.towards(poses, here), 3)
        passed.append(poses)
    poses = search.settle(np.concatenate(passed), _NEWTON)
    poses = poses[family.measure(poses) <= _REACHED]
    if not len(poses):
        return None
    away = np.linalg.norm((poses - here) / search.unit, axis=1)
    others = [other.measure(poses) for other in singular_families(robot) if _apart(other, family)]
    pure = np.min(others, axis=0, initial=1.0) > _PURE if others else np.ones(len(poses), bool)
    return np.asarray(poses[np.argmin(np.where(pure | ~pure.any(), away, np.inf))])


def _apart(other: SingularFamily, family: SingularFamily) -> bool:
    """Whether one can be in `family` without being in the other."""
    own = {term.symbol for term in family.terms}
    return any(term.symbol not in own for term in other.terms)


class _Search:
    """Many poses (m, n) at once on their way into a family."""

    def __init__(self, robot: Robot, family: SingularFamily, limits: FloatArray) -> None:
        self._family, (self._lower, self._upper) = family, limits.T
        self.unit = np.where(robot.is_revolute, 1.0, robot.size)

    def starts(self, here: FloatArray) -> FloatArray:
        """Here, and poses over the whole range; without limits over half a turn or a size to either side."""
        lower = np.where(np.isfinite(self._lower), self._lower, here - np.pi * self.unit)
        upper = np.where(np.isfinite(self._upper), self._upper, here + np.pi * self.unit)
        spread = np.random.default_rng(0).uniform(lower, upper, (_STARTS, here.size))
        idle = np.abs(self._slopes(spread)).max(axis=(0, 1)) < 1e-9  # joints that the family does not ask
        return self._clipped(np.concatenate([here[None], np.where(idle, here, spread)]))

    def settle(self, poses: FloatArray, steps: int) -> FloatArray:
        """Newton's method, the shortest way; a joint at its limit stays there."""
        for _ in range(steps):
            off = self._family.scaled(poses)
            if np.abs(off).max() <= 1e-14:
                break
            slopes = self._slopes(poses)
            step = _shortest(slopes, -off)
            blocked = self._blocked(poses, step)
            if blocked.any():
                step = _shortest(np.where(blocked[:, None], 0.0, slopes), -off)
            poses = self._clipped(poses + np.clip(step, -0.5, 0.5) * self.unit)
        return poses

    def towards(self, poses: FloatArray, here: FloatArray) -> FloatArray:
        """Poses drawn halfway to `here`, along the family to first order."""
        wish = 0.5 * (here - poses) / self.unit
        slopes = self._slopes(poses)
        across = np.einsum("mkn,mn->mk", slopes, wish)
        return self._clipped(poses + (wish - _shortest(slopes, across)) * self.unit)

    def _slopes(self, poses: FloatArray) -> FloatArray:
        """(m, k, n) how the terms change with the joints, in units of the joints."""
        shifts = _STEP * np.diag(self.unit)
        ahead, behind = (self._family.scaled(poses[:, None] + shift) for shift in (shifts, -shifts))
        return np.asarray(np.swapaxes(ahead - behind, -1, -2) / (2.0 * _STEP))

    def _blocked(self, poses: FloatArray, step: FloatArray) -> FloatArray:
        return np.asarray(((poses <= self._lower) & (step < 0.0)) | ((poses >= self._upper) & (step > 0.0)))

    def _clipped(self, poses: FloatArray) -> FloatArray:
        return np.asarray(np.clip(poses, self._lower, self._upper))


def _shortest(slopes: FloatArray, wanted: FloatArray) -> FloatArray:
    """The shortest steps (m, n) with slopes · step = wanted (m, k), damped where there is none."""
    square = slopes @ np.swapaxes(slopes, -1, -2) + 1e-12 * np.eye(slopes.shape[-2])
    return np.asarray(np.einsum("mkn,mk->mn", slopes, np.linalg.solve(square, wanted[..., None])[..., 0]))
