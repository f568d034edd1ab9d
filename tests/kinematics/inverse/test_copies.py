"""Whole turns into the limits."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from rvsim import load_robot
from rvsim.kinematics import limit_copies, limit_margins

ANGLES = st.lists(st.floats(-20.0, 20.0), min_size=6, max_size=6).map(np.array)


@given(q=ANGLES, near=ANGLES)
def test_a_copy_is_the_nearest_within_the_limits_or_the_one_that_breaks_them_least(q, near):
    robot = load_robot("rv-1a")
    copies = limit_copies(robot, q, near)
    every = q + 2.0 * np.pi * np.arange(-6, 7)[:, None]
    inside = (every >= robot.limits[:, 0] - 1e-9) & (every <= robot.limits[:, 1] + 1e-9)
    distance = np.where(inside, np.abs(every - near), np.inf).min(axis=0)
    excess = np.maximum(-limit_margins(robot, every), 0.0).min(axis=0)
    reachable = inside.any(axis=0)
    assert copies.within == reachable.all()
    np.testing.assert_allclose(np.abs(copies.q - near)[reachable], distance[reachable], atol=1e-6)
    np.testing.assert_allclose(
        np.maximum(-limit_margins(robot, copies.q), 0.0)[~reachable], excess[~reachable], atol=1e-6
    )


def test_a_stroke_has_no_turns_and_what_does_not_exist_stays_so():
    robot = load_robot("rrrp")
    q = np.array([[[7.0, 1.0, -9.0, 1.0], [0.0, 0.0, 0.0, 7.0]], [[np.nan] * 4, [0.0, 0.0, 0.0, 2.0]]])
    copies = limit_copies(robot, q)
    np.testing.assert_allclose(copies.q[0, 0], [7.0 - 2.0 * np.pi, 1.0, -9.0 + 2.0 * np.pi, 1.0])
    assert copies.q[0, 1, 3] == 7.0
    assert np.isnan(copies.q[1, 0]).all()
    assert copies.within.tolist() == [[True, False], [False, True]]
