"""Whole turns: copies of an angle within limits."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim import load_robot
from rvsim.motion.turns import JointRange, nearest_turn, whole_turns

TURN = 2.0 * np.pi
angles = st.floats(-20.0, 20.0)


@pytest.fixture(scope="module")
def rv_1a() -> JointRange:
    return JointRange.of(load_robot("rv-1a"), ignore_limits=False)


@given(st.lists(angles, min_size=6, max_size=6), st.lists(angles, min_size=6, max_size=6))
def test_a_copy_is_the_same_pose_and_no_other_copy_suits_better(q: list[float], near: list[float]) -> None:
    joints = JointRange.of(load_robot("rv-1a"), ignore_limits=False)
    values, wanted = np.array(q), np.array(near)
    copies = joints.nearest_copy(values, wanted)
    turns = (copies - values) / TURN
    assert np.allclose(turns, np.round(turns), atol=1e-9)
    others = values[None] + TURN * np.arange(-9, 10)[:, None]
    within = joints.outside(others) == 0.0
    least = joints.outside(others).min(axis=0)
    assert np.allclose(joints.outside(copies), least, atol=1e-9)
    distance = np.where(within, np.abs(others - wanted), np.inf).min(axis=0)
    inside = within.any(axis=0)
    assert np.allclose(np.abs(copies - wanted)[inside], distance[inside], atol=1e-9)


def test_without_limits_the_nearest_copy_wins() -> None:
    joints = JointRange.of(load_robot("rv-m1"), ignore_limits=True)
    far = np.array([7.0, -7.0, 0.1, 3.0, 12.0])
    assert np.all(np.abs(joints.nearest_copy(far, np.zeros(5))) <= np.pi)


def test_only_a_joint_that_can_turn_all_round_is_periodic(rv_1a: JointRange) -> None:
    assert rv_1a.periodic.tolist() == [False] * 5 + [True]  # ±200°
    rrrp = JointRange.of(load_robot("rrrp"), ignore_limits=True)
    assert rrrp.periodic.tolist() == [True, True, True, False]


def test_a_run_fits_if_it_fits_after_whole_turns(rv_1a: JointRange) -> None:
    low, high = (
        np.tile(np.radians([0.0, 90.0, 0.0, 0.0, 0.0, 0.0]), (2, 1)),
        np.radians([0.0, 90.0, 0.0, 0.0, 0.0, 0.0]),
    )
    low[:, 5] = np.radians([170.0, 170.0])
    highs = np.tile(high, (2, 1))
    highs[:, 5] = np.radians([540.0, 590.0])
    assert rv_1a.fits(low, highs).tolist() == [True, False]


def test_the_short_way_round_and_the_turns_that_unwrap() -> None:
    periodic = np.array([True, False])
    assert np.allclose(nearest_turn(np.array([6.0, 6.0]), periodic), [6.0 - TURN, 6.0])
    wrapped = np.array([[3.0, 0.0], [-3.0, 4.0], [3.0, 8.0]])
    assert np.allclose(whole_turns(wrapped, periodic)[:, 0], [0.0, TURN, 0.0])
    assert not whole_turns(wrapped, periodic)[:, 1].any()
