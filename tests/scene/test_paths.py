"""A path says honestly what was reached."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from rvsim.scene import Labels, Polyline
from rvsim.scene.palette import LIGHT
from rvsim.scene.paths import path_items, trail_items


def _lines(points: np.ndarray, reached: list[bool]) -> list[Polyline]:
    items = path_items(points, reached, np.empty((0, 3)), LIGHT)
    return [item for item in items if isinstance(item, Polyline)]


@given(st.lists(st.booleans(), min_size=2, max_size=40))
def test_each_piece_is_drawn_once_and_is_dashed_if_an_end_is_unreached(reached: list[bool]) -> None:
    points = np.arange(3.0 * len(reached)).reshape(-1, 3)
    lines = _lines(points, reached)
    pieces = [(line.dashed, tuple(a), tuple(b)) for line in lines for a, b in pairwise(line.points)]
    drawn = {(a, b): dashed for dashed, a, b in pieces}
    assert len(drawn) == len(reached) - 1 == len(pieces)
    for i in range(len(reached) - 1):
        assert drawn[tuple(points[i]), tuple(points[i + 1])] is not (reached[i] and reached[i + 1])


def test_unreached_points_carry_a_sign_besides_their_colour() -> None:
    items = path_items(np.eye(3), [True, False, False], np.empty((0, 3)), LIGHT)
    signs = [item for item in items if isinstance(item, Labels)]
    assert [label.text for label in signs[0].labels] == ["×", "×"]


def test_the_actual_path_lies_on_top_and_a_single_point_is_no_trail() -> None:
    assert path_items(np.eye(3), [True] * 3, np.eye(3), LIGHT)[-1].key == "path.actual"
    assert trail_items(np.zeros((1, 3)), LIGHT) == ()


def test_where_the_pen_is_up_the_path_is_thin_and_dashed_and_the_trail_is_not_drawn() -> None:
    points, up = np.arange(18.0).reshape(-1, 3), np.array([False, False, True, True, False, False])
    lines = path_items(points, np.ones(6, bool), np.empty((0, 3)), LIGHT, pen_up=up, marks=False)
    found = [(len(line.points), line.dashed, line.width) for line in lines if isinstance(line, Polyline)]
    assert found == [(2, False, 2.0), (3, True, 1.0), (3, False, 2.0)]
    trail = trail_items(points, LIGHT, pen_up=up)
    assert [len(line.points) for line in trail if isinstance(line, Polyline)] == [2, 3]


def test_a_path_of_one_point_is_no_line() -> None:
    assert _lines(np.zeros((1, 3)), [True]) == []
