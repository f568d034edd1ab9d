"""What holds whatever happens: random actions and faults, and minutes that cost no more memory than seconds."""

from __future__ import annotations

import gc
import runpy
import sys
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from rvsim.device.bridge.board import BridgeBoard
from rvsim.device.driver.actions import Connect, Run, Stream, Wake
from rvsim.device.driver.core import DriverCore
from rvsim.device.virtual.board import Ssc32Board
from rvsim.motion import joint_move

SOAK = Path(__file__).parents[2] / "soak" / "soak_driver.py"


@pytest.mark.parametrize("first", [0, 10])
def test_nothing_raises_nothing_asleep_moves_and_what_is_stopped_stays(first) -> None:
    session = runpy.run_path(str(SOAK))["session"]
    for seed in range(first, first + 6):
        session(seed, Counter(), 15.0)


def boards(robot):
    """Both boards, without arms to move: physics takes its time."""
    yield "ssc32", Ssc32Board(robot.servos, lambda: robot.home)
    yield "bridge", BridgeBoard(robot, robot.servos, robot.gripper_servo, lambda: robot.home)


def test_minutes_of_streaming_leave_the_memory_flat(al5b) -> None:
    # An hour of it: tests/soak/soak_streaming.py.
    for language, board in boards(al5b):
        core = DriverCore(al5b, language=language, baud=115200)
        home, now = np.clip(al5b.home, *core.limits.T), 0.0

        def run(seconds: float, follow: bool = False, core=core, board=board, home=home) -> None:
            nonlocal now
            for count in range(round(seconds / 0.02)):
                if follow:
                    core.do(Stream(home + 0.2 * np.sin(0.02 * count)))
                board.process(0.02)
                now += 0.02
                board.write(core.process(now, board.read()))

        core.do(Connect())
        run(1.0)
        for axis in range(5):
            assert core.do(Wake(axis, home[axis])) is None
            run(1.5)
        run(30.0, follow=True)
        gc.collect()
        before = sys.getallocatedblocks()
        run(90.0, follow=True)
        gc.collect()
        assert core.phase == "streaming"
        assert sys.getallocatedblocks() - before < 300


def test_a_long_run_is_recorded_in_the_same_memory(rig) -> None:
    arm = rig(baud=115200).ready()
    arm.done(Run(joint_move(arm.robot, arm.home, arm.home + 0.3, seconds=60.0)))
    rows = arm.core._recorder._table.shape[0]
    arm.run(20.0, 0.02)
    assert len(arm.core._recorder) <= rows
    assert arm.core._recorder._table.shape[0] == rows
    assert arm.core.recording.duration == pytest.approx(20.0, abs=0.2)
