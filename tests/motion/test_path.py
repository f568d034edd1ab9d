"""Paths: where the tool goes, and the spline of the source's letter."""

from __future__ import annotations

import json
from pathlib import Path as FilePath

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.interpolate import CubicSpline

from rvsim.errors import NotFiniteError, ShapeError
from rvsim.motion import TOOL_DOWN, Path, line_path, spline_points, through_points
from rvsim.motion.path import radial_rotations

ORACLE = json.loads((FilePath(__file__).parents[1] / "oracles" / "oracle.json").read_text())["trajectories"]
places = arrays(np.float64, (3,), elements=st.floats(-2.0, 2.0, width=32))


@given(places, places, st.integers(2, 60))
def test_a_line_meets_both_ends_exactly_and_steps_evenly(start: np.ndarray, end: np.ndarray, samples: int) -> None:
    path = line_path(start, end, samples)
    assert np.array_equal(path.points[0], start)
    assert np.array_equal(path.points[-1], end)
    assert np.allclose(np.diff(path.points, axis=0), (end - start) / (samples - 1), atol=1e-15)
    assert path.length == pytest.approx(np.linalg.norm(end - start), abs=1e-12)


def test_a_path_cannot_be_changed_and_says_what_does_not_fit() -> None:
    path = through_points([[0.1, 0.0, 0.2], [0.2, 0.0, 0.2]], TOOL_DOWN)
    with pytest.raises(ValueError, match="read-only"):
        path.points[0, 0] = 1.0
    with pytest.raises(ShapeError, match=r"path rotations must have the shape \(2, 3, 3\)"):
        Path("odd", path.points, np.zeros((3, 3, 3)))
    with pytest.raises(ShapeError, match="at least 1"):
        through_points(np.zeros((0, 3)))


def test_poses_hold_places_and_orientations() -> None:
    path = line_path((0.1, 0.2, 0.3), (0.4, 0.2, 0.3), 3)
    assert np.array_equal(path.poses()[:, :3, 3], path.points)
    assert np.array_equal(path.poses()[1, :3, :3], TOOL_DOWN)
    assert path.with_rotation(None).rotations is None
    assert np.array_equal(path.moved((0.0, 0.0, 1.0)).points, path.points + np.array([0.0, 0.0, 1.0]))


@given(arrays(np.float64, (5, 3), elements=st.floats(0.1, 2.0)))
def test_radial_rotations_are_rotations_with_a_level_tool_that_points_away_from_the_base(points: np.ndarray) -> None:
    R = radial_rotations(points)
    assert np.allclose(R @ np.swapaxes(R, -1, -2), np.eye(3), atol=1e-15)
    assert np.allclose(np.linalg.det(R), 1.0)
    outwards = points[:, :2] / np.linalg.norm(points[:, :2], axis=1, keepdims=True)
    assert np.allclose(R[:, :, 2], np.column_stack([outwards, np.zeros(5)]), atol=1e-15)


def test_the_spline_draws_the_letter_as_matlab_does() -> None:
    oracle = ORACLE["D_spline_raw"]
    xy = np.array(
        [[13, 14, 6, 2, 5, 20, 42, 49, 39, 25, 22, 30], [48, 31, 7, 13, 19, 12, 16, 39, 61, 66, 40, 2]], dtype=float
    ).T
    drawn = spline_points(range(1, 13), xy, oracle["tt"])
    assert np.allclose(drawn, np.column_stack([oracle["xx"], oracle["yy"]]), atol=1e-12)


@pytest.mark.parametrize("count", [4, 5, 9, 100, 101, 402, 5003])
def test_the_spline_is_the_not_a_knot_spline_between_and_beyond_uneven_knots(count: int) -> None:
    generator = np.random.default_rng(count)
    knots, values = np.cumsum(generator.uniform(0.2, 2.0, count)), generator.normal(size=(count, 2))
    at = np.linspace(knots[0] - 0.5, knots[-1] + 0.5, 101)
    reference = CubicSpline(knots, values, bc_type="not-a-knot")(at)
    assert np.allclose(spline_points(knots, values, at), reference, atol=1e-10)


def test_a_spline_needs_four_knots() -> None:
    with pytest.raises(ShapeError, match="at least 4"):
        spline_points([0, 1, 2], np.zeros((3, 1)), [0.5])


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_a_place_that_is_no_number_is_refused_with_its_index(bad: float) -> None:
    points = np.zeros((5, 3))
    points[3, 1] = bad
    with pytest.raises(NotFiniteError, match=rf"path points\[3, 1\] is {bad}, but must be a finite number"):
        through_points(points)
    with pytest.raises(NotFiniteError, match=r"path points\[3, 1\]"):
        line_path([0, 0, 0], [1, 1, 1], 5).moved(points)
    turned = np.tile(np.eye(3), (5, 1, 1))
    turned[2, 0, 1] = bad
    with pytest.raises(NotFiniteError, match=r"path rotations\[2, 0, 1\]"):
        through_points(np.zeros((5, 3)), turned)
