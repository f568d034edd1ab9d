"""Buttons stand in as few rows as fit, and these are filled alike."""

from __future__ import annotations

import pytest

from rvsim.gui.rows import rows_of


@pytest.mark.parametrize(
    ("widths", "rows"),
    [
        ([60] * 5, (5,)),
        ([80] * 5, (3, 2)),
        ([100, 70, 100, 120], (2, 2)),
        ([134, 166, 88, 68, 92, 127, 81], (2, 3, 2)),
        ([400, 20, 20], (1, 1, 1)),
        ([], ()),
    ],
)
def test_rows_are_few_and_filled_alike(widths: list[int], rows: tuple[int, ...]) -> None:
    assert rows_of(widths, gap=2, room=342) == rows
