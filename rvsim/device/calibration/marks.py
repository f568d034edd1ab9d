"""Which poses a joint is marked in: easy to recognise, far apart, clear of the table, and little loaded."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import lru_cache
from itertools import combinations, islice, product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rvsim.device.calibration.bodies import body_of
from rvsim.device.calibration.sag import sag_of
from rvsim.kinematics.clearance import clearance
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray

# Multiples of these are easy to recognise, the first ones best: with a set square, then with a protractor.
_EASY_DEG = (90, 45, 30, 15, 10, 5, 1)
_EASY_MM = (100, 50, 20, 10, 5, 2, 1)
# A reading error grows beyond the marks. Half a degree, and half a microsecond of rounding, stay below one degree
# where they leave no more than this part of their distance uncovered at either end: (0.5 + 0.1) (1 + 2 · 0.3) < 1.
MOST_UNCOVERED = 0.3
_TRIED = 60  # pairs, before the table is left out of account
_CLEAR = 0.02  # [m] above the table, all the way between the marks
_LIGHT = math.radians(0.2)  # a sag that nobody sees
_STEPS = 13  # of a joint's range
_POSTURE_STEPS = (math.radians(30.0), math.radians(45.0), math.radians(90.0))
_MOST_POSTURES = 1000
_TINY = 1e-9


class MarkPlan(NamedTuple):
    """Two values [rad, m] at which a joint is marked, the lesser first, and the pose (n,) of the arm at each."""

    values: tuple[float, float]
    postures: tuple[FloatArray, FloatArray]


@lru_cache(maxsize=256)
def mark_plan(robot: Robot, joint: int, lower: float, upper: float) -> MarkPlan:
    """The best two marks for what a joint (from 0) can reach, from `lower` to `upper` [rad, m]."""
    pairs = list(islice(_pairs(lower, upper, robot.joints[joint].revolute), _TRIED)) or [(lower, upper)]
    postures, values = _postures(robot, joint), np.linspace(lower, upper, _STEPS)
    clear = _clear(robot, joint, postures, values)
    for pair in pairs:
        between = _between(values, pair)
        posture = _best_posture(robot, joint, postures[clear[:, between].all(axis=1)], pair)
        if posture is not None:
            return _plan(joint, posture, pair)
    return _plan(joint, robot.home, pairs[0])


def usual_range(robot: Robot, joint: int) -> tuple[float, float]:
    """What both the joint and its servo, as calibrated so far, allow [rad, m]; the servo's where they share nothing."""
    least, largest = robot.servos[joint].limits
    lower, upper = max(least, robot.joints[joint].lower), min(largest, robot.joints[joint].upper)
    return (lower, upper) if lower < upper else (least, largest)


def _plan(joint: int, posture: FloatArray, values: tuple[float, float]) -> MarkPlan:
    poses = np.stack([posture, posture])
    poses[:, joint] = values
    poses.setflags(write=False)
    return MarkPlan(values, (poses[0], poses[1]))


def _pairs(lower: float, upper: float, revolute: bool) -> Iterator[tuple[float, float]]:
    """Pairs of marks that cover the range, the easiest first, among these those farthest apart."""
    easy, unit = (_EASY_DEG, math.radians(1.0)) if revolute else (_EASY_MM, 1e-3)
    numbers: set[int] = set()
    seen: set[tuple[int, int]] = set()
    for step in easy:
        first, last = math.ceil(lower / unit / step - _TINY), math.floor(upper / unit / step + _TINY)
        numbers |= {multiple * step for multiple in range(first, last + 1)}
        pairs = sorted(combinations(sorted(numbers), 2), key=lambda pair: pair[0] - pair[1])
        for low, high in pairs:
            if (low, high) not in seen and _covers(low * unit, high * unit, lower, upper):
                seen.add((low, high))
                yield low * unit, high * unit


def _covers(low: float, high: float, lower: float, upper: float) -> bool:
    return max(low - lower, upper - high) <= MOST_UNCOVERED * (high - low)


def _postures(robot: Robot, joint: int) -> FloatArray:
    """(k, n) home first, then poses that differ in the other joints which tilt or bend.

    Home alone where the joint itself does neither: what it carries is the same in all of them.
    """
    movable = [other for other in range(robot.dof) if body_of(robot, other, robot.home).kind in ("tilt", "bend")]
    if joint not in movable:
        return robot.home[None]
    others = [other for other in movable if other != joint]
    for step in _POSTURE_STEPS:
        choices = [_multiples(*usual_range(robot, other), step) for other in others]
        if math.prod(map(len, choices)) <= _MOST_POSTURES:
            break
    poses = np.tile(robot.home, (1 + min(math.prod(map(len, choices)), _MOST_POSTURES), 1))
    poses[1:, others] = list(islice(product(*choices), _MOST_POSTURES))
    return poses


def _multiples(lower: float, upper: float, step: float) -> list[float]:
    first, last = math.ceil(lower / step - _TINY), math.floor(upper / step + _TINY)
    return [multiple * step for multiple in range(first, last + 1)] or [0.5 * (lower + upper)]


def _clear(robot: Robot, joint: int, postures: FloatArray, values: FloatArray) -> NDArray[np.bool_]:
    """(k, v) whether the arm is clear of the table and of itself in postures (k, n) with the joint at values (v,)."""
    poses = np.repeat(postures[:, None, :], len(values), axis=1)
    poses[:, :, joint] = values
    room = clearance(robot, poses)
    return np.asarray((room.table > _CLEAR) & (room.own > 0.0))


def _between(values: FloatArray, pair: tuple[float, float]) -> slice:
    """Of rising values, those between the pair and the next one on either side."""
    first, last = np.searchsorted(values, pair)
    return slice(max(int(first) - 1, 0), int(last) + 1)


def _best_posture(robot: Robot, joint: int, clear: FloatArray, pair: tuple[float, float]) -> FloatArray | None:
    """Of postures (k, n), the nearest to home of those in which the joint carries next to nothing at both marks.

    Where it always carries more, the one in which it carries least; None where k is 0.
    """
    if not len(clear):
        return None
    poses = np.repeat(clear[:, None, :], 2, axis=1)
    poses[:, :, joint] = pair
    sag = np.abs(sag_of(robot, poses)[..., joint]).max(axis=1)
    away = np.abs(clear - robot.home).sum(axis=1)
    return np.asarray(clear[np.lexsort((away, np.maximum(np.round(sag, 2), _LIGHT)))[0]])
