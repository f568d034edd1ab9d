"""Which arm a closed form fits, and what its branches are called."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim import forward_kinematics, inverse_kinematics_batch, link_transforms, load_robot
from rvsim.kinematics import branch_labels
from rvsim.kinematics.inverse.chain import canonical_chain
from rvsim.robot import Joint, Robot

# The frames of link_transforms at shoulder, elbow, wrist, and at the point that is in front or behind.
FRAMES = {
    "rv-m1": (1, 2, 3, 5),
    "al5b": (2, 3, 4, 5),
    "rv-1a": (1, 2, 4, 4),
    "ur5e": (1, 2, 3, 5),
    "articulated": (1, 2, 3, 3),
}


def puma() -> Robot:
    """A PUMA 560: its shoulder stands beside the base axis, its forearm beside the upper arm (Lee 1982)."""
    rows = [
        (0.672, 0.0, 90.0),
        (0.0, 0.4318, 0.0),
        (0.15, 0.0203, -90.0),
        (0.4318, 0.0, 90.0),
        (0.0, 0.0, -90.0),
        (0.0, 0.0, 0.0),
    ]
    joints = [Joint(f"q{i}", "revolute", 0.0, d, a, np.radians(alpha)) for i, (d, a, alpha) in enumerate(rows)]
    return Robot("puma", "PUMA 560", "standard", tuple(joints))


def craig_puma() -> Robot:
    """The same in Craig's convention: a and alpha one row further down."""
    joints = puma().joints
    moved = [(0.0, 0.0), *((joint.a, joint.alpha) for joint in joints[:-1])]
    rows = [Joint(j.name, "revolute", 0.0, j.d, a, alpha) for j, (a, alpha) in zip(joints, moved, strict=True)]
    return Robot("craig", "PUMA 560", "modified", tuple(rows))


@pytest.mark.parametrize("make", [puma, craig_puma])
def test_an_arm_that_is_not_shipped_is_solved_because_its_rows_fit(make, random_q, apart):
    robot = make()
    true = random_q(robot, 2000)
    q = inverse_kinematics_batch(robot, forward_kinematics(robot, true))
    assert set(branch_labels(robot)) == set(branch_labels(load_robot("rv-1a")))
    assert np.nanmin(apart(robot, q, true[:, None]), axis=1).max() < 1e-5


def test_a_stanford_like_5r_arm_with_its_axes_the_other_way_round_is_solved(random_q, apart):
    robot = load_robot("rv-m1")
    for i, joint in enumerate(robot.joints):
        robot = robot.with_joint(i, alpha=-joint.alpha if i % 2 else joint.alpha + np.pi * (i == 2), a=-joint.a)
    true = random_q(robot, 1000)
    q = inverse_kinematics_batch(robot, forward_kinematics(robot, true))
    assert np.nanmin(apart(robot, q, true[:, None]), axis=1).max() < 1e-5


@pytest.mark.parametrize("beside", [{0: 0.05}, {3: 0.03}, {0: -0.04, 3: -0.02}])
def test_axes_that_pass_beside_each_other_are_solved_on_both_sides(beside, random_q, apart):
    robot = load_robot("rv-m1")
    for joint, a in beside.items():
        robot = robot.with_joint(joint, a=a)
    true = random_q(robot, 1000)
    T = forward_kinematics(robot, true)
    q = inverse_kinematics_batch(robot, T)
    assert np.nanmin(apart(robot, q, true[:, None]), axis=1).max() < 1e-5
    there = ~np.isnan(q[..., 0])
    poses = np.broadcast_to(T[:, None], (*there.shape, 4, 4))[there]
    np.testing.assert_allclose(forward_kinematics(robot, q[there]), poses, atol=1e-9)
    assert there[:, :2].any()
    assert there[:, 2:].any()


def test_the_normal_form_is_the_same_arm(random_q):
    for name in ("rv-m1", "rv-1a", "ur5e", "rrrp", "al5b", "scara", "cylindrical", "cartesian"):
        robot = load_robot(name)
        chain = canonical_chain(robot)
        assert (chain.alpha >= 0.0).all()
        for q in random_q(robot, 5):
            place = chain.T_base_0 @ np.append(chain.place(chain.inner(q).tolist()), 1.0)
            np.testing.assert_allclose(place[:3], forward_kinematics(robot, q)[:3, 3], atol=1e-12)


@pytest.mark.parametrize("name", FRAMES)
def test_elbow_up_is_up(name, random_q):
    robot, labels = load_robot(name), branch_labels(load_robot(name))
    q = inverse_kinematics_batch(robot, forward_kinematics(robot, random_q(robot, 300)))
    origins = link_transforms(robot, q)[..., :3, 3]
    shoulder, elbow, wrist, target = (origins[:, :, frame] for frame in FRAMES[name])
    for up, label in enumerate(labels):
        if "elbow up" in label:
            down = labels.index(label.replace("elbow up", "elbow down"))
            out = ((wrist - shoulder)[:, up, :2] * target[:, up, :2]).sum(axis=1) > 0.0  # not folded back behind
            exists = out & ~np.isnan(q[:, [up, down], 0]).any(axis=1)
            assert exists.any()
            assert (elbow[exists, up, 2] > elbow[exists, down, 2] - 1e-9).all()


@pytest.mark.parametrize("name", ["rv-1a", "articulated"])
def test_front_faces_the_wrist(name, random_q):
    robot, labels = load_robot(name), branch_labels(load_robot(name))
    links = link_transforms(robot, inverse_kinematics_batch(robot, forward_kinematics(robot, random_q(robot, 200))))
    ahead = (links[..., 1, :2, 0] * links[..., FRAMES[name][2], :2, 3]).sum(axis=-1)
    for i, label in enumerate(labels):
        assert ((ahead[:, i] > 0.0) == ("front" in label)).all()


@pytest.mark.parametrize("name", ["rv-1a", "ur5e"])
def test_no_flip_is_a_positive_sine_of_joint_five(name, random_q):
    robot, labels = load_robot(name), branch_labels(load_robot(name))
    q = inverse_kinematics_batch(robot, forward_kinematics(robot, random_q(robot, 200)))
    for i, label in enumerate(labels):
        sine = np.sin(q[~np.isnan(q[:, i, 4]), i, 4])
        assert ((sine > 0.0) == ("no-flip" in label)).all()
