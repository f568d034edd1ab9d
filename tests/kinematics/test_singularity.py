"""Singular poses: the numbers are the oracle's, the families are exactly where the Jacobian loses rank."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim import Robot, forward_kinematics, jacobian, link_transforms, load_robot, robot_names, singularity
from rvsim.errors import ShapeError, UnknownNameError
from rvsim.kinematics import families_known, go_to_singularity, lost_motions, singular_families
from rvsim.robot import Joint
from rvsim.spatial import transform_from_twist

ORACLE_NAMES = {"rv-m1": "rvm1", "rv-1a": "rv1a", "ur5e": "ur5e", "rrrp": "rrrp", "al5b": "al5b"}
POSITION_NAMES = {"tip_on_axis_position_only": "tip on axis", "zero_extension_position_only": "zero extension"}
FIVE_AXIS = ("rv-m1", "al5b")


def names(families) -> list[str]:
    return [family.name for family in families]


def random_poses(robot: Robot, count: int, seed: int = 4) -> np.ndarray:
    return np.random.default_rng(seed).uniform(-2.5, 2.5, (count, robot.dof))


def family(robot: Robot, name: str, part: str = "pose"):
    return next(each for each in singular_families(robot) if (each.name, each.part) == (name, part))


@pytest.mark.parametrize("name", ORACLE_NAMES)
def test_numbers_and_families_are_the_oracles(name, oracle):
    robot = load_robot(name)
    for sample in oracle["robots"][ORACLE_NAMES[name]]["samples"]:
        found = singularity(robot, sample["q"])
        assert found.sigma_min == pytest.approx(sample["sigma_min"], abs=1e-9)
        assert (found.rank < robot.dof) == sample["singular"] == (found.lost is not None)
        assert names(found.families) == sample["families"]
        assert names(found.position_families) == [POSITION_NAMES[each] for each in sample["aux"]]


@pytest.mark.parametrize("name", FIVE_AXIS)
def test_the_gram_determinant_of_a_5r_arm_has_two_factors(name):
    for robot in (load_robot(name).with_tool(tool.name) for tool in load_robot(name).tools):
        q = random_poses(robot, 200)
        J, (a2, a3) = jacobian(robot, q), sorted(robot.dh[:, 2])[-2:]
        s3 = family(robot, "elbow").values(q)[:, 0]
        r, tilt = family(robot, "coaxial").values(q).T
        gram = np.linalg.det(np.swapaxes(J, -1, -2) @ J)
        np.testing.assert_allclose(gram, (a2 * a3 * s3) ** 2 * (r**2 + tilt**2), atol=1e-15)
        np.testing.assert_allclose(np.abs(r), np.linalg.norm(forward_kinematics(robot, q)[:, :2, 3], axis=1))


def test_the_determinants_of_the_six_axis_arms_have_three_factors():
    factors = {"ur5e": 0.425 * 0.3922, "rv-1a": 0.25 * np.hypot(0.09, 0.16)}
    for name, factor in factors.items():
        robot = load_robot(name)
        q = random_poses(robot, 200)
        product = np.prod([family(robot, part).values(q)[:, 0] for part in ("elbow", "shoulder", "wrist")], axis=0)
        np.testing.assert_allclose(np.abs(np.linalg.det(jacobian(robot, q))), np.abs(factor * product), atol=1e-15)
    robot, a = load_robot("rv-1a"), {"a2": -0.25, "a3": -0.09, "d4": 0.16}
    q = random_poses(robot, 200)
    s3, c3, s5 = np.sin(q[:, 2]), np.cos(q[:, 2]), np.sin(q[:, 4])
    r = a["a2"] * np.cos(q[:, 1]) + a["a3"] * np.cos(q[:, 1] + q[:, 2]) + a["d4"] * np.sin(q[:, 1] + q[:, 2])
    expected = -a["a2"] * (a["a3"] * s3 - a["d4"] * c3) * r * s5
    np.testing.assert_allclose(np.linalg.det(jacobian(robot, q)), expected, atol=1e-15)


@pytest.mark.parametrize(
    ("name", "rows", "columns", "factor"),
    [
        ("rrrp", (0, 1, 2), (0, 1, 3), 1.0),
        ("planar", (0, 1), (0, 1), 0.3 * 0.25),
        ("articulated", (0, 1, 2), (0, 1, 2), 0.3 * 0.28),
        ("spherical", (0, 1, 2), (0, 1, 2), 1.0),
        ("scara", (0, 1, 2, 5), (0, 1, 2, 3), 0.25 * 0.2),
        ("cylindrical", (0, 1, 2), (0, 1, 2), 1.0),
    ],
)
def test_where_an_arm_places_a_point_its_families_are_the_factors(name, rows, columns, factor):
    robot = load_robot(name)
    q = random_poses(robot, 100)
    product = np.prod([each.values(q)[:, 0] for each in singular_families(robot)], axis=0)
    task = jacobian(robot, q)[:, rows][:, :, columns]
    np.testing.assert_allclose(np.abs(np.linalg.det(task)), np.abs(factor * product), atol=1e-12)


@pytest.mark.parametrize("name", robot_names())
def test_each_family_within_reach_is_entered_and_does_what_it_says(name):
    robot = load_robot(name)
    here = np.clip(robot.home + 0.2, *robot.limits.T)
    for each in singular_families(robot):
        way = go_to_singularity(robot, each, here)
        q = way.outside if way.q is None else way.q
        assert q is not None
        assert each.measure(q) < 1e-9
        found = singularity(robot, q)
        numbers = found.task if each.part == "pose" else found.position
        assert numbers.rank < numbers.full_rank
        assert each in (*found.families, *found.position_families)
        if way.q is None:
            assert all(robot.joint_names[joint] in way.reason for joint in way.joints)
            assert way.joints
        else:
            assert (robot.limits[:, 0] <= q).all()
            assert (q <= robot.limits[:, 1]).all()


def test_the_elbow_of_the_rv_1a_is_outside_its_limits():
    robot = load_robot("rv-1a")
    way = go_to_singularity(robot, "elbow", robot.home)
    assert way.q is None
    assert way.reason == "The elbow singularity lies outside the limits of elbow."
    with pytest.raises(UnknownNameError, match="elbow, shoulder, wrist"):
        go_to_singularity(robot, "knee", robot.home)


@pytest.mark.parametrize("name", robot_names())
def test_away_from_its_families_an_arm_keeps_its_rank(name):
    robot = load_robot(name)
    for q in random_poses(robot, 60):
        found = singularity(robot, q)
        clear = min([float(each.measure(q)) for each in singular_families(robot)], default=1.0) > 0.01
        if clear:
            assert found.task.rank == found.task.full_rank
            assert (found.families, found.position_families, found.task.lost) == ((), (), None)


lengths = st.floats(0.1, 1.0)
signs = st.sampled_from([-1.0, 1.0])
offsets = st.floats(-1.0, 1.0)


@given(lengths, lengths, offsets, offsets, offsets, offsets, signs, st.lists(offsets, min_size=6, max_size=6))
def test_an_arm_of_the_users_own_has_the_families_of_its_shape(a2, a3, a1, d1, d5, theta3, sign, base):
    rows = ((0, d1, a1, sign * np.pi / 2), (0.3, 0, a2, 0), (theta3, 0, -a3, 0), (0, 0, 0, np.pi / 2), (0, d5, 0, 0))
    joints = tuple(Joint(f"j{i}", "revolute", *row) for i, row in enumerate(rows))
    robot = Robot("own", "Own", "standard", joints, transform_from_twist(base))
    elbow = family(robot, "elbow")
    for q in random_poses(robot, 3):
        q[2] = -theta3 + np.pi * (q[2] > 0)
        assert elbow.measure(q) < 1e-12
        assert singularity(robot, q).rank < 5
        q[2] += 0.4
        assert elbow.measure(q) > 0.3


def test_an_arm_of_no_known_shape_has_numbers_only():
    robot = load_robot("ur5e").with_joint(3, alpha=0.7)
    assert not families_known(robot)
    assert singular_families(robot) == ()
    assert singularity(robot, robot.home).rank == 6
    assert families_known(load_robot("cartesian"))
    assert singular_families(load_robot("cartesian")) == ()


@pytest.mark.parametrize("name", ["rv-m1", "al5b", "ur5e", "rv-1a"])
def test_what_is_lost_no_joint_speed_makes_and_near_by_one_does(name):
    robot = load_robot(name)
    for each in (f for f in singular_families(robot) if f.part == "pose"):
        way = go_to_singularity(robot, each, robot.home)
        q = way.outside if way.q is None else way.q
        assert q is not None
        found = singularity(robot, q)
        assert found.lost is not None
        np.testing.assert_allclose(found.lost @ jacobian(robot, q), 0.0, atol=1e-8)
        nearby = [jacobian(robot, q + step) for step in 1e-3 * np.eye(robot.dof)]
        assert max(np.abs(found.lost @ J).max() for J in nearby) > 1e-6


def test_the_stretched_rv_m1_cannot_move_along_its_arm():
    robot, q = load_robot("rv-m1"), np.array([0.3, 0.7, 0.0, 0.4, 0.2])
    origins = link_transforms(robot, q)[:, :3, 3]
    arm = (origins[3] - origins[1]) / np.linalg.norm(origins[3] - origins[1])
    (lost,) = lost_motions(singularity(robot, q).whole, robot.size)
    assert lost.kind == "move"
    np.testing.assert_allclose(lost.direction, arm, atol=1e-9)
    tip = forward_kinematics(robot, q)[:3, 3]
    np.testing.assert_allclose(np.cross(tip + lost.offset - origins[1], arm), 0.0, atol=1e-9)


def test_upright_on_its_base_axis_a_5r_arm_loses_a_way_and_a_turn():
    robot = load_robot("al5b")
    way = go_to_singularity(robot, "coaxial", robot.home)
    assert way.q is not None
    motions = lost_motions(singularity(robot, way.q).whole, robot.size)
    assert [motion.kind for motion in motions] == ["move", "turn"]
    assert motions[0].direction @ motions[1].direction == pytest.approx(0.0, abs=1e-9)
    assert motions[0].direction[2] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("name", ["ur5e", "rv-1a"])
def test_a_motion_lost_on_its_own_asks_no_joint_speed_that_there_is(name):
    robot = load_robot(name)
    way = go_to_singularity(robot, "wrist", robot.home)
    assert way.q is not None
    found = singularity(robot, way.q)
    motions = lost_motions(found.whole, robot.size)
    assert [(motion.kind, motion.alone) for motion in motions] == [("move", True), ("turn", True)]
    for motion in motions:
        twist = np.zeros(6)
        twist[3 * (motion.kind == "turn") :][:3] = motion.direction
        qd = np.linalg.lstsq(found.J, twist, rcond=1e-9)[0]
        assert np.linalg.norm(found.J @ qd - twist) > 0.05


@pytest.mark.parametrize(
    ("pose", "expected"),
    [((0, -90, 0, -90, -90, 0), ["move", "move"]), ((0, -90, 0, -90, 0, 0), ["move", "move", "turn"])],
)
def test_where_several_motions_are_lost_at_once_each_is_named_along_an_axis(pose, expected):
    robot, q = load_robot("ur5e"), np.deg2rad(pose)
    found = singularity(robot, q)
    motions = lost_motions(found.whole, robot.size)
    assert sorted(motion.kind for motion in motions) == expected
    assert found.rank == 6 - len(motions)
    for motion in motions:
        assert np.abs(motion.direction).max() == pytest.approx(1.0)
        force = motion.direction if motion.kind == "move" else np.zeros(3)
        moment = np.cross(motion.offset, force) if motion.kind == "move" else motion.direction
        np.testing.assert_allclose(np.concatenate([force, moment]) @ found.J, 0.0, atol=1e-9)


def test_the_planar_arm_is_judged_by_its_own_task():
    robot = load_robot("planar")
    found = singularity(robot, [0.5, 0.0])
    assert names(found.families) == ["elbow"]
    assert found.families[0].kind == "boundary"
    assert (found.rank, found.task.rank, found.task.full_rank) == (2, 1, 2)
    (lost,) = lost_motions(found.task, robot.size)
    np.testing.assert_allclose(lost.direction, [np.cos(0.5), np.sin(0.5), 0.0], atol=1e-9)


def test_the_set_31_of_source_000_is_not_singular():
    robot = load_robot("rv-m1")
    at_its_stop = np.deg2rad([0.0, -30.0, -40.0, 0.0, 0.0])
    found = singularity(robot, at_its_stop)
    assert found.families == found.position_families == ()
    assert found.position.rank == 3


def test_condition_and_manipulability_come_from_the_singular_values():
    robot = load_robot("ur5e")
    found = singularity(robot, [0.2, -1.2, 0.8, 0.5, 1.0, 0.3])
    assert found.manipulability == pytest.approx(abs(np.linalg.det(found.J)))
    assert found.condition == pytest.approx(np.linalg.cond(found.J))
    assert found.task.ratio == pytest.approx(1.0 / found.condition)
    assert singularity(robot, np.zeros(6)).condition == np.inf


def test_the_tip_of_an_arm_without_lengths_moves_nowhere():
    planar = load_robot("planar")
    short = replace(planar, joints=tuple(replace(joint, a=0.0, d=0.0) for joint in planar.joints))
    found = singularity(short, [0.3, 0.4]).position
    assert (found.rank, found.ratio, found.condition) == (0, 0.0, np.inf)


def test_the_limits_hold_on_the_way_into_a_family():
    robot = load_robot("planar")
    bent = replace(robot, joints=(robot.joints[0], replace(robot.joints[1], lower=0.2, home=0.5)))
    way = go_to_singularity(bent, "elbow", bent.home)
    assert (way.q, way.joints) == (None, (1,))


def test_a_wrong_number_of_joints_is_named():
    with pytest.raises(ShapeError, match="q must have"):
        singularity(load_robot("rv-m1"), np.zeros(6))
