"""Texts in the scene are whole or not there, and the floor's numbers do not lie on one another."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim.gui.renderers.text_room import TextRoom, moved_inside

WIDTH, HEIGHT, LINE, HALO = 300.0, 200.0, 20.0, 3.0
INK = 0.7 * (LINE - 2.0 * HALO)  # digits leave the top and the bottom of their line free
places = st.tuples(st.floats(-60.0, 340.0), st.floats(-60.0, 240.0), st.floats(12.0, 60.0))


@pytest.mark.parametrize(
    ("start", "expected"), [(10.0, 10.0), (-4.0, 0.0), (85.0, 80.0), (-11.0, None), (91.0, None), (0.0, 0.0)]
)
def test_a_text_is_moved_inside_or_left_out_but_never_cut(start: float, expected: float | None) -> None:
    assert moved_inside(start, 20.0, 100.0) == expected


@given(st.lists(places, max_size=30))
def test_texts_that_keep_apart_share_no_ink(wanted: list[tuple[float, float, float]]) -> None:
    room = TextRoom(WIDTH, HEIGHT, apart=True)
    placed = [(room.place(x, y, length, LINE, HALO), length) for x, y, length in wanted]
    shown = [(*corner, length) for corner, length in placed if corner is not None]
    for x, y, length in shown:
        assert 0.0 <= x <= WIDTH - length
        assert 0.0 <= y <= HEIGHT - LINE
    for index, (x, y, length) in enumerate(shown):
        for other_x, other_y, other_length in shown[:index]:
            beside = x + length - HALO <= other_x + HALO or other_x + other_length - HALO <= x + HALO
            assert beside or abs(y - other_y) >= INK - 1e-9


@given(st.lists(places, max_size=30))
def test_other_texts_do_not_hide_one_another(wanted: list[tuple[float, float, float]]) -> None:
    room = TextRoom(WIDTH, HEIGHT)
    for x, y, length in wanted:
        assert room.place(x, y, length, LINE, HALO) == TextRoom(WIDTH, HEIGHT).place(x, y, length, LINE, HALO)


@given(st.lists(places, max_size=12))
def test_a_text_whose_place_is_taken_goes_beside_it_or_is_left_out(wanted: list[tuple[float, float, float]]) -> None:
    room = TextRoom(WIDTH, HEIGHT, apart=True)
    shown = []
    for x, y, length in wanted:
        corner = room.place_near(x, y, length, LINE, HALO, (x - 6.0, y + 0.5 * LINE))
        if corner is not None:
            shown.append((*corner, length))
            assert abs(corner[0] - x) < 2.0 * length + 40.0
            assert abs(corner[1] - y) < 4.0 * LINE
    for index, (x, y, length) in enumerate(shown):
        for other_x, other_y, other_length in shown[:index]:
            beside = x + length - HALO <= other_x + HALO or other_x + other_length - HALO <= x + HALO
            assert beside or abs(y - other_y) >= INK - 1e-9


def test_two_texts_for_one_point_stand_on_either_side_of_it() -> None:
    room = TextRoom(WIDTH, HEIGHT, apart=True)
    places = [room.place_near(106.0, 80.0, 40.0, LINE, HALO, (100.0, 90.0)) for _ in range(2)]
    assert places[0] == (106.0, 80.0)
    assert places[1] is not None
    assert places[1][0] + 40.0 <= 100.0
