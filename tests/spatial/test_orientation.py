"""Every notation of an orientation gives back the rotation it was read from, near gimbal lock and near π too."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim.spatial import (
    axis_angle_from_rotation,
    quaternion_from_rotation,
    rot_x,
    rot_y,
    rot_z,
    rotation_from_axis_angle,
    rotation_from_quaternion,
    rotation_from_rpy,
    rotation_from_zyx,
    rotation_from_zyz,
    rpy_from_rotation,
    zyx_from_rotation,
    zyz_from_rotation,
)

NOTATIONS = {
    "rpy": (rpy_from_rotation, rotation_from_rpy),
    "zyx": (zyx_from_rotation, rotation_from_zyx),
    "zyz": (zyz_from_rotation, rotation_from_zyz),
    "quaternion": (quaternion_from_rotation, rotation_from_quaternion),
    "axis-angle": (axis_angle_from_rotation, lambda pair: rotation_from_axis_angle(*pair)),
}
# How far from a quarter turn: gimbal lock of roll-pitch-yaw, and with a quarter turn more of ZYZ.
FROM_LOCK = [0.0, 1e-16, 1e-13, 1e-11, 1e-8, 1e-4]
turns = st.one_of(st.sampled_from([k * np.pi / 2 for k in range(-4, 5)]), st.floats(-7.0, 7.0))
middles = st.builds(lambda k, off: k * np.pi / 2 + off, st.integers(-2, 2), st.sampled_from(FROM_LOCK))
rotations = st.builds(
    lambda first, middle, last: rot_z(first) @ rot_y(middle) @ rot_x(last), turns, st.one_of(turns, middles), turns
)


@pytest.mark.parametrize("notation", NOTATIONS)
@given(R=rotations)
def test_what_was_read_off_gives_the_rotation_back(notation, R):
    read, put = NOTATIONS[notation]
    np.testing.assert_allclose(put(read(R)), R, atol=4e-12)


@given(rotations)
def test_the_middle_angle_stays_in_its_range(R):
    assert abs(rpy_from_rotation(R)[1]) <= np.pi / 2
    assert 0.0 <= zyz_from_rotation(R)[1] <= np.pi


@given(st.tuples(st.floats(-3.0, 3.0), st.floats(-1.5, 1.5), st.floats(-3.0, 3.0)))
def test_away_from_gimbal_lock_the_angles_themselves_come_back(rpy):
    np.testing.assert_allclose(rpy_from_rotation(rotation_from_rpy(rpy)), rpy, atol=1e-13)
    np.testing.assert_allclose(zyx_from_rotation(rotation_from_zyx(rpy)), rpy, atol=1e-13)
    zyz = np.add(rpy, [0.0, 1.6, 0.0])
    np.testing.assert_allclose(zyz_from_rotation(rotation_from_zyz(zyz)), zyz, atol=1e-13)


def test_the_conventions_are_the_stated_products():
    a, b, c = 0.3, -0.7, 1.9
    np.testing.assert_array_equal(rotation_from_rpy([a, b, c]), rot_z(c) @ rot_y(b) @ rot_x(a))
    np.testing.assert_array_equal(rotation_from_zyx([a, b, c]), rot_z(a) @ rot_y(b) @ rot_x(c))
    np.testing.assert_array_equal(rotation_from_zyz([a, b, c]), rot_z(a) @ rot_y(b) @ rot_z(c))


def test_in_gimbal_lock_the_stated_angle_is_zero_and_another_holds_the_turn():
    up = rot_z(0.4) @ rot_y(np.pi / 2) @ rot_x(0.1)
    np.testing.assert_allclose(rpy_from_rotation(up), [0.0, np.pi / 2, 0.3], atol=1e-12)
    down = rot_z(0.4) @ rot_y(-np.pi / 2) @ rot_x(0.1)
    np.testing.assert_allclose(rpy_from_rotation(down), [0.0, -np.pi / 2, 0.5], atol=1e-12)
    np.testing.assert_allclose(zyz_from_rotation(rot_z(0.5)), [0.0, 0.0, 0.5], atol=1e-12)


@given(rotations)
def test_the_quaternion_has_unit_length_and_lies_in_the_upper_half(R):
    quaternion = quaternion_from_rotation(R)
    assert quaternion[0] >= 0.0
    np.testing.assert_allclose(np.linalg.norm(quaternion), 1.0, atol=1e-15)


def test_a_half_turn_about_minus_y_is_the_quaternion_j():
    half_turn = np.diag([-1.0, 1.0, -1.0])
    np.testing.assert_array_equal(quaternion_from_rotation(half_turn), [0.0, 0.0, 1.0, 0.0])


def test_a_quaternion_need_not_have_unit_length():
    np.testing.assert_allclose(rotation_from_quaternion([3.0, 0.0, 0.0, 3.0]), rot_z(np.pi / 2), atol=1e-15)


def test_no_turn_has_the_axis_z_and_no_minus_zero():
    axis, angle = axis_angle_from_rotation(np.eye(3))
    assert (axis.tolist(), float(angle)) == ([0.0, 0.0, 1.0], 0.0)
    assert not np.signbit(rpy_from_rotation(np.eye(3))).any()


@pytest.mark.parametrize("notation", NOTATIONS)
def test_any_leading_shape(notation):
    read, put = NOTATIONS[notation]
    R = rot_y(np.linspace(-3.0, 3.0, 6).reshape(3, 2))
    np.testing.assert_allclose(put(read(R)), R, atol=1e-14)
    assert put(read(R[:0])).shape == (0, 2, 3, 3)
