"""Speeds and accelerations are derivatives; what an arm cannot do is said, never hidden in huge joint speeds."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim import Robot, forward_kinematics, jacobian, load_robot, robot_names
from rvsim.errors import SettingError, ShapeError, UnknownNameError
from rvsim.kinematics import (
    analytic_jacobian,
    angle_measure,
    jacobian_dot,
    joint_accelerations,
    joint_rates,
    tool_acceleration,
    tool_jacobian,
    tool_twist,
)
from rvsim.robot import Joint, Tool
from rvsim.spatial import rpy_from_rotation, transform_from_twist, zyz_from_rotation

READ = {"rpy": rpy_from_rotation, "zyz": zyz_from_rotation}
STRETCHED = [0.3, 0.7, 0.0, 0.4, 0.2]  # the elbow of a 5R arm


def random_states(robot: Robot, *shape: int, seed: int = 5) -> np.ndarray:
    return np.random.default_rng(seed).uniform(-2.0, 2.0, (3, *shape, robot.dof))


def assert_rate_of_the_jacobian(robot: Robot) -> None:
    q, qd, _ = random_states(robot, 6)
    step = 1e-5
    difference = (jacobian(robot, q + step * qd) - jacobian(robot, q - step * qd)) / (2.0 * step)
    np.testing.assert_allclose(jacobian_dot(robot, q, qd), difference, atol=1e-8)


@pytest.mark.parametrize("name", robot_names())
def test_the_rate_of_the_jacobian_is_its_derivative(name):
    assert_rate_of_the_jacobian(load_robot(name))


lengths = st.floats(-1.0, 1.0)
joints = st.builds(
    Joint, st.just("j"), st.sampled_from(["revolute", "prismatic"]), lengths, lengths, lengths, st.floats(-3.2, 3.2)
)
placements = st.lists(lengths, min_size=6, max_size=6).map(transform_from_twist)


@given(st.lists(joints, min_size=1, max_size=7), st.sampled_from(["standard", "modified"]), placements, placements)
def test_of_any_dh_table_too(rows, convention, base, tool):
    assert_rate_of_the_jacobian(Robot("any", "Any", convention, tuple(rows), base, (Tool("tool", "Tool", tool),)))


@pytest.mark.parametrize("name", robot_names())
def test_the_tools_acceleration_is_the_derivative_of_its_twist(name):
    robot = load_robot(name)
    q, qd, qdd = random_states(robot, 4)
    step = 1e-5
    twists = [tool_twist(robot, q + t * qd + 0.5 * t * t * qdd, qd + t * qdd) for t in (-step, step)]
    np.testing.assert_allclose(tool_acceleration(robot, q, qd, qdd), (twists[1] - twists[0]) / (2 * step), atol=1e-7)


@pytest.mark.parametrize("name", robot_names())
@pytest.mark.parametrize("shape", [(), (0,), (2, 3)])
def test_any_leading_shape(name, shape):
    robot = load_robot(name)
    q, qd, qdd = random_states(robot, *shape)
    for matrix in (jacobian_dot(robot, q, qd), tool_jacobian(robot, q), analytic_jacobian(robot, q)):
        assert matrix.shape == (*shape, 6, robot.dof)
    assert tool_twist(robot, q, qd).shape == tool_acceleration(robot, q, qd, qdd).shape == (*shape, 6)
    assert angle_measure(robot, q).shape == shape


@pytest.mark.parametrize("name", robot_names())
def test_in_tool_axes_only_the_axes_differ(name):
    robot = load_robot(name)
    q = random_states(robot, 5)[0]
    R = forward_kinematics(robot, q)[..., :3, :3]
    back = np.concatenate([R @ tool_jacobian(robot, q)[..., rows, :] for rows in (slice(3), slice(3, 6))], axis=-2)
    np.testing.assert_allclose(back, jacobian(robot, q), atol=1e-14)


@pytest.mark.parametrize("name", ["rv-m1", "ur5e", "al5b", "rv-1a"])
@pytest.mark.parametrize("angles", READ)
def test_the_analytic_jacobian_gives_the_rates_of_the_angles(name, angles):
    robot = load_robot(name)
    q, qd, _ = random_states(robot, 40)
    step = 1e-6
    poses = [forward_kinematics(robot, q + t * qd) for t in (-step, step)]
    change = READ[angles](poses[1][:, :3, :3]) - READ[angles](poses[0][:, :3, :3])
    change -= 2.0 * np.pi * np.rint(change / (2.0 * np.pi))
    rates = (analytic_jacobian(robot, q, angles) @ qd[..., None])[..., 0]
    clear = angle_measure(robot, q, angles) > 0.2
    assert clear.sum() > 20
    np.testing.assert_allclose(rates[clear, 3:], (change / (2.0 * step))[clear], atol=1e-6)


def test_angles_that_are_singular_have_no_rates_though_the_arm_is_well():
    arm, level = load_robot("rv-m1"), [0.0, 0.5, -1.0, 0.5, np.pi / 2]  # the tool's x axis stands upright
    assert angle_measure(arm, level, "rpy") < 1e-12
    J = analytic_jacobian(arm, level, "rpy")
    assert np.isnan(J[3:]).all()
    np.testing.assert_array_equal(J[:3], jacobian(arm, level)[:3])
    assert np.isfinite(analytic_jacobian(arm, level, "zyz")).all()
    with pytest.raises(UnknownNameError, match="rpy, zyz"):
        analytic_jacobian(arm, level, "xyz")  # type: ignore[arg-type]


@pytest.mark.parametrize("name", robot_names())
def test_a_twist_the_arm_makes_is_found_again(name):
    robot = load_robot(name)
    q, qd, qdd = (states[0] for states in random_states(robot, 1, seed=8))
    rates = joint_rates(robot, q, tool_twist(robot, q, qd), threshold=0.0)
    assert rates.feasible
    assert rates.damping == 0.0
    np.testing.assert_allclose(rates.qd, qd, atol=1e-10)
    np.testing.assert_allclose(rates.lost, 0.0, atol=1e-12)
    found = joint_accelerations(robot, q, qd, tool_acceleration(robot, q, qd, qdd), threshold=0.0)
    assert found.feasible
    np.testing.assert_allclose(found.qdd, qdd, atol=1e-9)


@pytest.mark.parametrize("name", ["rv-m1", "al5b"])
def test_five_joints_cannot_turn_the_tool_out_of_its_plane(name):
    robot = load_robot(name)
    q = np.array([0.0, 0.6, -0.9, 0.3, 0.2])  # the arm's plane is x z
    rates = joint_rates(robot, q, [0.0, 0.0, 0.0, 0.0, 0.0, 1.0])
    assert not rates.feasible
    np.testing.assert_allclose(rates.achieved + rates.lost, [0, 0, 0, 0, 0, 1], atol=1e-14)
    inside = joint_rates(robot, q, [0.0, 0.0, 0.1, 0.0, 0.5, 0.0])
    assert inside.feasible


def test_at_a_singularity_only_the_lost_direction_suffers():
    robot = load_robot("rv-m1")
    arm_axis = np.array([np.cos(0.3) * np.cos(0.7), np.sin(0.3) * np.cos(0.7), np.sin(0.7)])
    stuck = joint_rates(robot, STRETCHED, [*(0.1 * arm_axis), 0, 0, 0])
    assert not stuck.feasible
    assert stuck.damping == pytest.approx(0.01)
    assert np.abs(stuck.qd).max() < 60.0
    possible = tool_twist(robot, STRETCHED, [0.4, 0.2, 0.2, -0.3, 0.1])
    np.testing.assert_allclose(joint_rates(robot, STRETCHED, possible).achieved, possible, atol=1e-12)


@pytest.mark.parametrize("bend", [0.0, 1e-9, 1e-4, 1e-2, 0.05])
def test_joint_speeds_stay_bounded_on_the_way_into_a_singularity(bend):
    robot = load_robot("ur5e")
    q = np.array([0.2, -1.2, bend, 0.5, 1.0, 0.3])
    for twist in np.diag([robot.size] * 3 + [1.0] * 3):
        assert np.abs(joint_rates(robot, q, twist, threshold=0.02).qd).max() <= 2.0 / (np.sqrt(3.0) * 0.02) + 1e-9


def test_the_weight_of_a_length_does_not_change_what_is_feasible():
    robot, q = load_robot("ur5e"), [0.2, -1.2, 0.8, 0.5, 1.0, 0.3]
    one, other = (joint_rates(robot, q, np.ones(6), threshold=0.0, length=length) for length in (0.1, 10.0))
    np.testing.assert_allclose(one.achieved, other.achieved, atol=1e-12)


def test_wrong_arguments_are_named():
    robot = load_robot("rv-m1")
    with pytest.raises(ShapeError, match="twist"):
        joint_rates(robot, robot.home, np.zeros(5))
    with pytest.raises(SettingError, match="threshold must be 0 or more"):
        joint_rates(robot, robot.home, np.zeros(6), threshold=-1.0)
    with pytest.raises(SettingError, match="length must be above 0"):
        joint_rates(robot, robot.home, np.zeros(6), length=0.0)
