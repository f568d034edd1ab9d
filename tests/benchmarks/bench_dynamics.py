"""Inverse dynamics and the Jacobian of the UR5e, against the Robotics Toolbox and Pinocchio.

The toolbox's `rne` takes arrays; its `jacob0` and Pinocchio's `rnea` do not, and are looped over. Ours computes the
tool's pose together with the Jacobian.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import roboticstoolbox
from harness import Race, Side, print_races, race

import rvsim
from rvsim.dynamics import STANDARD_GRAVITY
from rvsim.kinematics import pose_and_jacobian
from rvsim.robot import Robot

MANY = 100_000
SEED = 9


def toolbox_arm(robot: Robot) -> Any:
    """The same DH rows and masses as a robot of the toolbox, gravity along −z."""
    links = [
        roboticstoolbox.RevoluteDH(
            d=joint.d, a=joint.a, alpha=joint.alpha, offset=joint.theta,
            m=link.mass, r=link.com, I=link.inertia, Jm=0.0, B=0.0, Tc=[0.0, 0.0], G=1.0,
        )
        for joint, link in zip(robot.joints, robot.masses, strict=True)
    ]  # fmt: skip
    return roboticstoolbox.DHRobot(links, gravity=[0.0, 0.0, -STANDARD_GRAVITY])


class PinocchioArm:
    """The same DH rows and masses as a Pinocchio model, and its loop over poses."""

    def __init__(self, robot: Robot) -> None:
        import pinocchio

        self._pinocchio = pinocchio
        self._model = pinocchio.Model()
        self._model.gravity.linear = np.array([0.0, 0.0, -STANDARD_GRAVITY])
        placement = pinocchio.SE3.Identity()
        for number, (joint, link) in enumerate(zip(robot.joints, robot.masses, strict=True)):
            about_z = pinocchio.AngleAxis(joint.theta, np.array([0.0, 0, 1])).matrix()
            start = placement * pinocchio.SE3(about_z, np.zeros(3))
            index = self._model.addJoint(number, pinocchio.JointModelRZ(), start, joint.name)
            tilt = pinocchio.AngleAxis(joint.alpha, np.array([1.0, 0, 0])).matrix()
            placement = pinocchio.SE3(tilt, np.array([joint.a, 0, joint.d]))
            body = pinocchio.Inertia(link.mass, np.array(link.com), np.array(link.inertia))
            self._model.appendBodyToJoint(index, body, placement)
        self._data = self._model.createData()

    def torques(self, q: np.ndarray, qd: np.ndarray, qdd: np.ndarray) -> np.ndarray:
        """(m, n) each -> (m, n), pose after pose."""
        result = np.empty_like(q)
        for index, rates in enumerate(zip(q, qd, qdd, strict=True)):
            result[index] = self._pinocchio.rnea(self._model, self._data, *rates)
        return result


def dynamics_races(robot: Robot, toolbox: Any, rates: np.ndarray) -> list[Race]:
    """A hundred thousand states and one."""
    one = rates[:, 0]
    ours_many = Side("rvsim", lambda: rvsim.inverse_dynamics(robot, *rates))
    ours_one = Side("rvsim", lambda: rvsim.inverse_dynamics(robot, *one))
    races = [
        race(f"torques, {MANY} states", ours_many, Side("toolbox rne", lambda: toolbox.rne(*rates)), MANY, aim=3.0),
        race("torques, one state", ours_one, Side("toolbox rne", lambda: toolbox.rne(*one)), 1),
    ]
    try:
        arm = PinocchioArm(robot)
    except ModuleNotFoundError:
        print("Pinocchio is not installed here, and left out.")
        return races
    loop = Side("pin rnea, loop", lambda: arm.torques(*rates))
    return [*races, race(f"torques, {MANY} states", ours_many, loop, MANY, aim=3.0)]


def jacobian_race(robot: Robot, toolbox: Any, q: np.ndarray) -> Race:
    """Pose and Jacobian of ours against the Jacobian alone."""
    ets = toolbox.ets()
    loop = Side("toolbox jacob0, loop", lambda: np.array([ets.jacob0(pose) for pose in q]))
    ours = Side("rvsim", lambda: pose_and_jacobian(robot, q).J)
    return race(f"pose and Jacobian, {MANY} poses", ours, loop, MANY, aim=45.0)


def main() -> None:
    robot = rvsim.load_robot("ur5e")
    toolbox = toolbox_arm(robot)
    rates = np.random.default_rng(SEED).uniform(-np.pi, np.pi, (3, MANY, robot.dof))
    print_races("UR5e, dynamics", [*dynamics_races(robot, toolbox, rates), jacobian_race(robot, toolbox, rates[0])])


if __name__ == "__main__":
    main()
