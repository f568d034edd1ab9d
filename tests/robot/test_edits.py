"""An edited DH value gives another arm whose solid look, home and masses go along."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim.errors import RobotDefinitionError, UnknownNameError
from rvsim.kinematics import link_transforms
from rvsim.robot import BoxShape, CapsuleShape, Joint, LinkMass, Robot
from rvsim.robot.edits import with_dh_value
from rvsim.scene.points import link_corners

LENGTHS = st.floats(0.02, 2.0)


def arm(convention="standard", **changes) -> Robot:
    """Three revolute joints and a slide: a column d1, links a2 and a3 with an offset d3."""
    alpha = 90.0 if convention == "standard" else 0.0
    joints = (
        Joint("waist", "revolute", 0.0, 0.4, 0.0, math.radians(alpha), -2.0, 2.0),
        Joint("shoulder", "revolute", 0.3, 0.0, 0.5, 0.0, -1.0, 1.5, home=1.0),
        Joint("elbow", "revolute", 0.0, -0.1, -0.3, math.pi / 2),
        Joint("slide", "prismatic", 0.0, 0.2, 0.0, 0.0, 0.0, 0.5),
    )
    return Robot("arm", "Arm", convention, joints, **changes)


def place(robot, frame, point):
    return (link_transforms(robot, np.zeros(robot.dof))[frame] @ [*point, 1.0])[:3]


@given(LENGTHS)
def test_a_capsule_that_spans_a_link_spans_it_when_it_is_longer(a2):
    robot = arm(shapes=(CapsuleShape(2, (-0.5, 0, 0), (0, 0, 0), 0.04),))
    edited = with_dh_value(robot, 1, "a", a2)
    T = link_transforms(edited, np.zeros(4))
    np.testing.assert_allclose(place(edited, 2, edited.shapes[0].start), T[1, :3, 3], atol=1e-12)
    np.testing.assert_allclose(place(edited, 2, edited.shapes[0].end), T[2, :3, 3], atol=1e-12)


@given(LENGTHS)
def test_a_modified_row_stretches_the_link_before_it(a3):
    robot = arm("modified", shapes=(CapsuleShape(1, (0, 0, 0), (0.5, 0, 0), 0.04),))
    edited = with_dh_value(robot, 1, "a", a3)
    np.testing.assert_allclose(edited.shapes[0].start, 0.0, atol=1e-12)
    np.testing.assert_allclose(edited.shapes[0].end, [a3, 0, 0], atol=1e-12)


@given(LENGTHS)
def test_the_base_column_grows_with_d1_in_the_base_and_in_link_1(d1):
    shapes = (CapsuleShape(0, (0, 0, 0), (0, 0, 0.4), 0.1), CapsuleShape(1, (0, -0.4, 0), (0, 0, 0), 0.1))
    edited = with_dh_value(arm(shapes=shapes), 0, "d", d1)
    np.testing.assert_allclose(edited.shapes[0].end, [0, 0, d1], atol=1e-12)
    np.testing.assert_allclose(place(edited, 1, edited.shapes[1].start), 0.0, atol=1e-12)
    np.testing.assert_allclose(place(edited, 1, edited.shapes[1].end), [0, 0, d1], atol=1e-12)


@pytest.mark.parametrize("convention", ["standard", "modified"])
@pytest.mark.parametrize("key", ["a", "d"])
def test_a_link_that_had_no_length_is_bridged_from_the_axis_before_to_its_own_frame(convention, key):
    robot = arm(convention, shapes=(CapsuleShape(0, (0, 0, 0), (0, 0, 0.3), 0.1),))
    joint = {"a": 0, "d": 1}[key]
    edited = with_dh_value(robot, joint, key, 0.25)
    bars = [[place(edited, bar.frame, end) for end in (bar.start, bar.end)] for bar in edited.shapes[1:]]
    T = link_transforms(edited, np.zeros(4))
    way = np.array([T[joint, :3, 3], link_corners(edited, T)[joint], T[joint + 1, :3, 3]])
    pieces = [way[0:2], way[1:3]] if convention == "standard" else [way[1:3], way[0:2]]  # d, then a
    wanted = pieces[:1] if key == "d" else pieces[::-1]
    np.testing.assert_allclose(bars, wanted, atol=1e-12)
    assert with_dh_value(edited, joint, key, 0.0, look_of=robot).shapes == robot.shapes


@given(LENGTHS)
def test_what_overhangs_a_link_keeps_its_overhang(a2):
    box = BoxShape(2, (-0.25, 0.02, 0.01), (0.6, 0.1, 0.2))
    edited = with_dh_value(arm(shapes=(box,)), 1, "a", a2).shapes[0]
    np.testing.assert_allclose(edited.size, [a2 + 0.1, 0.1, 0.2], atol=1e-12)
    np.testing.assert_allclose(edited.center + edited.size / 2, [0.05, 0.07, 0.11], atol=1e-12)


def test_a_box_across_a_slanted_offset_is_moved_and_not_stretched():
    box = BoxShape(1, (0.0, -0.2, -0.2), (0.1, 0.1, 0.1))
    slanted = arm(shapes=(box,)).with_joint(0, alpha=math.pi / 4)
    edited = with_dh_value(slanted, 0, "d", 0.8).shapes[0]
    np.testing.assert_array_equal(edited.size, box.size)
    assert np.linalg.norm(edited.center - box.center) > 0.05


def test_a_link_that_was_0_for_a_moment_gets_its_look_back():
    robot = arm(shapes=(CapsuleShape(2, (-0.5, 0, 0), (0, 0.03, 0), 0.04),))
    flat = with_dh_value(robot, 1, "a", 0.0, look_of=robot)
    np.testing.assert_allclose(flat.shapes[0].start, 0.0, atol=1e-12)
    back = with_dh_value(flat, 1, "a", 0.5, look_of=robot)
    np.testing.assert_array_equal(back.shapes[0].start, robot.shapes[0].start)
    np.testing.assert_array_equal(back.shapes[0].end, robot.shapes[0].end)


@pytest.mark.parametrize(("joint", "key"), [(1, "theta"), (1, "alpha"), (3, "d"), (1, "upper")])
def test_edits_that_change_no_length_of_a_link_leave_its_look_alone(joint, key):
    robot = arm(shapes=(CapsuleShape(2, (-0.5, 0, 0), (0, 0, 0), 0.04), CapsuleShape(4, (0, 0, -1), (0, 0, 0), 0.02)))
    edited = with_dh_value(robot, joint, key, 1.2)
    for before, after in zip(robot.shapes, edited.shapes, strict=True):
        np.testing.assert_array_equal(before.start, after.start)


def test_a_home_outside_the_new_limits_moves_to_the_nearest_one():
    assert with_dh_value(arm(), 1, "upper", 0.5).joints[1].home == 0.5
    assert with_dh_value(arm(), 1, "lower", 1.2).joints[1].home == 1.2
    assert with_dh_value(arm(), 1, "upper", math.inf).joints[1].home == 1.0


def test_only_the_mass_of_the_edited_link_is_marked_as_assumed():
    masses = tuple(LinkMass(1.0, np.zeros(3), np.eye(3), source="data sheet") for _ in range(4))
    for convention, key, marked in (("standard", "a", 1), ("modified", "a", 0), ("modified", "d", 1)):
        edited = with_dh_value(arm(convention, masses=masses), 1, key, 0.7)
        assert [mass.assumed for mass in edited.masses] == [index == marked for index in range(4)]
        assert [mass.mass for mass in edited.masses] == [1.0] * 4
    assert not any(mass.assumed for mass in with_dh_value(arm(masses=masses), 1, "upper", 1.4).masses)


def test_the_edited_arm_is_a_copy():
    robot = arm()
    edited = with_dh_value(robot, 1, "a", 0.7)
    assert (robot.joints[1].a, edited.joints[1].a) == (0.5, 0.7)
    assert replace(edited.joints[1], a=0.5) == robot.joints[1]


def test_what_makes_no_arm_is_refused():
    with pytest.raises(RobotDefinitionError, match="not finite"):
        with_dh_value(arm(), 1, "a", math.inf)
    with pytest.raises(RobotDefinitionError, match="below its upper limit"):
        with_dh_value(arm(), 1, "lower", 1.5)
    with pytest.raises(RobotDefinitionError, match="home"):
        with_dh_value(arm(), 1, "home", 9.0)
    with pytest.raises(UnknownNameError, match="alpha"):
        with_dh_value(arm(), 1, "alfa", 1.0)
