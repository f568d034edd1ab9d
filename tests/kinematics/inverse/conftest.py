"""What the tests of inverse kinematics share: joint poses compared up to whole turns, and random ones to compare."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from rvsim.robot import Robot

ORACLE_KEYS = {"rv-m1": "rvm1", "rv-1a": "rv1a", "ur5e": "ur5e", "rrrp": "rrrp", "al5b": "al5b"}


def joint_distance(robot: Robot, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """The largest joint difference (...) of q (..., n), whole turns aside."""
    difference = np.asarray(a) - np.asarray(b)
    whole = np.where(robot.is_revolute, 2.0 * np.pi * np.rint(difference / (2.0 * np.pi)), 0.0)
    return np.abs(difference - whole).max(axis=-1)


def poses_within(robot: Robot, count: int, seed: int = 0) -> np.ndarray:
    """q (count, n), uniform within the limits; ±π, or 0 … 2, where there is none."""
    span = np.where(robot.is_revolute[:, None], [-np.pi, np.pi], [0.0, 2.0])
    lower, upper = np.where(np.isfinite(robot.limits), robot.limits, span).T
    return np.random.default_rng(seed).uniform(lower, upper, (count, robot.dof))


@pytest.fixture
def apart() -> Callable[..., np.ndarray]:
    return joint_distance


@pytest.fixture
def random_q() -> Callable[..., np.ndarray]:
    return poses_within


@pytest.fixture(params=ORACLE_KEYS)
def oracle_arm(request, oracle) -> tuple[str, dict]:
    """The name of one of the five arms, and its oracle."""
    return request.param, oracle["robots"][ORACLE_KEYS[request.param]]
