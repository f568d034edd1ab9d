"""Which branch at which point: of all branches at all points, the sequence that never jumps if it can, and moves least.

Dynamic programming over the points (Bellman). Every reachable point is reached; among the ways to do so the fewest
jumps count first, then the length of the way in joint space, the way from the present pose included.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rvsim.kinematics.forward import forward_kinematics
from rvsim.motion.continuity import beside, continuous
from rvsim.motion.straight import straight_run
from rvsim.motion.turns import JointRange, existing, nearest_turn, whole_turns
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

# A jump costs more than any way in joint space.
_JUMP = 1e6
_BLOCK = 100_000
# Of so few branches each counts; of many sampled ones those with doubtful steps can be spared.
_FEW = 16


@dataclass(eq=False)
class _Front:
    """The best ways to each branch (s,) of the present point: cost, pose unwrapped, and the span of the run so far."""

    cost: FloatArray
    q: FloatArray
    low: FloatArray
    high: FloatArray


@dataclass(frozen=True, eq=False)
class _Link:
    """How each branch (s,) of a point was best arrived at: the branch before, and whether a new run begins."""

    before: NDArray[np.intp]
    fresh: NDArray[np.bool_]


class Sequence(NamedTuple):
    """q (m, n), unwrapped, NaN where a point has no branch; `sure`: every step is known to keep to the path."""

    q: FloatArray
    sure: bool


def best_sequence(
    robot: Robot, branches: FloatArray, near: FloatArray, joints: JointRange, with_rotation: bool
) -> Sequence:
    """One pose a point, of branches (m, s, n).

    Args:
        branches: within the limits, or with a copy within them where a joint can turn a whole turn; NaN rows where
            there is none.
        near: (n,) the present pose.
        joints: the limits that count.
        with_rotation: whether the orientation belongs to the path.
    """
    missing = np.isnan(branches[..., 0])
    if not (missing.any() and missing.all(axis=1).any()):
        return _sequence(robot, branches, np.ones(len(branches) - 1, dtype=bool), near, joints, with_rotation)
    stages = np.flatnonzero(~missing.all(axis=1))
    q = np.full((len(branches), robot.dof), np.nan)
    if not len(stages):
        return Sequence(q, True)
    q[stages], sure = _sequence(robot, branches[stages], np.diff(stages) == 1, near, joints, with_rotation)
    return Sequence(q, sure)


@lru_cache(maxsize=64)
def motion_weights(robot: Robot) -> FloatArray:
    """(n,) what a joint's motion counts: 1 a radian; a slide across the whole arm as much as half a turn."""
    return np.where(robot.is_revolute, 1.0, np.pi / robot.size)


def _sequence(
    robot: Robot, q: FloatArray, adjacent: NDArray[np.bool_], near: FloatArray, joints: JointRange, with_rotation: bool
) -> Sequence:
    """Of branches q (k, s, n) at points each of which has some."""
    straight = _straight(robot, q, adjacent, near, joints, with_rotation)
    if straight is not None:
        return Sequence(straight, True)
    chosen, fresh = _chosen(robot, q, adjacent, near, joints, with_rotation)
    return Sequence(_unwrapped(q[np.arange(len(q)), chosen], fresh, near, joints), False)


def _straight(
    robot: Robot, q: FloatArray, adjacent: NDArray[np.bool_], near: FloatArray, joints: JointRange, with_rotation: bool
) -> FloatArray | None:
    """(k, n) the best sequence where it is one branch alone, and its runs fit into the limits."""
    if q.shape[1] > _FEW:
        return None
    weights = motion_weights(robot)
    front = _first(q[0], near, joints, weights)
    run = straight_run(robot, q, front.cost, adjacent, joints, weights, with_rotation)
    if run is None:
        return None
    if adjacent.all():
        found = joints.nearest_run(run, near)
    else:
        found = _unwrapped(run, np.concatenate([[True], ~adjacent]), near, joints)
    return np.ascontiguousarray(found) if joints.holds(found) else None


def _chosen(
    robot: Robot, q: FloatArray, adjacent: NDArray[np.bool_], near: FloatArray, joints: JointRange, with_rotation: bool
) -> tuple[NDArray[np.intp], NDArray[np.bool_]]:
    """The branch (k,) at each point and whether a new run begins there."""
    weights = motion_weights(robot)
    front = _first(q[0], near, joints, weights)
    links = []
    for index, step in enumerate(_steps(robot, q, adjacent, joints, with_rotation)):
        front, link = _extended(front, q[index + 1], step, bool(adjacent[index]), joints, weights)
        links.append(link)
    return _traced(int(np.argmin(front.cost)), links)


def _first(q: FloatArray, near: FloatArray, joints: JointRange, weights: FloatArray) -> _Front:
    way = joints.nearest_copy(q, near) - near
    way *= weights
    cost = np.sqrt((way * way).sum(axis=-1))
    return _Front(np.where(np.isnan(cost), np.inf, cost), q, q, q)


def _steps(
    robot: Robot, q: FloatArray, adjacent: NDArray[np.bool_], joints: JointRange, with_rotation: bool
) -> Iterator[tuple[FloatArray, NDArray[np.bool_]]]:
    """For each pair of successive points the joint steps (s, s, n) and whether each keeps to the path (s, s)."""
    T = forward_kinematics(robot, q)
    block = max(_BLOCK // q.shape[1] ** 2, 1)
    for first in range(0, len(q) - 1, block):
        last = min(first + block, len(q) - 1)
        here, there = q[first:last, :, None], q[first + 1 : last + 1, None, :]
        step = nearest_turn(there - here, joints.periodic)
        asked = existing(step) & adjacent[first:last, None, None]
        kept = np.zeros(asked.shape, dtype=bool)
        kept[asked] = _kept(robot, T[first : last + 1], asked, here, step, with_rotation)
        yield from zip(step, kept, strict=True)


def _kept(
    robot: Robot, T: FloatArray, asked: NDArray[np.bool_], here: FloatArray, step: FloatArray, with_rotation: bool
) -> NDArray[np.bool_]:
    """(k,) whether each of the steps asked for keeps to the path; T (m, s, 4, 4) of all points and branches."""
    point, branch, next_branch = np.nonzero(asked)
    way = step[asked]
    start = np.broadcast_to(here, step.shape)[asked]
    middle = forward_kinematics(robot, start + 0.5 * way)
    near, far = beside(robot, T[point, branch], middle, T[point + 1, next_branch], with_rotation)
    doubtful = ~near & ~far
    if asked.shape[1] <= _FEW:
        near[doubtful] = continuous(robot, start[doubtful], start[doubtful] + way[doubtful], with_rotation)
    return near


def _extended(
    front: _Front,
    q: FloatArray,
    step: tuple[FloatArray, NDArray[np.bool_]],
    adjacent: bool,
    joints: JointRange,
    weights: FloatArray,
) -> tuple[_Front, _Link]:
    """The best ways to the branches q (s, n) of the next point."""
    way, kept = step
    reached = front.q[:, None] + way
    low, high = np.minimum(front.low[:, None], reached), np.maximum(front.high[:, None], reached)
    fresh = ~(kept & joints.fits(low, high))
    # After an unreached stretch the arm has left the path anyway: what follows is a new run, but no jump.
    cost = front.cost[:, None] + np.linalg.norm(weights * way, axis=-1) + np.where(fresh & adjacent, _JUMP, 0.0)
    cost = np.where(np.isnan(cost), np.inf, cost)
    before, column = np.argmin(cost, axis=0), np.arange(cost.shape[1])
    new = fresh[before, column]
    pick = [np.where(new[:, None], q, array[before, column]) for array in (reached, low, high)]
    return _Front(cost[before, column], *pick), _Link(before, new)


def _traced(last: int, links: list[_Link]) -> tuple[NDArray[np.intp], NDArray[np.bool_]]:
    """From the last point back to the first."""
    chosen, fresh = [last], []
    for link in reversed(links):
        fresh.append(bool(link.fresh[chosen[-1]]))
        chosen.append(int(link.before[chosen[-1]]))
    return np.array(chosen[::-1], dtype=np.intp), np.array([True, *fresh[::-1]])


def _unwrapped(q: FloatArray, fresh: NDArray[np.bool_], near: FloatArray, joints: JointRange) -> FloatArray:
    """Each run of poses (k, n) without whole turns inside, begun as near as possible to where the last one ended."""
    runs = []
    for run in np.split(q, np.flatnonzero(fresh)[1:]):
        runs.append(joints.nearest_run(run + whole_turns(run, joints.periodic), near))
        near = runs[-1][-1]
    return np.concatenate(runs)
