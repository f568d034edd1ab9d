"""Numeric inverse kinematics of 2,000 random poses, against the Robotics Toolbox's Levenberg–Marquardt.

The toolbox is called a pose at a time, as is its only way, with the tolerance that makes it as exact as ours: at its
default few of its answers are within 1e-6. Neither side knows a closed form or the joints the pose was made from.
"""

from __future__ import annotations

import statistics
import time
from typing import Any, NamedTuple

import numpy as np
import roboticstoolbox
from harness import REPEATS, Race, Side, duration, print_races, print_table, race

import rvsim
from rvsim.kinematics.numeric.start_table import StartTable
from rvsim.robot import Robot
from rvsim.spatial import pose_difference

MANY = 2000
SEED = 11
TOLERANCE = 1e-6
AIMS = {"ur5e": 2.5, "rv-m1": 4.5}


def poses_of(robot: Robot) -> np.ndarray:
    """(2000, 4, 4) of configurations within the limits, at most half a turn from zero."""
    low, high = np.clip(robot.limits, -np.pi, np.pi).T
    return rvsim.forward_kinematics(robot, np.random.default_rng(SEED).uniform(low, high, (MANY, robot.dof)))


def toolbox_within_limits(robot: Robot) -> Any:
    """The same DH rows as a robot of the toolbox, with the limits in which it is to start and to end."""
    links = [
        roboticstoolbox.RevoluteDH(d=joint.d, a=joint.a, alpha=joint.alpha, offset=joint.theta, qlim=limits)
        for joint, limits in zip(robot.joints, np.clip(robot.limits, -np.pi, np.pi), strict=True)
    ]
    return roboticstoolbox.DHRobot(links).ets()


def toolbox_answers(arm: Any, T: np.ndarray) -> np.ndarray:
    """(m, n) one after the other."""
    return np.array([arm.ik_LM(pose, tol=1e-13, method="chan", k=0.1)[0] for pose in T])


def reached(robot: Robot, q: np.ndarray, T: np.ndarray) -> np.ndarray:
    """(m,) which poses are met within a micrometre and a microradian, inside the limits."""
    difference = pose_difference(rvsim.forward_kinematics(robot, q), T)
    within = np.all((q >= robot.limits[:, 0] - 1e-9) & (q <= robot.limits[:, 1] + 1e-9), axis=1)
    return (difference.position <= TOLERANCE) & (difference.angle <= TOLERANCE) & within


class Outcome(NamedTuple):
    """One arm: the race, and the parts of the poses that each side reached."""

    race: Race
    ours: float
    theirs: float


def run(robot: Robot) -> Outcome:
    """Both are timed on the poses that both reach; joints may differ, so the poses they give are compared."""
    T, arm = poses_of(robot), toolbox_within_limits(robot)
    ours = reached(robot, rvsim.solve_numeric_batch(robot, T).q, T)
    theirs = reached(robot, toolbox_answers(arm, T), T)
    common = T[ours & theirs]
    sides = (
        Side("rvsim", lambda: rvsim.forward_kinematics(robot, rvsim.solve_numeric_batch(robot, common).q)),
        Side("toolbox ik_LM", lambda: rvsim.forward_kinematics(robot, toolbox_answers(arm, common))),
    )
    outcome = race(robot.title, *sides, items=len(common), aim=AIMS[robot.name], tolerance=10.0 * TOLERANCE)
    return Outcome(outcome, float(ours.mean()), float(theirs.mean()))


def table_time(robot: Robot) -> float:
    """Seconds to build the table of starts, which is done once for an arm; the median."""
    times = []
    for _ in range(REPEATS):
        start = time.process_time()
        StartTable(robot, "pose", True)
        times.append(time.process_time() - start)
    return statistics.median(times)


def main() -> None:
    robots = [rvsim.load_robot(name) for name in AIMS]
    outcomes = [run(robot) for robot in robots]
    title = f"Numeric inverse kinematics, {MANY} random poses, tolerance 1e-6 m and 1e-6 rad"
    print_races(title, [outcome.race for outcome in outcomes])
    print_table(
        "Reached, and the time to build the table of starts once (not in the times above)",
        ("arm", "rvsim", "toolbox", "table"),
        [
            (robot.title, f"{outcome.ours:.2%}", f"{outcome.theirs:.2%}", duration(table_time(robot)))
            for robot, outcome in zip(robots, outcomes, strict=True)
        ],
    )


if __name__ == "__main__":
    main()
