"""Drive virtual arms with the driver for months: random actions, junk among them, and faults, in virtual time.

    python tests/soak/soak_driver.py [--minutes 1000] [--seed 0]

Laws: nothing raises; no byte moves an axis that sleeps; after a latched stop no set-point arrives, and the pulses stay
as they are unless the supply breaks down or no STOP can come through. Prints simulated minutes and events; leaves with
1 at the first law that breaks, naming the session's seed. tests/device/driver/test_laws.py runs a slice of them.
"""

from __future__ import annotations

import argparse
import random
import runpy
import sys
import time
import traceback
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np

from rvsim import load_robot
from rvsim.device.driver.actions import (
    Action,
    Connect,
    Disconnect,
    Grip,
    Hold,
    JogPulse,
    Limp,
    MoveTo,
    Reset,
    Run,
    StopAll,
    Stream,
    UseServos,
    Wake,
)
from rvsim.device.virtual.faults import Fault, Faults
from rvsim.motion import joint_move

Rig: Any = runpy.run_path(str(Path(__file__).parents[1] / "device" / "driver" / "conftest.py"))["Rig"]
ROBOT = load_robot("al5b")
SESSION = 30.0  # [s]
STEP = 0.005  # [s]
# Through these no byte comes, or not the one that was sent.
DEAF = (Fault.PORT_VANISHES, Fault.WRONG_BAUD, Fault.SATURATED_BUFFER, Fault.BROWN_OUT, Fault.BROWN_OUT_IN_MOVE)
ON_THE_WIRE = 0.12  # [s] a line that was begun before may still arrive
JUNK: tuple[Action, ...] = (
    *(MoveTo([np.nan] * 5), MoveTo([1.0]), MoveTo("elbow"), Stream([np.inf] * 5), Wake(77, 0.0), Wake("gripper", 9.0)),
    *(Grip(-1.0), JogPulse(31, 1500.0), JogPulse(0, np.inf), Limp(-3), MoveTo(ROBOT.home, np.nan), UseServos(())),
)


def _pose(dice: random.Random, rig: Any, reach: float) -> np.ndarray:
    here = rig.state.commanded_q
    here = np.where(np.isfinite(here), here, rig.home)
    return np.clip(here + [dice.uniform(-reach, reach) for _ in here], *rig.core.limits.T)


def random_action(dice: random.Random, rig: Any) -> Action:
    """Mostly sensible."""
    kind = dice.choices(
        (
            "wake",
            "move",
            "stream",
            "run",
            "grip",
            "jog",
            "hold",
            "limp",
            "stop",
            "reset",
            "connect",
            "disconnect",
            "junk",
        ),
        (6, 4, 8, 4, 1, 1, 1, 0.5, 1, 4, 4, 0.3, 2),
    )[0]
    asleep = [axis for axis, awake in enumerate(rig.state.awake) if not awake]
    made: dict[str, Any] = {
        "wake": lambda: Wake(dice.choice([*asleep, "gripper"]), 0.5) if not asleep else _wake(dice.choice(asleep), rig),
        "move": lambda: MoveTo(_pose(dice, rig, 0.5), dice.choice([None, 0.0, 1.0, 3.0])),
        "stream": lambda: Stream(_pose(dice, rig, 0.5)),
        "run": lambda: Run(
            joint_move(ROBOT, _pose(dice, rig, 0.0), _pose(dice, rig, 0.4), seconds=dice.uniform(0.5, 4.0))
        ),
        "grip": lambda: Grip(dice.random()),
        "jog": lambda: JogPulse(dice.choice(rig.channels), dice.uniform(400.0, 2600.0)),
        "hold": Hold,
        "limp": lambda: Limp(dice.choice([0, 1, 2, 3, 4, "gripper"])),
        "stop": StopAll,
        "reset": Reset,
        "connect": Connect,
        "disconnect": Disconnect,
        "junk": lambda: dice.choice(JUNK),
    }
    return made[kind]()


def _wake(axis: int, rig: Any) -> Wake:
    return Wake(axis, float(rig.home[axis]))


class Judge:
    """Watches a rig step by step."""

    def __init__(self, rig: Any) -> None:
        self.rig = rig
        self._judged = 0
        self._allowed: dict[int, float] = {}  # axis → until when a move of it may arrive
        self._stopped: float | None = None
        self._held: np.ndarray | None = None
        self._deaf_until = 0.0

    def asked(self, action: Action, refused: bool) -> None:
        """A wake that was accepted may move its axis."""
        if isinstance(action, Wake) and not refused:
            axis = ROBOT.dof if action.axis == "gripper" else action.axis
            self._allowed[axis] = self.rig.now + 2.0

    def step(self) -> None:
        rig, now = self.rig, self.rig.now
        state = rig.state
        for axis, awake in enumerate((*state.awake, state.gripper_awake)):
            if awake:
                self._allowed[axis] = now + ON_THE_WIRE
        for told in rig.board.told[self._judged :]:
            self._judge_told(told)
        self._judged = len(rig.board.told)
        if rig.arm.faults.on.intersection(DEAF):
            self._deaf_until = now + 1.0
        self._judge_rest(state.phase == "stopped")

    def _judge_told(self, told: Any) -> None:
        sleeping = [axis for axis in told.moves if self._allowed.get(axis, -1.0) < told.time - STEP]
        assert not sleeping, f"axes {sleeping} sleep and were told to move at {told.time:.3f} s"
        if self._stopped is not None and told.time > self._stopped + STEP + 2.1 * 10.0 / self.rig.baud:
            assert not told.moves, f"a set-point arrived at {told.time:.3f} s, after the stop at {self._stopped:.3f} s"
            assert not told.limp

    def _judge_rest(self, stopped: bool) -> None:
        now = self.rig.now
        if not stopped:
            self._stopped = self._held = None
            return
        self._stopped = now if self._stopped is None else self._stopped
        if now < max(self._stopped + 0.2, self._deaf_until + 1.0):
            self._held = None
            return
        pulses = self.rig.pulses
        if self._held is None:
            self._held = pulses
        changed = np.isfinite(pulses) & (pulses != self._held)
        assert not changed.any(), f"pulses went from {self._held} to {pulses} after the stop"


def session(seed: int, counts: Counter[str], seconds: float = SESSION) -> None:
    """One arm and one driver for a while.

    Raises:
        AssertionError: a law is broken.
    """
    dice = random.Random(seed)
    language, baud = dice.choice(["ssc32", "bridge"]), dice.choice([9600, 38400, 115200])
    rig = Rig(ROBOT, language, baud, seed=dice.randrange(1000))
    judge = Judge(rig)
    rig.do(Connect())
    if dice.random() < 0.7:
        rig.until("asleep")
        rig.wake_all()
        judge._allowed = dict.fromkeys(range(6), rig.now + 1.0)
    while rig.now < seconds:
        _stir(dice, rig, judge, counts)
        for _ in range(int(dice.choice([0.01, 0.05, 0.2, 0.7, 2.0]) / STEP)):
            rig.step(STEP)
            judge.step()
            if dice.random() < 0.002:
                rig.arm.faults = Faults()
    counts[f"{language} sessions"] += 1


def _stir(dice: random.Random, rig: Any, judge: Judge, counts: Counter[str]) -> None:
    if dice.random() < 0.12:
        fault = dice.choice(list(Fault))
        counts[f"fault: {fault}"] += 1
        rig.arm.faults = rig.arm.faults.switched(fault, fault not in rig.arm.faults)
        if fault is Fault.PORT_VANISHES:
            rig.core.lose("The plug is out.")
        return
    action = random_action(dice, rig)
    refusal = rig.do(action)
    judge.asked(action, refusal is not None)
    counts[f"{type(action).__name__}{' refused' if refusal else ''}"] += 1
    assert refusal is None or refusal.sentence.endswith((".", "?")), refusal


def main() -> int:
    """Many sessions."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--minutes", type=float, default=1000.0)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    counts: Counter[str] = Counter()
    began, sessions = time.monotonic(), max(round(options.minutes * 60.0 / SESSION), 1)
    for seed in range(options.seed, options.seed + sessions):
        try:
            session(seed, counts)
        except Exception:
            traceback.print_exc()
            print(f"session {seed} broke a law; again with --seed {seed} --minutes 0.1")
            return 1
    spent = time.monotonic() - began
    for name, count in sorted(counts.items()):
        print(f"{count:8d}  {name}")
    print(f"{sessions * SESSION / 60.0:g} simulated minutes, {sessions * SESSION / spent:.0f} times real time")
    return 0


if __name__ == "__main__":
    sys.exit(main())
