"""What holds whatever happens: random actions and faults, and an hour that costs no more memory than a minute."""

from __future__ import annotations

import gc
import runpy
import sys
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from rvsim.device.driver.actions import Run, Stream
from rvsim.motion import joint_move

SOAK = Path(__file__).parents[2] / "soak" / "soak_driver.py"


@pytest.mark.parametrize("first", [0, 10, 20])
def test_nothing_raises_nothing_asleep_moves_and_what_is_stopped_stays(first) -> None:
    session = runpy.run_path(str(SOAK))["session"]
    for seed in range(first, first + 10):
        session(seed, Counter(), 15.0)


@pytest.mark.parametrize("language", ["ssc32", "bridge"])
def test_ten_minutes_of_streaming_leave_the_memory_flat(rig, language) -> None:
    arm = rig(language, 115200).ready()
    arm.core._log = arm.core._wire._log = lambda *_: None

    def stream(minutes: float) -> None:
        for count in range(round(minutes * 60.0 / 0.02)):
            arm.core.do(Stream(arm.home + 0.2 * np.sin(0.02 * count)))
            arm.step(0.02)
            arm.sent.clear()
            arm.board.told.clear()
            arm.board.bytes.clear()

    stream(1.0)
    gc.collect()
    before = sys.getallocatedblocks()
    stream(9.0)
    gc.collect()
    assert arm.state.phase == "streaming"
    assert sys.getallocatedblocks() - before < 300


def test_a_long_run_is_recorded_in_the_same_memory(rig) -> None:
    arm = rig(baud=115200).ready()
    arm.done(Run(joint_move(arm.robot, arm.home, arm.home + 0.3, seconds=60.0)))
    rows = arm.core._recorder._table.shape[0]
    arm.run(20.0, 0.02)
    assert len(arm.core._recorder) <= rows
    assert arm.core._recorder._table.shape[0] == rows
    assert arm.core.recording.duration == pytest.approx(20.0, abs=0.2)
