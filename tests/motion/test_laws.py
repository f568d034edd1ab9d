"""Time laws: what they promise at their ends, that derivatives are derivatives, and that no limit is exceeded."""

from __future__ import annotations

import json
import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rvsim.errors import SettingError, ShapeError
from rvsim.motion.laws import (
    Limits,
    PiecewisePolynomial,
    cubic,
    jerk_limited,
    joined,
    quickest_along,
    quintic_between,
    shortest_time,
    spline_through,
    trapezoid,
)

ORACLE = json.loads((Path(__file__).parents[1] / "oracles" / "oracle.json").read_text())
numbers = st.floats(-3.0, 3.0)
poses = st.lists(numbers, min_size=3, max_size=3).map(np.array)
times = st.floats(-5.0, 5.0)
spans = st.floats(0.05, 20.0)


def assert_derivatives(law: PiecewisePolynomial, orders: int = 2) -> None:
    """Between the breaks each derivative is the slope of the one before, to the precision of a difference."""
    middles = law.breaks[:-1] + np.diff(law.breaks) * 0.37
    step = 1e-4 * np.diff(law.breaks)
    moments, before, after = law.at(middles), law.at(middles - step), law.at(middles + step)
    for order in range(orders):
        slope = (after[order] - before[order]) / (2.0 * step[:, None])
        scale = 1.0 + np.abs(moments[order + 1]).max() + np.abs(moments[order]).max() / step.min() * 1e-12
        np.testing.assert_allclose(slope, moments[order + 1], atol=2e-6 * scale, rtol=1e-5)


def assert_continuous(law: PiecewisePolynomial, orders: int) -> None:
    """q and so many derivatives have no jump at the inner breaks."""
    if len(law.breaks) < 3:
        return
    ends = PiecewisePolynomial.at
    before = [ends(PiecewisePolynomial(law.breaks[i : i + 2], law.coefficients[i : i + 1]), law.breaks[i + 1])
              for i in range(len(law.breaks) - 2)]  # fmt: skip
    for one, t in zip(before, law.breaks[1:-1], strict=True):
        for order in range(orders + 1):
            scale = 1.0 + np.abs(law.coefficients).max()
            np.testing.assert_allclose(one[order], law.at(t)[order], atol=1e-8 * scale)


@given(times, spans, poses, poses, poses, poses, poses, poses)
def test_polynomials_meet_every_condition_at_both_ends_from_any_t0(t0, T, q0, q1, v0, v1, a0, a1) -> None:
    law = quintic_between(t0, t0 + T, q0, q1, v0, v1, a0, a1)
    first, last = law.at(law.start), law.at(law.end)
    for found, wanted in zip((*first[:3], *last[:3]), (q0, v0, a0, q1, v1, a1), strict=True):
        np.testing.assert_allclose(found, wanted, atol=1e-8 * (1.0 + T**2 + 1.0 / T**2))
    law = cubic(t0, t0 + T, q0, q1, v0, v1)
    first, last = law.at(law.start), law.at(law.end)
    for found, wanted in zip((*first[:2], *last[:2]), (q0, v0, q1, v1), strict=True):
        np.testing.assert_allclose(found, wanted, atol=1e-9 * (1.0 + T + 1.0 / T))
    assert_derivatives(law)


def test_the_quintic_of_source_004() -> None:
    wanted = ORACLE["trajectories"]["al5b_quintic"]["samples"]
    law = quintic_between(0.0, 2.0, np.zeros(1), np.array([40.0]))
    np.testing.assert_allclose(law.coefficients[0, :, 0], [0.0, 0.0, 0.0, 50.0, -37.5, 7.5], atol=1e-12)
    for t, q, qd, qdd in wanted:
        np.testing.assert_allclose([value[0] for value in law.at(t)[:3]], [q, qd, qdd], atol=1e-9)


def test_the_quintic_rests_at_its_end_whatever_t0_is() -> None:
    """Where source 004's printed matrix, from 1 to 3 s, ends with an acceleration of −133.3."""
    assert abs(quintic_between(1.0, 3.0, 0.0, 40.0).at(3.0).qdd[0]) < 1e-11


limit_values = st.lists(st.floats(0.1, 5.0), min_size=3, max_size=3).map(np.array)


@given(times, poses, poses, limit_values, limit_values, st.floats(1.0, 4.0))
def test_the_trapezoid_keeps_its_limits_and_none_could_be_quicker(t0, q0, q1, speed, acceleration, slower) -> None:
    law = trapezoid(t0, q0, q1, speed, acceleration)
    assert_trapezoid(law, q0, q1, speed, acceleration)
    if law.duration > 1e-5:
        peaks = law.peaks()
        assert max((peaks.qd / speed).max(), (peaks.qdd / acceleration).max()) == pytest.approx(1.0)
        with pytest.raises(SettingError, match="duration"):
            trapezoid(t0, q0, q1, speed, acceleration, duration=0.9 * law.duration)
    longer = trapezoid(t0, q0, q1, speed, acceleration, duration=slower * law.duration)
    assert longer.duration == pytest.approx(slower * law.duration, abs=1e-8)
    assert_trapezoid(longer, q0, q1, speed, acceleration)


def assert_trapezoid(law, q0, q1, speed, acceleration) -> None:
    np.testing.assert_allclose(law.at(law.start).q, q0, atol=1e-12)
    np.testing.assert_allclose(law.at(law.end).q, q1, atol=1e-9)
    peaks = law.peaks()
    assert (peaks.qd <= speed * (1 + 1e-9) + 1e-12).all()
    assert (peaks.qdd <= acceleration * (1 + 1e-9) + 1e-12).all()
    assert_continuous(law, 1 if law.duration > 1e-5 else 0)


@given(poses, poses, limit_values, limit_values, limit_values)
def test_the_jerk_limited_way_keeps_all_limits_and_arrives_at_rest(q0, q1, speed, acceleration, jerk) -> None:
    law = jerk_limited(0.5, q0, q1, Limits(speed, acceleration, jerk))
    first, last = law.at(law.start), law.at(law.end)
    np.testing.assert_allclose(first.q, q0, atol=1e-8)
    np.testing.assert_allclose(last.q, q1, atol=1e-8)
    np.testing.assert_allclose([first.qd, last.qd, first.qdd, last.qdd], 0.0, atol=1e-6)
    peaks = law.peaks()
    assert (peaks.qd <= speed * (1 + 1e-6) + 1e-8).all()
    assert (peaks.qdd <= acceleration * (1 + 1e-6) + 1e-8).all()
    assert (peaks.jerk <= jerk * (1 + 1e-4) + 1e-5).all()
    assert_continuous(law, 2)
    longer = jerk_limited(0.5, q0, q1, Limits(speed, acceleration, jerk), duration=law.duration + 1.0)
    assert longer.duration == pytest.approx(law.duration + 1.0)


@given(st.lists(poses, min_size=4, max_size=7), st.lists(st.floats(0.1, 3.0), min_size=6, max_size=6), poses, poses)
def test_splines_pass_their_poses_with_continuous_acceleration(via, gaps, v0, v1) -> None:
    at = np.concatenate([[1.0], 1.0 + np.cumsum(gaps)])[: len(via)]
    natural, clamped, free = (spline_through(at, via, ends, v0, v1) for ends in ("natural", "clamped", "not-a-knot"))
    for law in (natural, clamped, free):
        np.testing.assert_allclose(law.at(at).q, via, atol=1e-9)
        assert_continuous(law, 2)
    scale = 1e-7 * (1.0 + np.abs(natural.coefficients).max())
    np.testing.assert_allclose([natural.at(at[0]).qdd, natural.at(at[-1]).qdd], 0.0, atol=scale)
    np.testing.assert_allclose([clamped.at(at[0]).qd, clamped.at(at[-1]).qd], [v0, v1], atol=1e-9)
    np.testing.assert_allclose(free.coefficients[0, 3], free.coefficients[1, 3], atol=1e-6)
    np.testing.assert_allclose(free.coefficients[-1, 3], free.coefficients[-2, 3], atol=1e-6)


@settings(max_examples=25)
@given(poses, poses, limit_values, limit_values)
def test_the_shortest_time_touches_a_limit_and_exceeds_none(q0, q1, speed, acceleration) -> None:
    def law(duration: float) -> PiecewisePolynomial:
        return quintic_between(2.0, 2.0 + duration, q0, q1)

    peaks = law(shortest_time(law, speed, acceleration)).peaks()
    used = max((peaks.qd / speed).max(), (peaks.qdd / acceleration).max())
    assert used <= 1.0 + 1e-6
    if np.abs(q1 - q0).max() > 1e-3:
        assert used == pytest.approx(1.0, abs=1e-4)


@given(spans, poses, poses, poses, poses)
def test_peaks_and_range_are_those_of_a_fine_sampling(T, q0, q1, v0, v1) -> None:
    law = cubic(0.0, T, q0, q1, v0, v1)
    seen, peaks, reach = law.at(np.linspace(0.0, T, 4001)), law.peaks(), law.range()
    for found, values in zip(peaks, seen, strict=True):
        np.testing.assert_allclose(found, np.abs(values).max(axis=0), rtol=1e-5, atol=1e-9)
    np.testing.assert_allclose(reach, np.stack([seen.q.min(axis=0), seen.q.max(axis=0)], -1), rtol=1e-5, atol=1e-5)


def test_laws_can_be_put_one_after_the_other() -> None:
    law = joined(cubic(1.0, 2.0, [0.0], [1.0]), quintic_between(0.0, 3.0, [1.0], [-1.0]))
    assert (law.start, law.end) == (1.0, 5.0)
    np.testing.assert_allclose(law.at([1.0, 2.0, 5.0]).q[:, 0], [0.0, 1.0, -1.0], atol=1e-12)
    assert_continuous(law, 1)


def test_what_makes_no_motion_is_refused_with_the_culprit() -> None:
    with pytest.raises(SettingError, match="t1"):
        cubic(1.0, 1.0, 0.0, 1.0)
    with pytest.raises(SettingError, match="max_speed"):
        trapezoid(0.0, 0.0, 1.0, 0.0, 1.0)
    with pytest.raises(SettingError, match="max_jerk"):
        jerk_limited(0.0, 0.0, 1.0, Limits(np.ones(1), np.ones(1), np.zeros(1)))
    with pytest.raises(SettingError, match="limits at both"):
        jerk_limited(0.0, 0.0, 1.0, Limits(np.ones(1), np.ones(1), np.ones(1)), qd1=3.0)
    with pytest.raises(SettingError, match="ends"):
        shortest_time(lambda T: cubic(0.0, T, 0.0, 1.0, 9.0), 1.0, 1.0)
    with pytest.raises(ShapeError):
        spline_through([0.0, 0.0], [[1.0], [2.0]])
    with pytest.raises(ShapeError):
        PiecewisePolynomial(np.array([0.0, 1.0]), np.zeros((2, 1, 1)))


@given(st.lists(poses, min_size=4, max_size=6), limit_values, limit_values)
def test_the_quickest_way_along_a_curve_is_always_at_a_limit_and_never_beyond(via, speed, acceleration) -> None:
    way = spline_through(np.linspace(0.0, 1.0, len(via)), np.array(via) + np.linspace(0.0, 1.0, len(via))[:, None])
    law = quickest_along(way, speed, acceleration)
    assert (law.at(0.0).q[0], law.at(0.0).qd[0]) == (0.0, 0.0)
    assert law.at(law.end).q[0] == pytest.approx(1.0)
    times = law.breaks[:-1] + 1e-9
    s, sd, sdd, _ = (value[:, 0] for value in law.at(times))
    _, q1, q2, _ = way.at(s)
    used_speed = np.abs(q1 * sd[:, None]) / speed
    used_acceleration = np.abs(q2 * sd[:, None] ** 2 + q1 * sdd[:, None]) / acceleration
    assert used_speed.max() <= 1.0 + 1e-6
    assert np.quantile(used_acceleration.max(axis=1), 0.98) <= 1.02
    busy = np.maximum(used_speed.max(axis=1), used_acceleration.max(axis=1))
    assert np.median(busy) > 0.95


def test_the_quickest_way_along_a_straight_line_is_the_trapezoid() -> None:
    q0, q1, speed, acceleration = np.zeros(2), np.array([2.0, -1.0]), np.array([1.0, 1.0]), np.array([2.0, 3.0])
    way = PiecewisePolynomial(np.array([0.0, 1.0]), np.array([[q0, q1 - q0]]))
    law = quickest_along(way, speed, acceleration)
    assert law.duration == pytest.approx(trapezoid(0.0, q0, q1, speed, acceleration).duration, rel=1e-3)


def test_a_spline_through_very_many_points_is_right_and_needs_little_room() -> None:
    x = np.linspace(0.0, 1.0, 20_001)
    y = np.column_stack([x**3 - x, 2.0 * x**2 - x**3])  # not-a-knot gives cubics back
    spline_through(x[:1001], y[:1001], "not-a-knot")  # the solver is imported now
    tracemalloc.start()
    way = spline_through(x, y, "not-a-knot")
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert most < 100e6
    np.testing.assert_allclose(way.at(x).qd, np.column_stack([3.0 * x**2 - 1.0, 4.0 * x - 3.0 * x**2]), atol=1e-9)
