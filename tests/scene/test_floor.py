"""The floor has round numbers and covers what it should."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim.scene import Box, Item, Labels, Segments
from rvsim.scene.floor import Extent, floor_items, nice_step
from rvsim.scene.palette import LIGHT

reaches = st.floats(0.05, 20.0)
extents = st.builds(lambda w, e, s, n: Extent(-w, e, -s, n), reaches, reaches, reaches, reaches)


@given(st.floats(1e-4, 1e4))
def test_a_step_is_one_two_or_five_and_not_much_smaller_than_asked(rough: float) -> None:
    step = nice_step(rough)
    mantissa = step / 10.0 ** np.floor(np.log10(step) + 1e-9)
    assert min(abs(mantissa - nice) for nice in (1.0, 2.0, 5.0)) < 1e-9
    assert 0.39 * rough <= step <= rough * (1 + 1e-6)


@given(extents)
def test_the_grid_covers_the_extent_and_passes_the_base(extent: Extent) -> None:
    items: dict[str, Item] = {item.key: item for item in floor_items(LIGHT, extent, "mm")}
    grid, plate = items["floor.major"], items["floor.plate"]
    assert isinstance(grid, Segments)
    assert isinstance(plate, Box)
    lower, upper = grid.points.min(axis=0), grid.points.max(axis=0)
    assert (lower[:2] <= (extent.x_min + 1e-6, extent.y_min + 1e-6)).all()
    assert (upper[:2] >= (extent.x_max - 1e-6, extent.y_max - 1e-6)).all()
    assert np.abs(grid.points[:, 0]).min() < 1e-9
    assert not grid.points[:, 2].any()


@pytest.mark.parametrize(
    ("unit", "number", "axis"), [("mm", "−500", "x [mm]"), ("m", "−0.5", "x [m]"), ("unit", "−0.5", "x [unit]")]
)
def test_numbers_are_in_the_shown_unit(unit: str, number: str, axis: str) -> None:
    numbers = floor_items(LIGHT, Extent(-0.5, 0.5, -0.5, 0.5), unit)[-1]
    assert isinstance(numbers, Labels)
    texts = {label.text for label in numbers.labels}
    assert {number, axis, "0"} <= texts
