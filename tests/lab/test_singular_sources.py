"""What sources 000 and 004 say of singularities, held against the arm itself."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim import jacobian, load_robot, singularity
from rvsim.lab.singular_sources import barriers, minors, position_jacobian, wrist_split

HERE = np.deg2rad([10.0, 40.0, -50.0, 20.0, 60.0])


def random_poses(name: str, count: int) -> np.ndarray:
    return np.random.default_rng(6).uniform(-2.5, 2.5, (count, load_robot(name).dof))


def printed_jacobian(theta: np.ndarray, a2: float, a3: float, d: float) -> np.ndarray:
    """Source 000's Ĵ, entry by entry as printed below (27), for its own θ."""
    s, c = np.sin, np.cos
    t1, t2, t23, t234 = theta[0], theta[1], theta[1] + theta[2], theta[1] + theta[2] + theta[3]
    out, up = a2 * c(t2) + a3 * c(t23) + d * s(t234), a2 * s(t2) + a3 * s(t23) - d * c(t234)
    rest = a3 * s(t23) - d * c(t234)
    return np.array(
        [
            [-s(t1) * out, -c(t1) * up, -c(t1) * rest, d * c(t1) * c(t234)],
            [-c(t1) * out, s(t1) * up, s(t1) * rest, -d * s(t1) * c(t234)],
            [0.0, d * s(t234) + a2 * c(t2) + a3 * c(t23), d * s(t234) + a3 * c(t23), d * s(t234)],
        ]
    )


def test_the_printed_position_jacobian_is_right_but_for_the_sense_of_joint_1():
    robot = load_robot("rv-m1")
    for q in random_poses("rv-m1", 50):
        theta = np.add(q, [0.0, 0.0, 0.0, np.pi / 2, 0.0])
        theta[0] = -q[0]
        printed = printed_jacobian(theta, 0.25, 0.16, 0.072) * [-1.0, 1.0, 1.0, 1.0]
        np.testing.assert_allclose(position_jacobian(robot, q), printed, atol=1e-14)


@pytest.mark.parametrize("tool", ["flange", "standard hand"])
def test_the_minors_are_what_they_are_when_worked_out(tool):
    robot = load_robot("rv-m1").with_tool(tool)
    a2, a3, d = 0.25, 0.16, 0.072 + robot.T_flange_tool[2, 3]
    for q in random_poses("rv-m1", 50):
        s3, s4, s34 = np.sin(q[2]), np.sin(q[3]), np.sin(q[2] + q[3])
        bend = np.cumsum(q[1:4])
        r = a2 * np.cos(bend[0]) + a3 * np.cos(bend[1]) + d * np.cos(bend[2])
        expected = [-r * a2 * (a3 * s3 + d * s34), -r * d * (a2 * s34 + a3 * s4), -r * a3 * d * s4]
        np.testing.assert_allclose([minor.value for minor in minors(robot, q)], expected, atol=1e-15)


def test_the_barriers_are_those_of_the_list():
    robot = load_robot("rv-m1")
    found = np.rad2deg([barrier.q[1:4] for barrier in barriers(robot, HERE)])
    listed = [(2, 0.0, 3, 0.0), (1, -30.0, 3, 0.0), (1, 100.0, 3, 0.0), (2, -110.0, 3, 72.406), (3, 90.0, 2, -24.228)]
    assert len(found) == len(listed)
    for first, value, second, other in listed:
        assert (np.abs(found[:, [first - 1, second - 1]] - [value, other]) < 1e-3).all(axis=1).any()


def test_each_barrier_takes_a_direction_from_the_three_joints_that_are_left():
    robot = load_robot("rv-m1")
    for barrier in barriers(robot, HERE):
        left = [joint for joint in range(4) if joint != barrier.stop]
        assert abs(np.linalg.det(position_jacobian(robot, barrier.q)[:, left])) < 1e-12
        stop = robot.limits[barrier.stop]
        assert np.abs(stop - barrier.q[barrier.stop]).min() < 1e-12


def test_only_the_first_of_them_is_singular_and_the_set_31_is_not():
    robot = load_robot("rv-m1")
    found = barriers(robot, HERE)
    assert [barrier.printed for barrier in found if barrier.singular] == ["(30)"]
    first = next(barrier for barrier in found if barrier.printed == "(31)")
    np.testing.assert_allclose(first.sigma, [0.470, 0.217, 0.112], atol=5e-4)
    assert first.verdict.startswith("Not singular: σ = 0.470, 0.217, 0.112 m. A barrier: joint 2 is at its stop")
    assert singularity(robot, first.q).position.rank == 3


def test_the_source_misses_the_tip_on_the_base_axis():
    robot = load_robot("rv-m1")
    q = np.array([0.0, np.deg2rad(94.0), np.deg2rad(-10.26), 0.0, 0.0])
    q[3] = np.pi - np.arccos((0.25 * np.cos(q[1]) + 0.16 * np.cos(q[1] + q[2])) / 0.072) - q[1] - q[2]
    assert abs(np.sin(q[2])) > 0.1
    np.testing.assert_allclose([minor.value for minor in minors(robot, q)], 0.0, atol=1e-12)


@pytest.mark.parametrize("name", ["rv-1a"])
def test_a_spherical_wrist_splits_the_determinant(name):
    robot = load_robot(name)
    for q in random_poses(name, 50):
        split = wrist_split(robot, q)
        assert split.arm * split.wrist == pytest.approx(split.whole, abs=1e-15)
        assert split.whole == pytest.approx(np.linalg.det(jacobian(robot, q)), abs=1e-15)
        assert abs(split.wrist) == pytest.approx(abs(np.sin(q[4])), abs=1e-12)
