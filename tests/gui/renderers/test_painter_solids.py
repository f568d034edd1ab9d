"""Rays meet capsules and boxes on their surface, and the first time they do."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from rvsim.gui.renderers.painter_lens import Lens, look_at
from rvsim.gui.renderers.painter_solids import FlatBody, Rays, RoundBody, Solid, body_of
from rvsim.scene import Box, Camera, Capsule, Color
from rvsim.spatial import rotation_from_vector

GREY = Color(0.5, 0.5, 0.5)
STEPS = np.linspace(-3.0, 3.0, 601)  # along each ray, about the solid's centre [m]
small = st.floats(-0.5, 0.5)
places = st.tuples(small, small, small).map(np.array)
capsules = st.builds(lambda a, b, r: Capsule("capsule", a, b, r, GREY), places, places, st.floats(0.05, 0.4))
sizes = st.tuples(*3 * [st.floats(0.1, 0.8)]).map(np.array)


def _box(place: np.ndarray, turn: np.ndarray, size: np.ndarray) -> Box:
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = rotation_from_vector(3.0 * turn), place
    return Box("box", T, size, GREY)


boxes = st.builds(_box, places, places, sizes)
cameras = st.builds(
    lambda azimuth, elevation, orthographic: Camera(
        np.zeros(3), 6.0, azimuth=azimuth, elevation=elevation, orthographic=orthographic
    ),
    st.floats(-3.0, 3.0),
    st.floats(-1.5, 1.5),
    st.booleans(),
)


def _distance(body: RoundBody | FlatBody, points: np.ndarray) -> np.ndarray:
    """How far points (…, 3) about the centre lie outside a solid (negative: inside), from its definition."""
    if isinstance(body, FlatBody):
        return (np.abs(points @ body.axes.T) - body.half).max(axis=-1)
    axis = body.axis.astype(float)
    share = np.clip(points @ axis / (axis @ axis), -0.5, 0.5)[..., None]
    return np.linalg.norm(points - share * axis, axis=-1) - body.radius


def _check(item: Solid, camera: Camera, spread: float) -> None:
    lens = Lens(camera, 400.0, 300.0)
    body = body_of(look_at((item,), lens)[0], lens)  # type: ignore[arg-type]
    grid = np.linspace(-0.7, 0.7, 9)
    x, y = (values.reshape(-1).astype(np.float32) for values in np.meshgrid(grid, grid))
    rays = Rays(x, y, np.float32(spread) * x, np.float32(spread) * y)
    depth, _ = body.hits(rays)
    along = STEPS[:, None]
    path = np.stack([x + along * rays.dx, y + along * rays.dy, np.broadcast_to(along, (len(STEPS), len(x)))], axis=-1)
    inside = _distance(body, path) < -2e-3  # clearly
    first = np.where(inside.any(axis=0), STEPS[inside.argmax(axis=0)], np.inf)
    assert np.isfinite(depth[np.isfinite(first)]).all()  # what is clearly met is met
    assert (depth <= first + 1e-3).all()  # and not too late
    met = np.isfinite(depth)
    reach = np.where(met, depth, 0.0)
    points = np.stack([x + reach * rays.dx, y + reach * rays.dy, reach], axis=-1)[met]
    assert np.abs(_distance(body, points)).max(initial=0.0) < 2e-3  # on the surface


@settings(max_examples=40)
@given(capsules, cameras, st.sampled_from([0.0, 0.2]))
def test_a_capsule_is_met_on_its_surface(item: Capsule, camera: Camera, spread: float) -> None:
    _check(item, camera, spread)


@settings(max_examples=40)
@given(boxes, cameras, st.sampled_from([0.0, 0.2]))
def test_a_box_is_met_on_its_surface(item: Box, camera: Camera, spread: float) -> None:
    _check(item, camera, spread)


def test_the_side_towards_the_light_is_brighter_and_opaque() -> None:
    lens = Lens(Camera(np.zeros(3), 5.0), 400.0, 300.0)
    ball = body_of(look_at((Capsule("ball", np.zeros(3), np.zeros(3), 1.0, GREY),), lens)[0], lens)  # type: ignore[arg-type]
    assert isinstance(ball, RoundBody)
    x, y = np.array([-0.5, 0.5], np.float32), np.array([0.5, -0.5], np.float32)
    nothing = np.zeros(2, np.float32)
    rays = Rays(x, y, nothing, nothing)
    upper_left, lower_right = ball.pixels(rays, ball.hits(rays).depth).tolist()
    assert upper_left >> 24 == lower_right >> 24 == 255
    assert upper_left & 255 > (lower_right & 255) + 20
