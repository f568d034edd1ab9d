"""All branches of the inverse kinematics, against EAIK, ur-analytic-ik and the Robotics Toolbox.

Before anything is timed, every branch of the peer must be a branch of ours and the other way round. What is compared
in the race itself is the number of branches of each pose, read from the peer's own result objects.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import roboticstoolbox
import ur_analytic_ik
from eaik.IK_DH import DhRobot
from harness import Race, Side, print_races, race

import rvsim
from rvsim.robot import Robot

MANY = 50_000
CHECKED = 200
SEED = 7
SAME = 1e-6  # [rad]
BATCH_AIMS = {"ur5e": 14.0, "rv-m1": 27.0, "rv-1a": 10.0}

Branches = Callable[[np.ndarray], np.ndarray]


def poses_of(robot: Robot, count: int) -> np.ndarray:
    """(count, 4, 4) of random configurations."""
    q = np.random.default_rng(SEED).uniform(-np.pi, np.pi, (count, robot.dof))
    return rvsim.forward_kinematics(robot, q)


def check(robot: Robot, name: str, branches_of: Branches) -> None:
    """Every branch of the peer is one of ours, and the other way round, or there is nothing to compare.

    Raises:
        ValueError: a branch is missing on one side.
    """
    for T in poses_of(robot, CHECKED):
        ours, theirs = rvsim.inverse_branches(robot, T), np.asarray(branches_of(T))
        apart = np.abs(np.remainder(ours[:, None] - theirs[None] + np.pi, 2 * np.pi) - np.pi).max(axis=-1)
        if len(ours) != len(theirs) or apart.min(axis=1).max() > SAME or apart.min(axis=0).max() > SAME:
            raise ValueError(f"{robot.title}: rvsim and {name} disagree, so they are not timed")


def exact(found: Any) -> np.ndarray:
    """EAIK's solutions without those that it marks as least-squares guesses at a pose it cannot reach."""
    return found.Q[~np.asarray(found.is_LS)]


def batch_race(robot: Robot) -> Race:
    """All branches of many poses."""
    arm = DhRobot(robot.dh[:, 3], robot.dh[:, 2], robot.dh[:, 1])
    check(robot, "EAIK", lambda T: exact(arm.IK(T)) - robot.dh[:, 0])
    T = poses_of(robot, MANY)
    same = _counted(robot, T) == _counted_by_eaik(arm, T)
    print(f"{robot.title}: the numbers of branches differ at {MANY - int(same.sum())} of {MANY} poses, left out")
    raced = T[same]
    ours = Side("rvsim", lambda: _counted(robot, raced))
    peer = Side("EAIK IK_batched", lambda: _counted_by_eaik(arm, raced))
    return race(f"{robot.title}, {MANY} poses", ours, peer, items=len(raced), aim=BATCH_AIMS[robot.name])


def _counted(robot: Robot, T: np.ndarray) -> np.ndarray:
    return np.asarray(np.isfinite(rvsim.inverse_kinematics_batch(robot, T)[..., 0]).sum(axis=1))


def _counted_by_eaik(arm: DhRobot, T: np.ndarray) -> np.ndarray:
    return np.array([len(exact(found)) for found in arm.IK_batched(T)])


def single_races(robot: Robot) -> list[Race]:
    """All branches of one pose at a time, a call a pose."""
    T = poses_of(robot, CHECKED)
    toolbox = _toolbox_solver(robot)
    peers: list[tuple[str, Branches, float]] = [
        ("ur-analytic-ik", ur_analytic_ik.ur5e.inverse_kinematics, 2.0),
        ("toolbox analytic_ik", lambda pose: toolbox.solve(pose, joint_limits=False).q, 80.0),
    ]
    ours = Side("rvsim", lambda: np.array([len(rvsim.inverse_branches(robot, pose)) for pose in T]))
    races = []
    for name, branches_of, aim in peers:
        check(robot, name, branches_of)
        theirs = Side(name, lambda peer=branches_of: np.array([len(peer(pose)) for pose in T]))
        races.append(race(f"{robot.title}, one pose", ours, theirs, items=len(T), aim=aim))
    return races


def _toolbox_solver(robot: Robot) -> Any:
    """The toolbox's closed form of the same DH rows; to derive it takes seconds and is not timed."""
    links = [
        roboticstoolbox.RevoluteDH(d=joint.d, a=joint.a, alpha=joint.alpha, offset=joint.theta)
        for joint in robot.joints
    ]
    return roboticstoolbox.DHRobot(links).analytic_ik()


def main() -> None:
    races = [batch_race(rvsim.load_robot(name)) for name in BATCH_AIMS]
    races += single_races(rvsim.load_robot("ur5e"))
    print_races("Inverse kinematics, all branches", races)


if __name__ == "__main__":
    main()
