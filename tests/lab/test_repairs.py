"""Repairs: each that is offered works when it is done, and none is offered where nothing is wrong."""

from __future__ import annotations

import numpy as np
import pytest

from rvsim import load_robot
from rvsim.experiment import Experiment, LineTask, TrajectoryTask
from rvsim.lab.repairs import Offer, path_of, repairs
from rvsim.lab.sentences import Units
from rvsim.motion import TOOL_DOWN, through_points, track, trajectory_of
from rvsim.motion.honesty import Report, check

LINE = LineTask(np.array((0.11, 0.0, 0.13)), np.array((0.23, 0.0, 0.333)))


def experiment_of(name: str, path: str = "line") -> Experiment:
    robot = load_robot(name)
    return Experiment(robot, robot.home, LINE, TrajectoryTask(path))


def report_of(kind: str, experiment: Experiment) -> Report:
    tracking = track(
        experiment.robot, path_of(kind, experiment), near=experiment.q, ignore_limits=experiment.ignore_limits
    )
    return check(tracking, trajectory_of(tracking, experiment.q))


def offers(kind: str, experiment: Experiment) -> dict[str, Offer]:
    found = repairs(kind, experiment, report_of(kind, experiment), Units())
    return {offer.name: offer for offer in found if offer is not None}


@pytest.mark.parametrize(
    ("name", "kind", "path", "names"),
    [
        ("rv-m1", "line", "line", {"free", "move", "ignore limits"}),
        ("ur5e", "trajectory", "ellipse", {"free", "move", "scale"}),
        ("rv-m1", "trajectory", "letter-raw", {"move and scale"}),
        ("ur5e", "trajectory", "ellipse-moved", {"branch"}),
        ("al5b", "trajectory", "star", set()),
    ],
)
def test_what_is_offered_works_when_it_is_done(name: str, kind: str, path: str, names: set[str]) -> None:
    experiment = experiment_of(name, path)
    found = offers(kind, experiment)
    assert set(found) == names
    for offer in found.values():
        assert offer.experiment is not None
        again = report_of(kind, offer.experiment)
        np.testing.assert_array_equal(again.tracking.q, offer.tracking.q)
        if offer.name != "free":
            assert again.tracking.complete
        else:
            assert again.tracking.reached_count > report_of(kind, experiment).tracking.reached_count


def test_another_branch_leaves_less_to_warn_of() -> None:
    experiment = experiment_of("ur5e", "ellipse-moved")
    offer = offers("trajectory", experiment)["branch"]
    assert offer.experiment is not None
    assert report_of("trajectory", experiment).severity == "bad"
    assert report_of("trajectory", offer.experiment).severity == "good"


def test_a_path_that_winds_the_waist_up_is_split_with_the_pen_up() -> None:
    robot = load_robot("ur5e")
    turn = np.linspace(0.0, 6.0 * np.pi, 400)
    points = np.stack([0.45 * np.cos(turn), 0.45 * np.sin(turn), 0.2 + 0.005 * turn], axis=1)
    tracking = track(robot, through_points(points, TOOL_DOWN))
    assert tracking.complete
    assert tracking.jumps
    report = check(tracking, None)
    (offer,) = [o for o in repairs("trajectory", experiment_of("ur5e"), report, Units()) if o and o.name == "split"]
    split = offer.tracking
    assert split.complete
    assert split.samples == tracking.samples + 2 * len(tracking.jumps)
    assert split.path.pen_up is not None
    assert split.path.pen_up[list(split.jumps)].all()
    assert int(split.path.pen_up.sum()) == 3 * len(tracking.jumps)
    drawn = split.path.points[~split.path.pen_up]
    assert drawn[:, 2].max() == pytest.approx(points[:, 2].max())
