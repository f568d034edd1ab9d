"""What the search offers instead is the best there is: nothing sampled comes nearer."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim import forward_kinematics, inverse_kinematics, load_robot
from rvsim.kinematics import free_pitch_batch
from rvsim.kinematics.inverse.nearest import nearest_configuration
from rvsim.spatial import rotation_from_vector

ARMS = ("rv-m1", "rv-1a", "ur5e", "al5b", "rrrp", "articulated", "spherical", "scara", "cylindrical")
SAMPLED = 100_000


def random_targets(count: int, size: float, middle: np.ndarray) -> np.ndarray:
    rng = np.random.default_rng(7)
    T = np.tile(np.eye(4), (count, 1, 1))
    T[:, :3, :3] = rotation_from_vector(rng.normal(size=(count, 3)))
    T[:, :3, 3] = middle + rng.uniform(-0.6, 0.6, (count, 3)) * size
    return T


@pytest.mark.parametrize("name", ARMS)
def test_no_pose_within_the_limits_comes_nearer(name, random_q):
    robot = load_robot(name)
    places = forward_kinematics(robot, random_q(robot, SAMPLED))[:, :3, 3]
    for T in random_targets(12, robot.size, robot.T_base_0[:3, 3]):
        failure = inverse_kinematics(robot, T).failure
        if failure is not None:
            best = np.linalg.norm(places - T[:3, 3], axis=1).min()
            if failure.kind == "orientation":
                assert failure.nearest.position_error < 1e-7 * robot.size
            else:
                assert failure.nearest.position_error < best + 1e-7 * robot.size
            nearest = failure.nearest
            np.testing.assert_allclose(forward_kinematics(robot, nearest.q), nearest.T, atol=1e-9)
            assert nearest.position_error == pytest.approx(np.linalg.norm(nearest.T[:3, 3] - T[:3, 3]), abs=1e-12)
            if failure.kind == "limits":
                assert (nearest.q >= robot.limits[:, 0]).all()
                assert (nearest.q <= robot.limits[:, 1]).all()


def test_where_a_5r_arm_cannot_have_the_projected_pitch_it_has_the_nearest_it_can():
    robot, seen = load_robot("rv-m1"), 0
    pitches = np.linspace(-np.pi, np.pi, 3601)
    for T in random_targets(60, 0.6, np.array([0.0, 0.0, 0.15])):
        failure = inverse_kinematics(robot, T).failure
        if failure is not None and failure.kind == "orientation" and failure.nearest.rotation_error > 0.0:
            q = free_pitch_batch(robot, T[None, :3, 3], pitches)[0, :, :2].reshape(-1, 5)
            axes = forward_kinematics(robot, q[~np.isnan(q).any(axis=1)])[:, :3, 2]
            # The roll can make up for all but the angle between the tool axes.
            best = np.arccos(np.clip(axes @ T[:3, 2], -1.0, 1.0)).min()
            assert failure.nearest.rotation_error == pytest.approx(best, abs=2e-3)
            seen += 1
    assert seen > 10


def test_two_axes_in_one_line_stop_no_search(random_q):
    robot = load_robot("ur5e").with_joint(1, alpha=0.0, a=0.0)
    for q in random_q(robot, 6):
        T = forward_kinematics(robot, q)
        found = nearest_configuration(robot, T, robot.home, robot.limits, robot.home[None], place_only=False)
        assert found.position_error < 1e-7 * robot.size
