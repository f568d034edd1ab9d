"""Arrows end where their vector ends, turn the way the right hand says, and are not there for nothing."""

import math

import numpy as np
import pytest

from rvsim.scene.arrows import ON_TOP, arrow_items, turn_arrow_items
from rvsim.scene.palette import LIGHT
from rvsim.scene.primitives import Color, Polyline, Segments

RED = Color.from_hex("#D0312D")


def points_of(items):
    return np.concatenate([item.points for item in items])


@pytest.mark.parametrize("vector", [(0.2, 0.0, 0.0), (0.0, 0.0, -0.3), (0.1, -0.2, 0.05)])
def test_an_arrow_goes_from_its_start_to_the_end_of_its_vector(vector):
    start, vector = np.array([0.1, 0.2, 0.3]), np.array(vector)
    items = arrow_items("v", start, vector, RED, LIGHT)
    along = (points_of(items) - start) @ vector / (vector @ vector)
    assert along.min() == pytest.approx(0.0, abs=1e-12)
    assert along.max() == pytest.approx(1.0)
    assert any(np.allclose(point, start + vector) for point in points_of(items))


@pytest.mark.parametrize("sense", [1.0, -1.0])
@pytest.mark.parametrize("angle", [0.3, 1.5, 4.0, 20.0])
def test_a_turn_arrow_goes_round_its_axis_by_the_right_hand_rule(sense, angle):
    center, axis, radius = np.array([0.1, 0.0, 0.4]), np.array([0.0, 3.0, 4.0]), 0.08
    arc, *_, head = turn_arrow_items("w", center, axis, sense * angle, radius, RED, LIGHT)
    assert isinstance(arc, Polyline)
    spokes = arc.points - center
    np.testing.assert_allclose(np.linalg.norm(spokes, axis=1), radius)
    np.testing.assert_allclose(spokes @ axis, 0.0, atol=1e-12)
    assert np.all(sense * np.cross(spokes[:-1], spokes[1:]) @ axis > 0.0)
    tip = head.points[1] - center
    assert sense * np.cross(spokes[-1], tip) @ axis > 0.0
    assert not math.isclose(angle, 20.0) or np.linalg.norm(tip - spokes[0]) > 0.2 * radius


def test_what_is_nothing_is_not_drawn():
    nothing, center = np.zeros(3), np.ones(3)
    assert arrow_items("v", center, nothing, RED, LIGHT) == ()
    assert turn_arrow_items("w", center, nothing, 1.0, 0.1, RED, LIGHT) == ()
    assert turn_arrow_items("w", center, np.eye(3)[2], 0.0, 0.1, RED, LIGHT) == ()
    assert turn_arrow_items("w", center, np.eye(3)[2], 1.0, 0.0, RED, LIGHT) == ()


def test_keys_are_apart_and_stay_on_top_when_asked_to():
    items = arrow_items(f"{ON_TOP}v", np.zeros(3), np.array([0.0, 0.0, 1.0]), RED, LIGHT)
    keys = [item.key for item in items]
    assert len(set(keys)) == len(keys)
    assert all(key.startswith(ON_TOP) for key in keys)


def test_a_head_reads_from_every_side():
    items = arrow_items("v", np.zeros(3), np.array([0.0, 0.0, 1.0]), RED, LIGHT)
    head = next(item for item in items if isinstance(item, Segments))
    for side in np.random.default_rng(0).normal(size=(20, 3)):
        seen = head.points - np.outer(head.points @ side, side) / (side @ side)
        assert np.linalg.matrix_rank(seen - seen.mean(axis=0), tol=1e-3) == 2
