"""A lit column shows the joint's axis through o, the arm p − o, and arrows along the column's two parts."""

import numpy as np
import pytest

from rvsim.experiment import random_pose
from rvsim.files import load_robot
from rvsim.kinematics import forward_kinematics, jacobian
from rvsim.scene.arrows import ON_TOP
from rvsim.scene.jacobian_column import VELOCITY_SCALE, column_items
from rvsim.scene.palette import LIGHT


@pytest.mark.parametrize("name", ["rv-m1", "ur5e", "rrrp", "scara"])
def test_the_arrow_at_the_tool_goes_along_the_linear_part(name):
    robot = load_robot(name)
    q = random_pose(robot, 3)
    p, J = forward_kinematics(robot, q)[:3, 3], jacobian(robot, q)
    for joint in range(robot.dof):
        items = {item.key: item for item in column_items(robot, q, joint, "1 mm/rad", LIGHT)}
        assert all(key.startswith(ON_TOP) for key in items)
        wanted = J[:3, joint] * (1.0 if robot.joints[joint].revolute else 0.5 * robot.size)
        arrow = items.get(f"{ON_TOP}jacobian.v")
        if np.linalg.norm(wanted) > 1e-6:
            np.testing.assert_allclose(arrow.points[0], p, atol=1e-12)
            way = arrow.points[1] - p
            np.testing.assert_allclose(np.cross(way, wanted), 0.0, atol=1e-12)
            assert way @ wanted > 0.0
            assert np.linalg.norm(way) < VELOCITY_SCALE * np.linalg.norm(wanted)
        axis = items[f"{ON_TOP}jacobian.z"].points
        if robot.joints[joint].revolute:
            np.testing.assert_allclose(np.cross(axis[1] - axis[0], J[3:, joint]), 0.0, atol=1e-12)
