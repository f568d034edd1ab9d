"""The experiments of the sources: none is missing, each has its numbers, and each setup is a state of its arm."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest

from rvsim.experiment import limit_violations
from rvsim.files import load_robot
from rvsim.lab.lines import default_experiment
from rvsim.lab.sources import errata
from rvsim.lab.sources.experiment import SourceExperiment
from rvsim.lab.sources.experiments import SOURCE_TITLES, experiment_of, experiments, keys_in_order
from rvsim.lab.sources.reproduce import reproduce, reproduce_by_key, reproduction_parts

ALL = experiments()


def test_every_program_and_every_erratum_is_an_experiment_once() -> None:
    assert {f"Program {number}" for number in range(1, 17)} <= {e.item for e in ALL if e.source == "000"}
    keys = Counter(key for experiment in ALL for key in experiment.keys)
    assert set(keys.values()) == {1}
    assert {entry.key for entry in errata()} <= set(keys)
    assert all(entry.source == experiment_of(entry.key).source for entry in errata())


def test_experiments_come_source_by_source_with_words() -> None:
    assert list(dict.fromkeys(e.source for e in ALL)) == list(SOURCE_TITLES)
    for experiment in ALL:
        assert experiment.key.startswith(experiment.source)
        assert experiment.title
        assert experiment.shows.endswith(".")


def test_every_experiment_has_its_numbers_in_order() -> None:
    rows = reproduce_by_key()
    assert {experiment_of(row.key) for row in rows} == set(ALL)
    places = [keys_in_order().index(row.key) for row in rows]
    assert places == sorted(places)
    assert all(experiment_of(key).source == row.source for key, row in rows)
    assert str(reproduce()) == str(tuple(row for _, row in rows))  # NaN is not itself


def test_the_work_tells_how_far_it_is_and_can_be_given_up() -> None:
    parts = reproduction_parts()
    first, second = next(parts), next(parts)  # and no more is asked for
    assert 0.0 < first < second < 1.0


@pytest.mark.parametrize("experiment", ALL, ids=lambda experiment: experiment.key)
def test_a_setup_leads_to_a_pose_that_the_arm_may_take(experiment: SourceExperiment) -> None:
    robot = load_robot(experiment.robot)
    state = experiment.setup.applied(default_experiment(robot))
    pose = robot.home if experiment.setup.pose is None else experiment.setup.pose
    np.testing.assert_array_equal(state.q, pose)
    assert state.ignore_limits or not limit_violations(robot, state.q)
    assert experiment.setup.erratum in ("", *(entry.key for entry in errata(robot)))
