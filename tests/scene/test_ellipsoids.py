"""An ellipsoid's lines lie on it; a flat one is a disc, a flatter one a line, an empty one nothing."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim.scene.ellipsoids import ellipsoid_items
from rvsim.scene.palette import LIGHT
from rvsim.scene.primitives import Color, Dots, Polyline, Segments
from rvsim.spatial import rotation_from_rpy

COLOR = Color(0.8, 0.2, 0.5)
CENTER, AXES = np.array([0.3, -0.2, 0.5]), rotation_from_rpy([0.4, 0.7, -1.1])


def drawn(*radii: float):
    return ellipsoid_items("e", CENTER, AXES, np.array(radii), COLOR, LIGHT)


@pytest.mark.parametrize("radii", [(0.3, 0.2, 0.1), (0.1, 0.3, 0.2)])
def test_every_line_lies_on_the_surface_or_is_an_axis(radii):
    for item in drawn(*radii):
        local = (item.points - CENTER) @ AXES / radii
        if isinstance(item, Segments) and item.key == "e.axes":
            np.testing.assert_allclose(np.sort(np.abs(local), axis=1)[:, :2], 0.0, atol=1e-12)
        np.testing.assert_allclose(np.linalg.norm(local, axis=1), 1.0)


def test_a_flat_one_is_a_disc_in_its_plane():
    items = drawn(0.3, 0.2, 0.0)
    assert sum(isinstance(item, Polyline) for item in items) == 1
    for item in items:
        np.testing.assert_allclose((item.points - CENTER) @ AXES[:, 2], 0.0, atol=1e-12)


def test_flat_twice_it_is_a_line_with_its_ends():
    line, ends = drawn(0.0, 0.25, 0.0)
    assert isinstance(line, Polyline)
    assert isinstance(ends, Dots)
    np.testing.assert_allclose(line.points, [CENTER - 0.25 * AXES[:, 1], CENTER + 0.25 * AXES[:, 1]])


def test_nothing_is_drawn_as_nothing():
    assert drawn(0.0, 0.0, 0.0) == ()


def test_keys_are_distinct_and_begin_with_the_given_one():
    keys = [item.key for item in drawn(0.3, 0.2, 0.1)]
    assert len(set(keys)) == len(keys)
    assert all(key.startswith("e") for key in keys)
