"""The moment of a pose: what a motion passes is found again, what it does not pass is not."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim.files import load_robot
from rvsim.motion import joint_move
from rvsim.playback import moment_of

MOTION = joint_move(load_robot("rv-m1"), np.zeros(5), np.radians([30.0, 40.0, -50.0, 20.0, 60.0]))


@given(st.floats(0.0, 1.0), st.floats(0.0, 1.0))
def test_every_pose_of_a_motion_is_found(share: float, shown: float) -> None:
    q = MOTION.q(share * MOTION.duration)
    found = moment_of(MOTION, q, (shown * MOTION.duration,))
    assert found is not None
    np.testing.assert_allclose(MOTION.q(found), q, atol=1e-9)


def test_a_pose_off_the_motion_has_no_moment() -> None:
    assert moment_of(MOTION, MOTION.q(0.3) + 1e-6 * np.array([1.0, -1.0, 0.0, 0.0, 0.0]), (0.3,)) is None


def test_of_several_moments_the_one_that_is_nearest_to_what_is_shown_counts() -> None:
    class ToAndFro:
        duration = 4.0

        def q(self, t: object) -> np.ndarray:
            return np.sin(np.pi * np.asarray(t, dtype=float))[..., None]

    for time in (0.3, 0.7, 2.3, 2.7):
        assert moment_of(ToAndFro(), ToAndFro().q(0.3), (time + 0.01,)) == pytest.approx(time)
