"""An hour of streaming to a virtual arm in virtual time: the memory line must be flat.

    python tests/soak/soak_streaming.py [--minutes 60] [--baud 115200]

Prints, every five simulated minutes, the resident memory, the lines in the log, and the set-points dropped. The log
keeps its newest 100,000 lines; once it is full nothing may grow: leaves with 1 if memory then grows by more than 3 %.
"""

from __future__ import annotations

import argparse
import math
import sys
import time

import numpy as np

from rvsim import load_robot
from rvsim.device.driver.actions import Connect, Stream, Wake
from rvsim.device.driver.core import DriverCore
from rvsim.device.link.pacing import PacedArm
from rvsim.device.virtual.arm import VirtualArm
from rvsim.device.wire_log import MOST_ENTRIES, WireLog

STEP = 0.02  # [s] the thread's look at the wire
REPORT = 300.0  # [s]
GROWTH = 1.03


def resident_mb() -> float:
    """[MB], Linux only; nan elsewhere."""
    try:
        with open("/proc/self/statm", encoding="ascii") as file:
            return int(file.read().split()[1]) * 4096 / 1e6
    except OSError:
        return math.nan


def main() -> int:
    """Stream; the exit status."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--baud", type=int, default=115200)
    options = parser.parse_args()
    robot, log = load_robot("al5b"), WireLog()
    core = DriverCore(robot, baud=options.baud, log=log.add)
    wire = PacedArm(VirtualArm(robot), options.baud)
    core.do(Connect())
    now, began, next_report = 0.0, time.perf_counter(), REPORT
    full: list[float] = []  # [MB] once the log is full
    asleep: list[int | str] = [*range(robot.dof), "gripper"]
    while now < 60.0 * options.minutes:
        now += STEP
        wire.process(STEP)
        wire.send(core.process(now, wire.receive()))
        if asleep and core.phase in ("asleep", "ready"):
            axis = asleep.pop(0)
            core.do(Wake(axis, 1.0 if axis == "gripper" else float(robot.home[int(axis)])))
        elif not asleep and core.phase in ("ready", "streaming"):
            swing = 0.3 * np.sin(now * np.array([0.5, 0.7, 0.9, 1.1, 1.3]))
            core.do(Stream(np.clip(robot.home + swing, *core.limits.T)))
        if now >= next_report:
            next_report += REPORT
            state = core.state
            print(
                f"{now / 60:5.0f} min  {state.phase:9s}  resident {resident_mb():6.1f} MB  "
                f"lines {log.count}  sent {state.sent_bytes}  dropped {state.dropped_setpoints}",
                flush=True,
            )
            full += [resident_mb()] if log.count > MOST_ENTRIES else []
    print(f"{now / (time.perf_counter() - began):.0f} times real time")
    flat = not full or max(full) <= GROWTH * full[0]
    return 0 if flat and core.phase == "streaming" else 1


if __name__ == "__main__":
    sys.exit(main())
