"""What is under the pointer."""

from __future__ import annotations

import numpy as np

from rvsim.files import load_robot
from rvsim.kinematics import link_transforms
from rvsim.scene import Camera
from rvsim.scene.build import SceneOptions, compose
from rvsim.scene.camera_moves import framed
from rvsim.scene.palette import LIGHT
from rvsim.scene.picking import point_under

SIZE = (800.0, 600.0)
ROBOT = load_robot("rv-m1")
SCENE = compose(ROBOT, ROBOT.home, LIGHT, SceneOptions(look="stick"))
CAMERA = framed(Camera(np.zeros(3), 1.0), SCENE.bounds, *SIZE)


def test_every_frame_origin_is_found_at_its_pixel() -> None:
    for origin in link_transforms(ROBOT, ROBOT.home)[:, :3, 3]:
        x, y, _ = CAMERA.project(origin, *SIZE)
        found = point_under(SCENE, CAMERA, x, y, *SIZE)
        assert found is not None
        np.testing.assert_allclose(found, origin, atol=1e-9)


def test_beside_the_arm_the_floor_is_found_and_beyond_it_nothing() -> None:
    place = np.array([-0.3, -0.3, 0.0])
    x, y, _ = CAMERA.project(place, *SIZE)
    found = point_under(SCENE, CAMERA, x, y, *SIZE)
    assert found is not None
    np.testing.assert_allclose(found, place, atol=1e-9)
    assert point_under(SCENE, CAMERA, 400.0, 5.0, *SIZE) is None
