"""Clearance: against sampled surfaces, and the laws of a distance."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim import load_robot
from rvsim.kinematics.clearance import clearance, segment_distance
from rvsim.kinematics.forward import link_transforms
from rvsim.robot import BoxShape, Robot

SEED = 3
ARMS = ("rv-m1", "rv-1a", "ur5e", "al5b", "rrrp")


def poses(robot: Robot, count: int) -> np.ndarray:
    low, high = np.clip(robot.limits, -3.0, 3.0).T
    return np.random.default_rng(SEED).uniform(low, high, (count, robot.dof))


def segments(count: int) -> list[np.ndarray]:
    return list(np.random.default_rng(SEED).normal(size=(4, count, 3)))


def test_two_segments_are_as_far_apart_as_their_nearest_points() -> None:
    p0, p1, q0, q1 = segments(200)
    q1[:50] = q0[:50] + (p1 - p0)[:50]  # parallel
    q1[50:60], p1[55:65] = q0[50:60], p0[55:65]  # points
    t = np.linspace(0.0, 1.0, 201)[:, None, None]
    ways = ((1.0 - t) * p0 + t * p1)[:, None] - ((1.0 - t) * q0 + t * q1)[None]
    sampled = np.linalg.norm(ways, axis=-1).min(axis=(0, 1))
    exact = segment_distance(p0, p1, q0, q1)
    assert np.all(exact <= sampled + 1e-12)
    assert np.all(exact >= sampled - 0.03)


def test_the_distance_of_two_segments_is_symmetric_and_0_where_they_cross() -> None:
    p0, p1, q0, q1 = segments(100)
    np.testing.assert_allclose(segment_distance(p0, p1, q0, q1), segment_distance(q1, q0, p0, p1), atol=1e-12)
    middle = 0.3 * p0 + 0.7 * p1
    np.testing.assert_allclose(segment_distance(p0, p1, middle - q0, middle + q0), 0.0, atol=1e-12)


@pytest.mark.parametrize("name", ARMS)
def test_the_lowest_point_of_the_arm_is_that_of_its_shapes(name: str) -> None:
    robot = load_robot(name)
    q = poses(robot, 20)
    found = clearance(robot, q, table=0.02)
    T = link_transforms(robot, q)
    T = np.concatenate([T, T[:, -1:] @ robot.T_flange_tool], axis=1)
    random = np.random.default_rng(SEED)
    for shape in robot.shapes:
        if shape.frame == 0:
            continue
        if isinstance(shape, BoxShape):
            inside = shape.center + shape.size * random.uniform(-0.5, 0.5, (50, 3))
        else:
            share, way = random.uniform(size=(50, 1)), random.normal(size=(50, 3))
            way *= shape.radius / np.linalg.norm(way, axis=1, keepdims=True)
            inside = (1.0 - share) * shape.start + share * shape.end + way
        heights = np.einsum("mj,kj->mk", T[:, shape.frame, 2, :3], inside) + T[:, shape.frame, 2, 3, None]
        # The tool's boxes are taken as capsules, rounded by less than a third of their shortest edge.
        rounded = 0.37 * shape.size.min() if shape.frame > robot.dof and isinstance(shape, BoxShape) else 0.0
        assert np.all(found.table + 0.02 <= heights.min(axis=1) + rounded + 1e-12)


@pytest.mark.parametrize("name", ARMS)
def test_a_batch_is_what_each_pose_is_and_no_arm_touches_itself_at_home(name: str) -> None:
    robot = load_robot(name)
    q = poses(robot, 6).reshape(2, 3, robot.dof)
    batch = clearance(robot, q)
    assert batch.table.shape == batch.own.shape == (2, 3)
    assert batch.pair.shape == (2, 3, 2)
    one = clearance(robot, q[1, 2])
    assert (float(one.table), float(one.own)) == pytest.approx((batch.table[1, 2], batch.own[1, 2]))
    assert float(clearance(robot, robot.home).own) > 0.0


def test_an_arm_folded_onto_itself_touches_itself_and_says_which_links(ur5e_folded: np.ndarray) -> None:
    found = clearance(load_robot("ur5e"), ur5e_folded)
    assert float(found.own) < 0.0
    low, high = found.pair.tolist()
    assert high - low > 1


@pytest.fixture
def ur5e_folded() -> np.ndarray:
    return np.radians([0.0, -90.0, 170.0, 0.0, 0.0, 0.0])


def test_below_the_table_the_height_is_negative() -> None:
    robot = load_robot("ur5e")
    found = clearance(robot, np.radians([0.0, 40.0, 0.0, 0.0, 0.0, 0.0]))
    assert float(found.table) < -0.1
    assert int(found.lowest) >= 3
