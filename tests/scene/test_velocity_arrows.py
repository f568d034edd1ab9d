"""Arrows at the tool go along v and round ω; a wish that is not met is dashed beside them."""

import numpy as np
import pytest

from rvsim.scene.palette import LIGHT
from rvsim.scene.primitives import Labels, Polyline
from rvsim.scene.velocity_arrows import velocity_items

P, SIZE, TEXTS = np.array([0.3, 0.1, 0.4]), 0.8, ("v", "ω")


def items_of(wished, achieved):
    return {item.key.split(".", 2)[2]: item for item in velocity_items(P, wished, achieved, SIZE, TEXTS, LIGHT)}


@pytest.mark.parametrize("speed", [1e-3, 0.02, 0.5, 30.0])
def test_an_arrow_is_readable_at_every_speed_and_points_along_v(speed):
    v = speed * np.array([0.6, 0.0, 0.8])
    twist = np.concatenate([v, np.zeros(3)])
    items = items_of(twist, twist)
    way = items["achieved.v"].points[1] - P
    np.testing.assert_allclose(np.cross(way, v), 0.0, atol=1e-9)
    assert 0.05 * SIZE < np.linalg.norm(way) < 0.31 * SIZE
    assert not any(key.startswith("wished") for key in items)


def test_what_is_lost_is_seen_as_a_second_dashed_arrow():
    wished, achieved = np.array([0.1, 0.0, 0.0, 0.0, 0.0, 0.5]), np.array([0.05, 0.0, 0.0, 0.0, 0.0, 0.5])
    items = items_of(wished, achieved)
    assert items["wished.v"].dashed
    assert "wished.w" not in items
    assert isinstance(items["achieved.w"], Polyline)
    np.testing.assert_allclose((items["achieved.w"].points - P)[:, 2], 0.0, atol=1e-12)


def test_rest_draws_nothing():
    assert items_of(np.zeros(6), np.zeros(6)) == {}


def test_labels_stand_only_beside_what_moves():
    (labels,) = [item for item in items_of(np.eye(6)[5], np.eye(6)[5]).values() if isinstance(item, Labels)]
    assert [label.text for label in labels.labels] == ["ω"]
