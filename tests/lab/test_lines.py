"""The lines that are offered: the first one of every arm can be drawn."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim import load_robot, robot_names
from rvsim.errors import NoClosedFormError
from rvsim.lab import default_experiment, line_of, line_presets, named_path
from rvsim.motion import track

ELEVEN = robot_names()


@pytest.mark.parametrize("name", ELEVEN)
def test_the_first_line_of_every_arm_is_drawn_whole_within_its_limits_and_from_home(name: str) -> None:
    robot = load_robot(name)
    experiment = default_experiment(robot)
    tracking = track(robot, line_of(robot, experiment.line), near=experiment.q)
    assert tracking.complete
    assert not tracking.jumps
    assert tracking.max_deviation is not None
    assert tracking.max_deviation < 1e-14 * max(robot.size, 1.0)


@pytest.mark.parametrize("name", ELEVEN)
def test_the_star_of_every_arm_is_drawn_whole(name: str) -> None:
    robot = load_robot(name)
    tracking = track(robot, named_path("star", robot))
    assert tracking.complete
    assert not tracking.jumps


def test_source_000s_own_line_is_a_preset_beside_it() -> None:
    within, source = line_presets(load_robot("rv-m1"))
    assert within.name == "within-limits"
    assert np.allclose([source.start, source.end], [[0.11, 0.0, 0.13], [0.23, 0.0, 0.333]])
    assert source.task().samples == 11


@pytest.mark.parametrize("name", ["rv-m1", "al5b", "ur5e", "rrrp", "scara", "articulated"])
def test_an_arm_of_ones_own_gets_a_line_that_it_can_draw(name: str) -> None:
    robot = load_robot(name).renamed("mine", "Mine")
    (preset,) = line_presets(robot)
    task = default_experiment(robot).line
    assert track(robot, line_of(robot, task)).complete
    assert np.linalg.norm(preset.end - preset.start) > 0.05 * robot.size


def test_the_line_of_an_experiment_is_the_line_path_of_its_ends() -> None:
    robot = load_robot("rv-m1")
    task = default_experiment(robot).line
    path = line_of(robot, task)
    wanted = named_path("line", robot, samples=task.samples, start=task.start, end=task.end)
    np.testing.assert_array_equal(path.points, wanted.points)
    np.testing.assert_array_equal(path.rotations, wanted.rotations)


def test_a_line_is_looked_for_once_an_arm(monkeypatch: pytest.MonkeyPatch) -> None:
    robot = load_robot("rv-m1").renamed("mine", "Mine")
    found = line_presets(robot)
    monkeypatch.setattr("rvsim.lab.lines.track", None)
    assert line_presets(robot) == found
    assert line_of(robot, found[0].task()).samples == found[0].task().samples


def test_an_arm_without_a_closed_form_still_has_an_experiment() -> None:
    skew = load_robot("rv-1a").renamed("mine", "Mine").with_joint(3, alpha=1.0)
    with pytest.raises(NoClosedFormError):
        track(skew, named_path("line", skew))
    line = default_experiment(skew).line
    assert np.array_equal(line.start, line.end)
