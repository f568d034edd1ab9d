"""The four solvers keep their word: what they call solved is solved, and what is not has a reason and a residual."""

from __future__ import annotations

from dataclasses import replace
from itertools import count

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rvsim import load_robot, robot_names
from rvsim.errors import PoseError, SettingError, ShapeError, UnknownNameError
from rvsim.kinematics import forward_kinematics, solve_numeric
from rvsim.kinematics.numeric import SOLVERS, NumericResult, SolverOptions
from rvsim.robot import Robot
from rvsim.robot.arrays import FloatArray
from rvsim.spatial import pose_difference, rot_x, transform, translation

ONE_TRY = SolverOptions(allow_random_restarts=False)
SHORT = SolverOptions(max_iterations=250)
# A slow machine must not change what is found.


def standing_clock() -> float:
    return 0.0


def random_joints(robot: Robot, count: int, seed: int = 3) -> FloatArray:
    """Within the limits; angles without limits within half a turn, lengths without limits within 3 m."""
    bound = np.where(robot.is_revolute, np.pi, 3.0)
    low, high = np.maximum(robot.limits[:, 0], -bound), np.minimum(robot.limits[:, 1], bound)
    return np.random.default_rng(seed).uniform(low, high, (count, robot.dof))


def check_word(robot: Robot, T: FloatArray, result: NumericResult, task: str = "pose") -> None:
    """The errors are those of its q, `converged` is what they say, and the history ends with it."""
    difference = pose_difference(forward_kinematics(robot, result.q), T)
    assert result.position_error == pytest.approx(float(difference.position), abs=1e-12)
    assert result.rotation_error == pytest.approx(float(difference.angle), abs=1e-12)
    small = result.position_error <= 1e-6 and (task == "position" or result.rotation_error <= 1e-6)
    assert result.converged == small == (result.kind == "solved")
    assert result.reason
    assert np.array_equal(result.history.q[-1], result.q)
    assert result.history.position_error[-1] == result.position_error
    assert result.history.rotation_error[-1] == result.rotation_error


def never_left_limits(robot: Robot, result: NumericResult) -> bool:
    iterates = result.history.q
    return bool(np.all((iterates >= robot.limits[:, 0]) & (iterates <= robot.limits[:, 1])))


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("name", robot_names())
def test_every_solver_reaches_random_poses_of_every_arm_inside_its_limits(name: str, solver: str) -> None:
    robot = load_robot(name)
    for task in ("pose", "position"):
        for T in forward_kinematics(robot, random_joints(robot, 4)):
            result = solve_numeric(robot, T, robot.home, solver, task=task, clock=standing_clock)
            assert result.converged, result.reason
            check_word(robot, T, result, task)
            assert never_left_limits(robot, result)


@given(seed=st.integers(0, 10_000), name=st.sampled_from(robot_names()), solver=st.sampled_from(SOLVERS))
@settings(max_examples=40)
def test_a_start_that_is_the_solution_needs_no_iteration(seed: int, name: str, solver: str) -> None:
    robot = load_robot(name)
    q = random_joints(robot, 1, seed)[0]
    result = solve_numeric(robot, forward_kinematics(robot, q), q, solver)
    assert result.converged
    assert result.iterations == 0
    assert np.array_equal(result.q, q)


SINGULAR = {
    "rv-m1": [0.3, 0.4, 0.0, 0.2, 0.1],  # elbow straight, at its stop
    "rv-1a": [0.2, 1.5, 0.3, 0.4, 0.0, 0.3],  # wrist
    "ur5e": [0.3, -0.7, 0.0, 0.5, 0.8, 0.1],  # elbow
    "al5b": [0.3, 0.8, 0.0, 0.2, 0.1],
    "scara": [0.3, 0.0, 0.1, 0.2],
}


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("name", SINGULAR)
def test_singular_poses_are_reached_too(name: str, solver: str) -> None:
    robot = load_robot(name)
    T = forward_kinematics(robot, SINGULAR[name])
    result = solve_numeric(robot, T, robot.home, solver, clock=standing_clock)
    assert result.converged, result.reason
    check_word(robot, T, result)


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_place_out_of_reach_ends_as_near_as_the_arm_can_come_with_a_reason(solver: str) -> None:
    robot = load_robot("rv-m1")
    # The arm reaches 0.482 m from its shoulder, here in a direction within the limits.
    shoulder, direction = np.array([0.0, 0.0, 0.152]), np.array([0.6, 0.48, 0.64])
    T = translation(shoulder + 0.8 * direction)
    result = solve_numeric(robot, T, robot.home, solver, task="position", options=SHORT, clock=standing_clock)
    assert not result.converged
    assert result.restarts > 0
    assert "restart" in result.reason
    assert result.position_error == pytest.approx(0.8 - 0.482, abs=5e-4)
    check_word(robot, T, result, "position")


@pytest.mark.parametrize("solver", SOLVERS)
def test_an_orientation_a_five_axis_arm_cannot_take_is_not_called_solved(solver: str) -> None:
    robot = load_robot("rv-m1")
    T = forward_kinematics(robot, [0.3, 0.5, -1.0, 0.2, 0.1]) @ transform(rot_x(0.3), np.zeros(3))
    result = solve_numeric(robot, T, robot.home, solver, options=SHORT, clock=standing_clock)
    assert not result.converged
    assert 1e-3 < result.position_error + result.rotation_error < 0.31
    check_word(robot, T, result)


@pytest.mark.parametrize("solver", SOLVERS)
def test_limits_hold_at_every_iterate_even_from_a_start_outside(solver: str) -> None:
    robot = load_robot("rv-m1")
    T = forward_kinematics(robot, [2.5, 1.7, -0.1, -1.5, 3.1])
    result = solve_numeric(robot, T, [9.0, -3.0, 2.0, 5.0, -7.0], solver, options=ONE_TRY)
    assert never_left_limits(robot, result)
    assert len(result.history.q) > 2


def test_without_limits_a_pose_outside_them_is_reached() -> None:
    robot, free = load_robot("rv-m1"), SolverOptions(enforce_joint_limits=False)
    T = forward_kinematics(robot, [3.0, 0.2, -0.5, 0.1, 0.4])
    assert solve_numeric(robot, T, options=free).converged
    assert not solve_numeric(robot, T, options=SHORT).converged


def test_a_joint_with_a_full_turn_of_room_passes_its_stop() -> None:
    robot = load_robot("rv-m1")
    T = forward_kinematics(robot, [0.3, 0.5, -1.0, 0.2, -3.0])
    result = solve_numeric(robot, T, [0.3, 0.5, -1.0, 0.2, 3.0], options=ONE_TRY)
    assert result.converged
    assert result.iterations < 10
    assert result.q[4] == pytest.approx(-3.0, abs=1e-5)


@pytest.mark.parametrize("solver", SOLVERS)
def test_the_seed_decides_the_restarts(solver: str) -> None:
    robot = load_robot("rrrp")
    T = forward_kinematics(robot, random_joints(robot, 6)[5])  # from home all of them first end at a stop
    first, again, other = (
        solve_numeric(robot, T, None, solver, options=replace(SHORT, seed=seed), clock=standing_clock)
        for seed in (1, 1, 2)
    )
    assert np.array_equal(first.q, again.q)
    assert np.array_equal(first.history.q, again.history.q)
    assert first.restarts
    assert not np.array_equal(first.q, other.q)


# Each rule that ends a try, with settings that bring it about for a pose out of reach.
RULES = {
    "iterations": replace(ONE_TRY, max_iterations=3),
    "gradient": replace(ONE_TRY, gradient_tolerance=1e9),
    "step": replace(ONE_TRY, step_tolerance=10.0),
    "change": replace(ONE_TRY, error_change_tolerance=10.0),
    "progress": replace(ONE_TRY, patience=2, gradient_tolerance=1e-300, error_change_tolerance=1e-300),
    "time": replace(ONE_TRY, max_time=5e-6),
}


@pytest.mark.parametrize("kind", RULES)
def test_each_rule_ends_a_try_and_says_so(kind: str) -> None:
    robot = load_robot("ur5e")
    T = translation([3.0, 0.0, 0.0])
    result = solve_numeric(
        robot, T, [0.1, -1.0, 1.0, 0.2, 0.3, 0.4], "lm", options=RULES[kind], clock=count(step=1e-6).__next__
    )
    assert result.kind == kind
    assert not result.converged
    assert result.restarts == 0
    check_word(robot, T, result)


def test_iterations_and_time_are_counted_over_all_tries() -> None:
    robot = load_robot("rv-m1")
    T = translation([2.0, 0.0, 0.0])
    result = solve_numeric(robot, T, options=replace(SHORT, max_iterations=123), clock=count(step=0.001).__next__)
    assert (result.kind, result.iterations) == ("iterations", 123)
    assert result.elapsed > 0.123
    late = solve_numeric(robot, T, options=replace(SHORT, max_time=0.05), clock=count(step=0.001).__next__)
    assert late.kind == "time"
    assert late.iterations <= 50


def test_lm_without_damping_is_newton() -> None:
    robot = load_robot("ur5e")
    T = forward_kinematics(robot, random_joints(robot, 1)[0])
    undamped = solve_numeric(robot, T, None, "lm", options=replace(ONE_TRY, use_error_damping=False))
    newton = solve_numeric(robot, T, None, "newton", options=ONE_TRY)
    assert np.array_equal(undamped.history.q, newton.history.q)
    assert not undamped.history.damping.any()


def test_the_history_tells_the_damping_of_each_step() -> None:
    robot = load_robot("ur5e")
    T = forward_kinematics(robot, random_joints(robot, 1)[0])
    dls = solve_numeric(robot, T, None, "dls", options=replace(ONE_TRY, damping=0.1)).history
    lm = solve_numeric(robot, T, None, "lm", options=ONE_TRY).history
    assert np.allclose(dls.damping[1:3], 0.1**2)
    assert dls.damping[-1] < 1e-5
    assert lm.damping[0] == 0.0
    assert lm.damping[1] > 1e-3 > lm.damping[-1] > 0.0


def test_a_rotation_typed_with_few_digits_is_mended() -> None:
    robot = load_robot("ur5e")
    printed = transform(np.array([[-0.5, -0.866, 0.0], [0.866, -0.5, 0.0], [0.0, 0.0, 1.0]]), [0.435, 0.1, 0.3])
    assert solve_numeric(robot, printed).converged


def test_what_makes_no_sense_is_refused_with_its_name() -> None:
    robot = load_robot("ur5e")
    T = forward_kinematics(robot, robot.home)
    with pytest.raises(UnknownNameError, match="newton"):
        solve_numeric(robot, T, solver="newtn")
    with pytest.raises(UnknownNameError, match="position"):
        solve_numeric(robot, T, task="place")
    with pytest.raises(ShapeError, match="q0"):
        solve_numeric(robot, T, np.zeros((2, 6)))
    with pytest.raises(ShapeError):
        solve_numeric(robot, T[None])
    with pytest.raises(SettingError, match="finite"):
        solve_numeric(robot, T, np.full(6, np.nan))
    with pytest.raises(PoseError):
        solve_numeric(robot, -T)
    with pytest.raises(SettingError, match="max_iterations"):
        SolverOptions(max_iterations=0)
    with pytest.raises(SettingError, match="weights"):
        SolverOptions(weights=(1.0, 1.0, 1.0, 1.0, 1.0, -1.0))
    for setting in ({"damping": 1e308}, {"damping_bias": np.inf}, {"length": 1e-320}, {"weights": (1e308,) * 6}):
        with pytest.raises(SettingError, match=next(iter(setting))):
            SolverOptions(**setting)  # type: ignore[arg-type]
    with pytest.raises(SettingError, match="seed"):
        SolverOptions(seed=-1)


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_search_in_which_nothing_weighs_comes_to_an_end(solver: str) -> None:
    robot = load_robot("rv-m1")
    target = forward_kinematics(robot, robot.home)
    result = solve_numeric(
        robot, target, robot.home - 0.1, solver, options=SolverOptions(weights=(0.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    )
    assert result.kind == "iterations"
    assert not result.converged
