"""A million poses of a workspace: no peer draws one, so these are times on the clock, as a student waits for them."""

from __future__ import annotations

import statistics
import time

from harness import duration, print_table

import rvsim
from rvsim.kinematics.workspace import WorkspaceTask, holds_orientation, workspace

POSES = 1_000_000
REPEATS = 5
AIM = 2.0  # [s]
WORK = {
    "manipulability": {},
    "manipulability and branches": {"branches": True},
    "orientation held": {"fixed": True},
}


def waited(task: WorkspaceTask) -> float:
    """The median of some surveys [s]."""
    times = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        workspace(task)
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def rows(name: str) -> list[tuple[str, str, str, str]]:
    """One row for each kind of work the arm can do."""
    robot = rvsim.load_robot(name)
    found = []
    for work, options in WORK.items():
        if options.get("fixed") and not holds_orientation(robot):
            continue
        seconds = waited(WorkspaceTask(robot, robot.home, poses=POSES, **options))
        aim = f"≤ {AIM:g} s {'reached' if seconds <= AIM else 'MISSED'}" if not options else ""
        found.append((robot.title, work, duration(seconds), aim))
    return found


def main() -> None:
    table = [row for name in ("ur5e", "rv-m1", "rv-1a", "scara") for row in rows(name)]
    print_table(f"Workspace, {POSES} poses", ("arm", "work", "time", "aim"), table)


if __name__ == "__main__":
    main()
