"""Where a line of sight meets a plane: the place that is seen at that pixel, and nowhere when it is seen edge-on."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from rvsim.scene import Camera, Ray
from rvsim.scene.palette import LIGHT
from rvsim.scene.picking import plane_point
from rvsim.scene.primitives import Segments
from rvsim.scene.work_plane import WorkPlane, point_items, pointer_items, work_plane_items

SIZE = 640.0, 480.0
planes = st.builds(WorkPlane, st.integers(0, 2), st.floats(-0.4, 0.4))
cameras = st.builds(
    Camera,
    st.just(np.array([0.2, 0.1, 0.3])),
    st.floats(1.5, 4.0),
    st.floats(-3.1, 3.1),
    st.floats(-1.5, 1.5),
    orthographic=st.booleans(),
)


@given(planes, cameras, st.floats(0.0, 640.0), st.floats(0.0, 480.0))
def test_the_place_is_on_the_plane_and_seen_at_the_pixel(plane: WorkPlane, camera: Camera, x: float, y: float) -> None:
    point = plane.meets(camera.ray(x, y, *SIZE))
    assume(point is not None)
    assert point is not None
    assert point[plane.axis] == plane.offset
    np.testing.assert_allclose(camera.project(point, *SIZE)[:2], (x, y), atol=1e-6)


@given(planes, cameras, st.floats(0.0, 640.0), st.floats(0.0, 480.0), st.sampled_from([1e-3, 1e-2]))
def test_steps_are_whole_but_the_plane_is_kept(
    plane: WorkPlane, camera: Camera, x: float, y: float, step: float
) -> None:
    ray = camera.ray(x, y, *SIZE)
    exact, rounded = plane.meets(ray), plane.meets(ray, step)
    assume(exact is not None and rounded is not None)
    assert exact is not None
    assert rounded is not None
    assert rounded[plane.axis] == plane.offset
    assert np.abs(rounded - exact).max() <= 0.5 * step + 1e-9
    others = np.delete(rounded, plane.axis) / step
    np.testing.assert_allclose(others, np.round(others), atol=1e-6)


@pytest.mark.parametrize(
    ("direction", "met"), [((0, 0, -1), True), ((0, 0, 1), False), ((1, 0, 0), False), ((1, 0, -0.01), False)]
)
def test_behind_the_eye_and_edge_on_nothing_is_met(direction: tuple[float, float, float], met: bool) -> None:
    unit = np.array(direction) / np.linalg.norm(direction)
    found = plane_point(Ray(np.array([0.0, 0.0, 1.0]), unit), np.zeros(3), np.array([0.0, 0.0, 1.0]))
    assert (found is not None) == met


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_what_is_drawn_lies_on_the_plane_and_stands_on_the_floor(axis: int) -> None:
    plane, middle = WorkPlane(axis, 0.25), np.array([0.3, -0.2, 0.05])
    items = work_plane_items(plane, middle, 0.2, LIGHT)
    (grid,) = [item for item in items if isinstance(item, Segments)]
    np.testing.assert_allclose(grid.points[:, axis], 0.25)
    np.testing.assert_allclose(np.delete(np.ptp(grid.points, axis=0), axis), 0.4)
    assert grid.points[:, 2].min() >= 0.0
    numbers = np.random.default_rng(0).uniform(size=(41, 3))
    every = (*items, *point_items(numbers, LIGHT), *pointer_items(numbers[0], "here", LIGHT))
    assert len({item.key for item in every}) == len(every)
    assert len(point_items(numbers[:3], LIGHT)[1].labels) == 3  # type: ignore[union-attr]
    assert not point_items(numbers, LIGHT)[1].labels  # type: ignore[union-attr]
