"""What the painter paints, pixel by pixel, off-screen."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtGui import QImage
from pytestqt.qtbot import QtBot

from rvsim.files import load_robot
from rvsim.gui.renderers.painter import PainterRenderer, scene_image
from rvsim.kinematics import link_transforms
from rvsim.scene import Box, Camera, Capsule, Color, Dots, Item, Label, Labels, Polyline, Scene, Segments, Triads
from rvsim.scene.build import LOOKS, Look, SceneOptions, arm_items, compose
from rvsim.scene.camera_moves import framed
from rvsim.scene.palette import DARK, LIGHT, ScenePalette

pytestmark = pytest.mark.usefixtures("qapp")

WIDTH, HEIGHT = 640, 480
RED, GREEN = Color(1.0, 0.0, 0.0), Color(0.0, 1.0, 0.0)
BOUNDS = np.array([[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]])
FRONT = Camera(np.zeros(3), 5.0).from_preset("front")  # the eye on +x: right is y, up is z
ROBOT = load_robot("rv-m1")
Q = np.radians([30.0, 40.0, -50.0, 20.0, 60.0])


def _pixels(image: QImage) -> np.ndarray:
    """(h, w, 3) red, green, blue."""
    plain = image.convertToFormat(QImage.Format.Format_RGBX8888)
    return np.frombuffer(plain.constBits(), np.uint8).reshape(image.height(), image.width(), 4)[..., :3].astype(int)


def _painted(*items: Item, camera: Camera = FRONT, ratio: float = 1.0) -> np.ndarray:
    scene = Scene(items, LIGHT.background, BOUNDS)
    return _pixels(scene_image(scene, camera, WIDTH, HEIGHT, ratio))


def _rgb(color: Color) -> np.ndarray:
    return np.rint(255.0 * np.array(color[:3]))


def _arm_scene(look: Look, palette: ScenePalette = LIGHT) -> tuple[Scene, Camera]:
    scene = compose(ROBOT, Q, palette, SceneOptions(look=look, labels=False))
    return scene, framed(Camera(np.zeros(3), 1.0), scene.bounds, WIDTH, HEIGHT)


def _ball(x: float, color: Color, radius: float = 0.3) -> Capsule:
    place = np.array([x, 0.0, 0.0])
    return Capsule(f"ball{x}", place, place, radius, color)


def test_an_empty_scene_is_background() -> None:
    assert (_painted() == _rgb(LIGHT.background)).all()


@pytest.mark.parametrize("palette", [LIGHT, DARK])
def test_the_corners_show_the_palettes_background(palette: ScenePalette) -> None:
    pixels = _pixels(scene_image(*_arm_scene("solid", palette), WIDTH, HEIGHT))
    for corner in (pixels[0, 0], pixels[0, -1]):
        assert (corner == _rgb(palette.background)).all()


def test_the_joints_are_where_they_should_be_in_their_colours() -> None:
    scene, camera = _arm_scene("stick")
    pixels = _pixels(scene_image(scene, camera, WIDTH, HEIGHT))
    places = camera.project(link_transforms(ROBOT, Q)[:3, :3, 3], WIDTH, HEIGHT)  # joints 1, 2, 3: nothing covers them
    for joint, (x, y, _) in zip(ROBOT.joints, places, strict=False):
        around = pixels[int(y) - 4 : int(y) + 5, int(x) - 4 : int(x) + 5].reshape(-1, 3)
        assert np.abs(around - _rgb(Color.from_hex(joint.color))).max(axis=1).min() <= 6


@pytest.mark.parametrize("look", LOOKS)
def test_an_arm_changes_the_picture_where_it_stands(look: Look) -> None:
    scene, camera = _arm_scene(look)
    floor = replace(scene, items=tuple(item for item in scene.items if item.key.startswith("floor")))
    with_arm, without = (_pixels(scene_image(one, camera, WIDTH, HEIGHT)) for one in (scene, floor))
    changed = np.abs(with_arm - without).max(axis=2) > 20
    assert 300 < changed.sum() < 0.3 * WIDTH * HEIGHT
    elbow = camera.project(link_transforms(ROBOT, Q)[2, :3, 3], WIDTH, HEIGHT)
    assert changed[int(elbow[1]), int(elbow[0])]


def test_a_ball_is_a_disc_of_its_projected_size() -> None:
    pixels = _painted(_ball(0.0, RED))
    red = pixels[..., 0] - pixels[..., 1] > 60
    radius_pixels = HEIGHT / 2 / np.tan(FRONT.field_of_view / 2) * 0.3 / np.sqrt(5.0**2 - 0.3**2)
    assert red.sum() == pytest.approx(np.pi * radius_pixels**2, rel=0.03)
    assert red[HEIGHT // 2, WIDTH // 2]


@pytest.mark.parametrize("orthographic", [False, True])
@pytest.mark.parametrize("swapped", [False, True])
def test_the_nearer_solid_hides_the_farther_one(orthographic: bool, swapped: bool) -> None:
    solids = [_ball(0.6, GREEN), _ball(-0.6, RED)]
    camera = replace(FRONT, orthographic=orthographic)
    red, green, _ = _painted(*(solids[::-1] if swapped else solids), camera=camera)[HEIGHT // 2, WIDTH // 2]
    assert green > 2 * red


def test_solids_that_reach_into_one_another_meet_where_they_should() -> None:
    # Two crossing boxes, each nearer than the other at one place: no order of whole shapes could show both.
    turn = np.radians(45.0)
    boxes = []
    for key, color, angle in (("a", RED, turn), ("b", GREEN, -turn)):
        T = np.eye(4)
        T[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
        boxes.append(Box(key, T, np.array([1.6, 0.1, 0.4]), color))
    row = _painted(*boxes)[HEIGHT // 2]
    right, left = row[WIDTH // 2 + 40], row[WIDTH // 2 - 40]
    assert right[0] > 2 * right[1]
    assert left[1] > 2 * left[0]


def test_a_line_behind_a_solid_is_hidden_and_one_before_it_is_seen() -> None:
    ends = np.array([[0.0, -1.0, 0.0], [0.0, 1.0, 0.0]])
    for x, color in ((-1.0, RED), (1.0, GREEN)):
        row = _painted(_ball(0.0, RED), Polyline("line", ends + np.array([x, 0.0, 0.0]), GREEN, 3.0))[HEIGHT // 2]
        assert np.argmax(row[WIDTH // 2]) == np.argmax(color[:3])
        assert (row[WIDTH // 2 + 60] == _rgb(GREEN)).all()


def test_of_two_paths_at_one_place_the_later_one_is_seen() -> None:
    line = np.array([[0.0, -0.5, 0.0], [0.0, 0.0, 0.0], [0.9, 0.5, 0.0]])
    desired, actual = Polyline("desired", line, RED, 2.0), Polyline("actual", line[:2], GREEN, 2.2)
    assert np.argmax(_painted(desired, actual)[HEIGHT // 2, WIDTH // 2 - 40]) == 1


@pytest.mark.parametrize("solids", [(), (_ball(-0.5, RED),)])
def test_a_line_of_many_points_looks_like_one_of_few(solids: tuple[Item, ...]) -> None:
    few, many = (np.linspace((0.5, -1.0, -0.5), (0.5, 1.0, 0.7), count) for count in (2, 6000))
    one, other = (_painted(*solids, Polyline("line", points, GREEN, 2.0)) for points in (few, many))
    assert np.abs(one - other).mean() < 0.1


def test_a_ghost_lets_the_background_through_by_its_alpha() -> None:
    opaque, ghost = (_painted(_ball(0.0, color))[HEIGHT // 2, WIDTH // 2] for color in (RED, RED.faded(0.3)))
    expected = 0.3 * opaque + 0.7 * _rgb(LIGHT.background)
    np.testing.assert_allclose(ghost, expected, atol=2.0)


def test_what_overlaps_inside_a_ghost_is_not_counted_twice() -> None:
    one, two = _ball(0.0, RED.faded(0.4)), replace(_ball(0.0, RED.faded(0.4)), key="again")
    assert (_painted(one) == _painted(one, two)).all()


def test_an_edge_is_smooth() -> None:
    green = _painted(_ball(0.0, RED))[..., 1]
    between = (green > 50) & (green < 240)  # neither ball nor background
    assert 150 < between.sum() < 600  # about one for each pixel of the rim


@pytest.mark.parametrize("orthographic", [False, True])
def test_what_is_behind_the_eye_or_no_number_does_no_harm(orthographic: bool) -> None:
    behind, nan = np.array([[9.0, 0.0, 0.0], [-9.0, 0.1, 0.1], [np.nan, 0.0, 0.0], [0.0, 1.0, 0.0]]), np.full(3, np.nan)
    T = np.eye(4)
    T[:3, 3] = (5.2, 0.0, 0.0)
    items: tuple[Item, ...] = (
        Box("floor.plate", np.eye(4), np.array([30.0, 30.0, 0.1]), GREEN),
        Polyline("line", behind, RED, 5.0),
        Polyline("dashes", behind[:2], RED, 2.0, dashed=True),
        Segments("pieces", behind, RED),
        Dots("dots", behind, RED),
        Capsule("through", behind[0], behind[1], 0.2, RED),
        Capsule("gone", np.array([9.0, 0.0, 0.0]), np.array([8.0, 0.0, 0.0]), 0.2, RED),
        Capsule("nowhere", nan, nan, 0.2, RED.faded(0.5)),
        Box("around", T, np.ones(3), RED),
        Triads("frames", np.stack([T, np.full((4, 4), np.nan)]), 1.0, letters=True),
        Labels("texts", tuple(Label(point, "text", RED) for point in (nan, behind[0], behind[1]))),
    )
    pixels = _painted(*items, camera=replace(FRONT, orthographic=orthographic))
    assert len(np.unique(pixels.reshape(-1, 3), axis=0)) > 10


@pytest.mark.parametrize("size", [(1, 1), (1, 300), (7, 2)])
def test_the_smallest_pictures_can_be_painted(size: tuple[int, int]) -> None:
    scene, camera = _arm_scene("both")
    image = scene_image(scene, camera, *size)
    assert (image.width(), image.height()) == size


def test_twice_the_pixels_show_the_same_picture() -> None:
    scene, camera = _arm_scene("solid")
    coarse, fine = (scene_image(scene, camera, WIDTH, HEIGHT, ratio) for ratio in (1.0, 2.0))
    assert (fine.width(), fine.height()) == (2 * WIDTH, 2 * HEIGHT)
    halved = _pixels(fine).reshape(HEIGHT, 2, WIDTH, 2, 3).mean(axis=(1, 3))
    assert np.abs(halved - _pixels(coarse)).mean() < 2.0


def test_the_widget_paints_once_for_many_changes_and_tells_how_long_it_took(qtbot: QtBot) -> None:
    view = PainterRenderer()
    qtbot.addWidget(view)
    view.resize(WIDTH, HEIGHT)
    scene, camera = _arm_scene("stick")
    view.set_camera(camera)
    times: list[float] = []
    view.on_painted(times.append)
    with qtbot.waitExposed(view):
        view.show()
    qtbot.waitUntil(lambda: len(times) > 0)
    times.clear()
    for _ in range(5):
        view.set_scene(replace(scene))
    qtbot.waitUntil(lambda: len(times) > 0)
    assert len(times) == 1
    assert (_pixels(view.image()) == _pixels(scene_image(scene, camera, WIDTH, HEIGHT))).all()


@pytest.mark.parametrize(("rest", "at_last_smooth"), [(60.0, False), (0.2, True)])
def test_edges_are_rough_in_motion_and_smooth_at_rest(qtbot: QtBot, rest: float, at_last_smooth: bool) -> None:
    scene, camera = _arm_scene("solid")
    view = PainterRenderer(rest=rest)
    qtbot.addWidget(view)
    view.resize(WIDTH, HEIGHT)
    view.set_camera(camera)
    smooth = _pixels(scene_image(scene, camera, WIDTH, HEIGHT))

    def rough_pixels() -> int:
        return int((np.abs(_pixels(view.grab().toImage()) - smooth).max(axis=2) > 8).sum())

    view.set_scene(scene)
    assert rough_pixels() == 0  # a first frame has the time
    view.set_scene(replace(scene))
    if at_last_smooth:
        qtbot.waitUntil(lambda: rough_pixels() == 0)
    else:
        assert 100 < rough_pixels() < 5000


def test_a_ghost_arm_stands_behind_the_arm() -> None:
    scene, camera = _arm_scene("solid")
    ghost = arm_items(ROBOT, Q, LIGHT, look="solid", key="ghost", alpha=0.3, labels=False)
    haunted = replace(scene, items=(*ghost, *scene.items))
    difference = np.abs(
        _pixels(scene_image(haunted, camera, WIDTH, HEIGHT)) - _pixels(scene_image(scene, camera, WIDTH, HEIGHT))
    )
    assert (difference.max(axis=2) > 8).sum() < 400  # only along the smooth edges


@pytest.mark.parametrize("far", [1e3, 1e6, 1e12])
@pytest.mark.parametrize("tilt", [0.0, 0.3])
def test_a_dashed_line_to_far_away_has_only_the_dashes_that_are_seen(far: float, tilt: float) -> None:
    ends = np.array([[0.0, -0.5, -0.5 * tilt], [0.0, 2e1, 2e1 * tilt]])
    near = _painted(Polyline("dashes", ends, RED, 2.0, dashed=True))
    away = ends[0] + far * (ends[1] - ends[0])
    distant = _painted(Polyline("dashes", np.array([ends[0], away]), RED, 2.0, dashed=True))
    red = [(image == _rgb(RED)).all(axis=2).sum() for image in (near, distant)]
    assert red[0] > 100
    assert red[1] == pytest.approx(red[0], rel=0.1)


def test_a_dashed_line_that_passes_far_beside_the_picture_is_not_there() -> None:
    beside = np.array([[0.0, -1e9, 1e3], [0.0, 1e9, 1e3]])
    assert (_painted(Polyline("dashes", beside, RED, 2.0, dashed=True)) == _rgb(LIGHT.background)).all()
