"""Forward kinematics and the Jacobian of the UR5e, against the Robotics Toolbox and Pinocchio.

The toolbox is called in its quickest public form for arrays; Pinocchio has none for arrays and is looped over.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import roboticstoolbox
from harness import Race, Side, print_races, race

import rvsim
from rvsim.robot import Robot

MANY = 100_000
SEED = 5


def toolbox_arm(robot: Robot) -> Any:
    """The same DH rows as a robot of the toolbox."""
    links = [
        roboticstoolbox.RevoluteDH(d=joint.d, a=joint.a, alpha=joint.alpha, offset=joint.theta)
        for joint in robot.joints
    ]
    return roboticstoolbox.DHRobot(links).ets()


class PinocchioArm:
    """The same DH rows as a Pinocchio model, and its loop over poses."""

    def __init__(self, robot: Robot) -> None:
        import pinocchio

        self._pinocchio = pinocchio
        self._model = pinocchio.Model()
        placement = pinocchio.SE3.Identity()
        for number, joint in enumerate(robot.joints):
            start = placement * pinocchio.SE3(
                pinocchio.AngleAxis(joint.theta, np.array([0.0, 0, 1])).matrix(), np.zeros(3)
            )
            self._model.addJoint(number, pinocchio.JointModelRZ(), start, joint.name)
            turn = pinocchio.AngleAxis(joint.alpha, np.array([1.0, 0, 0])).matrix()
            placement = pinocchio.SE3(turn, np.array([joint.a, 0, joint.d]))
        self._T_joint_tool = placement.homogeneous
        self._data = self._model.createData()

    def forward(self, q: np.ndarray) -> np.ndarray:
        """(m, n) -> (m, 4, 4), pose after pose; the fixed last step is done for all at once, as is quickest."""
        result = np.empty((len(q), 4, 4))
        last = self._model.njoints - 1
        for index, pose in enumerate(q):
            self._pinocchio.forwardKinematics(self._model, self._data, pose)
            result[index] = self._data.oMi[last].homogeneous
        return result @ self._T_joint_tool


def forward_races(robot: Robot, toolbox: Any, q: np.ndarray) -> list[Race]:
    """A hundred thousand poses and one."""
    one = q[0]
    ours = [
        Side("rvsim", lambda: rvsim.forward_kinematics(robot, q)),
        Side("rvsim", lambda: rvsim.forward_kinematics(robot, one)),
    ]
    theirs = [Side("toolbox ets.eval", lambda: toolbox.eval(q)), Side("toolbox ets.eval", lambda: toolbox.eval(one))]
    return [
        race(f"forward, {MANY} poses", ours[0], theirs[0], items=MANY, aim=10.0),
        race("forward, one pose", ours[1], theirs[1], items=1, aim=2.5),
    ]


def pinocchio_races(robot: Robot, q: np.ndarray) -> list[Race]:
    """The loop over poses; none where the library cannot be installed."""
    try:
        arm = PinocchioArm(robot)
    except ModuleNotFoundError:
        print("Pinocchio is not installed here, and left out.")
        return []
    ours = Side("rvsim", lambda: rvsim.forward_kinematics(robot, q))
    return [race(f"forward, {MANY} poses", ours, Side("pin, loop", lambda: arm.forward(q)), items=MANY)]


def jacobian_races(robot: Robot, toolbox: Any, q: np.ndarray) -> list[Race]:
    """The toolbox has no batch form: ours is timed in both forms against its loop."""
    one = q[0]
    loop = Side("toolbox jacob0, loop", lambda: np.array([toolbox.jacob0(pose) for pose in q]))
    ours_many = Side("rvsim", lambda: rvsim.jacobian(robot, q))
    ours_one = Side("rvsim", lambda: rvsim.jacobian(robot, one))
    return [
        race(f"Jacobian, {len(q)} poses", ours_many, loop, items=len(q)),
        race("Jacobian, one pose", ours_one, Side("toolbox jacob0", lambda: toolbox.jacob0(one)), items=1),
    ]


def main() -> None:
    robot = rvsim.load_robot("ur5e")
    toolbox = toolbox_arm(robot)
    q = np.random.default_rng(SEED).uniform(-np.pi, np.pi, (MANY, robot.dof))
    races = [*forward_races(robot, toolbox, q), *pinocchio_races(robot, q), *jacobian_races(robot, toolbox, q[:10_000])]
    print_races("UR5e, kinematics", races)


if __name__ == "__main__":
    main()
