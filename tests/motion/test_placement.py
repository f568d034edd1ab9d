"""The nearest place for a path: all of it is reached there, nearer it is not, and no hope is no answer."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from rvsim import load_robot
from rvsim.lab import named_path
from rvsim.motion import Path, line_path, track
from rvsim.motion.placement import SCALES, Place, largest_in_place, nearest_place
from rvsim.robot import Robot


def answer(search: Iterator[Place | None]) -> Place | None:
    found = [place for place in search if place is not None]
    return found[-1] if found else None


def source_line() -> Path:
    return line_path((0.11, 0.0, 0.13), (0.23, 0.0, 0.333), 11)


CASES = [("ur5e", named_path("ellipse", load_robot("ur5e"))), ("rv-m1", source_line())]


@pytest.mark.parametrize(("name", "path"), CASES)
def test_moved_there_all_of_it_is_reached_and_half_way_there_it_is_not(name: str, path: Path) -> None:
    robot: Robot = load_robot(name)
    place = answer(nearest_place(robot, path))
    assert place is not None
    shift = place.center - path.middle
    again = track(robot, path.moved(shift))
    assert again.complete
    assert not again.jumps
    assert place.scale == 1.0
    assert not track(robot, path.moved(0.5 * shift)).complete


def test_what_is_reached_already_stays() -> None:
    robot = load_robot("ur5e")
    path = named_path("ellipse-moved", robot)
    place = answer(nearest_place(robot, path))
    assert place is not None
    np.testing.assert_allclose(place.center, path.middle, atol=1e-12)


def test_it_never_sinks_into_the_table() -> None:
    place = answer(nearest_place(load_robot("rv-m1"), source_line()))
    assert place is not None
    assert place.tracking.path.points[:, 2].min() >= -1e-9


def test_what_is_too_large_fits_only_when_it_is_scaled() -> None:
    robot = load_robot("rv-m1")
    letter = named_path("letter-raw", robot)
    assert answer(nearest_place(robot, letter)) is None
    assert answer(largest_in_place(robot, letter)) is None
    small = answer(nearest_place(robot, letter, scale=0.03))
    assert small is not None
    assert np.ptp(small.tracking.path.points, axis=0) == pytest.approx(0.03 * np.ptp(letter.points, axis=0))


def test_in_place_it_takes_the_largest_scale_that_fits() -> None:
    robot = load_robot("ur5e")
    path = named_path("ellipse", robot)
    place = answer(largest_in_place(robot, path))
    assert place is not None
    larger = [scale for scale in SCALES if scale > place.scale]
    assert not any(track(robot, path.placed(path.middle, None, scale)).complete for scale in larger)
