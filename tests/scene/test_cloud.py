"""The workspace in the scene: few items, colours that tell more from less, outlines where the section lies."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim.files import load_robot
from rvsim.kinematics.workspace import WorkspaceTask, workspace
from rvsim.scene.cloud import CLASSES, cloud_items, merged_pieces, scale_color, section_items
from rvsim.scene.palette import DARK, LIGHT, contrast, luminance


@pytest.mark.parametrize(("palette", "dark"), [(LIGHT, False), (DARK, True)])
def test_more_is_lighter_and_no_colour_is_lost_on_the_ground(palette, dark) -> None:
    colors = [scale_color(share, dark=dark) for share in np.linspace(0.0, 1.0, 30)]
    assert (np.diff([luminance(color) for color in colors]) > 0.0).all()
    assert min(contrast(color, palette.background) for color in colors) > 1.25


def test_a_cloud_is_a_few_items_of_the_dots_of_one_colour() -> None:
    points = np.random.default_rng(0).normal(size=(9000, 3))
    shares = np.linspace(0.0, 1.0, 9000)
    items = cloud_items(points, shares, LIGHT, most=3000)
    assert len(items) == CLASSES
    assert len({item.key for item in items}) == len({item.color for item in items}) == CLASSES
    assert sum(len(item.points) for item in items) == 3000
    known = {tuple(point) for point in points}
    assert all(tuple(point) in known for item in items for point in item.points)


def test_an_empty_cloud_draws_nothing() -> None:
    assert cloud_items(np.empty((0, 3)), np.empty(0), LIGHT) == ()


def test_outlines_lie_in_their_sections() -> None:
    robot = load_robot("articulated")
    result = workspace(WorkspaceTask(robot, robot.home, poses=10_000))
    (side,) = section_items(result.side, LIGHT, key="side")
    (top,) = section_items(result.top, LIGHT, key="top")
    assert side.points[:, 1] == pytest.approx(0.0)  # its plane at home is that of x and z
    assert top.points[:, 2] == pytest.approx(result.top.origin[2])
    assert side.key != top.key


def test_pieces_that_follow_each_other_become_one() -> None:
    line = np.column_stack([np.arange(11.0), np.zeros(11)])
    pieces = np.stack([line[:-1], line[1:]], axis=1)
    apart = np.array([[[50.0, 1.0], [51.0, 1.0]]])
    merged = merged_pieces(np.concatenate([pieces, apart]), most=4)
    assert merged[..., 0].tolist() == [
        [0, 4],
        [4, 8],
        [8, 10],
        [50, 51],
    ]
