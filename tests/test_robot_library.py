"""The shipped arms: what their files say is what the sources and the reference values say."""

from __future__ import annotations

import json
import math
import re
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rvsim import Robot, forward_kinematics, link_transforms, load_robot, robot_names
from rvsim.robot import CapsuleShape, Shape

ORACLE = Path(__file__).parent / "oracles" / "oracle.json"
ORACLE_KEYS = {"rv-m1": "rvm1", "rv-1a": "rv1a", "ur5e": "ur5e", "rrrp": "rrrp", "al5b": "al5b"}
TEXTBOOK = robot_names()[5:]
OKABE_ITO = ["#E69F00", "#56B4E9", "#009E73", "#F0E442", "#0072B2", "#D55E00", "#CC79A7"]


@cache
def oracle_robots() -> dict[str, Any]:
    robots: dict[str, Any] = json.loads(ORACLE.read_text())["robots"]
    return robots


def random_poses(robot: Robot, count: int = 50) -> np.ndarray:
    spans = np.where(robot.is_revolute, np.pi, 2.0)
    return np.random.default_rng(7).uniform(-spans, spans, (count, robot.dof))


def lowest_point(shape: Shape, T: np.ndarray) -> float:
    if isinstance(shape, CapsuleShape):
        return min((T @ [*end, 1.0])[2] - shape.radius for end in (shape.start, shape.end))
    return float((T @ [*shape.center, 1.0])[2] - np.abs(T[2, :3]) @ shape.size / 2)


# --- every arm -----------------------------------------------------------------------------------------------------


def test_the_five_arms_of_the_sources_come_first_then_the_textbook_arms() -> None:
    assert robot_names() == (
        *("rv-m1", "rv-1a", "ur5e", "rrrp", "al5b"),
        *("planar", "articulated", "spherical", "scara", "cylindrical", "cartesian"),
    )


@pytest.mark.parametrize("name", robot_names())
def test_an_arm_answers_to_its_name_in_any_letters(name: str) -> None:
    assert load_robot(name).name == load_robot(f" {name.upper()} ").name == name


@pytest.mark.parametrize("name", robot_names())
def test_home_lies_within_the_limits(name: str) -> None:
    robot = load_robot(name)
    assert np.all(robot.limits[:, 0] <= robot.home)
    assert np.all(robot.home <= robot.limits[:, 1])


@pytest.mark.parametrize("name", robot_names())
def test_every_arm_cites_its_source_and_tells_what_to_know(name: str) -> None:
    robot = load_robot(name)
    assert len(robot.source) > 60
    assert len(robot.notes.splitlines()) >= 2
    assert robot.family
    for joint in robot.joints:
        for datum in (joint.max_speed, joint.max_acceleration, joint.max_torque):
            assert datum is None or datum.assumed or len(datum.source) > 10


@pytest.mark.parametrize("name", robot_names())
def test_joints_wear_the_palette_in_its_order(name: str) -> None:
    robot = load_robot(name)
    assert [joint.color for joint in robot.joints] == OKABE_ITO[: robot.dof]


@pytest.mark.parametrize("name", robot_names())
def test_every_link_has_a_body_that_shows_the_colour_of_its_joint(name: str) -> None:
    robot = load_robot(name)
    assert {shape.frame for shape in robot.shapes if shape.color} >= {0}
    assert {shape.frame for shape in robot.shapes if not shape.color} >= set(range(1, robot.dof + 1))


@pytest.mark.parametrize("name", robot_names())
def test_at_home_no_body_reaches_through_the_floor(name: str) -> None:
    robot = load_robot(name)
    T = link_transforms(robot, robot.home)
    assert min(lowest_point(shape, T[shape.frame]) for shape in robot.shapes) > -1e-9


@pytest.mark.parametrize("name", TEXTBOOK)
def test_what_no_source_gives_is_marked_as_assumed(name: str) -> None:
    robot = load_robot(name)
    assert all(joint.dh_assumed and joint.limits_assumed for joint in robot.joints)
    assert "ours" in robot.source


# --- the arms of the sources ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(("name", "key"), ORACLE_KEYS.items())
def test_dh_rows_equal_the_reference(name: str, key: str) -> None:
    robot, reference = load_robot(name), oracle_robots()[key]
    rows = [[row[field] for field in ("theta_offset", "d", "a", "alpha")] for row in reference["rows"]]
    assert robot.convention == {"std": "standard", "mod": "modified"}[reference["dh"]]
    assert [kind[0].upper() for kind in robot.joint_types] == [row["type"] for row in reference["rows"]]
    assert_allclose(robot.dh, rows, rtol=0, atol=1e-15)


@pytest.mark.parametrize(("name", "key"), ORACLE_KEYS.items())
def test_limits_base_and_tool_equal_the_reference(name: str, key: str) -> None:
    robot, reference = load_robot(name), oracle_robots()[key]
    limits = [[-math.inf if lo is None else lo, math.inf if hi is None else hi] for lo, hi in reference["qlim"]]
    assert_allclose(robot.limits, limits, rtol=0, atol=1e-14)
    assert_allclose(robot.T_base_0, reference["base"], rtol=0, atol=0)
    assert_allclose(robot.T_flange_tool, reference["tool"], rtol=0, atol=0)


@pytest.mark.parametrize(
    ("name", "q_deg", "p", "R"),
    [
        ("rv-m1", [0] * 5, (0.482, 0, 0.152), [[0, 0, 1], [1, 0, 0], [0, 1, 0]]),
        ("rv-1a", [0] * 6, (-0.34, 0, 0.639), np.eye(3)),
        ("rv-1a", [0, 90, 0, 0, 0, 0], (0.339, 0, 0.640), None),
        ("ur5e", [0] * 6, (-0.8172, -0.2329, 0.0628), [[1, 0, 0], [0, 0, -1], [0, 1, 0]]),
        ("rrrp", [0] * 4, (5, 4, 3), np.diag([-1, -1, 1])),
        ("al5b", [0] * 5, (0.33147, 0, 0.06858), [[0, 0, 1], [0, 1, 0], [-1, 0, 0]]),
    ],
)
def test_poses_that_can_be_read_off_the_drawing(name: str, q_deg: list[float], p: Any, R: Any) -> None:
    T = forward_kinematics(load_robot(name), np.radians(q_deg))
    assert_allclose(T[:3, 3], p, atol=1e-12)
    if R is not None:
        assert_allclose(T[:3, :3], R, atol=1e-12)


def test_the_rv_m1_is_that_of_its_source() -> None:
    robot = load_robot("rv-m1")
    assert robot.joint_names == ("waist", "shoulder", "elbow", "wrist pitch", "wrist roll")
    assert_allclose(robot.home, np.zeros(5), atol=0)
    assert robot.gripper is not None
    millimetres = [[-35, 0, 0], [-35, 0, -60], [0, 0, -60], [35, 0, -60], [35, 0, 0]]
    assert_allclose(robot.gripper.points * 1e3, millimetres, atol=1e-12)


def test_the_standard_hand_reaches_107_mm_beyond_the_flange() -> None:
    flange, hand = load_robot("rv-m1"), load_robot("rv-m1").with_tool("standard hand")
    reach = forward_kinematics(hand, flange.home) - forward_kinematics(flange, flange.home)
    assert_allclose(reach[:3, 3], (0.107, 0, 0), atol=1e-15)


def test_the_ur5e_has_the_masses_and_speeds_of_its_maker() -> None:
    robot = load_robot("ur5e")
    assert [link.mass for link in robot.masses] == [3.761, 8.058, 2.846, 1.37, 1.3, 0.365]
    assert_allclose(robot.masses[1].com, (0.2125, 0, 0.11336), atol=1e-15)
    assert_allclose(robot.masses[5].inertia, np.diag([0, 0, 2e-4]), atol=0)
    speeds = [joint.max_speed for joint in robot.joints]
    assert all(speed is not None and not speed.assumed and speed.value == pytest.approx(math.pi) for speed in speeds)


def test_the_rrrp_arm_counts_in_units_and_turns_without_end() -> None:
    robot = load_robot("rrrp")
    assert robot.length_unit == "unit"
    assert [joint.continuous for joint in robot.joints] == [True, False, True, False]


def test_sources_are_cited_by_author_and_never_by_place() -> None:
    for name in robot_names():
        assert not re.search(r"https?:|/work|\.txt", load_robot(name).source)


# --- the textbook arms against closed forms derived by hand --------------------------------------------------------


def test_planar() -> None:
    robot = load_robot("planar")
    q = random_poses(robot)
    (a1, a2), z = robot.dh[:, 2], robot.T_base_0[2, 3]
    s1, s12 = q[:, 0], q[:, 0] + q[:, 1]
    p = [a1 * np.cos(s1) + a2 * np.cos(s12), a1 * np.sin(s1) + a2 * np.sin(s12), np.full(len(q), z)]
    assert_allclose(forward_kinematics(robot, q)[:, :3, 3], np.transpose(p), atol=1e-14)


def test_articulated() -> None:
    robot = load_robot("articulated")
    q = random_poses(robot)
    d1, a2, a3 = robot.dh[0, 1], robot.dh[1, 2], robot.dh[2, 2]
    r = a2 * np.cos(q[:, 1]) + a3 * np.cos(q[:, 1] + q[:, 2])
    z = d1 + a2 * np.sin(q[:, 1]) + a3 * np.sin(q[:, 1] + q[:, 2])
    p = [r * np.cos(q[:, 0]), r * np.sin(q[:, 0]), z]
    assert_allclose(forward_kinematics(robot, q)[:, :3, 3], np.transpose(p), atol=1e-14)


def test_spherical() -> None:
    # The boom starts d2 to the left of the base axis and points at polar angle q2, azimuth q1.
    robot = load_robot("spherical")
    q1, q2, q3 = random_poses(robot).T
    d1, d2 = robot.dh[0, 1], robot.dh[1, 1]
    p = [
        q3 * np.sin(q2) * np.cos(q1) - d2 * np.sin(q1),
        q3 * np.sin(q2) * np.sin(q1) + d2 * np.cos(q1),
        d1 + q3 * np.cos(q2),
    ]
    assert_allclose(forward_kinematics(robot, np.transpose([q1, q2, q3]))[:, :3, 3], np.transpose(p), atol=1e-14)


def test_scara() -> None:
    robot = load_robot("scara")
    q = random_poses(robot)
    q1, q2, q3, q4 = q.T
    d1, a1, a2 = robot.dh[0, 1], robot.dh[0, 2], robot.dh[1, 2]
    p = [a1 * np.cos(q1) + a2 * np.cos(q1 + q2), a1 * np.sin(q1) + a2 * np.sin(q1 + q2), d1 - q3]
    yaw = q1 + q2 - q4
    x_axis = [np.cos(yaw), np.sin(yaw), np.zeros(len(q))]
    T = forward_kinematics(robot, q)
    assert_allclose(T[:, :3, 3], np.transpose(p), atol=1e-14)
    assert_allclose(T[:, :3, 0], np.transpose(x_axis), atol=1e-14)
    assert_allclose(T[:, :3, 2], np.broadcast_to([0, 0, -1], (len(q), 3)), atol=1e-14)


def test_cylindrical() -> None:
    robot = load_robot("cylindrical")
    q1, q2, q3 = random_poses(robot).T
    p = [-q3 * np.sin(q1), q3 * np.cos(q1), robot.dh[0, 1] + q2]
    assert_allclose(forward_kinematics(robot, np.transpose([q1, q2, q3]))[:, :3, 3], np.transpose(p), atol=1e-14)


def test_cartesian_joint_values_are_the_coordinates_of_the_tool() -> None:
    robot = load_robot("cartesian")
    q = random_poses(robot)
    T = forward_kinematics(robot, q)
    assert_allclose(T[:, :3, 3], q, atol=1e-14)
    assert_allclose(T[:, :3, :3], np.broadcast_to(np.eye(3), (len(q), 3, 3)), atol=1e-14)


@pytest.mark.parametrize(("name", "upper_mm", "fore_mm"), [("al5a", 95.25, 107.95), ("al5d", 146.05, 187.325)])
def test_the_other_sizes_of_the_al5_are_files_alone(name: str, upper_mm: float, fore_mm: float) -> None:
    """ROBOTS §2: 3.75 and 4.25 inches, 5.75 and 7.375 inches; everything else is the AL5B's."""
    robot, al5b = load_robot(name), load_robot("al5b")
    assert name not in robot_names()
    assert [1e3 * joint.a for joint in robot.joints[2:4]] == pytest.approx([upper_mm, fore_mm])
    assert robot.servos == al5b.servos
    assert robot.gripper_servo == al5b.gripper_servo
