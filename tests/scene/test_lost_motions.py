"""A lost motion points both ways from where its line passes the tip."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim.kinematics import LostMotion
from rvsim.scene.lost_motions import lost_motion_items
from rvsim.scene.palette import LIGHT

TIP, WAY = np.array([0.3, 0.1, 0.5]), np.array([0.0, 0.6, 0.8])


def points(motion: LostMotion) -> np.ndarray:
    items = lost_motion_items("lost", TIP, motion, 0.2, LIGHT)
    assert len({item.key for item in items}) == len(items)
    return np.concatenate([item.points for item in items])


def test_a_way_reaches_as_far_to_either_side():
    offset = np.array([0.02, 0.0, 0.0])
    along = (points(LostMotion("move", WAY, offset)) - TIP - offset) @ WAY
    assert (along.min(), along.max()) == pytest.approx((-0.2, 0.2))


def test_a_line_beside_the_tip_has_a_lead_to_it():
    beside = points(LostMotion("move", WAY, np.array([0.02, 0.0, 0.0])))
    assert np.abs(beside - TIP).max(axis=1).min() == pytest.approx(0.0)


def test_a_turn_goes_round_its_axis_both_ways():
    motion = LostMotion("turn", WAY, np.zeros(3))
    keys = [item.key for item in lost_motion_items("lost", TIP, motion, 0.2, LIGHT)]
    assert any(key.endswith("left") for key in keys)
    assert any(key.endswith("right") for key in keys)
    assert any(key.endswith("axis") for key in keys)
