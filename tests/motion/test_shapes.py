"""The shapes are what geometry says of them: radii, corners among the samples, ends that meet, strokes in their box."""

from __future__ import annotations

import math
import unicodedata
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim.errors import LetterError, ShapeError
from rvsim.motion import shapes, spline_points
from rvsim.motion.lettering import glyphs, text_strokes
from rvsim.spatial import rotation_from_rpy, transform

lengths = st.floats(0.01, 5.0)
angles = st.floats(-6.0, 6.0)
counts = st.integers(2, 300)
places = st.tuples(*[st.floats(-2.0, 2.0)] * 3).map(np.array)


@given(lengths, angles, angles, counts)
def test_an_arc_keeps_its_radius_and_has_its_angles(radius: float, begin: float, sweep: float, samples: int) -> None:
    points = shapes.arc(radius, begin, sweep, samples).points
    assert len(points) == samples
    np.testing.assert_allclose(np.linalg.norm(points, axis=1), radius, rtol=1e-12)
    np.testing.assert_allclose(points[0], radius * np.array([math.cos(begin), math.sin(begin)]), atol=1e-12)
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    np.testing.assert_allclose(steps, 2 * radius * abs(math.sin(sweep / (samples - 1) / 2)), atol=1e-12)


@given(lengths, lengths, counts)
def test_an_ellipse_satisfies_its_equation_and_closes(a: float, b: float, samples: int) -> None:
    x, y = shapes.ellipse(a, b, samples).points.T
    np.testing.assert_allclose((x / a) ** 2 + (y / b) ** 2, 1.0, rtol=1e-12)
    assert (x[0], y[0]) == (x[-1], y[-1])


@given(places, places, places, counts)
def test_an_arc_through_three_points_lies_in_their_plane_at_one_distance_from_a_centre(
    a: np.ndarray, b: np.ndarray, c: np.ndarray, samples: int
) -> None:
    normal = np.cross(b - a, c - a)
    if np.linalg.norm(normal) < 0.05:
        return
    points = shapes.arc_through(a, b, c, 2 * samples)
    assert np.array_equal(points[0], a)
    assert np.array_equal(points[-1], c)
    np.testing.assert_allclose((points - a) @ normal, 0.0, atol=1e-9 * (1 + np.abs(points).max() ** 3))
    # The circle through every three points of it is the same: it passes b, and turns one way.
    step = np.diff(points, axis=0)
    turns = np.cross(step[:-1], step[1:]) @ normal
    assert (turns > 0.0).all()
    near = np.linalg.norm(points - b, axis=1).min()
    assert near <= 0.51 * np.linalg.norm(step, axis=1).max()


def test_an_arc_through_points_on_a_line_is_that_line() -> None:
    points = shapes.arc_through((0, 0, 0), (1, 0, 0), (3, 0, 0), 31)
    np.testing.assert_allclose(points[:, 1:], 0.0)
    assert points[:, 0].max() == 3.0


@given(st.lists(places, min_size=2, max_size=9), st.integers(2, 200))
def test_a_polyline_has_each_corner_exactly_and_goes_straight_between(knots: list[np.ndarray], samples: int) -> None:
    drawn = shapes.polyline(knots, samples)
    through = [0, *drawn.corners.tolist(), len(drawn.points) - 1]
    assert np.array_equal(drawn.points[through], np.array(knots))
    way = sum(np.linalg.norm(b - a) for a, b in pairwise(knots))
    assert np.linalg.norm(np.diff(drawn.points, axis=0), axis=1).sum() == pytest.approx(way, abs=1e-9)
    if samples >= 20 * len(knots) and way > 0.0:
        assert abs(len(drawn.points) - samples) <= len(knots)


@given(st.integers(3, 30), lengths, st.integers(2, 300))
def test_a_regular_polygon_has_equal_edges_and_its_corners_are_known(corners: int, radius: float, samples: int) -> None:
    drawn = shapes.regular_polygon(corners, radius, samples)
    tips = drawn.points[[0, *drawn.corners, -1]]
    np.testing.assert_allclose(np.linalg.norm(tips, axis=1), radius, rtol=1e-12)
    edges = np.linalg.norm(np.diff(tips, axis=0), axis=1)
    np.testing.assert_allclose(edges, 2 * radius * math.sin(math.pi / corners), rtol=1e-9)


def test_a_star_crosses_itself_turns_by_144_degrees_and_ends_where_it_began() -> None:
    drawn = shapes.five_pointed_star(0.1, 101)
    assert drawn.corners.tolist() == [20, 40, 60, 80]
    tips = drawn.points[::20]
    edges = np.diff(tips, axis=0)
    cosine = np.sum(edges[:-1] * edges[1:], axis=1) / (0.2 * math.sin(math.radians(72.0))) ** 2
    np.testing.assert_allclose(np.degrees(np.arccos(cosine)), 144.0)
    assert np.array_equal(tips[0], tips[-1])
    np.testing.assert_allclose(tips[0], (0.0, 0.1), atol=1e-15)


def test_a_spline_passes_its_knots_and_is_the_sources_where_that_is_asked() -> None:
    knots = np.array([[0.0, 0.0], [1.0, 2.0], [2.0, -1.0], [4.0, 0.5], [5.0, 0.0]])
    x = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(knots, axis=0), axis=1))])
    drawn = shapes.spline_curve(knots, 400, "not-a-knot").points
    np.testing.assert_allclose(drawn, spline_points(x, knots, np.linspace(0.0, x[-1], 400)), atol=1e-12)
    for ends in ("natural", "closed"):
        curve = shapes.spline_curve(knots, 2001, ends).points
        gaps = np.linalg.norm(curve[:, None] - knots, axis=2).min(axis=0)
        assert gaps.max() < 0.01


def test_a_closed_spline_is_smooth_where_it_closes() -> None:
    curve = shapes.spline_curve([[0.0, 0.0], [1.0, 0.2], [1.2, 1.0], [0.1, 0.8]], 4001, "closed").points
    first, last = curve[1] - curve[0], curve[-1] - curve[-2]
    np.testing.assert_allclose(first, last, atol=5e-6)
    assert np.array_equal(curve[0], curve[-1])


@given(places, places)
def test_a_plane_takes_the_drawing_along(center: np.ndarray, rpy: np.ndarray) -> None:
    T = transform(rotation_from_rpy(rpy), center)
    path = shapes.drawn_on(T, shapes.circle(0.2, 25))
    np.testing.assert_allclose(np.linalg.norm(path.points - center, axis=1), 0.2, rtol=1e-9)
    np.testing.assert_allclose((path.points - center) @ T[:3, 2], 0.0, atol=1e-12)
    moved = path.placed(center + 1.0, rotation_from_rpy((0.3, 0.2, 0.1)), 2.0)
    np.testing.assert_allclose(moved.middle - center, 1.0, atol=0.25)
    assert moved.length == pytest.approx(2.0 * path.length)


printable = st.text(st.sampled_from(sorted(glyphs())), min_size=1, max_size=12)


@given(printable, st.floats(0.005, 0.3))
def test_letters_stay_in_their_box_and_the_pen_is_up_just_between_strokes(text: str, height: float) -> None:
    lines = text_strokes(text, height)
    if not lines:
        return
    spacing, lift = height / 10, height / 3
    drawn = shapes.strokes(lines, spacing, lift)
    x, y, z = drawn.points.T
    assert drawn.pen_up is not None
    assert np.abs(y).max() <= 0.5 * height * (32 / 21) + 1e-12
    widest = max(glyph.width for glyph in glyphs().values())
    assert np.abs(x).max() <= 0.5 * len(text) * widest * height / 21 + 1e-12
    assert ((z == 0.0) | drawn.pen_up).all()
    assert drawn.pen_up.sum() == 0 if len(lines) == 1 else z.max() == pytest.approx(lift)
    steps = np.linalg.norm(np.diff(drawn.points, axis=0), axis=1)
    assert steps[~drawn.pen_up[1:]].max(initial=0.0) <= spacing * (1 + 1e-9)
    down = steps[~drawn.pen_up[1:]].sum()
    assert down == pytest.approx(sum(np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line in lines))


@pytest.mark.parametrize("name", ["Zoë", "José", "Łukasz", "Bjørn", "Weiß", "Dvořák", "Gül", "François", "Nguyễn"])
def test_names_with_accents_can_be_written(name: str) -> None:
    plain = "".join(letter for letter in name if letter.isascii())
    assert len(text_strokes(name, 0.1)) > len(text_strokes(plain, 0.1))
    for one, other in zip(text_strokes(unicodedata.normalize("NFD", name), 0.1), text_strokes(name, 0.1), strict=True):
        np.testing.assert_array_equal(one, other)


def test_what_cannot_be_drawn_is_named() -> None:
    with pytest.raises(LetterError, match="“Ж”"):
        text_strokes("Ж", 0.1)
    with pytest.raises(ShapeError):
        shapes.regular_polygon(2, 0.1, 10)
    with pytest.raises(ShapeError):
        shapes.spline_curve([[1.0, 1.0], [1.0, 1.0]], 10)
