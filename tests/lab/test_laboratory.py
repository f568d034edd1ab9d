"""The laboratory is fair: one start, one target, one set of rules, and verdicts that the arm itself confirms."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rvsim import forward_kinematics, load_robot, robot_names
from rvsim.experiment import random_pose
from rvsim.kinematics.numeric import AS_IN_SOURCE_002, SOLVERS
from rvsim.lab.laboratory import (
    PRESETS,
    Contest,
    Trial,
    contest_sentence,
    run_contest,
    same_solutions,
    source_002_sentence,
    target_of,
    verdict,
)
from rvsim.lab.sentences import Units
from rvsim.lab.source_002 import compare_source_002
from rvsim.spatial import pose_difference


def trial_of(name: str, seed: int = 6) -> Trial:
    robot = load_robot(name)
    return Trial(robot, target_of(robot, random_pose(robot, seed)), robot.home)


def contest_of(trial: Trial) -> Contest:
    contest = run_contest(trial)
    assert contest is not None
    return contest


@pytest.mark.parametrize("name", robot_names())
def test_all_solvers_begin_at_the_same_start_and_those_that_converge_are_there(name: str) -> None:
    trial = trial_of(name)
    contest = contest_of(trial)
    assert tuple(outcome.solver for outcome in contest.outcomes) == SOLVERS
    assert contest.converged
    for _, result in contest.outcomes:
        assert np.array_equal(result.history.q[0], trial.q0)
    for _, result in contest.converged:
        place, turn = pose_difference(forward_kinematics(trial.robot, result.q), trial.T)
        assert place <= trial.options.position_tolerance
        assert turn <= trial.options.rotation_tolerance


@pytest.mark.parametrize("preset", PRESETS, ids=lambda preset: preset.title)
def test_every_preset_leads_somewhere(preset) -> None:
    contest = contest_of(replace(trial_of("ur5e"), task=preset.task, options=preset.options))
    assert contest.converged


def test_the_best_needs_the_fewest_iterations() -> None:
    contest = contest_of(trial_of("ur5e"))
    assert contest.best.result.iterations == min(outcome.result.iterations for outcome in contest.converged)
    assert contest_sentence(contest).startswith("All 4 reach the target. Damped least squares needs the fewest")


def test_solvers_that_need_equally_few_are_named_together() -> None:
    sentence = contest_sentence(contest_of(trial_of("cartesian")))
    assert "Newton and BFGS need the fewest iterations (1). They end in the same pose of the arm." in sentence


def test_out_of_reach_each_solver_says_why_it_ended_and_what_is_left() -> None:
    trial = trial_of("rv-m1")
    away = trial.T.copy()
    away[:3, 3] *= 3.0
    contest = contest_of(replace(trial, T=away))
    assert not contest.converged
    assert contest_sentence(contest).startswith("None of the 4 reaches the target. Nearest: ")
    for outcome in contest.outcomes:
        sentence = verdict(trial, outcome)
        assert outcome.result.reason in sentence
        assert " mm and " in sentence


def test_solutions_whole_turns_apart_are_the_same() -> None:
    contest = contest_of(trial_of("ur5e"))
    turned = [
        outcome._replace(result=replace(outcome.result, q=contest.best.result.q + 2.0 * np.pi * index))
        for index, outcome in enumerate(contest.outcomes)
    ]
    assert len(same_solutions(replace(contest, outcomes=tuple(turned)))) == 1


def test_a_solution_outside_the_limits_is_said_to_be_so() -> None:
    trial = trial_of("rv-m1")
    unlimited = replace(
        trial, options=AS_IN_SOURCE_002.options, task="position", T=target_of(trial.robot, np.full(5, 2.0))
    )
    contest = contest_of(unlimited)
    assert any("Outside the limits: " in verdict(unlimited, outcome) for outcome in contest.outcomes)


def test_nothing_is_said_in_degrees_or_millimetres_where_radians_and_metres_are_preferred() -> None:
    trial = trial_of("rv-m1")
    away = trial.T.copy()
    away[:3, 3] *= 3.0
    free = replace(trial.options, enforce_joint_limits=False)
    contest, units = contest_of(replace(trial, T=away, options=free)), Units("rad", "m")
    said = [contest_sentence(contest, units), *(verdict(contest.trial, o, units) for o in contest.outcomes)]
    said.append(source_002_sentence(compare_source_002(load_robot("ur5e")), units))
    assert all(" m " in sentence for sentence in said)
    assert any(" rad" in sentence for sentence in said)
    assert not any("°" in sentence or " mm" in sentence for sentence in said)
    assert "0.431 m RMS" in said[-1]


def test_restarts_are_told_and_counted() -> None:
    trial = trial_of("rv-m1", seed=5)
    alone = contest_of(trial)
    helped = contest_of(replace(trial, options=replace(trial.options, allow_random_restarts=True)))
    assert [o.solver for o in alone.outcomes if not o.result.converged] == ["bfgs"]
    assert len(helped.converged) == len(SOLVERS)
    assert "random restart" in verdict(trial, helped.outcomes[-1])


def test_a_cancelled_contest_ends_early_and_has_no_outcome() -> None:
    trial = trial_of("ur5e")
    endless = replace(trial.options, max_iterations=10**9, max_time=1e6, allow_random_restarts=True)
    away = trial.T.copy()
    away[:3, 3] *= 5.0
    asked: list[bool] = []

    def after_some_iterations() -> bool:
        asked.append(True)
        return len(asked) > 20

    assert run_contest(replace(trial, T=away, options=endless), after_some_iterations) is None
    assert len(asked) < 100
