"""The laws of the camera: what is seen at a pixel is what the ray through that pixel meets."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rvsim.scene import PRESETS, Camera
from rvsim.scene.camera_moves import blended, dome, framed

WIDTH, HEIGHT = 640.0, 480.0
near_zero = st.floats(-1.0, 1.0)
points = st.tuples(near_zero, near_zero, near_zero).map(np.array)
cameras = st.builds(
    Camera,
    target=points,
    distance=st.floats(3.0, 20.0),
    azimuth=st.floats(-math.pi, math.pi),
    elevation=st.floats(-math.pi / 2, math.pi / 2),
    orthographic=st.booleans(),
)
pixels = st.tuples(st.floats(0.0, WIDTH), st.floats(0.0, HEIGHT))


@given(cameras, points)
def test_the_ray_through_a_points_pixel_passes_the_point(camera: Camera, point: np.ndarray) -> None:
    x, y, depth = camera.project(point, WIDTH, HEIGHT)
    origin, direction = camera.ray(x, y, WIDTH, HEIGHT)
    assert np.linalg.norm(np.cross(point - origin, direction)) < 1e-9
    assert depth > 0.0


@given(cameras, points)
def test_the_matrices_of_opengl_give_the_same_pixel(camera: Camera, point: np.ndarray) -> None:
    clip = camera.projection_matrix(WIDTH, HEIGHT) @ camera.view_matrix() @ np.append(point, 1.0)
    x, y = clip[:2] / clip[3]
    expected = (WIDTH / 2 * (1 + x), HEIGHT / 2 * (1 - y))
    np.testing.assert_allclose(camera.project(point, WIDTH, HEIGHT)[:2], expected, atol=1e-6)


@given(cameras, st.floats(0.5, 2.0), pixels)
def test_zooming_keeps_the_point_under_the_pointer(camera: Camera, factor: float, pixel: tuple[float, float]) -> None:
    right, up, _ = camera.axes
    scale = camera.metres_per_pixel(HEIGHT)
    under = camera.target + scale * ((pixel[0] - WIDTH / 2) * right + (HEIGHT / 2 - pixel[1]) * up)
    zoomed = camera.zoomed(factor, *pixel, WIDTH, HEIGHT)
    np.testing.assert_allclose(zoomed.project(under, WIDTH, HEIGHT)[:2], pixel, atol=1e-6)
    assert zoomed.distance == pytest.approx(camera.distance / factor)


@given(cameras, st.floats(-9.0, 9.0), st.floats(-9.0, 9.0))
def test_orbiting_keeps_the_distance_and_stops_at_the_poles(camera: Camera, turn: float, lift: float) -> None:
    orbited = camera.orbited(turn, lift)
    assert np.linalg.norm(orbited.eye - camera.target) == pytest.approx(camera.distance)
    assert abs(orbited.elevation) <= math.pi / 2


@given(cameras, st.floats(-200.0, 200.0), st.floats(-200.0, 200.0))
def test_panning_moves_the_target_with_the_pointer(camera: Camera, right: float, down: float) -> None:
    panned = camera.panned(right, down, HEIGHT)
    expected = (WIDTH / 2 + right, HEIGHT / 2 + down)
    np.testing.assert_allclose(panned.project(camera.target, WIDTH, HEIGHT)[:2], expected, atol=1e-6)


@given(cameras, points, st.tuples(*3 * [st.floats(0.05, 2.0)]).map(np.array))
def test_fitting_brings_the_whole_box_into_view(camera: Camera, corner: np.ndarray, size: np.ndarray) -> None:
    bounds = np.array([corner, corner + size])
    corners = np.array([[bounds[i, 0], bounds[j, 1], bounds[k, 2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    x, y, depth = camera.fitted(bounds, WIDTH, HEIGHT).project(corners, WIDTH, HEIGHT).T
    assert camera.orthographic or (depth > 0.0).all()  # parallel lines have no eye that a point could be behind
    assert (x >= 0.0).all()
    assert (x <= WIDTH).all()
    assert (y >= 0.0).all()
    assert (y <= HEIGHT).all()


@given(cameras, points, st.tuples(*3 * [st.floats(0.2, 2.0)]).map(np.array))
def test_framing_touches_two_opposite_margins_and_leaves_the_others_free(
    camera: Camera, corner: np.ndarray, size: np.ndarray
) -> None:
    bounds = np.array([corner, corner + size])
    seen = framed(camera, bounds, WIDTH, HEIGHT, margin=0.05).project(dome(bounds), WIDTH, HEIGHT)[:, :2]
    low, high = seen.min(axis=0) / (WIDTH, HEIGHT), seen.max(axis=0) / (WIDTH, HEIGHT)
    touches = (np.abs(low - 0.05) < 1e-9) & (np.abs(high - 0.95) < 1e-9)
    assert touches.any()
    assert low.min() > 0.05 - 1e-9
    assert high.max() < 0.95 + 1e-9


def test_a_zoomed_box_fills_the_picture() -> None:
    camera = Camera(np.zeros(3), 5.0)
    target = camera.ray(300.0, 200.0, WIDTH, HEIGHT)
    on_plane = target.origin + target.direction * 5.0 / -(target.direction @ camera.axes[2])
    zoomed = camera.zoomed_to_box(280.0, 185.0, 320.0, 215.0, WIDTH, HEIGHT)
    np.testing.assert_allclose(zoomed.project(on_plane, WIDTH, HEIGHT)[:2], (WIDTH / 2, HEIGHT / 2), atol=1e-6)
    assert zoomed.distance == pytest.approx(5.0 / 16.0)


@pytest.mark.parametrize(
    ("name", "right", "up"),
    [("top", (1, 0, 0), (0, 1, 0)), ("front", (0, 1, 0), (0, 0, 1)), ("side", (1, 0, 0), (0, 0, 1))],
)
def test_presets_look_along_the_axes(name: str, right: tuple[int, ...], up: tuple[int, ...]) -> None:
    axes = Camera(np.zeros(3), 1.0).from_preset(name).axes
    np.testing.assert_allclose(axes[:2], [right, up], atol=1e-12)
    assert name in PRESETS


@given(cameras, cameras)
def test_a_move_begins_and_ends_where_it_should_and_goes_the_short_way(start: Camera, end: Camera) -> None:
    half = blended(start, end, 0.5)
    np.testing.assert_allclose(blended(start, end, 0.0).target, start.target)
    np.testing.assert_allclose(blended(start, end, 1.0).axes, end.axes, atol=1e-9)
    assert abs(half.azimuth - start.azimuth) <= math.pi / 2 + 1e-12
