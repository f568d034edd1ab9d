"""How quickly an emergency stop is on the wire while a trajectory streams, and how even set-points are.

Run it with `packaging/dev.py bench device`, or as a script; `--trials N` says how many stops a row. Key to first byte
is the time from the call of `ArmDriver.stop` until the first byte of the first STOP has arrived at the board at the
wire's pace; the last byte is that of the last channel with a servo. "al5b://" has the virtual arm in the driver's
process, "PTY" a board in another one. The hog is a thread that computes in pure Python for a second and leaves the
interpreter only when it must. Wall-clock times of a machine that may have other work.
"""

from __future__ import annotations

import argparse
import math
import multiprocessing
import os
import platform
import random
import re
import statistics
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from multiprocessing.connection import Connection
from typing import NamedTuple

import numpy as np
from harness import print_table

from rvsim import load_robot
from rvsim.device.driver import ArmDriver
from rvsim.device.virtual.board import Ssc32Board
from rvsim.motion import joint_move

BAUDS = (9600, 38400, 115200)
ROBOT = load_robot("al5b")
AIM = 50.0  # [ms]
WAIT = 10.0  # [s]
USED = 6  # channels
_STOPS = re.compile(rb"STOP(\d+)\r")


class Byte(NamedTuple):
    """A byte that arrived at the board, at a time of this computer's monotonic clock [s]."""

    time: float
    value: int


class Side(NamedTuple):
    """A driver at a board, and the bytes that have arrived there since they were asked for last."""

    driver: ArmDriver
    arrived: Callable[[], list[Byte]]


# --- the two boards ----------------------------------------------------------------------------------------------


@contextmanager
def in_process(baud: int) -> Iterator[Side]:
    """The virtual arm behind al5b://."""
    found: list[tuple[float, int]] = []
    with ArmDriver(ROBOT, "al5b://", baud=baud) as driver:
        driver.connect()
        driver.wait(lambda state: state.phase == "asleep", WAIT)
        arm = driver.virtual
        assert arm is not None
        write, began = arm.write, [math.inf]

        def heard(data: bytes) -> None:
            found.extend((arm.time, byte) for byte in data)
            began[0] = min(began[0], time.monotonic() - arm.time)
            write(data)

        arm.write = heard  # type: ignore[method-assign]

        def arrived() -> list[Byte]:
            # The arm's time lags behind the clock's by what it has not been told yet: at the least by nothing.
            taken = found[:]
            found.clear()
            return [Byte(began[0] + moment, value) for moment, value in taken]

        yield Side(driver, arrived)


@contextmanager
def over_pty(baud: int) -> Iterator[Side]:
    """A board in another process, which takes bytes off a PTY no faster than the wire would carry them."""
    import tty

    master, slave = os.openpty()
    tty.setraw(slave)
    ours, theirs = multiprocessing.get_context("fork").Pipe()
    child = multiprocessing.get_context("fork").Process(target=_board, args=(master, baud, theirs), daemon=True)
    child.start()
    try:
        with ArmDriver(ROBOT, os.ttyname(slave), baud=baud) as driver:
            driver.connect()
            driver.wait(lambda state: state.phase == "asleep", WAIT)

            def arrived() -> list[Byte]:
                ours.send(None)
                return [Byte(*entry) for entry in ours.recv()]

            yield Side(driver, arrived)
    finally:
        child.kill()
        child.join()
        os.close(master)
        os.close(slave)


def _board(master: int, baud: int, pipe: Connection) -> None:
    """In the other process: a byte every ten bits."""
    board = Ssc32Board(ROBOT.servos, lambda: ROBOT.home)
    os.set_blocking(master, False)
    found: list[tuple[float, int]] = []
    byte, free, before = 10.0 / baud, time.monotonic(), time.monotonic()
    while True:
        now = time.monotonic()
        board.process(now - before)
        before, most = now, int((now - free) / byte)
        data = _read(master, most)
        if len(data) < most:  # the line was at rest, the bytes have just come
            free = max(free, now - (len(data) + 1) * byte)
        for value in data:
            free += byte
            found.append((free, value))
        board.write(data)
        if answers := board.read():
            os.write(master, answers)
        if pipe.poll():
            pipe.recv()
            pipe.send(found)
            found = []
        time.sleep(0.0005)


def _read(master: int, most: int) -> bytes:
    try:
        return os.read(master, most) if most > 0 else b""
    except (BlockingIOError, OSError):
        return b""


# --- what is measured --------------------------------------------------------------------------------------------


def ready(side: Side) -> np.ndarray:
    """All joints awake, at home."""
    home = np.clip(ROBOT.home, *side.driver.limits.T)
    for axis in range(ROBOT.dof):
        side.driver.wake(axis, home[axis])
        side.driver.wait(lambda state, axis=axis: state.awake[axis] and state.phase == "ready", WAIT)
    return home


def streaming(side: Side, home: np.ndarray) -> None:
    """A trajectory under way."""
    refusal = side.driver.run(joint_move(ROBOT, home, home + 0.3, seconds=60.0), approach=True)
    assert refusal is None, refusal
    side.driver.wait(lambda state: state.time > 0.3, WAIT)


def stop_times(side: Side, home: np.ndarray, trials: int) -> list[tuple[float, float]]:
    """Key to the first byte of STOP, and to the last one for a channel with a servo [ms]."""
    dice, times = random.Random(0), []
    for _ in range(trials):
        streaming(side, home)
        time.sleep(dice.uniform(0.0, 0.1))
        side.arrived()
        pressed = time.monotonic()
        side.driver.stop()
        time.sleep(0.5)
        times.append(_first_and_last(side.arrived(), pressed))
        side.driver.wait(lambda _: side.driver.reset() is None, WAIT)
    return times


def _first_and_last(arrived: Sequence[Byte], pressed: float) -> tuple[float, float]:
    after = [byte for byte in arrived if byte.time >= pressed]
    text = bytes(byte.value for byte in after)
    stops = list(_STOPS.finditer(text))
    first, last = after[stops[0].start()].time, after[stops[USED - 1].end() - 1].time
    return 1e3 * (first - pressed), 1e3 * (last - pressed)


def intervals(side: Side, home: np.ndarray, hog: bool) -> list[float]:
    """Between the beginnings of set-points within a second [ms]."""
    streaming(side, home)
    side.arrived()
    end = time.monotonic() + 1.0
    while time.monotonic() < end:
        if not hog:
            time.sleep(0.01)
    arrived = side.arrived()
    side.driver.hold()
    side.driver.wait(lambda state: state.phase == "ready", WAIT)
    text = bytes(byte.value for byte in arrived)
    starts = [arrived[match.start()].time for match in re.finditer(rb"#0P", text)]
    return (1e3 * np.diff(starts)).tolist()


# --- tables ------------------------------------------------------------------------------------------------------


def _spread(values: Sequence[float]) -> tuple[str, str, str]:
    ordered = sorted(values)
    return tuple(
        f"{value:.1f}" for value in (statistics.median(ordered), ordered[int(0.95 * (len(ordered) - 1))], ordered[-1])
    )


def main() -> int:
    """Both tables; 1 where a stop took longer than the aim."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--trials", type=int, default=25)
    options = parser.parse_args()
    print(f"{platform.system()} {platform.machine()}, Python {platform.python_version()}, {os.cpu_count()} cores")
    stops, evenness, slowest = [], [], 0.0
    for name, link in {"al5b://": in_process, "PTY": over_pty if sys.platform != "win32" else None}.items():
        for baud in BAUDS if link else ():
            with link(baud) as side:
                home = ready(side)
                times = stop_times(side, home, options.trials)
                slowest = max(slowest, max(first for first, _ in times))
                stops.append((name, str(baud), *_spread([t for t, _ in times]), *_spread([t for _, t in times])))
                for hog in (False, True):
                    gaps = intervals(side, home, hog)
                    evenness.append((name, str(baud), "hogged" if hog else "idle", str(len(gaps)), *_spread(gaps)))
    head = ("link", "baud", "first p50", "p95", "max", "last p50", "p95", "max")
    print_table(f"Key to STOP [ms], {options.trials} stops each; aim: first byte within {AIM:g} ms", head, stops)
    print_table("From set-point to set-point [ms]", ("link", "baud", "window", "count", "p50", "p95", "max"), evenness)
    return int(slowest > AIM)


if __name__ == "__main__":
    sys.exit(main())
