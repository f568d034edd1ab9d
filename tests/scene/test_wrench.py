"""The wrench's arrows: as long as the force is large, and back again; taken hold of at the tip alone."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim.scene.camera import Camera
from rvsim.scene.palette import LIGHT
from rvsim.scene.primitives import Labels
from rvsim.scene.wrench import WrenchArrows, arrow_scale, met_in_view_plane, tip_is_under, wrench_items

VIEW = (800.0, 600.0)


def arrows(force=(10.0, 0.0, 5.0), moment=(0.0, 0.0, 0.0)) -> WrenchArrows:
    return WrenchArrows(np.array([0.4, 0.1, 0.3]), np.array(force), np.array(moment), 0.01, 0.6, "11.2 N", "1 N m")


@pytest.mark.parametrize("force", [0.03, 1.0, 2.0, 2.0001, 7.0, 99.0, 1234.0])
def test_the_longest_arrow_is_a_round_force_and_never_less_than_a_third_is_used(force):
    length = arrow_scale(1.0, force) * force
    assert 0.4 / 3 < length / 0.42 * 0.4 <= 0.4 * (1 + 1e-9)
    whole = 0.42 / arrow_scale(1.0, force)
    assert f"{whole:e}"[0] in "125"


def test_the_force_of_a_tip_is_the_force_that_put_it_there():
    pulled = arrows()
    np.testing.assert_allclose(pulled.force_at(pulled.tip), pulled.force, atol=1e-12)


def test_what_is_zero_is_not_drawn_but_can_be_pulled():
    nothing = wrench_items(arrows(force=(0.0, 0.0, 0.0)), LIGHT)
    assert [item.key.rsplit(".")[-1] for item in nothing] == ["knob"]
    both = wrench_items(arrows(moment=(0.0, 0.0, 2.0)), LIGHT)
    assert len({item.key for item in both}) == len(both)
    texts = [label.text for item in both if isinstance(item, Labels) for label in item.labels]
    assert texts == ["11.2 N", "1 N m"]


@pytest.mark.parametrize("orthographic", [False, True])
def test_the_tip_is_found_under_the_pointer_and_follows_it(orthographic):
    camera = Camera(np.zeros(3), 3.0, orthographic=orthographic)
    pulled = arrows()
    x, y, _ = camera.project(pulled.tip[None], *VIEW)[0]
    assert tip_is_under(pulled, camera, (x + 5.0, y), VIEW)
    assert not tip_is_under(pulled, camera, (x + 40.0, y), VIEW)
    met = met_in_view_plane(pulled.tip, camera, camera.ray(x + 30.0, y - 20.0, *VIEW))
    assert met is not None
    np.testing.assert_allclose(camera.project(met[None], *VIEW)[0][:2], [x + 30.0, y - 20.0], atol=1e-6)
    assert abs((met - pulled.tip) @ camera.axes[2]) < 1e-9
