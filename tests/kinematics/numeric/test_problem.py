"""The cost's slope is its derivative, for any weights and lengths: BFGS and the gradient rule stand on it."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest

from rvsim import load_robot
from rvsim.kinematics import forward_kinematics
from rvsim.kinematics.numeric import AS_IN_SOURCE_000, SolverOptions, Task
from rvsim.kinematics.numeric.bounds import bounds_of, start_ranges
from rvsim.kinematics.numeric.normal_equations import normal_equations, solve_rows
from rvsim.kinematics.numeric.problem import Problem

UNEVEN = SolverOptions(weights=(0.3, 1.0, 2.5, 1.2, 0.7, 1.9), length=0.2)
SETTINGS = (SolverOptions(), UNEVEN, AS_IN_SOURCE_000.options)
TASKS: tuple[Task, ...] = ("pose", "position")


@pytest.mark.parametrize(("options", "task"), list(product(SETTINGS, TASKS)))
@pytest.mark.parametrize("name", ["ur5e", "rv-m1", "rrrp"])
def test_the_gradient_is_the_derivative_of_the_cost(name: str, options: SolverOptions, task: Task) -> None:
    robot, random = load_robot(name), np.random.default_rng(5)
    for distance in (1e-4, 0.3, 1.5):
        q = random.uniform(-1.0, 1.0, robot.dof)
        target = forward_kinematics(robot, q + distance * random.uniform(-1.0, 1.0, robot.dof))
        problem, step = Problem(robot, target, task, options), 1e-6
        here = problem.evaluate(q)
        differences = [problem.evaluate(q + e).cost - problem.evaluate(q - e).cost for e in step * np.eye(robot.dof)]
        assert here.gradient == pytest.approx(np.array(differences) / (2.0 * step), rel=1e-5, abs=1e-8)


@pytest.mark.parametrize("task", TASKS)
@pytest.mark.parametrize("name", ["ur5e", "al5b", "rrrp"])
def test_the_recorded_system_is_the_problem_for_many_poses(name: str, task: Task) -> None:
    robot, random = load_robot(name), np.random.default_rng(6)
    q = random.uniform(-1.0, 1.0, (30, robot.dof))
    targets = forward_kinematics(robot, q + random.uniform(-0.3, 0.3, q.shape))
    rows = normal_equations(robot, task).evaluate(np.hstack([q, targets[:, :3].reshape(30, 12)]).T)
    for i, angles in enumerate(q):
        here = Problem(robot, targets[i], task, SolverOptions()).evaluate(angles)
        assert rows.system[:, :-1, i] == pytest.approx(here.J.T @ here.J, abs=1e-12)
        assert rows.position_squared[i] == pytest.approx(here.position_error**2, abs=1e-12)
        if task == "pose":
            assert rows.sine_squared[i] == pytest.approx(np.sin(here.rotation_error) ** 2, abs=1e-12)
            assert rows.cosine[i] == pytest.approx(np.cos(here.rotation_error), abs=1e-12)


def test_many_small_systems_are_solved_as_one_is() -> None:
    random = np.random.default_rng(7)
    J, b = random.normal(size=(40, 6, 5)), random.normal(size=(40, 5))
    matrices = np.swapaxes(J, 1, 2) @ J
    system = np.concatenate([matrices, b[..., None]], axis=2).transpose(1, 2, 0).copy()
    expected = np.linalg.solve(matrices, b[..., None])[..., 0]
    assert np.allclose(solve_rows(system).T, expected, rtol=1e-6)


def test_starts_are_drawn_from_the_limits_and_from_finite_ranges_where_there_are_none() -> None:
    for name in ("rv-m1", "ur5e", "rrrp"):
        robot = load_robot(name)
        low, high = start_ranges(robot, bounds_of(robot, True)).T
        assert np.all((low >= robot.limits[:, 0]) & (high <= robot.limits[:, 1]))
        assert np.all(np.isfinite(low) & np.isfinite(high) & (low < high))
        assert np.all((high - low)[robot.is_revolute] <= 2.0 * np.pi + 1e-12)
