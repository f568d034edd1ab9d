"""The load: its wrench means the same in either axes, and what nobody can hold is refused."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim.errors import SettingError, ShapeError
from rvsim.experiment import Load
from rvsim.spatial.orientation import rotation_from_rpy

ANGLES = st.tuples(*(st.floats(-3.0, 3.0),) * 3)
WRENCHES = st.tuples(*(st.floats(-100.0, 100.0),) * 6)


@given(ANGLES, WRENCHES)
def test_a_wrench_is_the_same_written_in_other_axes(angles, wrench):
    R = rotation_from_rpy(angles)
    load = Load(np.array(wrench), payload=2.0)
    turned = load.in_axes("tool", R)
    np.testing.assert_allclose(turned.in_base(R), load.in_base(R), atol=1e-9)
    np.testing.assert_allclose(turned.in_axes("base", R).wrench, load.wrench, atol=1e-9)
    assert (turned.axes, turned.payload) == ("tool", 2.0)


def test_a_part_of_the_wrench_is_replaced_in_a_copy():
    load = Load()
    moment = load.with_wrench(3, np.array([1.0, 2.0, 3.0]))
    np.testing.assert_array_equal(moment.wrench, [0, 0, 0, 1, 2, 3])
    assert not np.any(load.wrench)
    assert not moment.wrench.flags.writeable


@pytest.mark.parametrize("payload", [-1.0, np.nan, np.inf])
def test_a_payload_that_nothing_weighs_is_refused(payload):
    with pytest.raises(SettingError, match="payload"):
        Load(payload=payload)


def test_a_wrench_is_six_finite_numbers():
    with pytest.raises(ShapeError):
        Load(np.zeros(3))
    with pytest.raises(SettingError, match="wrench"):
        Load(np.full(6, np.nan))
