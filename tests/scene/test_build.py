"""What an arm becomes in a scene."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rvsim.files import load_robot, robot_names
from rvsim.kinematics import forward_kinematics, link_transforms
from rvsim.robot import Joint, Robot
from rvsim.scene import Box, Capsule, Color, Dots, Item, Labels, Polyline
from rvsim.scene.build import LOOKS, Look, SceneOptions, arm_items, compose, scene_bounds
from rvsim.scene.floor import FLOOR_KEY
from rvsim.scene.palette import DARK, LIGHT
from rvsim.scene.points import gripper_points, link_corners, source_points

RVM1_Q = np.radians([30.0, 40.0, -50.0, 20.0, 60.0])


@pytest.fixture(scope="module", params=robot_names())
def robot(request: pytest.FixtureRequest) -> Robot:
    return load_robot(request.param)


def _by_key(items: tuple[Item, ...]) -> dict[str, Item]:
    return {item.key: item for item in items}


def test_an_arm_without_lengths_still_stands_on_a_floor() -> None:
    point = Robot("point", "Point", "standard", (Joint("J1", "revolute", 0.0, 0.0, 0.0, 0.0),))
    assert (np.ptp(scene_bounds(point), axis=0)[:2] > 0.0).all()
    assert FLOOR_KEY in {item.key.split(".")[0] for item in compose(point, [0.0], LIGHT).items}


def test_the_rv_m1_has_the_eleven_points_of_its_source() -> None:
    # By hand at q = 0: the arm is stretched along x at z = 152 mm, the gripper's U is 70 mm wide and 60 mm deep.
    points = source_points(load_robot("rv-m1"), np.zeros(5))
    origins = [(0, 0, 0), (0, 0, 152), (250, 0, 152), (410, 0, 152), (410, 0, 152), (482, 0, 152)]
    grip = [(482, -35, 152), (422, -35, 152), (422, 0, 152), (422, 35, 152), (482, 35, 152)]
    np.testing.assert_allclose(points, np.array(origins + grip) / 1e3, atol=1e-12)


def test_the_sixth_point_is_the_tool_of_the_worked_example() -> None:
    points = source_points(load_robot("rv-m1"), RVM1_Q)
    np.testing.assert_allclose(points[5], (0.3637, 0.2100, 0.2974), atol=5e-5)


def test_a_links_corner_lies_d_along_z_and_a_along_x(robot: Robot) -> None:
    T = link_transforms(robot, robot.home)
    corners = link_corners(robot, T)
    first, second = corners - T[:-1, :3, 3], T[1:, :3, 3] - corners
    axes = (T[:-1, :3, 2], T[1:, :3, 0]) if robot.convention == "standard" else (T[:-1, :3, 0], T[1:, :3, 2])
    for part, axis in zip((first, second), axes, strict=True):
        assert np.abs(np.cross(part, axis)).max() < 1e-12


@pytest.mark.parametrize("look", LOOKS)
def test_keys_are_unique_and_items_are_finite(robot: Robot, look: Look) -> None:
    scene = compose(robot, robot.home, LIGHT, SceneOptions(look=look, frames=True))
    keys = [item.key for item in scene.items]
    assert len(set(keys)) == len(keys)
    for item in scene.items:
        if isinstance(item, Polyline | Dots):
            assert np.isfinite(item.points).all()


@pytest.mark.parametrize("look", LOOKS)
def test_every_arm_can_be_seen_at_zero_even_one_that_shrinks_to_a_point(robot: Robot, look: Look) -> None:
    scene = compose(robot, np.zeros(robot.dof), LIGHT, SceneOptions(look=look, frames=True))
    assert np.isfinite(scene.bounds).all()


def test_every_joint_has_its_dot_in_its_colour(robot: Robot) -> None:
    items = _by_key(arm_items(robot, robot.home, LIGHT))
    for index, joint in enumerate(robot.joints):
        dot = items[f"arm.joint{index + 1}"]
        assert isinstance(dot, Dots)
        assert dot.color == Color.from_hex(joint.color)


def test_the_looks_show_what_they_say(robot: Robot) -> None:
    kinds = {look: {type(item) for item in arm_items(robot, robot.home, LIGHT, look=look)} for look in LOOKS}
    assert Capsule not in kinds["stick"]
    assert Polyline not in kinds["solid"]
    assert {Capsule, Polyline} <= kinds["both"]


def test_a_tool_point_away_from_the_flange_is_held_by_a_hand() -> None:
    robot = load_robot("rv-m1")
    assert not any("hand" in item.key for item in arm_items(robot, RVM1_Q, LIGHT, look="solid"))
    held = robot.with_tool("standard hand")
    hand = [item for item in arm_items(held, RVM1_Q, LIGHT, look="solid") if "hand" in item.key]
    np.testing.assert_allclose(hand[0].start, link_transforms(held, RVM1_Q)[-1, :3, 3], atol=1e-12)
    np.testing.assert_allclose(hand[0].end, hand[1].start, atol=1e-12)
    np.testing.assert_allclose(hand[1].end, forward_kinematics(held, RVM1_Q)[:3, 3], atol=1e-12)
    bare = replace(held, shapes=())
    assert {"hand", "hand_tip"} <= {item.key.split(".")[-1] for item in arm_items(bare, RVM1_Q, LIGHT, look="solid")}


def test_an_arm_without_shapes_gets_a_body_of_its_links(robot: Robot) -> None:
    bare = replace(robot, shapes=())
    assert any(isinstance(item, Capsule) for item in arm_items(bare, bare.home, LIGHT, look="solid"))


def test_what_stands_still_is_the_same_object_in_every_frame(robot: Robot) -> None:
    moved = robot.home + 0.01
    one, two = (compose(robot, q, LIGHT, SceneOptions(look="solid")) for q in (robot.home, moved))
    still = [(a, b) for a, b in zip(one.items, two.items, strict=True) if a.key.startswith(FLOOR_KEY)]
    assert len(still) == 5
    assert all(a is b for a, b in still)
    assert one.bounds is two.bounds


def test_the_bounds_hold_the_tool_wherever_the_joints_go(robot: Robot) -> None:
    spans = np.where(np.isfinite(robot.limits), robot.limits, [-1.0, 1.0])
    q = np.random.default_rng(5).uniform(spans[:, 0], spans[:, 1], (300, robot.dof))
    tools = forward_kinematics(robot, q)[:, :3, 3]
    lower, upper = scene_bounds(robot)
    slack = 0.05 * robot.size
    above = tools[tools[:, 2] > 0.0]
    assert (above > lower - slack).all()
    assert (above < upper + slack).all()


def test_a_ghost_is_fainter_has_keys_of_its_own_and_throws_no_shadow() -> None:
    robot = load_robot("rv-m1")
    ghost = arm_items(robot, RVM1_Q, LIGHT, key="ghost", alpha=0.3, labels=False)
    assert all(item.key.startswith("ghost.") for item in ghost)
    assert all(item.color.alpha == pytest.approx(0.3) for item in ghost if isinstance(item, Polyline | Dots))


def test_joints_at_one_place_share_a_label() -> None:
    labels = _by_key(arm_items(load_robot("rv-m1"), RVM1_Q, DARK))["arm.labels"]
    assert isinstance(labels, Labels)
    assert [label.text for label in labels.labels] == ["J1", "J2", "J3", "J4 J5"]


def test_the_background_is_the_palettes() -> None:
    robot = load_robot("scara")
    assert compose(robot, robot.home, DARK).background == DARK.background


@pytest.mark.parametrize("name", ["rv-m1", "al5b"])
def test_the_fingers_of_a_gripper_meet_in_the_middle_and_nothing_else_moves(name: str) -> None:
    robot = load_robot(name)
    T = link_transforms(robot, robot.home)
    open_, half, closed = (
        _by_key(arm_items(robot, robot.home, LIGHT, look="both", labels=False, opening=opening))
        for opening in (1.0, 0.5, 0.0)
    )
    assert _by_key(arm_items(robot, robot.home, LIGHT, look="both", labels=False)).keys() == open_.keys()
    fingers = {f"arm.solid{index}" for index, shape in enumerate(robot.shapes) if shape.finger}
    assert len(fingers) >= 2
    inner = []
    for key, item in open_.items():
        if not isinstance(item, Box):
            continue
        place, between, end = (boxes[key].T_base_box[:3, 3] for boxes in (open_, half, closed))  # type: ignore[union-attr]
        if key in fingers:
            np.testing.assert_allclose(between, 0.5 * (place + end), atol=1e-15)
            inner.append((T[-1, :3, :3].T @ (end - T[-1, :3, 3]), item.size))
        else:
            np.testing.assert_array_equal(place, end)
    axis = int(np.argmax(np.abs(robot.gripper.closing)))  # type: ignore[union-attr]
    gaps = [abs(center[axis]) - 0.5 * size[axis] for center, size in inner]
    assert 0.0 <= min(gaps) < 1e-3  # closed, the plates just touch


def test_an_outline_narrows_and_keeps_its_middle() -> None:
    robot = load_robot("rv-m1")
    T = link_transforms(robot, RVM1_Q)
    outlines = [gripper_points(robot, T, opening) for opening in (1.0, 0.25, 0.0)]
    widths = [np.linalg.norm(points[0] - points[-1]) for points in outlines]
    np.testing.assert_allclose(widths, (0.070, 0.022, 0.006), atol=1e-12)
    np.testing.assert_allclose([points[2] for points in outlines], [outlines[0][2]] * 3, atol=1e-15)
    np.testing.assert_array_equal(outlines[0], source_points(robot, RVM1_Q)[-5:])
