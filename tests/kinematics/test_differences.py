"""Differences of the forward kinematics agree with every Jacobian of every arm."""

from functools import partial

import numpy as np
import pytest

import rvsim
from rvsim.errors import UnknownNameError
from rvsim.experiment import random_pose
from rvsim.kinematics import jacobian
from rvsim.kinematics.differences import jacobian_by_differences
from rvsim.kinematics.rates import analytic_jacobian, angle_measure, tool_jacobian

FORMULAS = {
    "base": jacobian,
    "tool": tool_jacobian,
    "rpy": partial(analytic_jacobian, angles="rpy"),
    "zyz": partial(analytic_jacobian, angles="zyz"),
}


@pytest.mark.parametrize("rows", FORMULAS)
@pytest.mark.parametrize("name", rvsim.robot_names())
def test_they_agree(name, rows):
    robot = rvsim.load_robot(name)
    for seed in range(5):
        q = random_pose(robot, seed)
        if rows in ("rpy", "zyz") and angle_measure(robot, q, rows) < 0.1:
            continue
        np.testing.assert_allclose(jacobian_by_differences(robot, q, rows), FORMULAS[rows](robot, q), atol=1e-8)


def test_there_are_no_other_rows():
    robot = rvsim.load_robot("rv-m1")
    with pytest.raises(UnknownNameError, match="zyz"):
        jacobian_by_differences(robot, robot.home, "zxz")
