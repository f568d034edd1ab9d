"""Tracking a path, against the Robotics Toolbox and EAIK, each followed from point to point as they are meant to be.

The work is source 002's ellipse moved by (300, 0, 300) mm. Ours looks at all branches at all points, chooses the best
sequence, tests that it keeps to the path between the points, and reports; the peers go from one solution to the next.
Before anything is timed each must put the tool on every point.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import roboticstoolbox
from eaik.IK_DH import DhRobot
from harness import REPEATS, Race, Side, duration, print_races, print_table, race

import rvsim
from rvsim.lab import named_path
from rvsim.motion import Path, track
from rvsim.robot import Robot

AIM = 5.0
TURN = 2.0 * np.pi
LONG = (20_000, 40_000)
MOST = {"spiral": 0.005, "long": 0.3}


def counting(solve: Callable[[], np.ndarray]) -> Callable[[], np.ndarray]:
    """How many points it found."""
    return lambda: np.array(len(solve()))


def toolbox(robot: Robot, T: np.ndarray, start: np.ndarray) -> Callable[[], np.ndarray]:
    """Levenberg–Marquardt as exact as ours, started in the last solution."""
    links = [roboticstoolbox.RevoluteDH(d=j.d, a=j.a, alpha=j.alpha, offset=j.theta) for j in robot.joints]
    arm = roboticstoolbox.DHRobot(links).ets()

    def follow() -> np.ndarray:
        q, found = start, np.empty((len(T), robot.dof))
        for index, pose in enumerate(T):
            found[index] = q = arm.ik_LM(pose, q0=q, tol=1e-13, method="chan", k=0.1)[0]
        return found

    return follow


def eaik(robot: Robot, T: np.ndarray, start: np.ndarray) -> Callable[[], np.ndarray]:
    """All branches of a pose, of which the nearest to the last one."""
    arm = DhRobot(robot.dh[:, 3], robot.dh[:, 2], robot.dh[:, 1])

    def follow() -> np.ndarray:
        q, found = start, np.empty((len(T), robot.dof))
        for index, pose in enumerate(T):
            steps = arm.IK(pose).Q - robot.dh[:, 0] - q
            steps -= TURN * np.rint(steps / TURN)
            found[index] = q = q + steps[np.argmin(np.einsum("bn,bn->b", steps, steps))]
        return found

    return follow


def races(robot: Robot, path: Path) -> list[Race]:
    """Ours against both, in one run."""
    T = path.poses()
    start = np.array(track(robot, path).q[0])
    peers = {"toolbox ik_LM, warm": toolbox(robot, T, start), "EAIK, nearest branch": eaik(robot, T, start)}
    sides: dict[str, Callable[[], np.ndarray]] = {"rvsim": lambda: track(robot, path).q, **peers}
    for name, follow in sides.items():
        missed = float(np.abs(rvsim.forward_kinematics(robot, follow()) - T).max())
        if missed > 1e-6:
            raise ValueError(f"{name} misses the path by {missed:.3g}, so it is not timed")
    work = f"{robot.title}, ellipse of {path.samples} points"
    # The branch is each one's own choice: what is compared in the race itself is how many points were found.
    counted = Side("rvsim track", counting(lambda: track(robot, path).q))
    return [race(work, counted, Side(name, counting(follow)), path.samples, aim=AIM) for name, follow in peers.items()]


def seconds(robot: Robot, path: Path) -> float:
    """The median of the time for a whole path.

    Raises:
        ValueError: not all of it is reached without a jump.
    """
    tracking = track(robot, path)
    if not tracking.complete or tracking.jumps:
        raise ValueError(f"{robot.title} does not draw all of {path.title}")
    times = []
    for _ in range(REPEATS):
        begun = time.process_time()
        track(robot, path)
        times.append(time.process_time() - begun)
    return statistics.median(times)


def denser(path: Path, samples: int) -> Path:
    """The same ellipse with more points."""
    assert path.rotations is not None
    known, wanted = np.arange(path.samples), np.linspace(0.0, path.samples - 1.0, samples)
    points = np.stack([np.interp(wanted, known, path.points[:, axis]) for axis in range(3)], axis=1)
    return Path(path.name, points, np.broadcast_to(path.rotations[0], (samples, 3, 3)), path.title)


def freed(path: Path) -> Path:
    """The same places in any orientation."""
    return replace(path, rotations=None, title=f"{path.title}, orientation free")


def main() -> None:
    ur5e, rrrp = rvsim.load_robot("ur5e"), rvsim.load_robot("rrrp")
    ellipse, spiral = named_path("ellipse-moved", ur5e), named_path("spiral", rrrp)
    print_races("Tracking, all branches and the best sequence of them", races(ur5e, ellipse))
    works = [
        (rrrp, spiral, MOST["spiral"]),
        *((ur5e, denser(ellipse, n), MOST["long"] * n / LONG[0]) for n in LONG),
        *((ur5e, freed(denser(ellipse, n)), MOST["long"] * n / LONG[0]) for n in LONG),
    ]
    rows = []
    for robot, path, most in works:
        taken = seconds(robot, path)
        verdict = "reached" if taken < most else "MISSED"
        rows.append((f"{robot.title}, {path.title}", str(path.samples), duration(taken), duration(taken / path.samples),
                     f"< {duration(most)} {verdict}"))  # fmt: skip
    print_table("Long paths", ("work", "points", "time", "a point", "aim"), rows)


if __name__ == "__main__":
    main()
