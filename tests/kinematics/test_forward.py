"""Forward kinematics is the textbook's product of matrices, for every arm, every convention, one pose or many."""

from __future__ import annotations

from functools import reduce

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim import forward_kinematics, link_transforms, load_robot, robot_names
from rvsim.errors import ShapeError
from rvsim.kinematics import dh_transform, joint_transforms
from rvsim.robot import Joint, Robot, Tool
from rvsim.spatial import rot_x, rot_z, transform_from_twist, translation

ORACLE_NAMES = {"rv-m1": "rvm1", "rv-1a": "rv1a", "ur5e": "ur5e", "rrrp": "rrrp", "al5b": "al5b"}
MANY = 300  # enough for blocks of arrays; up to twenty poses go one by one


def random_poses(robot: Robot, *shape: int, seed: int = 1) -> np.ndarray:
    return np.random.default_rng(seed).uniform(-np.pi, np.pi, (*shape, robot.dof))


def textbook_links(robot: Robot, q: np.ndarray) -> np.ndarray:
    transforms = np.moveaxis(joint_transforms(robot, q), -3, 0)
    links = [np.broadcast_to(robot.T_base_0, transforms.shape[1:])]
    for A in transforms:
        links.append(links[-1] @ A)
    return np.stack(links, axis=-3)


@pytest.mark.parametrize("name", ORACLE_NAMES)
def test_the_tool_is_where_the_oracle_says(name, oracle):
    samples = oracle["robots"][ORACLE_NAMES[name]]["samples"]
    robot = load_robot(name)
    for sample in samples:
        np.testing.assert_allclose(forward_kinematics(robot, sample["q"]), sample["T"], rtol=0.0, atol=1e-12)
    q, T = (np.array([sample[key] for sample in samples]) for key in "qT")
    np.testing.assert_allclose(forward_kinematics(robot, q), T, rtol=0.0, atol=1e-12)


def test_the_rv_m1_stands_where_its_manual_geometry_puts_it():
    p = forward_kinematics(load_robot("rv-m1"), np.deg2rad([30.0, 40.0, -50.0, 20.0, 60.0]))[:3, 3]
    np.testing.assert_allclose(p, [0.3637, 0.2100, 0.2974], atol=5e-5)


@pytest.mark.parametrize("name", robot_names())
def test_every_arm_is_the_product_of_its_matrices_with_each_tool(name):
    robot = load_robot(name)
    for held in (robot.with_tool(tool.name) for tool in robot.tools):
        q = random_poses(held, MANY)
        links = textbook_links(held, q)
        np.testing.assert_allclose(link_transforms(held, q), links, atol=1e-14)
        np.testing.assert_allclose(forward_kinematics(held, q), links[:, -1] @ held.T_flange_tool, atol=1e-14)


@pytest.mark.parametrize("name", robot_names())
def test_one_pose_at_a_time_gives_the_same_as_all_at_once(name):
    robot = load_robot(name)
    q = random_poses(robot, MANY)
    for function in (forward_kinematics, link_transforms):
        np.testing.assert_allclose(function(robot, q), [function(robot, pose) for pose in q], atol=4e-15)


angles = st.one_of(st.integers(-4, 4).map(lambda k: k * np.pi / 2), st.floats(-3.2, 3.2))
lengths = st.one_of(st.just(0.0), st.floats(-1.0, 1.0))
joints = st.builds(Joint, st.just("j"), st.sampled_from(["revolute", "prismatic"]), angles, lengths, lengths, angles)
placements = st.lists(lengths, min_size=6, max_size=6).map(transform_from_twist)
arms = st.builds(
    lambda convention, rows, base, tool: Robot("any", "Any", convention, tuple(rows), base, (Tool("t", "T", tool),)),
    st.sampled_from(["standard", "modified"]),
    st.lists(joints, min_size=1, max_size=7),
    placements,
    placements,
)


@given(arms, st.integers(0, 1000))
def test_any_dh_table_is_the_product_of_its_matrices(robot, seed):
    q = random_poses(robot, 30, seed=seed)
    links = textbook_links(robot, q)
    for rows in (slice(None), slice(2), 0):
        np.testing.assert_allclose(link_transforms(robot, q[rows]), links[rows], atol=2e-13)
        expected = links[rows][..., -1, :, :] @ robot.T_flange_tool
        np.testing.assert_allclose(forward_kinematics(robot, q[rows]), expected, atol=2e-13)


def test_the_two_conventions_are_the_stated_products_of_turns_and_shifts():
    row = theta, d, a, alpha = 0.3, 0.1, 0.2, -0.9
    about_z = np.eye(4)
    about_z[:3, :3] = rot_z(theta)
    about_x = np.eye(4)
    about_x[:3, :3] = rot_x(alpha)
    shift_z, shift_x = translation([0.0, 0.0, d]), translation([a, 0.0, 0.0])
    for convention, factors in {
        "standard": (about_z, shift_z, shift_x, about_x),
        "modified": (about_x, shift_x, shift_z, about_z),
    }.items():
        np.testing.assert_allclose(dh_transform(*row, convention), reduce(np.matmul, factors), atol=1e-16)


def test_a_long_arm_of_a_hundred_joints_is_no_special_case():
    robot = Robot("snake", "Snake", "standard", tuple(Joint(f"j{i}", "revolute", 0, 0, 0.1, 0.5) for i in range(100)))
    q = random_poses(robot, 30)
    expected = textbook_links(robot, q)[:, -1]
    np.testing.assert_allclose(forward_kinematics(robot, q), expected, atol=1e-12)
    np.testing.assert_allclose(forward_kinematics(robot, q[0]), expected[0], atol=1e-12)


@pytest.mark.parametrize("shape", [(), (0,), (1,), (20,), (21,), (3, 4), (5, 0, 2), (5000,), (2, 4096)])
def test_any_leading_shape(shape):
    robot = load_robot("ur5e")
    q = random_poses(robot, *shape)
    T, links = forward_kinematics(robot, q), link_transforms(robot, q)
    assert T.shape == (*shape, 4, 4)
    assert links.shape == (*shape, 7, 4, 4)
    assert T.flags.c_contiguous
    np.testing.assert_allclose(links[..., -1, :, :] @ robot.T_flange_tool, T, atol=1e-14)


@pytest.mark.parametrize("name", robot_names())
@pytest.mark.parametrize("count", [1, MANY])
def test_whole_turns_change_nothing(name, count):
    robot = load_robot(name)
    q = random_poses(robot, count)
    turns = np.random.default_rng(2).integers(-3, 4, q.shape) * robot.is_revolute
    moved = forward_kinematics(robot, q + 2.0 * np.pi * turns)
    np.testing.assert_allclose(moved, forward_kinematics(robot, q), atol=1e-13)


@pytest.mark.parametrize("value", [np.pi, -np.pi, np.pi / 2, 3 * np.pi, 2 * np.pi, 1e5 * np.pi])
@pytest.mark.parametrize("count", [1, MANY])
def test_half_turns_are_as_exact_as_any_angle(value, count):
    robot = load_robot("ur5e")
    q = np.full((count, 6), value)
    np.testing.assert_allclose(forward_kinematics(robot, q), textbook_links(robot, q)[:, -1], atol=1e-10)
    if abs(value) < 10.0:
        np.testing.assert_allclose(forward_kinematics(robot, q), textbook_links(robot, q)[:, -1], atol=4e-15)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_what_is_not_finite_spoils_its_own_pose_only_and_raises_nothing(bad):
    robot = load_robot("ur5e")
    for count in (2, MANY):
        q = random_poses(robot, count)
        expected = forward_kinematics(robot, q)
        q[1, 2] = bad
        found = forward_kinematics(robot, q)
        assert np.isnan(found[1]).any()
        np.testing.assert_allclose(np.delete(found, 1, axis=0), np.delete(expected, 1, axis=0), atol=0.0)


@pytest.mark.parametrize("count", [1, MANY])
def test_a_joint_that_is_not_a_number_leaves_the_links_before_it_alone(count):
    robot = load_robot("ur5e")
    q = random_poses(robot, count)
    expected = link_transforms(robot, q)
    q[0, 3] = np.nan
    found = link_transforms(robot, q)
    np.testing.assert_array_equal(found[:, :4], expected[:, :4])
    assert np.isnan(found[0, 4:]).any(axis=(-2, -1)).all()


def test_lengths_near_the_largest_float_overflow_instead_of_failing():
    robot = Robot("huge", "Huge", "standard", tuple(Joint(f"j{i}", "prismatic", 0, 1e308, 0, 0) for i in range(3)))
    for q in (np.zeros(3), np.zeros((MANY, 3))):
        assert np.isinf(forward_kinematics(robot, q)[..., 2, 3]).all()


def test_a_result_belongs_to_the_caller():
    robot = load_robot("planar")
    first = forward_kinematics(robot, robot.home)
    expected = first.copy()
    first[:] = 0.0
    np.testing.assert_array_equal(forward_kinematics(robot, list(robot.home)), expected)


@pytest.mark.parametrize("q", [0.0, [0.0] * 5, [[0.0] * 7], np.zeros((6, 1)), np.zeros((0, 5))])
@pytest.mark.parametrize("function", [forward_kinematics, link_transforms, joint_transforms])
def test_a_wrong_number_of_joints_is_named(function, q):
    with pytest.raises(ShapeError, match=r"q must have the shape \(\.\.\., 6\)"):
        function(load_robot("ur5e"), q)
