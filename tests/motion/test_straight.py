"""The quick way to the best sequence: whatever it answers, the dynamic programming over all branches answers too."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim import forward_kinematics, load_robot
from rvsim.lab import named_path
from rvsim.motion import Path, Tracking, continuity, sequence, track
from rvsim.robot import Robot

SEED = 5


def joint_wave(robot: Robot, seed: int, samples: int = 60) -> Path:
    """A path that the arm can follow: that of joints that swing."""
    random = np.random.default_rng(seed)
    low, high = np.clip(robot.limits, -2.5, 2.5).T
    middle, swing = random.uniform(0.7 * low, 0.7 * high), 0.3 * random.uniform(0.1, 1.0, robot.dof)
    t = np.linspace(0.0, 2.0, samples)[:, None]
    T = forward_kinematics(robot, middle + swing * np.sin(t * random.uniform(0.5, 1.5, robot.dof)))
    return Path("wave", T[:, :3, 3], T[:, :3, :3])


def by_the_long_way(robot: Robot, path: Path, near: np.ndarray, monkeypatch: pytest.MonkeyPatch) -> Tracking:
    with monkeypatch.context() as patch:
        patch.setattr(sequence, "straight_run", lambda *_: None)
        return track(robot, path, near=near)


@pytest.mark.parametrize("name", ["rv-m1", "ur5e", "al5b", "rrrp", "scara"])
def test_it_never_differs_from_the_dynamic_programming(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    robot = load_robot(name)
    random = np.random.default_rng(SEED)
    for seed in range(12):
        path = joint_wave(robot, seed)
        near = np.array(random.uniform(*np.clip(robot.limits, -3.0, 3.0).T))
        quick, long = track(robot, path, near=near), by_the_long_way(robot, path, near, monkeypatch)
        np.testing.assert_allclose(quick.q, long.q, atol=1e-9)
        assert quick.jumps == long.jumps


def test_the_sources_ellipse_is_such_a_path(monkeypatch: pytest.MonkeyPatch) -> None:
    robot = load_robot("ur5e")
    monkeypatch.setattr(sequence, "_chosen", None)  # not to be asked
    tracking = track(robot, named_path("ellipse-moved", robot))
    assert tracking.complete
    assert not tracking.jumps


@pytest.mark.parametrize("name", ["rv-m1", "rv-1a", "ur5e", "al5b"])
def test_steps_that_are_small_enough_to_need_no_midpoint_pass_the_midpoint_test(name: str) -> None:
    robot = load_robot(name)
    random = np.random.default_rng(SEED)
    start = random.uniform(-3.0, 3.0, (2000, robot.dof))
    way = random.normal(size=start.shape)
    end = start + way * (0.999 * continuity._SMALL_STEP / np.abs(way).sum(axis=1, keepdims=True))
    assert all(continuity._in_small_steps(robot, np.array(pair)) for pair in zip(start[:50], end[:50], strict=True))
    first, middle, last = forward_kinematics(robot, np.stack([start, 0.5 * (start + end), end]))
    near, _ = continuity.beside(robot, first, middle, last, True)
    assert near.all()
