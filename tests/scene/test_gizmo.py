"""What is held stays under the pointer; what cannot be dragged from where one looks cannot be taken hold of."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from rvsim.scene import Camera
from rvsim.scene.gizmo import PIXELS, Gizmo, Handle, dragged, gizmo_at, gizmo_items, handle_under, take_hold
from rvsim.scene.palette import DARK, LIGHT
from rvsim.spatial import rotation_error_angle, rotation_from_rpy

WIDTH, HEIGHT = 800.0, 600.0
CAMERA = Camera(np.array([0.1, 0.0, 0.2]), 2.0)
CAMERAS = [CAMERA, replace(CAMERA, orthographic=True), replace(CAMERA, azimuth=2.4, elevation=-0.5, distance=0.7)]
BASE = np.eye(3)
HANDLES = (
    *(Handle("ring", name, BASE[i], i) for i, name in enumerate("xyz")),
    *(Handle("plane", name, BASE[i], i) for i, name in enumerate(("yz", "xz", "xy"))),
    *(Handle("axis", name, BASE[i], i) for i, name in enumerate("xyz")),
    Handle("free", "free", BASE[2]),
)


def target() -> np.ndarray:
    T = np.eye(4)
    T[:3, :3] = rotation_from_rpy([0.3, -0.4, 1.0])
    T[:3, 3] = (0.15, -0.1, 0.3)
    return T


def gizmo(camera: Camera) -> Gizmo:
    return gizmo_at(target(), HANDLES, camera, HEIGHT)


def handle(key: str) -> Handle:
    return next(each for each in HANDLES if each.key == key)


def pixel(camera: Camera, point: np.ndarray) -> tuple[float, float]:
    x, y, _ = camera.project(point, WIDTH, HEIGHT).tolist()
    return x, y


def drag(camera: Camera, key: str, start: tuple[float, float], end: tuple[float, float], before: float = 0.0,
         snap: float = 0.0):  # fmt: skip
    grip = take_hold(gizmo(camera), handle(key), camera.ray(*start, WIDTH, HEIGHT))
    assert grip is not None
    return dragged(grip, camera.ray(*end, WIDTH, HEIGHT), before, snap)


@pytest.mark.parametrize("camera", CAMERAS)
@pytest.mark.parametrize("axis", range(3))
def test_an_arrow_follows_the_pointer_along_its_line_and_nowhere_else(camera: Camera, axis: int) -> None:
    held = target()[:3, 3] + 0.05 * BASE[axis]
    done = drag(camera, f"axis {'xyz'[axis]}", pixel(camera, held), pixel(camera, held + 0.12 * BASE[axis]))
    np.testing.assert_allclose(done.T[:3, 3] - target()[:3, 3], 0.12 * BASE[axis], atol=1e-12)
    assert done.amount == pytest.approx(0.12)
    np.testing.assert_array_equal(done.T[:3, :3], target()[:3, :3])


@pytest.mark.parametrize("camera", CAMERAS)
@pytest.mark.parametrize("normal", range(3))
def test_a_square_follows_the_pointer_in_its_plane(camera: Camera, normal: int) -> None:
    held = target()[:3, 3]
    step = np.where(np.arange(3) == normal, 0.0, (0.03, -0.05, 0.04))
    done = drag(camera, f"plane {('yz', 'xz', 'xy')[normal]}", pixel(camera, held), pixel(camera, held + step))
    np.testing.assert_allclose(done.T[:3, 3], held + step, atol=1e-12)


@pytest.mark.parametrize("camera", CAMERAS)
def test_the_knob_follows_the_pointer_parallel_to_the_picture(camera: Camera) -> None:
    x, y = pixel(camera, target()[:3, 3])
    done = drag(camera, "free free", (x, y), (x + 40.0, y - 25.0))
    np.testing.assert_allclose(pixel(camera, done.T[:3, 3]), (x + 40.0, y - 25.0), atol=1e-6)


@pytest.mark.parametrize("camera", CAMERAS)
@pytest.mark.parametrize("angle", [0.4, -1.3])
def test_a_ring_turns_the_target_in_place_by_the_angle_that_the_pointer_goes(camera: Camera, angle: float) -> None:
    u, v = BASE[0], BASE[1]
    start = target()[:3, 3] + 0.06 * u
    end = target()[:3, 3] + 0.06 * (math.cos(angle) * u + math.sin(angle) * v)
    done = drag(camera, "ring z", pixel(camera, start), pixel(camera, end))
    assert done.amount == pytest.approx(angle)
    np.testing.assert_allclose(done.T[:3, :3], rotation_from_rpy([0, 0, angle]) @ target()[:3, :3], atol=1e-12)
    np.testing.assert_array_equal(done.T[:3, 3], target()[:3, 3])


def test_a_ring_can_be_turned_further_than_half_a_turn() -> None:
    start, end = target()[:3, 3] + 0.06 * BASE[0], target()[:3, 3] - 0.06 * BASE[1]
    done = drag(CAMERA, "ring z", pixel(CAMERA, start), pixel(CAMERA, end), before=4.5)
    assert done.amount == pytest.approx(1.5 * math.pi)


def test_a_ring_seen_from_its_edge_turns_along_its_edge() -> None:
    side = replace(CAMERA, elevation=0.0, orthographic=True)
    x, y = pixel(side, target()[:3, 3])
    right = drag(side, "ring z", (x, y), (x + 30.0, y))
    left = drag(side, "ring z", (x, y), (x - 30.0, y + 10.0))
    assert right.amount == pytest.approx(-left.amount)
    assert right.amount > 0.1
    assert rotation_error_angle(right.T[:3, :3], target()[:3, :3]) == pytest.approx(right.amount)


def test_round_steps() -> None:
    held = target()[:3, 3]
    done = drag(CAMERA, "axis z", pixel(CAMERA, held), pixel(CAMERA, held + 0.0234 * BASE[2]), snap=0.01)
    assert done.amount == pytest.approx(0.02)


@pytest.mark.parametrize("camera", CAMERAS)
def test_each_handle_is_found_where_it_is_drawn_and_none_where_there_is_none(camera: Camera) -> None:
    shown = gizmo(camera)
    for axis in shown.handles:
        if axis.kind == "axis":
            x, y = pixel(camera, shown.origin + 0.97 * shown.size * axis.direction)
            assert handle_under(shown, camera, x, y, WIDTH, HEIGHT).key == axis.key
    x, y = pixel(camera, shown.origin)
    assert handle_under(shown, camera, x, y, WIDTH, HEIGHT).key == "free free"
    assert handle_under(shown, camera, x + 2.0 * PIXELS, y, WIDTH, HEIGHT) is None


def test_what_is_seen_from_its_end_or_its_edge_cannot_be_taken() -> None:
    top = gizmo(replace(CAMERA, elevation=math.pi / 2, orthographic=True))
    keys = {each.key for each in top.seen()}
    assert "axis z" not in keys
    assert {"plane yz", "plane xz"}.isdisjoint(keys)
    assert {"axis x", "axis y", "plane xy", "ring z"} <= keys


@pytest.mark.parametrize("distance", [0.4, 5.0])
@pytest.mark.parametrize("orthographic", [False, True])
def test_it_is_as_large_on_the_screen_from_everywhere(distance: float, orthographic: bool) -> None:
    camera = replace(CAMERA, distance=distance, orthographic=orthographic)
    shown = gizmo(camera)
    across = shown.origin + shown.size * camera.axes[0]
    length = np.hypot(*np.subtract(pixel(camera, across), pixel(camera, shown.origin)))
    assert length == pytest.approx(PIXELS)


@pytest.mark.parametrize("palette", [LIGHT, DARK])
def test_what_is_held_stands_out(palette) -> None:
    shown = gizmo(CAMERA)
    plain = {item.key: item for item in gizmo_items(shown, palette)}
    held = {item.key: item for item in gizmo_items(shown, palette, held="axis x", note="+12.0 mm")}
    assert held["gizmo.axis x"].width > plain["gizmo.axis x"].width
    assert "gizmo.axis y" in plain
    assert "gizmo.axis y" not in held
    assert held["gizmo.note"].labels[0].text == "+12.0 mm"
    assert all(key.startswith("gizmo") for key in (*plain, *held))
