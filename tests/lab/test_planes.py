"""Planes: named ones are what they are called wherever the shape lies; a normal and three points give the only one."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from rvsim import load_robot, robot_names
from rvsim.errors import UnknownNameError
from rvsim.experiment import Placement, TrajectoryTask
from rvsim.lab import named_path
from rvsim.lab.planes import PLANES, laid, plane_name, three_points, through_three, with_normal
from rvsim.lab.shape_paths import FLAT_SHAPES, in_plane, placement_of, task_path
from rvsim.motion import track
from rvsim.spatial import rot_z, rotation_from_rpy

places = st.tuples(*[st.floats(-2.0, 2.0)] * 3).map(np.array)
WHERE = Placement((0.3, 0.1, 0.2), (0.1, 0.2, 0.3), 1.5)


def rotation_of(where: Placement) -> np.ndarray:
    return rotation_from_rpy(where.rpy)


@given(places, st.sampled_from(sorted(PLANES)), st.floats(-3.0, 3.0))
def test_a_named_plane_is_known_again_and_stands_as_it_is_called(
    center: np.ndarray, name: str, level_yaw: float
) -> None:
    assume(np.hypot(*center[:2]) > 1e-3)
    where = laid(Placement(center, (0.4, -0.3, 0.9), 2.0), name, level_yaw)
    x, y, z = rotation_of(where).T
    assert plane_name(center, rotation_of(where)) == name
    assert (where.scale, where.center.tolist()) == (2.0, center.tolist())
    away, up = np.append(center[:2], 0.0) / np.hypot(*center[:2]), np.array([0.0, 0.0, 1.0])
    expected = {"level": up, "facing": -away, "sideways": np.cross(away, up)}[name]
    np.testing.assert_allclose(z, expected, atol=1e-9)
    if name != "level":
        np.testing.assert_allclose(y, up, atol=1e-9)  # letters stand upright
    if name == "sideways":
        np.testing.assert_allclose(x, away, atol=1e-9)


@pytest.mark.parametrize(("turn", "name"), [(40.0, "facing"), (50.0, "sideways"), (130.0, "sideways"), (140.0, None)])
def test_an_upright_plane_is_called_by_what_it_is_nearest_to(turn: float, name: str | None) -> None:
    facing = rotation_of(laid(WHERE, "facing"))
    for way in (turn, -turn):
        assert plane_name(WHERE.center, rot_z(np.radians(way)) @ facing) == name
    assert plane_name(WHERE.center, rotation_from_rpy((1e-3, 0.0, 0.0))) is None


@given(places)
def test_a_normal_of_any_length_gives_its_plane_and_none_gives_none(normal: np.ndarray) -> None:
    assume(np.linalg.norm(normal) > 1e-3)
    found = with_normal(WHERE, normal)
    assert found is not None
    np.testing.assert_allclose(rotation_of(found)[:, 2], normal / np.linalg.norm(normal), atol=1e-8)
    assert rotation_of(found)[2, 1] >= -1e-9
    assert with_normal(WHERE, np.zeros(3)) is None


@given(places, places, places)
def test_three_points_lie_in_the_plane_through_them(first: np.ndarray, second: np.ndarray, third: np.ndarray) -> None:
    sides = np.cross(second - first, third - first)
    assume(np.linalg.norm(sides) > 1e-2)
    points = np.stack([first, second, third])
    found = through_three(WHERE, points)
    assert found is not None
    local = (points - found.center) @ rotation_of(found)
    np.testing.assert_allclose(local[:, 2], 0.0, atol=1e-8)
    np.testing.assert_allclose(local.mean(axis=0), 0.0, atol=1e-8)
    assert local[1, 0] > local[0, 0]
    assert local[1, 1] == pytest.approx(local[0, 1], abs=1e-8)
    assert local[2, 1] > local[0, 1]
    assert through_three(WHERE, [first, second, first + 0.3 * (second - first)]) is None


def test_the_points_that_are_offered_give_the_plane_they_were_made_of() -> None:
    again = through_three(WHERE, three_points(WHERE, rotation_of(WHERE), 0.1))
    assert again is not None
    np.testing.assert_allclose(again.center, WHERE.center, atol=1e-12)
    np.testing.assert_allclose(again.rpy, WHERE.rpy, atol=1e-12)


@pytest.mark.parametrize("arm", robot_names())
def test_a_star_in_any_named_plane_is_flat_and_most_arms_draw_it_at_the_first_go(arm: str) -> None:
    robot = load_robot(arm)
    for name in PLANES:
        task = in_plane(robot, TrajectoryTask("star"), name)
        path, where = task_path(robot, task), placement_of(robot, task)
        assert plane_name(where.center, rotation_of(where)) == name
        np.testing.assert_allclose((path.points - where.center) @ rotation_of(where)[:, 2], 0.0, atol=1e-12)
        if (arm, name) not in (("planar", "facing"), ("planar", "sideways"), ("spherical", "sideways")):
            assert track(robot, path).complete


def test_letters_on_a_table_are_read_by_somebody_who_faces_the_arm() -> None:
    robot = load_robot("ur5e")
    task = in_plane(robot, in_plane(robot, TrajectoryTask("text"), "facing"), "level")
    np.testing.assert_allclose(placement_of(robot, task).rpy, placement_of(robot, TrajectoryTask("text")).rpy)


def test_a_path_by_its_name_takes_a_plane_and_says_which_there_are() -> None:
    robot = load_robot("rv-m1")
    upright = named_path("star", robot, plane="facing", samples=51)
    assert upright.samples == 51
    np.testing.assert_allclose(upright.points[:, 0], 0.3)
    with pytest.raises(UnknownNameError, match="Did you mean 'facing'"):
        named_path("star", robot, plane="facin")
    with pytest.raises(UnknownNameError, match="No flat shape 'line'") as caught:
        named_path("line", robot, plane="level")
    assert caught.value.known == FLAT_SHAPES
