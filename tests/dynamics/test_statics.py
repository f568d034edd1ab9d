"""τ = Jᵀ F does the work of F, and the largest force is the one at which a joint reaches its limit."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rvsim import forward_kinematics, jacobian, load_robot, robot_names
from rvsim.dynamics import joint_torques, largest_force, payload_wrench, wrench_in_base
from rvsim.errors import SettingError, ShapeError

ORACLE_NAMES = {"rv-m1": "rvm1", "rv-1a": "rv1a", "ur5e": "ur5e", "rrrp": "rrrp", "al5b": "al5b"}


def random(*shape: int) -> np.ndarray:
    return np.random.default_rng(11).uniform(-2.0, 2.0, shape)


@pytest.mark.parametrize("name", ORACLE_NAMES)
def test_the_torques_are_the_oracles(name, oracle):
    samples = oracle["robots"][ORACLE_NAMES[name]]["samples"]
    q, F, tau = (np.array([sample[key] for sample in samples]) for key in ("q", "F", "tau"))
    np.testing.assert_allclose(joint_torques(load_robot(name), q, F), tau, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(joint_torques(load_robot(name), q[0], F[0]), tau[0], rtol=0.0, atol=1e-9)


@pytest.mark.parametrize("name", robot_names())
def test_the_joints_give_the_power_that_the_tool_takes(name):
    robot = load_robot(name)
    q, qd, F = random(20, robot.dof), random(20, robot.dof), random(20, 6)
    twist = (jacobian(robot, q) @ qd[..., None])[..., 0]
    np.testing.assert_allclose(np.sum(joint_torques(robot, q, F) * qd, axis=-1), np.sum(F * twist, axis=-1), atol=1e-9)


def test_a_wrench_in_tool_axes_turns_with_the_tool():
    robot = load_robot("rv-1a")
    q, F = random(5, 6), random(6)
    R = forward_kinematics(robot, q)[:, :3, :3]
    expected = np.concatenate([R @ F[:3], R @ F[3:]], axis=-1)
    np.testing.assert_allclose(wrench_in_base(robot, q, F), expected, atol=1e-12)
    np.testing.assert_allclose(payload_wrench(np.array([0.0, 2.0]), 9.8)[:, 2], [0.0, 19.6])


LIMITS = np.array([10.0, 20.0, 15.0, 5.0, 3.0])


@pytest.mark.parametrize("direction", [[0, 0, 1], [1, -2, 0.5], [0, 0, 0, 0, 0, 1], [1, 0, 0, 0, 0.2, 0]])
@pytest.mark.parametrize("held", [0.0, 2.0])
def test_the_largest_force_puts_one_joint_at_its_limit_and_none_beyond(direction, held):
    robot, q = load_robot("rv-m1"), np.array([0.3, 0.5, -0.8, 0.4, 0.1])
    found = largest_force(robot, q, direction, LIMITS, holding=np.full(5, held))
    assert np.all(np.abs(found.torques) <= LIMITS * (1 + 1e-12))
    assert abs(found.torques[found.joint]) == pytest.approx(LIMITS[found.joint])
    unit = np.zeros(6)
    unit[: len(direction)] = direction
    unit /= np.linalg.norm(unit[:3]) or np.linalg.norm(unit[3:])
    np.testing.assert_allclose(joint_torques(robot, q, found.force * unit) + held, found.torques, atol=1e-9)


def test_where_the_bearings_hold_it_all_the_force_has_no_bound():
    planar = load_robot("planar")
    sideways = largest_force(planar, [0.3, 0.4], [0, 0, 1], [1.0, 1.0])
    assert sideways.force == math.inf
    assert sideways.joint is None
    stretched = largest_force(planar, [0.0, 0.0], [1, 0, 0], [1.0, 1.0])
    assert stretched.force == math.inf


def test_an_overloaded_joint_leaves_no_force():
    found = largest_force(load_robot("planar"), [0.3, 0.4], [1, 0, 0], [1.0, 1.0], holding=[0.0, 2.0])
    assert found.force == 0.0
    assert found.joint == 1


def test_what_makes_no_sense_is_refused():
    planar = load_robot("planar")
    with pytest.raises(SettingError, match="direction"):
        largest_force(planar, [0, 0], [0, 0, 0], [1, 1])
    with pytest.raises(SettingError, match="torque_limits"):
        largest_force(planar, [0, 0], [0, 0, 1], [1, -1])
    with pytest.raises(ShapeError, match="torque_limits"):
        largest_force(planar, [0, 0], [0, 0, 1], [1, 1, 1])
    with pytest.raises(ShapeError, match="direction"):
        largest_force(planar, [0, 0], [1, 0], [1, 1])
    with pytest.raises(ShapeError, match="wrench"):
        joint_torques(planar, [0, 0], [1, 0, 0])
