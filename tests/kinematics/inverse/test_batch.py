"""All branches of many poses: the true configuration is always among them, and every branch is one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rvsim import forward_kinematics, inverse_branches, inverse_kinematics, inverse_kinematics_batch, load_robot
from rvsim.errors import NoClosedFormError, ShapeError
from rvsim.kinematics import branch_labels
from rvsim.robot import Robot, Tool
from rvsim.spatial import rot_z, transform_from_twist

ARMS = {  # the arm, and how many entries of a pose its own task asks for
    "rv-m1": 6, "rv-1a": 6, "ur5e": 6, "rrrp": 6, "al5b": 6, "scara": 6,
    "planar": 3, "articulated": 3, "spherical": 3, "cylindrical": 3, "cartesian": 3,
}  # fmt: skip
MANY = 3000


def tilted(robot: Robot) -> Robot:
    """On a slanted base, with a tool that stands off in every direction."""
    base, tool = (
        transform_from_twist([0.3, -0.2, 0.1, 0.4, -0.3, 0.8]),
        transform_from_twist([0.02, -0.03, 0.09, 0.5, 0.2, -0.7]),
    )
    return replace(robot, T_base_0=base @ robot.T_base_0, tools=(Tool("odd", "odd", tool),), tool_name="odd")


def longer(robot: Robot) -> Robot:
    """Every length of the DH table half as long again, every zero of a revolute joint moved."""
    for i, joint in enumerate(robot.joints):
        turn = 0.3 if joint.revolute else 0.0
        robot = robot.with_joint(i, a=1.5 * joint.a, d=1.5 * joint.d, theta=joint.theta + turn)
    return robot


def shoulder_beside_the_axis(robot: Robot) -> Robot:
    """With a distance between axes 1 and 2 (a row further down in the modified convention)."""
    return robot.with_joint(0 if robot.convention == "standard" else 1, a=0.07)


EDITS = {"as shipped": lambda robot: robot, "tilted": tilted, "longer": longer, "shoulder": shoulder_beside_the_axis}


def right(robot: Robot, q: np.ndarray, T: np.ndarray, entries: int) -> np.ndarray:
    """(m, branches) the residual of each branch, NaN where there is none."""
    error = np.full(q.shape[:2], np.nan)
    exists = ~np.isnan(q).any(axis=2)
    wanted = np.broadcast_to(T[:, None], (*q.shape[:2], 4, 4))[exists]
    difference = np.abs(forward_kinematics(robot, q[exists]) - wanted)
    error[exists] = (difference if entries == 6 else difference[:, :3, 3:]).max(axis=(1, 2))
    return error


@pytest.mark.parametrize("edit", EDITS)
@pytest.mark.parametrize("name", ARMS)
def test_the_true_configuration_is_among_the_branches_and_every_branch_is_right(name, edit, random_q, apart):
    robot = EDITS[edit](load_robot(name))
    true = random_q(robot, MANY)
    T = forward_kinematics(robot, true)
    q = inverse_kinematics_batch(robot, T)
    assert q.shape == (MANY, len(branch_labels(robot)), robot.dof)
    assert np.array_equal(np.isnan(q).any(axis=2), np.isnan(q).all(axis=2))
    assert np.nanmax(right(robot, q, T, ARMS[name])) < 1e-9
    # How well a branch is known depends on how near it is to a singular pose; the residual above does not.
    assert np.nanmin(apart(robot, q, true[:, None]), axis=1).max() < 1e-5


@pytest.mark.parametrize("name", ARMS)
def test_no_branch_comes_twice(name, random_q, apart):
    robot = load_robot(name)
    q = inverse_kinematics_batch(robot, forward_kinematics(robot, random_q(robot, 500)))
    gaps = apart(robot, q[:, :, None], q[:, None])
    different = ~np.eye(q.shape[1], dtype=bool)
    assert np.nanmin(gaps[:, different], initial=np.inf) > 1e-5


@pytest.mark.parametrize("name", ARMS)
def test_at_and_beside_round_angles_there_is_a_branch_and_none_that_is_slightly_wrong(name):
    robot = load_robot(name)
    rng = np.random.default_rng(5)
    shape = (2000, robot.dof)
    round_angles = np.where(robot.is_revolute, rng.integers(-4, 5, shape) * (np.pi / 4.0), 0.25)
    beside = rng.choice([-1.0, 0.0, 1.0], shape) * 10.0 ** rng.uniform(-17.0, -2.0, shape)
    T = forward_kinematics(robot, round_angles + beside)
    q = inverse_kinematics_batch(robot, T)
    assert (~np.isnan(q).any(axis=2)).any(axis=1).all()
    assert np.nanmax(right(robot, q, T, ARMS[name])) < 1e-9


@pytest.mark.parametrize("edit", EDITS)
def test_beside_a_free_wrist_and_a_straight_elbow_one_pose_has_the_branches_of_the_batch(edit):
    robot = EDITS[edit](load_robot("ur5e"))
    rng = np.random.default_rng(6)
    q = rng.uniform(-np.pi, np.pi, (500, 6))
    q[:, 2], q[:, 4] = 10.0 ** rng.uniform(-13.0, -4.0, 500), 10.0 ** rng.uniform(-9.0, -1.0, 500)
    T = forward_kinematics(robot, q)
    for pose, batch in zip(T, inverse_kinematics_batch(robot, T), strict=True):
        ours = inverse_branches(robot, pose)
        assert 0 < len(ours) == (~np.isnan(batch[:, 0])).sum()
        assert right(robot, ours[None], pose[None], ARMS["ur5e"]).max() < 1e-9


def test_angles_come_within_half_a_turn(random_q):
    robot = load_robot("ur5e")
    q = inverse_kinematics_batch(robot, forward_kinematics(robot, random_q(robot, 200)))
    assert np.nanmax(np.abs(q)) <= np.pi


@pytest.mark.parametrize("name", ARMS)
def test_one_pose_has_the_branches_of_the_batch(name, random_q):
    robot = tilted(load_robot(name))
    for T in forward_kinematics(robot, random_q(robot, 20)):
        q = inverse_kinematics_batch(robot, T[None])[0]
        np.testing.assert_allclose(inverse_branches(robot, T), q[~np.isnan(q).any(axis=1)], atol=1e-10)


def test_in_plain_floats_a_ur5e_has_the_same_branches_in_the_same_order(random_q, apart):
    robot = load_robot("ur5e")
    T = np.concatenate([forward_kinematics(robot, random_q(robot, 300)), np.eye(4)[None]])
    T[-1, :3, 3] = 0.05, 0.0, 0.3  # nearer to the base axis than its shoulder is wide
    for pose, q in zip(T, inverse_kinematics_batch(robot, T), strict=True):
        ours = inverse_branches(robot, pose)
        assert len(ours) == (~np.isnan(q[:, 0])).sum()
        assert apart(robot, ours, q[~np.isnan(q[:, 0])]).max(initial=0.0) < 1e-10


@pytest.mark.parametrize("entry", [(0, 2), (1, 3), (2, 2), (2, 3)])
def test_a_pose_that_is_not_finite_has_no_branches(entry):
    T = forward_kinematics(load_robot("ur5e"), np.full(6, 0.3))
    T[entry] = np.nan
    assert inverse_branches(load_robot("ur5e"), T).shape == (0, 6)


def test_a_pose_that_leans_out_of_the_arms_plane_is_solved_only_when_projected():
    robot = load_robot("rv-m1")
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = [[0, 0, 1], [1, 0, 0], [0, 1, 0]], (0.2, 0.2, 0.3)
    assert np.isnan(inverse_kinematics_batch(robot, T[None])).all()
    assert not np.isnan(inverse_kinematics_batch(robot, T[None], project=True)).any()
    lean = rot_z(2e-9)
    T[:3, 3] = 0.3, 0.0, 0.3
    assert not np.isnan(inverse_kinematics_batch(robot, T[None])).any()
    T[:3, :3] = lean @ T[:3, :3]
    assert np.isnan(inverse_kinematics_batch(robot, T[None])).all()


def test_a_vertical_tool_above_the_base_axis_leaves_joint_one_where_it_is():
    robot = load_robot("rv-m1")
    q = np.array([0.0, 1.5, -1.9, 0.0, 0.4])
    q[3] = np.pi / 2.0 - q[1] - q[2]
    T = forward_kinematics(robot, q)
    T[:2, 3] = 0.0
    for near in (0.0, 1.0, -2.0):
        here = [near, 0.0, 0.0, 0.0, 0.0]
        branches = inverse_kinematics(robot, T, near=here).branches
        assert branches
        for branch in branches:
            assert branch.continuum
            assert min(abs(branch.q[0] - near), abs(abs(branch.q[0] - near) - np.pi)) < 1e-12


def test_no_poses_have_no_branches():
    assert inverse_kinematics_batch(load_robot("ur5e"), np.empty((0, 4, 4))).shape == (0, 8, 6)
    assert inverse_kinematics_batch(load_robot("rv-m1"), np.empty((0, 4, 4)), project=True).shape == (0, 4, 5)


def test_a_batch_is_a_stack_of_poses():
    for shape in ((4, 4), (2, 3, 3), (2, 2, 4, 4)):
        with pytest.raises(ShapeError):
            inverse_kinematics_batch(load_robot("rv-m1"), np.zeros(shape))


def test_only_a_5r_arm_projects():
    with pytest.raises(NoClosedFormError, match="projected only for a 5R arm"):
        inverse_kinematics_batch(load_robot("ur5e"), np.eye(4)[None], project=True)
