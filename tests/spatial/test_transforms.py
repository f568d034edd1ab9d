"""Transforms form a group; the exponential of a twist is that of its 4 × 4 matrix."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import expm

from rvsim.errors import ShapeError
from rvsim.spatial import (
    inverse_transform,
    pose_difference,
    rot_x,
    rot_z,
    rotation_from_vector,
    skew,
    transform,
    transform_from_twist,
    translation,
)

lengths = st.floats(-3.0, 3.0)
twists = st.lists(lengths, min_size=6, max_size=6).map(np.array)
scales = st.sampled_from([0.0, 1e-170, 1e-9, 1e-6, 1e-4, 1e-2, 1.0])


@given(twists, scales)
def test_the_exponential_of_a_twist_is_that_of_its_matrix(twist, scale):
    twist = twist * [1.0, 1.0, 1.0, scale, scale, scale]
    matrix = np.zeros((4, 4))
    matrix[:3, :3], matrix[:3, 3] = skew(twist[3:]), twist[:3]
    np.testing.assert_allclose(transform_from_twist(twist), expm(matrix), atol=3e-14)


@given(twists)
def test_a_transform_and_its_inverse_cancel(twist):
    T = transform_from_twist(twist)
    np.testing.assert_allclose(T @ inverse_transform(T), np.eye(4), atol=1e-14)
    np.testing.assert_allclose(inverse_transform(T), transform_from_twist(-twist), atol=1e-14)


@given(twists, st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))
def test_motions_along_one_screw_add_up(twist, first, second):
    together = transform_from_twist(first * twist) @ transform_from_twist(second * twist)
    np.testing.assert_allclose(together, transform_from_twist((first + second) * twist), atol=3e-14)


def test_a_screw_about_a_shifted_axis_leaves_its_points_where_they_are():
    point, axis = np.array([1.0, 2.0, 0.0]), np.array([0.0, 0.0, 1.0])
    T = transform_from_twist(np.concatenate([np.cross(point, axis), axis]) * 0.8)
    np.testing.assert_allclose(T @ [*point, 1.0], [*point, 1.0], atol=1e-15)


def test_rotation_and_origin_are_put_together_and_broadcast():
    T = transform(rot_z([0.0, 1.0]), np.zeros((5, 1, 3)))
    assert T.shape == (5, 2, 4, 4)
    np.testing.assert_array_equal(T[3, 1, :3, :3], rot_z(1.0))
    np.testing.assert_array_equal(translation([1.0, 2.0, 3.0]) @ [0.0, 0.0, 0.0, 1.0], [1.0, 2.0, 3.0, 1.0])
    with pytest.raises(ShapeError, match="p must have the shape"):
        translation([1.0, 2.0])


def test_the_difference_of_two_poses_is_a_distance_and_an_angle():
    start = transform_from_twist([0.3, 0.1, -0.2, 1.0, 0.4, 2.0])
    moved = translation([0.0, 3e-9, 4e-9]) @ start
    moved[:3, :3] = rotation_from_vector([0.0, 0.0, 1e-9]) @ start[:3, :3]
    difference = pose_difference(start, np.stack([start, moved]))
    np.testing.assert_allclose(difference.position, [0.0, 5e-9], atol=1e-15)
    np.testing.assert_allclose(difference.angle, [0.0, 1e-9], atol=1e-15)
    np.testing.assert_allclose(pose_difference(translation([0, 0, 0]), transform(rot_x(np.pi), [0, 0, 0])).angle, np.pi)
