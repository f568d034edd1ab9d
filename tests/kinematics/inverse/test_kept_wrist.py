"""The place alone with the wrist kept: four ways, each with the wrist joints of the arm, the arm's own among them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rvsim.errors import NoClosedFormError
from rvsim.files import load_robot
from rvsim.kinematics import forward_kinematics, inverse_kinematics
from rvsim.robot import Tool
from rvsim.spatial import translation

TASK = "position, wrist kept"


@pytest.mark.parametrize("name", ["rv-m1", "al5b"])
def test_the_arms_own_joints_are_found_again_and_the_wrist_stays(name: str) -> None:
    robot, generator = load_robot(name), np.random.default_rng(4)
    for q in generator.uniform(*robot.limits.T, (200, 5)):
        near = q + np.append(generator.uniform(-0.3, 0.3, 3), (0.0, 0.0))
        branches = inverse_kinematics(robot, forward_kinematics(robot, q), task=TASK, near=near).branches
        assert max(branch.residual for branch in branches) < 1e-12
        np.testing.assert_allclose([branch.q[3:] for branch in branches], [q[3:]] * len(branches), atol=1e-12)
        turns = [np.abs(np.sin(0.5 * (branch.q - q))).max() for branch in branches]
        assert min(turns) < 1e-7


def test_a_place_further_than_the_bent_wrist_lets_the_arm_reach_is_out_of_reach() -> None:
    robot = load_robot("rv-m1")
    bent = np.radians([0.0, 30.0, -40.0, -80.0, 0.0])
    far = forward_kinematics(robot, robot.home)  # the arm stretched out, the wrist straight
    assert inverse_kinematics(robot, far, task="position", near=bent).failure is None
    failure = inverse_kinematics(robot, far, task=TASK, near=bent).failure
    assert failure is not None
    assert failure.kind == "reach"
    np.testing.assert_allclose(failure.nearest_q[3:], bent[3:], atol=1e-12)
    assert failure.nearest.position_error > 0.02


def test_a_tip_beside_the_roll_axis_has_no_such_closed_form() -> None:
    robot = load_robot("rv-m1")
    bent = replace(robot, tools=(Tool("bent", "Bent", translation([0.03, 0.0, 0.05])),), tool_name="bent")
    with pytest.raises(NoClosedFormError, match="roll axis"):
        inverse_kinematics(bent, forward_kinematics(bent, bent.home), task=TASK)
