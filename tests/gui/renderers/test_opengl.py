"""The OpenGL picture, judged by its pixels; needs a real context (a virtual X server will do)."""

from __future__ import annotations

import gc
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from PySide6.QtGui import QGuiApplication, QImage
from PySide6.QtWidgets import QVBoxLayout, QWidget
from pytestqt.qtbot import QtBot

from rvsim import load_robot
from rvsim.gui.renderers.base import Renderer
from rvsim.gui.renderers.choose import PLATFORMS_WITHOUT_OPENGL, choose_renderer, renderer_factory
from rvsim.gui.renderers.opengl_context import probe_opengl
from rvsim.gui.renderers.painter import PainterRenderer
from rvsim.scene import Box, Camera, Capsule, Color, Dots, Item, Label, Labels, Polyline, Scene, Segments, Triads
from rvsim.scene.build import LOOKS, SceneOptions, arm_items, compose
from rvsim.scene.palette import DARK, LIGHT, axis_colors

pytestmark = pytest.mark.opengl

WIDTH, HEIGHT = 320, 240
WHITE, RED, GREEN, BLUE = Color(1.0, 1.0, 1.0), Color(0.9, 0.1, 0.1), Color(0.1, 0.7, 0.2), Color(0.1, 0.2, 0.9)
BOUNDS = np.array([[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]])
CAMERA = Camera(np.zeros(3), 4.0)
# Seen along −x: y goes to the right, z upwards, in metres times this many pixels.
FRONT = replace(CAMERA, azimuth=0.0, elevation=0.0, orthographic=True)
PIXELS = 1 / FRONT.metres_per_pixel(HEIGHT)
Pixels = NDArray[np.float64]


@pytest.fixture(autouse=True)
def _opengl(qapp: QGuiApplication) -> None:
    if qapp.platformName() in PLATFORMS_WITHOUT_OPENGL:
        pytest.skip("there is no OpenGL without a screen: packaging/dev.py test runs these on a virtual one")


class Picture:
    """A renderer in a window of its own, and what it shows."""

    def __init__(self, qtbot: QtBot, renderer: Renderer, window: QWidget) -> None:
        self.renderer, self.window = renderer, window
        qtbot.addWidget(window)
        layout = QVBoxLayout(window)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(renderer.widget())
        window.resize(WIDTH, HEIGHT)

    def of(self, *items: Item, camera: Camera = CAMERA, background: Color = WHITE) -> Pixels:
        """(height, width, 3) the colours that these items give, 0…1."""
        return self.of_scene(Scene(items, background, BOUNDS), camera)

    def of_scene(self, scene: Scene, camera: Camera) -> Pixels:
        self.renderer.set_camera(camera)
        self.renderer.set_scene(scene)
        return pixels(self.renderer.image())


def pixels(image: QImage) -> Pixels:
    plain = image.convertToFormat(QImage.Format.Format_RGB32)
    channels = np.frombuffer(plain.constBits(), dtype=np.uint8).reshape(plain.height(), plain.width(), 4)
    return channels[:, :, 2::-1] / 255.0


@pytest.fixture
def view(qtbot: QtBot) -> Picture:
    # Imported here: PyOpenGL asks for the kind of context that Qt makes, which an application without a screen has not.
    from rvsim.gui.renderers.opengl import OpenGLRenderer

    window = QWidget()
    picture = Picture(qtbot, OpenGLRenderer(window), window)
    with qtbot.waitExposed(window):
        window.show()
    return picture


def differs(picture: Pixels, background: Color = WHITE) -> NDArray[np.bool_]:
    """(height, width) where something is."""
    return np.asarray(np.abs(picture - background[:3]).max(axis=2) > 0.1)


def at(picture: Pixels, place: tuple[float, ...] | NDArray[np.float64], camera: Camera = CAMERA) -> Pixels:
    """The colour where a point (3,) is seen."""
    x, y, _ = camera.project(place, WIDTH, HEIGHT)
    return picture[int(y), int(x)]


def extent(shown: NDArray[np.bool_]) -> tuple[int, int]:
    """Width and height of what is shown."""
    rows, columns = np.nonzero(shown)
    return int(np.ptp(columns)) + 1, int(np.ptp(rows)) + 1


# --- where things are ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("background", [WHITE, DARK.background])
def test_an_empty_scene_is_its_background(view: Picture, background: Color) -> None:
    assert np.abs(view.of(background=background) - background[:3]).max() < 0.01


@pytest.mark.parametrize("orthographic", [False, True])
def test_a_dot_is_where_the_camera_says(view: Picture, orthographic: bool) -> None:
    camera = replace(CAMERA, orthographic=orthographic)
    for place in np.random.default_rng(1).uniform(-0.8, 0.8, (8, 3)):
        shown = differs(view.of(Dots("dot", place[None], RED, 12.0), camera=camera))
        rows, columns = np.nonzero(shown)
        centre = columns.mean() + 0.5, rows.mean() + 0.5
        np.testing.assert_allclose(centre, camera.project(place, WIDTH, HEIGHT)[:2], atol=0.5)
        np.testing.assert_allclose(extent(shown), 12.0, atol=1.5)


@pytest.mark.parametrize("width", [1.0, 3.0, 8.0])
def test_a_line_is_as_wide_as_it_says_and_goes_from_end_to_end(view: Picture, width: float) -> None:
    line = Polyline("line", np.array([[0.0, -0.5, 0.0], [0.0, 0.5, 0.0]]), BLUE, width)
    picture = view.of(line, camera=FRONT)
    np.testing.assert_allclose(extent(differs(picture)), (PIXELS + width, width), atol=1.5)


def test_a_bent_translucent_line_covers_no_pixel_twice(view: Picture) -> None:
    turn = np.linspace(0.0, 3.0, 400)
    arc = np.stack([0.0 * turn, 0.7 * np.cos(turn), 0.7 * np.sin(turn)], axis=1)
    picture = view.of(Polyline("arc", arc, Color(0.0, 0.0, 0.0, 0.5), 6.0), camera=FRONT)
    assert picture.min() == pytest.approx(0.5, abs=0.02)


def test_segments_leave_the_gaps_between_them_and_a_dashed_line_has_gaps_of_its_own(view: Picture) -> None:
    row = np.array([[0.0, y, 0.0] for y in (-0.8, -0.4, 0.4, 0.8)])
    middle = (0.0, 0.0, 0.0)
    np.testing.assert_allclose(at(view.of(Segments("s", row, RED, 3.0), camera=FRONT), middle, FRONT), 1.0)
    assert at(view.of(Polyline("s", row, RED, 3.0), camera=FRONT), middle, FRONT)[1] < 0.5
    dashes = differs(view.of(Polyline("s", row, RED, 3.0, dashed=True), camera=FRONT)).any(axis=0)
    share = dashes.sum() / (1.6 * PIXELS)
    assert 0.5 < share < 0.8


def test_a_line_that_passes_the_eye_is_seen_as_far_as_it_is_before_it(view: Picture) -> None:
    camera = replace(CAMERA, azimuth=0.0, elevation=0.0)
    line = Polyline("line", np.array([[-1.0, -0.3, 0.2], [100.0, -0.3, 0.2]]), RED, 4.0)
    shown = differs(view.of(line, camera=camera))
    assert shown[:, 0].any() or shown[0].any(), "it leaves the picture at the border"
    assert not shown[HEIGHT // 2 + 5 :].any(), "and does not come back on the other side"


def test_a_capsule_keeps_round_ends_however_long_it_is(view: Picture) -> None:
    for length in (0.0, 0.3, 1.0):
        end = np.array([0.0, length - 0.5, 0.0])
        picture = view.of(Capsule("c", np.array([0.0, -0.5, 0.0]), end, 0.1, GREEN), camera=FRONT)
        expected = ((length + 0.2) * PIXELS, 0.2 * PIXELS)
        np.testing.assert_allclose(extent(differs(picture)), expected, atol=1.5)
        corner = (0.0, end[1] + 0.085, 0.085)
        np.testing.assert_allclose(at(picture, corner, FRONT), 1.0, atol=0.05, err_msg="a round end has no corner")


def test_a_box_has_its_size_and_turns_with_its_frame(view: Picture) -> None:
    size = np.array([0.2, 1.0, 0.4])
    np.testing.assert_allclose(
        extent(differs(view.of(Box("b", np.eye(4), size, GREEN), camera=FRONT))), (PIXELS, 0.4 * PIXELS), atol=1.5
    )
    upright = np.eye(4)[[0, 2, 1, 3]] * [1, 1, -1, 1]
    np.testing.assert_allclose(
        extent(differs(view.of(Box("b", upright, size, GREEN), camera=FRONT))), (0.4 * PIXELS, PIXELS), atol=1.5
    )


def test_frames_are_red_green_and_blue(view: Picture) -> None:
    picture = view.of(Triads("t", np.eye(4)[None], 0.8))
    for axis, color in zip(np.eye(3), axis_colors(WHITE), strict=True):
        np.testing.assert_allclose(at(picture, 0.4 * axis), color[:3], atol=0.35)


# --- what hides what -----------------------------------------------------------------------------------------------


def test_what_is_nearer_hides_what_is_farther_in_whatever_order_they_come(view: Picture) -> None:
    near, far = np.eye(4), np.eye(4)
    near[0, 3], far[0, 3] = 0.5, -0.5
    size = np.array([0.2, 0.6, 0.6])
    items = (Box("near", near, size, RED), Box("far", far, size, BLUE))
    for order in (items, items[::-1]):
        red, _, blue = at(view.of(*order, camera=FRONT), (0.5, 0.0, 0.0), FRONT)
        assert red > blue


def test_a_line_behind_a_body_is_hidden_and_one_before_it_is_not(view: Picture) -> None:
    body = Box("body", np.eye(4), np.array([0.2, 0.6, 0.6]), GREEN)
    for depth, color in ((-0.5, GREEN), (0.5, RED)):
        line = Polyline("line", np.array([[depth, -0.8, 0.0], [depth, 0.8, 0.0]]), RED, 3.0)
        seen = at(view.of(line, body, camera=FRONT), (0.0, 0.0, 0.0), FRONT)
        assert np.argmax(seen) == np.argmax(color[:3])


def test_a_frame_is_seen_through_a_body(view: Picture) -> None:
    body = Box("body", np.eye(4), np.array([0.9, 0.9, 0.9]), WHITE)
    seen = at(view.of(body, Triads("t", np.eye(4)[None], 0.4), camera=FRONT), (0.0, 0.2, 0.0), FRONT)
    assert seen[1] > seen[0] + 0.2


def test_ghosts_of_one_alpha_are_one_pane_of_glass(view: Picture) -> None:
    size = np.array([0.2, 0.6, 0.6])
    solid = at(view.of(Box("a", np.eye(4), size, BLUE), camera=FRONT), (0.1, 0.15, 0.1), FRONT)
    ghosts = [Box(name, np.eye(4), size * grown, BLUE.faded(0.3)) for name, grown in (("a", 1.0), ("b", 0.9))]
    seen = at(view.of(*ghosts, camera=FRONT), (0.1, 0.15, 0.1), FRONT)
    np.testing.assert_allclose(seen, 0.3 * solid + 0.7, atol=0.02)


def test_a_body_above_the_floor_has_its_shadow_on_it_but_none_without_a_floor(view: Picture) -> None:
    camera = CAMERA.from_preset("side")
    camera = replace(camera, elevation=0.9)
    raised = np.eye(4)
    raised[2, 3] = 0.8
    body = Box("body", raised, np.array([0.6, 0.6, 0.2]), RED)
    floor = Box("floor.plate", np.eye(4), np.array([3.0, 3.0, 0.01]), WHITE)
    below, beside = (0.0, 0.0, 0.0), (0.9, 0.0, 0.0)
    shaded = view.of(floor, body, camera=camera)
    assert at(shaded, below, camera).max() < at(shaded, beside, camera).min() - 0.05
    floating = view.of(replace(body, key="other"), camera=camera)
    np.testing.assert_allclose(at(floating, below, camera), at(floating, beside, camera))


def test_the_floor_hides_nothing(view: Picture) -> None:
    camera = replace(CAMERA, elevation=-0.6)
    floor = Box("floor.plate", np.eye(4), np.array([3.0, 3.0, 0.01]), WHITE)
    dot = Dots("dot", np.array([[0.0, 0.0, 0.3]]), BLUE, 12.0)
    assert at(view.of(floor, dot, camera=camera), dot.points[0], camera)[0] < 0.3


def test_edges_are_smooth_in_a_picture_and_on_a_screen_at_rest(view: Picture, qtbot: QtBot) -> None:
    turned = np.eye(4)
    turned[1:3, 1:3] = [[np.cos(0.3), -np.sin(0.3)], [np.sin(0.3), np.cos(0.3)]]
    picture = view.of(Box("body", turned, np.array([0.2, 1.0, 1.0]), Color(0.0, 0.0, 0.0)), camera=FRONT)

    def shades(colours: Pixels) -> int:
        return len(np.unique(np.rint(colours[:, :, 1] * 50)))

    def on_screen() -> Pixels:
        return pixels(view.window.screen().grabWindow(view.window.winId()).toImage())

    assert shades(picture) > 4
    qtbot.waitUntil(lambda: shades(on_screen()) > 4)


# --- texts ---------------------------------------------------------------------------------------------------------


def test_a_label_is_beside_its_place_on_top_of_everything_and_goes_again(view: Picture) -> None:
    body = Box("body", np.eye(4), np.array([0.8, 0.8, 0.8]), WHITE)
    label = Labels("labels", (Label(np.zeros(3), "J1", Color(0.0, 0.0, 0.0), (6.0, -6.0), 14.0),))
    dark = view.of(body, label).max(axis=2) < 0.2
    rows, columns = np.nonzero(dark)
    assert dark.sum() > 15
    assert WIDTH / 2 + 4 < columns.min() < columns.max() < WIDTH / 2 + 40
    assert HEIGHT / 2 - 25 < rows.min() < rows.max() < HEIGHT / 2
    assert not (view.of(body).max(axis=2) < 0.2).any()


def test_frames_have_letters_only_when_asked(view: Picture) -> None:
    frames = Triads("t", np.eye(4)[None], 0.5, letters=True)
    with_letters, without = view.of(frames), view.of(replace(frames, letters=False))
    changed = np.abs(with_letters - without).max(axis=2) > 0.3
    assert changed.sum() > 20


# --- what does not disturb it --------------------------------------------------------------------------------------


def nowhere(value: float) -> list[Item]:
    points = np.full((4, 3), value)
    return [
        Polyline("n1", points, RED),
        Segments("n2", points, RED),
        Dots("n3", points, RED),
        Capsule("n4", points[0], np.zeros(3), 0.1, RED),
        Box("n5", np.full((4, 4), value), np.ones(3), RED),
        Triads("n6", np.full((2, 4, 4), value), 0.1, letters=True),
        Labels("n7", (Label(points[0], "nowhere", RED), Label(np.zeros(3), "", RED))),
        Polyline("n8", np.empty((0, 3)), RED),
        Dots("n9", np.empty((0, 3)), RED),
        Triads("n10", np.empty((0, 4, 4)), 0.1, letters=True),
        Labels("n11", ()),
    ]


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_what_is_nowhere_is_left_out_and_the_rest_is_drawn(view: Picture, value: float) -> None:
    dot = Dots("dot", np.zeros((1, 3)), BLUE, 12.0)
    np.testing.assert_array_equal(view.of(dot, *nowhere(value)), view.of(dot))


def test_a_gap_of_nan_parts_a_line(view: Picture) -> None:
    points = np.array([[0.0, y, 0.0] for y in (-0.8, -0.3, np.nan, 0.3, 0.8)])
    columns = differs(view.of(Polyline("line", points, RED, 3.0), camera=FRONT)).any(axis=0)
    assert not columns[WIDTH // 2]
    assert columns.sum() == pytest.approx(PIXELS, abs=8)


def test_items_move_come_and_go(view: Picture) -> None:
    here, there = np.array([[0.0, -0.5, 0.0]]), np.array([[0.0, 0.5, 0.0]])
    kept = Dots("kept", np.array([[0.0, 0.0, 0.5]]), GREEN, 12.0)
    view.of(kept, Dots("moved", here, RED, 12.0), camera=FRONT)
    moved = view.of(kept, Dots("moved", there, RED, 12.0), camera=FRONT)
    assert at(moved, here[0], FRONT).min() > 0.99
    assert at(moved, there[0], FRONT)[1] < 0.2
    gone = view.of(kept, camera=FRONT)
    assert at(gone, there[0], FRONT).min() > 0.99
    assert at(gone, kept.points[0], FRONT)[0] < 0.2
    other_kind = view.of(Polyline("kept", np.concatenate([here, there]), BLUE, 5.0), camera=FRONT)
    assert at(other_kind, (0.0, 0.0, 0.0), FRONT)[0] < 0.3


def test_many_scenes_leave_nothing_behind(view: Picture) -> None:
    from rvsim.gui.renderers.opengl_buffers import Vertices

    robots = [load_robot(name) for name in ("rv-m1", "ur5e", "scara")]

    def show(rounds: int) -> int:
        for number in range(rounds):
            robot = robots[number % len(robots)]
            options = SceneOptions(look=LOOKS[number % 2], frames=True)
            view.of_scene(compose(robot, robot.home, LIGHT, options), CAMERA)
        gc.collect()
        return sum(isinstance(thing, Vertices) for thing in gc.get_objects())

    assert show(6) == show(30)


def test_a_second_view_and_one_that_moves_to_another_window_are_not_blank(view: Picture, qtbot: QtBot) -> None:
    from rvsim.gui.renderers.opengl import OpenGLRenderer

    body = Box("body", np.eye(4), np.array([0.6, 0.6, 0.6]), RED)
    first = view.of(body)
    other = QWidget()
    second = Picture(qtbot, OpenGLRenderer(other), other)
    with qtbot.waitExposed(other):
        other.show()
    np.testing.assert_array_equal(second.of(body), first)
    layout = other.layout()
    assert layout is not None
    layout.addWidget(view.renderer.widget())
    second.renderer.widget().hide()
    qtbot.waitUntil(lambda: view.renderer.widget().size() == other.size())
    np.testing.assert_array_equal(view.of(body), first)


def test_a_view_that_was_never_shown_makes_a_picture(qtbot: QtBot) -> None:
    window = QWidget()
    qtbot.addWidget(window)
    made = renderer_factory(choose_renderer("gl", "xcb", probe_opengl))(window)
    made.widget().resize(WIDTH, HEIGHT)
    made.set_camera(CAMERA)
    made.set_scene(Scene((Dots("dot", np.zeros((1, 3)), RED, 12.0),), WHITE, BOUNDS))
    assert made.name == "opengl"
    assert pixels(made.image()).shape == (HEIGHT, WIDTH, 3)
    assert differs(pixels(made.image())).sum() > 80


def test_each_frame_is_reported_with_its_time(view: Picture, qtbot: QtBot) -> None:
    times: list[float] = []
    view.renderer.on_painted(times.append)
    view.renderer.set_camera(FRONT)
    qtbot.waitUntil(lambda: bool(times))
    assert 0.0 < times[0] < 10_000.0


# --- the same picture as the painter's -----------------------------------------------------------------------------


def blurred(picture: Pixels) -> Pixels:
    return np.asarray(picture.reshape(HEIGHT // 8, 8, WIDTH // 8, 8, 3).mean(axis=(1, 3)))


@pytest.mark.parametrize("name", ["rv-m1", "ur5e", "scara"])
@pytest.mark.parametrize("look", LOOKS)
@pytest.mark.parametrize("palette", [LIGHT, DARK], ids=["light", "dark"])
def test_both_renderers_paint_the_same_arm(view: Picture, qtbot: QtBot, name: str, look: str, palette: object) -> None:
    robot = load_robot(name)
    q = robot.home + 0.3
    ghost = arm_items(robot, robot.home - 0.3, palette, look=look, key="ghost", alpha=0.3)
    scene = compose(robot, q, palette, SceneOptions(look=look, frames=True), ghost)
    painted = Picture(qtbot, PainterRenderer(), QWidget())
    painted.renderer.widget().resize(WIDTH, HEIGHT)
    for preset in ("iso", "top", "side"):
        for orthographic in (False, True):
            camera = replace(CAMERA.from_preset(preset), orthographic=orthographic).fitted(scene.bounds, WIDTH, HEIGHT)
            difference = np.abs(blurred(view.of_scene(scene, camera)) - blurred(painted.of_scene(scene, camera)))
            assert difference.mean() < 0.01
            assert np.quantile(difference, 0.995) < 0.15


# --- when it breaks ------------------------------------------------------------------------------------------------


def test_an_error_while_painting_is_told_once_and_the_painter_takes_over(
    qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    from rvsim.gui.renderers.opengl_bodies import BodyLayer

    def refuse(_layer: object) -> None:
        raise RuntimeError("the driver refuses")

    monkeypatch.setattr(BodyLayer, "paint", refuse)
    sentences: list[str] = []
    window = QWidget()
    factory = renderer_factory(choose_renderer("gl", "xcb", probe_opengl), sentences.append)
    picture = Picture(qtbot, factory(window), window)
    with qtbot.waitExposed(window):
        window.show()
    qtbot.waitUntil(lambda: picture.renderer.name == "painter")
    assert sentences == ["The painter draws: OpenGL failed (the driver refuses)."]
    assert differs(picture.of(Box("b", np.eye(4), np.ones(3), RED))).sum() > 1000


def test_opengl_that_paints_nothing_is_found_out_before_the_first_frame(
    qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    from rvsim.gui.renderers.opengl import OpenGLRenderer
    from rvsim.gui.renderers.opengl_strokes import StrokeLayer

    monkeypatch.setattr(StrokeLayer, "draw", lambda _layer, _frame: None)
    renderer = OpenGLRenderer(None)
    qtbot.addWidget(renderer.widget())
    with qtbot.waitSignal(renderer.failed) as told:
        renderer.widget().show()
    assert told.args == ["it reports no error but paints nothing"]


@pytest.mark.qt_log_ignore("QOpenGLShader::compile", "Problematic .* shader source code")
def test_a_shader_that_the_driver_refuses_is_named(view: Picture, monkeypatch: pytest.MonkeyPatch) -> None:
    from rvsim.gui.renderers import opengl_shaders

    monkeypatch.setattr(opengl_shaders, "BODY_VERTEX", "this is no shader")
    view.renderer.widget().makeCurrent()  # type: ignore[attr-defined]
    with pytest.raises(opengl_shaders.ShaderError, match="refuses the shader 'body'"):
        opengl_shaders.body_program()


def test_the_system_is_described_as_it_is(view: Picture) -> None:
    import OpenGL

    probe = probe_opengl()
    assert probe.current
    assert probe.version >= (2, 1)
    assert probe.api in ("egl", "glx", "")
    assert probe.renderer in view.renderer.description
    assert OpenGL.ERROR_CHECKING is False
