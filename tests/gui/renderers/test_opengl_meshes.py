"""The unit bodies and line pieces that OpenGL draws from; they need no OpenGL."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.typing import NDArray

from rvsim.gui.renderers.opengl_meshes import box_body, capsule_body, capsule_transform, strokes_of
from rvsim.scene import Color, Dots, Polyline, Segments, Triads

BLACK, WHITE = Color(0.0, 0.0, 0.0), Color(1.0, 1.0, 1.0)
POINTS = arrays(
    np.float64,
    st.tuples(st.integers(0, 12), st.just(3)),
    elements=st.floats(-10, 10) | st.sampled_from([np.nan, np.inf, -np.inf]),
)


def stretched(body: NDArray[np.float32], stretch: float) -> NDArray[np.float64]:
    """(k, 3, 3) the triangles as the shader places them."""
    corners = body[:, :3].astype(np.float64)
    corners[:, 2] += stretch * body[:, 6]
    return corners.reshape(-1, 3, 3)


def volume(triangles: NDArray[np.float64]) -> float:
    return float(np.linalg.det(triangles).sum() / 6)


def test_a_box_has_the_volume_one_and_its_faces_look_outwards() -> None:
    body = box_body()
    assert volume(stretched(body, 0.0)) == pytest.approx(1.0)
    assert ((body[:, :3] * body[:, 3:6]).sum(axis=1) == 0.5).all()


def test_a_capsule_is_a_ball_and_a_cylinder_of_its_length() -> None:
    body = capsule_body(around=96, up=48)
    ball, cylinder = 4 / 3 * np.pi, np.pi
    for stretch in (0.0, 2.5):
        assert volume(stretched(body, stretch)) == pytest.approx(ball + stretch * cylinder, rel=2e-3)
    np.testing.assert_allclose(np.linalg.norm(body[:, 3:6], axis=1), 1.0, atol=1e-6)


@given(arrays(np.float64, 3, elements=st.floats(-5, 5)), arrays(np.float64, 3, elements=st.floats(-5, 5)))
def test_a_capsule_reaches_from_start_to_end(start: NDArray[np.float64], end: NDArray[np.float64]) -> None:
    frame, length = capsule_transform(start, end)
    np.testing.assert_allclose(frame @ [0.0, 0.0, length, 1.0], [*end, 1.0], atol=1e-12)
    np.testing.assert_allclose(frame[:3, :3].T @ frame[:3, :3], np.eye(3), atol=1e-12)
    assert np.linalg.det(frame) == pytest.approx(1.0)


@given(POINTS)
def test_only_numbers_are_drawn_and_each_finite_piece_once(points: NDArray[np.float64]) -> None:
    finite = np.isfinite(points).all(axis=1)
    pairs = finite[: len(finite) // 2 * 2].reshape(-1, 2)
    expected = {
        Polyline("p", points, BLACK): int((finite[1:] & finite[:-1]).sum()),
        Segments("s", points, BLACK): int(pairs.all(axis=1).sum()),
        Dots("d", points, BLACK): int(finite.sum()),
    }
    for item, pieces in expected.items():
        (stroke,) = strokes_of(item, WHITE)
        assert stroke.vertices.shape == (6 * pieces, 15)
        assert np.isfinite(stroke.vertices).all()


def test_a_line_knows_how_long_it_is_up_to_each_piece() -> None:
    corners = np.array([[0.0, 0.0, 0.0], [3.0, 4.0, 0.0], [3.0, 4.0, 2.0], [0.0, 0.0, 2.0]])
    (stroke,) = strokes_of(Polyline("p", corners, BLACK, dashed=True), WHITE)
    np.testing.assert_allclose(stroke.vertices[::6, 14], [0.0, 5.0, 7.0])


def test_frames_become_one_stroke_an_axis() -> None:
    frames = np.tile(np.eye(4), (3, 1, 1))
    strokes = strokes_of(Triads("t", frames, 0.1, alpha=0.5), WHITE)
    assert [len(stroke.vertices) for stroke in strokes] == [18, 18, 18]
    assert [int(np.argmax(stroke.color[:3])) for stroke in strokes] == [0, 1, 2]
    assert {stroke.color.alpha for stroke in strokes} == {0.5}
