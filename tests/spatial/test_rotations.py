"""Rotations form a group; exponential and logarithm are inverse to each other, also where naive formulas fail."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim.errors import ShapeError
from rvsim.spatial import (
    nearest_rotation,
    rot_x,
    rot_y,
    rot_z,
    rotation_error,
    rotation_error_angle,
    rotation_from_vector,
    rotation_vector,
    skew,
)

NEAR_ZERO_AND_PI = [0.0, 1e-300, 1e-16, 1e-9, 1e-5, np.pi - 1e-5, np.pi - 1e-9, np.pi - 1e-12]
numbers = st.floats(-1.0, 1.0)
vectors = st.tuples(numbers, numbers, numbers).map(np.array)
axes = vectors.filter(lambda v: np.linalg.norm(v) > 0.1).map(lambda v: v / np.linalg.norm(v))
angles = st.one_of(st.sampled_from(NEAR_ZERO_AND_PI), st.floats(0.0, np.pi - 1e-12))
rotations = st.builds(lambda axis, angle: rotation_from_vector(angle * axis), axes, angles)


def assert_rotation(R: np.ndarray) -> None:
    np.testing.assert_allclose(R @ np.swapaxes(R, -1, -2), np.broadcast_to(np.eye(3), R.shape), atol=4e-15)
    np.testing.assert_allclose(np.linalg.det(R), 1.0, atol=4e-15)


@pytest.mark.parametrize(("turn", "axis"), [(rot_x, 0), (rot_y, 1), (rot_z, 2)])
def test_elementary_turns_are_exponentials_of_their_axis(turn, axis):
    angle = np.linspace(-7.0, 7.0, 29)
    R = turn(angle)
    assert_rotation(R)
    np.testing.assert_allclose(R, rotation_from_vector(angle[:, None] * np.eye(3)[axis]), atol=2e-15)


def test_a_quarter_turn_about_z_brings_x_to_y():
    np.testing.assert_allclose(rot_z(np.pi / 2) @ [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], atol=1e-16)


@given(vectors, vectors)
def test_skew_is_the_cross_product(v, w):
    np.testing.assert_allclose(skew(v) @ w, np.cross(v, w), atol=1e-15)


@given(axes, angles)
def test_the_logarithm_undoes_the_exponential(axis, angle):
    R = rotation_from_vector(angle * axis)
    assert_rotation(R)
    np.testing.assert_allclose(rotation_vector(R), angle * axis, rtol=1e-12, atol=2e-15)


@given(axes)
def test_a_half_turn_has_the_axis_whose_first_entry_is_positive(axis):
    R = 2.0 * np.outer(axis, axis) - np.eye(3)  # exactly symmetric: a half turn
    vector = rotation_vector(R)
    assert vector[np.flatnonzero(vector)[0]] > 0.0
    np.testing.assert_allclose(np.linalg.norm(vector), np.pi, atol=1e-14)
    np.testing.assert_allclose(rotation_from_vector(vector), R, atol=1e-14)


@given(axes, st.floats(-10.0, 10.0), st.floats(-10.0, 10.0))
def test_turns_about_one_axis_add_up(axis, first, second):
    together = rotation_from_vector(first * axis) @ rotation_from_vector(second * axis)
    np.testing.assert_allclose(together, rotation_from_vector((first + second) * axis), atol=1e-14)


@given(rotations, rotations)
def test_the_error_turns_the_actual_into_the_target(actual, target):
    error = rotation_error(actual, target)
    np.testing.assert_allclose(rotation_from_vector(error) @ actual, target, atol=1e-14)
    np.testing.assert_allclose(rotation_error_angle(actual, target), np.linalg.norm(error), atol=0.0)


@pytest.mark.parametrize("angle", NEAR_ZERO_AND_PI)
def test_the_error_angle_keeps_its_digits_near_zero_and_near_pi(angle):
    start = rotation_from_vector([0.4, -1.1, 0.3])
    found = rotation_error_angle(start, rotation_from_vector([0.0, angle, 0.0]) @ start)
    np.testing.assert_allclose(found, angle, atol=1e-15)


@given(rotations, st.lists(numbers, min_size=9, max_size=9))
def test_the_nearest_rotation_is_a_rotation_and_nothing_beside_it_is_nearer(R, noise):
    matrix = R + 0.2 * np.reshape(noise, (3, 3))
    nearest = nearest_rotation(matrix)
    assert_rotation(nearest)
    beside = rotation_from_vector(1e-3 * np.vstack([np.eye(3), -np.eye(3)])) @ nearest
    assert np.all(np.linalg.norm(matrix - beside, axis=(-2, -1)) >= np.linalg.norm(matrix - nearest) - 1e-12)
    np.testing.assert_allclose(nearest_rotation(R), R, atol=4e-15)


def test_even_a_mirror_image_has_a_nearest_rotation():
    assert_rotation(nearest_rotation(np.stack([np.diag([1.0, 1.0, -1.0]), np.diag([-1.0, -2.0, -3.0])])))


def test_every_function_takes_any_leading_shape_and_refuses_a_wrong_last_axis():
    assert rotation_vector(rotation_from_vector(np.zeros((0, 3)))).shape == (0, 3)
    assert nearest_rotation(rotation_from_vector(np.ones((2, 5, 3)))).shape == (2, 5, 3, 3)
    assert rotation_error(np.eye(3), rot_x(np.zeros((4, 1)))).shape == (4, 1, 3)
    with pytest.raises(ShapeError, match="vector must have the shape"):
        rotation_from_vector([0.0, 1.0])


def test_nan_stays_nan():
    assert np.isnan(rotation_vector(np.full((3, 3), np.nan))).all()
